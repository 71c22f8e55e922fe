#include "cli/failed_scene.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "campaign/signals.h"
#include "cli/config.h"
#include "effects/effects.h"
#include "effects/friction.h"
#include "realisation/accuracy.h"

/* How long before the failure the scene begins [m of the current's way]: the first at which no two floes overlap (a scene starts without a
 * history of contacts) and which fails. */
static const double BEFORE[] = {0.5, 2, 5, 10, 20, 40};
/* It goes on beyond the failure by this way [m]: two listings of the kernel. */
static const double AFTER = 15;

/* A window's wind may be none, a scene's is refused then: air at rest drags all the same [m/s]. */
static const double CALM = 1e-9;

static void put_effects(FILE *f, const fw_model *m)
{
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e), k = 0;
    fprintf(f, "effects: [");
    for (size_t i = 0; i < n; i++)
        if (m->effects & (uint32_t)e[i]->bit) fprintf(f, "%s%s", k++ ? ", " : "", e[i]->name);
    fprintf(f, "]\n");
}

static void put_contact(FILE *f, const fw_model *k)
{
    bool is_crush = fw_effects_have(k, FW_EFFECT_CRUSH_CONTACT);
    fprintf(f, "contact: {law: %s, ", is_crush ? "crush" : "spring");
    if (k->stiffness_from_pressure)
        fprintf(f, "stiffness: from_pressure, ");
    else
        fprintf(f, "stiffness: %.17g N/m, ", k->stiffness);
    fprintf(f, "damping_ratio: %.17g, friction: %.17g, slip_damping_ratio: %.17g", k->damping_ratio, k->friction, k->slip_damping_ratio);
    if (is_crush || k->stiffness_from_pressure)
        fprintf(f, ", pressure: %.17g Pa, pressure_exponent: %.17g", k->crush.law.pressure, k->crush.law.exponent);
    if (is_crush) fprintf(f, ", flat: %s", fw_effects_have(k, FW_EFFECT_ROTATION) && fw_friction_flat_turns(k) ? "on" : "off");
    if (is_crush && k->crush.unloading > 0) fprintf(f, ", unloading_stiffness: %.17g", k->crush.unloading);
    if (fw_effects_have(k, FW_EFFECT_ICE_ON_ICE)) {
        if (!k->stiffness_from_pressure) fprintf(f, ", floe_stiffness: %.17g N/m", k->floe_stiffness);
        fprintf(f, ", floe_friction: %.17g", k->floe_friction);
    }
    fprintf(f, "}\n");
}

static void put_wind(FILE *f, const fw_scene *s)
{
    const fw_wind *w = &s->model.wind;
    if (!fw_effects_have(&s->model, FW_EFFECT_WIND)) return;
    double speed = fmax(s->wind_speed, CALM), angle = -s->wind_angle * 180 / 3.14159265358979323846; /* anticlockwise to clockwise */
    fprintf(f, "wind: {speed: %.17g m/s, angle: %.17g deg, air_density: %.17g kg/m3, skin_drag: %.17g, form_drag: %.17g}\n", speed,
            remainder(angle, 360), w->density, w->skin_drag, w->form_drag);
}

static void put_laws(FILE *f, const fw_model *m)
{
    fprintf(f, "abrasion:\n");
    if (fw_effects_have(m, FW_EFFECT_CRUSHING_LIMIT))
        fprintf(f, "  crushing_limit: {pressure: %.17g Pa, exponent: %.17g}\n", m->crushing_limit.pressure, m->crushing_limit.exponent);
    fprintf(f, "  laws:\n");
    for (size_t i = 0; i < m->n_laws; i++) {
        const fw_abrasion_law *l = &m->laws[i];
        if (strcmp(l->name, "power") == 0)
            fprintf(f, "    - {power: {coefficient: %.17g mm/km, exponent: %.17g, uses_temperature: %s}}\n", l->coefficient, l->exponent,
                    l->uses_temperature ? "true" : "false");
        else if (strcmp(l->name, "archard") == 0)
            fprintf(f, "    - {archard: {coefficient: %.17g mm/km}}\n", l->coefficient);
        else
            fprintf(f, "    - %s\n", l->name);
    }
}

