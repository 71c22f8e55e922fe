/* The effects ledger from end to end: how many windows, all ways of each, then what they say. */
#include "study/effects_ledger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "realisation/accuracy.h"
#include "study/effects_inside.h"
#include "study/trial.h"

/* From the smallest. Total ice is what a budget buys and what intervals shrink with; it goes into number and length alike, so that the warm-up (120 m at
 * 1 %) is never most of it, and windows become what a design asks for as the budget grows. */
static const struct size {
    size_t n;
    double way; /* mean [m] */
} SIZES[] = {{32, 60},   {48, 120},  {64, 240},   {96, 360},   {128, 480},  {160, 600},   {192, 720},
           {256, 960}, {320, 1200}, {384, 1440}, {512, 1920}, {768, 2880}, {1024, 3840}, {2048, 7680}};
enum { N_SIZES = sizeof SIZES / sizeof SIZES[0], N_PILOT = 32, N_SPEEDS = 256 };

/* A point is read with this width [deg]. */
static const double WIDTH = 5;

/* Force evaluations that a core of 2020 does in a second in short windows (100 of 600 s of the Raahe campaign: 8.0e6; thin ice a third of it), and what an arm costs over
 * the campaign's own set: without drag floes stay, twice the work. Both only aim. */
static const double EVALUATIONS_PER_S = 8e6, COST_OF_ARM = 1.2;

typedef struct run {
    const fw_campaign        *c;
    const fw_effects_options *o;
    fw_effects_ledger        *out;
    fw_effects_plan           plan;
    double                    speed; /* mean of the campaign's first N_SPEEDS ids [m/s] */
    double                   *ring; /* (n_arcs), owned */
    size_t                    n_ways, *ways; /* arms that are run, the campaign's own at both ends; owned */
    double                    squares;       /* of the differences of processor time between the two runs of the campaign's own set */
} run;

#define SAY(r, ...) fw_trial_say((r)->o->say, (r)->o->say_self, __VA_ARGS__)

static void take_speed(run *r)
{
    for (uint64_t id = 0; id < N_SPEEDS; id++) {
        fw_scenario sc;
        r->o->scenario(r->c, id, &sc);
        r->speed += fmax(sc.speed, FW_SLOWEST) / N_SPEEDS;
    }
}

static double seconds_of(const run *r, double way) { return fmin(r->c->model.window, way / r->speed); }

/* Window i, so short, under one arm's model. Its scenario is that campaign's too: an effect brings numbers of its own (the wind's speed) from
 * streams of their own, and what was there before stays as it is. */
static fw_status run_window(const run *r, const fw_campaign *c, size_t i, double seconds, fw_record *out, fw_msg *m)
{
    fw_scenario sc;
    fw_model    own = c->model;
    r->o->scenario(c, i, &sc);
    own.window = seconds;
    return fw_realise(&own, &sc, r->o->tick, out, m);
}

/* ---- how many ---------------------------------------------------------------------------------------------------- */

static fw_status choose_size(run *r, fw_msg *m)
{
    double evaluations = 0, way = 0;
    bool   is_whole = (r->c->model.effects & FW_EFFECT_TIDE) != 0; /* part of a tide is not the tide */
    size_t n_pilot = is_whole ? N_PILOT / 4 : N_PILOT;
    r->out->n_windows = r->o->n_windows, r->out->way = r->o->way;
    if (r->o->n_windows > 0) return FW_OK;
    SAY(r, "pilot");
    for (size_t i = 0; i < n_pilot; i++) {
        fw_record record;
        FW_TRY(run_window(r, r->c, i, seconds_of(r, is_whole ? INFINITY : SIZES[0].way), &record, m));
        evaluations += record.force_evaluations;
        way += (record.window + record.warm_up) * fmax(record.speed, FW_SLOWEST);
        fw_record_free(&record);
    }
    double one = way / (double)n_pilot, before = fmax(0, one - SIZES[0].way); /* with its warm-up; that [m] */
    double most = r->o->cpu_budget_s * EVALUATIONS_PER_S / (COST_OF_ARM * (double)r->n_ways);
    size_t k = N_SIZES - 1;
    while (k > 0 && (double)SIZES[k].n * (is_whole ? one : SIZES[k].way + before) * evaluations / way > most) k--;
    r->out->n_windows = SIZES[k].n, r->out->way = is_whole ? INFINITY : SIZES[k].way;
    return FW_OK;
}

/* ---- all ways of all windows ------------------------------------------------------------------------------------- */

