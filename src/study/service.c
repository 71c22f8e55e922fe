#include "study/service_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* A fan of whole lives shows the lower side too, unless percentiles below the median were asked for. */
static const double LOWER = 0.05;

double fw_service_windows(const fw_campaign *c)
{
    double windows = c->service.life_years * c->service.ice_hours_per_year * 3600 / c->model.window;
    return fmax(1, round(windows));
}

static size_t years_of(const fw_campaign *c) { return (size_t)fmax(1, ceil(c->service.life_years)); }

size_t fw_service_lives(const fw_campaign *c)
{
    fw_year  one = {1, 1};
    fw_years years = {.n_years = c->service.is_asked ? years_of(c) : 50, .is_table = true, .n = 1, .kinds = &one};
    return fw_lives_count(&years);
}

/* ---- what all points share -------------------------------------------------------------------------------------- */

static fw_status choose_percentiles(fw_service_run *s, size_t n, const double *asked, fw_msg *m)
{
    bool has_lower = false;
    for (size_t k = 0; k < n; k++) has_lower = has_lower || asked[k] < 50;
    FW_TRY(fw_alloc(&s->percentiles, n + 1, sizeof *s->percentiles, "percentiles of lives", m));
    if (!has_lower) s->percentiles[s->n_percentiles++] = LOWER;
    for (size_t k = 0; k < n; k++) s->percentiles[s->n_percentiles++] = asked[k] / 100;
    s->n_asked = n, s->asked = asked;
    return FW_OK;
}

/* Windows are whole, so that a year's number follows from the life's. */
static fw_status make_years(fw_service_run *s, fw_msg *m)
{
    const fw_service *q = &s->campaign->service;
    size_t            n_years = years_of(s->campaign), n = q->n_table ? q->n_table : n_years;
    double            windows = fw_service_windows(s->campaign), made = 0;
    FW_TRY(fw_alloc(&s->kinds, n, sizeof *s->kinds, "years of a life", m));
    for (size_t k = 0; k < n; k++) {
        if (q->n_table) {
            s->kinds[k] = (fw_year){(size_t)round(q->table[k].ice_hours * 3600 / s->campaign->model.window), q->table[k].factor};
            continue;
        }
        double until = k + 1 == n ? windows : fmin(windows, round(windows * (double)(k + 1) / q->life_years));
        s->kinds[k] = (fw_year){(size_t)(until - made), 1};
        made = until;
    }
    s->years = (fw_years){.n_years = n_years, .is_table = q->n_table > 0, .n = n, .kinds = s->kinds, .cv = q->n_table ? 0 : q->year_to_year_cv};
    size_t step = (n_years + FW_SERVICE_FAN - 1) / FW_SERVICE_FAN;
    for (size_t year = n_years % step ? n_years % step : step; year <= n_years; year += step) s->fan[s->n_fan++] = year;
    return FW_OK;
}

static void say_assumption(const fw_service *q, char *text, size_t size)
{
    int n = 0;
    if (!(q->persistence > 0) && !(q->year_to_year_cv > 0) && q->n_table == 0) {
        snprintf(text, size, "independent windows");
        return;
    }
    n = q->persistence > 0 ? snprintf(text, size, "windows of persistence %g", q->persistence) : snprintf(text, size, "independent windows");
    if (q->n_table)
        snprintf(text + n, size - (size_t)n, ", years drawn from a table of %zu", q->n_table);
    else if (q->year_to_year_cv > 0)
        snprintf(text + n, size - (size_t)n, ", years of CV %g", q->year_to_year_cv);
}

static fw_status open_run(fw_service_run *s, size_t n_points, size_t n_percentiles, const double *percentiles, fw_service_answer *out, fw_msg *m)
{
    bool has_limit = s->campaign->service.allowance > 0;
    FW_TRY(choose_percentiles(s, n_percentiles, percentiles, m));
    FW_TRY(make_years(s, m));
    FW_TRY(fw_alloc(&s->depths, 2 * s->n_fan * s->n_percentiles, sizeof *s->depths, "percentiles of lives", m));
    s->scaled = s->depths + s->n_fan * s->n_percentiles;
    FW_TRY(fw_alloc(&s->used, 2 * s->years.n_years, sizeof *s->used, "years of the allowance", m));
    s->used_scaled = s->used + s->years.n_years;
    FW_TRY(fw_alloc(&out->fan, n_points * s->n_fan * s->n_percentiles, sizeof *out->fan, "rows of the fan of lives", m));
    if (has_limit) FW_TRY(fw_alloc(&out->allowance, n_points * s->years.n_years, sizeof *out->allowance, "rows of the allowance", m));
    if (s->campaign->after.has_water_level) FW_TRY(fw_alloc(&out->map, n_points * FW_MAP_HEIGHTS, sizeof *out->map, "map of lives", m));
    return fw_alloc(&out->points, n_points, sizeof *out->points, "rows of lives", m);
}

fw_status fw_service_open(fw_service_run *s, const fw_campaign *c, size_t n_percentiles, const double *percentiles, double design_percentile,
                          double confidence, const fw_law_factor *law, size_t n_points, fw_service_answer *out, fw_msg *m)
{
    memset(s, 0, sizeof *s);
    s->campaign = c, s->law = law, s->confidence = confidence, s->design_percentile = design_percentile;
    if (!c->service.is_asked) return FW_OK;
    say_assumption(&c->service, out->assumption, sizeof out->assumption);
    fw_status status = open_run(s, n_points, n_percentiles, percentiles, out, m);
    if (status != FW_OK) fw_service_close(s);
    return status;
}

void fw_service_close(fw_service_run *s)
{
    fw_lives_free(&s->lives);
    fw_winters_free(&s->winters);
    free(s->percentiles);
    free(s->kinds);
    free(s->sums);
    free(s->work);
    free(s->depths);
    free(s->used);
    memset(s, 0, sizeof *s);
}

void fw_service_answer_free(fw_service_answer *a)
{
    free(a->fan);
    free(a->allowance);
    free(a->points);
    free(a->map);
    memset(a, 0, sizeof *a);
}

fw_status fw_service_simulate(fw_service_run *s, fw_msg *m)
{
    uint64_t seed = s->campaign->seed;
    if (s->winters.at) return FW_OK;
    FW_TRY(fw_lives_make(&s->lives, &s->years, m));
    FW_TRY(fw_winters_make(&s->winters, seed, s->campaign->service.persistence, s->lives.lengths[s->lives.n_lengths - 1], m));
    FW_TRY(fw_lives_draw(&s->lives, seed, s->winters.n_winters, m));
    FW_TRY(fw_alloc(&s->sums, s->lives.n_lengths * s->winters.n_winters, sizeof *s->sums, "depths of winters", m));
    FW_TRY(fw_alloc(&s->work, 4 * s->lives.n_lives, sizeof *s->work, "depths of lives", m));
    s->factor = s->work + 3 * s->lives.n_lives;
    return FW_OK;
}
