/* Percentiles of a sample and order-statistic intervals. */
#include "statistics/order.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

static void percentiles_interpolate_between_ranks(void **state)
{
    (void)state;
    /* by the definition, by hand: rank 1 + (n - 1) p of 1, 2, 4, 8, 16; p = 0.9 is rank 4.6, so 8 + 0.6 x 8 */
    const double x[] = {1, 2, 4, 8, 16};
    assert_near(fw_order_percentile(5, x, 0), 1, 0);
    assert_near(fw_order_percentile(5, x, 0.1), 1.4, 1e-15);
    assert_near(fw_order_percentile(5, x, 0.5), 4, 0);
    assert_near(fw_order_percentile(5, x, 0.9), 12.8, 1e-15);
    assert_near(fw_order_percentile(5, x, 0.99), 15.68, 1e-15);
    assert_near(fw_order_percentile(5, x, 1), 16, 0);
    assert_near(fw_order_percentile(1, x, 0.99), 1, 0);
    assert_true(isnan(fw_order_percentile(0, NULL, 0.5)));
    assert_true(isnan(fw_order_percentile(5, x, 1.01)) && isnan(fw_order_percentile(5, x, NAN)));
    const double with_infinity[] = {1, INFINITY, INFINITY};
    assert_true(fw_order_percentile(3, with_infinity, 0.9) == INFINITY);
}

/* P(a <= Bin(n, p) <= b) summed term by term from log-gamma, independent of the incomplete beta function. */
static double binomial_between(int n, double p, int a, int b)
{
    double sum = 0;
    for (int k = a; k <= b; k++)
        sum += exp(lgamma(n + 1.0) - lgamma(k + 1.0) - lgamma(n - k + 1.0) + k * log(p) + (n - k) * log1p(-p));
    return sum;
}

static double *counting(size_t n) /* 1, 2, ... n: the interval then names its ranks */
{
    double *x = malloc(n * sizeof *x);
    for (size_t i = 0; i < n; i++) x[i] = (double)(i + 1);
    return x;
}

static void ends_exist_from_the_published_sizes_on(void **state)
{
    (void)state;
    /* 1 - p^n >= 0.975 */
    const struct {
        double p;
        size_t n;
    } limits[] = {{0.9, 36}, {0.95, 72}, {0.99, 368}};
    for (size_t i = 0; i < 3; i++) {
        double *x = counting(400);
        assert_true(isnan(fw_order_interval(limits[i].n - 1, x, 0, limits[i].p, 0.95).high));
        fw_interval at = fw_order_interval(limits[i].n, x, 0, limits[i].p, 0.95);
        assert_near(at.high, (double)limits[i].n, 0);
        assert_true(at.coverage >= 0.95);
        /* the mirror image: the lower end of P10, P5 and P1 */
        assert_true(isnan(fw_order_interval(limits[i].n - 1, x, 0, 1 - limits[i].p, 0.95).low));
        assert_near(fw_order_interval(limits[i].n, x, 0, 1 - limits[i].p, 0.95).low, 1, 0);
        free(x);
    }
}

static void ranks_are_those_of_the_tables(void **state)
{
    (void)state;
    double     *x = counting(100);
    /* median of 100: ranks 40 and 61, 96.48 % (Conover, Practical Nonparametric Statistics; any table of the sign
     * test) */
    fw_interval median = fw_order_interval(100, x, 0, 0.5, 0.95);
    assert_near(median.low, 40, 0);
    assert_near(median.high, 61, 0);
    assert_near(median.coverage, 0.9648, 5e-5);
    fw_interval p90 = fw_order_interval(100, x, 0, 0.9, 0.95);
    assert_near(p90.coverage, binomial_between(100, 0.9, (int)p90.low, (int)p90.high - 1), 1e-10);
    assert_true(binomial_between(100, 0.9, 0, (int)p90.low - 1) <= 0.025);
    assert_true(binomial_between(100, 0.9, 0, (int)p90.low) > 0.025);
    assert_true(binomial_between(100, 0.9, (int)p90.high, 100) <= 0.025);
    assert_true(binomial_between(100, 0.9, (int)p90.high - 1, 100) > 0.025);
    /* with one end missing the coverage is that of the other end alone */
    fw_interval p99 = fw_order_interval(100, x, 0, 0.99, 0.95);
    assert_true(isnan(p99.high) && p99.low > 0);
    assert_near(p99.coverage, binomial_between(100, 0.99, (int)p99.low, 100), 1e-10);
    free(x);
}

