#include "statistics/scale.h"

#include <gsl/gsl_integration.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* y at temperature T; grows with T, since |T| shrinks */
static double factor_at(const fw_scale *s, double T) { return s->coefficient * pow(-T, -s->exponent); }

static fw_status make_atoms(fw_scale *s, size_t n, fw_msg *m)
{
    s->is_discrete = true;
    FW_TRY(fw_alloc(&s->values, n, sizeof *s->values, "atoms of a temperature law", m));
    FW_TRY(fw_alloc(&s->weights, n, sizeof *s->weights, "atoms of a temperature law", m));
    return FW_OK;
}

static void discrete_moments(fw_scale *s)
{
    for (size_t k = 0; k <= FW_SCALE_MOMENTS; k++) {
        s->moment[k] = 0;
        for (size_t i = 0; i < s->n; i++) s->moment[k] += s->weights[i] * pow(s->values[i], (double)k);
    }
}

/* E Y^k = ymax^k - int k y^(k-1) P(Y <= y) dy, in ln y, by Gauss-Legendre on 64 panels: the CDF is smooth but for the
 * kinks of truncated and triangular laws, and a kink costs one panel's share of digits only. */
static fw_status continuous_moments(fw_scale *s, fw_msg *m)
{
    const int                      n_panels = 64;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(20);
    FW_CHECK(rule, m, FW_E_NOMEM, "out of memory: Gauss-Legendre rule");
    double below[1 + FW_SCALE_MOMENTS] = {0};
    double step = (s->ln_max - s->ln_min) / n_panels;
    for (int panel = 0; panel < n_panels; panel++) {
        double from = s->ln_min + panel * step;
        for (size_t i = 0; i < 20; i++) {
            double x, w;
            gsl_integration_glfixed_point(from, from + step, i, &x, &w, rule);
            double y = exp(x), p = fw_scale_cdf(s, y);
            for (int k = 1; k <= FW_SCALE_MOMENTS; k++) below[k] += w * k * pow(y, k) * p;
        }
    }
    gsl_integration_glfixed_table_free(rule);
    s->moment[0] = 1;
    for (int k = 1; k <= FW_SCALE_MOMENTS; k++) s->moment[k] = exp(k * s->ln_max) - below[k];
    return FW_OK;
}

static fw_status make_continuous(fw_scale *s, fw_msg *m)
{
    const fw_distribution *T = s->temperature;
    double                 coldest = fw_distribution_min(T);
    if (!isfinite(coldest)) coldest = fw_distribution_quantile(T, 1e-14);
    s->ln_min = log(factor_at(s, coldest));
    s->ln_max = log(factor_at(s, fw_distribution_max(T)));
    s->ln_step = (s->ln_max - s->ln_min) / FW_SCALE_NODES;
    FW_TRY(fw_alloc(&s->table, FW_SCALE_NODES + 1, sizeof *s->table, "table of a temperature law", m));
    for (size_t k = 0; k <= FW_SCALE_NODES; k++) s->table[k] = fw_scale_cdf(s, exp(s->ln_min + (double)k * s->ln_step));
    s->table[FW_SCALE_NODES] = 1;
    return continuous_moments(s, m);
}

static fw_status make(fw_scale *s, fw_msg *m)
{
    const fw_distribution *T = s->temperature;
    if (T) {
        double warmest = fw_distribution_max(T);
        FW_CHECK(warmest < 0, m, FW_E_ARG, "the temperature law reaches %g degC; wear goes as |T|^-%g and needs T < 0",
                 warmest, s->exponent);
    }
    if (T && T->kind == FW_DIST_VALUES) {
        FW_TRY(make_atoms(s, T->n, m));
        for (size_t i = 0; i < T->n; i++) {
            double weight = fw_distribution_cdf(T, T->values[i]) - fw_distribution_cdf_left(T, T->values[i]);
            if (!(weight > 0)) continue; /* cut off, or never */
            s->values[s->n] = factor_at(s, T->values[i]);
            s->weights[s->n++] = weight;
        }
        discrete_moments(s);
        return FW_OK;
    }
    if (!T || fw_distribution_is_constant(T)) {
        FW_TRY(make_atoms(s, 1, m));
        s->n = 1;
        s->values[0] = T ? factor_at(s, fw_distribution_max(T)) : s->coefficient;
        s->weights[0] = 1;
        discrete_moments(s);
        return FW_OK;
    }
    return make_continuous(s, m);
}

fw_status fw_scale_make(fw_scale *out, double coefficient, double exponent, const fw_distribution *temperature,
                        fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_CHECK(coefficient > 0 && exponent > 0, m, FW_E_ARG,
             "a wear law needs a coefficient and an exponent above 0, not %g and %g", coefficient, exponent);
    out->coefficient = coefficient;
    out->exponent = exponent;
    out->temperature = temperature;
    fw_status s = make(out, m);
    if (s != FW_OK) fw_scale_free(out);
    return s;
}

void fw_scale_free(fw_scale *s)
{
    if (!s) return;
    free(s->values);
    free(s->weights);
    free(s->table);
    memset(s, 0, sizeof *s);
}

double fw_scale_cdf(const fw_scale *s, double y)
{
    if (s->is_discrete) {
        double sum = 0;
        for (size_t i = 0; i < s->n && s->values[i] <= y; i++) sum += s->weights[i];
        return fmin(sum, 1);
    }
    if (!(y > 0)) return 0;
    return fw_distribution_cdf(s->temperature, -pow(s->coefficient / y, 1 / s->exponent));
}

double fw_scale_quantile(const fw_scale *s, double u)
{
    if (!s->is_discrete) return factor_at(s, fw_distribution_quantile(s->temperature, u));
    double sum = 0;
    for (size_t i = 0; i + 1 < s->n; i++) {
        sum += s->weights[i];
        if (sum >= u) return s->values[i];
    }
    return s->values[s->n - 1];
}
