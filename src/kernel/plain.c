/* Who is stepped: all ice past the inlet is awake, neighbours are listed with a skin, floes past the outlet are forgotten. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/plain_inside.h"
#include "kernel/strip.h"
#include "kernel/wake.h"

fw_status fw_plain_create(fw_plain **out, const fw_setup *setup, const fw_numerics *numerics, double inlet, fw_msg *m)
{
    FW_CHECK(numerics->step > 0 && inlet < -setup->structure_radius, m, FW_E_ARG,
             "plain method: step %g s, inlet %g m: wanted more than 0 s, and upstream of the structure", numerics->step,
             inlet);
    FW_CHECK(numerics->scheme != FW_SCHEME_EVENTS, m, FW_E_ARG, "plain method: the events scheme has no fixed step");
    FW_TRY(fw_alloc(out, 1, sizeof **out, "plain kernel", m));
    (*out)->setup = *setup, (*out)->numerics = *numerics, (*out)->inlet = inlet;
    return FW_OK;
}

void fw_plain_destroy(fw_plain *p)
{
    if (!p) return;
    fw_neighbours_free(&p->neighbours);
    free(p->law);
    free(p->force);
    free(p->stage);
    free(p->near_wall);
    free(p->wall);
    free(p->t_touch);
    free(p->slip);
    free(p->slope);
    free(p->is_gone);
    free(p);
}

fw_box fw_plain_needs_ice(const fw_plain *p, const fw_world *w)
{
    fw_strip strip = fw_strip_of(&p->setup, w);
    double   along[2] = {p->inlet - w->max_radius - p->setup.skin, p->setup.downstream}, across[2] = {-strip.half_width, strip.half_width};
    fw_box   box = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (int i = 0; i < 4; i++) {
        double a = along[i / 2], b = across[i % 2], x = strip.cx * a - strip.cy * b, y = strip.cy * a + strip.cx * b;
        box.x0 = fmin(box.x0, x), box.x1 = fmax(box.x1, x), box.y0 = fmin(box.y0, y), box.y1 = fmax(box.y1, y);
    }
    return box;
}

static fw_status wake_all(fw_plain *p, fw_world *w, fw_msg *m)
{
    fw_strip strip = fw_strip_of(&p->setup, w);
    for (size_t k = 0; k < w->n_blocks; k++) {
        fw_block *b = &w->blocks[k];
        if (b->n_left == 0) continue;
        for (size_t i = 0; i < b->n; i++) {
            double along = strip.cx * (b->x[i] + w->drift_x) + strip.cy * (b->y[i] + w->drift_y);
            if (b->is_taken[i] || along < p->inlet || !fw_strip_has(&strip, b->x[i], b->y[i])) continue;
            FW_TRY(fw_wake(&p->setup, w, k, i, m));
            w->bodies[w->n_bodies - 1].is_touched = true; /* so that pairs of it are listed and stepped */
        }
    }
    return FW_OK;
}

