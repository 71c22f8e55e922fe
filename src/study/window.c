#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "statistics/averaged.h"
#include "statistics/mean.h"
#include "study/depth.h"

/* The arcs and weights with which record i reaches the point, and its loads. */
static const fw_direction_weight *row_of(const fw_window *w, size_t i, size_t *n, const double **load)
{
    const fw_depth *d = w->depth;
    *load = d->load + i * d->directions.n_used;
    return fw_directions_row(&d->directions, d->direction_law[i], w->point, n);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Per realisation: mean depth; over all: the raw moments of load and with them those of depth (Y and arc
 * independent). */
static void take_moments(fw_window *w)
{
    const fw_depth *d = w->depth;
    double          sum[1 + FW_SCALE_MOMENTS] = {0};
    for (size_t i = 0; i < d->n; i++) {
        size_t                     n = 0;
        const double              *load = NULL;
        const fw_direction_weight *row = row_of(w, i, &n, &load);
        double                     own = 0;
        for (size_t k = 0; k < n; k++) {
            double x = load[row[k].column], wx = row[k].weight * x;
            own += wx;
            sum[2] += wx * x;
            sum[3] += wx * x * x;
        }
        sum[1] += own;
        w->means[i] = own * d->scale.moment[1];
    }
    w->load = sum[1] / (double)d->n;
    w->moment[0] = 1;
    for (int k = 1; k <= FW_SCALE_MOMENTS; k++) w->moment[k] = sum[k] / (double)d->n * d->scale.moment[k];
}

static fw_status make_mixture(fw_window *w, fw_msg *m)
{
    const fw_depth   *d = w->depth;
    fw_mixture_entry *entries = NULL;
    size_t            n_entries = 0, at = 0, n = 0;
    const double     *load = NULL;
    for (size_t i = 0; i < d->n; i++) {
        row_of(w, i, &n, &load);
        n_entries += n;
    }
    FW_TRY(fw_alloc(&entries, n_entries, sizeof *entries, "loads of a measuring point", m));
    for (size_t i = 0; i < d->n; i++) {
        const fw_direction_weight *row = row_of(w, i, &n, &load);
        for (size_t k = 0; k < n; k++) entries[at++] = (fw_mixture_entry){load[row[k].column], row[k].weight};
    }
    fw_status s = fw_mixture_make(&w->mixture, &d->scale, n_entries, entries, m);
    free(entries);
    return s;
}

static fw_status make(fw_window *w, fw_msg *m)
{
    const fw_depth *d = w->depth;
    FW_CHECK(d->n > 0, m, FW_E_FAILURES, "no realisation succeeded (%zu failed): there is nothing to answer from",
             d->n_failed);
    FW_TRY(fw_alloc(&w->means, d->n, sizeof *w->means, "mean depths of a measuring point", m));
    take_moments(w);
    if (!w->is_sample) return make_mixture(w, m);
    FW_TRY(fw_alloc(&w->sorted, d->n, sizeof *w->sorted, "depths of a measuring point", m));
    memcpy(w->sorted, w->means, d->n * sizeof *w->sorted); /* one arc, one temperature: the mean is the value */
    qsort(w->sorted, d->n, sizeof *w->sorted, compare_doubles);
    return FW_OK;
}

fw_status fw_window_make(fw_window *out, const fw_depth *d, size_t point, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    out->depth = d;
    out->point = point;
    out->is_sample = d->directions.is_single && d->scale.is_discrete && d->scale.n == 1;
    fw_status s = make(out, m);
    if (s != FW_OK) fw_window_free(out);
    return s;
}

void fw_window_free(fw_window *w)
{
    if (!w) return;
    free(w->means);
    free(w->sorted);
    fw_mixture_free(&w->mixture);
    memset(w, 0, sizeof *w);
}

double fw_window_percentile(const fw_window *w, double p)
{
    return w->is_sample ? fw_order_percentile(w->depth->n, w->sorted, p) : fw_mixture_quantile(&w->mixture, p);
}

/* P(D <= depth) in realisation i. This is asked a dozen times of every load of every point, hence no logarithms and no
 * divisions in the inner loops. */
static double own_cdf(const fw_window *w, size_t i, double depth, double ln_depth)
{
    const fw_scale            *s = &w->depth->scale;
    size_t                     n = 0;
    const double              *load = NULL;
    const fw_direction_weight *row = row_of(w, i, &n, &load);
    double                     sum = 0;
    if (s->is_discrete) {
        for (size_t t = 0; t < s->n; t++) {
            double most = depth / s->values[t] * (1 + 1e-12), part = 0; /* the percentile itself is one of the loads */
            for (size_t k = 0; k < n; k++) part += load[row[k].column] <= most ? row[k].weight : 0;
            sum += s->weights[t] * part;
        }
        return fmin(sum, 1);
    }
    const double *ln_load = w->depth->ln_load + i * w->depth->directions.n_used;
    for (size_t k = 0; k < n; k++) {
        double x = ln_load[row[k].column];
        sum += row[k].weight * (x == -INFINITY ? 1 : fw_scale_cdf_ln(s, ln_depth - x));
    }
    return fmin(sum, 1);
}

static void own_sums(void *self, double depth, double *sum, double *squares)
{
    const fw_window *w = self;
    double           ln_depth = log(depth); /* -inf at 0: only loads of 0 count */
    *sum = *squares = 0;
    for (size_t i = 0; i < w->depth->n; i++) {
        double f = own_cdf(w, i, depth, ln_depth);
        *sum += f;
        *squares += f * f;
    }
}

fw_interval fw_window_interval(const fw_window *w, double p, double confidence)
{
    const fw_depth *d = w->depth;
    if (w->is_sample) return fw_order_interval(d->n, w->sorted, d->n_failed, p, confidence);
    fw_window         self = *w; /* the callback borrows; it changes nothing */
    fw_averaged_parts parts = {own_sums, &self};
    return fw_averaged_interval(&w->mixture, d->n, d->n_failed, &parts, p, confidence);
}

fw_interval fw_window_mean_interval(const fw_window *w, double confidence)
{
    fw_interval v = fw_mean_interval(w->depth->n, w->means, w->depth->n_failed, confidence);
    if (v.low < 0) v.low = 0; /* no wear is negative */
    return v;
}

void fw_window_failure_ends(const fw_window *w, double p, double *low, double *high)
{
    double n = (double)w->depth->n, failed = (double)w->depth->n_failed;
    double low_level = (p * (n + failed) - failed) / n, high_level = p * (n + failed) / n;
    *low = low_level <= 0 ? 0 : fw_window_percentile(w, low_level);
    *high = high_level > 1 ? INFINITY : fw_window_percentile(w, high_level);
}

double fw_window_draw(const fw_window *w, double u_record, double u_arc, double u_factor)
{
    size_t i = (size_t)(u_record * (double)w->depth->n), n = 0;
    if (i >= w->depth->n) i = w->depth->n - 1;
    const double              *load = NULL;
    const fw_direction_weight *row = row_of(w, i, &n, &load);
    size_t                     k = 0;
    for (double sum = row[0].weight; k + 1 < n && sum < u_arc; sum += row[k].weight) k++;
    return load[row[k].column] * fw_scale_quantile(&w->depth->scale, u_factor);
}
