#include "statistics/life.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "floewear/distribution.h"

fw_life fw_life_of_moments(double m1, double m2, double m3)
{
    double variance = m2 - m1 * m1;
    if (!(variance > 1e-14 * m2)) return (fw_life){m1, 0, 0};
    double sd = sqrt(variance), third = m3 - 3 * m1 * m2 + 2 * m1 * m1 * m1;
    return (fw_life){m1, sd, third / (sd * sd * sd)};
}

/* Standardised quantile of the gamma law with skewness g; the law's shape is 4/g^2. */
static double pearson_quantile(double g, double p)
{
    if (g < 0) return -pearson_quantile(-g, 1 - p);
    if (g < 1e-7) return gsl_cdf_ugaussian_Pinv(p);
    double shape = 4 / (g * g);
    if (shape > 1e4) { /* Cornish and Fisher's expansion of the gamma law; error O(g^3) */
        double z = gsl_cdf_ugaussian_Pinv(p);
        return z + g * (z * z - 1) / 6 + g * g * (z * z * z - 7 * z) / 144;
    }
    fw_distribution gamma = {.kind = FW_DIST_GAMMA, .a = shape, .b = 1, .low = -INFINITY, .high = INFINITY};
    return (fw_distribution_quantile(&gamma, p) - shape) / sqrt(shape);
}

double fw_life_percentile(const fw_life *window, double n_windows, double p)
{
    double root = sqrt(n_windows);
    if (window->sd == 0) return n_windows * window->mean;
    return n_windows * window->mean + root * window->sd * pearson_quantile(window->skewness / root, p);
}

bool fw_life_is_smooth(const fw_life *window, double n_windows)
{
    return fabs(window->skewness) <= FW_LIFE_SKEWNESS * sqrt(n_windows);
}

double fw_life_windows_to(const fw_life *window, double limit, double n_most, double p)
{
    if (!(n_most > 0) || !(fw_life_percentile(window, n_most, p) >= limit)) return INFINITY;
    double from = 0, to = n_most;
    for (int i = 0; i < 60; i++) {
        double n = 0.5 * (from + to);
        if (n > 0 && fw_life_percentile(window, n, p) >= limit) {
            to = n;
        } else {
            from = n;
        }
    }
    return to;
}
