/* One scene of given floes: the kernel alone, no sampling. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "floewear/realisation.h"
#include "kernel/kernel.h"
#include "physics/drag.h"
#include "realisation/accuracy.h"
#include "realisation/flow.h"
#include "realisation/outcome.h"
#include "realisation/verdict.h"

static fw_status add_floes(fw_world *w, const fw_scene *scene, const fw_setup *s, fw_msg *m)
{
    for (size_t i = 0; i < scene->n_floes; i++) {
        const fw_floe *f = &scene->floes[i];
        fw_body        b = fw_kernel_floe(s, 0.5 * f->diameter, f->thickness);
        b.x = f->x, b.y = f->y, b.vx = f->vx, b.vy = f->vy, b.spin = f->spin;
        b.name = i + 1;
        FW_TRY(fw_world_add_body(w, &b, m));
        /* Given floes may meet each other anywhere: none of them drifts undisturbed. */
        w->bodies[w->n_bodies - 1].is_touched = true;
    }
    return FW_OK;
}

static void floes_now(const fw_world *w, fw_floe *floes)
{
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        floes[i] = (fw_floe){.x = b->x,
                             .y = b->y,
                             .diameter = 2 * b->radius,
                             .thickness = b->thickness,
                             .vx = b->vx,
                             .vy = b->vy,
                             .spin = b->spin};
    }
}

static fw_status simulate(fw_kernel *k, fw_world *w, fw_wear *wear, const fw_weather *weather, double duration, const fw_tick *tick,
                          const fw_frame_sink *frames, fw_floe *floes, fw_msg *m)
{
    size_t n_frames = 0;
    double turned = 0;
    for (;;) {
        double next = duration;
        if (frames) {
            double at = (double)n_frames * frames->interval;
            if (w->t >= at) {
                floes_now(w, floes);
                FW_TRY(frames->frame(frames->self, w->t, w->n_bodies, floes, m));
                at = (double)++n_frames * frames->interval;
            }
            next = fmin(duration, at);
        }
        if (!(w->t < duration)) return FW_OK;
        double turns = fw_weather_segment_end(weather, turned);
        FW_TRY(fw_kernel_step(k, w, wear, fmin(next, turns), m));
        if (w->t == turns) {
            fw_flow flow = fw_weather_flow(weather, turned = turns);
            fw_kernel_turn(k, w, &flow);
        }
        if (tick && ((uint64_t)w->ledger.macro_steps & 63) == 0) FW_TRY(tick->call(tick->self, w->t / duration));
    }
}

static fw_status check(const fw_scene *scene, const fw_frame_sink *frames, double *fastest, fw_msg *m)
{
    FW_TRY(fw_model_check(&scene->model, m));
    FW_CHECK(isfinite(scene->speed), m, FW_E_ARG, "current speed %g m/s: wanted a finite number", scene->speed);
    FW_CHECK(scene->duration > 0 && isfinite(scene->duration), m, FW_E_ARG, "duration %g s: wanted more than 0",
             scene->duration);
    FW_CHECK(!frames || frames->interval > 0, m, FW_E_ARG, "frame interval must be positive");
    *fastest = 0; /* of the floes; the current's is the weather's to say */
    for (size_t i = 0; i < scene->n_floes; i++) {
        const fw_floe *f = &scene->floes[i];
        FW_CHECK(isfinite(f->x) && isfinite(f->y) && isfinite(f->vx) && isfinite(f->vy) && isfinite(f->spin) &&
                     f->diameter > 0 && f->thickness > 0,
                 m, FW_E_ARG, "floe %zu: a value is not finite or not positive", i + 1);
        *fastest = fmax(*fastest, hypot(f->vx, f->vy));
    }
    bool have_contact = (scene->model.effects & FW_EFFECT_FLOE_CONTACT) != 0;
    for (size_t i = 0; i < scene->n_floes && have_contact; i++)
        for (size_t k = 0; k < i; k++) {
            const fw_floe *a = &scene->floes[i], *b = &scene->floes[k];
            double         far = 0.5 * fmax(a->diameter, b->diameter), dx = a->x - b->x, dy = a->y - b->y;
            FW_CHECK(dx * dx + dy * dy > far * far, m, FW_E_ARG, "floes %zu and %zu overlap by a whole radius at the start", k + 1, i + 1);
        }
    return FW_OK;
}

/* What the wind makes of floes that the current leaves behind, or lies still under. */
static double fastest_drift(const fw_scene *scene, const fw_setup *s)
{
    double most = 0, vx, vy;
    for (size_t i = 0; i < scene->n_floes && s->has_wind; i++) {
        fw_body b = fw_kernel_floe(s, 0.5 * scene->floes[i].diameter, scene->floes[i].thickness);
        fw_kernel_free_drift(s, &b, &vx, &vy);
        most = fmax(most, hypot(vx, vy));
    }
    return most;
}

