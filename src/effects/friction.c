#include <stdio.h>

#include "effects/friction.h"
#include "effects/rows.h"

double fw_friction_largest(const fw_model *m, const fw_scene_facts *f)
{
    double between = fw_effects_given(f, FW_GIVEN_FLOE_FRICTION) ? m->floe_friction : 0;
    return between > m->friction ? between : m->friction;
}

static bool has_viscous_part(const fw_model *m) { return m->slip_damping_ratio > 0 && m->damping_ratio > 0; }

bool fw_friction_flat_turns(const fw_model *m) { return m->crush.has_flat && has_viscous_part(m); }

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    double mu = fw_friction_largest(m, f);
    bool   it_is = mu > 0 && has_viscous_part(m);
    snprintf(reason, FW_REASON_SIZE, "%s: coefficient %g, slip damping %g of a dashpot of %g of the critical one",
             it_is ? "it spins floes up until they roll" : "there is none", mu, m->slip_damping_ratio, m->damping_ratio);
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    if (!fw_effects_have(m, FW_EFFECT_FRICTION)) return NULL;
    *key = "contact.friction";
    if (!(fw_friction_largest(m, f) > 0)) return "friction cannot be on: its coefficient is 0";
    *key = m->damping_ratio > 0 ? "contact.slip_damping_ratio" : "contact.damping_ratio";
    if (!has_viscous_part(m)) return "friction cannot be on: it acts through its viscous part ct |vt|, and ct is 0";
    return NULL;
}

const fw_effect fw_effect_friction = {
    .name = "friction",
    .bit = FW_EFFECT_FRICTION,
    .does = "viscous Coulomb friction on the structure and between floes",
    .equation = "Ft = -sign(vt) min(ct |vt|, mu N), ct = slip_damping_ratio c, torque -R Ft",
    .source = "source paper, table 1: mu = 0.1; ct is not in it",
    .range = "dry and wet concrete 0.05 to 0.3; one coefficient for rest and sliding",
    .limit = "mu = 0: nothing turns a floe; a sliding disc loses 3 mu times its normal impulse over m in slip, then rolls",
    .needed = "needed where mu > 0: it spins floes up, and a rolling floe stops sliding",
    .off = "contacts slide freely; wear is larger",
    .is_needed = is_needed,
    .refuse = refuse,
};
