/* Inside lone.c, lone_edges.c and lone_keep.c only: where the floe of a step is at any time (lone.c has the equations). */
#ifndef FW_KERNEL_LONE_FORMS_H
#define FW_KERNEL_LONE_FORMS_H

#include <math.h>

#include "kernel/cluster.h"
#include "kernel/forces.h"

/* What decays since the step's start: e^(-t c/2m) times cosh(bt) and sinh(bt)/b, b^2 = split (any sign), and e^(-qt). */
typedef struct decay {
    double cosh, sinh, slip;
} decay;

static inline decay decay_at(const fw_lone *L, double t)
{
    decay w = {0, 0, 0};
    if (L->presses && !L->is_short) {
        double x = L->split * t * t;
        if (fabs(x) < 0.01) { /* near critical damping, whose double root needs no case of its own */
            double e = exp(-L->half_damping * t);
            w.cosh = e * (1 + x * (1.0 / 2 + x * (1.0 / 24 + x * (1.0 / 720 + x * (1.0 / 40320)))));
            w.sinh = e * t * (1 + x * (1.0 / 6 + x * (1.0 / 120 + x * (1.0 / 5040 + x * (1.0 / 362880)))));
        } else if (x < 0) {
            double b = sqrt(-L->split), e = exp(-L->half_damping * t);
            w.cosh = e * cos(b * t), w.sinh = e * sin(b * t) / b;
        } else {
            double b = sqrt(L->split), fast = L->half_damping + b;
            double e = exp(-L->omega2 / fast * t), f = exp(-fast * t); /* the slow root without cancellation */
            w.cosh = 0.5 * (e + f), w.sinh = 0.5 * (e - f) / b;
        }
    }
    if (L->rubs && L->slides == 0 && !L->is_short_slip) w.slip = exp(-L->relaxation * t);
    return w;
}

static inline decay later(const fw_lone *L, decay a, decay b) /* at the sum of their times */
{
    return (decay){a.cosh * b.cosh + L->split * a.sinh * b.sinh, a.sinh * b.cosh + a.cosh * b.sinh, a.slip * b.slip};
}

static inline double value(const double *c, double x) { return c[0] + x * (c[1] + x * c[2]); }
static inline double integral(const double *c, double x)
{
    return x * (c[0] + x * (0.5 * c[1] + x * (1.0 / 3) * c[2]));
}
static inline double integral_twice(const double *c, double x)
{
    return x * x * (0.5 * c[0] + x * ((1.0 / 6) * c[1] + x * (1.0 / 12) * c[2]));
}

static inline void swing_at(const fw_lone *L, const double *P, double d, double u, double x, decay w, double *depth,
                            double *rate)
{
    double inv = L->per_span;
    if (L->is_short) {
        double y = P[FW_LONE_TERMS - 1], s = 0;
        for (int n = FW_LONE_TERMS - 2; n >= 0; n--) s = s * x + y, y = y * x + P[n];
        *depth = y, *rate = s * inv;
        return;
    }
    double A = d - P[0], B = u - P[1] * inv;
    *depth = value(P, x) + A * w.cosh + (B + L->half_damping * A) * w.sinh;
    *rate = (P[1] + 2 * x * P[2]) * inv + B * w.cosh - (L->half_damping * B + L->omega2 * A) * w.sinh;
}

static inline void creep_at(const fw_lone *L, const double *P, double s, double x, decay w, double driven, double *slip,
                            double *slid)
{
    if (L->is_short_slip) {
        double y = P[FW_LONE_TERMS - 1], sum = y / FW_LONE_TERMS;
        for (int n = FW_LONE_TERMS - 2; n >= 0; n--) y = y * x + P[n], sum = sum * x + P[n] / (n + 1);
        *slip = y, *slid = sum * x * L->span;
        return;
    }
    *slip = value(P, x) + (s - P[0]) * w.slip;
    *slid = (driven - (*slip - s)) * L->per_relaxation;
}

