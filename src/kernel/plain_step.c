/* The three schemes. One pass over near pairs gives all forces; what differs is when it is called and with which state. */
#include <math.h>

#include "geometry/ring.h"
#include "kernel/forces.h"
#include "kernel/plain_inside.h"

/* rate at one instant times dt: the naive sum, through the same ring whatever the rule */
static void naive_wear(fw_wear *wear, const fw_body *b, double n, double slip, double depth, double dt)
{
    if (!wear->is_open || !(n > 0)) return;
    double           a = fw_ring_angle(b->x, b->y);
    fw_wear_interval iv = {.length = dt,
                           .since_touch = 1e9,
                           .n_stages = 2,
                           .at = {0, 1},
                           .depth = {depth, depth},
                           .angle = {a, a},
                           .normal = {n, n},
                           .slip = {slip, slip},
                           .radius = b->radius,
                           .thickness = b->thickness};
    fw_wear_collect(wear, &iv);
}

/* Forces and torques of the present state into p->force. weight: time that this evaluation stands for in the normal impulse
 * on the structure. collects: hits and naive wear are taken here (Euler alone); a constant where it is called. */
static inline void forces(fw_plain *p, fw_world *w, fw_wear *wear, double weight, bool collects)
{
    const fw_setup *s = &p->setup;
    double         *f = p->force;
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        double         ux, uy;
        fw_water_at(s, b->x, b->y, &ux, &uy);
        double rx = ux - b->vx, ry = uy - b->vy, speed = sqrt(rx * rx + ry * ry), drag = b->drag * speed;
        f[3 * i] = drag * rx, f[3 * i + 1] = drag * ry, f[3 * i + 2] = 0;
        if (fw_has_wind(s)) {
            double air = fw_wind_rate(s, b->air, b->vx, b->vy);
            f[3 * i] += air * (s->flow.wind_x - b->vx), f[3 * i + 1] += air * (s->flow.wind_y - b->vy);
        }
        if (fw_has_spin_drag(s)) f[3 * i + 2] = -fw_skin_drag_torque_rate(b->spin_drag, b->radius, speed, b->spin) * b->spin;
    }
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_near          e = p->neighbours.near[q];
        fw_plain_meeting c;
        if (!fw_plain_meets(p, w, q, &c)) continue;
        fw_body *a = c.a, *b = c.b;
        double   n = c.normal, slip = c.slip, depth = c.depth;
        double   t = fw_contact_friction(&p->law[q], n, slip), fx = n * c.nx - t * c.ny, fy = n * c.ny + t * c.nx;
        w->ledger.force_evaluations++;
        f[3 * e.i] += fx, f[3 * e.i + 1] += fy, f[3 * e.i + 2] -= t * a->radius;
        if (b) {
            f[3 * e.j] -= fx, f[3 * e.j + 1] -= fy, f[3 * e.j + 2] -= t * b->radius;
            continue;
        }
        if (wear->is_open) w->ledger.normal_impulse += n * weight;
        if (!collects) continue;
        if (w->t - a->t_wall > 1 && wear->is_open) w->ledger.hits++;
        a->t_wall = w->t;
        naive_wear(wear, a, n, slip, depth, weight);
    }
}

static inline void euler(fw_plain *p, fw_world *w, fw_wear *wear, double dt, bool collects)
{
    const double *f = p->force;
    forces(p, w, wear, dt, collects);
    for (size_t i = 0; i < w->n_bodies; i++) {
        fw_body *b = &w->bodies[i];
        b->vx += dt * f[3 * i] * b->inv_mass, b->vy += dt * f[3 * i + 1] * b->inv_mass,
            b->spin += dt * f[3 * i + 2] * b->inv_inertia;
        b->x += dt * b->vx, b->y += dt * b->vy;
    }
}

/* x1 = x0 + dt v0 + dt^2/2 a0, v* = v0 + dt a0, a1 = a(x1, v*), v1 = v* + dt/2 (a1 - a0). A floe that was woken after the
 * last step drifts with the water: its a0 of zero is right. */
