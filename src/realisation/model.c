/* Defaults and checks of a model. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floewear/realisation.h"
#include "kernel/kernel.h"
#include "physics/abrasion.h"
#include "physics/unbreakable.h"

void fw_model_defaults(fw_model *m)
{
    *m = (fw_model){
        .structure_radius = 3.7, /* Raahe lighthouse, 7.4 m: source paper, table 1 */
        .ice_density = 900,
        .water_density = 1025,
        .form_drag = 10,    /* source paper, table 2; on D h: this project's reading */
        .stiffness = 2e6,   /* source paper, table 2 */
        .damping_ratio = 1, /* "critical damping coefficient" */
        .friction = 0.1,    /* source paper, table 1 */
        .slip_damping_ratio = 1,
        .effects = FW_EFFECTS_CORE,
        .skin_drag = 0.0055,   /* ice on water: Leppaeranta, The Drift of Sea Ice (2011) */
        .floe_stiffness = 2e6,
        .floe_friction = 0.1,
        .wind = {.density = 1.3, .skin_drag = 0.0018, .form_drag = 1.1},
        .tide = {.period = 12.42 * 3600, .phase = NAN},
        .crushing_limit = {5e6, 0},
        .crush = {.law = {1.1e6, 0}, .has_flat = true},
        .n_laws = 1,
        .n_mixes = 1,
        .size_law = FW_SIZE_UNIFORM,
        .window = 3 * 3600,
        .warm_up = -1,
        .accuracy = 0.01,
        .n_arcs = 360,
        .strip_width = -1,
        .downstream = -1,
        .max_evaluations = -1,
    };
    m->laws[0] = *fw_abrasion_find("bekker2011");
    fw_thickness_mix *x = &m->mixes[0];
    x->probability = 1;
    x->n_classes = 5;
    static const double H[] = {0.5, 0.7, 0.9, 1.1, 1.3}; /* source paper: one fifth each */
    for (size_t i = 0; i < 5; i++) x->classes[i] = (fw_thickness_class){H[i], 0.2};
}

#define NEED(cond, ...) FW_CHECK(cond, msg, FW_E_ARG, __VA_ARGS__)
static bool is_in(double v, double low, double high) { return v >= low && v <= high; } /* false for NaN */

/* The patch of a touch grows like t^(1/2): without a limit sigma^m ~ t^(-m/2), under one ~ t^(-q m/2). */
static fw_status check_laws(const fw_model *m, fw_msg *msg)
{
    bool                   is_limited = (m->effects & FW_EFFECT_CRUSHING_LIMIT) != 0;
    const fw_pressure_law *limit = &m->crushing_limit;
    NEED(!is_limited || is_in(limit->pressure, 1e3, 1e8), "crushing limit %g Pa: wanted 1 kPa to 100 MPa at 1 m2", limit->pressure);
    NEED(!is_limited || (limit->exponent >= 0 && limit->exponent < 1), "crushing limit: exponent %g of the area: wanted 0 <= q < 1",
         limit->exponent);
    for (size_t i = 0; i < m->n_laws; i++) {
        const fw_abrasion_law *l = &m->laws[i];
        NEED(is_limited || (l->exponent > 0 && l->exponent < 2),
             "abrasion law %s: exponent %g: wanted 0 < m < 2 (from 2 on the load of a touch diverges without a "
             "crushing limit)",
             l->name, l->exponent);
        NEED(l->exponent > 0 && l->exponent <= 4, "abrasion law %s: exponent %g: wanted 0 < m <= 4 under a crushing limit", l->name, l->exponent);
        NEED(!is_limited || l->exponent * limit->exponent < 2,
             "abrasion law %s: exponent %g under a crushing limit that falls with area^%g: wanted a product below 2 (from there on the "
             "load of a touch diverges under the limit too)",
             l->name, l->exponent, limit->exponent);
    }
    return FW_OK;
}

static fw_status check_course(const fw_tide *t, fw_msg *msg)
{
    for (size_t i = 0; i < t->n_rows; i++) {
        const fw_course_row *r = &t->rows[i];
        NEED(isfinite(r->time) && isfinite(r->factor) && isfinite(r->turn) && (i == 0 || r->time > r[-1].time),
             "course of the current, row %zu: %g s, factor %g, turn %g rad: wanted times that ascend, and finite numbers", i + 1, r->time, r->factor,
             r->turn);
    }
    return FW_OK;
}

const char *fw_model_beyond_fixed_steps(const fw_model *m)
{
    if (m->effects & FW_EFFECT_CRUSH_CONTACT) return "contacts that crush";
    if (m->stiffness_from_pressure) return "stiffness from pressure";
    return m->effects & FW_EFFECT_TIDE ? "a current that changes within a window" : NULL;
}

