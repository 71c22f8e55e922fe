/* The rows of the list of effects, each in the file of its name. */
#ifndef FW_EFFECTS_ROWS_H
#define FW_EFFECTS_ROWS_H

#include "effects/effects.h"

extern const fw_effect fw_effect_floe_contact, fw_effect_friction, fw_effect_rotation, fw_effect_form_drag, fw_effect_skin_drag,
    fw_effect_wind, fw_effect_added_mass, fw_effect_tide, fw_effect_deflected_flow, fw_effect_crushing_limit,
    fw_effect_ice_on_ice, fw_effect_crush_contact;

#endif
