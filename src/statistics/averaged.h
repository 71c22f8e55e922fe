/* Interval of a percentile of an averaged CDF, F(x) = mean over i of F_i(x), where each realisation i gives a whole
 * distribution F_i instead of one number (temperature and direction are integrated, not sampled).
 *
 * Such a CDF has no order statistics, but at any x the F_i(x) are numbers in [0, 1] whose weighted mean is F(x), and the variance of that mean is
 * known from their scatter (spread.h), be the realisations independent, weighted, calibrated or in randomisations of a design. Beside F (1 - F),
 * the variance of one plain draw, it says how much the averaging is worth:
 *     n_effective = F (1 - F) / variance   (Kish's effective sample size; n when every F_i is a step of a plain sample)
 * A binomial interval for a sample of that size, continued to real n by the incomplete beta function, then gives levels below and above p, and the
 * averaged CDF read backwards at these levels gives the ends (Woodruff 1952; Korn and Graubard 1998 for the effective size in a binomial interval).
 * Levels are those of the mid-P interval: an average takes every value between its steps, and the exact binomial's ends, which are for steps alone,
 * would cover up to 99 % for 95. An end that does not exist for n_effective is not offered.
 *
 * Why not sectioning (B batches, t interval of the batch quantiles): measured on lognormal, exponential and Pareto
 * laws, it keeps 93-97 % only when each of at least six batches holds three values beyond the percentile, n >= 180
 * for P90 and 1800 for P99. Coverage of this one, and where it is refused: tests/statistics/test_averaged.c. */
#ifndef FW_STATISTICS_AVERAGED_H
#define FW_STATISTICS_AVERAGED_H

#include <stddef.h>

#include "statistics/order.h"
#include "statistics/spread.h"

/* Below this the variance of the F_i is too poorly known: no interval is offered. */
enum { FW_AVERAGED_MIN_N = 40 };
/* Equal F_i: the sampling error is nil; keeps the incomplete beta function in its range. */
#define FW_AVERAGED_MOST_N 1e8

/* The averaged CDF at one depth and how well it is known there. */
typedef struct fw_averaged_at {
    double    cdf;
    fw_spread spread;
} fw_averaged_at;

/* n_effective as above; 0 when the variance is not known, 1e8, the most, when there is none. */
double fw_averaged_kish_size(const fw_averaged_at *at);

/* n_effective, less what is lost by estimating the variance with few degrees of freedom: (normal quantile / t quantile)^2. Where few realisations carry the
 * variance there are fewer of them: 2 / vov, vov less that of a plain sample's steps, (1 - 4 F (1 - F)) / (n F (1 - F)), which the binomial interval
 * allows for itself. */
double fw_averaged_effective_size(const fw_averaged_at *at, double confidence);

/* Levels of the averaged CDF at which the ends of the p-quantile's interval lie; NAN where there is none. */
void fw_averaged_levels(double n_effective, double p, double confidence, double *low, double *high);

typedef struct fw_averaged {
    void (*at)(void *self, double depth, fw_averaged_at *out);
    double (*quantile)(void *self, double level); /* of the averaged CDF; level in (0, 1] */
    void  *self;
    size_t n;            /* realisations */
    const fw_averaged_at *at_percentile; /* known there already; NULL: it is asked for */
    double failed_share; /* of the weight, by those that failed */
} fw_averaged;

/* Interval of the p-quantile. The effective size is the smallest of those at the percentile and at both ends: where a gap between two directions
 * makes all F_i equal by chance, a variance of 0 there says nothing. Failed realisations count as 0 for the lower end and as +infinity for the
 * upper one, as in order.h. coverage is the nominal one; NAN (no interval) when n < FW_AVERAGED_MIN_N. */
fw_interval fw_averaged_interval(const fw_averaged *x, double p, double confidence);

#endif
