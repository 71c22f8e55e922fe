/* The ring of arcs round the structure. Arc k of n covers [k, k+1) 2 pi / n of theta = atan2(y, -x): 0 faces the
 * current, positive towards +y, clockwise seen from above. */
#ifndef FW_GEOMETRY_RING_H
#define FW_GEOMETRY_RING_H

#include <stddef.h>

double fw_ring_angle(double x, double y); /* theta of a point, in [0, 2 pi) */

/* The arcs that a patch [centre - half, centre + half] covers, as shares of its width: share[0..count-1] belongs to arcs
 * first, first + 1, ... modulo n_arcs and sums to 1. capacity >= n_arcs + 1. Returns count; half < pi. A patch of no
 * width belongs to the arc that holds its centre. */
size_t fw_ring_cover(size_t n_arcs, double centre, double half, size_t *first, double *share);

#endif
