#include "effects/deflected_flow.h"

#include <stdio.h>

#include "effects/rows.h"

/* Of the free flow, along the normal at the centre of a floe of radius R that touches: 1 - Rs^2 / (Rs + R)^2. */
static double of_normal(const fw_model *m, double diameter)
{
    double q = m->structure_radius / (m->structure_radius + 0.5 * diameter);
    return 1 - q * q;
}

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = fw_effects_given(f, FW_GIVEN_DEFLECTED_ON);
    snprintf(reason, FW_REASON_SIZE, "%swater.deflected_flow: on; touching floes of %.3g to %.3g m would meet %.2f to %.2f of the flow against the wall",
             it_is ? "" : "no ", f->diameter.low, f->diameter.high, of_normal(m, f->diameter.low), of_normal(m, f->diameter.high));
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    if (!fw_effects_have(m, FW_EFFECT_DEFLECTED_FLOW)) return NULL;
    *key = "water.deflected_flow";
    if (fw_effects_given(f, FW_GIVEN_DEFLECTED_OFF)) return "effects switch on what this key switches off";
    if (!fw_effects_have(m, FW_EFFECT_FORM_DRAG) && !fw_effects_have(m, FW_EFFECT_SKIN_DRAG))
        return "the flow acts on floes by its drag alone, and neither form drag nor skin drag is on";
    *key = "current.speed";
    if (!(f->speed.high > 0)) return "deflected flow cannot be on: there is no current to deflect";
    return NULL;
}

const fw_effect fw_effect_deflected_flow = {
    .name = "deflected_flow",
    .bit = FW_EFFECT_DEFLECTED_FLOW,
    .does = "the current parts before the structure and goes round it",
    .equation = "u = U (1 - Rs^2 cos(2 phi) / r^2), v = -U Rs^2 sin(2 phi) / r^2, at the floe's centre",
    .source = "Lamb, Hydrodynamics, art. 68: potential flow round a cylinder",
    .range = "upstream of the structure's axis; behind it the flow separates: there the cross-flow back is left out, in the wake it is no good",
    .limit = "touching floe's centre, D 2.5 / 5 / 10 m on 7.4 m: 0.44 / 0.64 / 0.82 of the flow along the normal, 1.56 / 1.36 / 1.18 along the wall",
    .needed = "needed where water.deflected_flow: on asks for it: no scene calls for it by itself",
    .off = "the current is the same everywhere, as if there were no structure",
    .is_needed = is_needed,
    .refuse = refuse,
};
