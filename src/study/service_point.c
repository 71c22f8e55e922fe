/* One point's life: percentiles, fan, allowance, intervals. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "statistics/life.h"
#include "statistics/life_interval.h"
#include "study/service_run.h"

/* ---- the law of a window over normal scores ---------------------------------------------------------------------- */

/* Beyond this score a probability is no longer told from 0 or 1. */
static const double FARTHEST = 8.1;

typedef struct window_law {
    const fw_window *window;
    double           least, most;
} window_law;

static double depth_at(const void *self, double score)
{
    const window_law *q = self;
    if (score < -FARTHEST) return q->least;
    if (score > FARTHEST) return q->most;
    return fw_window_percentile(q->window, gsl_cdf_ugaussian_P(score));
}

static fw_status make_scores(fw_scores *out, const fw_window *w, fw_msg *m)
{
    window_law q = {w, fw_window_percentile(w, gsl_cdf_ugaussian_P(-FARTHEST)), fw_window_percentile(w, gsl_cdf_ugaussian_P(FARTHEST))};
    return fw_scores_make(out, depth_at, &q, w->moment[1], fmax(0, w->moment[2] - w->moment[1] * w->moment[1]), m);
}

/* ---- percentiles over years -------------------------------------------------------------------------------------- */

/* Independent windows, years alike, sums close to normal: Pearson's law with the sum's moments. */
static void by_moments(fw_service_run *s, const fw_life *window)
{
    double until = 0, before = 0, limit = s->campaign->service.allowance;
    size_t at = 0;
    for (size_t year = 0; year < s->years.n_years; year++) {
        until += (double)s->kinds[year].windows;
        double past = limit > 0 && until > 0 ? 1 - fw_life_cdf(window, until, limit * (1 - 1e-12)) : 0;
        s->used[year] = fmax(0, past - before);
        before = fmax(past, before);
        if (s->fan[at] != year + 1) continue;
        for (size_t k = 0; k < s->n_percentiles; k++)
            s->depths[at * s->n_percentiles + k] = until > 0 ? fmax(0, fw_life_percentile(window, until, s->percentiles[k])) : 0;
        at++;
    }
}

static fw_status by_lives(fw_service_run *s, size_t i, bool has_law, fw_msg *m)
{
    FW_TRY(fw_service_simulate(s, m));
    fw_lives_ask ask = {.n_percentiles = s->n_percentiles,
                        .percentiles = s->percentiles,
                        .n_fan = s->n_fan,
                        .fan = s->fan,
                        .limit = s->campaign->service.allowance,
                        .scale = has_law ? s->factor : NULL};
    FW_CHECK(!has_law || s->law->n == s->lives.n_lives, m, FW_E_INTERNAL, "%zu draws of the law for %zu lives", s->law->n, s->lives.n_lives);
    if (has_law) fw_law_factor_of_point(s->law, i, s->factor);
    fw_winters_sum(&s->winters, &s->scores, s->lives.n_lengths, s->lives.lengths, s->sums);
    fw_lives_run(&s->lives, &ask, s->sums, s->work, s->depths, has_law ? s->scaled : NULL, s->used, has_law ? s->used_scaled : NULL);
    return FW_OK;
}

/* First year up to whose end this share of lives has used up the allowance; NAN: it is not within the life. */
static double year_of_share(size_t n_years, const double *used, double share)
{
    double sum = 0;
    for (size_t year = 0; year < n_years; year++)
        if ((sum += used[year]) >= share * (1 - 1e-9) && sum > 0) return (double)year + 1;
    return NAN;
}

/* ---- intervals --------------------------------------------------------------------------------------------------- */

/* What the records leave open. values (2 x n): scratch. */
static fw_interval by_records(const fw_window *w, const fw_life_slopes *slopes, double depth, double *values, double confidence)
{
    const fw_depth *d = w->depth;
    double          none = fmax(0, depth - slopes->first * w->moment[1] - slopes->second * w->moment[2]);
    for (size_t i = 0; i < d->n; i++) values[i] = slopes->first * w->means[i] + slopes->second * w->squares[i];
    return fw_window_interval_of(w, depth, none, values, confidence);
}

