/* A realisation at one instant as a scene of its own. */
#include <math.h>

#include "base/memory.h"
#include "realisation/accuracy.h"
#include "realisation/window.h"

static fw_status add_floe(fw_scene *to, size_t *capacity, fw_floe f, fw_msg *m)
{
    FW_TRY(fw_grow(&to->floes, capacity, to->n_floes + 1, sizeof *to->floes, "floes", m));
    to->floes[to->n_floes++] = f;
    return FW_OK;
}

/* All floes that are awake, and the untouched ones that the current brings near within the scene's duration. */
static fw_status gather(const fw_window_run *r, fw_scene *to, fw_msg *m)
{
    const fw_world *w = r->world;
    size_t          capacity = 0;
    double          from, low, high;
    fw_kernel_needs_ice(r->kernel, w, &from, &low, &high);
    from -= to->speed * to->duration;
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        FW_TRY(add_floe(to, &capacity, (fw_floe){b->x, b->y, 2 * b->radius, b->thickness, b->vx, b->vy, b->spin}, m));
    }
    for (size_t q = 0; q < w->n_blocks; q++) {
        const fw_block *b = &w->blocks[q];
        for (size_t i = 0; i < b->n; i++) {
            double x = b->x[i] + w->drift, y = b->y[i];
            if (b->is_taken[i] || fabs(y) > r->setup.half_width || x < from || y < low || y > high || x > r->setup.downstream) continue;
            FW_TRY(add_floe(to, &capacity, (fw_floe){x, y, 2 * b->radius[i], b->thickness[i], to->speed, 0, 0}, m));
        }
    }
    return FW_OK;
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
    /* By the way of the run itself, which has all floes stand at the window's start: its steps are cut there. */
    double warm_up = fw_accuracy_warm_up(model, at.speed);
    if (s == FW_OK && warm_up < t) s = fw_window_go(&r, warm_up, t, tick, m);
    if (s == FW_OK) s = fw_window_go(&r, t, t, tick, m);
    if (s == FW_OK) s = fw_window_feed(&r, at.speed * duration, m);
    if (s == FW_OK) s = gather(&r, out, m);
    fw_window_close(&r);
    if (s != FW_OK) fw_scene_free(out);
    return s;
}
