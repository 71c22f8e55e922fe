/* Inside the kernel only: what water and air do to a floe, besides contacts. An effect that is off is a flag that is constant over a run. */
#ifndef FW_KERNEL_FORCES_H
#define FW_KERNEL_FORCES_H

#include "effects/deflected_flow.h"
#include "effects/skin_drag.h"
#include "kernel/cluster.h"

/* Does a floe in no contact fly by the closed form of its drag? Else it is a cluster of its own, stepped by the method. */
static inline bool fw_has_flight(const fw_setup *s) { return !s->has_wind && !s->has_deflection; }

/* Water where a floe's centre is [m/s]. */
static inline void fw_water_at(const fw_setup *s, double x, double y, double *ux, double *uy)
{
    *ux = s->flow.ux, *uy = s->flow.uy;
    if (s->has_deflection) fw_deflected_flow(s->structure_radius, s->flow.ux, s->flow.uy, x, y, ux, uy);
}

/* |W - v| per mass x drag of the air: times (W - v) it is the wind's acceleration [1/s]. */
static inline double fw_wind_rate(const fw_setup *s, double air_per_mass, double vx, double vy)
{
    double rx = s->flow.wind_x - vx, ry = s->flow.wind_y - vy;
    return air_per_mass * sqrt(rx * rx + ry * ry);
}

#endif
