/* Inside the kernel only: a cluster is a set of floes held together by closed contacts, stepped at a pace of its own.
 *
 *   t0 ------------ step tried, accepted by its error, not yet committed ------------ t1
 *   x0, v0, a[0]                    cubic between the two ends                       x1, v1
 *
 * A tried step may be cut at any instant in between: somebody may hit the cluster before t1. Books and wear are written when
 * it is committed, once. */
#ifndef FW_KERNEL_CLUSTER_H
#define FW_KERNEL_CLUSTER_H

#include <math.h>

#include "kernel/kernel.h"
#include "kernel/lone.h"

/* Where a floe's position and velocity stand in an array of eight: a vector unit's two words. */
enum { FW_X = 0, FW_Y = 1, FW_TURN = 2, FW_VX = 4, FW_VY = 5, FW_SPIN = 6 };

/* A floe of the cluster. */
typedef struct fw_member {
    /* what a sweep reads and writes lies together */
    double   V[4];     /* unknown stage velocity (x, y, spin, 0) while it is solved for */
    double   inv_mass; /* of the stage: drag adds to inertia */
    double   radius;
    double   turn; /* radius x inv_inertia: spin per impulse along the rim */
    /* the stage's equations */
    double   r[8];                      /* known part */
    double   X, Y, U[4];                /* predicted stage position and the velocity it was predicted with */
    double   resistance, ease;          /* 1 + hg drag_rate and its inverse */
    double   drag_rate, drag_per_mass;  /* drag x |u - v| / mass [1/s] that V was built with; drag / mass [1/m] */
    double   drag_speed; /* that |u - v| */
    double   ux, uy;     /* the water there [m/s] */
    double   air_rate, air_per_mass, spin_slows, spin_per_inertia; /* the same of the wind; of the water on spin [1/s2], [1/(m R)] */
    double   own_inv_mass;              /* of the floe */
    double   mass, inertia;             /* 0: rotation is locked */
    /* the step: state at both ends, slopes of the state at the stages: (vx, vy, spin, 0, ax, ay, spin's, 0) */
    double   y0[8], y1[8], k[FW_MAX_STAGES][8];
    double   drag[FW_MAX_STAGES][3]; /* acceleration by water and wind, and of spin */
    double   fastest;           /* bound of |v - u| over the tried step [m/s] */
    double   gained[3], shoved, twisted; /* books' sums of one step: velocity from impulses, and their size without sign, spin's too */
    int32_t  index;             /* of the body in the world */
    uint32_t n_pairs;
} fw_member;

/* A closed contact. b = FW_WALL: the structure. */
typedef struct fw_pair {
    /* what a sweep reads and writes */
    fw_member *ma, *mb;     /* members a and b, or the cluster's wall; set anew for each stage, since members move */
    double     nx, ny;      /* this stage, from b to a */
    double     alpha, beta; /* N = max(0, alpha + beta closing rate) */
    double     to_push, to_rub;  /* impulses that a sweep answers with, per force without it and per slip */
    double     push, rub;        /* impulses of this stage [N s] */
    double     w_normal, w_slip; /* inverse effective masses */
    double     mu;
    int32_t    a, b; /* members */
    double     depth_star, rate_star;
    fw_contact_constants law;
    double               t_touch, since_touch;
    double               normal[FW_MAX_STAGES], friction[FW_MAX_STAGES], slip[FW_MAX_STAGES], rate[FW_MAX_STAGES];
    double               depth[FW_MAX_STAGES], dir[FW_MAX_STAGES][2];
    double  wear_until, wear_angle; /* ring angle at the end of the last interval that wore, and when */
    double  load, load_tried; /* of this touch so far, and of the tried step: see wear_error in cluster.c */
    int32_t candidate;        /* its entry in the lists of who may touch whom */
    bool    is_lawful; /* in the weighed step, at all stages: no tension, friction within its cap */
    struct fw_rim *rim; /* ice that crushes on the structure (crush.h): then k and c of its law are 0; NULL: a spring */
    int8_t  jumped; /* slip went from cap to cap of friction in the step before, up or down: watch.c */
} fw_pair;

/* What keeps a locked floe's spin up against friction works, too: R Ft w. Of an impulse of friction. */
static inline double fw_member_held(const fw_member *m, double rub) { return m->inertia > 0 ? 0 : rub * m->radius * m->y0[FW_SPIN]; }

/* What the crushing contact of a pair remembers; NULL: a spring's. */
static inline struct fw_rim *fw_rim_of(const fw_pair *p) { return FW_OPTIONAL_EFFECTS ? p->rim : NULL; }

/* What a step leaves behind, before it is entered in the ledger. Energies [J], momenta [N s]. */
typedef struct fw_step_books {
    double kinetic_change, impulse_work, impulse_size, drag_work, dashpot, friction, dropped;
    double crushed, rolling, turned; /* of ice that crushes: see fw_ledger */
    double stored, into_springs; /* change of spring energy; of the springs that gained some */
    double momentum_error, momentum_size, normal_impulse, contact_time, peak_force;
} fw_step_books;

