/* The pilot of levels: which ways, and the windows in all of them. */
#include "study/levels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "realisation/accuracy.h"
#include "study/levels_inside.h"
#include "study/trial.h"

/* At first what control variates can be fitted to (half as many are too few for any); then as many as the budget has room for. */
static const size_t SIZES[] = {128, 192, 256, 384, 512, 768, 1024};
enum { N_SIZES = sizeof SIZES / sizeof SIZES[0], MOST_WINDOWS = 1024, N_WAYS = 1 + FW_LEVELS_ROWS };

/* Force evaluations that a core of 2020 does in a second, with the spring and with crushing ice. They only aim. */
static const double EVALUATIONS_PER_S = 8e6, CRUSHING_PER_S = 3.5e6;

static const double COARSE = 0.1, PARTS = 3;

typedef struct run {
    const fw_campaign       *c;
    const fw_levels_options *o;
    fw_levels               *out;
    size_t                   n_ways;
    fw_levels_way            way[N_WAYS]; /* the campaign's own first */
    fw_sanity                sanity;
} run;

/* ---- the ways ---------------------------------------------------------------------------------------------------- */

static fw_levels_way *add(run *r, const char *name, const char *what, const char *note)
{
    fw_levels_row *row = &r->out->rows[r->out->n_rows++];
    snprintf(row->name, sizeof row->name, "%s", name);
    snprintf(row->what, sizeof row->what, "%s", what);
    if (note) {
        snprintf(row->note, sizeof row->note, "%s", note);
        return NULL;
    }
    fw_levels_way *way = &r->way[r->n_ways++];
    way->row = row;
    way->model = r->c->model;
    return way;
}

static void add_effects(run *r, const char *name, const char *what, uint32_t off, const char *is_off)
{
    fw_levels_way *way = add(r, name, what, is_off);
    fw_msg         why = {""};
    if (!way) return;
    way->model.effects &= ~off;
    if (fw_model_check(&way->model, &why) == FW_OK) return;
    snprintf(way->row->note, sizeof way->row->note, "not possible here: %.130s", why.text);
    r->n_ways--;
}

static void add_ways(run *r)
{
    const fw_model *own = &r->c->model;
    uint32_t        has = own->effects;
    r->way[r->n_ways++].model = *own;
    const char    *no_steps = own->numerics.scheme != FW_SCHEME_EVENTS ? "steps are fixed" : own->accuracy >= COARSE ? "the campaign's own are as coarse" : NULL;
    fw_levels_way *coarse = add(r, "coarse steps", "accuracy 10 %", no_steps);
    if (coarse) coarse->model.accuracy = COARSE, coarse->model.numerics = (fw_numerics){.scheme = FW_SCHEME_EVENTS};
    fw_levels_way *part = add(r, "third of window", "the first third of it, wear times three", has & FW_EFFECT_TIDE ? "part of a tide is not the tide" : NULL);
    if (part) part->model.window /= PARTS;
    add_effects(r, "no floe contact", "floes pass through one another", FW_EFFECT_FLOE_CONTACT | FW_EFFECT_ICE_ON_ICE,
                has & FW_EFFECT_FLOE_CONTACT ? NULL : "the campaign has none");
    if (has & FW_EFFECT_CRUSH_CONTACT) add_effects(r, "spring", "instead of ice that crushes", FW_EFFECT_CRUSH_CONTACT, NULL);
    fw_levels_way *strip = add(r, "swept strip", "no floes at all; part of the control variates already", r->sanity.why[0] ? r->sanity.why : NULL);
    if (strip) strip->is_strip = true;
}

/* ---- windows ----------------------------------------------------------------------------------------------------- */

/* The way's warm-up is the campaign's, so that its window begins with the same ice. */
static fw_status run_way(const run *r, const fw_levels_way *way, const fw_scenario *sc, fw_record *out, fw_msg *m)
{
    fw_model model = way->model;
    model.warm_up = fw_accuracy_warm_up(&r->c->model, sc->speed);
    FW_TRY(fw_realise(&model, sc, r->o->tick, out, m));
    double times = r->c->model.window / model.window;
    for (size_t k = 0; k < fw_record_n_rings(out->n_arcs, out->n_laws) && out->rings && times != 1; k++) out->rings[k] *= times;
    return FW_OK;
}

static fw_status keep(run *r, const fw_record *records, fw_msg *m)
{
    for (size_t k = 0; k < r->n_ways; k++) {
        fw_levels_way *way = &r->way[k];
        if (way->is_strip) continue;
        way->cpu_s[way->depth.n] = records[k].host_cpu_s;
        way->evaluations += records[k].force_evaluations;
        FW_TRY(fw_depth_add(&way->depth, &records[k], m));
    }
    fw_sanity_add(&r->sanity, &records[0], records[0].weight);
    return FW_OK;
}

/* One window in all ways, every other one backwards, so that a machine that slows down does so for all alike. */
static fw_status run_window(run *r, uint64_t id, double *evaluations, fw_msg *m)
{
    fw_record   records[N_WAYS] = {0};
    fw_scenario sc;
    fw_status   s = FW_OK;
    bool        is_ok = true;
    r->o->scenario(r->c, id, &sc);
    for (size_t i = 0; i < r->n_ways && s == FW_OK; i++) {
        size_t k = id % 2 ? r->n_ways - 1 - i : i;
        if (r->way[k].is_strip) continue;
        s = run_way(r, &r->way[k], &sc, &records[k], m);
        is_ok = is_ok && s == FW_OK && records[k].status == FW_OK;
        *evaluations += records[k].force_evaluations;
    }
    if (s == FW_OK && is_ok) s = keep(r, records, m);
    r->out->n_failed += !is_ok;
    for (size_t k = 0; k < r->n_ways; k++) fw_record_free(&records[k]);
    return s;
}

