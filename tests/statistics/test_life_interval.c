/* Intervals of a life percentile: coverage over records and over tables of years, slopes, failed runs. */
#include "statistics/life_interval.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/mean.h"
#include "statistics/near.h"

#include "statistics/lognormal_windows.h"

enum { REPEATS = 6000, MOST = 400, YEARS = 50 };

typedef struct law {
    const char *name;
    double      first, second; /* E D, E D^2 */
    double (*draw)(double u, double v);
} law;

static double draw_lognormal(double u, double v)
{
    (void)v;
    return lognormal_quantile(lognormal_sigma(1.5), u);
}

static double draw_weibull(double u, double v)
{
    (void)v;
    return pow(-log(u), 1 / 0.7);
}

/* Calm windows, and three of ten that wear ten-fold. */
static double draw_mixture(double u, double v)
{
    return v < 0.7 ? 0.1 * lognormal_quantile(lognormal_sigma(0.5), u) : lognormal_quantile(lognormal_sigma(1), u);
}

static const law LAWS[] = {
    {"lognormal", 1.8027756377319946, 10.5625, draw_lognormal}, /* exp(s^2/2), exp(2 s^2) with s^2 = ln 3.25 */
    {"Weibull", 1.2658235060572851, 5.0291258450284785, draw_weibull}, /* Gamma(1 + k/0.7) */
    {"mixture", 0.7 * 0.1 * 1.118033988749895 + 0.3 * 1.4142135623730951, 0.7 * 0.01 * 1.5625 + 0.3 * 4, draw_mixture}};

static fw_life_spread even_life(double phi, double cv, fw_scores *s, fw_year *kinds)
{
    for (size_t k = 0; k < YEARS; k++) kinds[k] = (fw_year){800, 1};
    fw_years y = {.n_years = YEARS, .n = YEARS, .kinds = kinds, .cv = cv};
    lognormal_scores(s);
    return fw_life_spread_make(&y, s, phi);
}

static double percentile_of(const fw_life_spread *l, double first, double second, double k)
{
    return l->windows * first + k * fw_life_spread_sd(l, first, second - first * first);
}

static double coverage(const law *q, const fw_life_spread *l, size_t n, double k)
{
    double    first[MOST], second[MOST], values[MOST], truth = percentile_of(l, q->first, q->second, k);
    int       hit = 0;
    fw_random r;
    fw_random_stream(&r, 8, FW_STREAM_TEST, n, (uint64_t)(q - LAWS));
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        double sum = 0, square = 0;
        for (size_t i = 0; i < n; i++) {
            double u = fw_random_uniform(&r), v = fw_random_uniform(&r);
            first[i] = q->draw(u, v), second[i] = first[i] * first[i];
            sum += first[i] / (double)n, square += second[i] / (double)n;
        }
        double         percentile = percentile_of(l, sum, square, k);
        fw_life_slopes slopes = fw_life_slopes_make(l, sum, square - sum * sum, percentile);
        for (size_t i = 0; i < n; i++) values[i] = percentile + slopes.first * (first[i] - sum) + slopes.second * (second[i] - square);
        fw_interval v = fw_mean_interval_of(percentile, n, values, 0, 0, FW_MEAN_MIN_N, 0.95);
        hit += v.low <= truth && truth <= v.high;
    }
    return (double)hit / REPEATS;
}

/* Persistence 0.97 and a year CV of 0.4: half of a life's scatter comes from a window's variance, whose estimate is what makes it hard. */
static void records_cover_what_they_promise(void **state)
{
    (void)state;
    fw_scores      s;
    fw_year        kinds[YEARS];
    fw_life_spread l = even_life(0.97, 0.4, &s, kinds), plain = even_life(0, 0, &s, kinds);
    const size_t   ns[] = {FW_MEAN_MIN_N, 100, MOST};
    for (size_t q = 0; q < 3; q++)
        for (size_t i = 0; i < 3; i++) {
            double with[] = {coverage(&LAWS[q], &plain, ns[i], 1.2816), coverage(&LAWS[q], &l, ns[i], 0), coverage(&LAWS[q], &l, ns[i], 2.5)};
            for (size_t k = 0; k < 3; k++)
                if (!(with[k] >= 0.93 && with[k] <= 0.97)) fail_msg("%s, %zu records, case %zu: %.4f", LAWS[q].name, ns[i], k, with[k]);
        }
}