static fw_status list(fw_plain *p, fw_world *w, fw_msg *m)
{
    size_t n_given = p->has_started ? 0 : w->n_bodies;
    FW_TRY(wake_all(p, w, m));
    FW_TRY(fw_neighbours_list(&p->neighbours, &p->setup, w, m));
    FW_TRY(fw_grow(&p->law, &p->law_capacity, p->neighbours.n_near + 1, sizeof *p->law, "plain kernel", m));
    FW_TRY(fw_grow(&p->force, &p->force_capacity, 3 * w->n_bodies + 3, sizeof *p->force, "plain kernel", m));
    FW_TRY(fw_grow(&p->t_touch, &p->touch_capacity, w->n_bodies + 1, sizeof *p->t_touch, "plain kernel", m));
    FW_TRY(fw_grow(&p->slip, &p->slip_capacity, p->neighbours.n_near + 1, sizeof *p->slip, "plain kernel", m));
    memset(p->slip, 0, p->neighbours.n_near * sizeof *p->slip); /* listed anew: what jumped before is forgotten */
    if (p->numerics.scheme == FW_SCHEME_VERLET)
        FW_TRY(fw_grow(&p->slope, &p->slope_capacity, 3 * w->n_bodies + 3, sizeof *p->slope, "plain kernel", m));
    if (p->numerics.scheme == FW_SCHEME_RK4)
        FW_TRY(fw_grow(&p->stage, &p->stage_capacity, 10 * w->n_bodies + 10, sizeof *p->stage, "plain kernel", m));
    FW_TRY(fw_grow(&p->is_gone, &p->gone_capacity, w->n_bodies + 1, sizeof *p->is_gone, "plain kernel", m));
    size_t n_walls = 0;
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_near n = p->neighbours.near[q];
        double  inv = w->bodies[n.i].inv_mass + (n.j == FW_WALL ? 0 : w->bodies[n.j].inv_mass);
        p->law[q] = fw_contact_law_apply(n.j == FW_WALL ? &p->setup.contact : &p->setup.floe_contact, 1 / inv);
        if (n.j == FW_WALL) n_walls++;
    }
    FW_TRY(fw_grow(&p->near_wall, &p->near_wall_capacity, n_walls + 1, sizeof *p->near_wall, "plain kernel", m));
    FW_TRY(fw_grow(&p->wall, &p->wall_capacity, n_walls + 1, sizeof *p->wall, "plain kernel", m));
    p->n_walls = 0;
    for (size_t q = 0; q < p->neighbours.n_near; q++)
        if (p->neighbours.near[q].j == FW_WALL) p->near_wall[p->n_walls++] = q;
    fw_plain_begin_slopes(p, w, n_given);
    p->has_started = true;
    return FW_OK;
}

/* What is kept per floe moves with the floes, and what the gone ones leave behind is cleared for those that are woken next. */
static void forget(fw_plain *p, fw_world *w)
{
    size_t kept = 0;
    for (size_t i = 0; i < w->n_bodies; i++) {
        if (p->is_gone[i]) continue;
        p->t_touch[kept] = p->t_touch[i];
        if (p->slope) memmove(p->slope + 3 * kept, p->slope + 3 * i, 3 * sizeof *p->slope);
        kept++;
    }
    if (p->slope) memset(p->slope + 3 * kept, 0, 3 * (w->n_bodies - kept) * sizeof *p->slope);
    fw_world_forget(w, p->is_gone);
    p->neighbours.is_valid = false;
}

fw_status fw_plain_step(fw_plain *p, fw_world *w, fw_wear *wear, double t_end, fw_msg *m)
{
    double until = fmin(t_end, w->t + 0.1), dt = p->numerics.step, near_time = 10 * dt;
    if (fw_neighbours_is_stale(&p->neighbours, &p->setup, w, near_time)) FW_TRY(list(p, w, m));
    for (size_t n = 1; w->t < until; n++) {
        double left = t_end - w->t;
        fw_plain_advance(p, w, wear, left < dt * (1 + 1e-9) ? left : dt);
        if (left < dt * (1 + 1e-9)) w->t = t_end;
        if (n % 10 == 0 && fw_neighbours_is_stale(&p->neighbours, &p->setup, w, near_time)) FW_TRY(list(p, w, m));
    }
    bool     any = false;
    fw_strip strip = fw_strip_of(&p->setup, w);
    for (size_t i = 0; i < w->n_bodies; i++) any |= p->is_gone[i] = strip.cx * w->bodies[i].x + strip.cy * w->bodies[i].y > p->setup.downstream;
    if (any) forget(p, w);
    FW_CHECK(isfinite(fw_world_energy(w)), m, FW_E_NUMERIC, "plain method: the state is not finite at t = %.6g s",
             w->t);
    w->ledger.macro_steps++;
    return FW_OK;
}
