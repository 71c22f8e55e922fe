#include "field/sizes.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <math.h>

#include "physics/unbreakable.h"

static const double MAX_POWER = 100.0; /* (low/high)^100 is far from overflow: high/low <= 4.9 for every h */
static const double MIN_MASS = 1e-6;   /* of a lognormal inside a class: less is an input error, not a law */

/* Integral of t^p over [low, high] divided by low^(p+1), exact also at p = -1: with s = p + 1 and l = ln(high/low) it
 * is (e^(s l) - 1)/s, whose limit at s = 0 is l. */
static double power_integral(double p, double l)
{
    double s = p + 1.0;
    return fabs(s * l) < 1e-12 ? l : expm1(s * l) / s;
}

/* Mass of the standard normal law in [alpha, beta], from the tail that keeps the digits. */
static double normal_mass(double alpha, double beta)
{
    return alpha > 0.0 ? gsl_cdf_ugaussian_Q(alpha) - gsl_cdf_ugaussian_Q(beta)
                       : gsl_cdf_ugaussian_P(beta) - gsl_cdf_ugaussian_P(alpha);
}

double fw_sizes_moment(const fw_sizes *s, size_t k, int power)
{
    const fw_sizes_class *c = &s->classes[k];
    double                lo = c->low, hi = c->high;
    if (lo == hi) return gsl_pow_int(lo, power);
    switch (s->law) {
    case FW_SIZE_POWER_LAW: { /* int D^(n-a) / int D^-a */
        double l = log(hi / lo);
        return gsl_pow_int(lo, power) * power_integral(power - s->a, l) / power_integral(-s->a, l);
    }
    case FW_SIZE_LOGNORMAL: {
        /* exp(n mu + n^2 s^2/2) [Phi(beta - n s) - Phi(alpha - n s)] / [Phi(beta) - Phi(alpha)] */
        double alpha = (log(lo) - s->a) / s->b, beta = (log(hi) - s->a) / s->b, n = power;
        return exp(n * s->a + 0.5 * n * n * s->b * s->b) * normal_mass(alpha - n * s->b, beta - n * s->b) / c->mass;
    }
    case FW_SIZE_UNIFORM: break;
    }
    return power == 1 ? 0.5 * (lo + hi) : (lo * lo + lo * hi + hi * hi) / 3.0;
}

double fw_sizes_quantile(const fw_sizes *s, size_t k, double v)
{
    const fw_sizes_class *c = &s->classes[k];
    double                lo = c->low, hi = c->high, d;
    if (lo == hi) return lo;
    switch (s->law) {
    case FW_SIZE_POWER_LAW: { /* (D/lo)^t = 1 + v ((hi/lo)^t - 1), t = 1 - a */
        double t = 1.0 - s->a, l = log(hi / lo);
        d = lo * exp(fabs(t * l) < 1e-12 ? v * l : log1p(v * expm1(t * l)) / t);
        break;
    }
    case FW_SIZE_LOGNORMAL: { /* counted from the tail that keeps the digits, like the mass */
        double z = log(lo) > s->a ? gsl_cdf_ugaussian_Qinv(c->mass_low - v * c->mass)
                                  : gsl_cdf_ugaussian_Pinv(c->mass_low + v * c->mass);
        d = exp(s->a + s->b * z);
        break;
    }
    case FW_SIZE_UNIFORM:
    default: d = lo + v * (hi - lo); break;
    }
    return GSL_MIN_DBL(hi, GSL_MAX_DBL(lo, d));
}

void fw_sizes_draw(const fw_sizes *s, double q, double *diameter, double *thickness)
{
    size_t k = s->n - 1;
    while (k > 0 && (q < s->classes[k].begin || s->classes[k].share == 0.0)) k--;
    while (s->classes[k].share == 0.0) k++; /* classes without floes at the thin end */
    double v = (q - s->classes[k].begin) / s->classes[k].share;
    *diameter = fw_sizes_quantile(s, k, GSL_MIN_DBL(1.0, GSL_MAX_DBL(0.0, v)));
    *thickness = s->classes[k].thickness;
}

