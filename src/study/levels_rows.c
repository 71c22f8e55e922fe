/* What the pairs of the pilot of levels say, row by row, and the verdict. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/levels_inside.h"

typedef struct values {
    double         *dear, *cheap; /* (n) owned */
    fw_paired_draws draws;
} values;

/* What decides the precision, of every window: its mean depth, or P(D <= x). */
static fw_status read_way(const fw_levels *l, const fw_levels_way *way, bool is_mean, double *to, fw_msg *m)
{
    fw_window w;
    FW_TRY(fw_window_make(&w, &way->depth, l->point - 1, m));
    if (is_mean)
        memcpy(to, w.means, way->depth.n * sizeof *to);
    else
        fw_window_cdfs(&w, l->depth_mm, to);
    fw_window_free(&w);
    return FW_OK;
}

/* What is left of values that are all the same, relative to their squares: below this it is rounding. */
static const double ROUNDING = 1e-24;

/* Shares in a weighted mean, n of which count as one: of the residuals of the control variates, or of the distances from the mean. */
static void take_shares(const fw_depth *own, bool is_controlled, double *x)
{
    const double *weight = is_controlled ? own->control.calibration.weight : own->plain;
    double        mean = 0, squares = 0, left = 0;
    for (size_t i = 0; i < own->n; i++) mean += weight[i] * x[i], squares += x[i] * x[i];
    if (is_controlled) fw_calibration_residuals(&own->control.calibration, x);
    for (size_t i = 0; i < own->n; i++) {
        if (!is_controlled) x[i] -= mean;
        left += x[i] * x[i];
        x[i] *= (double)own->n * weight[i];
    }
    for (size_t i = 0; i < own->n && left <= ROUNDING * squares; i++) x[i] = 0;
}

static fw_status correlate(const fw_levels *l, const fw_levels_way *own, const fw_levels_way *way, bool is_mean, bool is_controlled, values *v,
                           fw_coupled *out, fw_msg *m)
{
    FW_TRY(read_way(l, own, is_mean, v->dear, m));
    FW_TRY(read_way(l, way, is_mean, v->cheap, m));
    take_shares(&own->depth, is_controlled, v->dear);
    take_shares(&own->depth, is_controlled, v->cheap);
    fw_coupled_pairs x = {.n = own->depth.n, .dear = v->dear, .cheap = v->cheap, .dear_cost = own->cpu_s, .cheap_cost = way->cpu_s};
    return fw_coupled_compare(&x, &v->draws, l->confidence, out, m);
}

/* Windows from which a run has all its control variates (control.h). With fewer, what they leave of the scenario is common to both models: at 60 %
 * ice 128 windows with 7 of them promised x1.90 [0.97, 3.81] for windows without floe contact, 256 with 13 x0.98 [0.97, 1.00]. */
enum { FEWEST = 240 };

static void judge(fw_levels_row *row, const fw_levels *l, bool is_strip)
{
    const fw_coupled *p = &row->pairs;
    const fw_gain    *g = &p->multifidelity;
    char              promise[64];
    size_t            size = sizeof row->verdict;
    bool              is_small = l->n_functions > 1 && l->n_windows < FEWEST;
    snprintf(promise, sizeof promise, "promises x%.2f [%.2f, %.2f]", g->gain, g->low, g->high);
    if (isnan(g->gain))
        snprintf(row->verdict, size, "refused: nothing scatters that it could explain");
    else if (is_strip)
        snprintf(row->verdict, size, l->n_functions > 0 ? "in use: a control variate; beyond that it %s" : "in use wherever there are control variates: it %s", promise);
    else if (!(g->low > FW_LEVELS_WANTED))
        snprintf(row->verdict, size, "refused: %s, wanted more than x%g", promise, FW_LEVELS_WANTED);
    else if (!(p->kurtosis < p->most_kurtosis))
        snprintf(row->verdict, size, "refused: %s, but a few pairs carry the difference (kurtosis %.0f, wanted below %.0f)", promise, p->kurtosis, p->most_kurtosis);
    else if (!(p->consistency < 1))
        snprintf(row->verdict, size, "refused: %s, but the levels do not add up (consistency %.2g, wanted below 1)", promise, p->consistency);
    else if (is_small)
        snprintf(row->verdict, size, "refused: %s, but %zu windows are too few for all control variates of a run; wanted %d", promise, l->n_windows, FEWEST);
    else
        snprintf(row->verdict, size, "%s", promise);
    row->is_promising = !is_strip && !is_small && g->low > FW_LEVELS_WANTED && p->kurtosis < p->most_kurtosis && p->consistency < 1;
}

/* Nothing is paid for what the strip says for nothing: where control variates leave it that much, they are too few or do not know the load. */
static void compare_with_strip(size_t n_cheap, fw_levels_way *cheap)
{
    const fw_levels_row *strip = NULL;
    for (size_t k = 0; k < n_cheap; k++)
        if (cheap[k].is_strip) strip = cheap[k].row;
    for (size_t k = 0; k < n_cheap && strip; k++) {
        fw_levels_row *row = cheap[k].row;
        const fw_gain *g = &row->pairs.multifidelity;
        if (!row->is_promising || g->gain > strip->pairs.multifidelity.gain) continue;
        row->is_promising = false;
        snprintf(row->verdict, sizeof row->verdict, "refused: promises x%.2f [%.2f, %.2f], and the swept strip x%.2f for nothing: a control variate is missing, no level", g->gain,
                 g->low, g->high, strip->pairs.multifidelity.gain);
    }
}

static fw_status compare(fw_levels *out, const fw_campaign *c, const fw_levels_way *own, size_t n_cheap, fw_levels_way *cheap, values *v, fw_msg *m)
{
    size_t n = own->depth.n;
    bool   is_mean = isnan(out->percentile);
    FW_TRY(fw_alloc(&v->dear, n, sizeof *v->dear, "values of windows", m));
    FW_TRY(fw_alloc(&v->cheap, n, sizeof *v->cheap, "values of windows", m));
    FW_TRY(fw_paired_draws_make(&v->draws, n, c->seed, m));
    for (size_t k = 0; k < n_cheap; k++) {
        fw_levels_row *row = cheap[k].row;
        fw_coupled     other;
        FW_TRY(correlate(out, own, &cheap[k], is_mean, true, v, &row->pairs, m));
        FW_TRY(correlate(out, own, &cheap[k], is_mean, false, v, &other, m));
        row->correlation_before = other.correlation;
        FW_TRY(correlate(out, own, &cheap[k], true, true, v, &other, m));
        row->correlation_mean = other.correlation;
        row->evaluations_ratio = own->evaluations / cheap[k].evaluations;
        judge(row, out, cheap[k].is_strip);
    }
    compare_with_strip(n_cheap, cheap);
    return FW_OK;
}

fw_status fw_levels_compare(fw_levels *out, const fw_campaign *c, const fw_levels_way *own, size_t n_cheap, fw_levels_way *cheap, fw_msg *m)
{
    values    v = {0};
    fw_status s = compare(out, c, own, n_cheap, cheap, &v, m);
    free(v.dear);
    free(v.cheap);
    fw_paired_draws_free(&v.draws);
    return s;
}
