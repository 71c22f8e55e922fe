#include "floewear/distribution.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* ---- the untruncated continuous laws: P(X <= x), P(X > x) and their inverses ------------------------------------- */

static double triangular_cdf(const fw_distribution *d, double x)
{
    if (x <= d->a) return 0;
    if (x >= d->c) return 1;
    if (x <= d->b) return (x - d->a) * (x - d->a) / ((d->c - d->a) * (d->b - d->a));
    return 1 - (d->c - x) * (d->c - x) / ((d->c - d->a) * (d->c - d->b));
}

static double base_P(const fw_distribution *d, double x)
{
    if (x == INFINITY) return 1;
    if (x == -INFINITY) return 0;
    switch (d->kind) {
    case FW_DIST_UNIFORM: return gsl_cdf_flat_P(x, d->a, d->b);
    case FW_DIST_NORMAL: return gsl_cdf_gaussian_P(x - d->a, d->b);
    case FW_DIST_LOGNORMAL: return x <= 0 ? 0 : gsl_cdf_ugaussian_P((log(x) - d->a) / d->b);
    case FW_DIST_WEIBULL: return x <= d->c ? 0 : gsl_cdf_weibull_P(x - d->c, d->a, d->b);
    case FW_DIST_GAMMA: return x <= 0 ? 0 : gsl_cdf_gamma_P(x, d->a, d->b);
    case FW_DIST_BETA: return x <= d->c ? 0 : x >= d->d ? 1 : gsl_cdf_beta_P((x - d->c) / (d->d - d->c), d->a, d->b);
    case FW_DIST_TRIANGULAR: return triangular_cdf(d, x);
    default: return NAN;
    }
}

static double base_Q(const fw_distribution *d, double x)
{
    if (x == INFINITY) return 0;
    if (x == -INFINITY) return 1;
    switch (d->kind) {
    case FW_DIST_UNIFORM: return gsl_cdf_flat_Q(x, d->a, d->b);
    case FW_DIST_NORMAL: return gsl_cdf_gaussian_Q(x - d->a, d->b);
    case FW_DIST_LOGNORMAL: return x <= 0 ? 1 : gsl_cdf_ugaussian_Q((log(x) - d->a) / d->b);
    case FW_DIST_WEIBULL: return x <= d->c ? 1 : gsl_cdf_weibull_Q(x - d->c, d->a, d->b);
    case FW_DIST_GAMMA: return x <= 0 ? 1 : gsl_cdf_gamma_Q(x, d->a, d->b);
    case FW_DIST_BETA: return x <= d->c ? 1 : x >= d->d ? 0 : gsl_cdf_beta_Q((x - d->c) / (d->d - d->c), d->a, d->b);
    case FW_DIST_TRIANGULAR:
        if (x <= d->b || x >= d->c) return 1 - triangular_cdf(d, x);
        return (d->c - x) * (d->c - x) / ((d->c - d->a) * (d->c - d->b));
    default: return NAN;
    }
}

/* Smallest x with P(X <= x) >= p for a law on [0, inf) or [c, d], by bisection on GSL's own CDF: GSL's Pinv of the
 * gamma and beta laws calls the error handler (abort, unless the host program has set another) where its Newton
 * steps wander. */
