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

/* Laws that intervals are tested on: a lognormal of CV 1.5, a Weibull of shape 0.7 and scale 1 (CV 1.46), and windows of two kinds, 0.7 of them
 * lognormal(0, 0.5), 0.3 lognormal(ln 4, 1) (CV 2.2). */
typedef enum test_law { LAW_LOGNORMAL, LAW_WEIBULL, LAW_MIXTURE, N_LAWS } test_law;

static inline double law_draw(test_law law, double u)
{
    switch (law) {
    case LAW_WEIBULL: return pow(-log1p(-u), 1 / 0.7);
    case LAW_MIXTURE: return u < 0.7 ? lognormal_quantile(0.5, u / 0.7) : 4 * lognormal_quantile(1, (u - 0.7) / 0.3);
    default: return lognormal_quantile(lognormal_sigma(1.5), u);
    }
}

static inline double law_mean(test_law law)
{
    switch (law) {
    case LAW_WEIBULL: return tgamma(1 + 1 / 0.7);
    case LAW_MIXTURE: return 0.7 * exp(0.125) + 0.3 * 4 * exp(0.5);
    default: return exp(0.5 * log1p(2.25));
    }
}

static inline double law_cdf(test_law law, double x)
{
    if (!(x > 0)) return 0;
    switch (law) {
    case LAW_WEIBULL: return -expm1(-pow(x, 0.7));
    case LAW_MIXTURE: return 0.7 * gsl_cdf_ugaussian_P(log(x) / 0.5) + 0.3 * gsl_cdf_ugaussian_P(log(x / 4));
    default: return gsl_cdf_ugaussian_P(log(x) / lognormal_sigma(1.5));
    }
}

static inline int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Standard error of a coverage counted in n repeats. */
static inline double coverage_error(double coverage, double n) { return sqrt(coverage * (1 - coverage) / n); }

#endif
