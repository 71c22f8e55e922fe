/* The ring of arcs round the structure. Arc k of n covers [k, k+1) 2 pi / n of theta = atan2(y, -x): 0 faces the
 * current, positive towards +y, clockwise seen from above. */
#ifndef FW_GEOMETRY_RING_H
#define FW_GEOMETRY_RING_H

#include <stddef.h>

double fw_ring_angle(double x, double y); /* theta of a point, in [0, 2 pi) */

/* Change of theta on the shorter way from point 0 to point 1, in [-pi, pi]; a few products for the small turns of one step,
 * without arctangent. */
double fw_ring_turn(double x0, double y0, double x1, double y1);

/* Lay down on the ring what a patch [low, high] leaves there while each of its edges moves evenly from angle [0] to angle [1]:
 *
 *        share     ______________             the low edge sweeps over the arcs of one slope, the high edge over those of the
 *        of an    /              `--__        other; upright where an edge rests
 *        arc   __/                    `--__
 *
 * cells    (n_arcs, n_quads, 4): cells[arc][i] += amount[i] x the arc's share. Several quantities at once, four doubles a step,
 *          because a patch covers ten arcs or twenty and each quantity would find them anew
 * amount   (n_quads, 4)
 *
 * The shares are at least 0 and sum to 1; cells of arcs not covered keep their bits. low <= high at both times, and no patch with
 * its sweep longer than the ring. A patch narrower than a thousandth of an arc counts as that wide: keeps the shares exact.
 * A difference array (four entries a patch, summed up at the end) was considered: at these widths it costs as much, and
 * arcs that nothing reached would hold rounding errors. */
void fw_ring_spread(double *cells, size_t n_quads, size_t n_arcs, const double low[2], const double high[2],
                    const double *amount);

#endif
