/* Gaussian copula of windows: the lognormal in closed form, steps, and a pool of winters against both. */
#include "statistics/winters.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

#include "statistics/lognormal_windows.h"

/* Correlation of exp(s Z) and exp(s Z'), (Z, Z') normal with correlation r: (exp(s^2 r) - 1)/(exp(s^2) - 1). */
static double lognormal_correlation(double phi, double lag) { return expm1(log(3.25) * pow(phi, lag)) / 2.25; }

static void lognormal_windows_have_a_closed_form(void **state)
{
    (void)state;
    fw_scores    s;
    const double phis[] = {0, 0.5, 0.97, 0.9999};
    lognormal_scores(&s);
    assert_true(s.share[0] < 1e-12);
    for (size_t k = 0; k < 4; k++) {
        double pairs = 800;
        assert_near(fw_scores_correlation(&s, phis[k], 0), 1, 0);
        for (int lag = 1; lag < 800; lag++) {
            double want = lognormal_correlation(phis[k], lag);
            if (fabs(fw_scores_correlation(&s, phis[k], lag) - want) > 1e-10) fail_msg("correlation at lag %d of %g", lag, phis[k]);
            pairs += 2 * (800 - lag) * want;
        }
        assert_near(fw_scores_sum(&s, phis[k], 800), pairs, 1e-10);
    }
    assert_near(fw_scores_sum(&s, 0, 123), 123, 1e-12);
    assert_near(fw_scores_sum(&s, 0.9, 1), 1, 1e-12);
    fw_scores_bare(&s, 2, 3);
    assert_true(s.mean == 2 && s.variance == 3 && fw_scores_sum(&s, 0, 123) == 123);
}

static double linear_depth(const void *self, double score) { return fmax(0, 50 + *(const double *)self * score); }
static double step_depth(const void *self, double score)
{
    (void)self;
    return score > 0 ? 1 : 0;
}

static void other_laws(void **state)
{
    (void)state;
    fw_scores s;
    double    slope = 3; /* a normal law: its depths are correlated like its scores */
    assert_int_equal(fw_scores_make(&s, linear_depth, &slope, 50, 9, NULL), FW_OK);
    assert_near(fw_scores_correlation(&s, 0.8, 3), 0.512, 1e-10);
    /* half of all windows wear: correlation of signs 2/pi arcsin r, whose coefficients fall slowly; what is left out counts as the next term */
    assert_int_equal(fw_scores_make(&s, step_depth, NULL, 0.5, 0.25, NULL), FW_OK);
    assert_true(s.share[0] > 0.02 && s.share[0] < 0.2);
    assert_near(fw_scores_correlation(&s, 0.5, 1), 1.0 / 3, 2e-3);
    assert_near(fw_scores_correlation(&s, 0.97, 1), 2 / 3.141592653589793 * asin(0.97), 0.03);
    slope = 0;
    assert_int_equal(fw_scores_make(&s, linear_depth, &slope, 50, 0, NULL), FW_OK);
    assert_true(fw_scores_correlation(&s, 0.8, 1) >= 0 && s.variance * fw_scores_sum(&s, 0.8, 100) == 0);
    slope = -1;
    assert_int_equal(fw_scores_make(&s, linear_depth, &slope, 50, 1, NULL), FW_E_ARG);
    assert_int_equal(fw_scores_make(&s, linear_depth, &slope, 50, NAN, NULL), FW_E_ARG);
}

