/* The swept strip: the macro-scale probabilistic model of a window, in milliseconds.
 *
 *       ice comes in with u            Floes of a mix lie at random, C / E[A] of them on a square metre. One of diameter D hits the
 *      o   O    o                      structure (diameter Ds) if its track passes within (Ds + D)/2 of the middle:
 *    -----------------  ^
 *      O    o    ( S )  | Ds + D         hits in a window = C u T E[Ds + D] / E[A]
 *    -----------------  v                load of a window = C u T / E[A] x E[int over tracks of one hit's load]
 *
 * One hit's load is the kernel's own solution of one floe and the structure, with the model's friction, drag, contact law and so on, until the floe
 * has gone. Hits are solved at a few angles of the touch, diameters and speeds (swept_hits.c); between speeds a hit's load goes as a power of
 * speed (2.0 to 2.1 on the default ice from 1 cm/s to 2 m/s), with what is left of it straight over ln u. Two mixes of five classes at four speeds: 600 hits,
 * 16 ms, 40 000 force evaluations.
 *
 * What is not there: ice on ice (floes pass through one another), wind and tide (the current is steady along +x). Against the kernel's windows whose
 * floes do not meet each other it is exact: load 1.000 +- 0.001 of it, over 40 conditions of 5 to 60 % ice and 0.1 to 2 m/s. Where they do meet, load over the strip's,
 * default ice, mean of two mixes and four speeds from 0.1 to 2 m/s (which do not matter: tests/validation/swept.md):
 *
 *    ice      whole ring   0-30    30-60   60-90 degrees    hits
 *     5 %     1.08         1.33    1.02    0.99             0.99
 *    10 %     1.18         1.7     1.05    0.98             0.96
 *    20 %     1.37         2.4     1.13    1.00             0.90
 *    40 %     1.82         4.0     1.3     1.05             0.73
 *    60 %     2.36         5.5     1.6     1.2              0.53
 *
 * Fewer floes hit, as others are in their way, but those that do are pressed against the middle by the ice behind them and roll off no more. So it is a check
 * of order beside a campaign's result, and a control variate; never a result. Over the default campaign's scenarios the correlation of a window's load with
 * the strip's times fw_swept_crowding is 0.999 over the ring (what is left of a mean's variance: 1/400), 0.99 at 25 to 60 degrees, 0.94 at 0, 0.81 at 82. */
#ifndef FW_STUDY_SWEPT_H
#define FW_STUDY_SWEPT_H

#include "floewear/scenario.h"

typedef struct fw_swept {
    size_t  n_arcs, n_mixes, n_speeds;
    double  structure_diameter, window; /* [m], [s] */
    double  power;                      /* of speed, of a hit's load */
    double *ln_speed;                   /* (n_speeds) of [m/s], evenly spaced; owned */
    double *diameter, *area;            /* (n_mixes) E[D] [m], E[A] [m2]; owned */
    double *load;                       /* (n_mixes, n_speeds, n_arcs) E[int over tracks of a hit's load] [MPa^m km m]; owned */
    double *square;                     /* the same of its square [(MPa^m km)^2 m]; owned */
    double  force_evaluations;          /* that it took */
} fw_swept;

/* Solves the hits for speeds from slowest to fastest [m/s]; law: index into the model's. Borrows nothing. FW_E_ARG: no such law, speeds or sizes;
 * FW_E_NUMERIC, FW_E_LIMIT: a hit failed. */
fw_status fw_swept_make(fw_swept *out, const fw_model *model, double slowest, double fastest, size_t law, fw_msg *m);
void      fw_swept_free(fw_swept *s);

/* Expected number of floes that hit the structure in a window. A record's hits count a floe again that bounced and came back after more than a
 * second, as most do at 0.3 m/s and less. */
double fw_swept_hits(const fw_swept *s, const fw_scenario *sc);

/* Load on the whole ring over the strip's at a concentration, as measured on the default ice (the table above, within 1 %): 1 + 1.7 C + 0.93 C^2. */
static inline double fw_swept_crowding(double concentration) { return 1 + concentration * (1.7 + 0.93 * concentration); }

/* A window's expected load is this sum of rows of s->load: share[0] of row + share[1] of row + 1. Of many windows shares may be added up first. */
typedef struct fw_swept_share {
    size_t row;
    double share[2]; /* [1/m] */
} fw_swept_share;
fw_swept_share fw_swept_share_of(const fw_swept *s, const fw_scenario *sc);

/* load: (n_arcs) expected load of a window [MPa^m km]. variance: (n_arcs) between windows of this very scenario [(MPa^m km)^2], floes being a Poisson
 * stream: rate x E[load of one^2]; may be NULL. */
void fw_swept_ring(const fw_swept *s, const fw_scenario *sc, double *load, double *variance);

#endif
