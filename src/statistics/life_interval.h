/* Intervals of a life's percentile: from what each window record says of the law of windows, and each row of a table of years of that of years.
 *
 * A life's percentile is windows E D + k sd, sd^2 = scatter var D + years (E D)^2 (lives.h), k its distance from the mean in standard
 * deviations. It depends on the records through E D and E D^2, means of numbers that each record gives: to first order the percentile is
 * itself a mean over records, of
 *     percentile + (d/dE D) (first_i - E D) + (d/dE D^2) (second_i - E D^2)
 * (pseudo-values), and over the rows of a table likewise. Of k, the shape of a life's law, nothing is propagated.
 *
 * The interval is that of a mean (mean.h), of the pseudo-values. At 95 % it keeps 93 to 97 % in every case tested: 60 to 400 records of a lognormal of CV 1.5,
 * a Weibull of shape 0.7 and a mixture, percentiles from P50 to P99, with and without persistence 0.97 and a year CV of 0.4; rows of a table, 8 to 40
 * lognormal ones of CV 0.4, from 93 % (tests/statistics/test_life_interval.c). Drawing tables of the same length from the rows (percentile bootstrap,
 * stretched by t/z) kept 89-94 % and is not used. */
#ifndef FW_STATISTICS_LIFE_INTERVAL_H
#define FW_STATISTICS_LIFE_INTERVAL_H

#include "statistics/lives.h"
#include "statistics/order.h"

enum { FW_LIFE_YEARS = 8 /* rows of a table; no interval below. Records and randomisations: as of a mean */ };

/* How the percentile moves with E D and E D^2 of a window. */
typedef struct fw_life_slopes {
    double first, second;
} fw_life_slopes;
fw_life_slopes fw_life_slopes_make(const fw_life_spread *l, double mean, double variance, double percentile);

/* For not knowing the law of years better than a table tells. sums (years->n): of each row, fw_scores_sum of its windows. */
fw_interval fw_life_years_interval(const fw_years *y, const double *sums, double mean, double variance, double percentile, double confidence);

/* Of two things that are not known, independent of one another: distances from the value add in squares. An end that is missing in one is
 * missing in both. */
fw_interval fw_life_both(double value, fw_interval a, fw_interval b);

#endif