static inline __attribute__((always_inline)) void state_at(const fw_lone *L, const fw_contact_constants *law, double t, decay w, fw_lone_state *y)
{
    const fw_lone_state *o = &L->from;
    double               h = L->span, x = t * L->per_span;
    double               pushed = h * integral(L->by.push, x), driven = h * integral(L->by.drive, x);
    if (L->presses)
        swing_at(L, L->swing, o->depth, o->rate, x, w, &y->depth, &y->rate);
    else
        y->depth = o->depth + o->rate * t + h * h * integral_twice(L->by.push, x), y->rate = o->rate + pushed;
    if (L->rubs && L->slides == 0) {
        creep_at(L, L->creep, o->slip, x, w, driven, &y->slip, &y->slid);
    } else {
        y->slip = o->slip + driven, y->slid = o->slip * t + h * h * integral_twice(L->by.drive, x);
        if (L->rubs) {
            double kick = L->slides * L->kick, rise = y->depth - o->depth - o->rate * t;
            y->slip -= kick * (pushed - (y->rate - o->rate));
            y->slid -= kick * (h * h * integral_twice(L->by.push, x) - rise);
        }
    }
    y->along = L->carried + (1 - L->share) * driven + L->share * y->slip;
    if (FW_OPTIONAL_EFFECTS && L->has_twist) y->along += h * integral(L->by.twist, x);
    y->reach = o->reach - (y->depth - o->depth);
    y->per_reach = 1 / y->reach;
    y->turn = h * integral(L->by.orbit, x) + L->share * y->slid * y->per_reach;
    y->normal = law->k * y->depth + law->c * y->rate;
}

/* The normal after a turn. */
static inline void normal_at(const fw_lone *L, double turn, double *nx, double *ny)
{
    double c, s, x = turn * turn;
    if (x < 0.0625) { /* cheaper than the library's, and as exact here */
        s = turn * (1 - x * (1.0 / 6 - x * (1.0 / 120 - x * (1.0 / 5040 - x * (1.0 / 362880 - x * (1.0 / 39916800))))));
        c = 1 - x * (1.0 / 2 - x * (1.0 / 24 - x * (1.0 / 720 - x * (1.0 / 40320 - x * (1.0 / 3628800)))));
    } else {
        s = sin(turn), c = cos(turn);
    }
    *nx = L->nx * c - L->ny * s, *ny = L->nx * s + L->ny * c;
}

/* Drag of water and air per mass, outward and along the wall. */
static inline void drag_at(const fw_setup *set, const fw_member *m, double nx, double ny, const fw_lone_state *y, double *out,
                           double *along)
{
    double ux = set->flow.ux, uy = set->flow.uy;
    if (fw_has_deflection(set)) fw_water_at(set, y->reach * nx, y->reach * ny, &ux, &uy);
    double wn = ux * nx + uy * ny + y->rate, wt = uy * nx - ux * ny - y->along, rate = m->drag_per_mass * sqrt(wn * wn + wt * wt);
    *out = rate * wn, *along = rate * wt;
    if (!fw_has_wind(set)) return;
    double an = set->flow.wind_x * nx + set->flow.wind_y * ny + y->rate, at = set->flow.wind_y * nx - set->flow.wind_x * ny - y->along;
    double air = m->air_per_mass * sqrt(an * an + at * at);
    *out += air * an, *along += air * at;
}

/* The water slows spin: R w' by it, with R w = v - s. */
static inline double spin_drag_at(const fw_setup *set, const fw_member *m, double nx, double ny, const fw_lone_state *y)
{
    double ux, uy;
    fw_water_at(set, y->reach * nx, y->reach * ny, &ux, &uy);
    double wn = ux * nx + uy * ny + y->rate, wt = uy * nx - ux * ny - y->along, rim = y->along - y->slip;
    return -fw_skin_drag_torque_rate(m->spin_per_inertia, m->radius, sqrt(wn * wn + wt * wt), rim / m->radius) * rim;
}

/* lone_edges.c. May the force dip below zero and come back? A bound of its decaying part against the force at the start. */
bool fw_lone_rings(const fw_lone *L, const fw_pair *p);
/* First edge within the span; INFINITY: none. at: states at start, middle and end. */
double fw_lone_first_edge(const fw_lone *L, const fw_pair *p, const fw_lone_state *at);

#endif
