/* Inside the kernel only: the structure contact of ice that crushes and remembers (fw_setup.is_crush).
 *
 *   N ^        ______ push: N = F(d) = P0 (b h)^(1-q), d = D grows
 *     |    ___/  |
 *     |  _/      | flat: N = F(D) (1 - kappa (D - d) / D) + c d', back and forth on one line, not below 0, not above F(D)
 *     | /        |
 *     +----------+----> d                 D: deepest overlap so far at that place of the rim, D0 at least
 *
 * Only floe on structure; between floes the spring stays. F takes the exact lens. c = 2 sqrt(S m) with S = kappa F(D) / D, critical: crushed ice is
 * squeezed between flat and wall. So no bounce on a flat, and a push that is over gives e^-2 of its speed back: half of that, in powers of e, by kappa, half by c.
 * A line without damper was tried first (kappa 7 times as large): a floe then rings on its flat for a second and more, at 15 w, and where it comes to rest is
 * chance: of nine hits at accuracy 1 % six were 5 to 60 % off in depth, with other tolerances as many and others, for four times the evaluations. While the
 * ice crushes there is no damper (N = p b h as measured); where d falls and D faster (a floe that rolls) N = F(d) + c d'.
 *
 * Slow currents. Every place of a rim has D >= D0 (physics/crush.h), up to which ice is elastic: N = F(D0) d / D0 + c d' there, and kappa goes from 1 to its own
 * beyond. Without, F(d) ~ sqrt(d) has no end of slope: 0.1 N stood on 1e-15 m, which is rounding, and windows at 1 mm/s never ended. D0 moves hits at 1 to 2
 * m/s by less than 1e-4 (tests/reference/crush.csv, which is without). Where little presses (below F(D0), some 200 N: floes that rub in less than 0.2 m/s) it is a law of its own: the chord stays that of D0, while
 * Hertz lets it shrink as sqrt(N / F(D0)) and crushing, with no D0, as N / F(D0). Wear's load goes with the chord to the -0.12: at 5 cm/s windows wear 14 %
 * less than with no D0, at D0 = 1e-7 m another 2 %; against Hertz it is (N / F(D0))^0.06, -20 % where a fortieth of F(D0) presses. D0 is one number:
 * for p of 6 MPa Hertz says 30 times as much, for 0.2 MPa a thirtieth.
 *
 * Place. A push leaves the imprint of the wall's disc, d - s^2 / (2 R*), in the floe's own frame. Nodes round the rim, no further apart than a tenth of a
 * typical chord, keep the imprint that is deepest there; between two nodes D is the deeper of theirs. One imprint so comes back exactly, many
 * never deeper than they were: D kept as a number and read between nodes, straight or as a parabola, is out by width^2 / (8 R*), and where that is above
 * (the small imprints of a floe that rolls, D / kappa deep in what is elastic) force is gone all at once. The contact's own last imprint is kept beside the nodes.
 *
 * Moment. The flat, of width b, holds N anywhere on it while ice at its edge stays below p: the resultant is off the middle by at most (b - N / (p h)) / 2, so
 *   |M| <= N b / 2 (1 - N / F(D)),   M = -cr (w - v/r) below,   cr = ct R^2
 * w spin, v/r orbital rate. None during the push (N = F), without a jump there. Pressure on a round wall has no moment about its axis: with M goes the
 * force -M/r along the wall. So M works on w - v/r alone, and takes energy always; torque alone would give some where the wall's turning drags spin along.
 *
 * Energy. Stored: (N - c d')^2 / 2S. Crushed: what int F dd leaves of it, below D0 as well where a push begins with the touch. Turned: places of other D come
 * under the wall as the floe turns against it; what that changes in store no force has paid (a cam without torque); of either sign, and within what the
 * flat's moment takes.
 *
 * Range. The floe keeps its mass, inertia and round rim, a tenth of the radius deep 2 % of its mass are gone. What is elastic, D / kappa, stays
 * below a tenth of it as long as D is below half of it. So such contacts count in the largest overlap and in none of the shares "beyond a tenth"; a
 * whole radius fails. A floe that is cut out for a scene of its own (fw_realise_excerpt) comes without its flats. */