static void tables_cover_what_they_promise(void **state)
{
    (void)state;
    /* years of lognormal length, mean 400 windows and CV 0.4; sums of a winter go with its length */
    fw_scores s;
    lognormal_scores(&s);
    double       each = fw_scores_sum(&s, 0.9, 400) / 400, sigma = lognormal_sigma(0.4);
    const size_t ns[] = {FW_LIFE_YEARS, 10, 30};
    for (size_t i = 0; i < 3; i++)
        for (double k = 0; k < 3; k += 1.2816) {
            fw_life_spread l = {YEARS * 400, YEARS * 400 * each, YEARS * 0.16 * 400 * 400};
            double         truth = percentile_of(&l, s.mean, s.variance + s.mean * s.mean, k);
            int            hit = 0;
            fw_random      r;
            fw_random_stream(&r, 9, FW_STREAM_TEST, ns[i], 0);
            for (int repeat = 0; repeat < REPEATS; repeat++) {
                fw_year rows[30];
                double  sums[30], sum = 0, square = 0, n = (double)ns[i];
                for (size_t j = 0; j < ns[i]; j++) {
                    double x = round(400 * lognormal_quantile(sigma, fw_random_uniform(&r)) * exp(-sigma * sigma / 2));
                    rows[j] = (fw_year){(size_t)x, 1}, sums[j] = each * x;
                    sum += x / n, square += x * x / n;
                }
                fw_years       y = {.n_years = YEARS, .is_table = true, .n = ns[i], .kinds = rows};
                fw_life_spread own = {YEARS * sum, YEARS * sum * each, YEARS * (square - sum * sum)};
                double         percentile = percentile_of(&own, s.mean, s.variance + s.mean * s.mean, k);
                fw_interval    v = fw_life_years_interval(&y, sums, s.mean, s.variance, percentile, 0.95);
                hit += v.low <= truth && truth <= v.high;
            }
            double got = (double)hit / REPEATS, error = 4 * coverage_error(0.93, REPEATS);
            if (!(got >= 0.93 - error && got <= 0.97)) fail_msg("%zu years, %.2f standard deviations: %.4f", ns[i], k, got);
        }
    fw_year  few[FW_LIFE_YEARS] = {{1, 1}};
    double   one[FW_LIFE_YEARS] = {1};
    fw_years y = {.n_years = YEARS, .is_table = true, .n = FW_LIFE_YEARS - 1, .kinds = few};
    assert_true(isnan(fw_life_years_interval(&y, one, 1, 1, 50, 0.95).low));
    y.n = FW_LIFE_YEARS, y.is_table = false;
    assert_true(isnan(fw_life_years_interval(&y, one, 1, 1, 50, 0.95).low));
}

static void slopes_are_derivatives(void **state)
{
    (void)state;
    fw_scores      s;
    fw_year        kinds[YEARS];
    fw_life_spread l = even_life(0.9, 0.3, &s, kinds);
    double         first = 2, second = 9, k = 1.7, h = 1e-5, at = percentile_of(&l, first, second, k);
    fw_life_slopes g = fw_life_slopes_make(&l, first, second - first * first, at);
    assert_near(g.first, (percentile_of(&l, first + h, second, k) - percentile_of(&l, first - h, second, k)) / (2 * h), 1e-7);
    assert_near(g.second, (percentile_of(&l, first, second + h, k) - percentile_of(&l, first, second - h, k)) / (2 * h), 1e-6);
    assert_near(g.first * first + 2 * g.second * second, at, 1e-12); /* a depth: twice the depths, twice the percentile (Euler) */
    g = fw_life_slopes_make(&l, 2, 0, l.windows * 2 + 3);            /* windows that do not scatter, years that do */
    assert_true(isfinite(g.first) && g.second > 0);
    g = fw_life_slopes_make(&(fw_life_spread){100, 100, 0}, 2, 0, 200);
    assert_true(g.first == 100 && g.second == 0);
}

static void failed_runs_and_small_samples(void **state)
{
    (void)state;
    double values[100];
    for (size_t i = 0; i < 100; i++) values[i] = 1000 * (1 + (double)(i % 7));
    fw_interval clean = fw_mean_interval_of(3950, 99, values, 0, 0, FW_MEAN_MIN_N, 0.95);
    fw_interval failed = fw_mean_interval_of(3950, 99, values, 1, 0, FW_MEAN_MIN_N, 0.95);
    assert_true(failed.low < clean.low && isnan(failed.high) && clean.high > 3950);
    assert_true(isnan(fw_mean_interval_of(3950, FW_MEAN_MIN_N - 1, values, 0, 0, FW_MEAN_MIN_N, 0.95).low));
    assert_true(isfinite(fw_mean_interval_of(3950, FW_MEAN_MIN_UNITS, values, 0, 0, FW_MEAN_MIN_UNITS, 0.95).low));
    assert_true(isnan(fw_mean_interval_of(0, 0, NULL, 100, 0, FW_MEAN_MIN_N, 0.95).low));
    for (size_t i = 0; i < 100; i++) values[i] = 5000;
    fw_interval equal = fw_mean_interval_of(5000, 100, values, 0, 0, FW_MEAN_MIN_N, 0.95);
    assert_near(equal.low, 5000, 1e-12);
    assert_near(equal.high, 5000, 1e-12);
    fw_interval both = fw_life_both(10, (fw_interval){7, 14, 0.95}, (fw_interval){6, 13, 0.95});
    assert_near(both.low, 5, 1e-15); /* 3 and 4 below, 4 and 3 above */
    assert_near(both.high, 15, 1e-15);
    both = fw_life_both(10, (fw_interval){7, NAN, 0.95}, (fw_interval){6, 13, 0.95});
    assert_true(isnan(both.high) && both.low == 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(records_cover_what_they_promise), cmocka_unit_test(tables_cover_what_they_promise),
                                       cmocka_unit_test(slopes_are_derivatives), cmocka_unit_test(failed_runs_and_small_samples)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
