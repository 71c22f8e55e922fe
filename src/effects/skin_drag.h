/* Drag of the water on a floe's lower face: F = 1/2 rho_w Cs pi R^2 |u - v| (u - v), and a torque against spin.
 *
 * The torque of |q| q over the face, q = V + w x r, has two limits: slow spin (3/8) pi rho Cs R^4 V w, spin alone (pi/5) rho Cs R^5 w^2; in
 * between T = 1/2 rho Cs pi R^4 w sqrt((3 V / 4)^2 + (2 R w / 5)^2), 0 to 6.0 % more than the integral, most at R w = 1.6 V (tests/effects). What
 * spin does to the force is left out: the integral gives 0.4 % more at R w = 0.1 V, 5 % at 0.36 V, 36 % at R w = V. Source: quadratic stress on the face, Leppaeranta, The Drift of Sea Ice (2011). */
#ifndef FW_EFFECTS_SKIN_DRAG_H
#define FW_EFFECTS_SKIN_DRAG_H

#include <math.h>

/* 1/2 rho_w Cs pi R^2 [kg/m] */
double fw_skin_drag_coefficient(double water_density, double skin_drag, double radius);

/* Torque over -spin [N m s] = coefficient R^2 sqrt((3 V / 4)^2 + (2 R w / 5)^2), V speed through the water. */
static inline double fw_skin_drag_torque_rate(double coefficient, double radius, double speed, double spin)
{
    double a = 0.75 * speed, b = 0.4 * radius * spin;
    return coefficient * radius * radius * sqrt(a * a + b * b);
}

#endif
