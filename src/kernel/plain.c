#include "kernel/plain.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "geometry/lens.h"
#include "geometry/ring.h"
#include "kernel/neighbours.h"
#include "kernel/wake.h"

struct fw_plain {
    fw_setup              setup;
    double                dt, inlet;
    fw_neighbours         neighbours;
    fw_contact_constants *law;
    size_t                law_capacity; /* (n_near) */
    double               *force;
    size_t                force_capacity; /* (n_bodies x 3) */
    bool                 *is_gone;
    size_t                gone_capacity;
};

fw_status fw_plain_create(fw_plain **out, const fw_setup *setup, double dt, double inlet, fw_msg *m)
{
    FW_CHECK(dt > 0 && inlet < -setup->structure_radius, m, FW_E_ARG, "plain method: step %g s, inlet %g m", dt, inlet);
    FW_TRY(fw_alloc(out, 1, sizeof **out, "plain kernel", m));
    (*out)->setup = *setup, (*out)->dt = dt, (*out)->inlet = inlet;
    return FW_OK;
}

void fw_plain_destroy(fw_plain *p)
{
    if (!p) return;
    fw_neighbours_free(&p->neighbours);
    free(p->law);
    free(p->force);
    free(p->is_gone);
    free(p);
}

double fw_plain_needs_ice_from(const fw_plain *p, const fw_world *w)
{
    return p->inlet - w->max_radius - p->setup.skin;
}

static fw_status wake_all(fw_plain *p, fw_world *w, fw_msg *m)
{
    for (size_t k = 0; k < w->n_blocks; k++) {
        fw_block *b = &w->blocks[k];
        if (b->n_left == 0) continue;
        for (size_t i = 0; i < b->n; i++) {
            if (b->is_taken[i] || b->x[i] + w->drift < p->inlet || fabs(b->y[i]) > p->setup.half_width) continue;
            FW_TRY(fw_wake(&p->setup, w, k, i, m));
            w->bodies[w->n_bodies - 1].is_touched = true; /* so that pairs of it are listed and stepped */
        }
    }
    return FW_OK;
}

static fw_status list(fw_plain *p, fw_world *w, fw_msg *m)
{
    FW_TRY(wake_all(p, w, m));
    FW_TRY(fw_neighbours_list(&p->neighbours, &p->setup, w, m));
    FW_TRY(fw_grow(&p->law, &p->law_capacity, p->neighbours.n_near + 1, sizeof *p->law, "plain kernel", m));
    FW_TRY(fw_grow(&p->force, &p->force_capacity, 3 * w->n_bodies + 3, sizeof *p->force, "plain kernel", m));
    FW_TRY(fw_grow(&p->is_gone, &p->gone_capacity, w->n_bodies + 1, sizeof *p->is_gone, "plain kernel", m));
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_near n = p->neighbours.near[q];
        double  inv = w->bodies[n.i].inv_mass + (n.j == FW_WALL ? 0 : w->bodies[n.j].inv_mass);
        p->law[q] = fw_contact_law_apply(&p->setup.contact, 1 / inv);
    }
    return FW_OK;
}

/* rate at the step's end times dt: the naive sum, through the same ring */
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

static void step(fw_plain *p, fw_world *w, fw_wear *wear, double dt)
{
    const fw_setup *s = &p->setup;
    double         *f = p->force;
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        double         rx = s->speed - b->vx, ry = -b->vy, drag = b->drag * sqrt(rx * rx + ry * ry);
        f[3 * i] = drag * rx, f[3 * i + 1] = drag * ry, f[3 * i + 2] = 0;
    }
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_near  e = p->neighbours.near[q];
        fw_body *a = &w->bodies[e.i], *b = e.j == FW_WALL ? NULL : &w->bodies[e.j];
        double   dx = a->x, dy = a->y, ux = a->vx, uy = a->vy, turn = a->radius * a->spin, reach = a->radius;
        if (b)
            dx -= b->x, dy -= b->y, ux -= b->vx, uy -= b->vy, turn += b->radius * b->spin, reach += b->radius;
        else
            reach += s->structure_radius;
        double r2 = dx * dx + dy * dy;
        if (r2 >= reach * reach) continue;
        double r = sqrt(r2), nx = dx / r, ny = dy / r, depth = reach - r;
        double n = fw_contact_normal(&p->law[q], depth, -(nx * ux + ny * uy)), slip = nx * uy - ny * ux - turn;
        double t = fw_contact_friction(&p->law[q], n, slip), fx = n * nx - t * ny, fy = n * ny + t * nx;
        w->ledger.force_evaluations++;
        f[3 * e.i] += fx, f[3 * e.i + 1] += fy, f[3 * e.i + 2] -= t * a->radius;
        if (b)
            f[3 * e.j] -= fx, f[3 * e.j + 1] -= fy, f[3 * e.j + 2] -= t * b->radius;
        else {
            if (w->t - a->t_wall > 1 && wear->is_open) w->ledger.hits++;
            a->t_wall = w->t;
            if (wear->is_open) w->ledger.normal_impulse += n * dt;
            naive_wear(wear, a, n, slip, depth, dt);
        }
    }
    for (size_t i = 0; i < w->n_bodies; i++) {
        fw_body *b = &w->bodies[i];
        b->vx += dt * f[3 * i] * b->inv_mass, b->vy += dt * f[3 * i + 1] * b->inv_mass,
            b->spin += dt * f[3 * i + 2] * b->inv_inertia;
        b->x += dt * b->vx, b->y += dt * b->vy;
    }
    w->t += dt;
    w->drift += s->speed * dt;
    w->ledger.steps++;
}

fw_status fw_plain_step(fw_plain *p, fw_world *w, fw_wear *wear, double t_end, fw_msg *m)
{
    double until = fmin(t_end, w->t + 0.1), near_time = 10 * p->dt;
    if (fw_neighbours_is_stale(&p->neighbours, &p->setup, w, near_time)) FW_TRY(list(p, w, m));
    for (size_t n = 1; w->t < until; n++) {
        double left = t_end - w->t;
        step(p, w, wear, left < p->dt * (1 + 1e-9) ? left : p->dt);
        if (left < p->dt * (1 + 1e-9)) w->t = t_end;
        if (n % 10 == 0 && fw_neighbours_is_stale(&p->neighbours, &p->setup, w, near_time)) FW_TRY(list(p, w, m));
    }
    bool any = false;
    for (size_t i = 0; i < w->n_bodies; i++) any |= p->is_gone[i] = w->bodies[i].x > p->setup.downstream;
    if (any) {
        fw_world_forget(w, p->is_gone);
        p->neighbours.is_valid = false;
    }
    FW_CHECK(isfinite(fw_world_energy(w)), m, FW_E_NUMERIC, "plain method: the state is not finite at t = %.6g s",
             w->t);
    w->ledger.macro_steps++;
    return FW_OK;
}
