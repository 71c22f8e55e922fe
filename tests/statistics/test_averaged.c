/* Interval of a percentile of an averaged CDF: its limit, its existence, and its coverage on known laws. */
#include "statistics/averaged.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

static void levels_pass_into_order_statistics(void **state)
{
    (void)state;
    /* integer sizes: the ends exist from the same n on, and the levels lie within one rank of the binomial ones */
    const struct {
        double p;
        size_t n;
    } limits[] = {{0.9, 36}, {0.95, 72}, {0.99, 368}};
    double low, high;
    for (size_t i = 0; i < 3; i++) {
        fw_averaged_levels((double)limits[i].n - 1, limits[i].p, 0.95, &low, &high);
        assert_true(isnan(high));
        fw_averaged_levels((double)limits[i].n, limits[i].p, 0.95, &low, &high);
        assert_true(high <= 1 && high > 1 - 1.0 / (double)limits[i].n);
    }
    double ranks[1000];
    for (size_t i = 0; i < 1000; i++) ranks[i] = (double)(i + 1);
    fw_interval exact = fw_order_interval(1000, ranks, 0, 0.9, 0.95);
    fw_averaged_levels(1000, 0.9, 0.95, &low, &high);
    assert_true(fabs(1000 * low - exact.low) <= 1 && fabs(1000 * high - exact.high) <= 1);
    fw_averaged_levels(0, 0.9, 0.95, &low, &high);
    assert_true(isnan(low) && isnan(high));
}

static void effective_size_of_steps_is_the_sample_size(void **state)
{
    (void)state;
    /* F_i in {0, 1}: s^2 = n/(n-1) F(1-F); the rest is (1.959964/2.0)^2-like loss by the t quantile, t(0.975, 999) =
     * 1.962341 */
    assert_near(fw_averaged_effective_size(1000, 900, 900, 0.95), 999 * pow(1.959964 / 1.962341, 2), 1e-5);
    /* F_i all equal: nothing to scatter */
    assert_near(fw_averaged_effective_size(1000, 900, 810, 0.95), 1e8, 0);
    assert_true(fw_averaged_effective_size(1, 0.5, 0.25, 0.95) == 0);
    assert_true(fw_averaged_effective_size(100, 100, 100, 0.95) <= 100);
}

/* ---- coverage
 * ------------------------------------------------------------------------------------------------------ */

enum { N_DIRECTIONS = 4, REPEATS = 1000 };

typedef struct plan { /* load on direction d = multiple[d] * lognormal(0, sigma); T uniform */
    double sigma, coldest, warmest, weight[N_DIRECTIONS], multiple[N_DIRECTIONS];
} plan;

typedef struct sample {
    const plan     *plan;
    const fw_scale *scale;
    size_t          n;
    double          load[400];
} sample;

static double own_cdf(const sample *s, double load, double depth)
{
    double sum = 0;
    for (int d = 0; d < N_DIRECTIONS; d++) {
        double x = load * s->plan->multiple[d];
        sum += s->plan->weight[d] * (x > 0 ? fw_scale_cdf_ln(s->scale, log(depth / x)) : 1);
    }
    return sum;
}

static void own_sums(void *self, double depth, double *sum, double *squares)
{
    const sample *s = self;
    *sum = *squares = 0;
    for (size_t i = 0; i < s->n; i++) {
        double f = own_cdf(s, s->load[i], depth);
        *sum += f;
        *squares += f * f;
    }
}

static fw_mixture mixture_of(const sample *s, const double *loads, size_t n)
{
    fw_mixture_entry *e = malloc(n * N_DIRECTIONS * sizeof *e);
    fw_mixture        x;
    for (size_t i = 0; i < n; i++)
        for (size_t d = 0; d < N_DIRECTIONS; d++)
            e[i * N_DIRECTIONS + d] = (fw_mixture_entry){loads[i] * s->plan->multiple[d], s->plan->weight[d]};
    assert_int_equal(fw_mixture_make(&x, s->scale, n * N_DIRECTIONS, e, NULL), FW_OK);
    free(e);
    return x;
}

