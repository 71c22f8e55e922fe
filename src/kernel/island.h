/* Inside the kernel only: one island's working copy, and the steps on it. */
#ifndef FW_KERNEL_ISLAND_H
#define FW_KERNEL_ISLAND_H

#include <math.h>

#include "kernel/kernel.h"

/* A floe of the island. Stage arrays are (stage) x (x, y, rotation). */
typedef struct fw_member {
    fw_body *body;
    int32_t  index; /* of body in the world */
    uint32_t n_closed;
    double   x0, y0, v0[3];
    double   x1, y1, v1[3];
    double   a[FW_MAX_STAGES][3], v[FW_MAX_STAGES][3];
    double   xr, yr, vr[3];          /* known part of the stage's equations */
    double   X, Y, U[3];             /* predicted stage position and the velocity it was predicted with */
    double   V[3];                   /* unknown stage velocity while it is solved for */
    double   inv_mass;               /* of the stage: drag adds to inertia */
    double   resistance, ease;       /* 1 + hg drag_rate and its inverse */
    double   drag_rate;              /* drag x |u - v| / mass [1/s] that V was built with */
    double   drag[FW_MAX_STAGES][2]; /* drag acceleration at the stages */
} fw_member;

/* A pair of the island, closed (in contact) or open (can touch). b = FW_WALL: the structure. */
typedef struct fw_pair {
    int32_t              a, b; /* members */
    bool                 is_closed;
    fw_contact_constants law;
    double               t_touch, since_touch;
    double               gap0, rate0, gap1, rate1; /* at both ends of the sub-step; rate: closing is positive */
    double               nx, ny;                   /* this stage, from b to a */
    double               alpha, beta;              /* N = max(0, alpha + beta closing rate) */
    double               w_normal, w_slip;         /* inverse effective masses */
    double               to_push, to_rub; /* impulses that a sweep answers with, per force without it and per slip */
    double               push, rub;       /* impulses of this stage [N s] */
    double               depth_star, rate_star;
    double               normal[FW_MAX_STAGES], friction[FW_MAX_STAGES], slip[FW_MAX_STAGES], rate[FW_MAX_STAGES];
    double               depth[FW_MAX_STAGES], dir[FW_MAX_STAGES][2];
} fw_pair;

typedef struct fw_island {
    const fw_setup *setup;
    double          t; /* [s] */
    size_t          n_members, n_pairs, n_closed;
    fw_member      *members; /* (n_members) */
    fw_pair        *pairs;   /* (n_pairs) */
    size_t          n_held;
    int32_t        *closed; /* (n_closed) closed pairs, ascending; room for n_pairs */
    int32_t        *held;   /* (n_held) members in contact, ascending; room for n_members */
    fw_ledger      *ledger;
    fw_wear        *wear;
    double          structure_radius;
    uint64_t        n_touched; /* floes touched for the first time */
} fw_island;

/* Comparisons instead of fmax and fmin: those are library calls, this is an instruction. NaN in b is dropped, as there. */
static inline double fw_larger(double a, double b) { return b > a ? b : a; }
static inline double fw_length(double x, double y) { return sqrt(x * x + y * y); } /* nothing here nears 1e150 */
static inline double fw_smaller(double a, double b) { return b < a ? b : a; }

/* stage.c */
void fw_stage_start(fw_island *is);                     /* accelerations at the sub-step's start, from forces */
void fw_stage_solve(fw_island *is, size_t s, double h); /* stage s of a step h */
void fw_stage_forces_now(fw_island *is, fw_pair *p);    /* normal, friction, slip, rate, depth [0] of one closed pair */

/* touch.c */
void   fw_touch_fly(const fw_setup *setup, const fw_member *m, double dt, double *x, double *y, double v[3]);
void   fw_touch_gap(const fw_island *is, const fw_pair *p, bool at_end, double *gap, double *rate);
/* First root in (0, h] of the cubic through (gap0, rate0) and (gap1, rate1); INFINITY when there is none. */
double fw_touch_root(double gap0, double rate0, double gap1, double rate1, double h);
/* First touch of an open pair when nobody in the island is in contact, within dt; INFINITY: none. */
double fw_touch_free(const fw_island *is, const fw_pair *p, double dt);

/* island.c: advance from is->t to t_end. */
fw_status fw_island_advance(fw_island *is, double t_end, fw_msg *m);

#endif
