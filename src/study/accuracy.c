/* The accuracy study from end to end: sizes from a pilot, the groups in turn, the choice, the ledger's rows. */
#include "study/accuracy.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "realisation/accuracy.h"
#include "study/accuracy_inside.h"

/* From the smallest: a study of these sizes, or one between them never, so that two calls on one machine give the same table. Windows of
 * the step group stay short: two runs of a dense field drift apart within a hundred metres of ice however fine their steps, and then
 * it is their scatter that is measured. More windows know more. */
static const fw_accuracy_sizes SIZES[] = {
    {4, 10, 5, 2, 30, 32},     {6, 20, 10, 3, 60, 64},      {6, 40, 15, 3, 120, 96},   {10, 40, 15, 3, 150, 128},
    {12, 40, 15, 3, 250, 192}, {16, 40, 15, 4, 250, 256},   {20, 40, 20, 4, 400, 384}, {24, 50, 20, 5, 500, 512},
    {32, 50, 20, 5, 800, 768}, {40, 60, 20, 6, 1200, 1024},
};
enum { N_SIZES = sizeof SIZES / sizeof SIZES[0] };

/* ---- what the groups share -------------------------------------------------------------------------------------- */

fw_status fw_accuracy_append(fw_accuracy_run *r, const fw_accuracy_row *row, fw_msg *m)
{
    FW_TRY(fw_grow(&r->out->rows, &r->row_capacity, r->out->n_rows + 1, sizeof *r->out->rows,
                   "rows of the accuracy study", m));
    r->out->rows[r->out->n_rows++] = *row;
    return FW_OK;
}

void fw_accuracy_cost(fw_accuracy_row *row, size_t n, const fw_trial_sample *s)
{
    row->evaluations = row->cpu_s = row->truncation = 0;
    for (size_t i = 0; i < n; i++) {
        row->evaluations += s[i].evaluations / (double)n;
        row->cpu_s += s[i].cpu_s / (double)n;
        row->truncation += s[i].truncation / (double)n;
    }
}

void fw_accuracy_set_windows(fw_accuracy_run *r, double way, double warm_up_way)
{
    for (size_t i = 0; i < r->n; i++) {
        fw_trial_window *w = &r->windows[i];
        w->window = fmin(r->c->model.window, way / w->scenario.speed);
        w->warm_up = warm_up_way < 0 ? -1 : warm_up_way / w->scenario.speed;
    }
}

/* ---- which windows, how many ------------------------------------------------------------------------------------ */

