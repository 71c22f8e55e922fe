/* Sums of windows: gamma sums exactly, lognormal CV 1.5 against the normal limit and against a simulation. */
#include "statistics/life.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

static void sums_of_gamma_windows_are_exact(void **state)
{
    (void)state;
    const double shape = 0.7, scale = 2e-4; /* raw moments of the gamma law: scale^k shape (shape + 1) ... */
    fw_life      w = fw_life_of_moments(shape * scale, shape * (shape + 1) * scale * scale,
                                        shape * (shape + 1) * (shape + 2) * scale * scale * scale);
    assert_near(w.skewness, 2 / sqrt(shape), 1e-12);
    const double ns[] = {1, 3, 50, 20000}, ps[] = {0.01, 0.5, 0.9, 0.99};
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 4; k++)
            assert_near(fw_life_percentile(&w, ns[i], ps[k]), gsl_cdf_gamma_Pinv(ps[k], shape * ns[i], scale), 1e-7);
}

static void the_cdf_reads_percentiles_backwards(void **state)
{
    (void)state;
    fw_life      skew = {2, 3, 4}, left = {2, 1, -0.5}, constant = {2, 0, 0};
    const double ns[] = {1, 20, 500, 4000, 1e5}, ps[] = {0.01, 0.5, 0.9, 0.99};
    for (size_t i = 0; i < 5; i++)
        for (size_t k = 0; k < 4; k++) {
            assert_near(fw_life_cdf(&skew, ns[i], fw_life_percentile(&skew, ns[i], ps[k])), ps[k], 1e-9);
            assert_near(fw_life_cdf(&left, ns[i], fw_life_percentile(&left, ns[i], ps[k])), ps[k], 1e-9);
            /* the gamma law itself, on either side of where its expansion takes over */
            double shape = ns[i] / 4, y = (fw_life_percentile(&skew, ns[i], ps[k]) - 2 * ns[i]) / (3 * sqrt(ns[i]));
            assert_near(gsl_cdf_gamma_P(shape + sqrt(shape) * y, shape, 1), ps[k], 1e-7);
        }
    assert_true(fw_life_cdf(&skew, 1000, -1) == 0 && fw_life_cdf(&skew, 1000, 1e9) == 1);
    assert_true(fw_life_cdf(&constant, 10, 19.9) == 0 && fw_life_cdf(&constant, 10, 20) == 1);
}

static void many_windows_are_normal(void **state)
{
    (void)state;
    /* lognormal with median 1: E X^k = exp(k^2 sigma^2 / 2) */
    double  s2 = pow(lognormal_sigma(1.5), 2), n = 4e8;
    fw_life w = fw_life_of_moments(exp(s2 / 2), exp(2 * s2), exp(4.5 * s2));
    assert_near(w.sd / w.mean, 1.5, 1e-12);
    assert_near(w.skewness, 3 * 1.5 + pow(1.5, 3), 1e-12); /* of a lognormal: 3 CV + CV^3 */
    assert_near((fw_life_percentile(&w, n, 0.99) - n * w.mean) / (sqrt(n) * w.sd), 2.3263478740408408, 1e-3);
    assert_near((fw_life_percentile(&w, n, 0.05) - n * w.mean) / (sqrt(n) * w.sd), -1.6448536269514722, 1e-3);
}

static void lognormal_windows_match_a_simulation(void **state)
{
    (void)state;
    /* 700 windows: skewness of the sum 0.298, just inside FW_LIFE_SKEWNESS */
    enum { N = 700, LIVES = 10000 };
    double    sigma = lognormal_sigma(1.5), s2 = sigma * sigma;
    fw_life   w = fw_life_of_moments(exp(s2 / 2), exp(2 * s2), exp(4.5 * s2));
    fw_random r;
    double   *sums = calloc(LIVES, sizeof *sums);
    assert_true(fw_life_is_smooth(&w, N) && !fw_life_is_smooth(&w, N / 2.0));
    fw_random_stream(&r, 4, FW_STREAM_TEST, 0, 0);
    for (size_t i = 0; i < LIVES; i++)
        for (size_t k = 0; k < N; k += 2) { /* Box-Muller, independent of the quantile function */
            double radius = sigma * sqrt(-2 * log(fw_random_uniform(&r))),
                   angle = 6.283185307179586 * fw_random_uniform(&r);
            sums[i] += exp(radius * cos(angle)) + exp(radius * sin(angle));
        }
    qsort(sums, LIVES, sizeof *sums, compare_doubles);
    const double ps[] = {0.05, 0.5, 0.9, 0.95, 0.99};
    for (size_t k = 0; k < 5; k++) assert_near(fw_life_percentile(&w, N, ps[k]), sums[(size_t)(ps[k] * LIVES)], 0.01);
    free(sums);
}

static void windows_without_scatter(void **state)
{
    (void)state;
    fw_life constant = fw_life_of_moments(2, 4, 8), nothing = fw_life_of_moments(0, 0, 0);
    assert_near(fw_life_percentile(&constant, 10, 0.99), 20, 1e-15);
    assert_true(fw_life_percentile(&nothing, 10, 0.99) == 0 && fw_life_cdf(&nothing, 100, 1) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_of_gamma_windows_are_exact),
                                       cmocka_unit_test(the_cdf_reads_percentiles_backwards),
                                       cmocka_unit_test(many_windows_are_normal),
                                       cmocka_unit_test(lognormal_windows_match_a_simulation),
                                       cmocka_unit_test(windows_without_scatter)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