#ifndef FW_KERNEL_CRUSH_H
#define FW_KERNEL_CRUSH_H

#include "kernel/cluster.h"

typedef struct fw_imprint {
    double depth, at; /* -INFINITY: none; [rad] in the floe's frame */
} fw_imprint;

typedef struct fw_rim {
    /* the floe, the wall, the law */
    double          radius, thickness, structure_radius, mass;
    double          reduced;      /* R* = R Rs / (R + Rs) */
    fw_pressure_law law;
    double          kappa;        /* far beyond D0 */
    double          spin_damping; /* cr; 0: no flat */
    /* what is remembered */
    size_t n;            /* nodes, evenly round the rim */
    double width;        /* from node to node [m] */
    fw_imprint own;      /* last one of this contact */
    double place;        /* under the wall at the last committed instant [rad] */
    double stored;       /* at the last committed instant [J] */
    double load;         /* of all its touches so far: fw_pair.load goes on from touch to touch */
    /* the tried step, at the stages */
    double deepest[FW_MAX_STAGES], slope[FW_MAX_STAGES];  /* D before this step, dD/ds */
    double chord[FW_MAX_STAGES], yield[FW_MAX_STAGES];    /* of the larger one of D and d: b, F */
    double lever[FW_MAX_STAGES];                          /* 1/r */
    double line[FW_MAX_STAGES];                           /* N with its sign */
    double moment[FW_MAX_STAGES], hold[FW_MAX_STAGES], turning[FW_MAX_STAGES]; /* M on the floe, its cap; w - v/r */
    /* the stage that is solved */
    double hg, arm, roll;          /* 1/r; impulse of M */
    double fresh_chord, fresh_yield; /* of D */
    fw_imprint node[];    /* (n) */
} fw_rim;

/* k of the critically damped spring that a push at the current's speed means, between discs of radii Ra and Rb; h of the thinner. */
double fw_crush_spring(const fw_setup *s, double m_eff, double Ra, double Rb, double h);

/* A pair that has closed: its law where the model takes it from the pressure (floe on floe), its rim (on the structure). */
fw_status fw_crush_close(fw_pair *p, const fw_setup *s, fw_body *a, const fw_body *b, fw_msg *m);

/* What is stored where the floe at y0 overlaps the wall by depth; the place is remembered as it is found [J]. */
double fw_crush_find(fw_rim *r, const double *y0, double depth);

/* stage.c: forces of a contact at t0, into k[0] of its floe; all such contacts of a stage, linearised as the others are; one of them solved as if there were no
 * other, which returns the change of its velocities; what the stage leaves, after one more solution where others had a say. */
void   fw_crush_start(fw_pair *p);
void   fw_crush_linearise(fw_cluster *c, size_t s, double hg);
double fw_crush_solve(fw_pair *p, size_t s);
void   fw_crush_end(fw_cluster *c, size_t s, double inv, bool is_settled);

/* cluster.c: errors of the tried step, of the floe's velocity and of its wear over that of the touch so far, over what is tolerated; and where in the step the
 * law has its first kink that matters [s]; h: none */
double fw_crush_error(const fw_cluster *c, fw_pair *p, const fw_setup *s, double h, double no_slip);
double fw_crush_turn(const fw_cluster *c, const fw_pair *p, const fw_setup *s, double h);

/* books.c */
void fw_crush_weigh(fw_cluster *c, const fw_method *me, fw_pair *p, double h, fw_step_books *to);
/* its pressure and deepest overlap; when its force is gone for the rest of it [s]; INFINITY: it is not */
double fw_crush_interval(const fw_pair *p, size_t n_stages, fw_wear_interval *iv);

/* cluster_commit.c: the imprints of a committed step, once the members stand at its end; how far bodies have turned */
void fw_crush_commit(fw_cluster *c, fw_world *w, size_t last, double h);

#endif