static fw_status put(const fw_scene *s, const fw_campaign *c, const fw_record *r, double from, const char *path, fw_msg *m)
{
    const fw_model *k = &s->model;
    FILE           *f = fopen(path, "w");
    FW_CHECK(f, m, FW_E_IO, "%s: %s", path, strerror(errno));
    fprintf(f, "# Realisation %" PRIu64 " of %s (seed %" PRIu64 ") from %.6g s on, warm-up included.\n# It failed: %s\n", r->id, c->name, c->seed,
            from, r->cause);
    fprintf(f, "structure: {diameter: %.17g m}\nice: {density: %.17g kg/m3}\ncurrent: {speed: %.17g m/s}\n", 2 * k->structure_radius,
            k->ice_density, s->speed);
    put_contact(f, k);
    fprintf(f, "water: {density: %.17g kg/m3, form_drag: %.17g", k->water_density, k->form_drag);
    if (fw_effects_have(k, FW_EFFECT_SKIN_DRAG)) fprintf(f, ", skin_drag: %.17g", k->skin_drag);
    fprintf(f, "}\n");
    put_wind(f, s);
    put_effects(f, k);
    put_laws(f, k);
    fprintf(f, "ring: {arcs: %zu}\naccuracy: %.17g\nduration: %.17g s\nfloes:\n", k->n_arcs, k->accuracy, s->duration);
    for (size_t i = 0; i < s->n_floes; i++) {
        const fw_floe *b = &s->floes[i];
        fprintf(f, "  - {x: %.17g m, y: %.17g m, diameter: %.17g m, thickness: %.17g m, vx: %.17g m/s, vy: %.17g m/s, spin: %.17g rad/s}\n", b->x,
                b->y, b->diameter, b->thickness, b->vx, b->vy, b->spin);
    }
    bool is_good = !ferror(f);
    is_good = fclose(f) == 0 && is_good;
    if (!is_good) {
        fw_fail(m, FW_E_IO, "%s: %s", path, strerror(errno));
        unlink(path);
        return FW_E_IO;
    }
    return FW_OK;
}

/* Does the file fail? Read as a user's program reads it: it refuses floes that overlap at the start. */
static fw_status fails(const char *path, bool *it_does, fw_msg *m)
{
    fw_scene        s;
    fw_scene_result out = {0};
    fw_status       status = fw_config_scene(&s, path, 0, NULL, m);
    *it_does = false;
    if (status == FW_OK) {
        s.model.max_evaluations = 1e9; /* it may go astray, too */
        status = fw_scene_run(&s, NULL, NULL, &out, m);
        *it_does = status == FW_E_NUMERIC;
        fw_scene_result_free(&out);
        fw_scene_free(&s);
    }
    return status == FW_E_NOMEM ? status : FW_OK;
}

fw_status fw_failed_scene_write(const fw_campaign *c, const fw_record *r, const char *path, bool *is_written, fw_msg *m)
{
    fw_scenario sc;
    fw_tick     tick = {.call = fw_signals_tick};
    /* as the try that failed last */
    fw_model    model = r->tries > 1 ? fw_accuracy_finer(&c->model) : c->model;
    double      from = INFINITY;
    *is_written = false;
    if (r->failed_at >= r->warm_up + r->window) return FW_OK; /* judged at its end: there is no moment to show */
    fw_campaign_scenario(c, r->id, &sc);
    double speed = fmax(sc.speed, FW_SLOWEST);
    for (size_t i = 0; i < sizeof BEFORE / sizeof BEFORE[0] && from > 0; i++) {
        fw_scene  s;
        fw_status status;
        from = fmax(0, r->failed_at - BEFORE[i] / speed);
        status = fw_realise_excerpt(&model, &sc, from, (BEFORE[i] + AFTER) / speed, &tick, &s, m);
        if (status == FW_E_NUMERIC || status == FW_E_LIMIT) continue; /* cut at another instant it fails a little sooner */
        FW_TRY(status);
        status = put(&s, c, r, from, path, m);
        fw_scene_free(&s);
        FW_TRY(status);
        status = fails(path, is_written, m);
        if (*is_written) return FW_OK;
        unlink(path);
        FW_TRY(status);
    }
    return FW_OK;
}
