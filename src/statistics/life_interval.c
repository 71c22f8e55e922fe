#include "statistics/life_interval.h"

#include <math.h>

#include "statistics/mean.h"

fw_life_slopes fw_life_slopes_make(const fw_life_spread *l, double mean, double variance, double percentile)
{
    double sd = fw_life_spread_sd(l, mean, variance);
    if (!(sd > 0)) return (fw_life_slopes){l->windows, 0};
    double k = (percentile - l->windows * mean) / sd;
    return (fw_life_slopes){l->windows + k / sd * (l->years - l->scatter) * mean, 0.5 * k / sd * l->scatter};
}

/* windows, scatter and years of fw_life_spread are n_years times mean x, mean f^2 A and var x over rows, x = f n. */
fw_interval fw_life_years_interval(const fw_years *y, const double *sums, double mean, double variance, double percentile, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    if (!y->is_table || y->n < FW_LIFE_YEARS || y->n > FW_LIVES_KINDS || !(confidence > 0 && confidence < 1)) return out;
    double values[FW_LIVES_KINDS], n = (double)y->n, each = (double)y->n_years, windows = 0, square = 0, scatter = 0;
    for (size_t i = 0; i < y->n; i++) {
        double f = y->kinds[i].factor, x = f * (double)y->kinds[i].windows;
        windows += x / n, square += x * x / n, scatter += f * f * sums[i] / n;
    }
    fw_life_spread l = {each * windows, each * scatter, each * fmax(0, square - windows * windows)};
    double         sd = fw_life_spread_sd(&l, mean, variance), k = sd > 0 ? (percentile - l.windows * mean) / sd : 0;
    for (size_t i = 0; i < y->n; i++) {
        double f = y->kinds[i].factor, x = f * (double)y->kinds[i].windows, d = x - windows;
        double by_sd = sd > 0 ? 0.5 * k / sd * ((f * f * sums[i] - scatter) * variance + (d * d - l.years / each) * mean * mean) : 0;
        values[i] = percentile + each * (d * mean + by_sd);
    }
    out = fw_mean_interval_about(percentile, y->n, values, 0, 0, confidence);
    out.low = fmax(0, out.low);
    return out;
}

fw_interval fw_life_both(double value, fw_interval a, fw_interval b)
{
    double low = value - hypot(value - a.low, value - b.low);
    return (fw_interval){low < 0 ? 0 : low, value + hypot(a.high - value, b.high - value), fmin(a.coverage, b.coverage)};
}
