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

/* From this shape on the gamma law's quantile is Cornish and Fisher's expansion (Goldberg and Levine 1946, Ann. Math. Stat. 17, 216): to
 * 1e-9 of a standard deviation between P1 and P99, and a hundred times as fast as the iteration (tested against it). */
static const double EXPANDED = 400;

static double expansion(double g, double z)
{
    double z2 = z * z;
    return z + g * ((z2 - 1) / 6 + g * (z * (z2 - 7) / 144 + g * (-(z2 * (6 * z2 + 14) - 32) / 12960 + g * z * (z2 * (9 * z2 + 256) - 433) / 622080)));
}

/* Standardised quantile of the gamma law with skewness g; the law's shape is 4/g^2. */
static double pearson_quantile(double g, double p)
{
    if (g < 0) return -pearson_quantile(-g, 1 - p);
    double shape = 4 / (g * g);
    if (shape > EXPANDED) return expansion(g, gsl_cdf_ugaussian_Pinv(p));
    fw_distribution gamma = {.kind = FW_DIST_GAMMA, .a = shape, .b = 1, .low = -INFINITY, .high = INFINITY};
    return (fw_distribution_quantile(&gamma, p) - shape) / sqrt(shape);
}

double fw_life_percentile(const fw_life *window, double n_windows, double p)
{
    double root = sqrt(n_windows);
    if (window->sd == 0) return n_windows * window->mean;
    return n_windows * window->mean + root * window->sd * pearson_quantile(window->skewness / root, p);
}

double fw_life_cdf(const fw_life *window, double n_windows, double x)
{
    if (window->sd == 0) return n_windows * window->mean <= x;
    double root = sqrt(n_windows), y = (x - n_windows * window->mean) / (root * window->sd), g = window->skewness / root;
    double shape = 4 / (g * g), from = -8, to = 8; /* normal scores */
    if (g > 0 && shape <= EXPANDED) return gsl_cdf_gamma_P(fmax(0, shape + sqrt(shape) * y), shape, 1);
    for (int i = 0; i < 48; i++) {
        double z = 0.5 * (from + to);
        if (pearson_quantile(g, gsl_cdf_ugaussian_P(z)) <= y) {
            from = z;
        } else {
            to = z;
        }
    }
    return from == -8 ? 0 : to == 8 ? 1 : gsl_cdf_ugaussian_P(from);
}

bool fw_life_is_smooth(const fw_life *window, double n_windows)
{
    return fabs(window->skewness) <= FW_LIFE_SKEWNESS * sqrt(n_windows);
}