/* For the asked percentiles of the life: of the records, and of the table of years where there is one. */
static fw_status set_intervals(const fw_service_run *s, const fw_window *w, const fw_life_spread *l, fw_life_row *rows, double *years_half, fw_msg *m)
{
    double *values = w->depth->scratch, *sums = NULL, mean = s->scores.mean, variance = s->scores.variance;
    FW_TRY(fw_alloc(&sums, s->years.n, sizeof *sums, "winters of a table", m));
    for (size_t k = 0; s->years.is_table && k < s->years.n; k++)
        sums[k] = fw_scores_sum(&s->scores, s->campaign->service.persistence, (double)s->kinds[k].windows);
    for (size_t k = 0; k < s->n_asked; k++) {
        double         depth = rows[k].depth_mm;
        fw_life_slopes slopes = fw_life_slopes_make(l, mean, variance, depth);
        fw_interval    v = by_records(w, &slopes, depth, values, s->confidence);
        if (s->years.is_table) {
            fw_interval by_years = fw_life_years_interval(&s->years, sums, mean, variance, depth, s->confidence);
            v = fw_life_both(depth, v, by_years);
            if (rows[k].percentile == s->design_percentile) *years_half = (by_years.high - by_years.low) / (2 * depth);
        }
        rows[k].low_mm = mean > 0 ? v.low : NAN;
        rows[k].high_mm = mean > 0 ? v.high : NAN;
    }
    free(sums);
    return FW_OK;
}

/* ---- rows -------------------------------------------------------------------------------------------------------- */

static void fill_rows(fw_service_run *s, bool has_law, fw_life_row *rows)
{
    const double *last = s->depths + (s->n_fan - 1) * s->n_percentiles, *scaled = s->scaled + (s->n_fan - 1) * s->n_percentiles;
    size_t        skip = s->n_percentiles - s->n_asked;
    double        low = NAN, high = NAN;
    if (has_law) {
        gsl_sort(s->factor, 1, s->law->n);
        low = fw_order_percentile(s->law->n, s->factor, 0.5 - 0.5 * s->confidence);
        high = fw_order_percentile(s->law->n, s->factor, 0.5 + 0.5 * s->confidence);
    }
    for (size_t k = 0; k < s->n_asked; k++) {
        double p = s->percentiles[skip + k];
        rows[k].percentile = s->asked[k];
        rows[k].windows = fw_service_windows(s->campaign);
        rows[k].depth_mm = last[skip + k];
        rows[k].allowance_year = s->campaign->service.allowance > 0 ? year_of_share(s->years.n_years, s->used, 1 - p) : NAN;
        rows[k].with_law_depth_mm = has_law ? scaled[skip + k] : NAN;
        rows[k].with_law_low_mm = low * last[skip + k];
        rows[k].with_law_high_mm = high * last[skip + k];
    }
}

static void fill_fan(const fw_service_run *s, bool has_law, const fw_life_row *row, fw_service_answer *out)
{
    for (size_t at = 0; at < s->n_fan; at++)
        for (size_t k = 0; k < s->n_percentiles; k++)
            out->fan[out->n_fan++] = (fw_fan_row){.point = row->point,
                                                  .bearing_deg = row->bearing_deg,
                                                  .year = fmin((double)s->fan[at], s->campaign->service.life_years),
                                                  .percentile = 100 * s->percentiles[k],
                                                  .depth_mm = s->depths[at * s->n_percentiles + k],
                                                  .with_law_depth_mm = has_law ? s->scaled[at * s->n_percentiles + k] : NAN};
}

