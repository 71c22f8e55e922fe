/* Error of a percentile against the number of realisations, and how a CPU budget is best split between finer steps and more
 * windows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"
#include "study/accuracy_inside.h"
#include "study/depth.h"

enum { N_SUBSETS = 64, FINE_RING = 1440 };

/* Percentile p of one point from chosen records (picks NULL: all). */
static fw_status percentile_of(const fw_campaign *c, const double *bearing, size_t n, const fw_record *records,
                               const size_t *picks, double p, double *value, fw_msg *m)
{
    fw_depth  d;
    fw_window w;
    FW_TRY(fw_depth_make(&d, c, 0, 1, bearing, m));
    fw_status s = FW_OK;
    for (size_t i = 0; i < n && s == FW_OK; i++) s = fw_depth_add(&d, &records[picks ? picks[i] : i], m);
    *value = 0; /* nothing but failures in a sub-set */
    if (s == FW_OK && d.n > 0) {
        s = fw_depth_settle(&d, NULL, NULL, m);
        if (s == FW_OK) s = fw_window_make(&w, &d, 0, m);
        if (s == FW_OK) {
            *value = fw_window_percentile(&w, p);
            fw_window_free(&w);
        }
    }
    fw_depth_free(&d);
    return s;
}

/* The point that governs is the one with the largest percentile of all records. */
static fw_status governing_value(const fw_campaign *c, size_t n, const fw_record *records, double p, size_t *point,
                                 double *value, fw_msg *m)
{
    *value = -1;
    for (size_t k = 0; k < c->points.n; k++) {
        double v;
        FW_TRY(percentile_of(c, &c->points.bearing[k], n, records, NULL, p, &v, m));
        if (v > *value) *value = v, *point = k;
    }
    return FW_OK;
}

static fw_status subset_error(const fw_campaign *c, size_t n_records, const fw_record *records, double p, size_t n,
                              const double *bearing, double truth, size_t *picks, double *error, fw_msg *m)
{
    double squares = 0;
    for (uint64_t k = 0; k < N_SUBSETS; k++) {
        fw_random g;
        double    v;
        fw_random_stream(&g, c->seed, FW_STREAM_SUBSETS, n, k);
        for (size_t i = 0; i < n_records; i++) picks[i] = i;
        for (size_t i = 0; i < n; i++) { /* the first n of a shuffle */
            size_t j = i + (size_t)(fw_random_uniform(&g) * (double)(n_records - i));
            size_t swap = picks[i];
            picks[i] = picks[j], picks[j] = swap;
        }
        FW_TRY(percentile_of(c, bearing, n, records, picks, p, &v, m));
        squares += (v - truth) * (v - truth);
    }
    /* A sub-set shares its windows with the whole: its scatter about it is smaller by sqrt(1 - n/N). */
    double part = 1 - (double)n / (double)n_records;
    *error = sqrt(squares / N_SUBSETS / part) / truth;
    return FW_OK;
}

fw_status fw_accuracy_percentile_error(const fw_campaign *c, size_t n_records, const fw_record *records, double p,
                                       size_t n, double *error, double *value, fw_msg *m)
{
    size_t point = 0, *picks;
    FW_CHECK(n >= 1 && n <= n_records / 2, m, FW_E_ARG, "sub-sets of %zu out of %zu records: wanted 1 to half of them",
             n, n_records);
    FW_TRY(governing_value(c, n_records, records, p, &point, value, m));
    *error = NAN;
    if (!(*value > 0)) return FW_OK; /* a percentile of nothing has no relative error */
    FW_TRY(fw_alloc(&picks, n_records, sizeof *picks, "sub-sets of records", m));
    fw_status s = subset_error(c, n_records, records, p, n, &c->points.bearing[point], *value, picks, error, m);
    free(picks);
    return s;
}

/* Short windows of the first ids, all scenarios: speed and concentration rule the scatter between windows, not their length. */
static fw_status run_windows(fw_accuracy_run *r, size_t n, fw_record *records, double *cpu_s_window, fw_msg *m)
{
    double   cpu = 0, simulated = 0, wanted = 0;
    fw_model model = r->model;
    if (FINE_RING % model.n_arcs == 0) model.n_arcs = FINE_RING;
    model.window = fmin(r->c->model.window, r->out->sizes.domain_way / r->out->mean_speed);
    r->out->percentile_window_s = model.window;
    for (size_t id = 0; id < n; id++) {
        fw_scenario sc;
        r->o->scenario(r->c, id, &sc);
        if (id % 16 == 0) FW_ACCURACY_SAY(r, "percentile: window %zu of %zu", id + 1, n);
        FW_TRY(fw_realise(&model, &sc, r->o->tick, &records[id], m));
        cpu += records[id].host_cpu_s;
        simulated += model.window + records[id].warm_up;
        wanted += r->c->model.window + records[id].warm_up;
    }
    *cpu_s_window = cpu * wanted / simulated / (double)n;
    return FW_OK;
}

