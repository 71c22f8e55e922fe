/* The pressure above which ice crushes: limit(A) = P0 (A / 1 m2)^-q, A = b h. What wears is min(sigma, limit), so the force that
 * counts is min(N, P0 A^(1 - q)). It caps sigma in the wear alone: N and the motion know nothing of it.
 *
 * Constant (q = 0) or a pressure-area law like that of ISO 19906 for local pressures of massive ice, 7.4 MPa and q = 0.7 (there up to 10 m2;
 * patches here are smaller). With q < 1 the patch of a touch, b ~ t^(1/2), always begins above the limit (N > 0 = P0 0^(1 - q)) and falls
 * below it once:
 *
 *     rate                        capped: sigma^m ~ t^(-q m/2), integrable for q m < 2, whatever sigma does without a limit
 *       |\                        open:   sigma^m ~ t^(-m/2) from the crossing on, which any m survives
 *       | `.___
 *       |  :   `---..___          The crossing is found on the interval's own polynomials and both sides get nodes of their own,
 *       touch            time     so the kink costs nothing beyond what the polynomials cost. */
#ifndef FW_ABRASION_LIMIT_H
#define FW_ABRASION_LIMIT_H

#include "abrasion/power.h"
#include "floewear/scenario.h"

typedef struct fw_wear_limit {
    fw_pressure_law law;
    double          structure_radius; /* for the chord [m] */
    fw_power        power;            /* A^(1 - q) */
} fw_wear_limit;

/* Force at which a patch of that area crushes [N]; 0 for none. */
static inline double fw_limit_force(const fw_wear_limit *l, double area)
{
    return l->law.pressure * (l->law.exponent == 0 ? area : fw_power_of(&l->power, area));
}

#endif
