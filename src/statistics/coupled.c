#include "statistics/coupled.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

static const double GILES_KURTOSIS = 100;

double fw_coupled_gain(double rho, double w)
{
    double both = sqrt(fmax(0, 1 - rho * rho)) + sqrt(rho * rho / w);
    return 1 / (both * both);
}

typedef struct sums {
    double n, ee, dd, ed, dear_cost, cheap_cost;
} sums;

/* times NULL: each pair once. */
static sums sum_up(const fw_coupled_pairs *x, const uint16_t *times)
{
    sums s = {0};
    for (size_t i = 0; i < x->n; i++) {
        double t = times ? times[i] : 1, e = x->dear[i], d = x->cheap[i];
        s.n += t, s.ee += t * e * e, s.dd += t * d * d, s.ed += t * e * d;
        s.dear_cost += t * x->dear_cost[i], s.cheap_cost += t * x->cheap_cost[i];
    }
    return s;
}

static double correlation_of(const sums *s) { return s->ee > 0 && s->dd > 0 ? fmax(-1, fmin(1, s->ed / sqrt(s->ee * s->dd))) : 0; }

static double multifidelity(const sums *s) { return s->ee > 0 ? fw_coupled_gain(correlation_of(s), s->dear_cost / s->cheap_cost) : NAN; }

static double multilevel(const sums *s)
{
    double difference = fmax(0, s->ee + s->dd - 2 * s->ed);
    double both = sqrt(s->dd * s->cheap_cost) + sqrt(difference * (s->dear_cost + s->cheap_cost));
    return s->ee > 0 ? s->ee * s->dear_cost / (both * both) : NAN;
}

static fw_status resample(const fw_coupled_pairs *x, const fw_paired_draws *draws, double confidence, double (*gain)(const sums *s), fw_gain *out, fw_msg *m)
{
    sums    all = sum_up(x, NULL);
    double *values;
    size_t  n = 0;
    *out = (fw_gain){gain(&all), NAN, NAN};
    FW_TRY(fw_alloc(&values, FW_PAIRED_RESAMPLES, sizeof *values, "resampled gains", m));
    for (size_t k = 0; k < FW_PAIRED_RESAMPLES; k++) {
        sums   s = sum_up(x, draws->times + k * x->n);
        double g = gain(&s);
        if (!isnan(g)) values[n++] = g; /* a resample of pairs that do not scatter knows nothing */
    }
    gsl_sort(values, 1, n);
    size_t k = (size_t)floor((double)(n + 1) * (1 - confidence) / 2);
    if (n > 0 && k < 1) k = 1;
    if (n > 0) out->low = values[k - 1], out->high = values[n - k];
    free(values);
    return FW_OK;
}

static double kurtosis_of(const fw_coupled_pairs *x)
{
    double mean = 0, two = 0, four = 0, n = (double)x->n;
    for (size_t i = 0; i < x->n; i++) mean += (x->dear[i] - x->cheap[i]) / n;
    for (size_t i = 0; i < x->n; i++) {
        double z = x->dear[i] - x->cheap[i] - mean;
        two += z * z / n, four += z * z * z * z / n;
    }
    return two > 0 ? four / (two * two) : 1;
}

static double consistency_of(const fw_coupled_pairs *x)
{
    double n[3] = {0}, sum[3] = {0}, squares[3] = {0}, mean[3], errors = 0;
    for (size_t i = 0; i < x->n; i++) {
        size_t k = i % 3;
        double v = k == 0 ? x->dear[i] : k == 1 ? x->cheap[i] : x->dear[i] - x->cheap[i];
        n[k]++, sum[k] += v, squares[k] += v * v;
    }
    for (size_t k = 0; k < 3; k++) {
        if (n[k] < 2) return NAN;
        mean[k] = sum[k] / n[k];
        errors += sqrt(fmax(0, squares[k] / n[k] - mean[k] * mean[k]) / (n[k] - 1));
    }
    double off = fabs(mean[0] - mean[1] - mean[2]);
    return errors > 0 ? off / (3 * errors) : off > 0 ? INFINITY : 0;
}

fw_status fw_coupled_compare(const fw_coupled_pairs *x, const fw_paired_draws *draws, double confidence, fw_coupled *out, fw_msg *m)
{
    FW_CHECK(draws->n == x->n && x->n > 0, m, FW_E_ARG, "resamples of %zu pairs for %zu", draws->n, x->n);
    sums all = sum_up(x, NULL);
    *out = (fw_coupled){.cost_ratio = all.dear_cost / all.cheap_cost,
                        .correlation = correlation_of(&all),
                        .kurtosis = kurtosis_of(x),
                        .most_kurtosis = fmin(GILES_KURTOSIS, 0.25 * (double)x->n),
                        .consistency = consistency_of(x)};
    FW_TRY(resample(x, draws, confidence, multifidelity, &out->multifidelity, m));
    return resample(x, draws, confidence, multilevel, &out->multilevel, m);
}
