#include "effects/floe_contact.h"

#include <stdio.h>

#include "effects/rows.h"

/* Measured, paired on the same ice (3 h windows, Cf 10, accuracy 1 %): depth without floe contact against depth with it, +- 95 %. E is
 * fw_floe_contact_encounters.
 *
 *   7.4 m, h 0.5 to 1.3 m, 1 m/s:    1 % ice (E 0.05) -1.0 +- 0.2 %    2 % -2.6 +- 0.4 %    5 % -6.9 +- 0.4 %    10 % -14 %    20 % -26 %
 *   the same at 0.3 m/s:                              -1.0 +- 0.4 %        -2.8 +- 0.7 %        -6.6 +- 0.7 %         -13 %         -26 %
 *   2 % ice, h 0.3 m:   structures of 2 / 7.4 / 30 / 100 m (E 0.07 / 0.15 / 0.46 / 1.4)     -1.8 / -4.0 / -18 / -49 %
 *   2 % ice, h 1.3 m:                                      (E 0.06 / 0.09 / 0.21 / 0.59)     -0.8 / -1.4 / -5.7 / -23 %
 *
 *   E 0.025:  7.4 m at 0.5 % ice -0.27 +- 0.08 %, 30 m and h 0.3 m at 0.108 % ice -0.50 +- 0.15 %
 *   E 0.0125: 7.4 m at 0.25 %    -0.09 +- 0.06 %, 30 m and h 0.3 m at 0.054 %     -0.16 +- 0.10 %
 *
 * So depth changes by 0.1 to 0.4 of E, whatever the speed: below 1 in 50 by less than 0.5 %. */
static const double NEGLIGIBLE = 0.02;

/* C / mean_area floes on a square metre; 2 D wide, as pairs touch within the mean of their diameters either side. */
double fw_floe_contact_encounters(double concentration, double structure_radius, double mean_diameter, double mean_area)
{
    return concentration / mean_area * 2 * mean_diameter * (2 * structure_radius + mean_diameter);
}

bool fw_floe_contact_can_matter(const fw_scene_facts *f) { return f->n_floes ? f->n_floes > 1 : f->encounters >= NEGLIGIBLE; }

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    (void)m;
    bool it_is = fw_floe_contact_can_matter(f);
    if (f->n_floes)
        snprintf(reason, FW_REASON_SIZE, "%zu floe%s in the scene", f->n_floes, f->n_floes > 1 ? "s" : "");
    else
        snprintf(reason, FW_REASON_SIZE, "a floe on the structure meets about %.2g others at %.3g %% ice%s", f->encounters, 100 * f->concentration.high,
                 it_is ? "" : ": depth changes by less than 0.5 %");
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    (void)m, (void)f, (void)key;
    return NULL; /* switched on where nobody meets it does nothing, and is right */
}

const fw_effect fw_effect_floe_contact = {
    .name = "floe_contact",
    .bit = FW_EFFECT_FLOE_CONTACT,
    .does = "floes push each other (spring, dashpot, friction)",
    .equation = "N = max(0, k d + c d'), c = zeta 2 sqrt(k m_eff), m_eff = mi mj / (mi + mj), d = Ri + Rj - distance",
    .source = "source paper, table 2: k = 2000 kN/m, critical damping",
    .range = "rigid discs: overlaps below a tenth of the smaller radius; beyond, the ledger counts them",
    .limit = "two equal floes head-on, zeta = 1: relative motion as of one of half the mass on the wall, restitution e^-2 = 0.135",
    .needed = "needed where a floe on the structure meets others: more than one in 50 times, in the densest ice, or a scene of two floes",
    .off = "floes pass through each other; depth is smaller (7 % at 5 % ice, 26 % at 20 %)",
    .is_needed = is_needed,
    .refuse = refuse,
};
