#include "effects/effects.h"

#include <string.h>

#include "effects/rows.h"

/* In the order of their bits, the core ones first. */
static const fw_effect *const EFFECTS[] = {
    &fw_effect_floe_contact,   &fw_effect_friction,       &fw_effect_rotation,   &fw_effect_form_drag,
    &fw_effect_skin_drag,      &fw_effect_wind,           &fw_effect_added_mass, &fw_effect_tide,
    &fw_effect_deflected_flow, &fw_effect_crushing_limit, &fw_effect_ice_on_ice, &fw_effect_crush_contact,
};
enum { N_EFFECTS = sizeof EFFECTS / sizeof EFFECTS[0] };

size_t fw_effects_list(const fw_effect *const **effects)
{
    *effects = EFFECTS;
    return N_EFFECTS;
}

const fw_effect *fw_effects_find(const char *name)
{
    for (size_t i = 0; i < N_EFFECTS; i++)
        if (strcmp(EFFECTS[i]->name, name) == 0) return EFFECTS[i];
    return NULL;
}

uint32_t fw_effects_auto(const fw_model *m, const fw_scene_facts *f)
{
    uint32_t set = 0;
    char     reason[FW_REASON_SIZE];
    for (size_t i = 0; i < N_EFFECTS; i++)
        if (EFFECTS[i]->is_needed(m, f, reason)) set |= (uint32_t)EFFECTS[i]->bit;
    return set;
}

const char *fw_effects_refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    for (size_t i = 0; i < N_EFFECTS; i++) {
        const char *why = EFFECTS[i]->refuse(m, f, key);
        if (why) return why;
    }
    return NULL;
}
