/* Wind on a floe: F = 1/2 rho_a (Cs pi R^2 + Cf D f) |W - v| (W - v), f the freeboard.
 *
 * Free drift in still water is where it balances the water's drag. Source: quadratic drag of air on a skin and a side, Leppaeranta, The Drift of
 * Sea Ice (2011); freeboard by Archimedes. */
#ifndef FW_EFFECTS_WIND_H
#define FW_EFFECTS_WIND_H

#include "floewear/scenario.h"

/* 1/2 rho_a (Cs pi R^2 + Cf D f) [kg/m] */
double fw_wind_drag(const fw_wind *w, double ice_density, double water_density, double radius, double thickness);

/* Velocity of free drift relative to the water [m/s], along the wind relative to the water: s = W r / (1 + r), r = sqrt(air / water).
 * air, water: drag coefficients [kg/m]; speed: of the wind relative to the water [m/s]. water = 0: the wind's own speed. */
double fw_wind_free_drift(double air, double water, double speed);

#endif
