/* Wear of the structure: structure contacts -> pressure and slip -> wear load and path on the ring of arcs.
 *
 * Load of a law with exponent m: M = int sigma^m |vt| dt, sigma = N / (b h), b the lens chord. It is temperature-free:
 * temperature only multiplies. Pressure starts like t^(-1/2) at a touch, so the time integral runs over (time since touch)^(1 - m/2)
 * (Gauss nodes there): the naive sum converges like dt^0.44 only. */
#ifndef FW_ABRASION_WEAR_H
#define FW_ABRASION_WEAR_H

#include <stdbool.h>
#include <stddef.h>

#include "floewear/scenario.h"
#include "floewear/status.h"

enum { FW_WEAR_STAGES = 8 };

typedef struct fw_wear_sums {
    double path;   /* int |vt| dt [m] */
    double along;  /* int sigma^m |vt| dt along the contact [Pa^m m] */
    double x_wall; /* int sigma^m |vt| b dt [Pa^m m2]: what the ring must add up to */
    double impact; /* share of along within 2/w of a first touch */
    double beyond; /* share of along with an overlap beyond a tenth of the smaller radius */
} fw_wear_sums;

typedef struct fw_wear {
    double       structure_radius;
    size_t       n_arcs, n_laws;
    double       exponent[FW_MAX_LAWS];
    double       high_pressure;        /* [Pa] the share above it is kept apart: 5 MPa */
    fw_wear_rule rule;
    bool         is_open;              /* collecting: false during warm-up */
    double      *path;                 /* (n_arcs) [m] */
    double      *load[FW_MAX_LAWS][3]; /* (n_arcs) each: all, within 2/w of a hit, above high_pressure [Pa^m m] */
    fw_wear_sums sums[FW_MAX_LAWS];
    double      *share; /* (n_arcs + 1) work */
} fw_wear;

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
    double radius, thickness;      /* of the floe [m] */
} fw_wear_interval;

fw_status fw_wear_init(fw_wear *w, double structure_radius, size_t n_arcs, size_t n_laws, const fw_abrasion_law *laws,
                       fw_msg *m);
void      fw_wear_free(fw_wear *w);

/* Add one interval to the ring; does nothing unless is_open. The ring's sum of load x arc length equals sums.x_wall. */
void fw_wear_collect(fw_wear *w, const fw_wear_interval *iv);

/* |sum over arcs of load x arc length - x_wall| / x_wall, worst over the laws. */
double fw_wear_conservation(const fw_wear *w);

#endif