static fw_status run_windows(run *r, fw_msg *m)
{
    bool     is_crush = (r->c->model.effects & FW_EFFECT_CRUSH_CONTACT) != 0;
    double   evaluations = 0, most = r->o->cpu_budget_s * (is_crush ? CRUSHING_PER_S : EVALUATIONS_PER_S);
    uint64_t n = 0;
    for (size_t k = 0; k < N_SIZES && (n == 0 || evaluations * (double)SIZES[k] / (double)n <= most); k++)
        for (; n < SIZES[k]; n++) {
            if (n % 8 == 0) fw_trial_say(r->o->say, r->o->say_self, "window %llu of %zu or more", (unsigned long long)n + 1, SIZES[k]);
            FW_TRY(run_window(r, n, &evaluations, m));
        }
    return FW_OK;
}

/* ---- the strip --------------------------------------------------------------------------------------------------- */

/* Windows by the strip: its load of the scenario on the mean shape of the campaign's own rings at the arcs in use. */
static fw_status make_strip(run *r, fw_levels_way *way, fw_msg *m)
{
    const fw_depth *own = &r->way[0].depth;
    size_t          n_arcs = r->c->model.n_arcs;
    double          sum = 0;
    fw_record       record;
    for (size_t i = 0; i < own->n; i++) sum += own->row[i].ring_load;
    FW_TRY(fw_record_init(&record, n_arcs, r->c->model.n_laws, m));
    fw_status s = FW_OK;
    for (size_t i = 0; i < own->n && s == FW_OK; i++) {
        const fw_scenario *sc = &own->row[i].scenario;
        double            *load = record.rings + n_arcs, strip = exp(fw_sanity_ln_strip(&r->sanity, sc));
        record.id = sc->id, record.cell = sc->cell, record.weight = sc->weight, record.randomisation = -1;
        for (size_t k = 0; k < n_arcs; k++) {
            load[k] = 0;
            for (size_t law = 0; law < own->directions.n_laws; law++) load[k] += own->ring[FW_DEPTH_RING_LOAD][law * n_arcs + k];
            load[k] *= sum > 0 ? strip / ((double)n_arcs * sum) : 0;
        }
        s = fw_depth_add(&way->depth, &record, m);
    }
    fw_record_free(&record);
    return s;
}

/* ---- the whole --------------------------------------------------------------------------------------------------- */

/* The point with the largest percentile, or mean. */
static fw_status find_governing(run *r, fw_msg *m)
{
    fw_levels *l = r->out;
    for (size_t k = 0; k < r->c->points.n; k++) {
        fw_window w;
        FW_TRY(fw_window_make(&w, &r->way[0].depth, k, m));
        double x = isnan(l->percentile) ? w.moment[1] : fw_window_percentile(&w, l->percentile / 100);
        if (l->point == 0 || x > l->depth_mm) l->point = k + 1, l->depth_mm = x;
        fw_window_free(&w);
    }
    return FW_OK;
}

static fw_status measure(run *r, fw_msg *m)
{
    const fw_campaign *c = r->c;
    FW_TRY(fw_sanity_begin(&r->sanity, c, 0, m));
    add_ways(r);
    for (size_t k = 0; k < r->n_ways; k++) {
        FW_TRY(fw_depth_make(&r->way[k].depth, c, 0, c->points.n, c->points.bearing, m));
        FW_TRY(fw_alloc(&r->way[k].cpu_s, MOST_WINDOWS, sizeof *r->way[k].cpu_s, "costs of windows", m));
    }
    FW_TRY(run_windows(r, m));
    fw_depth *own = &r->way[0].depth;
    FW_CHECK(own->n > 0, m, FW_E_FAILURES, "none of %zu windows succeeded in all ways: there is nothing to compare", r->out->n_failed);
    FW_TRY(fw_depth_settle(own, r->o->law.point ? &r->o->law : NULL, &r->sanity, m));
    for (size_t k = 1; k < r->n_ways; k++) {
        if (r->way[k].is_strip) FW_TRY(make_strip(r, &r->way[k], m));
        FW_TRY(fw_depth_settle(&r->way[k].depth, NULL, NULL, m));
    }
    r->out->n_windows = own->n;
    r->out->n_functions = own->control.calibration.n_functions - 1;
    for (size_t i = 0; i < own->n; i++) r->out->cpu_s_window += r->way[0].cpu_s[i] / (double)own->n;
    FW_TRY(find_governing(r, m));
    return fw_levels_compare(r->out, c, &r->way[0], r->n_ways - 1, r->way + 1, m);
}

fw_status fw_levels_measure(fw_levels *out, const fw_campaign *c, const fw_levels_options *o, fw_msg *m)
{
    double start = fw_cpu_seconds();
    run   *r;
    memset(out, 0, sizeof *out);
    FW_CHECK(c->points.n > 0, m, FW_E_ARG, "the campaign has no measuring points");
    FW_TRY(fw_alloc(&r, 1, sizeof *r, "pilot of levels", m));
    r->c = c, r->o = o, r->out = out;
    out->percentile = c->precision.quantity == FW_QUANTITY_MEAN ? NAN : c->precision.percentile > 0 ? c->precision.percentile : 90;
    out->confidence = c->precision.confidence > 0 ? c->precision.confidence : 0.95;
    fw_status s = measure(r, m);
    for (size_t k = 0; k < r->n_ways; k++) {
        fw_depth_free(&r->way[k].depth);
        free(r->way[k].cpu_s);
    }
    fw_sanity_free(&r->sanity);
    free(r);
    out->cpu_s = fw_cpu_seconds() - start;
    return s;
}