static fw_status check_law(fw_size_law law, double a, double b, fw_msg *m)
{
    switch (law) {
    case FW_SIZE_UNIFORM: return FW_OK;
    case FW_SIZE_POWER_LAW:
        FW_CHECK(fabs(a) <= MAX_POWER, m, FW_E_ARG, "floe diameters: the power %g is outside -%g..%g", a, MAX_POWER,
                 MAX_POWER);
        return FW_OK;
    case FW_SIZE_LOGNORMAL:
        FW_CHECK(fabs(a) <= 10.0, m, FW_E_ARG, "floe diameters: lognormal mean of ln(D/m) %g is outside -10..10", a);
        FW_CHECK(b >= 1e-3 && b <= 5.0, m, FW_E_ARG, "floe diameters: lognormal spread %g is outside 0.001..5", b);
        return FW_OK;
    }
    return fw_fail(m, FW_E_ARG, "floe diameters: unknown law %d", (int)law);
}

static fw_status init_class(fw_sizes *s, size_t k, const fw_thickness_class *given, fw_msg *m)
{
    fw_sizes_class *c = &s->classes[k];
    double          h = given->thickness;
    FW_CHECK(fw_unbreakable_class_exists(h), m, FW_E_ARG,
             "thickness class %zu: %g m is outside %g..%g m, where 4h <= sqrt(130h - 11) leaves room for a diameter",
             k + 1, h, FW_THICKNESS_MIN, FW_THICKNESS_MAX);
    FW_CHECK(given->share >= 0.0 && given->share <= 1.0 + 1e-6, m, FW_E_ARG,
             "thickness class %zu (%g m): share %g is outside 0..1", k + 1, h, given->share);
    c->thickness = h;
    c->high = fw_unbreakable_max_diameter(h);
    c->low = GSL_MIN_DBL(fw_unbreakable_min_diameter(h), c->high);
    c->mass = 1.0;
    if (s->law == FW_SIZE_LOGNORMAL && c->low < c->high) {
        double alpha = (log(c->low) - s->a) / s->b, beta = (log(c->high) - s->a) / s->b;
        c->mass = normal_mass(alpha, beta);
        c->mass_low = alpha > 0.0 ? gsl_cdf_ugaussian_Q(alpha) : gsl_cdf_ugaussian_P(alpha);
        FW_CHECK(c->mass >= MIN_MASS, m, FW_E_ARG,
                 "thickness class %g m: the lognormal law has only %.2g of its mass between 4h = %.3g m and "
                 "sqrt(130h - 11) = %.3g m; give a mean of ln D nearer to that range",
                 h, c->mass, c->low, c->high);
    }
    return FW_OK;
}

fw_status fw_sizes_init(fw_sizes *s, const fw_thickness_mix *mix, fw_size_law law, double a, double b, fw_msg *m)
{
    FW_CHECK(mix != NULL, m, FW_E_ARG, "thickness mix: none given");
    FW_CHECK(mix->n_classes >= 1 && mix->n_classes <= FW_MAX_CLASSES, m, FW_E_ARG,
             "thickness mix: %zu classes, wanted 1..%d", mix->n_classes, (int)FW_MAX_CLASSES);
    FW_TRY(check_law(law, a, b, m));
    *s = (fw_sizes){.law = law, .a = a, .b = b, .n = mix->n_classes};

    double sum = 0.0;
    for (size_t k = 0; k < s->n; k++) {
        FW_TRY(init_class(s, k, &mix->classes[k], m));
        sum += mix->classes[k].share;
    }
    FW_CHECK(fabs(sum - 1.0) <= 1e-6, m, FW_E_ARG, "thickness mix: the shares sum to %.9g, wanted 1", sum);

    double total = 0.0;
    for (size_t k = 0; k < s->n; k++) {
        double share = mix->classes[k].share;
        s->classes[k].share = mix->by_area ? share / fw_sizes_moment(s, k, 2) : share;
        total += s->classes[k].share;
    }
    double q = 0.0;
    s->min_diameter = HUGE_VAL;
    for (size_t k = 0; k < s->n; k++) {
        fw_sizes_class *c = &s->classes[k];
        c->share /= total;
        c->begin = q;
        q += c->share;
        s->mean_diameter += c->share * fw_sizes_moment(s, k, 1);
        s->mean_area += c->share * M_PI_4 * fw_sizes_moment(s, k, 2);
        if (c->share > 0.0) {
            s->max_diameter = GSL_MAX_DBL(s->max_diameter, c->high);
            s->min_diameter = GSL_MIN_DBL(s->min_diameter, c->low);
        }
    }
    return FW_OK;
}
