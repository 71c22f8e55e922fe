#include <gsl/gsl_sort.h>
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
    return fw_directions_row(&d->directions, d->row[i].scenario.cell, w->point, n);
}

static double weight_of(const fw_window *w, size_t i) { return w->depth->control.calibration.weight[i]; }

/* Per realisation: mean depth; over all: the raw moments of depth (Y and arc independent). */
static void take_moments(fw_window *w)
{
    const fw_depth *d = w->depth;
    double          sum[1 + FW_SCALE_MOMENTS] = {0};
    for (size_t i = 0; i < d->n; i++) {
        size_t                     n = 0;
        const double              *load = NULL;
        const fw_direction_weight *row = row_of(w, i, &n, &load);
        double                     own[1 + FW_SCALE_MOMENTS] = {0};
        for (size_t k = 0; k < n; k++) {
            double x = load[row[k].column], wx = row[k].weight * x;
            own[1] += wx;
            own[2] += wx * x;
            own[3] += wx * x * x;
        }
        for (int k = 1; k <= FW_SCALE_MOMENTS; k++) sum[k] += weight_of(w, i) * own[k];
        w->means[i] = own[1] * d->scale.moment[1];
        w->squares[i] = own[2] * d->scale.moment[2];
    }
    w->moment[0] = 1;
    for (int k = 1; k <= FW_SCALE_MOMENTS; k++) w->moment[k] = sum[k] * d->scale.moment[k];
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
        for (size_t k = 0; k < n; k++) entries[at++] = (fw_mixture_entry){load[row[k].column], row[k].weight * weight_of(w, i)};
    }
    fw_status s = fw_mixture_make(&w->mixture, &d->scale, n_entries, entries, m);
    free(entries);
    return s;
}

static fw_status make(fw_window *w, fw_msg *m)
{
    const fw_depth *d = w->depth;
    FW_TRY(fw_alloc(&w->means, d->n, sizeof *w->means, "mean depths of a measuring point", m));
    FW_TRY(fw_alloc(&w->squares, d->n, sizeof *w->squares, "squared depths of a measuring point", m));
    take_moments(w);
    if (!w->is_sample) return make_mixture(w, m);
    FW_TRY(fw_alloc(&w->sorted, d->n, sizeof *w->sorted, "depths of a measuring point", m));
    memcpy(w->sorted, w->means, d->n * sizeof *w->sorted); /* one arc, one temperature: the mean is the value */
    gsl_sort(w->sorted, 1, d->n);
    return FW_OK;
}

/* Order statistics are those of equal, independent draws. */
static bool is_plain_sample(const fw_depth *d)
{
    bool is_plain = d->stride == 1 && !d->unit && !d->control.is_on && d->directions.is_single && d->scale.is_discrete && d->scale.n == 1;
    for (size_t i = 0; i < d->n && is_plain; i++) is_plain = d->row[i].scenario.weight == d->row[0].scenario.weight;
    return is_plain;
}

fw_status fw_window_make(fw_window *out, const fw_depth *d, size_t point, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    out->depth = d;
    out->point = point;
    out->is_sample = is_plain_sample(d);
    fw_status s = make(out, m);
    if (s != FW_OK) fw_window_free(out);
    return s;
}

void fw_window_free(fw_window *w)
{
    if (!w) return;
    free(w->means);
    free(w->squares);
    free(w->sorted);
    fw_mixture_free(&w->mixture);
    memset(w, 0, sizeof *w);
}

double fw_window_percentile(const fw_window *w, double p)
{
    return w->is_sample ? fw_order_percentile(w->depth->n, w->sorted, p) : fw_mixture_quantile(&w->mixture, p);
}

/* ---- scatter ----------------------------------------------------------------------------------------------------- */

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

double fw_window_cdfs(const fw_window *w, double depth, double *values)
{
    double ln_depth = log(depth), sum = 0; /* -inf at 0: only loads of 0 count */
    for (size_t i = 0; i < w->depth->n; i++) {
        values[i] = own_cdf(w, i, depth, ln_depth);
        sum += weight_of(w, i) * values[i];
    }
    return sum;
}

