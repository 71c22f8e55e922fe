/* One realisation: field -> world -> kernel -> wear -> record.
 *
 *   ice frame          X ---- tile c-1 ---- tile c ---- tile c+1 ----
 *   kernel frame       x = X + drift, drift = speed x time: tiles come in from the left as the run needs them,
 *                      and are dropped when they have passed.
 *
 * Nothing upstream is an inlet: ice is made as far as the disturbance reaches, however far that is. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/field.h"
#include "floewear/realisation.h"
#include "kernel/kernel.h"
#include "kernel/plain.h"
#include "realisation/accuracy.h"
#include "realisation/outcome.h"

/* The disturbance reaches 30-110 m upstream in ordinary fields. A pile that grows past this is no longer a
 * structure in a drifting field, and the realisation says so. */
static const double MAX_REACH = 5000;

/* Of the plain method: the paper's area reaches 60 m upstream. */
static const double PLAIN_INLET = -60;

typedef struct run {
    const fw_model *model;
    fw_setup        setup;
    fw_field       *field;
    fw_world       *world;
    fw_kernel      *kernel;
    fw_plain       *plain; /* instead of kernel, for benchmarks */
    fw_wear         wear;
    int64_t         next_column; /* the first (largest) column not in the world yet; columns go down as time goes on */
    int64_t         row0, row1;  /* rows of tiles that the strip's width needs */
    uint64_t        n_named;
} run;

static fw_status add_column(run *r, int64_t column, bool is_start, fw_msg *m)
{
    for (int64_t row = r->row0; row <= r->row1; row++) {
        const fw_tile *t;
        FW_TRY(fw_field_tile(r->field, column, row, &t, m));
        FW_TRY(fw_world_add_block(r->world, t->n_floes, t->x, t->y, t->radius, t->thickness, r->n_named, m));
        r->n_named += t->n_floes;
        if (!is_start) continue;
        /* The field is laid round the structure: what would lie on it is not there. */
        fw_block *b = &r->world->blocks[r->world->n_blocks - 1];
        for (size_t i = 0; i < b->n; i++)
            if (hypot(b->x[i] + r->world->drift, b->y[i]) <= r->model->structure_radius + b->radius[i]) {
                b->is_taken[i] = true;
                b->n_left--;
            }
    }
    return FW_OK;
}

static double needs_ice_from(const run *r)
{
    return r->plain ? fw_plain_needs_ice_from(r->plain, r->world) : fw_kernel_needs_ice_from(r->kernel, r->world);
}

static fw_status feed(run *r, fw_msg *m)
{
    double L = fw_field_tile_length(r->field), from = needs_ice_from(r);
    FW_CHECK(from > -MAX_REACH, m, FW_E_NUMERIC,
             "the pile of disturbed floes reaches %.0f m upstream at t = %.6g s: more than %.0f m", -from, r->world->t,
             MAX_REACH);
    /* A floe of the next column may stick out over the tile's border by its radius: one radius more is in `from`. */
    while ((double)(r->next_column + 1) * L + r->world->drift > from) {
        FW_TRY(add_column(r, r->next_column, false, m));
        r->next_column--;
        fw_world_drop_blocks_beyond(r->world, r->setup.downstream + r->world->max_radius + r->setup.skin);
        fw_field_forget(r->field, r->next_column + 3);
    }
    return FW_OK;
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
    FW_TRY(fw_field_create(&r->field, &f, m));
    double L = fw_field_tile_length(r->field), reach = r->setup.half_width;
    r->row1 = (int64_t)ceil(reach / L - 0.5 - 1e-9);
    if (r->row1 < 0) r->row1 = 0;
    r->row0 = -r->row1;
    FW_TRY(fw_world_create(&r->world, r->model->structure_radius, m));
    if (r->model->numerics.scheme != FW_SCHEME_EVENTS)
        FW_TRY(fw_plain_create(&r->plain, &r->setup, &r->model->numerics, PLAIN_INLET, m));
    else
        FW_TRY(fw_kernel_create(&r->kernel, &r->setup, m));
    r->world->max_radius = fw_field_max_radius(r->field);
    /* At the start the origin lies in the middle of column 0; the ice downstream belongs to columns 0 and 1. */
    r->world->drift = -0.5 * L;
    int64_t last = (int64_t)floor((r->setup.downstream + r->world->max_radius - r->world->drift) / L);
    double  from = needs_ice_from(r);
    for (r->next_column = last; (double)(r->next_column + 1) * L + r->world->drift > from; r->next_column--)
        FW_TRY(add_column(r, r->next_column, true, m));
    return FW_OK;
}

static fw_status go(run *r, double t_end, double t_all, const fw_tick *tick, fw_status *stopped, fw_msg *m)
{
    fw_world *w = r->world;
    double    told = w->ledger.force_evaluations;
    for (size_t quiet = 1; w->t < t_end; quiet++) {
        FW_TRY(feed(r, m));
        if (r->plain)
            FW_TRY(fw_plain_step(r->plain, w, &r->wear, t_end, m));
        else
            FW_TRY(fw_kernel_step(r->kernel, w, &r->wear, t_end, m));
        /* Some milliseconds of work: a macro-step takes from a microsecond to as many milliseconds in a jam. */
        if (tick && (quiet % 64 == 0 || w->ledger.force_evaluations - told > 2e4)) {
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
    if (!r->field) return;
    fw_field_census c = fw_field_count(r->field);
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

    double cpu = fw_outcome_cpu_now(), warm_up = fw_accuracy_warm_up(model, sc->speed), t_all = warm_up + model->window;
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
        out->host_cpu_s = fw_outcome_cpu_now() - cpu;
        s = FW_OK;
    } else {
        fw_record_free(out);
    }
    fw_kernel_destroy(r.kernel);
    fw_plain_destroy(r.plain);
    fw_world_destroy(r.world);
    fw_field_destroy(r.field);
    fw_wear_free(&r.wear);
    return s;
}