static void fill_allowance(const fw_service_run *s, bool has_law, fw_life_point *p, fw_service_answer *out)
{
    double sum = 0, with_law = 0;
    p->allowance_mm = p->never = p->with_law_never = p->allowance_year_p5 = p->allowance_year_p50 = p->allowance_year_p95 = NAN;
    if (!(s->campaign->service.allowance > 0)) return;
    p->allowance_mm = s->campaign->service.allowance;
    for (size_t year = 0; year < s->years.n_years; year++) {
        sum += s->used[year], with_law += has_law ? s->used_scaled[year] : NAN;
        out->allowance[out->n_allowance++] = (fw_allowance_row){.point = p->point,
                                                                .bearing_deg = p->bearing_deg,
                                                                .year = (double)year + 1,
                                                                .probability = s->used[year],
                                                                .by_then = fmin(sum, 1),
                                                                .with_law_probability = has_law ? s->used_scaled[year] : NAN,
                                                                .with_law_by_then = has_law ? fmin(with_law, 1) : NAN};
    }
    p->never = fmax(0, 1 - sum), p->with_law_never = has_law ? fmax(0, 1 - with_law) : NAN;
    p->allowance_year_p5 = year_of_share(s->years.n_years, s->used, 0.05);
    p->allowance_year_p50 = year_of_share(s->years.n_years, s->used, 0.5);
    p->allowance_year_p95 = year_of_share(s->years.n_years, s->used, 0.95);
}

/* Without persistence a winter's sum has the variance of as many windows. */
static void fill_scatter(const fw_service_run *s, const fw_life_spread *l, fw_life_point *p)
{
    fw_years       alike = s->years;
    fw_life_spread plain = fw_life_spread_make(&alike, &s->scores, 0), winters;
    double         mean = l->windows * s->scores.mean, window = mean > 0 ? s->scores.variance / (mean * mean) : NAN;
    alike.cv = 0;
    if (!alike.is_table) plain = fw_life_spread_make(&alike, &s->scores, 0);
    winters = alike.is_table ? *l : fw_life_spread_make(&alike, &s->scores, s->campaign->service.persistence);
    p->mean_mm = mean;
    p->cv = mean > 0 ? fw_life_spread_sd(l, s->scores.mean, s->scores.variance) / mean : NAN;
    p->cv_windows = sqrt(plain.scatter * window);
    p->cv_persistence = sqrt(fmax(0, winters.scatter - plain.scatter) * window);
    p->cv_years = sqrt(fmax(0, p->cv * p->cv - winters.scatter * window));
}

fw_status fw_service_point(fw_service_run *s, const fw_window *w, size_t i, fw_life_row *rows, fw_service_answer *out, fw_msg *m)
{
    const fw_service *q = &s->campaign->service;
    fw_life           life = fw_life_of_moments(w->moment[1], w->moment[2], w->moment[3]);
    bool              has_law = s->law->n > 0, is_plain = !(q->persistence > 0) && !(q->year_to_year_cv > 0) && q->n_table == 0;
    fw_life_point    *point = &out->points[out->n_points++];
    *point = (fw_life_point){.point = rows[0].point, .bearing_deg = rows[0].bearing_deg, .years_half_width = NAN};
    is_plain = is_plain && fw_life_is_smooth(&life, fw_service_windows(s->campaign));
    if (is_plain && !has_law) {
        fw_scores_bare(&s->scores, life.mean, life.sd * life.sd);
    } else {
        FW_TRY(make_scores(&s->scores, w, m));
        FW_TRY(by_lives(s, i, has_law, m));
    }
    if (is_plain) by_moments(s, &life);
    fw_life_spread spread = fw_life_spread_make(&s->years, &s->scores, q->persistence);
    fill_rows(s, has_law, rows);
    FW_TRY(set_intervals(s, w, &spread, rows, &point->years_half_width, m));
    fill_fan(s, has_law, &rows[0], out);
    fill_scatter(s, &spread, point);
    fill_allowance(s, has_law, point, out);
    const fw_life_row *design = NULL;
    for (size_t k = 0; k < s->n_asked; k++)
        if (rows[k].percentile == s->design_percentile) design = &rows[k];
    FW_CHECK(design, m, FW_E_INTERNAL, "no life at the design percentile P%g", s->design_percentile);
    if (out->governing_point == 0 || design->depth_mm > out->governing_mm)
        out->governing_point = design->point, out->governing_mm = design->depth_mm;
    return fw_life_map_add(out, s->campaign, w, design, m);
}
