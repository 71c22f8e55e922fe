/* Inside the plain methods only: plain.c (who is stepped), plain_step.c (the schemes), plain_wear.c (wear from both ends of a step). */
#ifndef FW_KERNEL_PLAIN_INSIDE_H
#define FW_KERNEL_PLAIN_INSIDE_H

#include "kernel/neighbours.h"
#include "kernel/plain.h"

/* One floe near the structure at one instant. */
typedef struct fw_plain_wall {
    double depth, rate, normal, slip, angle; /* normal k d + c d' with its sign; depth < 0: a gap */
} fw_plain_wall;

/* Slip of a near pair at one instant, and whether it jumped from cap to cap of friction to get there. */
struct fw_plain_slip {
    double slip, normal;
    int    jumped;
};

struct fw_plain {
    fw_setup              setup;
    fw_numerics           numerics;
    double                inlet;
    fw_neighbours         neighbours;
    fw_contact_constants *law;
    size_t                law_capacity; /* (n_near) */
    double               *force;        /* (n_bodies x 3) */
    size_t                force_capacity;
    double               *stage; /* (n_bodies x 10) of RK4: the step's start, and the weighted sums of its slopes */
    size_t                stage_capacity;
    size_t               *near_wall; /* (n_walls) which near pairs are with the structure */
    size_t                n_walls, near_wall_capacity;
    fw_plain_wall        *wall; /* (n_walls) at the step's start */
    size_t                wall_capacity;
    double               *t_touch; /* (n_bodies) when the contact with the structure closed */
    size_t                touch_capacity;
    struct fw_plain_slip *slip; /* (n_near) of the step before; without a contact normal is 0 */
    size_t                slip_capacity;
    double *slope; /* (n_bodies x 3) accelerations at the step's start, of Verlet; 0: drifts with the water */
    size_t  slope_capacity;
    bool    has_started;
    bool   *is_gone;
    size_t  gone_capacity;
};

/* A near pair at this instant, normal from b (NULL: the structure) to a. */
typedef struct fw_plain_meeting {
    fw_body *a, *b;
    double   nx, ny, normal, slip, depth;
} fw_plain_meeting;

/* Do they overlap? Else only a and b are filled. */
static inline bool fw_plain_meets(const fw_plain *p, fw_world *w, size_t q, fw_plain_meeting *to)
{
    fw_near  e = p->neighbours.near[q];
    fw_body *a = &w->bodies[e.i], *b = e.j == FW_WALL ? NULL : &w->bodies[e.j];
    double   dx = a->x, dy = a->y, ux = a->vx, uy = a->vy, turn = a->radius * a->spin, reach = a->radius;
    if (b)
        dx -= b->x, dy -= b->y, ux -= b->vx, uy -= b->vy, turn += b->radius * b->spin, reach += b->radius;
    else
        reach += p->setup.structure_radius;
    to->a = a, to->b = b;
    double r2 = dx * dx + dy * dy;
    if (r2 >= reach * reach) return false;
    double r = sqrt(r2), nx = dx / r, ny = dy / r;
    to->nx = nx, to->ny = ny, to->depth = reach - r;
    to->normal = fw_contact_normal(&p->law[q], to->depth, -(nx * ux + ny * uy)), to->slip = nx * uy - ny * ux - turn;
    return true;
}

/* Accelerations of the first n floes, for Verlet: of those that were there at the start. What is woken later drifts with the water. */
void fw_plain_begin_slopes(fw_plain *p, fw_world *w, size_t n);
/* One step of the scheme; advances the world's time and drift. */
void fw_plain_advance(fw_plain *p, fw_world *w, fw_wear *wear, double dt);

/* Before and after a step: what the structure's contacts were and have become; the wear rule gets both ends. */
void fw_plain_wear_begin(fw_plain *p, const fw_world *w);
void fw_plain_wear_end(fw_plain *p, fw_world *w, fw_wear *wear, double t, double dt);

/* plain_watch.c: after a step. An explicit step beyond its limit does not blow up: slip chatters between the caps of friction. */
void fw_plain_watch(fw_plain *p, fw_world *w);

/* Euler with the naive rule collects inside its force loop and needs neither. */
static inline bool fw_plain_is_naive_euler(const fw_plain *p)
{
    return p->numerics.scheme == FW_SCHEME_EULER && p->numerics.wear_rule == FW_WEAR_NAIVE;
}

#endif
