#include <math.h>
#include <stdio.h>

#include "effects/rows.h"

/* The way through the water on which a floe loses half its speed against it, ln 2 / K, K = rho_w Cf D h / (2 m), m = rho_i pi R^2 h. */
static double half_way(const fw_model *m, double diameter)
{
    return log(2) * m->ice_density * 3.14159265358979323846 * diameter / (2 * m->water_density * m->form_drag);
}

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = m->form_drag > 0;
    if (it_is)
        snprintf(reason, FW_REASON_SIZE, "coefficient %g: floes of %.3g to %.3g m take up half the current's speed in %.2g to %.2g m", m->form_drag,
                 f->diameter.low, f->diameter.high, half_way(m, f->diameter.low), half_way(m, f->diameter.high));
    else
        snprintf(reason, FW_REASON_SIZE, "coefficient 0");
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    (void)f;
    *key = "water.form_drag";
    if (fw_effects_have(m, FW_EFFECT_FORM_DRAG) && !(m->form_drag > 0)) return "form drag cannot be on: its coefficient is 0";
    return NULL;
}

const fw_effect fw_effect_form_drag = {
    .name = "form_drag",
    .bit = FW_EFFECT_FORM_DRAG,
    .does = "the current drags floes by their sides",
    .equation = "F = 1/2 rho_w Cf D h |u - v| (u - v)",
    .source = "source paper, table 2: drag force coefficient 10, without area or unit; D h is this project's reading",
    .range = "literature for floes' sides is about 0.9; 10 stands for all that the water does to a floe",
    .limit = "free flight: speed through the water v0 / (1 + K v0 t), way ln(1 + K v0 t) / K, K = rho_w Cf D h / (2 m)",
    .needed = "needed where Cf > 0: it presses floes on the structure and carries them on",
    .off = "floes keep their speed, unless skin drag or wind changes it",
    .is_needed = is_needed,
    .refuse = refuse,
};
