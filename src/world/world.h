/* The state of a simulation: awake floes, their contacts, and blocks of ice that nothing has touched yet. Knows no method.
 *
 * Frame: structure at the origin, the window's mean current along +x. Ice that nothing has touched drifts as one (with the water, or the mean
 * floe's way in the wind) and needs no arithmetic: it stays in blocks of rows in the ice frame, (x, y) = (X, Y) + drift, until an awake floe
 * comes near. */
#ifndef FW_WORLD_WORLD_H
#define FW_WORLD_WORLD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"
#include "geometry/cells.h"
#include "physics/contact.h"
#include "world/ledger.h"

enum { FW_WALL = -1 };

typedef struct fw_body {
    double   t;                     /* instant that the state belongs to [s]; a kernel may be ahead of some floes */
    double   x, y, vx, vy, spin;    /* [m], [m/s], [rad/s] anticlockwise */
    double   radius, thickness;     /* [m] */
    double   inv_mass, inv_inertia; /* [1/kg], [1/(kg m2)]; inv_inertia = 0 locks rotation */
    double   drag, air;             /* 1/2 rho C A of water and of air [kg/m] */
    double   spin_drag;             /* of the water on the face, over R^2 [kg/m]: effects/skin_drag.h */
    double   t_wall;                /* last instant with the structure contact closed; -INFINITY: never */
    double   t_hit;                 /* first touch of the present visit to the structure */
    double   x_listed, y_listed;    /* where it was when neighbours were last listed, in the ice frame */
    uint64_t name;                  /* for messages and for the order of sums */
    bool     is_touched;            /* ever */
    double   angle;                 /* turned so far, anticlockwise [rad]; kept where a rim is remembered */
    struct fw_rim *rim;             /* crushed places of its rim (kernel/crush.h); NULL: none. Owned, one allocation */
} fw_body;

typedef struct fw_contact {
    int32_t i, j;      /* i < j, or j = FW_WALL */
    double  stiffness; /* [N/m] */
    double  energy;    /* stored otherwise [J]: a crushing contact's */
} fw_contact;

/* Rows of ice that nothing has touched, in the ice frame. */
typedef struct fw_block {
    size_t   n;
    double  *x, *y, *radius, *thickness; /* (n), one allocation, owned */
    bool    *is_taken;                   /* (n) woken or swallowed by the structure at the start */
    size_t   n_left;
    uint64_t first_name;
    double   x_min, x_max, max_radius;
    fw_cells cells;
    size_t   x_capacity, taken_capacity;
} fw_block;

typedef struct fw_world {
    double      t;     /* now [s] */
    double      drift_x, drift_y; /* x - X, y - Y of untouched ice [m] */
    size_t      n_bodies, body_capacity;
    fw_body    *bodies;
    size_t      n_contacts, contact_capacity;
    fw_contact *contacts; /* closed ones, as the kernel last told them: where all floes stand at w->t */
    size_t      n_blocks, block_capacity;
    fw_block   *blocks; /* those beyond n_blocks hold memory for the next ones */
    uint64_t    block_changes; /* blocks added or dropped so far: block numbers kept from before a change are stale */
    /* Untouched ice is complete here (ice frame): who feeds the world says so. */
    double      ice_from, ice_to, ice_low, ice_high;
    double      structure_radius; /* [m] */
    double      max_radius;       /* of any floe seen */
    uint64_t    n_touched;
    fw_ledger   ledger;
    double      energy_start; /* of the awake floes when the ledger was opened [J] */
} fw_world;

fw_status fw_world_create(fw_world **out, double structure_radius, fw_msg *m);
void      fw_world_destroy(fw_world *w);

/* Add an awake floe; fields x, y, vx, vy, spin, radius, thickness, inv_*, drag, air, spin_drag, name of proto are used. Its kinetic energy
 * enters the ledger as inflow. */
fw_status fw_world_add_body(fw_world *w, const fw_body *proto, fw_msg *m);
/* Add n untouched floes (arrays are copied). */
fw_status fw_world_add_block(fw_world *w, size_t n, const double *x, const double *y, const double *radius,
                             const double *thickness, uint64_t first_name, fw_msg *m);
void      fw_world_drop_blocks_beyond(fw_world *w,
                                      double    x); /* whole blocks with every floe's centre past x (kernel frame) */
void      fw_world_drop_block(fw_world *w, uint64_t first_name); /* the one of this name */
/* Forget the awake floes with is_gone[i] set: bodies and contacts close up in order; energy goes to outflow. */
void      fw_world_forget(fw_world *w, const bool *is_gone);

double fw_world_energy(const fw_world *w); /* kinetic of awake floes plus stored in closed contacts [J] */
void   fw_world_open_ledger(fw_world *w);  /* zero the books; the window starts here */

/* Overlap of body i with body j or with the structure: positive when they overlap. */
double fw_world_overlap(const fw_world *w, int32_t i, int32_t j);

#endif
