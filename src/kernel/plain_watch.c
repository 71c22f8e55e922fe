/* Does slip chatter? Not asked of Euler with the naive rule: that is the plain method as it is found elsewhere, to be timed. */
#include <math.h>

#include "kernel/plain_inside.h"
#include "kernel/watch.h"

/* Where several contacts hold a floe few of them swing all the way to their caps. */
static const double NEAR_CAP = 0.3;

void fw_plain_watch(fw_plain *p, fw_world *w)
{
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_near        e = p->neighbours.near[q];
        const fw_body *a = &w->bodies[e.i], *b = e.j == FW_WALL ? NULL : &w->bodies[e.j];
        double         dx = a->x, dy = a->y, ux = a->vx, uy = a->vy, turn = a->radius * a->spin, reach = a->radius;
        if (b)
            dx -= b->x, dy -= b->y, ux -= b->vx, uy -= b->vy, turn += b->radius * b->spin, reach += b->radius;
        else
            reach += p->setup.structure_radius;
        struct fw_plain_slip *was = &p->slip[q], now = {0};
        double                r = sqrt(dx * dx + dy * dy), nx = dx / r, ny = dy / r;
        if (r < reach) {
            now.normal = fw_contact_normal(&p->law[q], reach - r, -(nx * ux + ny * uy)), now.slip = nx * uy - ny * ux - turn;
            now.jumped = fw_watch_jump(&p->law[q], NEAR_CAP, was->slip, was->normal, now.slip, now.normal);
            w->ledger.contact_steps++;
            if (now.jumped && now.jumped == -was->jumped) w->ledger.chatter++;
        }
        *was = now;
    }
}