static fw_status keep(fw_effects_arm *arm, size_t i, const fw_record *record, fw_msg *m)
{
    arm->row[i] = FW_EFFECTS_FAILED;
    if (record->status != FW_OK) {
        arm->n_failed++;
        return FW_OK;
    }
    arm->row[i] = arm->depth.n;
    return fw_depth_add(&arm->depth, record, m);
}

/* The load of the first law as a point reads it, a moving mean over WIDTH, and of the short window as of the campaign's. The other rings are not asked. */
static void prepare(const run *r, fw_record *record)
{
    if (record->status != FW_OK) return;
    size_t  n = record->n_arcs, half = (size_t)(0.5 * WIDTH * (double)n / 360);
    double *load = record->rings + n; /* behind the path (record.h) */
    double  times = r->c->model.window / record->window / (double)(2 * half + 1);
    memcpy(r->ring, load, n * sizeof *load);
    for (size_t k = 0; k < n; k++) {
        load[k] = 0;
        for (size_t j = 0; j <= 2 * half; j++) load[k] += times * r->ring[(k + n + j - half) % n];
    }
}

/* The campaign's own set is run first and last (or last and first): only the processor's time may differ. */
static fw_status keep_own(run *r, size_t i, bool is_again, double *cpu_s, fw_record *record, fw_msg *m)
{
    fw_effects_ledger *l = r->out;
    fw_effects_arm    *own = &r->plan.arms[0];
    if (is_again) {
        l->cpu_s += record->host_cpu_s;
        r->squares += (record->host_cpu_s - *cpu_s) * (record->host_cpu_s - *cpu_s);
        return FW_OK;
    }
    l->cpu_s_first += record->host_cpu_s, own->cpu_s += record->host_cpu_s;
    own->evaluations += record->force_evaluations;
    *cpu_s = record->host_cpu_s;
    for (size_t k = 0; k < r->plan.n_arms; k++)
        if (k == 0 || r->plan.arms[k].is_read) FW_TRY(keep(&r->plan.arms[k], i, record, m));
    return FW_OK;
}

/* Every other window goes through the ways backwards, so that a machine that slows down or heats up does so for all alike. */
static fw_status run_ways(run *r, size_t i, fw_msg *m)
{
    double cpu_s = 0, first = 0;
    for (size_t step = 0; step < r->n_ways; step++) {
        size_t          way = i % 2 ? r->n_ways - 1 - step : step;
        fw_effects_arm *arm = &r->plan.arms[r->ways[way]];
        fw_record       record;
        FW_TRY(run_window(r, &arm->campaign, i, r->out->seconds, &record, m));
        prepare(r, &record);
        fw_status s = FW_OK;
        if (r->ways[way] == 0) {
            double load = 0;
            for (size_t k = 0; k < record.n_arcs; k++) load += fw_record_load(&record, 0, FW_RING_LOAD)[k];
            s = keep_own(r, i, step > 0, &cpu_s, &record, m);
            if (step == 0) first = load;
            if (s == FW_OK && step > 0 && memcmp(&load, &first, sizeof load) != 0)
                s = fw_fail(m, FW_E_INTERNAL, "window %zu gave two results: %.17g and %.17g", i, first, load);
        } else {
            arm->evaluations += record.force_evaluations, arm->cpu_s += record.host_cpu_s;
            s = keep(arm, i, &record, m);
        }
        fw_record_free(&record);
        FW_TRY(s);
    }
    return FW_OK;
}

static fw_status run_all(run *r, fw_msg *m)
{
    const fw_campaign *c = r->c;
    for (size_t k = 0; k < r->plan.n_arms; k++) {
        fw_effects_arm *arm = &r->plan.arms[k];
        FW_TRY(fw_depth_make(&arm->depth, &arm->campaign, 0, c->points.n, c->points.bearing, m));
        FW_TRY(fw_alloc(&arm->row, r->out->n_windows, sizeof *arm->row, "windows of the effects ledger", m));
    }
    for (size_t i = 0; i < r->out->n_windows; i++) {
        if (i % 8 == 0) SAY(r, "window %zu of %zu, %zu ways each", i + 1, r->out->n_windows, r->n_ways);
        FW_TRY(run_ways(r, i, m));
    }
    return FW_OK;
}

/* ---- costs ------------------------------------------------------------------------------------------------------- */

