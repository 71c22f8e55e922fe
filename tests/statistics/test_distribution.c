/* Distributions against closed forms; where a law has none, against an integral of its density done here. */
#include "floewear/distribution.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static fw_distribution law(fw_distribution_kind kind, double a, double b, double c, double d)
{
    fw_distribution x;
    memset(&x, 0, sizeof x);
    x.kind = kind;
    x.a = a;
    x.b = b;
    x.c = c;
    x.d = d;
    x.low = -INFINITY;
    x.high = INFINITY;
    return x;
}

static void assert_near(double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fmax(fabs(want), 1e-300)))
        fail_msg("got %.17g, want %.17g (relative %.3g)", got, want, (got - want) / want);
}

enum { N_LAWS = 9 };

static void all_laws(fw_distribution *laws)
{
    laws[0] = law(FW_DIST_UNIFORM, -12, -2, 0, 0);
    laws[1] = law(FW_DIST_NORMAL, 1.5, 0.5, 0, 0);
    laws[2] = law(FW_DIST_LOGNORMAL, -0.3, 1.0857, 0, 0); /* CV 1.5 */
    laws[3] = law(FW_DIST_WEIBULL, 0.4, 1.6, 0, 0);
    laws[4] = law(FW_DIST_GAMMA, 0.7, 2, 0, 0);
    laws[5] = law(FW_DIST_BETA, 2, 3.5, 0.1, 0.65);
    laws[6] = law(FW_DIST_TRIANGULAR, 0.1, 0.3, 0.6, 0);
    laws[7] = law(FW_DIST_TRIANGULAR, 0, 0, 2, 0); /* mode at an end */
    laws[8] = law(FW_DIST_WEIBULL, 0.4, 1.6, -0.25, 0);     /* three parameters */
}

/* densities as the textbooks write them, independent of the code under test */
static double density(double x, void *p)
{
    const fw_distribution *d = p;
    switch (d->kind) {
    case FW_DIST_UNIFORM: return x > d->a && x < d->b ? 1 / (d->b - d->a) : 0;
    case FW_DIST_NORMAL: return gsl_ran_gaussian_pdf(x - d->a, d->b);
    case FW_DIST_LOGNORMAL: return gsl_ran_lognormal_pdf(x, d->a, d->b);
    case FW_DIST_WEIBULL: return gsl_ran_weibull_pdf(x - d->c, d->a, d->b);
    case FW_DIST_GAMMA: return gsl_ran_gamma_pdf(x, d->a, d->b);
    case FW_DIST_BETA: return gsl_ran_beta_pdf((x - d->c) / (d->d - d->c), d->a, d->b) / (d->d - d->c);
    case FW_DIST_TRIANGULAR:
        if (x < d->a || x > d->c) return 0;
        return x < d->b ? 2 * (x - d->a) / ((d->c - d->a) * (d->b - d->a))
                        : 2 * (d->c - x) / ((d->c - d->a) * (d->c - d->b));
    default: return NAN;
    }
}

static double first_moment(double x, void *p) { return x * density(x, p); }

static double integral(double (*f)(double, void *), fw_distribution *d, double from, double to)
{
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(2000);
    gsl_function               g = {f, d};
    double                     result = 0, error = 0;
    gsl_integration_qags(&g, from, to, 0, 1e-11, 2000, w, &result, &error);
    gsl_integration_workspace_free(w);
    return result;
}

static void quantile_inverts_the_cdf(void **state)
{
    (void)state;
    fw_distribution laws[N_LAWS];
    all_laws(laws);
    const double us[] = {1e-12, 1e-4, 0.1, 0.5, 0.9, 0.99, 1 - 1e-6};
    for (size_t i = 0; i < N_LAWS; i++) {
        assert_int_equal(fw_distribution_check(&laws[i], NULL), FW_OK);
        for (size_t k = 0; k < sizeof us / sizeof *us; k++) {
            double x = fw_distribution_quantile(&laws[i], us[k]);
            /* the uniform's and the normal's lower tail lose digits in x = a + small, so compare to 1e-9 absolute
             * too */
            assert_true(fabs(fw_distribution_cdf(&laws[i], x) - us[k]) <= 1e-9 * us[k] + 1e-14);
            assert_true(x >= fw_distribution_min(&laws[i]) && x <= fw_distribution_max(&laws[i]));
        }
    }
}

