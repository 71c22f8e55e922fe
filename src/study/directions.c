#include "study/directions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

size_t fw_directions_arc(size_t n_arcs, double bearing, double direction)
{
    double theta = fmod(bearing - direction - 180, 360);
    if (theta < 0) theta += 360;
    return (size_t)floor(theta * (double)n_arcs / 360 + 1e-9) % n_arcs;
}

static bool is_atoms(const fw_distribution *law)
{
    return law->kind == FW_DIST_VALUES || fw_distribution_is_constant(law);
}

static void weigh_atoms(const fw_distribution *law, size_t n_arcs, double bearing, double *weight)
{
    if (law->kind != FW_DIST_VALUES) {
        weight[fw_directions_arc(n_arcs, bearing, fw_distribution_max(law))] = 1;
        return;
    }
    for (size_t i = 0; i < law->n; i++) {
        double x = law->values[i];
        weight[fw_directions_arc(n_arcs, bearing, x)] += fw_distribution_cdf(law, x) - fw_distribution_cdf_left(law, x);
    }
}

/* theta in [k, k+1) D  <=>  direction in (bearing - 180 - (k+1) D, bearing - 180 - k D], and the same turned by 360
 * j */
static void weigh_continuous(const fw_distribution *law, size_t n_arcs, double bearing, double *weight)
{
    double least = fmax(fw_distribution_min(law), fw_distribution_quantile(law, 1e-15));
    double most = fmin(fw_distribution_max(law), fw_distribution_quantile(law, 1 - 1e-15));
    double start = bearing - 180, arc = 360 / (double)n_arcs;
    for (double turn = floor((least - start) / 360); start + 360 * turn - 360 < most; turn++) {
        double upper = fw_distribution_cdf(law, start + 360 * turn);
        for (size_t k = 0; k < n_arcs; k++) {
            double lower = fw_distribution_cdf(law, start + 360 * turn - (double)(k + 1) * arc);
            weight[k] += upper - lower;
            upper = lower;
        }
    }
}

/* One row of weights over all arcs; they sum to 1 but for rounding, which is taken out. */
static fw_status weigh(const fw_distribution *law, size_t n_arcs, double bearing, double *weight, fw_msg *m)
{
    memset(weight, 0, n_arcs * sizeof *weight);
    if (is_atoms(law)) {
        weigh_atoms(law, n_arcs, bearing, weight);
    } else {
        weigh_continuous(law, n_arcs, bearing, weight);
    }
    double sum = 0;
    for (size_t k = 0; k < n_arcs; k++) sum += weight[k];
    FW_CHECK(fabs(sum - 1) < 1e-6, m, FW_E_INTERNAL, "the direction weights of the point at %g degrees sum to %g",
             bearing, sum);
    for (size_t k = 0; k < n_arcs; k++) weight[k] /= sum;
    return FW_OK;
}

static const fw_distribution *law_of(const fw_site *site, size_t law)
{
    return site->n_cells ? &site->cells[law].direction : &site->direction;
}

typedef struct scratch {
    double *weight;  /* (n_arcs) */
    bool   *is_used; /* (n_arcs) */
} scratch;

static fw_status fill(fw_directions *d, const fw_site *site, const double *bearings, const scratch *t, fw_msg *m)
{
    size_t capacity = 0, n = 0;
    FW_TRY(fw_alloc(&d->first, d->n_laws * d->n_points + 1, sizeof *d->first, "rows of direction weights", m));
    d->is_single = true;
    for (size_t row = 0; row < d->n_laws * d->n_points; row++) {
        size_t law = row / d->n_points, point = row % d->n_points;
        FW_TRY(weigh(law_of(site, law), d->n_arcs, bearings[point], t->weight, m));
        for (size_t k = 0; k < d->n_arcs; k++) {
            if (!(t->weight[k] > 0)) continue;
            FW_TRY(fw_grow(&d->weights, &capacity, n + 1, sizeof *d->weights, "direction weights", m));
            d->weights[n++] = (fw_direction_weight){(uint32_t)k, t->weight[k]};
            t->is_used[k] = true;
        }
        d->first[row + 1] = n;
        d->is_single = d->is_single && n == d->first[row] + 1;
    }
    /* from arcs to columns: only arcs that somebody reads are kept of each record */
    size_t *column = NULL;
    FW_TRY(fw_alloc(&d->used, d->n_arcs, sizeof *d->used, "arcs in use", m));
    FW_TRY(fw_alloc(&column, d->n_arcs, sizeof *column, "columns of arcs", m));
    for (size_t k = 0; k < d->n_arcs; k++) {
        column[k] = d->n_used;
        if (t->is_used[k]) d->used[d->n_used++] = k;
    }
    for (size_t i = 0; i < n; i++) d->weights[i].column = (uint32_t)column[d->weights[i].column];
    free(column);
    return FW_OK;
}

fw_status fw_directions_make(fw_directions *out, const fw_site *site, size_t n_arcs, size_t n_points,
                             const double *bearings, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    out->n_arcs = n_arcs;
    out->n_points = n_points;
    out->n_laws = site->n_cells ? site->n_cells : 1;
    FW_CHECK(n_arcs > 0, m, FW_E_ARG, "a ring needs at least one arc");
    scratch   t = {NULL, NULL};
    fw_status s = fw_alloc(&t.weight, n_arcs, sizeof *t.weight, "weights of one row", m);
    if (s == FW_OK) s = fw_alloc(&t.is_used, n_arcs, sizeof *t.is_used, "marks of arcs", m);
    if (s == FW_OK) s = fill(out, site, bearings, &t, m);
    free(t.weight);
    free(t.is_used);
    if (s != FW_OK) fw_directions_free(out);
    return s;
}

void fw_directions_free(fw_directions *d)
{
    if (!d) return;
    free(d->used);
    free(d->first);
    free(d->weights);
    memset(d, 0, sizeof *d);
}