fw_status fw_model_check(const fw_model *m, fw_msg *msg)
{
    NEED(is_in(m->structure_radius, 0.05, 500), "structure radius %g m: wanted 0.05 to 500 m", m->structure_radius);
    NEED(is_in(m->ice_density, 100, 1100), "ice density %g kg/m3: wanted 100 to 1100", m->ice_density);
    NEED(is_in(m->water_density, 100, 2000), "water density %g kg/m3: wanted 100 to 2000", m->water_density);
    NEED(is_in(m->form_drag, 0, 1000), "form drag %g: wanted 0 to 1000", m->form_drag);
    NEED(is_in(m->stiffness, 1e3, 1e12), "contact stiffness %g N/m: wanted 1e3 to 1e12", m->stiffness);
    NEED(is_in(m->damping_ratio, 0, 100), "damping ratio %g: wanted 0 to 100", m->damping_ratio);
    NEED(is_in(m->friction, 0, 10), "friction %g: wanted 0 to 10", m->friction);
    NEED(is_in(m->slip_damping_ratio, 0, 100), "slip damping ratio %g: wanted 0 to 100", m->slip_damping_ratio);
    NEED(is_in(m->skin_drag, 0, 1), "skin drag %g: wanted 0 to 1", m->skin_drag);
    NEED(is_in(m->floe_stiffness, 1e3, 1e12), "stiffness between floes %g N/m: wanted 1e3 to 1e12", m->floe_stiffness);
    NEED(is_in(m->floe_friction, 0, 10), "friction between floes %g: wanted 0 to 10", m->floe_friction);
    NEED(is_in(m->wind.density, 0, 10) && is_in(m->wind.skin_drag, 0, 1) && is_in(m->wind.form_drag, 0, 100),
         "wind: air density %g kg/m3, skin drag %g, form drag %g: wanted 0 to 10, 1, 100", m->wind.density, m->wind.skin_drag, m->wind.form_drag);
    NEED(m->tide.n_rows ? m->tide.rows && m->tide.n_rows <= FW_MAX_COURSE : is_in(m->tide.period, 60, 1e9) && is_in(m->tide.minor_ratio, -1, 1),
         "tide: %zu rows, period %g s, minor ratio %g: wanted at most %d rows, or 60 to 1e9 s and -1 to 1", m->tide.n_rows, m->tide.period,
         m->tide.minor_ratio, (int)FW_MAX_COURSE);
    FW_TRY(check_course(&m->tide, msg));
    FW_CHECK(FW_OPTIONAL_EFFECTS || !(m->effects & ~(uint32_t)FW_EFFECTS_CORE), msg, FW_E_UNSUPPORTED,
             "this program was built without the optional effects (FLOEWEAR_OPTIONAL_EFFECTS)");
    if ((m->effects & FW_EFFECT_CRUSH_CONTACT) || m->stiffness_from_pressure) {
        const fw_crush *c = &m->crush;
        NEED(is_in(c->law.pressure, 1e3, 1e9), "crush pressure %g Pa: wanted 1e3 to 1e9", c->law.pressure);
        NEED(is_in(c->law.exponent, 0, 0.8), "exponent of the crush pressure %g: wanted 0 to 0.8", c->law.exponent);
        NEED(!(c->unloading > 0) || is_in(c->unloading, 1, 1e6), "unloading stiffness %g: wanted 1 to 1e6, times force over deepest overlap", c->unloading);
    }
    const char *beyond = fw_model_beyond_fixed_steps(m);
    NEED(m->numerics.scheme == FW_SCHEME_EVENTS || !beyond, "%s: the fixed-step methods have none, wanted the events scheme", beyond);
    NEED(m->n_laws >= 1 && m->n_laws <= FW_MAX_LAWS, "%zu abrasion laws: wanted 1 to %d", m->n_laws, (int)FW_MAX_LAWS);
    FW_TRY(check_laws(m, msg));
    NEED(is_in(m->window, 1e-3, 1e9), "window %g s: wanted 1e-3 to 1e9 s", m->window);
    NEED(is_in(m->accuracy, 1e-4, 0.1), "accuracy %g: wanted 0.01 %% to 10 %%", m->accuracy);
    const fw_numerics *n = &m->numerics;
    NEED(n->scheme == FW_SCHEME_EVENTS || is_in(n->step, 1e-6, 1), "fixed step %g s: wanted 1e-6 to 1 s", n->step);
    NEED(n->order == 0 || (n->order >= 2 && n->order <= 4), "integrator of order %d: wanted 2, 3 or 4", n->order);
    NEED(is_in(n->tolerance, 0, 1) && is_in(n->wear_tolerance, 0, 1) && is_in(n->first_step, 0, 10) && is_in(n->growth, 0, 100),
         "numerics: tolerance %g, wear tolerance %g, first step %g, growth %g: wanted 0 to 1, 1, 10, 100", n->tolerance, n->wear_tolerance,
         n->first_step, n->growth);
    NEED(m->n_arcs >= 72 && m->n_arcs <= 3600, "ring of %zu arcs: wanted 72 to 3600", m->n_arcs);
    NEED(m->n_mixes >= 1 && m->n_mixes <= FW_MAX_MIXES, "%zu thickness mixes: wanted 1 to %d", m->n_mixes,
         (int)FW_MAX_MIXES);
    for (size_t i = 0; i < m->n_mixes; i++) {
        const fw_thickness_mix *x = &m->mixes[i];
        NEED(x->n_classes >= 1 && x->n_classes <= FW_MAX_CLASSES, "thickness mix %zu has %zu classes: wanted 1 to %d",
             i + 1, x->n_classes, (int)FW_MAX_CLASSES);
        for (size_t k = 0; k < x->n_classes; k++)
            NEED(fw_unbreakable_class_exists(x->classes[k].thickness),
                 "thickness %g m: wanted %g to %g m (4h <= sqrt(130h - 11))", x->classes[k].thickness, FW_THICKNESS_MIN,
                 FW_THICKNESS_MAX);
    }
    return FW_OK;
}

void fw_site_free(fw_site *s)
{
    if (!s) return;
    fw_distribution_free(&s->speed);
    fw_distribution_free(&s->concentration);
    fw_distribution_free(&s->direction);
    fw_distribution_free(&s->temperature);
    fw_distribution_free(&s->wind_speed);
    fw_distribution_free(&s->wind_angle);
    for (size_t i = 0; i < s->n_cells; i++) fw_distribution_free(&s->cells[i].direction);
    free(s->cells);
    memset(s, 0, sizeof *s);
}
