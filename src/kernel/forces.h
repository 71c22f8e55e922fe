/* Inside the kernel only: what water and air do to a floe, besides contacts. An effect that is off is a flag that is constant over a run. */
#ifndef FW_KERNEL_FORCES_H
#define FW_KERNEL_FORCES_H

#include "effects/deflected_flow.h"
#include "effects/skin_drag.h"
#include "kernel/cluster.h"

/* Does a floe in no contact fly by the closed form of its drag? Else it is a cluster of its own, stepped by the method. */
static inline bool fw_has_flight(const fw_setup *s) { return !fw_has_wind(s) && !fw_has_deflection(s); }

/* Water where a floe's centre is [m/s]. */
static inline void fw_water_at(const fw_setup *s, double x, double y, double *ux, double *uy)
{
    *ux = s->flow.ux, *uy = s->flow.uy;
    if (fw_has_deflection(s)) fw_deflected_flow(s->structure_radius, s->flow.ux, s->flow.uy, x, y, ux, uy);
}

/* |W - v| per mass x drag of the air: times (W - v) it is the wind's acceleration [1/s]. */
static inline double fw_wind_rate(const fw_setup *s, double air_per_mass, double vx, double vy)
{
    double rx = s->flow.wind_x - vx, ry = s->flow.wind_y - vy;
    return air_per_mass * sqrt(rx * rx + ry * ry);
}

static inline double fw_relative_speed(const fw_member *m, double vx, double vy)
{
    double rx = m->ux - vx, ry = m->uy - vy;
    return sqrt(rx * rx + ry * ry);
}

/* In a stage: resistance x V without contact impulses. is_blown: with wind. */
static inline void fw_known_part(const fw_setup *set, const fw_member *m, double hg, bool is_blown, double *x, double *y)
{
    *x = m->r[FW_VX] + hg * m->drag_rate * m->ux, *y = m->r[FW_VY] + hg * m->drag_rate * m->uy;
    if (is_blown) *x += hg * m->air_rate * set->flow.wind_x, *y += hg * m->air_rate * set->flow.wind_y;
}

/* Velocity without contact impulses, drag implicit with a given |u - v|: V = (vr + hg K u) / (1 + hg K); with wind likewise of both. */
static inline void fw_free_velocity(const fw_setup *set, fw_member *m, double hg, double speed, bool is_blown)
{
    m->drag_rate = m->drag_per_mass * speed, m->drag_speed = speed;
    m->resistance = 1 + hg * (is_blown ? m->drag_rate + m->air_rate : m->drag_rate);
    double f = 1 / m->resistance, x, y;
    fw_known_part(set, m, hg, is_blown, &x, &y);
    m->V[0] = x * f, m->V[1] = y * f;
    m->ease = f;
    m->inv_mass = m->own_inv_mass * f;
}

/* forces.c: what wind, deflected flow and drag of spin change in a stage, over what stage.c has put down without them; all members at a time, so that
 * who has none of them pays for one look. At t0; before the contacts; after them. */
void fw_forces_start(fw_cluster *c, const fw_setup *set);
void fw_forces_predict(fw_cluster *c, const fw_setup *set, double hg);
void fw_forces_end(fw_cluster *c, const fw_setup *set, size_t s);
void fw_forces_weigh(fw_cluster *c, const fw_setup *set, double h); /* drag of spin, into the books of the tried step */

#endif