/* Realisations that carry a part of the probability: (sum w x)^2 / sum (w x)^2. */
static double carriers(const fw_window *w, const double *values, bool is_above)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < w->depth->n; i++) {
        double x = weight_of(w, i) * (is_above ? 1 - values[i] : values[i]);
        sum += x, squares += x * x;
    }
    return squares > 0 ? sum * sum / squares : 0;
}

/* Of values whose weighted mean is `mean`, which become leave-one-out residuals. Without control variates the scatter is that about the mean, with
 * weights as they are: more than there is, where control variates act. */
static fw_spread spread_of(const fw_window *w, double mean, bool is_controlled, double *values)
{
    const fw_depth *d = w->depth;
    fw_units        units = d->units;
    double          n = (double)d->n;
    if (is_controlled) {
        fw_calibration_residuals(&d->control.calibration, values);
    } else {
        for (size_t i = 0; i < d->n; i++) values[i] = (values[i] - mean) * n / fmax(1, n - 1);
        units.n_fitted = 1;
    }
    return fw_spread_of(&units, values, d->scratch + d->n);
}

/* Where fewer realisations than this carry what lies beyond a percentile, their residuals are no measure of what control variates leave: on the default
 * campaign intervals of P99 from 200 windows covered 87 % for 95. Then the interval is made without them. */
static const double FEWEST_CARRIERS = 12;

/* values (n): of every realisation there, leave-one-out residuals. */
static void cdf_with_residuals(const fw_window *w, double depth, fw_averaged_at *out, double *values)
{
    out->cdf = fmin(fw_window_cdfs(w, depth, values), 1);
    bool is_controlled = w->depth->control.is_on && fmin(carriers(w, values, false), carriers(w, values, true)) >= FEWEST_CARRIERS;
    out->spread = spread_of(w, out->cdf, is_controlled, values);
}

static void cdf_at(void *self, double depth, fw_averaged_at *out)
{
    const fw_window *w = self;
    cdf_with_residuals(w, depth, out, w->depth->scratch);
}

static double quantile_at(void *self, double level) { return fw_window_percentile(self, level); }

static double failed_share(const fw_depth *d) { return d->failed_weight / (d->weight + d->failed_weight); }

/* values (2 x n): the first n, residuals, become in the first n_units the units' shares in the error of the weighted mean. */
static void share_out(const fw_units *u, double *values)
{
    double *sums = values + u->n;
    for (size_t i = 0; i < u->n; i++) values[i] *= u->weight[i];
    if (!u->unit) return;
    for (size_t r = 0; r < u->n_units; r++) sums[r] = 0;
    for (size_t i = 0; i < u->n; i++) sums[u->unit[i]] += values[i];
    memcpy(values, sums, u->n_units * sizeof *values);
}

void fw_window_look(const fw_window *w, double p, fw_window_level *out, double *values)
{
    out->p = p;
    out->depth = fw_window_percentile(w, p);
    cdf_with_residuals(w, out->depth, &out->at, values);
    share_out(&w->depth->units, values);
}

fw_interval fw_window_interval_at(const fw_window *w, const fw_window_level *l, double confidence)
{
    const fw_depth *d = w->depth;
    if (w->is_sample) return fw_order_interval(d->n, w->sorted, d->n_failed, l->p, confidence);
    fw_window   self = *w; /* the callbacks borrow; they change nothing but scratch */
    fw_averaged x = {.at = cdf_at, .quantile = quantile_at, .self = &self, .n = d->n, .at_percentile = &l->at, .failed_share = failed_share(d)};
    return fw_averaged_interval(&x, l->p, confidence);
}

fw_interval fw_window_interval(const fw_window *w, double p, double confidence)
{
    fw_window_level l;
    fw_window_look(w, p, &l, w->depth->scratch);
    return fw_window_interval_at(w, &l, confidence);
}

double fw_window_effective_size(const fw_window *w, const fw_window_level *l)
{
    const fw_depth *d = w->depth;
    double          n = w->is_sample ? (double)(d->n + d->n_failed) : fw_averaged_kish_size(&l->at) / (1 - failed_share(d));
    return n > 0 && n < FW_AVERAGED_MOST_N ? n : NAN;
}

