/* Wear of a fixed step from both its ends.
 *
 *   depth       start          end
 *               |--- gap ---o--|      a touch inside: only the part after it counts, its length from the two depths
 *               |--------------|      closed at both ends: the whole step
 *               |----o-- gap --|      parting: the whole step, the rule finds where the force ends
 *
 * The schemes do not locate touches; the rules other than the naive one need the time since touch, and a straight line
 * through both depths gives it to second order. The naive rule knows nothing of this and gets the whole step. */
#include <math.h>

#include "geometry/ring.h"
#include "kernel/plain_inside.h"

static fw_plain_wall wall_now(const fw_plain *p, const fw_world *w, size_t near)
{
    const fw_body              *b = &w->bodies[p->neighbours.near[near].i];
    const fw_contact_constants *law = &p->law[near];
    double                      r = sqrt(b->x * b->x + b->y * b->y), nx = b->x / r, ny = b->y / r;
    fw_plain_wall               now = {.depth = p->setup.structure_radius + b->radius - r,
                                       .rate = -(nx * b->vx + ny * b->vy),
                                       .slip = nx * b->vy - ny * b->vx - b->radius * b->spin};
    now.normal = law->k * now.depth + law->c * now.rate;
    if (now.depth > 0) now.angle = fw_ring_angle(b->x, b->y); /* most floes that are near do not touch */
    return now;
}

void fw_plain_wear_begin(fw_plain *p, const fw_world *w)
{
    for (size_t k = 0; k < p->n_walls; k++) p->wall[k] = wall_now(p, w, p->near_wall[k]);
}

static void touch(fw_plain *p, fw_world *w, const fw_wear *wear, size_t i, double t)
{
    fw_body *b = &w->bodies[i];
    p->t_touch[i] = t;
    if (!(t - b->t_wall > 1)) return;
    b->t_hit = t;
    if (wear->is_open) w->ledger.hits++;
}

void fw_plain_wear_end(fw_plain *p, fw_world *w, fw_wear *wear, double t, double dt)
{
    for (size_t k = 0; k < p->n_walls; k++) {
        size_t        near = p->near_wall[k], i = (size_t)p->neighbours.near[near].i;
        fw_plain_wall from = p->wall[k], to = wall_now(p, w, near);
        if (!(from.depth > 0) && !(to.depth > 0)) continue;
        fw_body *b = &w->bodies[i];
        double   start = t, length = dt;
        if (!(from.depth > 0)) {
            double gap = -from.depth / (to.depth - from.depth) * dt;
            touch(p, w, wear, i, t + gap);
            if (p->numerics.wear_rule != FW_WEAR_NAIVE) start += gap, length -= gap;
            from.depth = 0, from.rate = to.depth / fmax(dt - gap, 1e-12 * dt), from.angle = to.angle;
            from.normal = p->law[near].c * from.rate;
        }
        if (!(to.depth > 0)) to.angle = from.angle;
        if (to.depth > 0) b->t_wall = t + dt;
        if (!wear->is_open) continue;
        double force = fmax(0, to.normal);
        if (to.depth > 0 && force > 0) {
            w->ledger.peak_force = fmax(w->ledger.peak_force, force);
            w->ledger.contact_time += length;
        }
        fw_wear_interval iv = {.length = length,
                               .since_touch = start - p->t_touch[i],
                               .impact_left = b->t_hit + 2 / p->law[near].omega - start,
                               .n_stages = 2,
                               .at = {0, 1},
                               .depth = {from.depth, to.depth},
                               .rate = {from.rate, to.rate},
                               .angle = {from.angle, to.angle},
                               .normal = {from.normal, to.normal},
                               .slip = {from.slip, to.slip},
                               .radius = b->radius,
                               .thickness = b->thickness};
        fw_wear_collect(wear, &iv);
    }
}