static double bisect(const fw_distribution *d, double origin, double top, double p, double q)
{
    double lo = DBL_MIN, hi = 1; /* distance from origin */
    if (isfinite(top)) {
        hi = top - origin;
    } else {
        while (base_Q(d, origin + hi) > q && hi < DBL_MAX / 4) hi *= 2;
    }
    for (int i = 0; i < 2200 && hi - lo > 2 * DBL_EPSILON * hi; i++) {
        double mid = hi > 4 * lo ? sqrt(lo) * sqrt(hi) : 0.5 * (lo + hi);
        if (mid <= lo || mid >= hi) break;
        /* the smaller of both tails carries the digits */
        double tail = p <= q ? base_P(d, origin + mid) : base_Q(d, origin + mid);
        if (isnan(tail)) return NAN; /* beyond what GSL can sum up: no number rather than a wrong one */
        if (p <= q ? tail < p : tail > q) {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    return origin + hi;
}

/* Inverse for lower tail p and upper tail q = 1 - p, both given so that neither loses digits. */
static double base_inverse(const fw_distribution *d, double p, double q)
{
    switch (d->kind) {
    case FW_DIST_UNIFORM: return p <= q ? d->a + p * (d->b - d->a) : d->b - q * (d->b - d->a);
    case FW_DIST_NORMAL: return d->a + d->b * (p <= q ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_ugaussian_Qinv(q));
    case FW_DIST_LOGNORMAL: return exp(d->a + d->b * (p <= q ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_ugaussian_Qinv(q)));
    case FW_DIST_WEIBULL: return d->c + d->a * pow(p <= q ? -log1p(-p) : -log(q), 1 / d->b);
    case FW_DIST_GAMMA: return bisect(d, 0, INFINITY, p, q);
    case FW_DIST_BETA: return bisect(d, d->c, d->d, p, q);
    case FW_DIST_TRIANGULAR: {
        double left = (d->b - d->a) / (d->c - d->a); /* mass left of the mode */
        if (p <= left) return d->a + sqrt(p * (d->c - d->a) * (d->b - d->a));
        return d->c - sqrt(q * (d->c - d->a) * (d->c - d->b));
    }
    default: return NAN;
    }
}

static double support_min(const fw_distribution *d)
{
    switch (d->kind) {
    case FW_DIST_CONSTANT:
    case FW_DIST_UNIFORM:
    case FW_DIST_TRIANGULAR: return d->a;
    case FW_DIST_LOGNORMAL:
    case FW_DIST_GAMMA: return 0;
    case FW_DIST_WEIBULL:
    case FW_DIST_BETA: return d->c;
    default: return -INFINITY;
    }
}

static double support_max(const fw_distribution *d)
{
    switch (d->kind) {
    case FW_DIST_CONSTANT: return d->a;
    case FW_DIST_UNIFORM: return d->b;
    case FW_DIST_TRIANGULAR: return d->c;
    case FW_DIST_BETA: return d->d;
    default: return INFINITY;
    }
}

/* Mass of (from, to], from the tail that does not cancel. */
static double base_mass(const fw_distribution *d, double from, double to)
{
    double p = base_P(d, from);
    return p > 0.5 ? base_Q(d, from) - base_Q(d, to) : base_P(d, to) - p;
}

static bool is_inside(const fw_distribution *d, double x) { return x >= d->low && x <= d->high; }

/* Mass of the values that truncation leaves. */
static double values_mass(const fw_distribution *d)
{
    double mass = 0;
    for (size_t i = 0; i < d->n; i++)
        if (is_inside(d, d->values[i])) mass += d->weights[i];
    return mass;
}

/* ---- making and checking
 * ------------------------------------------------------------------------------------------ */

void fw_distribution_constant(fw_distribution *d, double value)
{
    memset(d, 0, sizeof *d);
    d->kind = FW_DIST_CONSTANT;
    d->a = value;
    d->low = -INFINITY;
    d->high = INFINITY;
}

static fw_status allocate_values(fw_distribution *d, size_t n, fw_msg *m)
{
    d->n = 0;
    d->values = d->weights = NULL;
    FW_TRY(fw_alloc(&d->values, n, sizeof *d->values, "values of a distribution", m));
    fw_status s = fw_alloc(&d->weights, n, sizeof *d->weights, "weights of a distribution", m);
    if (s == FW_OK) {
        d->n = n;
    } else {
        fw_distribution_free(d);
    }
    return s;
}

typedef struct atom {
    double value, weight;
} atom;

static int compare_atoms(const void *a, const void *b)
{
    const atom *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

fw_status fw_distribution_values(fw_distribution *d, size_t n, const double *values, const double *weights, fw_msg *m)
{
    fw_distribution_constant(d, 0);
    FW_CHECK(n > 0, m, FW_E_ARG, "a distribution of given values needs at least one value");
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        FW_CHECK(isfinite(values[i]), m, FW_E_ARG, "value %zu is not a finite number", i + 1);
        FW_CHECK(isfinite(weights[i]) && weights[i] >= 0, m, FW_E_ARG,
                 "the weight of value %g is %g; a weight is a finite number >= 0", values[i], weights[i]);
        sum += weights[i];
    }
    FW_CHECK(fabs(sum - 1) <= 1e-6, m, FW_E_ARG, "the weights sum to %.9g; they have to sum to 1 within 1e-6", sum);

    atom *atoms = NULL;
    FW_TRY(fw_alloc(&atoms, n, sizeof *atoms, "values of a distribution", m));
    for (size_t i = 0; i < n; i++) atoms[i] = (atom){values[i], weights[i]};
    qsort(atoms, n, sizeof *atoms, compare_atoms);
    size_t n_kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (n_kept && atoms[n_kept - 1].value == atoms[i].value) {
            atoms[n_kept - 1].weight += atoms[i].weight;
        } else {
            atoms[n_kept++] = atoms[i];
        }
    }
    fw_status s = allocate_values(d, n_kept, m);
    if (s == FW_OK) {
        d->kind = FW_DIST_VALUES;
        for (size_t i = 0; i < n_kept; i++) {
            d->values[i] = atoms[i].value;
            d->weights[i] = atoms[i].weight / sum;
        }
    }
    free(atoms);
    return s;
}

const char *fw_distribution_kind_name(fw_distribution_kind k)
{
    static const char *const names[FW_N_DIST] = {"constant", "uniform", "normal",     "lognormal", "weibull",
                                                 "gamma",    "beta",    "triangular", "values"};
    return (unsigned)k < FW_N_DIST ? names[k] : "unknown";
}

static fw_status check_parameters(const fw_distribution *d, fw_msg *m)
{
    const char *name = fw_distribution_kind_name(d->kind);
    FW_CHECK(isfinite(d->a) && isfinite(d->b) && isfinite(d->c) && isfinite(d->d), m, FW_E_ARG,
             "a parameter of the %s distribution is not a finite number", name);
    switch (d->kind) {
    case FW_DIST_CONSTANT: return FW_OK;
    case FW_DIST_UNIFORM:
        FW_CHECK(d->a < d->b, m, FW_E_ARG, "uniform [%g, %g]: the first number has to be below the second", d->a, d->b);
        return FW_OK;
    case FW_DIST_NORMAL:
        FW_CHECK(d->b > 0, m, FW_E_ARG, "normal: the standard deviation is %g; it has to be above 0", d->b);
        return FW_OK;
    case FW_DIST_LOGNORMAL:
        FW_CHECK(d->b > 0, m, FW_E_ARG, "lognormal: the standard deviation of ln x is %g; it has to be above 0", d->b);
        return FW_OK;
    case FW_DIST_WEIBULL:
        FW_CHECK(d->a > 0 && d->b > 0, m, FW_E_ARG, "weibull: scale %g and shape %g both have to be above 0", d->a,
                 d->b);
        return FW_OK;
    case FW_DIST_GAMMA:
        FW_CHECK(d->a > 0 && d->b > 0, m, FW_E_ARG, "gamma: shape %g and scale %g both have to be above 0", d->a, d->b);
        return FW_OK;
    case FW_DIST_BETA:
        FW_CHECK(d->a > 0 && d->b > 0, m, FW_E_ARG, "beta: the shapes %g and %g both have to be above 0", d->a, d->b);
        FW_CHECK(d->c < d->d, m, FW_E_ARG, "beta on [%g, %g]: the first end has to be below the second", d->c, d->d);
        return FW_OK;
    case FW_DIST_TRIANGULAR:
        FW_CHECK(d->a <= d->b && d->b <= d->c && d->a < d->c, m, FW_E_ARG,
                 "triangular [%g, %g, %g]: low <= mode <= high and low < high are needed", d->a, d->b, d->c);
        return FW_OK;
    case FW_DIST_VALUES:
        FW_CHECK(d->n > 0 && d->values && d->weights, m, FW_E_ARG, "a distribution of given values has no values");
        return FW_OK;
    default: return fw_fail(m, FW_E_ARG, "distribution kind %d does not exist", (int)d->kind);
    }
}

fw_status fw_distribution_check(const fw_distribution *d, fw_msg *m)
{
    FW_TRY(check_parameters(d, m));
    FW_CHECK(d->low <= d->high, m, FW_E_ARG, "truncation [%g, %g]: the lower end is above the upper one", d->low,
             d->high);
    double mass = 0;
    if (d->kind == FW_DIST_CONSTANT) {
        mass = is_inside(d, d->a) ? 1 : 0;
    } else if (d->kind == FW_DIST_VALUES) {
        mass = values_mass(d);
    } else {
        mass = base_mass(d, d->low, d->high);
    }
    FW_CHECK(mass > 0, m, FW_E_ARG, "the %s distribution has no mass inside its truncation [%g, %g]",
             fw_distribution_kind_name(d->kind), d->low, d->high);
    return FW_OK;
}

/* ---- using
 * -------------------------------------------------------------------------------------------------------- */

static double values_quantile(const fw_distribution *d, double u)
{
    double wanted = u * values_mass(d), sum = 0, last = NAN;
    for (size_t i = 0; i < d->n; i++) {
        if (!is_inside(d, d->values[i]) || d->weights[i] == 0) continue;
        sum += d->weights[i];
        last = d->values[i];
        if (sum >= wanted) return last;
    }
    return last; /* rounding of the sum */
}

double fw_distribution_quantile(const fw_distribution *d, double u)
{
    if (d->kind == FW_DIST_CONSTANT) return d->a;
    if (isnan(u)) return NAN;
    if (u <= 0) return fw_distribution_min(d);
    if (u >= 1) return fw_distribution_max(d);
    if (d->kind == FW_DIST_VALUES) return values_quantile(d, u);
    double p_low = base_P(d, d->low), q_low = base_Q(d, d->low), p_high = base_P(d, d->high),
           q_high = base_Q(d, d->high);
    double p = (1 - u) * p_low + u * p_high, q = (1 - u) * q_low + u * q_high;
    double x = base_inverse(d, p, q);
    if (isnan(x)) return NAN;
    return fmin(fmax(x, fw_distribution_min(d)), fw_distribution_max(d));
}

static double values_below(const fw_distribution *d, double x, bool is_inclusive)
{
    double below = 0;
    for (size_t i = 0; i < d->n && (d->values[i] < x || (is_inclusive && d->values[i] == x)); i++)
        if (is_inside(d, d->values[i])) below += d->weights[i];
    return fmin(below / values_mass(d), 1);
}

static double continuous_cdf(const fw_distribution *d, double x)
{
    if (x <= fw_distribution_min(d)) return 0;
    if (x >= fw_distribution_max(d)) return 1;
    double part = base_mass(d, d->low, x) / base_mass(d, d->low, d->high);
    return fmin(fmax(part, 0), 1);
}

double fw_distribution_cdf(const fw_distribution *d, double x)
{
    if (isnan(x)) return NAN;
    if (d->kind == FW_DIST_CONSTANT) return x >= d->a ? 1 : 0;
    if (d->kind == FW_DIST_VALUES) return values_below(d, x, true);
    return continuous_cdf(d, x);
}

double fw_distribution_cdf_left(const fw_distribution *d, double x)
{
    if (isnan(x)) return NAN;
    if (d->kind == FW_DIST_CONSTANT) return x > d->a ? 1 : 0;
    if (d->kind == FW_DIST_VALUES) return values_below(d, x, false);
    return continuous_cdf(d, x);
}

double fw_distribution_min(const fw_distribution *d)
{
    if (d->kind != FW_DIST_VALUES) return fmax(support_min(d), d->kind == FW_DIST_CONSTANT ? -INFINITY : d->low);
    for (size_t i = 0; i < d->n; i++)
        if (is_inside(d, d->values[i]) && d->weights[i] > 0) return d->values[i];
    return NAN;
}

double fw_distribution_max(const fw_distribution *d)
{
    if (d->kind != FW_DIST_VALUES) return fmin(support_max(d), d->kind == FW_DIST_CONSTANT ? INFINITY : d->high);
    for (size_t i = d->n; i-- > 0;)
        if (is_inside(d, d->values[i]) && d->weights[i] > 0) return d->values[i];
    return NAN;
}

bool fw_distribution_is_constant(const fw_distribution *d) { return fw_distribution_min(d) == fw_distribution_max(d); }

/* ---- means: the partial first moment over [from, to] has a closed form in every law here
 * --------------------------- */

static double triangular_moment(const fw_distribution *d, double from, double to)
{
    /* int x f dx with f = 2 (x - a)/((c - a)(b - a)) left of the mode and 2 (c - x)/((c - a)(c - b)) right of it;
     * the primitives are written about the ends a and c, where they vanish to second order */
    double a = d->a, b = d->b, c = d->c, moment = 0;
    double left_to = fmin(to, b), right_from = fmax(from, b);
    if (left_to > from) {
        double s = from - a, t = left_to - a;
        moment += 2 / ((c - a) * (b - a)) * ((t * t * t - s * s * s) / 3 + a * (t * t - s * s) / 2);
    }
    if (to > right_from) {
        double s = c - right_from, t = c - to;
        moment += 2 / ((c - a) * (c - b)) * (c * (s * s - t * t) / 2 - (s * s * s - t * t * t) / 3);
    }
    return moment;
}

static double partial_moment(const fw_distribution *d, double from, double to)
{
    fw_distribution shifted = *d; /* the law whose mass over [from, to] is the moment, up to a factor */
    switch (d->kind) {
    case FW_DIST_LOGNORMAL: /* x f(x; mu, s) = exp(mu + s^2/2) f(x; mu + s^2, s) */
        shifted.a = d->a + d->b * d->b;
        return exp(d->a + d->b * d->b / 2) * base_mass(&shifted, from, to);
    case FW_DIST_WEIBULL: { /* x = location + scale y^(1/shape), y exponential: an incomplete gamma function of 1 + 1/shape */
        shifted.kind = FW_DIST_GAMMA;
        shifted.a = 1 + 1 / d->b;
        shifted.b = 1;
        double y_from = pow(fmax(from - d->c, 0) / d->a, d->b), y_to = pow(fmax(to - d->c, 0) / d->a, d->b);
        double above = d->a * gsl_sf_gamma(shifted.a) * base_mass(&shifted, y_from, y_to);
        return d->c != 0 ? d->c * base_mass(d, from, to) + above : above;
    }
    case FW_DIST_GAMMA: /* x f(x; k, s) = k s f(x; k + 1, s) */
        shifted.a = d->a + 1;
        return d->a * d->b * base_mass(&shifted, from, to);
    case FW_DIST_BETA: /* on [0, 1]: x f(x; a, b) = a/(a + b) f(x; a + 1, b) */
        shifted.a = d->a + 1;
        return d->c * base_mass(d, from, to) + (d->d - d->c) * d->a / (d->a + d->b) * base_mass(&shifted, from, to);
    case FW_DIST_TRIANGULAR: return triangular_moment(d, from, to);
    case FW_DIST_NORMAL: {
        double density_from = isfinite(from) ? gsl_ran_gaussian_pdf(from - d->a, d->b) : 0;
        double density_to = isfinite(to) ? gsl_ran_gaussian_pdf(to - d->a, d->b) : 0;
        return d->a * base_mass(d, from, to) + d->b * d->b * (density_from - density_to);
    }
    default: return NAN;
    }
}

double fw_distribution_mean(const fw_distribution *d)
{
    double from = fw_distribution_min(d), to = fw_distribution_max(d);
    if (d->kind == FW_DIST_CONSTANT) return d->a;
    if (d->kind == FW_DIST_UNIFORM) return 0.5 * (from + to);
    if (d->kind == FW_DIST_VALUES) {
        double sum = 0;
        for (size_t i = 0; i < d->n; i++)
            if (is_inside(d, d->values[i])) sum += d->weights[i] * d->values[i];
        return sum / values_mass(d);
    }
    /* far out in a tail both factors are tiny and their quotient rounds: it stays inside the support */
    return fmin(fmax(partial_moment(d, from, to) / base_mass(d, from, to), from), to);
}

/* ---- owning
 * ------------------------------------------------------------------------------------------------------- */

fw_status fw_distribution_copy(fw_distribution *to, const fw_distribution *from, fw_msg *m)
{
    *to = *from;
    to->values = to->weights = NULL;
    if (from->n == 0) return FW_OK;
    FW_TRY(allocate_values(to, from->n, m));
    memcpy(to->values, from->values, from->n * sizeof *to->values);
    memcpy(to->weights, from->weights, from->n * sizeof *to->weights);
    return FW_OK;
}

void fw_distribution_free(fw_distribution *d)
{
    if (!d) return;
    free(d->values);
    free(d->weights);
    d->values = d->weights = NULL;
    d->n = 0;
}
