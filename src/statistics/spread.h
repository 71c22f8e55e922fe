/* Variance of a weighted mean over realisations that are independent, or that come in independent randomisations of a sampling design. */
#ifndef FW_STATISTICS_SPREAD_H
#define FW_STATISTICS_SPREAD_H

#include <stddef.h>
#include <stdint.h>

typedef struct fw_units {
    size_t         n;
    const double  *weight;   /* (n) sum to 1; borrowed */
    const int32_t *unit;     /* (n) 0 .. n_units - 1: the randomisation that each belongs to; NULL: each is one of its own; borrowed */
    size_t         n_units;  /* n when unit is NULL */
    size_t         n_fitted; /* functions that the values are residuals from, the mean included: degrees of freedom lost */
} fw_units;

typedef struct fw_spread {
    double variance;
    double dof; /* degrees of freedom that it is known with, at least 1: the number of units less what was fitted */
    double vov; /* variance of the variance, relative: sum z^4 / (sum z^2)^2 - 1/n over the units' shares z. Small where many units carry the
                 * variance (2/n for normal shares), near 1 where one of them does */
} fw_spread;

/* values (n): leave-one-out residuals (calibrate.h), of the mean alone n/(n - 1) times the distance from it: sum weight x value is about 0. scratch:
 * (n_units), unused when each is one of its own. */
fw_spread fw_spread_of(const fw_units *u, const double *values, double *scratch);

#endif