static double design_percentile(const fw_campaign *c)
{
    return c->precision.quantity == FW_QUANTITY_PERCENTILE && c->precision.percentile > 0
               ? c->precision.percentile / 100
               : 0.9;
}

static fw_status add_percentile_rows(fw_accuracy_run *r, size_t n_records, const fw_record *records, fw_msg *m)
{
    fw_accuracy *out = r->out;
    double       p = design_percentile(r->c), sum = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    size_t       most = 0, n_fit = 0;
    for (size_t n = 4; n <= n_records / 2; n *= 2) most++;
    FW_TRY(fw_alloc(&out->percentile, most + 1, sizeof *out->percentile, "errors of the percentile", m));
    for (size_t n = 4; n <= n_records / 2; n *= 2) {
        fw_accuracy_percentile_row *row = &out->percentile[out->n_percentile++];
        row->n = n;
        FW_ACCURACY_SAY(r, "percentile: sub-sets of %zu", n);
        FW_TRY(fw_accuracy_percentile_error(r->c, n_records, records, p, n, &row->error, &out->percentile_value, m));
        /* well below 1 / (1 - p) windows a percentile is hardly more than the largest window */
        if (!(row->error > 0) || (double)n * (1 - p) < 0.7) continue;
        double x = log((double)n), y = log(row->error);
        n_fit++, sum += row->error * sqrt((double)n), sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
    }
    double k = (double)n_fit;
    out->error_one = n_fit ? sum / k : NAN;
    out->percentile_slope = n_fit > 1 ? (k * sum_xy - sum_x * sum_y) / (k * sum_xx - sum_x * sum_x) : NAN;
    for (size_t i = 0; i < out->n_percentile; i++)
        out->percentile[i].fit = out->error_one / sqrt((double)out->percentile[i].n);
    return FW_OK;
}

fw_status fw_accuracy_percentile_group(fw_accuracy_run *r, fw_msg *m)
{
    size_t     n = r->out->sizes.n_percentile;
    fw_record *records;
    FW_TRY(fw_alloc(&records, n, sizeof *records, "records of the accuracy study", m));
    fw_status s = run_windows(r, n, records, &r->out->cpu_s_window, m);
    if (s == FW_OK) s = fw_accuracy_ring_rows(r, n, records, m);
    for (size_t i = 0; i < n && s == FW_OK; i++)
        if (records[i].rings) s = fw_accuracy_coarsen(&records[i], r->model.n_arcs, m);
    if (s == FW_OK) s = add_percentile_rows(r, n, records, m);
    for (size_t i = 0; i < n; i++) fw_record_free(&records[i]);
    free(records);
    return s;
}

static double step_error(const fw_accuracy_row *row)
{
    return row->coupled.n > 1 ? fabs(row->coupled.mean) + row->coupled.error : row->hit_error;
}

/* Three budgets: a tenth of the campaign's own cost, its cost, and a thousand times that, where steps begin to count. */
fw_status fw_accuracy_split_budget(fw_accuracy_run *r, fw_msg *m)
{
    fw_accuracy           *out = r->out;
    const fw_accuracy_row *chosen = NULL;
    size_t                 n_levels = 0;
    for (size_t i = 0; i < out->n_rows; i++)
        if (out->rows[i].is_chosen && out->rows[i].group == FW_ACCURACY_STEP) chosen = &out->rows[i];
    if (!chosen || !(out->error_one > 0)) return FW_OK;
    for (size_t i = 0; i < out->n_rows; i++)
        n_levels += out->rows[i].group == FW_ACCURACY_STEP && strcmp(out->rows[i].method, chosen->method) == 0;
    FW_TRY(fw_alloc(&out->budget, 3 * n_levels, sizeof *out->budget, "rows of the budget", m));
    double              whole = out->cpu_s_window * (double)r->c->precision.max_realisations;
    static const double SHARES[] = {0.1, 1, 1000};
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < out->n_rows; i++) {
            const fw_accuracy_row *row = &out->rows[i];
            if (row->group != FW_ACCURACY_STEP || strcmp(row->method, chosen->method) != 0) continue;
            fw_accuracy_budget_row *to = &out->budget[out->n_budget++];
            to->budget_cpu_s = whole * SHARES[k];
            to->tolerance = row->level;
            to->step_error = step_error(row);
            to->cpu_s_window = out->cpu_s_window * row->evaluations / chosen->evaluations;
            to->n = to->budget_cpu_s / to->cpu_s_window;
            to->sampling_error = out->error_one / sqrt(to->n);
            to->total_error = hypot(to->step_error, to->sampling_error);
            to->is_chosen = row->is_chosen;
        }
    return FW_OK;
}
