#include "statistics/averaged.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

double fw_averaged_effective_size(size_t n, double sum, double sum_of_squares, double confidence)
{
    const double most = 1e8; /* equal F_i: the sampling error is nil; keeps the incomplete beta function in its range */
    if (n < 2) return 0;
    double count = (double)n, mean = sum / count, plain = mean * (1 - mean);
    double upper = 0.5 + 0.5 * confidence;
    double known = gsl_cdf_ugaussian_Pinv(upper) / gsl_cdf_tdist_Pinv(upper, count - 1);
    if (!(plain > 1e-15)) return count * known * known;
    double variance = (sum_of_squares - count * mean * mean) / (count - 1);
    if (!(variance > 0)) return most;
    return fmin(count * plain / variance * known * known, most);
}

/* k below n p with P(Bin(n, p) <= k) = tail; P(Bin <= k) = I_{1-p}(n - k, k + 1) for real n and k. */
static double count_below(double n, double p, double tail)
{
    double from = 0, to = n * p;
    for (int i = 0; i < 60; i++) {
        double k = 0.5 * (from + to);
        if (gsl_cdf_beta_P(1 - p, n - k, k + 1) <= tail) {
            from = k;
        } else {
            to = k;
        }
    }
    return from;
}

void fw_averaged_levels(double n_effective, double p, double confidence, double *low, double *high)
{
    double n = n_effective, tail = 0.5 * (1 - confidence);
    *low = *high = NAN;
    if (!(n > 0 && p > 0 && p < 1 && confidence > 0 && confidence < 1)) return;
    if (n * log1p(-p) <= log(tail)) *low = count_below(n, p, tail) / n;
    /* P(Bin(n, p) >= u) = P(Bin(n, 1 - p) <= n - u): the same question from the other side */
    if (n * log(p) <= log(tail)) *high = 1 - count_below(n, 1 - p, tail) / n;
}

fw_interval fw_averaged_interval(const fw_mixture *x, size_t n, size_t n_failed, const fw_averaged_parts *parts,
                                 double p, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    size_t      total = n + n_failed;
    if (n == 0 || total < FW_AVERAGED_MIN_N || !(p > 0 && p < 1) || !(confidence > 0 && confidence < 1)) return out;

    double of_all = (double)total / (double)n, size = INFINITY;
    for (int round = 0; round < 3; round++) {
        double at = round == 0 ? fw_mixture_quantile(x, p) : round == 1 ? out.low : out.high;
        if (isnan(at)) continue; /* no such end yet: nothing to look at there */
        double sum = 0, squares = 0, low_level = NAN, high_level = NAN;
        parts->sums(parts->self, at, &sum, &squares);
        double here = of_all * fw_averaged_effective_size(n, sum, squares, confidence);
        if (here >= size) continue;
        size = here;
        fw_averaged_levels(size, p, confidence, &low_level, &high_level);
        double low = low_level * of_all - (double)n_failed / (double)n, high = high_level * of_all;
        out.low = isnan(low) ? NAN : low <= 0 ? 0 : fw_mixture_quantile(x, fmin(low * (1 + 1e-12), 1));
        out.high = high <= 1 ? fw_mixture_quantile(x, high) : NAN;
    }
    if (!isnan(out.low) || !isnan(out.high)) out.coverage = confidence;
    return out;
}
