#include "study/simultaneous.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "statistics/bands.h"

fw_status fw_simultaneous_open(fw_simultaneous *out, const fw_depth *d, size_t n_percentiles, fw_msg *m)
{
    size_t n_groups = d->n_units < FW_BANDS_MOST_GROUPS ? d->n_units : FW_BANDS_MOST_GROUPS;
    *out = (fw_simultaneous){.depth = d, .n_percentiles = n_percentiles, .n_groups = n_groups};
    fw_status s = fw_alloc(&out->shares, n_percentiles * d->n_points * n_groups, sizeof *out->shares, "shares of points in a band", m);
    if (s == FW_OK) s = fw_alloc(&out->levels, n_percentiles * d->n_points, sizeof *out->levels, "percentiles of points", m);
    if (s != FW_OK) fw_simultaneous_close(out);
    return s;
}

void fw_simultaneous_close(fw_simultaneous *s)
{
    free(s->shares);
    free(s->levels);
    memset(s, 0, sizeof *s);
}

static double *shares_of(const fw_simultaneous *s, size_t percentile, size_t point)
{
    return s->shares + (percentile * s->depth->n_points + point) * s->n_groups;
}

const fw_window_level *fw_simultaneous_add(fw_simultaneous *s, const fw_window *w, size_t k, double p)
{
    const fw_depth  *d = s->depth;
    fw_window_level *l = &s->levels[w->point * s->n_percentiles + k];
    fw_window_look(w, p, l, d->scratch);
    if (l->depth > 0 && isfinite(fw_window_effective_size(w, l))) { /* the shares of others stay 0 */
        fw_bands_group(d->n_units, d->scratch);
        memcpy(shares_of(s, k, w->point), d->scratch, s->n_groups * sizeof *d->scratch);
    }
    return l;
}

/* Wider than the point's own interval; what that one does not have, the band does not have either. */
static void take_ends(const fw_window *w, const fw_window_level *l, double pointwise, fw_percentile_row *row)
{
    fw_interval v = fw_window_interval_at(w, l, pointwise);
    row->band_low_mm = isnan(row->low_mm) ? NAN : v.low < row->low_mm || isnan(v.low) ? v.low : row->low_mm;
    row->band_high_mm = isnan(row->high_mm) ? NAN : v.high > row->high_mm || isnan(v.high) ? v.high : row->high_mm;
}

static fw_status take_all_ends(const fw_simultaneous *s, double confidence, const double *pointwise, fw_percentile_row *rows, fw_msg *m)
{
    bool is_wider = false;
    for (size_t k = 0; k < s->n_percentiles; k++) is_wider = is_wider || pointwise[k] > confidence;
    for (size_t i = 0; i < s->depth->n_points; i++) {
        fw_window          w;
        fw_percentile_row *own = rows + i * s->n_percentiles;
        if (is_wider) FW_TRY(fw_window_make(&w, s->depth, i, m));
        for (size_t k = 0; k < s->n_percentiles; k++) {
            own[k].band_low_mm = own[k].low_mm, own[k].band_high_mm = own[k].high_mm;
            if (pointwise[k] > confidence) take_ends(&w, &s->levels[i * s->n_percentiles + k], pointwise[k], &own[k]);
        }
        if (is_wider) fw_window_free(&w);
    }
    return FW_OK;
}

fw_status fw_simultaneous_end(fw_simultaneous *s, double confidence, fw_percentile_row *rows, fw_msg *m)
{
    const fw_depth *d = s->depth;
    double         *pointwise = NULL;
    FW_TRY(fw_alloc(&pointwise, s->n_percentiles, sizeof *pointwise, "confidences of a band", m));
    fw_status status = FW_OK;
    for (size_t k = 0; k < s->n_percentiles && status == FW_OK; k++)
        status = fw_bands_confidence(d->n_points, s->n_groups, shares_of(s, k, 0), confidence, d->campaign->seed, &pointwise[k], m);
    if (status == FW_OK) status = take_all_ends(s, confidence, pointwise, rows, m);
    free(pointwise);
    return status;
}
