/* Flow deflected round the structure: potential flow round a cylinder, seen at the floe's centre.
 *
 * With r, phi polar and phi = 0 along the current: u = U (1 - Rs^2 cos(2 phi) / r^2), v = -U Rs^2 sin(2 phi) / r^2. At a touching floe's centre the
 * part along the normal is (1 - Rs^2/r^2) of the free one, the part along the wall (1 + Rs^2/r^2). Behind the structure's axis the water separates:
 * there the cross-flow back to the axis is left out, the rest kept. No good within the wake. Source: Lamb, Hydrodynamics, art. 68. */
#ifndef FW_EFFECTS_DEFLECTED_FLOW_H
#define FW_EFFECTS_DEFLECTED_FLOW_H

/* Water velocity over (ux, uy), the free one, at (x, y) outside or inside the structure (where its rim's is taken). */
static inline void fw_deflected_flow(double structure_radius, double ux, double uy, double x, double y, double *vx, double *vy)
{
    double r2 = x * x + y * y, a2 = structure_radius * structure_radius, q = r2 > a2 ? a2 / r2 : 1;
    double inv = r2 > 0 ? 1 / r2 : 0, along = ux * x + uy * y, across = ux * y - uy * x; /* U r cos phi, U r sin phi */
    /* deflection: -U q (cos 2 phi, sin 2 phi) in the frame of the current */
    double c2 = along * along - across * across, u2 = ux * ux + uy * uy, s2 = 2 * along * across;
    double du = u2 > 0 ? -q * c2 * inv / u2 : 0, dv = u2 > 0 && along < 0 ? -q * s2 * inv / u2 : 0; /* over U, along and to the left */
    *vx = ux + ux * du - uy * dv, *vy = uy + uy * du + ux * dv;
}

#endif
