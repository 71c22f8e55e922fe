/* Crushing of ice: what a nominal area b h carries while it crushes, and closed forms of one head-on push.
 *
 *   p = P0 (b h / 1 m2)^-q,  F = p b h = P0 (b h)^(1-q)            loading: b the chord of the overlap, h the thickness; p below 0.01 m2 as there
 *   N = F(D) (1 - kappa (D - d) / D) + c d' >= 0,  d < D           on the flat that the deepest overlap D has left, c critical
 *
 * Below, D is taken to be far beyond D0.
 * Shallow lens, b = 2 sqrt(2 R* d) with 1/R* = 1/R + 1/Rs (the exact lens is used where forces act; it is within 1 %):
 *   push       int F dd = F(D) D / e,  e = (3 - q)/2, so m v^2 / 2 = F(D) D / e gives the deepest overlap
 *   rebound    F(D) D / (2 kappa) is in store, and a critically damped line from rest lets go at exp(-1) of the speed of that: after 1/w, with
 *              w^2 = kappa F(D) / (D m), so restitution = sqrt(e / (2 kappa)) exp(-1)
 *   spring     the critically damped one is deepest at v / (w exp 1): equal D takes k = m v^2 / (exp 1 D)^2; for q = 0
 *              k = e^-2 (8/3)^(4/3) (m v^2)^(-1/3) (2 R*)^(2/3) (p h)^(4/3)
 * Source: a continuum model (material points, crushable foam) of the source paper's table cases: N within 2 % of p b h on loading,
 * unloading stiff. p of about 1.1 MPa is what the paper's stiffness means. */
#ifndef FW_PHYSICS_CRUSH_H
#define FW_PHYSICS_CRUSH_H

#include "floewear/scenario.h"

/* Pressure-area laws are fitted to areas of 0.01 m2 and more. On smaller ones p stays: carried on, p ~ A^-0.7 lets a floe of 10 t rest on 1e-12 m. */
#define FW_CRUSH_LEAST_AREA 0.01 /* [m2] */

/* Ice is elastic before it crushes: no place of a rim has a deepest overlap of less than D0, up to which its line goes to N = 0 at d = 0, kappa = 1. The chord
 * b0 at which a line contact of plane-strain modulus E comes to a mean pressure p is 16 p R* / (pi E) (Hertz: (b / 2)^2 = 4 N R* / (pi h E)), which two circles
 * have at D0 = b0^2 / (8 R*) = 32 R* (p / (pi E))^2: 2 to 8e-8 m at 1.1 MPa, 10 GPa, R* of 0.5 to 2 m. */
#define FW_CRUSH_ELASTIC 3e-8 /* D0 [m] */

/* kappa of a place where D was deepest. Crushing moves the end of the line, D (1 - 1/kappa), on from 0, by 1 - 1/kappa of the way past D0. */
static inline double fw_crush_kappa(double kappa, double D)
{
    return D > FW_CRUSH_ELASTIC ? 1 / (1 - (1 - 1 / kappa) * (1 - FW_CRUSH_ELASTIC / D)) : 1;
}

/* Force that an area b h [m2] carries while it crushes [N], and its pressure [Pa]. */
double fw_crush_force(const fw_pressure_law *p, double area);
double fw_crush_pressure(const fw_pressure_law *p, double area);

/* kappa of the line for a restitution of a head-on push. */
double fw_crush_unloading(const fw_pressure_law *p, double restitution);

/* Deepest overlap [m] of a head-on push of mass m at speed v against R* = reduced radius; of ice h thick. */
double fw_crush_depth(const fw_pressure_law *p, double m, double v, double reduced_radius, double h);
/* Chord of a shallow lens [m]. */
double fw_crush_chord(double reduced_radius, double depth);

/* k [N/m] of the critically damped spring that is as deep. m_eff: mi mj / (mi + mj) between floes, h the thinner one. */
double fw_crush_stiffness(const fw_pressure_law *p, double m_eff, double v, double reduced_radius, double h);

#endif
