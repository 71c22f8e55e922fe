/* Inside the kernel only: one floe pressed on the structure and on nothing else, stepped by closed forms. */
#ifndef FW_KERNEL_LONE_H
#define FW_KERNEL_LONE_H

#include <stdbool.h>

#include "floewear/status.h"

struct fw_cluster;
struct fw_books;

enum { FW_LONE_NODES = 4, FW_LONE_TERMS = 14 };

/* Where the floe is after a time: polar about the structure. */
typedef struct fw_lone_state {
    double depth, rate;   /* overlap d and its rate u */
    double slip, slid;    /* s = v - R w, and its integral */
    double carried;       /* p = v - a s: what friction cannot change */
    double along;         /* v, along the wall */
    double reach;         /* distance of the centres */
    double turn;          /* of the normal since the step's start [rad], anticlockwise */
    double normal;        /* k d + c u, with its sign [N] */
} fw_lone_state;

/* One step: its regime, its start and the polynomials of the slow forcing. Enough to say where the floe is at any t in it. */
typedef struct fw_lone {
    double span, length; /* [s] the forcing was fitted over span; the step ends after length <= span */
    bool   presses, rubs, is_short, is_short_slip;
    double slides;       /* sign of a slip at Coulomb's cap; 0: friction is viscous */
    double nx, ny;       /* normal at the start */
    fw_lone_state from;
    double decay, split, omega2; /* a, a^2 - omega^2, omega^2 of d'' + 2 a d' + omega^2 d */
    double relax;                /* q: of s' = -q s + f */
    double share, kick;          /* a = (1/m) / w_slip;  mu / a */
    double g[FW_LONE_NODES], f[FW_LONE_NODES], round[FW_LONE_NODES]; /* in shares of span */
    double depth[FW_LONE_TERMS], slip[FW_LONE_TERMS];                /* particular solutions, or series */
} fw_lone;

bool fw_lone_is(const struct fw_cluster *c, const struct fw_books *b);
/* As fw_cluster_try, _land and the books of _commit, for such a cluster. */
fw_status fw_lone_try(struct fw_cluster *c, const struct fw_books *b, double limit, fw_msg *m);
fw_status fw_lone_land(struct fw_cluster *c, const struct fw_books *b, double t, fw_msg *m);
void      fw_lone_keep(struct fw_cluster *c, const struct fw_books *b);

#endif
