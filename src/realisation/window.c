#include "realisation/window.h"

#include <math.h>

#include "kernel/strip.h"
#include "realisation/accuracy.h"
#include "realisation/cost.h"

/* Of the plain method: the paper's area reaches 60 m upstream. */
static const double PLAIN_INLET = -60;

static fw_box ice_need(const fw_window_run *r)
{
    return r->plain ? fw_plain_needs_ice(r->plain, r->world) : fw_kernel_needs_ice(r->kernel, r->world);
}

static fw_status lay(fw_window_run *r, const fw_scenario *sc, fw_msg *m)
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
    fw_ice_way way = r->weather.tide || r->setup.flow.ice_x < 0 ? FW_ICE_ANYWHERE : r->setup.flow.ice_y != 0 ? FW_ICE_ACROSS : FW_ICE_ALONG;
    return fw_ice_lay(&r->ice, &f, r->world, r->setup.half_width, r->setup.downstream, sc->speed * fw_accuracy_warm_up(r->model, sc->speed), way, m);
}

/* How many floes are awake, and how far the jam has grown against the current. Where floes are awake before anything touches them those are no
 * part of it. */
static void note_extent(fw_world *w, const fw_setup *s)
{
    fw_ledger *l = &w->ledger;
    fw_strip   strip = fw_strip_of(s, w);
    bool       are_touched = !(s->wake_radius > 0 || s->wake_upstream > 0);
    if ((double)w->n_bodies > l->awake_floes) l->awake_floes = (double)w->n_bodies;
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        double         upstream = -(strip.cx * b->x + strip.cy * b->y);
        if (upstream > l->reach && (are_touched || b->is_touched)) l->reach = upstream;
    }
}

double fw_window_now(const fw_window_run *r)
{
    if (!r->world) return 0;
    return r->kernel ? fw_kernel_now(r->kernel, r->world) : r->world->t;
}

fw_box fw_window_box(const fw_window_run *r, double more)
{
    fw_box         box = ice_need(r);
    const fw_flow *f = &r->setup.flow;
    double         u = hypot(f->ice_x, f->ice_y), x = u > 0 ? more * f->ice_x / u : more, y = u > 0 ? more * f->ice_y / u : 0;
    box.x0 -= fmax(x, 0), box.x1 -= fmin(x, 0), box.y0 -= fmax(y, 0), box.y1 -= fmin(y, 0);
    return box;
}

fw_status fw_window_feed(fw_window_run *r, double more, fw_msg *m)
{
    fw_box need = fw_window_box(r, more);
    r->is_ice = true;
    FW_TRY(fw_ice_feed(&r->ice, r->world, &need, m));
    r->is_ice = false;
    return FW_OK;
}

static fw_status attend(void *self)
{
    fw_window_run *r = self;
    if (r->tick) r->stopped = r->tick->call(r->tick->self, r->world->t / r->t_all);
    return r->stopped;
}

/* Towards t_end, where the current changes at the latest. */
static fw_status towards(fw_window_run *r, double t_end, fw_msg *m)
{
    fw_world *w = r->world;
    double    turns = fw_weather_segment_end(&r->weather, r->turned); /* not the one after w->t: a window may begin a rounding before it */
    FW_TRY(fw_kernel_step(r->kernel, w, &r->wear, fmin(t_end, turns), m));
    if (w->t == turns) {
        r->turned = turns;
        r->setup.flow = fw_weather_flow(&r->weather, turns);
        fw_kernel_turn(r->kernel, w, &r->setup.flow);
    }
    return FW_OK;
}

fw_status fw_window_go(fw_window_run *r, double t_end, double t_all, const fw_tick *tick, fw_msg *m)
{
    fw_world *w = r->world;
    r->tick = tick, r->t_all = t_all, r->stopped = FW_OK;
    for (size_t quiet = 1; w->t < t_end; quiet++) {
        FW_TRY(fw_window_feed(r, 0, m));
        if (r->plain)
            FW_TRY(fw_plain_step(r->plain, w, &r->wear, t_end, m));
        else
            FW_TRY(towards(r, t_end, m));
        note_extent(w, &r->setup);
        if (quiet % 64 == 0 || r->plain) FW_TRY(attend(r));
    }
    return FW_OK;
}

fw_status fw_window_open(fw_window_run *r, const fw_model *model, const fw_scenario *sc, fw_msg *m)
{
    *r = (fw_window_run){.model = model};
    fw_accuracy_setup(&r->setup, model, sc->speed, sc->speed);
    FW_TRY(fw_weather_init(&r->weather, &r->setup, model, sc, fw_accuracy_warm_up(model, sc->speed), model->window, (int)sc->mix, m));
    r->setup.velocity_scale = r->weather.fastest;
    r->setup.attend = attend, r->setup.attend_self = r;
    FW_TRY(fw_cost_limit(model, sc, &r->setup.max_evaluations, m));
    FW_TRY(fw_wear_init(&r->wear, model->structure_radius, model->n_arcs, model->n_laws, model->laws, m));
    if (model->effects & FW_EFFECT_CRUSHING_LIMIT) fw_wear_limit_pressure(&r->wear, &model->crushing_limit);
    r->is_ice = true;
    FW_TRY(lay(r, sc, m));
    r->is_ice = false;
    fw_world_open_ledger(r->world);
    return FW_OK;
}

void fw_window_close(fw_window_run *r)
{
    fw_kernel_destroy(r->kernel);
    fw_plain_destroy(r->plain);
    fw_world_destroy(r->world);
    fw_ice_free(&r->ice);
    fw_wear_free(&r->wear);
}