static void quantiles_have_their_closed_forms(void **state)
{
    (void)state;
    fw_distribution laws[N_LAWS];
    all_laws(laws);
    assert_near(fw_distribution_quantile(&laws[0], 0.25), -9.5, 1e-15);
    /* 1.6448536269514722 = standard normal quantile of 0.95 (Abramowitz and Stegun, table 26.5) */
    assert_near(fw_distribution_quantile(&laws[1], 0.95), 1.5 + 0.5 * 1.6448536269514722, 1e-14);
    assert_near(fw_distribution_quantile(&laws[2], 0.95), exp(-0.3 + 1.0857 * 1.6448536269514722), 1e-13);
    assert_near(fw_distribution_quantile(&laws[3], 0.9), 0.4 * pow(log(10.0), 1 / 1.6), 1e-14);
    assert_near(fw_distribution_quantile(&laws[8], 0.9), -0.25 + 0.4 * pow(log(10.0), 1 / 1.6), 1e-14);
    assert_near(fw_distribution_mean(&laws[8]), -0.25 + 0.4 * tgamma(1 + 1 / 1.6), 1e-13);
    assert_true(fw_distribution_min(&laws[8]) == -0.25 && fw_distribution_cdf(&laws[8], -0.26) == 0);
    /* gamma of shape 1 is the exponential law; beta(2, 1) has CDF x^2 */
    fw_distribution e = law(FW_DIST_GAMMA, 1, 3, 0, 0), b = law(FW_DIST_BETA, 2, 1, 0, 1);
    assert_near(fw_distribution_quantile(&e, 0.99), 3 * log(100.0), 1e-13);
    assert_near(fw_distribution_quantile(&e, 1e-9), -3 * log1p(-1e-9), 1e-12);
    assert_near(fw_distribution_quantile(&b, 0.81), 0.9, 1e-14);
    /* a gamma law of shape 0.01 reaches far down: P = x^k / (k Gamma(k)) there, Gamma(1.01) = 0.99432585119150603714 */
    fw_distribution tiny = law(FW_DIST_GAMMA, 0.01, 1, 0, 0);
    assert_near(fw_distribution_quantile(&tiny, 0.1), pow(0.1 * 0.99432585119150603714, 100), 1e-11);
    assert_near(fw_distribution_quantile(&laws[6], 0.4), 0.3, 1e-14);  /* mass 0.2/0.5 left of the mode */
    assert_near(fw_distribution_quantile(&laws[7], 0.75), 1.0, 1e-14); /* 1 - (1 - x/2)^2 */
}

static void means_match_an_integral_of_the_density(void **state)
{
    (void)state;
    fw_distribution laws[N_LAWS];
    all_laws(laws);
    for (size_t i = 0; i < N_LAWS; i++) {
        double whole = fw_distribution_mean(&laws[i]);
        double q1 = fw_distribution_quantile(&laws[i], 0.2), q2 = fw_distribution_quantile(&laws[i], 0.7);
        laws[i].low = q1;
        laws[i].high = q2;
        assert_int_equal(fw_distribution_check(&laws[i], NULL), FW_OK);
        double want = integral(first_moment, &laws[i], q1, q2) / integral(density, &laws[i], q1, q2);
        assert_near(fw_distribution_mean(&laws[i]), want, 1e-9);
        /* one-sided truncations at the same point, weighted by their masses, make up the whole mean again */
        laws[i].low = -INFINITY;
        double below = fw_distribution_mean(&laws[i]);
        laws[i].low = q2;
        laws[i].high = INFINITY;
        double above = fw_distribution_mean(&laws[i]);
        assert_near(0.7 * below + 0.3 * above, whole, 1e-10);
    }
    fw_distribution n = law(FW_DIST_LOGNORMAL, -0.3, 1.0857, 0, 0);
    assert_near(fw_distribution_mean(&n), exp(-0.3 + 1.0857 * 1.0857 / 2), 1e-14);
}