static void check_coverage(const plan *p, size_t n, double level, uint64_t part, double least, double most)
{
    enum { FINE = 4000 };
    fw_distribution T = {.kind = FW_DIST_UNIFORM, .a = p->coldest, .b = p->warmest, .low = -INFINITY, .high = INFINITY};
    fw_scale        scale;
    assert_int_equal(fw_scale_make(&scale, 1, 1.121, &T, NULL), FW_OK);
    sample  s = {.plan = p, .scale = &scale, .n = n};
    double *fine = malloc(FINE * sizeof *fine);
    for (size_t i = 0; i < FINE; i++) fine[i] = lognormal_quantile(p->sigma, ((double)i + 0.5) / FINE);
    fw_mixture limit = mixture_of(&s, fine, FINE);
    double     truth = fw_mixture_quantile(&limit, level);
    fw_mixture_free(&limit);
    free(fine);

    int       hit = 0;
    fw_random r;
    fw_random_stream(&r, 5, FW_STREAM_TEST, n, part);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (size_t i = 0; i < n; i++) s.load[i] = lognormal_quantile(p->sigma, fw_random_uniform(&r));
        fw_mixture        x = mixture_of(&s, s.load, n);
        fw_averaged_parts parts = {own_sums, &s};
        fw_interval       v = fw_averaged_interval(&x, n, 0, &parts, level, 0.95);
        hit += !(v.low > truth) && !(v.high < truth);
        fw_mixture_free(&x);
    }
    fw_scale_free(&scale);
    double got = (double)hit / REPEATS;
    if (!(got >= least && got <= most))
        fail_msg("P%g at n = %zu, sigma %g: coverage %g", 100 * level, n, p->sigma, got);
}

static void coverage_on_known_laws(void **state)
{
    (void)state;
    const double narrow = lognormal_sigma(1.5);
    const plan   raahe = {narrow, -12, -2, {1, 0, 0, 0}, {1, 1, 1, 1}};        /* temperature integrated */
    const plan   nearly_plain = {narrow, -11, -9, {1, 0, 0, 0}, {1, 1, 1, 1}}; /* nearly steps */
    const plan   rose = {narrow, -12, -2, {0.4, 0.3, 0.2, 0.1}, {0, 0.1, 1, 3}};
    const plan   heavy = {2.5, -12, -2, {1, 0, 0, 0}, {1, 1, 1, 1}};
    /* the binomial interval is conservative where few ranks lie beyond the percentile; 97 % is held from a moderate
     * number of them on. Bounds leave four standard errors of 1000 repeats at 95 % (0.7 %): 93 - 0.9 and so on */
    check_coverage(&raahe, 20, 0.5, 1, 0.93, 1);
    check_coverage(&raahe, 60, 0.9, 2, 0.93, 0.99);
    check_coverage(&raahe, 200, 0.9, 3, 0.93, 0.98);
    check_coverage(&raahe, 200, 0.99, 4, 0.93, 0.98);
    check_coverage(&raahe, 400, 0.95, 5, 0.93, 0.98);
    check_coverage(&nearly_plain, 100, 0.9, 6, 0.93, 0.995);
    check_coverage(&nearly_plain, 400, 0.9, 7, 0.93, 0.98);
    check_coverage(&rose, 60, 0.9, 8, 0.93, 0.98);
    check_coverage(&rose, 100, 0.99, 9, 0.93, 0.98);
    check_coverage(&heavy, 100, 0.9, 10, 0.93, 0.985);
    check_coverage(&heavy, 400, 0.99, 11, 0.93, 0.985);
}

static void failed_runs_open_both_ends(void **state)
{
    (void)state;
    const plan      p = {0.5, -12, -2, {1, 0, 0, 0}, {1, 1, 1, 1}};
    fw_distribution T = {.kind = FW_DIST_UNIFORM, .a = -12, .b = -2, .low = -INFINITY, .high = INFINITY};
    fw_scale        scale;
    assert_int_equal(fw_scale_make(&scale, 1, 1.121, &T, NULL), FW_OK);
    sample s = {.plan = &p, .scale = &scale, .n = 200};
    for (size_t i = 0; i < s.n; i++) s.load[i] = lognormal_quantile(0.5, ((double)i + 0.5) / 200);
    fw_mixture        x = mixture_of(&s, s.load, s.n);
    fw_averaged_parts parts = {own_sums, &s};
    fw_interval       clean = fw_averaged_interval(&x, 200, 0, &parts, 0.9, 0.95);
    fw_interval       few = fw_averaged_interval(&x, 200, 4, &parts, 0.9, 0.95);
    fw_interval       many = fw_averaged_interval(&x, 200, 40, &parts, 0.9, 0.95);
    assert_true(few.low < clean.low && few.high > clean.high);
    assert_true(many.low < few.low && isnan(many.high));
    assert_true(isnan(fw_averaged_interval(&x, 10, 0, &parts, 0.9, 0.95).low)); /* too few */
    assert_true(isnan(fw_averaged_interval(&x, 0, 100, &parts, 0.9, 0.95).high));
    fw_mixture_free(&x);
    fw_scale_free(&scale);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(levels_pass_into_order_statistics),
                                       cmocka_unit_test(effective_size_of_steps_is_the_sample_size),
                                       cmocka_unit_test(coverage_on_known_laws),
                                       cmocka_unit_test(failed_runs_open_both_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
