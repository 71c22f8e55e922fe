/* floewear/distribution.h: one-dimensional laws of site statistics (current speed, concentration, temperature, ...).
 *
 * A distribution is data: it is sampled by its quantile function from one uniform number, so that any design (plain,
 * Sobol, Latin hypercube) can drive it. Values are SI (a speed in m/s, a concentration as a fraction, a temperature in
 * degC, a direction in degrees). Truncation [low, high] renormalises the law. Implemented with GSL. */
#ifndef FLOEWEAR_DISTRIBUTION_H
#define FLOEWEAR_DISTRIBUTION_H

#include <stddef.h>

#include "floewear/status.h"

typedef enum fw_distribution_kind {
    FW_DIST_CONSTANT,   /* a = value */
    FW_DIST_UNIFORM,    /* a = low, b = high */
    FW_DIST_NORMAL,     /* a = mean, b = standard deviation */
    FW_DIST_LOGNORMAL,  /* a = mean of ln x, b = standard deviation of ln x (x in SI) */
    FW_DIST_WEIBULL,    /* a = scale, b = shape, c = location: no value below it */
    FW_DIST_GAMMA,      /* a = shape, b = scale */
    FW_DIST_BETA,       /* a, b = shapes, on [c, d] */
    FW_DIST_TRIANGULAR, /* a = low, b = mode, c = high */
    FW_DIST_VALUES,     /* values (n) with weights (n): discrete; also what a table file gives */
    FW_N_DIST
} fw_distribution_kind;

typedef struct fw_distribution {
    fw_distribution_kind kind;
    double               a, b, c, d;
    double               low, high; /* truncation; -INFINITY, INFINITY when absent */
    size_t               n;         /* FW_DIST_VALUES only */
    double              *values;    /* (n) ascending, owned */
    double              *weights;   /* (n) sum to 1, owned */
} fw_distribution;

void      fw_distribution_constant(fw_distribution *d, double value);
/* Takes copies of values and weights, sorts them and joins equal values. FW_E_ARG: n = 0, a weight < 0 or not finite,
 * |sum - 1| > 1e-6 (the weights are then renormalised to 1 exactly). */
fw_status fw_distribution_values(fw_distribution *d, size_t n, const double *values, const double *weights, fw_msg *m);
fw_status fw_distribution_check(const fw_distribution *d,
                                fw_msg                *m);                    /* parameters legal, mass inside [low, high] > 0 */
const char *fw_distribution_kind_name(fw_distribution_kind k); /* "weibull" */

double fw_distribution_quantile(const fw_distribution *d, double u); /* u in (0, 1); FW_DIST_CONSTANT ignores u */
double fw_distribution_cdf(const fw_distribution *d, double x);      /* P(X <= x) */
double fw_distribution_cdf_left(const fw_distribution *d, double x); /* P(X < x) */
double fw_distribution_mean(const fw_distribution *d);
double fw_distribution_min(const fw_distribution *d); /* ends of the support, may be infinite */
double fw_distribution_max(const fw_distribution *d);
bool   fw_distribution_is_constant(const fw_distribution *d); /* both are one value */

fw_status fw_distribution_copy(fw_distribution *to, const fw_distribution *from, fw_msg *m);
void      fw_distribution_free(fw_distribution *d); /* frees what it owns, not d; a zeroed struct is fine */

#endif
