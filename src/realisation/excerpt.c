/* A realisation at one instant as a scene of its own. */
#include <math.h>

#include "base/memory.h"
#include "kernel/strip.h"
#include "realisation/accuracy.h"
#include "realisation/window.h"

static fw_status add_floe(fw_scene *to, size_t *capacity, fw_floe f, fw_msg *m)
{
    FW_TRY(fw_grow(&to->floes, capacity, to->n_floes + 1, sizeof *to->floes, "floes", m));
    to->floes[to->n_floes++] = f;
    return FW_OK;
}

/* The same floe in a frame that has the current along +x. */
static fw_floe turned(const fw_strip *by, const fw_body *b)
{
    double c = by->cx, s = by->cy;
    return (fw_floe){c * b->x + s * b->y, c * b->y - s * b->x, 2 * b->radius, b->thickness, c * b->vx + s * b->vy, c * b->vy - s * b->vx, b->spin};
}

/* Way of untouched ice within the scene's duration. */
static double way_of(const fw_window_run *r, double duration) { return hypot(r->setup.flow.ice_x, r->setup.flow.ice_y) * duration; }

/* All floes that are awake, and the untouched ones that current and wind bring near within the scene's duration. */
static fw_status gather(const fw_window_run *r, const fw_strip *by, fw_scene *to, fw_msg *m)
{
    const fw_world *w = r->world;
    size_t          capacity = 0;
    fw_box          box = fw_window_box(r, way_of(r, to->duration));
    fw_strip        strip = fw_strip_of(&r->setup, w);
    for (size_t i = 0; i < w->n_bodies; i++) FW_TRY(add_floe(to, &capacity, turned(by, &w->bodies[i]), m));
    for (size_t q = 0; q < w->n_blocks; q++) {
        const fw_block *b = &w->blocks[q];
        for (size_t i = 0; i < b->n; i++) {
            double x = b->x[i] + w->drift_x, y = b->y[i] + w->drift_y;
            if (b->is_taken[i] || !fw_strip_has(&strip, b->x[i], b->y[i]) || x < box.x0 || x > box.x1 || y < box.y0 || y > box.y1 ||
                strip.cx * x + strip.cy * y > r->setup.downstream)
                continue;
            fw_body f = fw_kernel_floe(&r->setup, b->radius[i], b->thickness[i]);
            f.x = x, f.y = y;
            fw_kernel_free_drift(&r->setup, &f, &f.vx, &f.vy);
            FW_TRY(add_floe(to, &capacity, turned(by, &f), m));
        }
    }
    return FW_OK;
}

/* Springs as stiff as pressure and the window's current made them: in a current of f times that, by a pressure of f^(2 - e) times as much,
 * as k ~ v^2 (v^2 / P)^(-2/e) (physics/crush.h). Where the structure crushes floes by that very pressure, they stay as they are. */
static void keep_stiffness(fw_model *m, double f)
{
    if (!m->stiffness_from_pressure || (m->effects & FW_EFFECT_CRUSH_CONTACT) || f == 1) return;
    m->crush.law.pressure *= pow(f, 0.5 + 0.5 * m->crush.law.exponent);
}

/* Along the current of this instant. A scene's lasts. */
static fw_strip direction_of(const fw_window_run *r)
{
    const fw_flow *f = &r->setup.flow;
    double         u = hypot(f->ux, f->uy);
    return (fw_strip){.cx = u > 0 ? f->ux / u : 1, .cy = u > 0 ? f->uy / u : 0};
}

fw_status fw_realise_excerpt(const fw_model *model, const fw_scenario *sc, double t, double duration, const fw_tick *tick, fw_scene *out,
                             fw_msg *m)
{
    FW_CHECK(model->numerics.scheme == FW_SCHEME_EVENTS && sc->mix < model->n_mixes && sc->speed > 0, m, FW_E_ARG,
             "no excerpt of thickness mix %u of %zu at %g m/s", sc->mix, model->n_mixes, sc->speed);
    fw_window_run r;
    fw_scenario   at = *sc;
    at.speed = fmax(at.speed, FW_SLOWEST);
    fw_status s = fw_window_open(&r, model, &at, m);
    *out = (fw_scene){.model = *model, .speed = at.speed, .duration = duration};
    out->model.tide.rows = NULL, out->model.tide.n_rows = 0; /* the campaign's own */
    /* By the way of the run itself, which has all floes stand at the window's start: its steps are cut there. */
    double warm_up = fw_accuracy_warm_up(model, at.speed);
    if (s == FW_OK && warm_up < t) s = fw_window_go(&r, warm_up, t, tick, m);
    if (s == FW_OK) s = fw_window_go(&r, t, t, tick, m);
    if (s == FW_OK) s = fw_window_feed(&r, way_of(&r, duration), m);
    if (s == FW_OK) {
        fw_strip by = direction_of(&r);
        out->model.effects &= ~(uint32_t)FW_EFFECT_TIDE;
        out->speed = fmax(hypot(r.setup.flow.ux, r.setup.flow.uy), FW_SLOWEST);
        keep_stiffness(&out->model, out->speed / at.speed);
        out->wind_speed = at.wind_speed, out->wind_angle = at.wind_angle - atan2(by.cy, by.cx);
        s = gather(&r, &by, out, m);
    }
    fw_window_close(&r);
    if (s != FW_OK) fw_scene_free(out);
    return s;
}