const char *fw_window_method(const fw_window *w)
{
    if (w->is_sample) return "order statistics";
    if (w->depth->unit) return w->depth->control.is_on ? "averaged CDF, control variates, randomisations" : "averaged CDF, randomisations";
    return w->depth->control.is_on ? "averaged CDF, control variates" : "averaged CDF";
}

/* A mean goes with the load itself: without it among the control variates, or where few windows carry the mean, its scatter is taken without them. */
static bool is_mean_controlled(const fw_window *w)
{
    return w->depth->control.has_load && carriers(w, w->means, false) >= FEWEST_CARRIERS;
}

/* values (2 x n; of the first n each realisation's own number) become values whose plain mean is about and whose scatter is that of what the control
 * variates leave: each realisation's, or each randomisation's, share in the weighted mean. Returns their number. */
static size_t pseudo_values(const fw_window *w, double about, double *values)
{
    const fw_depth *d = w->depth;
    const fw_units *u = &d->units;
    double          mean = 0;
    for (size_t i = 0; i < d->n; i++) mean += weight_of(w, i) * values[i];
    spread_of(w, mean, is_mean_controlled(w), values);
    share_out(u, values);
    for (size_t r = 0; r < u->n_units; r++) values[r] = about + (double)u->n_units * values[r];
    return u->n_units;
}

/* From the n units' pseudo-values. Of a design's randomisations none fails as a whole: failed realisations take their share off the lower end. */
static fw_interval interval_of_units(const fw_window *w, double about, size_t n, const double *values, double none, double confidence)
{
    const fw_depth *d = w->depth;
    size_t          n_failed = d->unit ? 0 : d->n_failed, least = d->unit ? FW_MEAN_MIN_UNITS : FW_MEAN_MIN_N;
    fw_interval     v = fw_mean_interval_of(about, n, values, n_failed, none, least, confidence);
    if (v.low < 0) v.low = 0; /* no wear is negative */
    if (d->unit && d->n_failed) v.low *= 1 - failed_share(d), v.high = NAN;
    return v;
}

fw_interval fw_window_interval_of(const fw_window *w, double about, double none, double *values, double confidence)
{
    size_t n = pseudo_values(w, about, values);
    return interval_of_units(w, about, n, values, none, confidence);
}

/* About the pseudo-values' own mean, from which leave-one-out residuals have taken a little of the regression's bias. */
fw_interval fw_window_mean_interval(const fw_window *w, double confidence)
{
    double *values = w->depth->scratch;
    memcpy(values, w->means, w->depth->n * sizeof *values);
    size_t n = pseudo_values(w, w->moment[1], values);
    return interval_of_units(w, fw_mean(n, values), n, values, 0, confidence);
}

double fw_window_mean_vov(const fw_window *w)
{
    double *values = w->depth->scratch;
    if (w->is_sample) return 0;
    memcpy(values, w->means, w->depth->n * sizeof *values);
    return spread_of(w, w->moment[1], is_mean_controlled(w), values).vov;
}

void fw_window_failure_ends(const fw_window *w, double p, double *low, double *high)
{
    double failed = failed_share(w->depth), low_level = (p - failed) / (1 - failed), high_level = p / (1 - failed);
    *low = low_level <= 0 ? 0 : fw_window_percentile(w, low_level);
    *high = high_level > 1 ? INFINITY : fw_window_percentile(w, high_level);
}

fw_window_scatter fw_window_scatter_at(const fw_window *w, double depth)
{
    const fw_depth   *d = w->depth;
    double           *f = d->scratch, mean = fw_window_cdfs(w, depth, f), squares = 0, left = 0, n = (double)d->n;
    fw_window_scatter out;
    for (size_t i = 0; i < d->n; i++) squares += weight_of(w, i) * (f[i] - mean) * (f[i] - mean);
    fw_calibration_residuals(&d->control.calibration, f);
    for (size_t i = 0; i < d->n; i++) left += weight_of(w, i) * f[i] * f[i];
    out.averaged = squares * n / (n - 1);
    out.controlled = left;
    return out;
}
