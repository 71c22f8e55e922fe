/* Sums of independent windows: the depth of a service life.
 *
 * A life is a sum of n windows, n in the tens of thousands, not an extreme value. Its first three moments are those
 * of the window (mean n mu, variance n s^2, skewness g/sqrt(n)); the percentile is that of the gamma law with the
 * same three (Pearson III). That is exact for a sum of gamma windows, normal for n -> infinity and, unlike a
 * Cornish-Fisher expansion, monotone. Where few windows leave much of their own shape in the sum (skewness of the sum
 * above FW_LIFE_SKEWNESS), where windows resemble their neighbours or years differ, lives are simulated instead (lives.h). */
#ifndef FW_STATISTICS_LIFE_H
#define FW_STATISTICS_LIFE_H

#include <stdbool.h>

/* At this skewness the Pearson III percentiles P50..P99 of a sum of lognormal CV 1.5 windows are right within 1 %
 * (tested). */
#define FW_LIFE_SKEWNESS 0.3

typedef struct fw_life {
    double mean, sd, skewness; /* of one window */
} fw_life;

/* From raw moments E D, E D^2, E D^3. */
fw_life fw_life_of_moments(double m1, double m2, double m3);
double  fw_life_percentile(const fw_life *window, double n_windows, double p); /* of the sum; n_windows > 0 */
double  fw_life_cdf(const fw_life *window, double n_windows, double x);        /* P(sum <= x), the percentile read backwards; 1e-12 */
bool    fw_life_is_smooth(const fw_life *window, double n_windows);            /* skewness of the sum small enough */

#endif
