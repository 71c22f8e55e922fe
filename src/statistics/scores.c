#include "statistics/scores.h"

#include <math.h>
#include <string.h>

static const double ROOT = 0.39894228040143267794; /* 1/sqrt(2 pi) */

static double score_at(size_t k) { return (double)k / FW_SCORES_PER_UNIT - FW_SCORES_REACH; }

/* Normalised Hermite polynomials: h_(j+1) = (z h_j - sqrt(j) h_(j-1)) / sqrt(j + 1). */
static void take_shares(fw_scores *s)
{
    double sum[1 + FW_SCORES_TERMS] = {0}, square = 0, left = 1;
    for (size_t k = 0; k < FW_SCORES_NODES; k++) {
        double z = score_at(k), weight = ROOT * exp(-0.5 * z * z) / FW_SCORES_PER_UNIT;
        double before = 0, now = 1;
        for (int j = 0; j <= FW_SCORES_TERMS; j++) {
            sum[j] += weight * s->depth[k] * now;
            double next = (z * now - sqrt(j) * before) / sqrt(j + 1);
            before = now, now = next;
        }
        square += weight * s->depth[k] * s->depth[k];
    }
    double variance = square - sum[0] * sum[0];
    for (int j = 1; j <= FW_SCORES_TERMS; j++) {
        s->share[j] = variance > 1e-14 * square ? sum[j] * sum[j] / variance : 0;
        left -= s->share[j];
    }
    s->share[0] = fmax(0, left);
}

fw_status fw_scores_make(fw_scores *out, double (*depth)(const void *self, double score), const void *self, double mean, double variance,
                         fw_msg *m)
{
    FW_CHECK(isfinite(mean) && mean >= 0 && isfinite(variance) && variance >= 0, m, FW_E_ARG,
             "windows of mean %g and variance %g: both have to be finite and >= 0", mean, variance);
    out->mean = mean;
    out->variance = variance;
    for (size_t k = 0; k < FW_SCORES_NODES; k++) {
        double d = depth(self, score_at(k));
        FW_CHECK(isfinite(d) && d >= 0 && (k == 0 || d >= out->depth[k - 1] * (1 - 1e-9)), m, FW_E_ARG,
                 "the depth of a window at score %g is %g, wanted one that is finite and does not fall", score_at(k), d);
        out->depth[k] = k == 0 ? d : fmax(d, out->depth[k - 1]);
    }
    take_shares(out);
    return FW_OK;
}

void fw_scores_bare(fw_scores *out, double mean, double variance)
{
    memset(out, 0, sizeof *out);
    out->mean = mean, out->variance = variance, out->share[0] = 1;
}

double fw_scores_correlation(const fw_scores *s, double phi, double lag)
{
    double sum = 0, r = pow(phi, lag), power = 1;
    if (lag == 0) return 1;
    for (int j = 1; j <= FW_SCORES_TERMS; j++) sum += s->share[j] * (power *= r);
    return sum + s->share[0] * power * r;
}

/* Sum over all pairs of n windows of r^distance: n + 2 sum over k of (n - k) r^k, summed in closed form. */
static double pairs(double r, double n)
{
    return n * (1 + r) / (1 - r) - 2 * r * (1 - pow(r, n)) / ((1 - r) * (1 - r));
}

double fw_scores_sum(const fw_scores *s, double phi, double n)
{
    double sum = 0, r = 1;
    for (int j = 1; j <= FW_SCORES_TERMS; j++) sum += s->share[j] * pairs(r *= phi, n);
    return sum + s->share[0] * pairs(r * phi, n);
}
