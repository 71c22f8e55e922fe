/* Changes between paired windows: exact cases, closed forms of lognormal pairs, coverage of both intervals. */
#include "statistics/paired.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_cdf.h>

#include "statistics/near.h"

enum { MOST = 512 };

static double normal(fw_random *r) { return gsl_cdf_ugaussian_Pinv(fw_random_uniform(r)); }

static void as_atoms(size_t n, const double *x, fw_paired_atom *to)
{
    for (size_t i = 0; i < n; i++) to[i] = (fw_paired_atom){x[i], 1, (uint32_t)i};
    fw_paired_sort(n, to);
}

/* b lognormal (sigma), a = b exp(shift + tau Z). */
static void draw(fw_random *r, size_t n, double sigma, double shift, double tau, double *a, double *b)
{
    for (size_t i = 0; i < n; i++) {
        b[i] = exp(sigma * normal(r));
        a[i] = b[i] * exp(shift + tau * normal(r));
    }
}

static void nothing_is_nothing(void **state)
{
    (void)state;
    static double         b[100], twice[100], none[100];
    static fw_paired_atom x[100], y[100];
    fw_random             r;
    fw_paired_draws       d;
    fw_change             c;
    fw_random_stream(&r, 5, FW_STREAM_TEST, 0, 0);
    draw(&r, 100, 1, 0, 0, twice, b);
    assert_int_equal(fw_paired_draws_make(&d, 100, 1, NULL), FW_OK);
    for (size_t k = 0; k < FW_PAIRED_RESAMPLES; k++) {
        unsigned sum = 0;
        for (size_t i = 0; i < 100; i++) sum += d.times[k * 100 + i];
        assert_int_equal(sum, 100);
    }
    assert_int_equal(fw_paired_mean(&d, b, b, 0.95, &c, NULL), FW_OK);
    assert_true(c.change == 0 && c.low == 0 && c.high == 0);
    as_atoms(100, b, x);
    assert_int_equal(fw_paired_percentile(&d, 100, x, 100, x, 0.9, 0.95, &c, NULL), FW_OK);
    assert_true(c.change == 0 && c.low == 0 && c.high == 0);
    /* a factor common to all windows is known exactly */
    for (size_t i = 0; i < 100; i++) twice[i] = 2 * b[i], none[i] = 0;
    as_atoms(100, twice, y);
    fw_paired_mean(&d, twice, b, 0.95, &c, NULL);
    assert_near(c.change, 1, 1e-12);
    assert_true(c.low == c.change && c.high == c.change);
    fw_paired_percentile(&d, 100, y, 100, x, 0.9, 0.95, &c, NULL);
    assert_near(c.low, 1, 1e-12);
    assert_near(c.high, 1, 1e-12);
    /* all wear gone; and no wear to begin with */
    fw_paired_mean(&d, none, b, 0.95, &c, NULL);
    assert_true(c.change == -1 && c.low == -1 && c.high == -1);
    fw_paired_mean(&d, b, none, 0.95, &c, NULL);
    assert_true(isnan(c.change) && isnan(c.low));
    as_atoms(100, none, y);
    fw_paired_percentile(&d, 100, x, 100, y, 0.9, 0.95, &c, NULL);
    assert_true(isnan(c.change));
    fw_paired_draws_free(&d);
    assert_null(d.times);
}

/* Weighted steps by hand: P(X <= 1) = 1/2, P(X <= 2) = 3/4, P(X <= 5) = 1 over two windows. */
static void quantiles_by_hand(void **state)
{
    (void)state;
    fw_paired_atom x[] = {{5, 0.5, 1}, {1, 1, 0}, {2, 0.5, 1}};
    fw_paired_sort(3, x);
    assert_true(fw_paired_quantile(2, 3, x, 0.5) == 1);
    assert_true(fw_paired_quantile(2, 3, x, 0.51) == 2);
    assert_true(fw_paired_quantile(2, 3, x, 0.75) == 2);
    assert_true(fw_paired_quantile(2, 3, x, 0.9) == 5);
    assert_true(isnan(fw_paired_quantile(0, 0, NULL, 0.5)));
}

