/* How much of the time each arc of the ring faces a measuring point: the weights that integrate the current's
 * direction.
 *
 * bearing = direction + 180 + theta (degrees; bearing of the point's outward normal, direction the current flows
 * to), so a point reads arc k, theta in [k, k+1) 360/n, with weight w_k = P(bearing - direction - 180 in arc k,
 * modulo 360). A law of given values puts each of them into its arc; a continuous one gives w_k = CDF differences
 * over the arc, wrapped. */
#ifndef FW_STUDY_DIRECTIONS_H
#define FW_STUDY_DIRECTIONS_H

#include <stdint.h>

#include "floewear/campaign.h"

/* The arc that a point of this bearing reads when the current flows to `direction`. A theta within 1e-9 of an arc's
 * upper end counts as that end: 180 - 0 - 180 must be arc 0 and not, by a rounding, the last one. */
size_t fw_directions_arc(size_t n_arcs, double bearing, double direction);

typedef struct fw_direction_weight {
    uint32_t column; /* index into used */
    double   weight;
} fw_direction_weight;

typedef struct fw_directions {
    size_t               n_arcs, n_points, n_laws; /* laws: one per cell of the joint table, else one */
    size_t               n_used;
    size_t              *used;      /* (n_used) arcs that any point reads under any law, ascending; owned */
    size_t              *first;     /* (n_laws * n_points + 1) into weights; owned */
    fw_direction_weight *weights;   /* by law, then point, then ascending arc; a row's weights sum to 1; owned */
    bool                 is_single; /* every row has one arc: each realisation gives each point one load */
} fw_directions;

fw_status fw_directions_make(fw_directions *out, const fw_site *site, size_t n_arcs, size_t n_points,
                             const double *bearings, fw_msg *m);
void      fw_directions_free(fw_directions *d);

/* The row of (law, point): its weights and their number. */
static inline const fw_direction_weight *fw_directions_row(const fw_directions *d, size_t law, size_t point, size_t *n)
{
    size_t row = law * d->n_points + point;
    *n = d->first[row + 1] - d->first[row];
    return d->weights + d->first[row];
}

#endif