static int compare_speeds(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* The n faster of the first 2 n ids, in order of id. */
static fw_status choose_windows(fw_accuracy_run *r, size_t n, fw_msg *m)
{
    double *speeds;
    FW_TRY(fw_alloc(&speeds, 2 * n, sizeof *speeds, "speeds of scenarios", m));
    fw_scenario sc;
    for (size_t id = 0; id < 2 * n; id++) {
        r->o->scenario(r->c, id, &sc);
        speeds[id] = sc.speed;
    }
    qsort(speeds, 2 * n, sizeof *speeds, compare_speeds);
    double least = speeds[n - 1];
    free(speeds);
    r->out->mean_speed = 0;
    r->n = 0;
    for (size_t id = 0; id < 2 * n && r->n < n; id++) {
        r->o->scenario(r->c, id, &sc);
        if (sc.speed < least) continue;
        r->windows[r->n++] = (fw_trial_window){.scenario = sc};
        r->out->mean_speed += sc.speed / (double)n;
    }
    return FW_OK;
}

/* CPU seconds that a study of these sizes takes, from a pilot's seconds per metre of ice at 1 %, and from counting floes and steps
 * for the fixed-step schemes (13 ns a floe and step at 10 to 60 %, RESULTS.md). The factors add up the groups' levels relative to
 * the pilot's cost; they are generous, because a busy machine is slower. */
static double forecast(const fw_accuracy_run *r, const fw_accuracy_sizes *s, double cpu_per_metre, double diameter)
{
    double auto_way = fw_accuracy_warm_up(&r->model, r->out->mean_speed) * r->out->mean_speed, n = (double)s->n_windows;
    double events = 60 * n * (s->way + s->warm_up_way), domain = 34 * n * (s->domain_way + auto_way);
    double percentile = (double)s->n_percentile * (s->domain_way + auto_way);
    double floes = 0, seconds = 0, evaluations = s->n_steps <= 3 ? 7 : 14; /* a step of each scheme and rule */
    for (size_t i = 0; i < r->n; i++) {
        const fw_scenario *sc = &r->windows[i].scenario;
        floes += sc->concentration * 85 * fw_accuracy_strip_width(&r->model) / (0.785 * 1.15 * diameter * diameter) /
                 (double)r->n;
        seconds += (s->way + s->warm_up_way) / sc->speed / (double)r->n;
    }
    double steps = n * seconds / 4e-3 * (pow(2, (double)s->n_steps) - 1);
    if (fw_model_beyond_fixed_steps(&r->model)) evaluations = 0;
    return cpu_per_metre * (events + domain + percentile) + steps * floes * evaluations * 13e-9;
}

/* A pilot of the smallest study's windows; the largest sizes whose forecast fits the budget. */
static fw_status choose_sizes(fw_accuracy_run *r, fw_msg *m)
{
    double cpu = 0, way = 0, diameter = 0;
    FW_TRY(choose_windows(r, SIZES[0].n_windows, m));
    FW_ACCURACY_SAY(r, "pilot");
    for (size_t i = 0; i < r->n; i++) {
        fw_model  model = r->model;
        fw_record record;
        model.accuracy = 0.01;
        model.window = SIZES[2].domain_way / r->windows[i].scenario.speed;
        FW_TRY(fw_realise(&model, &r->windows[i].scenario, r->o->tick, &record, m));
        cpu += record.host_cpu_s;
        way += (record.window + record.warm_up) * record.speed;
        diameter += record.mean_diameter / (double)r->n;
        fw_record_free(&record);
    }
    size_t k = N_SIZES - 1;
    while (k > 0 && forecast(r, &SIZES[k], cpu / way, diameter) > r->o->cpu_budget_s) k--;
    r->out->sizes = SIZES[k];
    return choose_windows(r, SIZES[k].n_windows, m);
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static fw_status allocate(fw_accuracy_run *r, fw_msg *m)
{
    size_t n = SIZES[N_SIZES - 1].n_windows, n_points = r->c->points.n;
    FW_TRY(fw_alloc(&r->windows, n, sizeof *r->windows, "windows of the accuracy study", m));
    FW_TRY(fw_alloc(&r->sample, 3 * n, sizeof *r->sample, "samples of the accuracy study", m));
    r->reference = r->sample + n, r->usual = r->reference + n;
    FW_TRY(fw_alloc(&r->points, 3 * n * n_points, sizeof *r->points, "points of the accuracy study", m));
    r->points_reference = r->points + n * n_points, r->points_usual = r->points_reference + n * n_points;
    return fw_alloc(&r->is_coupled, n, sizeof *r->is_coupled, "windows of the accuracy study", m);
}

static fw_status study(fw_accuracy_run *r, fw_msg *m)
{
    FW_TRY(allocate(r, m));
    FW_TRY(choose_sizes(r, m));
    fw_accuracy_set_windows(r, r->out->sizes.way, r->out->sizes.warm_up_way);
    FW_TRY(fw_accuracy_step_group(r, m));
    fw_accuracy_choose_step(r);
    r->model.numerics = r->out->choice.numerics;
    FW_TRY(fw_accuracy_domain_groups(r, m));
    FW_TRY(fw_accuracy_percentile_group(r, m));
    fw_accuracy_choose_domain(r);
    FW_TRY(fw_accuracy_split_budget(r, m));
    fw_accuracy_measure(r);
    return FW_OK;
}

fw_status fw_accuracy_study(fw_accuracy *out, const fw_campaign *c, const fw_accuracy_options *o, fw_msg *m)
{
    double          start = fw_cpu_seconds();
    fw_accuracy_run r = {.c = c, .o = o, .out = out, .model = c->model};
    memset(out, 0, sizeof *out);
    FW_CHECK(c->points.n > 0, m, FW_E_ARG, "the campaign has no measuring points");
    r.model.numerics = (fw_numerics){
        .scheme = FW_SCHEME_EVENTS}; /* what the file may say of them is what is being judged */
    fw_status s = study(&r, m);
    out->cpu_s = fw_cpu_seconds() - start;
    free(r.windows);
    free(r.sample);
    free(r.points);
    free(r.is_coupled);
    if (s != FW_OK) fw_accuracy_free(out);
    return s;
}

void fw_accuracy_free(fw_accuracy *a)
{
    if (!a) return;
    free(a->rows);
    free(a->percentile);
    free(a->budget);
    memset(a, 0, sizeof *a);
}