static void small_samples_have_no_interval(void **state)
{
    (void)state;
    double          a[] = {1, 2, 3}, b[] = {1, 1, 1};
    fw_paired_atom  x[3], y[3];
    fw_paired_draws d;
    fw_change       c;
    as_atoms(3, a, x), as_atoms(3, b, y);
    assert_int_equal(fw_paired_draws_make(&d, 3, 1, NULL), FW_OK);
    fw_paired_percentile(&d, 3, x, 3, y, 0.9, 0.95, &c, NULL);
    assert_true(c.change == 2 && isnan(c.low) && isnan(c.high));
    fw_paired_draws_free(&d);
    assert_int_equal(fw_paired_draws_make(&d, 1, 1, NULL), FW_OK);
    fw_paired_mean(&d, a, b, 0.95, &c, NULL);
    assert_true(c.change == 0 && isnan(c.low));
    fw_paired_draws_free(&d);
    assert_int_equal(fw_paired_draws_make(&d, 70000, 1, NULL), FW_E_ARG);
}

/* A window's depth under weather: lognormal (WEATHER) about x, at the middles of equal parts of probability. */
enum { PARTS = 16 };
static const double WEATHER = 0.5;

static void as_weather(size_t n, const double *x, fw_paired_atom *to)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < PARTS; k++)
            to[i * PARTS + k] =
                (fw_paired_atom){x[i] * lognormal_quantile(WEATHER, ((double)k + 0.5) / PARTS), 1.0 / PARTS, (uint32_t)i};
    fw_paired_sort(n * PARTS, to);
}

/* E a / E b = exp(shift + tau^2 / 2); ln(q_a / q_b) = shift + z (sqrt(sigma^2 + tau^2 + w^2) - sqrt(sigma^2 + w^2)): products of lognormals. */
static void coverage(void **state)
{
    (void)state;
    static double         a[MOST], b[MOST];
    static fw_paired_atom x[MOST * PARTS], y[MOST * PARTS];
    const double          sigma = lognormal_sigma(1.5), shift = 0.2, p = 0.9;
    const size_t          ns[] = {48, 128, 384};
    const double          taus[] = {0.05, 0.3, 1};
    int                   repeats = getenv("FW_TEST_REPEATS") ? atoi(getenv("FW_TEST_REPEATS")) : 200; /* paired.h has the table of 2000 */
    for (size_t j = 0; j < 3; j++)
        for (size_t k = 0; k < 3; k++) {
            size_t n = ns[k];
            double tau = taus[j], mean = expm1(shift + tau * tau / 2);
            double percentile = expm1(shift + gsl_cdf_ugaussian_Pinv(p) * (hypot(hypot(sigma, WEATHER), tau) - hypot(sigma, WEATHER)));
            int    in_mean = 0, in_percentile = 0;
            double width_mean = 0, width_percentile = 0;
            for (int repeat = 0; repeat < repeats; repeat++) {
                fw_random       r;
                fw_paired_draws d;
                fw_change       c;
                fw_random_stream(&r, 11, FW_STREAM_TEST, n, (uint64_t)repeat);
                draw(&r, n, sigma, shift, tau, a, b);
                assert_int_equal(fw_paired_draws_make(&d, n, (uint64_t)repeat, NULL), FW_OK);
                fw_paired_mean(&d, a, b, 0.95, &c, NULL);
                in_mean += c.low <= mean && mean <= c.high, width_mean += c.high - c.low;
                as_weather(n, a, x), as_weather(n, b, y);
                fw_paired_percentile(&d, n * PARTS, x, n * PARTS, y, p, 0.95, &c, NULL);
                in_percentile += c.low <= percentile && percentile <= c.high, width_percentile += c.high - c.low;
                fw_paired_draws_free(&d);
            }
            double of = repeats;
            print_message("n %zu, effect %g: mean %.1f %% (width %.3g), P90 %.1f %% (width %.3g)\n", n, tau, 100 * in_mean / of, width_mean / of,
                          100 * in_percentile / of, width_percentile / of);
            assert_true(in_mean >= 0.87 * of && in_percentile >= 0.91 * of);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_nothing), cmocka_unit_test(quantiles_by_hand),
                                       cmocka_unit_test(small_samples_have_no_interval), cmocka_unit_test(coverage)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
