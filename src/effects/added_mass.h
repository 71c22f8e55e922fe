/* Added mass of a floe that moves edgewise: the water round a spheroid of the floe's radius and draft.
 *
 * eps = draft / R, e^2 = 1 - eps^2, b0 = sqrt(1 - e^2) asin(e) / e^3 - (1 - e^2) / e^2, C = b0 / (2 - b0) of the displaced mass, which is the
 * floe's own. Source: Lamb, Hydrodynamics, art. 114. Limits: eps -> 0 gives 0, a sphere 1/2. Spin about the axis moves no water. */
#ifndef FW_EFFECTS_ADDED_MASS_H
#define FW_EFFECTS_ADDED_MASS_H

/* Added mass over the floe's mass; radius, draft [m] > 0. Deeper than wide it is the prolate spheroid that moves sideways, towards 1. */
double fw_added_mass_share(double radius, double draft);

#endif
