/* Inside the kernel only: one floe that touches the structure and nothing else, stepped by closed forms (lone.c). */
#ifndef FW_KERNEL_LONE_H
#define FW_KERNEL_LONE_H

#include <stdbool.h>

#include "floewear/status.h"

struct fw_cluster;
struct fw_books;

enum { FW_LONE_TERMS = 14 };

/* Where the floe is, in polar coordinates about the structure. */
typedef struct fw_lone_state {
    double depth, rate;      /* overlap d [m] and its rate d' */
    double slip, slid;       /* s = v - R w [m/s], and its integral since the step's start */
    double along;            /* v, of the centre along the wall */
    double reach, per_reach; /* r, distance of the centres, and 1/r */
    double turn;             /* of the normal since the step's start [rad], anticlockwise */
    double normal;           /* k d + c d', with its sign [N] */
} fw_lone_state;

/* Slow forcing as parabolas in t / span. */
typedef struct fw_lone_forcing {
    double push[3], drive[3], orbit[3]; /* g and f [m/s2], Omega [rad/s]: see lone.c */
    double twist[3];                    /* R w' by the water on spin [m/s2] */
} fw_lone_forcing;

/* A tried step: what holds from its start on, and the forcing. Enough to say where the floe is at any time in it. */
typedef struct fw_lone {
    double        t1;                      /* where the step ends */
    double        span, per_span, length;  /* [s] the forcing is fitted over span; the step ends after length <= span */
    bool          presses, rubs;           /* is there a force; can there be friction */
    bool          has_twist;               /* water slows spin */
    double        slides;                  /* sign of a slip at Coulomb's cap; 0: friction is viscous */
    bool          is_short, is_short_slip; /* power series instead of closed forms */
    double        nx, ny;                  /* normal at the start */
    fw_lone_state from, end;               /* at the start and after span */
    double        carried;                 /* p = v - a s at the start: what friction cannot change */
    double        half_damping, omega2, split;             /* c / 2m, k / m, and the first squared minus the second */
    double        relaxation, per_relaxation, share, kick; /* q, 1/q, a, mu / a */
    fw_lone_forcing by;
    double          swing[FW_LONE_TERMS], creep[FW_LONE_TERMS]; /* particular solutions of d and s, or their series */
    fw_lone_forcing before;                  /* of the step before, in the same span: what to expect of this one */
    double          before_end, before_span; /* its end as a share of its span; 0: nothing is known */
} fw_lone;

bool fw_lone_is(const struct fw_cluster *c, const struct fw_books *b);

/* For such a cluster: as fw_cluster_try and fw_cluster_land, and books and wear of the tried step. */
fw_status fw_lone_try(struct fw_cluster *c, const struct fw_books *b, double limit, fw_msg *m);
fw_status fw_lone_land(struct fw_cluster *c, const struct fw_books *b, double t, fw_msg *m);
void      fw_lone_keep(struct fw_cluster *c, const struct fw_books *b);

#endif
