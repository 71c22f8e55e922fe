#include <stdio.h>

#include "effects/friction.h"
#include "effects/rows.h"

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = fw_effects_given(f, FW_GIVEN_LAW_CRUSH);
    if (it_is)
        snprintf(reason, FW_REASON_SIZE, "contact.law: crush; %.3g MPa at 1 m2, exponent %g, %s flat", 1e-6 * m->crush.law.pressure, m->crush.law.exponent,
                 m->crush.has_flat ? "with a" : "without");
    else if (m->stiffness_from_pressure)
        snprintf(reason, FW_REASON_SIZE, "contact.law: spring, as stiff as %.3g MPa at 1 m2 would crush", 1e-6 * m->crush.law.pressure);
    else
        snprintf(reason, FW_REASON_SIZE, "contact.law: spring of %.4g N/m", m->stiffness);
    return it_is;
}

static const char NO_PRESSURE[] = "a spring of given stiffness has no pressure; wanted contact.law: crush, or contact.stiffness: from_pressure";

/* Keys that act under the crushing law alone, while the spring is on. */
static const char *refuse_beside_spring(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "contact.stiffness";
    if (m->stiffness_from_pressure && !fw_effects_given(f, FW_GIVEN_PRESSURE)) return "from_pressure needs contact.pressure, the pressure that the spring stands for";
    *key = "contact.pressure";
    if (!m->stiffness_from_pressure && fw_effects_given(f, FW_GIVEN_PRESSURE)) return NO_PRESSURE;
    *key = "contact.pressure_exponent";
    if (!m->stiffness_from_pressure && fw_effects_given(f, FW_GIVEN_PRESSURE_EXPONENT)) return NO_PRESSURE;
    *key = "contact.flat";
    if (fw_effects_given(f, FW_GIVEN_FLAT) && m->crush.has_flat) return "a spring leaves no flat behind; wanted contact.law: crush";
    *key = "contact.unloading_stiffness";
    if (fw_effects_given(f, FW_GIVEN_UNLOADING)) return "a spring unloads as it loads; wanted contact.law: crush";
    return NULL;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    bool is_on = fw_effects_have(m, FW_EFFECT_CRUSH_CONTACT);
    *key = "contact.law";
    if (is_on && fw_effects_given(f, FW_GIVEN_LAW_SPRING)) return "effects switch on crush_contact, and this key says spring";
    if (!is_on && fw_effects_given(f, FW_GIVEN_LAW_CRUSH)) return "this key says crush, and effects switch off crush_contact";
    *key = "current.speed";
    if (m->stiffness_from_pressure && !(f->speed.high > 0)) return "contact.stiffness: from_pressure goes with the current's speed to the -2/3, and there is no current";
    if (!is_on) return refuse_beside_spring(m, f, key);
    *key = "contact.flat";
    if (fw_effects_given(f, FW_GIVEN_FLAT) && m->crush.has_flat && !fw_friction_flat_turns(m))
        return "the flat's moment is viscous below its cap, by slip_damping_ratio times the dashpot, and that is 0";
    return NULL;
}

const fw_effect fw_effect_crush_contact = {
    .name = "crush_contact",
    .bit = FW_EFFECT_CRUSH_CONTACT,
    .does = "the structure crushes a flat into a floe's rim, which the floe keeps and comes back on",
    .equation = "loading N = P0 (b h)^(1 - q), b the chord of the deepest overlap; unloading along a stiff line; moment of the flat up to N b / 2",
    .source = "fitted to a continuum prototype (material points, crushable foam) of the source paper's four table cases",
    .range = "structure contacts; N = p b h within 2 %; p about 1.1 MPa for floes (cone tests 4 to 10 MPa: p(A))",
    .limit = "head-on, no drag: d_max = [m v^2 / ((8/3) sqrt(2 R*) p h)]^(2/3), N_max = 2 p h sqrt(2 R* d_max), 1/R* = 1/R + 1/Rs",
    .needed = "needed where contact.law: crush asks for it",
    .off = "contacts are springs and dashpots, which leave no trace on a floe",
    .is_needed = is_needed,
    .refuse = refuse,
};
