/* Interval of a percentile of an averaged CDF, F(x) = mean over i of F_i(x), where each realisation i gives a whole
 * distribution F_i instead of one number (temperature and direction are integrated, not sampled).
 *
 * Such a CDF has no order statistics, but at any x the F_i(x) are independent numbers in [0, 1] whose mean is F(x).
 * Their variance s^2 is at most F (1 - F), the variance of plain sampling; the quotient says how much the
 * integration is worth:
 *     n_effective = n F (1 - F) / s^2   (Kish's effective sample size; n when every F_i is a step, a plain sample)
 * The binomial interval of a sample of that size, continued to real n by the incomplete beta function, then gives
 * levels below and above p, and the averaged CDF read backwards at these levels gives the ends (Woodruff 1952; Korn
 * and Graubard 1998 for the effective size in a binomial interval). An end that does not exist for n_effective is not
 * offered, as with order statistics, into which this interval passes when the F_i become steps.
 *
 * Why not sectioning (B batches, t interval of the batch quantiles): measured on lognormal, exponential and Pareto
 * laws, it keeps 93-97 % only when each of at least six batches holds three values beyond the percentile, n >= 180
 * for P90 and 1800 for P99; this one covers 94.5 % or more from n = 20 on (conservative, up to 99 %, where few
 * realisations lie beyond the percentile; tests/statistics/test_averaged.c) and says itself when an end is missing. */
#ifndef FW_STATISTICS_AVERAGED_H
#define FW_STATISTICS_AVERAGED_H

#include <stddef.h>

#include "statistics/mixture.h"
#include "statistics/order.h"

/* Below this the variance of the F_i is too poorly known: no interval is offered. */
enum { FW_AVERAGED_MIN_N = 20 };

/* n_effective from sum and sum of squares of the n numbers F_i(x); the digits lost by estimating s^2 are taken off by
 * (normal quantile / t quantile)^2 with n - 1 degrees of freedom. At most 1e8; n itself when F(x) is 0 or 1; 0 when
 * n < 2. */
double fw_averaged_effective_size(size_t n, double sum, double sum_of_squares, double confidence);

/* Levels of the averaged CDF at which the ends of the p-quantile's interval lie; NAN where there is none. */
void fw_averaged_levels(double n_effective, double p, double confidence, double *low, double *high);

/* One realisation's own CDF at a depth, summed over the n realisations: *sum = sum F_i, *squares = sum F_i^2. */
typedef struct fw_averaged_parts {
    void (*sums)(void *self, double depth, double *sum, double *squares);
    void *self;
} fw_averaged_parts;

/* Interval of the p-quantile of x, the average of n realisations' CDFs. The effective size is the smallest of those at
 * the percentile and at both ends: where a gap between two directions makes all F_i equal by chance, s^2 = 0 there says
 * nothing. n_failed realisations count as 0 for the lower end and as +infinity for the upper one, as in order.h.
 * coverage is the nominal one; NAN (no interval) when n + n_failed < FW_AVERAGED_MIN_N or n = 0. */
fw_interval fw_averaged_interval(const fw_mixture *x, size_t n, size_t n_failed, const fw_averaged_parts *parts,
                                 double p, double confidence);

#endif
