/* Form drag of the current on a floe's side area D h, and the exact flow of a floe that feels nothing else.
 *
 * F = 1/2 rho_w Cf D h |u - v| (u - v). With r = v - u the direction of r stays and its size follows
 * r(t) = r0 / (1 + K r0 t), distance ln(1 + K r0 t) / K, K = rho_w Cf D h / (2 m). Source: the source paper's drag force coefficient 10;
 * the area D h is this project's reading. */
#ifndef FW_PHYSICS_DRAG_H
#define FW_PHYSICS_DRAG_H

/* 1/2 rho_w Cf D h [kg/m]. */
double fw_drag_coefficient(double water_density, double form_drag, double diameter, double thickness);

typedef struct fw_drag_flow {
    double distance; /* along r0 [m] */
    double speed;    /* |r| after t [m/s] */
} fw_drag_flow;

/* K [1/m] >= 0, r0 >= 0 [m/s], t >= 0 [s]; K = 0 is uniform motion. */
fw_drag_flow fw_drag_free(double K, double r0, double t);

#endif
