#include <stdio.h>

#include "effects/rows.h"

/* From this exponent on the load of a touch has no bound: sigma^m ~ t^(-m/2). */
static const double UNBOUNDED = 2;

static double largest_exponent(const fw_model *m)
{
    double most = 0;
    for (size_t i = 0; i < m->n_laws; i++)
        if (m->laws[i].exponent > most) most = m->laws[i].exponent;
    return most;
}

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = fw_effects_given(f, FW_GIVEN_CRUSHING_LIMIT);
    if (it_is)
        snprintf(reason, FW_REASON_SIZE, "abrasion.crushing_limit of %.3g MPa at 1 m2, exponent %.3g", 1e-6 * m->crushing_limit.pressure,
                 m->crushing_limit.exponent);
    else
        snprintf(reason, FW_REASON_SIZE, "no abrasion.crushing_limit; wear goes with pressure to the %.4g, which a touch bears below %g", largest_exponent(m),
                 UNBOUNDED);
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    (void)f;
    *key = "abrasion.laws";
    if (!fw_effects_have(m, FW_EFFECT_CRUSHING_LIMIT) && largest_exponent(m) >= UNBOUNDED)
        return "an exponent of 2 and above: the wear of a first touch is infinite without a crushing limit (abrasion.crushing_limit)";
    return NULL;
}

const fw_effect fw_effect_crushing_limit = {
    .name = "crushing_limit",
    .bit = FW_EFFECT_CRUSHING_LIMIT,
    .does = "ice under the contact crushes: it wears with this pressure at most",
    .equation = "sigma = min(N / (b h), P0 (A / 1 m2)^-q), A = b h",
    .source = "pressure-area form of ISO 19906; P0 and q are the site's",
    .range = "acts in the wear alone, the motion does not feel it; 0 <= q < 1",
    .limit = "P0 -> infinity: as without it; P0 below every pressure, q = 0: load P0^m times the path",
    .needed = "needed where abrasion.crushing_limit is given; an abrasion law with an exponent of 2 or more cannot do without",
    .off = "pressures of a first touch wear without bound",
    .is_needed = is_needed,
    .refuse = refuse,
};