static void truncation_renormalises(void **state)
{
    (void)state;
    fw_distribution w = law(FW_DIST_WEIBULL, 0.4, 1.6, 0, 0);
    w.low = 0.05;
    w.high = 2;
    double p = -expm1(-pow(0.05 / 0.4, 1.6)), q = exp(-pow(2 / 0.4, 1.6)), z = 1 - p - q;
    assert_near(fw_distribution_cdf(&w, 1), (1 - exp(-pow(1 / 0.4, 1.6)) - p) / z, 1e-13);
    assert_near(fw_distribution_quantile(&w, 0.5), 0.4 * pow(-log(1 - (p + 0.5 * z)), 1 / 1.6), 1e-13);
    assert_true(fw_distribution_min(&w) == 0.05 && fw_distribution_max(&w) == 2);
    assert_true(fw_distribution_cdf(&w, 0.04) == 0 && fw_distribution_cdf(&w, 2) == 1);
    assert_true(fw_distribution_quantile(&w, 0) == 0.05 && fw_distribution_quantile(&w, 1) == 2);
    /* far in a tail, where P alone has no digits left: above 9 sigma the excess is exponential with mean about 1/9.1,
     * and Q(9 + x)/Q(9) is the survival function */
    fw_distribution n = law(FW_DIST_NORMAL, 0, 1, 0, 0);
    n.low = 9;
    double median = fw_distribution_quantile(&n, 0.5);
    assert_near(gsl_cdf_ugaussian_Q(median) / gsl_cdf_ugaussian_Q(9), 0.5, 1e-9);
    assert_near(fw_distribution_cdf(&n, median), 0.5, 1e-9);
}

static void discrete_values_are_steps(void **state)
{
    (void)state;
    fw_distribution d;
    const double    values[] = {0.6, 0.2, 0.4, 0.2}, weights[] = {0.2, 0.25, 0.5, 0.05};
    assert_int_equal(fw_distribution_values(&d, 4, values, weights, NULL), FW_OK);
    assert_int_equal(fw_distribution_check(&d, NULL), FW_OK);
    assert_int_equal(d.n, 3); /* equal values joined */
    assert_true(d.values[0] == 0.2 && d.values[1] == 0.4 && d.values[2] == 0.6);
    assert_near(d.weights[0], 0.3, 1e-15);
    assert_true(fw_distribution_quantile(&d, 0.29) == 0.2 && fw_distribution_quantile(&d, 0.31) == 0.4);
    assert_true(fw_distribution_quantile(&d, 0.9999999999999999) == 0.6);
    assert_near(fw_distribution_cdf(&d, 0.4), 0.8, 1e-15);
    assert_near(fw_distribution_cdf_left(&d, 0.4), 0.3, 1e-15);
    assert_near(fw_distribution_mean(&d), 0.38, 1e-15);
    d.high = 0.5; /* leaves 0.2 and 0.4 with 3/8 and 5/8 */
    assert_near(fw_distribution_cdf(&d, 0.2), 0.375, 1e-15);
    assert_near(fw_distribution_mean(&d), (0.3 * 0.2 + 0.5 * 0.4) / 0.8, 1e-15);
    assert_true(fw_distribution_max(&d) == 0.4 && fw_distribution_quantile(&d, 0.5) == 0.4);

    fw_distribution copy;
    assert_int_equal(fw_distribution_copy(&copy, &d, NULL), FW_OK);
    assert_true(copy.values != d.values && copy.n == 3 && copy.values[2] == 0.6);
    fw_distribution_free(&copy);
    fw_distribution_free(&copy); /* twice is harmless */
    d.low = 0.7;
    d.high = 0.8;
    fw_msg m;
    assert_int_equal(fw_distribution_check(&d, &m), FW_E_ARG);
    assert_non_null(strstr(m.text, "no mass"));
    fw_distribution_free(&d);
}

