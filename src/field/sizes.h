/* The law of floe sizes of one field: thickness classes and, inside a class, the law of the diameter.
 *
 * Every diameter lies in [4h, sqrt(130 h - 11)]: thinner than a quarter of its diameter, and small enough not to break
 * in waves or on the structure (the unbreakable-floe criterion, Lindseth 2013). The two ends meet at h = 0.08552 m and
 * 8.0395 m; the accepted range of h is [0.0855, 8.04] m, and in the slivers beyond the crossing every floe has the
 * diameter sqrt(130 h - 11), so that none lies above the criterion.
 *
 * Floes are drawn by one number q in (0, 1): the class by cumulative share, the diameter from what is left of q inside
 * the class. So a set of stratified q keeps every margin (class shares, diameter law of each class) at once.
 * All moments are closed forms. */
#ifndef FW_FIELD_SIZES_H
#define FW_FIELD_SIZES_H

#include "floewear/scenario.h"

typedef struct fw_sizes_class {
    double thickness; /* h [m] */
    double low, high; /* ends of the diameter law [m], low == high: one diameter */
    double share;     /* of the floes, by number */
    double begin;     /* first q of the class; the next class's begin is its end */
    double mass_low;  /* lognormal: tail mass at the end of the law that quantiles are counted from */
    double mass;      /* lognormal: mass of the untruncated law inside [low, high] */
} fw_sizes_class;

typedef struct fw_sizes {
    fw_size_law    law;
    double         a, b; /* size_a, size_b of scenario.h */
    size_t         n;
    fw_sizes_class classes[FW_MAX_CLASSES]; /* (n) */
    double         mean_diameter;           /* E[D] over all floes [m] */
    double         mean_area;               /* E[pi D^2 / 4] over all floes [m2] */
    double         max_diameter;            /* over the classes that have floes [m] */
    double         min_diameter;
} fw_sizes;

/* Shares by area are turned into shares by number: proportional to share / E[area | class].
 * FW_E_ARG: no class or too many, a thickness outside the range, shares that are negative, not finite or do not sum to
 * 1 within 1e-6, a power or a lognormal spread out of range, a lognormal with less than 1e-6 of its mass in a class. */
fw_status fw_sizes_init(fw_sizes *s, const fw_thickness_mix *mix, fw_size_law law, double a, double b, fw_msg *m);

/* E[D^power | class k] [m^power], power 1 or 2. */
double fw_sizes_moment(const fw_sizes *s, size_t k, int power);
/* Diameter below which the share v in (0, 1) of the floes of class k lies [m]. */
double fw_sizes_quantile(const fw_sizes *s, size_t k, double v);
/* The floe at q in (0, 1) of the joint law [m]. */
void   fw_sizes_draw(const fw_sizes *s, double q, double *diameter, double *thickness);

#endif
