#include "effects/effects.h"

#include <stdio.h>
#include <string.h>

static const fw_effect EFFECTS[] = {
    {"floe_contact", FW_EFFECT_FLOE_CONTACT, "floes push each other (spring, dashpot, friction)",
     "needed wherever more than one floe can be near the structure", "floes pass through each other"},
    {"friction", FW_EFFECT_FRICTION, "viscous Coulomb friction on structure and between floes",
     "needed where mu > 0: it spins floes up, and a rolling floe stops sliding",
     "contacts slide freely; wear is larger"},
    {"rotation", FW_EFFECT_ROTATION, "floes spin about their centres",
     "needed with friction: a locked floe slides all the way and wears 3 to 43 times more",
     "spin is locked at its start"},
    {"form_drag", FW_EFFECT_FORM_DRAG, "the current drags floes by their sides, 1/2 rho_w Cf D h |u - v| (u - v)",
     "needed where Cf > 0: it presses floes on the structure and carries them on", "floes keep their speed"},
};

size_t fw_effects_list(const fw_effect **effects)
{
    *effects = EFFECTS;
    return sizeof EFFECTS / sizeof EFFECTS[0];
}

const fw_effect *fw_effects_find(const char *name)
{
    for (size_t i = 0; i < sizeof EFFECTS / sizeof EFFECTS[0]; i++)
        if (strcmp(EFFECTS[i].name, name) == 0) return &EFFECTS[i];
    return NULL;
}

bool fw_effects_needed(const fw_effect *e, const fw_model *m, char *reason, size_t n_reason)
{
    bool is_needed = true;
    switch (e->bit) {
    case FW_EFFECT_FLOE_CONTACT: snprintf(reason, n_reason, "a field of floes: they meet before the structure"); break;
    case FW_EFFECT_FRICTION:
        is_needed = m->friction > 0 && m->slip_damping_ratio > 0 && m->damping_ratio > 0;
        snprintf(reason, n_reason, "friction coefficient %g, slip damping %g of the dashpot", m->friction,
                 m->slip_damping_ratio);
        break;
    case FW_EFFECT_ROTATION:
        is_needed = m->friction > 0 && m->slip_damping_ratio > 0 && m->damping_ratio > 0;
        snprintf(reason, n_reason,
                 is_needed ? "friction turns floes until they roll" : "nothing turns a floe without friction");
        break;
    case FW_EFFECT_FORM_DRAG:
        is_needed = m->form_drag > 0 && m->water_density > 0;
        snprintf(reason, n_reason, "form drag coefficient %g on the side area D h", m->form_drag);
        break;
    default: return false;
    }
    return is_needed;
}

uint32_t fw_effects_auto(const fw_model *m)
{
    uint32_t set = 0;
    char     reason[128];
    for (size_t i = 0; i < sizeof EFFECTS / sizeof EFFECTS[0]; i++)
        if (fw_effects_needed(&EFFECTS[i], m, reason, sizeof reason)) set |= EFFECTS[i].bit;
    return set;
}
