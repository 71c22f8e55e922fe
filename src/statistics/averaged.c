#include "statistics/averaged.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

double fw_averaged_kish_size(const fw_averaged_at *at)
{
    double plain = at->cdf * (1 - at->cdf);
    if (isnan(at->spread.variance)) return 0;
    if (!(plain > 1e-15) || !(at->spread.variance > 0)) return FW_AVERAGED_MOST_N;
    return fmin(plain / at->spread.variance, FW_AVERAGED_MOST_N);
}

double fw_averaged_effective_size(const fw_averaged_at *at, double confidence)
{
    double plain = at->cdf * (1 - at->cdf), upper = 0.5 + 0.5 * confidence, n = fw_averaged_kish_size(at);
    if (!(n > 0 && n < FW_AVERAGED_MOST_N)) return n;
    double of_steps = (1 - 4 * plain) / (plain * n), excess = fmax(0, at->spread.vov - of_steps);
    double dof = excess > 0 ? fmax(1, fmin(at->spread.dof, 2 / excess)) : at->spread.dof;
    double known = gsl_cdf_ugaussian_Pinv(upper) / gsl_cdf_tdist_Pinv(upper, dof);
    return n * known * known;
}

/* k below n p with P(Bin(n, p) < k) + P(Bin = k) / 2 = tail, mid-P, for real n and k: between P(Bin <= k) = I_{1-p}(n - k, k + 1) and the same
 * of k - 1 lies I_{1-p}(n - k + 1/2, k + 1/2). */
static double count_below(double n, double p, double tail)
{
    double from = 0, to = n * p;
    for (int i = 0; i < 60; i++) {
        double k = 0.5 * (from + to);
        if (gsl_cdf_beta_P(1 - p, n - k + 0.5, k + 0.5) <= tail) {
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

fw_interval fw_averaged_interval(const fw_averaged *x, double p, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    if (x->n < FW_AVERAGED_MIN_N || !(x->failed_share < 1) || !(p > 0 && p < 1) || !(confidence > 0 && confidence < 1)) return out;

    double of_all = 1 / (1 - x->failed_share), size = INFINITY;
    for (int round = 0; round < 3; round++) {
        double depth = round == 0 ? x->quantile(x->self, p) : round == 1 ? out.low : out.high;
        if (isnan(depth)) continue; /* no such end yet: nothing to look at there */
        fw_averaged_at at;
        if (round == 0 && x->at_percentile)
            at = *x->at_percentile;
        else
            x->at(x->self, depth, &at);
        double here = of_all * fw_averaged_effective_size(&at, confidence), low_level = NAN, high_level = NAN;
        if (here >= size) continue;
        size = here;
        fw_averaged_levels(size, p, confidence, &low_level, &high_level);
        double low = (low_level - x->failed_share) * of_all, high = high_level * of_all;
        out.low = isnan(low) ? NAN : low <= 0 ? 0 : x->quantile(x->self, fmin(low * (1 + 1e-12), 1));
        out.high = high <= 1 ? x->quantile(x->self, high) : NAN;
    }
    if (!isnan(out.low) || !isnan(out.high)) out.coverage = confidence;
    return out;
}
