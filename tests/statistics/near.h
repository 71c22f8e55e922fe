/* What the statistics tests share: comparison with a relative tolerance, and laws to draw samples from. */
#ifndef FW_TESTS_STATISTICS_NEAR_H
#define FW_TESTS_STATISTICS_NEAR_H

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#include "base/random.h"

#define assert_near(got, want, relative)                                                                               \
    do {                                                                                                               \
        double got_ = (got), want_ = (want);                                                                           \
        if (!(fabs(got_ - want_) <= (relative)*fabs(want_)))                                                           \
            fail_msg("%s is %.17g, want %.17g (relative %.3g)", #got, got_, want_, (got_ - want_) / want_);            \
    } while (0)

/* Lognormal with median 1 and the given coefficient of variation: sigma^2 = ln(1 + CV^2). */
static inline double lognormal_sigma(double cv) { return sqrt(log1p(cv * cv)); }
static inline double lognormal_quantile(double sigma, double u) { return exp(sigma * gsl_cdf_ugaussian_Pinv(u)); }

static inline int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Standard error of a coverage counted in n repeats. */
static inline double coverage_error(double coverage, double n) { return sqrt(coverage * (1 - coverage) / n); }

#endif
