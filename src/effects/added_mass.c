#include "effects/added_mass.h"

#include <math.h>
#include <stdio.h>

#include "effects/rows.h"

double fw_added_mass_share(double radius, double draft)
{
    double eps = draft / radius, e2 = 1 - eps * eps, b0;
    if (fabs(e2) < 1e-4) { /* near the sphere both forms are 0/0: b0 = 2/3 (1 - e^2/5) to first order */
        b0 = 2.0 / 3 * (1 - 0.2 * e2);
    } else if (e2 > 0) {
        double e = sqrt(e2);
        b0 = eps * asin(e) / (e2 * e) - eps * eps / e2;
    } else { /* deeper than wide, a prolate spheroid that moves sideways: the same integral with e = i g */
        double g = sqrt(-e2);
        b0 = eps * eps / -e2 - eps * asinh(g) / (-e2 * g);
    }
    return b0 / (2 - b0);
}

/* Of the floe's mass: share of the displaced one, which is the floe's own. aspect: thickness over radius. */
static double of_aspect(const fw_model *m, double aspect) { return fw_added_mass_share(1, aspect * m->ice_density / m->water_density); }

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = fw_effects_given(f, FW_GIVEN_ADDED_MASS_ON);
    snprintf(reason, FW_REASON_SIZE, "%swater.added_mass: on; it adds %.2g to %.2g %% to a floe's inertia", it_is ? "" : "no ",
             100 * of_aspect(m, f->aspect.low), 100 * of_aspect(m, f->aspect.high));
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "water.added_mass";
    if (fw_effects_have(m, FW_EFFECT_ADDED_MASS) && fw_effects_given(f, FW_GIVEN_ADDED_MASS_OFF))
        return "effects switch on what this key switches off";
    return NULL;
}

const fw_effect fw_effect_added_mass = {
    .name = "added_mass",
    .bit = FW_EFFECT_ADDED_MASS,
    .does = "the water round a floe has to be moved with it",
    .equation = "(1 + C) m dv/dt = F; C = b0 / (2 - b0), b0 = sqrt(1 - e^2) asin(e) / e^3 - (1 - e^2) / e^2, e^2 = 1 - (draft / R)^2",
    .source = "Lamb, Hydrodynamics, art. 114: spheroid that moves edgewise",
    .range = "a floe alone in deep water, no waves; a disc has sharper edges than its spheroid",
    .limit = "draft -> 0: 0; a sphere: 1/2; 0.127 for D = 5 m, h = 0.5 m, 0.280 for D = 4h (900 in 1025 kg/m3)",
    .needed = "needed where water.added_mass: on asks for it: no scene calls for it by itself",
    .off = "a floe has its own mass alone",
    .is_needed = is_needed,
    .refuse = refuse,
};