static void failed_runs_widen_both_ends(void **state)
{
    (void)state;
    double     *x = counting(97);
    fw_interval clean = fw_order_interval(100, x, 0, 0.9, 0.95);
    fw_interval failed = fw_order_interval(97, x, 3, 0.9, 0.95);
    /* ranks stay those of 100: three zeros below shift the lower one, three infinities above do not move the upper
     * one */
    assert_near(failed.low, clean.low - 3, 0);
    assert_near(failed.high, clean.high, 0);
    fw_interval many = fw_order_interval(80, x, 20, 0.9, 0.95);
    assert_true(isnan(many.high)); /* rank 96 or so of 100 is a failed one */
    assert_near(fw_order_interval(5, x, 95, 0.5, 0.95).low, 0, 0);
    assert_true(isnan(fw_order_interval(0, NULL, 40, 0.5, 0.95).high));
    free(x);
}

static void nothing_from_nothing(void **state)
{
    (void)state;
    const double one[] = {3};
    fw_interval  none = fw_order_interval(0, NULL, 0, 0.9, 0.95), single = fw_order_interval(1, one, 0, 0.9, 0.95);
    assert_true(isnan(none.low) && isnan(none.high) && isnan(none.coverage));
    assert_true(isnan(single.low) && isnan(single.high) && isnan(single.coverage));
    assert_true(isnan(fw_order_interval(1, one, 0, 1.0, 0.95).coverage));
    assert_true(isnan(fw_order_interval(1, one, 0, NAN, 0.95).coverage));
}

/* The law's percentile by bisection on its CDF. */
static double law_quantile(test_law law, double p)
{
    double from = -20, to = 20;
    for (int i = 0; i < 100; i++) {
        double mid = 0.5 * (from + to);
        if (law_cdf(law, exp(mid)) < p)
            from = mid;
        else
            to = mid;
    }
    return exp(to);
}

static void coverage_is_what_is_printed(void **state)
{
    (void)state;
    enum { REPEATS = 3000 };
    const double ps[] = {0.5, 0.9, 0.95, 0.99};
    const size_t ns[] = {40, 100, 400};
    double       x[400];
    for (int law = 0; law < N_LAWS; law++)
        for (size_t in = 0; in < 3; in++) {
            int       hit[4] = {0};
            double    printed[4] = {0}, truth[4];
            fw_random r;
            fw_random_stream(&r, 1, FW_STREAM_TEST, ns[in], (uint64_t)law);
            for (size_t k = 0; k < 4; k++) truth[k] = law_quantile((test_law)law, ps[k]);
            for (int repeat = 0; repeat < REPEATS; repeat++) {
                for (size_t i = 0; i < ns[in]; i++) x[i] = law_draw((test_law)law, fw_random_uniform(&r));
                qsort(x, ns[in], sizeof *x, compare_doubles);
                for (size_t k = 0; k < 4; k++) {
                    fw_interval v = fw_order_interval(ns[in], x, 0, ps[k], 0.95);
                    hit[k] += !(v.low > truth[k]) && !(v.high < truth[k]); /* an end that does not exist is no bound */
                    printed[k] = v.coverage;
                }
            }
            for (size_t k = 0; k < 4; k++) {
                assert_true(isnan(printed[k]) || printed[k] >= 0.95);
                if (!isnan(printed[k])) assert_true(fabs((double)hit[k] / REPEATS - printed[k]) <= 4 * coverage_error(printed[k], REPEATS) + 1e-9);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(percentiles_interpolate_between_ranks),
                                       cmocka_unit_test(ends_exist_from_the_published_sizes_on),
                                       cmocka_unit_test(ranks_are_those_of_the_tables),
                                       cmocka_unit_test(failed_runs_widen_both_ends),
                                       cmocka_unit_test(nothing_from_nothing),
                                       cmocka_unit_test(coverage_is_what_is_printed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
