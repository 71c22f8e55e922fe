#include <stdio.h>

#include "effects/floe_contact.h"
#include "effects/rows.h"

static bool has_own_stiffness(const fw_model *m, const fw_scene_facts *f)
{
    return fw_effects_given(f, FW_GIVEN_FLOE_STIFFNESS) && (m->stiffness_from_pressure || m->floe_stiffness != m->stiffness);
}

static bool has_own_friction(const fw_model *m, const fw_scene_facts *f)
{
    return fw_effects_given(f, FW_GIVEN_FLOE_FRICTION) && m->floe_friction != m->friction;
}

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool differs = has_own_stiffness(m, f) || has_own_friction(m, f), it_is = differs && fw_floe_contact_can_matter(f);
    if (m->stiffness_from_pressure)
        snprintf(reason, FW_REASON_SIZE, "stiffness from pressure; friction %g between floes, %g on the structure", m->floe_friction, m->friction);
    else if (!differs)
        snprintf(reason, FW_REASON_SIZE, "floes meet as they meet the structure: %.4g N/m, friction %g", m->stiffness, m->friction);
    else
        snprintf(reason, FW_REASON_SIZE, "%.4g N/m and friction %g between floes, %.4g N/m and %g on the structure%s", m->floe_stiffness, m->floe_friction,
                 m->stiffness, m->friction, it_is ? "" : "; but floes hardly meet here");
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "contact.floe_stiffness";
    if (m->stiffness_from_pressure && fw_effects_given(f, FW_GIVEN_FLOE_STIFFNESS))
        return "contact.stiffness: from_pressure says already how stiff two floes meet, wanted one of them";
    if (!fw_effects_have(m, FW_EFFECT_ICE_ON_ICE)) return NULL;
    *key = "effects";
    if (!fw_effects_have(m, FW_EFFECT_FLOE_CONTACT)) return "ice_on_ice cannot be on: floes do not touch each other (floe_contact is off)";
    if (!has_own_stiffness(m, f) && !has_own_friction(m, f))
        return "ice_on_ice cannot be on: contact.floe_stiffness and contact.floe_friction are the structure's: nothing would change";
    *key = "contact.floe_friction";
    if (!has_own_stiffness(m, f) && !fw_effects_have(m, FW_EFFECT_FRICTION)) return "ice_on_ice would change the friction alone, and friction is off";
    return NULL;
}

const fw_effect fw_effect_ice_on_ice = {
    .name = "ice_on_ice",
    .bit = FW_EFFECT_ICE_ON_ICE,
    .does = "two floes meet with a stiffness and a friction of their own",
    .equation = "as floe_contact and friction, with k and mu between floes",
    .source = "the user's; the source paper has one stiffness and one friction",
    .range = "as floe_contact; damping ratios stay those of contact",
    .limit = "equal to the structure's: bit for bit as without it",
    .needed = "needed where contact.floe_stiffness or contact.floe_friction differs from the structure's and floes meet",
    .off = "floes meet each other as they meet the structure",
    .is_needed = is_needed,
    .refuse = refuse,
};