static void verlet(fw_plain *p, fw_world *w, fw_wear *wear, double dt)
{
    const double *f = p->force;
    for (size_t i = 0; i < w->n_bodies; i++) {
        fw_body      *b = &w->bodies[i];
        const double *a = p->slope + 3 * i;
        b->x += dt * (b->vx + 0.5 * dt * a[0]), b->y += dt * (b->vy + 0.5 * dt * a[1]);
        b->vx += dt * a[0], b->vy += dt * a[1], b->spin += dt * a[2];
    }
    forces(p, w, wear, dt, false);
    for (size_t i = 0; i < w->n_bodies; i++) {
        fw_body *b = &w->bodies[i];
        double  *a = p->slope + 3 * i;
        double   ax = f[3 * i] * b->inv_mass, ay = f[3 * i + 1] * b->inv_mass, as = f[3 * i + 2] * b->inv_inertia;
        b->vx += 0.5 * dt * (ax - a[0]), b->vy += 0.5 * dt * (ay - a[1]), b->spin += 0.5 * dt * (as - a[2]);
        a[0] = ax, a[1] = ay, a[2] = as;
    }
}

static void rk4(fw_plain *p, fw_world *w, fw_wear *wear, double dt)
{
    static const double AT[4] = {0, 0.5, 0.5, 1}, WEIGHT[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double       *f = p->force;
    for (size_t stage = 0; stage < 4; stage++) {
        forces(p, w, wear, WEIGHT[stage] * dt, false);
        /* the state of the next stage, or after the last one of the step's end */
        double next = stage < 3 ? AT[stage + 1] * dt : 0;
        for (size_t i = 0; i < w->n_bodies; i++) {
            fw_body *b = &w->bodies[i];
            double  *start = p->stage + 10 * i, *sum = start + 5;
            double   slope[5] = {b->vx, b->vy, f[3 * i] * b->inv_mass, f[3 * i + 1] * b->inv_mass,
                                 f[3 * i + 2] * b->inv_inertia};
            double  *state[5] = {&b->x, &b->y, &b->vx, &b->vy, &b->spin};
            for (size_t k = 0; k < 5; k++) {
                if (stage == 0) start[k] = *state[k], sum[k] = 0;
                sum[k] += WEIGHT[stage] * slope[k];
                *state[k] = start[k] + (stage < 3 ? next * slope[k] : dt * sum[k]);
            }
        }
    }
}

void fw_plain_begin_slopes(fw_plain *p, fw_world *w, size_t n)
{
    if (p->numerics.scheme != FW_SCHEME_VERLET || n == 0) return;
    forces(p, w, &(fw_wear){.is_open = false}, 0, false);
    for (size_t i = 0; i < n; i++) {
        const fw_body *b = &w->bodies[i];
        p->slope[3 * i] = p->force[3 * i] * b->inv_mass;
        p->slope[3 * i + 1] = p->force[3 * i + 1] * b->inv_mass;
        p->slope[3 * i + 2] = p->force[3 * i + 2] * b->inv_inertia;
    }
}

void fw_plain_advance(fw_plain *p, fw_world *w, fw_wear *wear, double dt)
{
    if (fw_plain_is_naive_euler(p)) {
        euler(p, w, wear, dt, true);
    } else {
        fw_plain_wear_begin(p, w);
        switch (p->numerics.scheme) {
        case FW_SCHEME_VERLET: verlet(p, w, wear, dt); break;
        case FW_SCHEME_RK4: rk4(p, w, wear, dt); break;
        default: euler(p, w, wear, dt, false); break;
        }
        fw_plain_wear_end(p, w, wear, w->t, dt);
        fw_plain_watch(p, w);
    }
    w->t += dt;
    w->drift_x += p->setup.flow.ice_x * dt, w->drift_y += p->setup.flow.ice_y * dt;
    w->ledger.steps++;
}
