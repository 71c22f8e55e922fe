#include <stdio.h>

#include "effects/friction.h"
#include "effects/rows.h"

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    char why[FW_REASON_SIZE];
    bool rubs = fw_effect_friction.is_needed(m, f, why), has_flat = fw_effects_given(f, FW_GIVEN_LAW_CRUSH) && fw_friction_flat_turns(m);
    snprintf(reason, FW_REASON_SIZE,
             rubs       ? "friction turns floes until they roll; locked they wear 43 and 4 times more (2.5 m floe, 1 m and 3 m off the middle)"
             : has_flat ? "the flat of ice that crushes turns floes along the wall, without friction too (coefficient %g)"
                        : "nothing turns a floe without friction (coefficient %g)",
             m->friction);
    return rubs || has_flat;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "contact.flat";
    if (!fw_effects_have(m, FW_EFFECT_ROTATION) && fw_effects_have(m, FW_EFFECT_CRUSH_CONTACT) && fw_effects_given(f, FW_GIVEN_FLAT) &&
        m->crush.has_flat)
        return "the flat's moment acts on spin, and effects lock it (rotation is off)";
    return NULL;
}

const fw_effect fw_effect_rotation = {
    .name = "rotation",
    .bit = FW_EFFECT_ROTATION,
    .does = "floes spin about their centres",
    .equation = "I dw/dt = sum of torques, I = m R^2 / 2",
    .source = "rigid disc; the source paper does not say whether its floes turn",
    .range = "discs; a floe with corners or a flat turns less easily (crush_contact has a flat)",
    .limit = "without torque spin is constant; sliding ends on a rolling floe, slip impulse J/m + J R^2/I = 3 J/m",
    .needed = "needed with friction, or a flat: a locked floe slides all the way and wears 3 to 43 times more",
    .off = "spin is locked at its start",
    .is_needed = is_needed,
    .refuse = refuse,
};
