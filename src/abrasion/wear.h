/* Wear of the structure: structure contacts -> pressure and slip -> wear load and path on the ring of arcs.
 *
 * Load of a law with exponent m: M = int sigma^m |vt| dt, sigma = N / (b h), b the lens chord. It is temperature-free:
 * temperature only multiplies. Pressure starts like t^(-1/2) at a touch: what that asks of the time integral is rule.h.
 * Under a crushing limit (limit.h) sigma is min(N / (b h), limit) throughout: in the load, in the share near a hit, and in the share
 * above high_pressure, which is that of the load laid down while the pressure that wears lies above it: none under a constant limit
 * at or below it. Path is path. */
#ifndef FW_ABRASION_WEAR_H
#define FW_ABRASION_WEAR_H

#include <stdbool.h>
#include <stddef.h>

#include "abrasion/power.h"
#include "abrasion/rule.h"
#include "floewear/scenario.h"
#include "floewear/status.h"

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
    double       high_pressure; /* [Pa] the share above it is kept apart: 5 MPa */
    fw_wear_rule rule;
    bool         is_open;              /* collecting: false during warm-up */
    double      *path;                 /* (n_arcs) [m]; path and load are filled by fw_wear_finish */
    double      *load[FW_MAX_LAWS][3]; /* (n_arcs) each: all, within 2/w of a hit, above high_pressure [Pa^m m] */
    fw_wear_sums sums[FW_MAX_LAWS];
    double       x_thickness; /* of the first law: int sigma^m |vt| b h dt; over x_wall: mean thickness of the floes that wore */
    /* Inside: a quad per arc and law, so that a patch is laid down in one pass: load all, near a hit, high; path (law 0), each
     * times the length of wall it lies on. */
    double      *cells; /* (n_arcs, n_laws, 4) */
    double       empty; /* intervals up to this long go another way: 0: nowhere; INFINITY: to the limit. One test for both */
    fw_rule      quadrature;
    fw_power     power[FW_MAX_LAWS];
} fw_wear;

fw_status fw_wear_init(fw_wear *w, double structure_radius, size_t n_arcs, size_t n_laws, const fw_abrasion_law *laws,
                       fw_msg *m);
void      fw_wear_free(fw_wear *w);
/* Before the first interval: the pressure that wears is limited from now on. exponent x m < 2 for every law (fw_model_check sees to it). */
void      fw_wear_limit_pressure(fw_wear *w, const fw_pressure_law *limit);

/* Add one interval; does nothing unless is_open. The finished ring's sum of load x arc length equals sums.x_wall. */
void fw_wear_collect(fw_wear *w, const fw_wear_interval *iv);

/* Fill path and load from what was collected so far; may be called again. */
void fw_wear_finish(fw_wear *w);

/* |sum over arcs of load x arc length - x_wall| / x_wall, worst over the laws; after fw_wear_finish. */
double fw_wear_conservation(const fw_wear *w);

#endif
