/* From one interval of a structure contact to a few nodes in time: the three wear rules.
 *
 *   HERMITE   overlap a cubic through both ends' values and rates, force and slip polynomials through the stages
 *   SINGULAR  the same nodes, but overlap, force and slip linear between the interval's ends
 *   NAIVE     one node: the values at the interval's end times its length
 *
 * With t the time since touch, the chord b starts like t^(1/2) and the pressure like t^(-1/2). With g smooth, a law of exponent m
 * grows along the contact like t^(-m/2) g and on the wall, where a wider patch reaches more arcs, like t^((1-m)/2) g. What
 * keeps a few nodes exact enough is to know where a rate is not smooth:
 *
 *     touch         force fades          slip turns        anywhere else
 *     t^(-m/2)      (t_end - t)^m        |t - t_turn|
 *     |..  .   .  . |  .   .   . ...|    |. . . | . . . |   | .  .  . |
 *     weights of    nodes drawn to       cut there         Gauss-Legendre
 *     its own       the zero
 *
 * Weights of its own: four nodes that all laws share, and for every power of t the weights that integrate it times any cubic
 * exactly. Gauss nodes in t^(1 - m/2) of one law were 0.5 % off for a second law beside it and 1 % for m above 1.5. */
#ifndef FW_ABRASION_RULE_H
#define FW_ABRASION_RULE_H

#include <stdbool.h>
#include <stddef.h>

#include "abrasion/limit.h"
#include "abrasion/power.h"
#include "floewear/scenario.h"

enum {
    FW_WEAR_STAGES = 8,
    FW_RULE_TOUCH = 4,
    FW_RULE_FADE = 5,
    FW_RULE_NODES = 168 /* a multiple of 4: 4 x FW_RULE_FADE, and more where a limit parts the pieces */
};

/* One structure contact during one sub-step, as the integrator knows it: values at the stages' instants. */
typedef struct fw_wear_interval {
    double length;            /* of the sub-step [s] */
    double since_touch;       /* time from the contact's closing to the sub-step's start [s] */
    double impact_left;       /* time from the sub-step's start until 2/w after the hit; <= 0: over */
    double depth[2], rate[2]; /* overlap [m] and closing rate [m/s] at both ends */
    double angle[2];          /* ring angle of the contact at both ends [rad] */
    size_t n_stages;
    double at[FW_WEAR_STAGES];     /* instants as shares of length, the first 0, the last 1 */
    double normal[FW_WEAR_STAGES]; /* k d + c d' with its sign: the force is its positive part [N] */
    double slip[FW_WEAR_STAGES];   /* [m/s] */
    bool   has_overlap;            /* overlap holds the stages' overlaps: then HERMITE takes it as it takes force and slip */
    double overlap[FW_WEAR_STAGES];
    double radius, thickness;      /* of the floe [m] */
    /* Ice that crushes: depth and rate are those of the deepest overlap at the place, which the chord b follows; normal is the pressure N / (b h) itself,
     * with its sign [Pa]. While it crushes (is_push) that is `crush` of b h, and normal says only that there is a force. */
    bool            is_crushed, is_push;
    fw_pressure_law crush;
} fw_wear_interval;

/* Node q stands for the part [from, to] of the interval. With breadth = chord / lift and p = force / (breadth thickness):
 *   along the contact   path |slip| dt            law l  p^m |slip| along[l]
 *   on the wall         path |slip| breadth wide  law l  p^m |slip| breadth wall[l]
 * lift is sqrt(t / t at the piece's end) soon after a touch, where p and breadth are smooth and sigma and chord are not; else 1. */
typedef struct fw_rule_nodes {
    size_t n;
    double u[FW_RULE_NODES], from[FW_RULE_NODES], to[FW_RULE_NODES]; /* shares of the interval's length */
    double normal[FW_RULE_NODES], slip[FW_RULE_NODES], depth[FW_RULE_NODES], lift[FW_RULE_NODES];
    double lift2_from[FW_RULE_NODES], lift2_to[FW_RULE_NODES]; /* lift^2 where the node's part begins and ends */
    double dt[FW_RULE_NODES], wide[FW_RULE_NODES]; /* weights [s] */
    double along[FW_MAX_LAWS][FW_RULE_NODES], wall[FW_MAX_LAWS][FW_RULE_NODES];
} fw_rule_nodes;

/* Gauss-Legendre on (0, 1). */
#define FW_RULE_NODES3                                                                                                 \
    {                                                                                                                  \
        0.11270166537925831, 0.5, 0.88729833462074169                                                                  \
    }
#define FW_RULE_WEIGHTS3                                                                                               \
    {                                                                                                                  \
        5.0 / 18, 8.0 / 18, 5.0 / 18                                                                                   \
    }

/* The usual interval, smooth from end to end: three Gauss nodes, all weights FW_RULE_WEIGHTS3 x length; [3] repeats [1] so that
 * four are computed at a time. */
typedef struct fw_rule_smooth {
    double normal[4], slip[4], depth[4];
} fw_rule_smooth;

/* What follows from the stages' instants alone. */
struct fw_rule_stages {
    size_t n;
    double at[FW_WEAR_STAGES];
    double to_power[FW_WEAR_STAGES][FW_WEAR_STAGES]; /* coefficient of u^k = sum over i of [k][i] value[i] */
    double to_node[FW_WEAR_STAGES][4];               /* value at smooth node q = sum over i of [i][q] value[i] */
    double to_touch[FW_WEAR_STAGES][FW_RULE_TOUCH];  /* the same at touch nodes */
};

/* What does not change from interval to interval. */
typedef struct fw_rule {
    size_t n_laws;
    double exponent[FW_MAX_LAWS];
    double touch[FW_RULE_TOUCH][FW_RULE_TOUCH]; /* coefficients of the touch nodes' Lagrange polynomials */
    /* 1 / (k + e) for moments of t^(e-1): e of path on the wall, of each law along the contact and on the wall */
    double   wide[FW_RULE_TOUCH], along[FW_MAX_LAWS][FW_RULE_TOUCH], wall[FW_MAX_LAWS][FW_RULE_TOUCH];
    fw_power start[FW_MAX_LAWS]; /* t^e along the contact */
    struct fw_rule_stages known[2]; /* of the last two kinds of interval: those of the method and those of a lone floe */
    size_t                last;     /* which of them the last interval was of */
    /* Of fw_rule_apply_limited alone. */
    bool          is_steep; /* a law has m >= 2 */
    double        steepest; /* see limit.c */
    fw_wear_limit limit;
} fw_rule;

void fw_rule_init(fw_rule *r, size_t n_laws, const double *exponent);
/* True, and the nodes, when the interval is smooth from end to end; false: fw_rule_apply knows more. Knows of no limit. */
bool fw_rule_is_smooth(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *iv, fw_rule_smooth *nodes);

/* nodes.n is 0 when nothing slides under force. */
void fw_rule_apply(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *iv, fw_rule_nodes *nodes);
/* The nodes carry the force that wears: min(N, limit), limit.exponent x m < 2 for every law; any m then. */
void fw_rule_limit(fw_rule *r, const fw_pressure_law *limit, double structure_radius);
void fw_rule_apply_limited(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *iv, fw_rule_nodes *nodes);

#endif