static void constants_and_zeroed_structs(void **state)
{
    (void)state;
    fw_distribution c;
    fw_distribution_constant(&c, -10);
    assert_int_equal(fw_distribution_check(&c, NULL), FW_OK);
    assert_true(fw_distribution_quantile(&c, 0.3) == -10 && fw_distribution_mean(&c) == -10);
    assert_true(fw_distribution_min(&c) == -10 && fw_distribution_max(&c) == -10);
    assert_true(fw_distribution_cdf(&c, -10) == 1 && fw_distribution_cdf_left(&c, -10) == 0);
    fw_distribution zero;
    memset(&zero, 0, sizeof zero);
    fw_distribution_free(&zero);
    fw_distribution_free(NULL);
    assert_string_equal(fw_distribution_kind_name(FW_DIST_WEIBULL), "weibull");
    assert_string_equal(fw_distribution_kind_name(FW_DIST_VALUES), "values");
}

static void wrong_laws_are_refused(void **state)
{
    (void)state;
    const fw_distribution wrong[] = {law(FW_DIST_UNIFORM, 2, 2, 0, 0),
                                     law(FW_DIST_NORMAL, 0, 0, 0, 0),
                                     law(FW_DIST_LOGNORMAL, 0, -1, 0, 0),
                                     law(FW_DIST_WEIBULL, 0, 1, 0, 0),
                                     law(FW_DIST_GAMMA, 1, -1, 0, 0),
                                     law(FW_DIST_BETA, 1, 1, 1, 1),
                                     law(FW_DIST_BETA, 0, 1, 0, 1),
                                     law(FW_DIST_TRIANGULAR, 0, 2, 1, 0),
                                     law(FW_DIST_TRIANGULAR, 1, 1, 1, 0),
                                     law(FW_DIST_VALUES, 0, 0, 0, 0),
                                     law(FW_DIST_NORMAL, NAN, 1, 0, 0),
                                     law(FW_DIST_UNIFORM, 0, INFINITY, 0, 0),
                                     law((fw_distribution_kind)77, 0, 0, 0, 0)};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fw_msg m = {""};
        assert_int_equal(fw_distribution_check(&wrong[i], &m), FW_E_ARG);
        assert_true(m.text[0] != '\0');
    }
    fw_distribution u = law(FW_DIST_UNIFORM, 0, 1, 0, 0);
    u.low = 2;
    assert_int_equal(fw_distribution_check(&u, NULL), FW_E_ARG);
    u.low = 0.5;
    u.high = 0.4;
    assert_int_equal(fw_distribution_check(&u, NULL), FW_E_ARG);
    assert_true(isnan(fw_distribution_quantile(
        &(fw_distribution){.kind = FW_DIST_UNIFORM, .b = 1, .low = -INFINITY, .high = INFINITY}, NAN)));

    fw_distribution d;
    const double    v[] = {1, 2}, short_sum[] = {0.5, 0.4}, negative[] = {1.5, -0.5}, nan_weight[] = {NAN, 1},
                 inf[] = {1, INFINITY};
    const double good[] = {0.5, 0.5};
    assert_int_equal(fw_distribution_values(&d, 0, v, good, NULL), FW_E_ARG);
    assert_int_equal(fw_distribution_values(&d, 2, v, short_sum, NULL), FW_E_ARG);
    assert_int_equal(fw_distribution_values(&d, 2, v, negative, NULL), FW_E_ARG);
    assert_int_equal(fw_distribution_values(&d, 2, v, nan_weight, NULL), FW_E_ARG);
    assert_int_equal(fw_distribution_values(&d, 2, inf, good, NULL), FW_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(quantile_inverts_the_cdf),
                                       cmocka_unit_test(quantiles_have_their_closed_forms),
                                       cmocka_unit_test(means_match_an_integral_of_the_density),
                                       cmocka_unit_test(truncation_renormalises),
                                       cmocka_unit_test(discrete_values_are_steps),
                                       cmocka_unit_test(constants_and_zeroed_structs),
                                       cmocka_unit_test(wrong_laws_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
