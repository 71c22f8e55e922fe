#include "statistics/order.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

double fw_order_percentile(size_t n, const double *sorted, double p)
{
    if (n == 0 || !(p >= 0 && p <= 1)) return NAN;
    double rank = p * (double)(n - 1);
    size_t k = (size_t)rank;
    if (k + 1 >= n) return sorted[n - 1];
    double part = rank - (double)k;
    if (part == 0 || sorted[k] == sorted[k + 1]) return sorted[k]; /* infinite neighbours stay harmless */
    return sorted[k] + part * (sorted[k + 1] - sorted[k]);
}

/* Smallest k in 0..n with P(Bin(n, p) <= k) > tail. */
static unsigned first_above(unsigned n, double p, double tail)
{
    unsigned from = 0, to = n;
    while (from < to) {
        unsigned k = from + (to - from) / 2;
        if (gsl_cdf_binomial_P(k, p, n) > tail) {
            to = k;
        } else {
            from = k + 1;
        }
    }
    return from;
}

/* Smallest u in 1..n+1 with P(Bin(n, p) >= u) <= tail; n + 1 means none. */
static unsigned first_rare(unsigned n, double p, double tail)
{
    unsigned from = 1, to = n + 1;
    while (from < to) {
        unsigned u = from + (to - from) / 2;
        if (gsl_cdf_binomial_Q(u - 1, p, n) <= tail) {
            to = u;
        } else {
            from = u + 1;
        }
    }
    return from;
}

fw_interval fw_order_interval(size_t n, const double *sorted, size_t n_failed, double p, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    size_t      total = n + n_failed;
    double      tail = 0.5 * (1 - confidence);
    if (total == 0 || total > 0x7fffffff || !(p > 0 && p < 1) || !(confidence > 0 && confidence < 1)) return out;

    unsigned n_all = (unsigned)total;
    unsigned l = first_above(n_all, p, tail); /* P(Bin <= l - 1) <= tail < P(Bin <= l): rank l; 0 means none */
    unsigned u = first_rare(n_all, p, tail);  /* rank u; n_all + 1 means none */
    if (l > 0) out.low = l <= n_failed ? 0 : sorted[l - n_failed - 1];
    if (u <= n) out.high = sorted[u - 1]; /* ranks above n belong to the failed ones, at +infinity */
    if (isnan(out.low) && isnan(out.high)) return out;

    double below = l > 0 ? gsl_cdf_binomial_P(l - 1, p, n_all) : 0;
    double above = u <= n ? gsl_cdf_binomial_Q(u - 1, p, n_all) : 0;
    out.coverage = 1 - below - above;
    return out;
}