static void paths_are_an_autoregressive_sequence(void **state)
{
    (void)state;
    fw_winters w;
    double     of_lag[3] = {0}, n = 0;
    assert_int_equal(fw_winters_make(&w, 1, 0.9, 400, NULL), FW_OK);
    assert_true(w.n_winters >= 7000);
    for (size_t i = 0; i < w.n_winters; i++) { /* one look a winter: independent */
        const float *at = w.at + i * 400;
        double       z = (double)at[300] / FW_SCORES_PER_UNIT - FW_SCORES_REACH;
        const size_t lags[] = {0, 1, 20};
        for (int k = 0; k < 3; k++) of_lag[k] += z * ((double)at[300 - lags[k]] / FW_SCORES_PER_UNIT - FW_SCORES_REACH);
        n++;
    }
    const double want[] = {1, 0.9, 0.12157665459056929}; /* 0.9^20; variance of a product of unit normals 1 + r^2 */
    for (int k = 0; k < 3; k++) assert_true(fabs(of_lag[k] / n - want[k]) < 4 * sqrt((1 + want[k] * want[k]) / n));
    fw_winters_free(&w);
    assert_int_equal(fw_winters_make(&w, 1, 1, 400, NULL), FW_E_ARG);
    assert_int_equal(fw_winters_make(&w, 1, -0.1, 400, NULL), FW_E_ARG);
    fw_winters_free(&w);
}

static void a_pool_has_the_moments_and_one_window_the_law(void **state)
{
    (void)state;
    fw_scores    s;
    fw_winters   w;
    const size_t lengths[] = {0, 1, 100, 400};
    lognormal_scores(&s);
    assert_int_equal(fw_winters_make(&w, 1, 0.97, 400, NULL), FW_OK);
    double *sums = calloc(4 * w.n_winters, sizeof *sums);
    fw_winters_sum(&w, &s, 4, lengths, sums);
    for (size_t l = 0; l < 4; l++) {
        double n = (double)w.n_winters, mean = 0, square = 0;
        for (size_t i = 0; i < w.n_winters; i++) mean += sums[l * w.n_winters + i] / n;
        for (size_t i = 0; i < w.n_winters; i++) square += pow(sums[l * w.n_winters + i] - mean, 2) / n;
        if (l == 0) assert_true(mean == 0 && square == 0);
        if (l == 0) continue;
        assert_near(mean, (double)lengths[l] * s.mean, 1e-3); /* but for winters that are kept at 0 */
        assert_near(square, s.variance * fw_scores_sum(&s, 0.97, (double)lengths[l]), 2e-3);
    }
    double *one = sums + w.n_winters;
    for (size_t i = w.n_winters / 2; i < w.n_winters; i += 500) /* stratified: the ith is the quantile at about (i + 1/2)/n */
        assert_near(one[i], lognormal_quantile(lognormal_sigma(1.5), ((double)i + 0.5) / (double)w.n_winters), 0.03);
    free(sums);
    fw_winters_free(&w);
}

/* 3 million windows of a second: scores for blocks of them, moments all the same, and memory for 8192 a winter. */
static void very_long_winters(void **state)
{
    (void)state;
    fw_scores    s;
    fw_winters   w;
    const size_t lengths[] = {1000, 1500000, 3000000};
    lognormal_scores(&s);
    assert_int_equal(fw_winters_make(&w, 1, 0.9999, 3000000, NULL), FW_OK);
    assert_true(w.n_scores <= FW_WINTERS_LONGEST && w.block * w.n_scores >= 3000000 && w.n_winters >= 256);
    double *sums = calloc(3 * w.n_winters, sizeof *sums);
    fw_winters_sum(&w, &s, 3, lengths, sums);
    for (size_t l = 0; l < 3; l++) {
        double n = (double)w.n_winters, mean = 0, square = 0;
        for (size_t i = 0; i < w.n_winters; i++) mean += sums[l * w.n_winters + i] / n;
        for (size_t i = 0; i < w.n_winters; i++) square += pow(sums[l * w.n_winters + i] - mean, 2) / n;
        assert_near(mean, (double)lengths[l] * s.mean, 0.02);
        assert_near(square, s.variance * fw_scores_sum(&s, 0.9999, (double)lengths[l]), 0.05);
    }
    free(sums);
    fw_winters_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lognormal_windows_have_a_closed_form), cmocka_unit_test(other_laws),
                                       cmocka_unit_test(paths_are_an_autoregressive_sequence),
                                       cmocka_unit_test(a_pool_has_the_moments_and_one_window_the_law), cmocka_unit_test(very_long_winters)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
