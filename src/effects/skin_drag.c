#include "effects/skin_drag.h"

#include <stdio.h>

#include "effects/rows.h"

double fw_skin_drag_coefficient(double water_density, double skin_drag, double radius)
{
    return 0.5 * water_density * skin_drag * 3.14159265358979323846 * radius * radius;
}

/* 1/2 rho_w Cs pi R^2 over 1/2 rho_w Cf D h */
static double over_form_drag(const fw_model *m, double aspect) { return 3.14159265358979323846 * m->skin_drag / (2 * m->form_drag * aspect); }

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool is_given = fw_effects_given(f, FW_GIVEN_SKIN_DRAG), it_is = m->skin_drag > 0 && (is_given || !(m->form_drag > 0));
    if (!(m->skin_drag > 0))
        snprintf(reason, FW_REASON_SIZE, "water.skin_drag = 0");
    else if (m->form_drag > 0)
        snprintf(reason, FW_REASON_SIZE, "%s; a coefficient of %g is %.2g to %.2g %% of the form drag", is_given ? "water.skin_drag is given" : "no water.skin_drag",
                 m->skin_drag, 100 * over_form_drag(m, f->aspect.high), 100 * over_form_drag(m, f->aspect.low));
    else
        snprintf(reason, FW_REASON_SIZE, "%s: coefficient %g", is_given ? "water.skin_drag is given" : "form drag 0: nothing else carries floes on", m->skin_drag);
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    (void)f;
    *key = "water.skin_drag";
    if (fw_effects_have(m, FW_EFFECT_SKIN_DRAG) && !(m->skin_drag > 0)) return "skin drag cannot be on: its coefficient is 0";
    return NULL;
}

const fw_effect fw_effect_skin_drag = {
    .name = "skin_drag",
    .bit = FW_EFFECT_SKIN_DRAG,
    .does = "the water drags floes by their lower faces, and brakes their spin",
    .equation = "F = 1/2 rho_w Cs pi R^2 |u - v| (u - v), torque -1/2 rho_w Cs pi R^4 w sqrt((3 V / 4)^2 + (2 R w / 5)^2), V = |u - v|",
    .source = "Leppaeranta, The Drift of Sea Ice (2011): Cs = 0.0055 under ice",
    .range = "quadratic stress on a flat face; torque 0 to 6 % above the integral over it; what spin adds to the force is left out (36 % at R w = V)",
    .limit = "slow spin (3/8) pi rho_w Cs R^4 V w, spin alone (pi/5) rho_w Cs R^5 w^2; free flight as under form drag",
    .needed = "needed where water.skin_drag is given, or where no form drag carries floes on",
    .off = "the water acts on a floe's side alone, and spin is not braked",
    .is_needed = is_needed,
    .refuse = refuse,
};
