/* One realisation: field -> world -> kernel -> wear -> record. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "floewear/realisation.h"
#include "kernel/kernel.h"
#include "kernel/plain.h"
#include "realisation/accuracy.h"
#include "realisation/ice.h"
#include "realisation/outcome.h"

/* Of the plain method: the paper's area reaches 60 m upstream. */
static const double PLAIN_INLET = -60;

typedef struct run {
    const fw_model *model;
    fw_setup        setup;
    fw_ice          ice;
    fw_world       *world;
    fw_kernel      *kernel;
    fw_plain       *plain; /* instead of kernel, for benchmarks */
    fw_wear         wear;
} run;

static fw_ice_need ice_need(const run *r)
{
    fw_ice_need n = {.low = -r->setup.half_width, .high = r->setup.half_width};
    if (r->plain)
        n.from = fw_plain_needs_ice_from(r->plain, r->world);
    else
        fw_kernel_needs_ice(r->kernel, r->world, &n.from, &n.low, &n.high);
    return n;
}

static fw_status lay(run *r, const fw_scenario *sc, fw_msg *m)
{
    fw_field_settings f = {.seed = sc->seed,
                           .id = sc->id,
                           .concentration = sc->concentration,
                           .mix = &r->model->mixes[sc->mix],
                           .size_law = r->model->size_law,
                           .size_a = r->model->size_a,
                           .size_b = r->model->size_b};
    FW_TRY(fw_world_create(&r->world, r->model->structure_radius, m));
    if (r->model->numerics.scheme != FW_SCHEME_EVENTS)
        FW_TRY(fw_plain_create(&r->plain, &r->setup, &r->model->numerics, PLAIN_INLET, m));
    else
        FW_TRY(fw_kernel_create(&r->kernel, &r->setup, m));
    return fw_ice_lay(&r->ice, &f, r->world, r->setup.half_width, r->setup.downstream,
                      sc->speed * fw_accuracy_warm_up(r->model, sc->speed), m);
}

/* How many floes are awake, and how far the jam has grown against the current. */
static void note_extent(fw_world *w)
{
    fw_ledger *l = &w->ledger;
    if ((double)w->n_bodies > l->awake_floes) l->awake_floes = (double)w->n_bodies;
    for (size_t i = 0; i < w->n_bodies; i++)
        if (-w->bodies[i].x > l->reach) l->reach = -w->bodies[i].x;
}

static fw_status go(run *r, double t_end, double t_all, const fw_tick *tick, fw_status *stopped, fw_msg *m)
{
    fw_world *w = r->world;
    double    told = w->ledger.force_evaluations;
    for (size_t quiet = 1; w->t < t_end; quiet++) {
        fw_ice_need need = ice_need(r);
        FW_TRY(fw_ice_feed(&r->ice, w, &need, m));
        if (r->plain)
            FW_TRY(fw_plain_step(r->plain, w, &r->wear, t_end, m));
        else
            FW_TRY(fw_kernel_step(r->kernel, w, &r->wear, t_end, m));
        note_extent(w);
        /* Less than a millisecond of work, so that messages of other ranks get on. */
        if (tick && (quiet % 64 == 0 || w->ledger.force_evaluations - told > 5e3)) {
            told = w->ledger.force_evaluations;
            *stopped = tick->call(tick->self, w->t / t_all);
            if (*stopped != FW_OK) return *stopped;
        }
    }
    return FW_OK;
}

static void describe(fw_record *rec, const run *r, const fw_scenario *sc, double warm_up)
{
    rec->id = sc->id;
    rec->concentration = sc->concentration;
    rec->speed = sc->speed;
    rec->mix = sc->mix;
    rec->cell = sc->cell;
    rec->window = r->model->window;
    rec->warm_up = warm_up;
    if (!r->ice.field) return;
    fw_field_census c = fw_field_count(r->ice.field);
    rec->floes_made = (double)c.n_floes;
    if (c.tile_area > 0) rec->concentration_achieved = c.ice_area / c.tile_area;
    if (c.n_floes > 0) rec->mean_diameter = c.sum_diameter / (double)c.n_floes;
}

fw_status fw_realise(const fw_model *model, const fw_scenario *sc, const fw_tick *tick, fw_record *out, fw_msg *m)
{
    fw_msg own = {""};
    if (!m) m = &own;
    memset(out, 0, sizeof *out);
    FW_TRY(fw_model_check(model, m));
    FW_CHECK(sc->speed > 0 && isfinite(sc->speed), m, FW_E_ARG, "current speed %g m/s: wanted more than 0", sc->speed);
    FW_CHECK(sc->mix < model->n_mixes, m, FW_E_ARG, "thickness mix %u of %zu", sc->mix, model->n_mixes);
    FW_TRY(fw_record_init(out, model->n_arcs, model->n_laws, m));

    double cpu = fw_cpu_seconds(), warm_up = fw_accuracy_warm_up(model, sc->speed), t_all = warm_up + model->window;
    run    r = {.model = model};
    fw_status stopped = FW_OK;
    fw_accuracy_setup(&r.setup, model, sc->speed, sc->speed);
    fw_status s = fw_wear_init(&r.wear, model->structure_radius, model->n_arcs, model->n_laws, model->laws, m);
    if (s == FW_OK) s = lay(&r, sc, m);
    if (s == FW_OK) {
        fw_world_open_ledger(r.world);
        s = go(&r, warm_up, t_all, tick, &stopped, m);
    }
    if (s == FW_OK) {
        double spent = r.world->ledger.force_evaluations, steps = r.world->ledger.steps;
        fw_world_open_ledger(r.world);
        r.world->ledger.force_evaluations = spent, r.world->ledger.steps = steps; /* cost counts from the start */
        r.wear.rule = model->numerics.wear_rule;
        r.wear.is_open = true;
        s = go(&r, t_all, t_all, tick, &stopped, m);
        fw_wear_finish(&r.wear);
    }
    /* A failure of the physics or of its limits is a record; no memory, a full disk or a stop are not. */
    bool is_failure = stopped == FW_OK && (s == FW_E_NUMERIC || s == FW_E_LIMIT);
    if (s == FW_OK || is_failure) {
        describe(out, &r, sc, warm_up);
        if (s == FW_OK)
            fw_outcome_fill(out, r.world, &r.wear, model->window);
        else if (r.world)
            out->force_evaluations = r.world->ledger.force_evaluations, out->steps = r.world->ledger.steps;
        out->status = s;
        if (is_failure) {
            snprintf(out->cause, sizeof out->cause, "%.*s", (int)sizeof out->cause - 1, m->text);
            m->text[0] = 0;
        }
        out->host_cpu_s = fw_cpu_seconds() - cpu;
        s = FW_OK;
    } else {
        fw_record_free(out);
    }
    fw_kernel_destroy(r.kernel);
    fw_plain_destroy(r.plain);
    fw_world_destroy(r.world);
    fw_ice_free(&r.ice);
    fw_wear_free(&r.wear);
    return s;
}