static void share_costs(run *r)
{
    fw_effects_ledger     *l = r->out;
    const fw_effects_plan *p = &r->plan;
    l->evaluations = p->arms[0].evaluations;
    for (size_t k = 0; k + 1 < p->n_chain; k++) {
        const fw_effects_arm *with = &p->arms[p->chain[k]], *without = &p->arms[p->chain[k + 1]];
        fw_effects_row       *row = &l->rows[p->what_is_off[k]];
        row->evaluations_share = (with->evaluations - without->evaluations) / l->evaluations;
        row->cpu_share = (with->cpu_s - without->cpu_s) / l->cpu_s;
    }
    const fw_effects_arm *bare = &p->arms[p->chain[p->n_chain - 1]];
    l->evaluations_bare = bare->evaluations / l->evaluations;
    l->cpu_bare = bare->cpu_s / l->cpu_s;
    l->cpu_noise = sqrt(r->squares) / l->cpu_s;
}

/* ---- the whole --------------------------------------------------------------------------------------------------- */

static fw_status make(run *r, fw_msg *m)
{
    fw_effects_ledger *l = r->out;
    const fw_campaign *c = r->c;
    FW_TRY(fw_effects_plan_make(&r->plan, l, c, r->o->n_switches, r->o->switches, m));
    FW_TRY(fw_alloc(&r->ways, r->plan.n_arms + 1, sizeof *r->ways, "ways of the effects ledger", m));
    for (size_t k = 0; k < r->plan.n_arms; k++)
        if (!r->plan.arms[k].is_read) r->ways[r->n_ways++] = k;
    r->ways[r->n_ways++] = 0;
    FW_TRY(fw_alloc(&r->ring, c->model.n_arcs, sizeof *r->ring, "a ring of arcs", m));
    take_speed(r);
    FW_TRY(choose_size(r, m));
    l->seconds = seconds_of(r, l->way);
    FW_TRY(run_all(r, m));
    share_costs(r);
    FW_TRY(fw_effects_compare(l, &r->plan, c, m));
    if (l->seconds < c->model.window)
        snprintf(l->origin, sizeof l->origin, "on this campaign, %zu windows of %.3g m of ice in the mean", l->n_windows, l->way);
    else
        snprintf(l->origin, sizeof l->origin, "on this campaign, %zu of its windows", l->n_windows);
    return FW_OK;
}

fw_status fw_effects_ledger_make(fw_effects_ledger *out, const fw_campaign *c, const fw_effects_options *o, fw_msg *m)
{
    double start = fw_cpu_seconds();
    run    r = {.c = c, .o = o, .out = out};
    memset(out, 0, sizeof *out);
    FW_CHECK(c->points.n > 0, m, FW_E_ARG, "the campaign has no measuring points");
    bool is_percentile = c->precision.quantity == FW_QUANTITY_PERCENTILE && c->precision.percentile > 0;
    out->percentile = is_percentile ? c->precision.percentile : 90;
    out->confidence = c->precision.confidence > 0 ? c->precision.confidence : 0.95;
    fw_status s = make(&r, m);
    fw_effects_plan_free(&r.plan);
    free(r.ways);
    free(r.ring);
    out->cpu_s_study = fw_cpu_seconds() - start;
    if (s != FW_OK) memset(out, 0, sizeof *out);
    return s;
}

/* ---- what may be left out ---------------------------------------------------------------------------------------- */

static double bound(const fw_change *c) { return fabs(c->change) + 0.5 * (c->high - c->low); } /* NAN without an interval */

static int compare_saved(const void *a, const void *b)
{
    const fw_effects_row *x = *(const fw_effects_row *const *)a, *y = *(const fw_effects_row *const *)b;
    if (x->cpu_saved != y->cpu_saved) return x->cpu_saved < y->cpu_saved ? 1 : -1;
    return strcmp(x->name, y->name);
}

size_t fw_effects_ledger_drops(const fw_effects_ledger *l, double tolerance, const fw_effects_row **rows)
{
    size_t n = 0, kept = 0;
    double mean = 0, percentile = 0;
    if (!(tolerance > 0)) return 0;
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *row = &l->rows[i];
        if (row->is_effect && row->was_on && row->cpu_saved > 0.01 + 2 * l->cpu_noise) rows[n++] = row;
    }
    qsort(rows, n, sizeof *rows, compare_saved);
    for (size_t i = 0; i < n; i++) {
        double a = mean + bound(&rows[i]->mean), b = percentile + bound(&rows[i]->percentile);
        if (!(a < tolerance && b < tolerance)) continue; /* NAN is no */
        mean = a, percentile = b;
        rows[kept++] = rows[i];
    }
    return kept;
}