/* A failed try still shows where it came to. */
static void fill(const fw_scene *scene, const fw_world *w, fw_wear *wear, fw_scene_result *out)
{
    fw_record *r = &out->record;
    double     evaluations = r->force_evaluations, steps = r->steps;
    fw_wear_finish(wear);
    fw_outcome_fill(r, w, wear, scene->duration);
    r->speed = scene->speed;
    r->wind_speed = scene->wind_speed, r->wind_angle = scene->wind_angle, r->tide_phase = scene->tide_phase;
    r->force_evaluations += evaluations, r->steps += steps;
    const fw_wear_sums *sum = &wear->sums[0];
    double              rate = fw_abrasion_rate(&scene->model.laws[0], scene->temperature),
           edge = pow(1e-6, wear->exponent[0]) * 1e-3 * rate;
    out->path = sum->path;
    out->depth_along_contact = sum->along * edge;
    out->depth_x_wall = sum->x_wall * edge;
    out->depth_impact = sum->impact * edge;
    out->max_overlap = w->ledger.max_overlap;
    out->n_floes = w->n_bodies;
    floes_now(w, out->floes);
}

static fw_status run_once(const fw_scene *scene, const fw_model *model, double fastest, const fw_tick *tick, const fw_frame_sink *frames,
                          fw_scene_result *out, fw_msg *m)
{
    fw_setup   setup;
    fw_weather weather;
    fw_kernel *k = NULL;
    fw_world  *w = NULL;
    fw_wear    wear = {0};
    fw_accuracy_setup(&setup, model, scene->speed, fastest);
    setup.half_width = setup.downstream = INFINITY; /* no untouched ice, and nobody is forgotten */
    if (model->max_evaluations > 0) setup.max_evaluations = model->max_evaluations;
    fw_scenario sc = {.speed = scene->speed, .wind_speed = scene->wind_speed, .wind_angle = scene->wind_angle, .tide_phase = scene->tide_phase};
    FW_TRY(fw_weather_init(&weather, &setup, model, &sc, 0, scene->duration, -1, m));
    setup.velocity_scale = fmax(fmax(fastest, weather.fastest), fastest_drift(scene, &setup));
    if (!(setup.velocity_scale > 0)) setup.velocity_scale = 1e-3; /* nothing moves: any scale will do */
    if (!(setup.crush_speed > 0)) setup.crush_speed = setup.velocity_scale;
    fw_status s = fw_wear_init(&wear, model->structure_radius, model->n_arcs, model->n_laws, model->laws, m);
    if (s == FW_OK) s = fw_world_create(&w, model->structure_radius, m);
    if (s == FW_OK) s = fw_kernel_create(&k, &setup, m);
    if (s == FW_OK) s = add_floes(w, scene, &setup, m);
    if (s == FW_OK) {
        if (model->effects & FW_EFFECT_CRUSHING_LIMIT) fw_wear_limit_pressure(&wear, &model->crushing_limit);
        wear.rule = model->numerics.wear_rule;
        wear.is_open = true;
        fw_world_open_ledger(w);
        s = simulate(k, w, &wear, &weather, scene->duration, tick, frames, out->floes, m);
        if (s == FW_OK || s == FW_E_NUMERIC || s == FW_E_LIMIT) fill(scene, w, &wear, out);
        if (s == FW_OK) s = fw_verdict(&out->record, w, model->numerics.order ? INFINITY : setup.energy_tolerance, m);
    }
    out->record.failed_at = s != FW_OK && k && w ? fw_kernel_now(k, w) : 0;
    fw_kernel_destroy(k);
    fw_world_destroy(w);
    fw_wear_free(&wear);
    out->record.status = s;
    return s;
}

fw_status fw_scene_run(const fw_scene *scene, const fw_tick *tick, const fw_frame_sink *frames, fw_scene_result *out,
                       fw_msg *m)
{
    fw_msg own = {""};
    if (!m) m = &own;
    memset(out, 0, sizeof *out);
    double fastest = 1, cpu = fw_cpu_seconds();
    FW_TRY(check(scene, frames, &fastest, m));
    fw_status s = fw_record_init(&out->record, scene->model.n_arcs, scene->model.n_laws, m);
    if (s == FW_OK) s = fw_alloc(&out->floes, scene->n_floes, sizeof *out->floes, "floes", m);
    if (s == FW_OK) s = run_once(scene, &scene->model, fastest, tick, frames, out, m);
    out->record.tries = 1;
    if (s == FW_E_NUMERIC && scene->model.numerics.scheme == FW_SCHEME_EVENTS) {
        fw_model finer = fw_accuracy_finer(&scene->model);
        fw_outcome_begin_again(&out->record, m);
        s = run_once(scene, &finer, fastest, tick, frames, out, m);
        out->record.tries = 2;
    }
    out->record.host_cpu_s = fw_cpu_seconds() - cpu;
    if (s == FW_E_NUMERIC || s == FW_E_LIMIT) {
        fw_msg said = *m;
        fw_outcome_say(&out->record, m);
        *m = said;
        s = out->record.status;
    }
    if (s != FW_OK && s != FW_E_NUMERIC && s != FW_E_LIMIT) fw_scene_result_free(out);
    return s;
}

void fw_scene_free(fw_scene *s)
{
    free(s->floes);
    free(s->model.tide.rows);
    s->floes = NULL, s->model.tide.rows = NULL;
    s->n_floes = s->model.tide.n_rows = 0;
}

void fw_scene_result_free(fw_scene_result *r)
{
    fw_record_free(&r->record);
    free(r->floes);
    memset(r, 0, sizeof *r);
}