typedef struct fw_cluster {
    double     t0, t1;  /* t1 == t0: no step tried yet */
    double     h;       /* step to try next [s]; INFINITY: none known */
    double     omega;   /* of the stiffest contact [1/s], at least the pace */
    double     pace;    /* of what happens without a contact [1/s]; 0 where floes in none are in no cluster */
    bool       is_kept; /* steps may not pass the next listing: members are about to be forgotten */
    fw_member  wall;    /* the structure as a member that nothing moves: a sweep needs no branch for it */
    size_t     n_members, member_capacity, n_pairs, pair_capacity;
    fw_member *members;
    fw_pair   *pairs;
    fw_lone    lone; /* the tried step of a lone floe on the structure */
    double        dissipated; /* since the first contact, shared out by number where the cluster falls apart [J] */
    fw_step_books tried;      /* of the tried step, but for a lone floe's; */
    bool          is_weighed; /* and whether it has been: a step that was cut is weighed when it is committed */
} fw_cluster;

/* Where committed steps leave their traces. */
typedef struct fw_books {
    const fw_setup *setup;
    fw_world       *world;
    fw_wear        *wear;
} fw_books;

/* Comparisons instead of fmax and fmin: those are library calls, this is an instruction. NaN in b is dropped, as there. */
static inline double fw_larger(double a, double b) { return b > a ? b : a; }
static inline double fw_length(double x, double y) { return sqrt(x * x + y * y); } /* nothing here nears 1e150 */
static inline double fw_smaller(double a, double b) { return b < a ? b : a; }

/* stage.c */
void fw_stage_start(fw_cluster *c, const fw_books *b);                     /* accelerations at t0, from forces */
bool fw_stage_solve(fw_cluster *c, const fw_books *b, size_t s, double h); /* stage s of a step h; false: sweeps ended before their time */

/* cluster.c */
fw_status fw_cluster_join(fw_cluster *c, const fw_books *b, int32_t body, int32_t *member,
                          fw_msg *m);                                      /* at its state */
fw_status fw_cluster_merge(fw_cluster *into, fw_cluster *from, fw_msg *m); /* from is empty afterwards */
/* New contact of members a and b (or the structure) at t0. Steps start anew: call fw_cluster_restart afterwards. */
fw_status fw_cluster_close(fw_cluster *c, const fw_books *b, int32_t a, int32_t other, int32_t candidate, double rate,
                           fw_msg *m);
void      fw_cluster_restart(fw_cluster *c, const fw_books *b);
/* A step from t0 whose error is within the tolerance, at most to limit. FW_E_NUMERIC: the state is not finite. */
fw_status fw_cluster_try(fw_cluster *c, const fw_books *b, double limit, fw_msg *m);
/* Steps below this, in 1/w, are taken whatever their error. */
static const double FW_SHORTEST = 1e-9;
/* Length of the next step: h or what is left, and no sliver at the end, two halves instead. */
static inline double fw_step_without_sliver(double h, double left) { return h >= left ? left : h > 0.5 * left ? 0.5 * left : h; }
/* The same, cut to end at t exactly, t0 < t < t1. A part of a step whose error was tolerable is taken whatever its own estimate says: ending
 * earlier would leave a gap that others have passed already. */
fw_status fw_cluster_land(fw_cluster *c, const fw_books *b, double t, fw_msg *m);
void      fw_cluster_find_stiffest(fw_cluster *c); /* into omega */
/* cluster_commit.c. The tried step becomes truth: books, wear, bodies. Contacts that let go are taken out; opened lists their candidates. */
fw_status fw_cluster_commit(fw_cluster *c, const fw_books *b, int32_t *opened, size_t *n_opened, fw_msg *m);
void      fw_cluster_free(fw_cluster *c);

fw_status fw_cluster_not_finite(const fw_cluster *c, const fw_books *b, fw_msg *m); /* says so; FW_E_NUMERIC */

/* When in the tried step, at the latest at its end, does the structure's force on a floe vanish [s after t0]? It presses at t0 and not at t1.
 * A parabola through the force and its slope at t0 and the first stage without force. */
double fw_cluster_lets_go(const fw_cluster *c, const fw_pair *p, const fw_method *me);

/* Bound of |v - u| over a tried step: the cubic's velocity is a parabola, bounded by its control points v0, middle, v1. */
double fw_member_fastest(const fw_member *m, const fw_flow *flow, double inv_h);

/* books.c: of the tried step */
void                 fw_books_weigh(fw_cluster *c, const fw_setup *set, double h); /* into c->tried */
void                 fw_books_keep(fw_cluster *c, const fw_books *b);
void                 fw_books_wear(const fw_cluster *c, const fw_books *b);
/* Largest overlap between two instants h apart: of the cubic through both, whose slope is the closing rate. */
double               fw_books_deepest(double depth0, double rate0, double depth1, double rate1, double h);
/* An overlap of discs, the smaller one of radius `small`, after a step; true: beyond what soft contact is meant for. */
bool                 fw_books_overlap(fw_ledger *l, double small, double depth);
static inline double fw_pair_signed_normal(const fw_pair *p, size_t s)
{
    return p->law.k * p->depth[s] + p->law.c * p->rate[s];
}

/* Local error of a tried step h at a structure contact of member a: of its velocity (x, y, spin), of the closing rate and of the slip. */
static inline void fw_pair_errors(const fw_pair *p, const fw_member *a, const fw_method *me, double h, double e[3], double *en, double *et)
{
    for (int q = 0; q < 3; q++) {
        e[q] = 0;
        for (size_t s = 0; s < me->n_stages; s++) e[q] += h * me->e[s] * a->k[s][FW_VX + q];
    }
    *en = fabs(p->nx * e[0] + p->ny * e[1]), *et = fabs(p->nx * e[1] - p->ny * e[0] - a->radius * e[2]);
}

#endif
