/* Latin hypercubes: every interval once, all orders as likely, variances of sums and of products in closed form. */
#include "statistics/latin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

enum { S = 8, MOST = 1000 };

static void every_interval_once(void **state)
{
    (void)state;
    static bool    is_hit[S][MOST];
    const uint64_t sizes[] = {1, 2, 3, 4, 7, 8, 16, 25, 1000};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        for (uint64_t replicate = 0; replicate < 20; replicate++) {
            memset(is_hit, 0, sizeof is_hit);
            for (uint64_t i = 0; i < sizes[k]; i++) {
                double u[S];
                fw_latin_point(i, sizes[k], S, 1, replicate, u);
                for (int d = 0; d < S; d++) {
                    size_t at = (size_t)(u[d] * (double)sizes[k]);
                    assert_true(u[d] > 0 && u[d] < 1 && !is_hit[d][at]);
                    is_hit[d][at] = true;
                }
            }
        }
}

static void a_point_is_a_function_of_its_index(void **state)
{
    (void)state;
    double u[S], v[S];
    for (uint64_t i = 25; i-- > 0;) {
        fw_latin_point(i, 25, S, 1, 2, u);
        fw_latin_point(i, 25, 3, 1, 2, v); /* fewer dimensions: the first of them */
        assert_memory_equal(u, v, 3 * sizeof *u);
        fw_latin_point(i, 25, S, 1, 3, v);
        for (int d = 0; d < S; d++) assert_true(u[d] != v[d]);
        fw_latin_point(i, 25, S, 2, 2, v);
        for (int d = 0; d < S; d++) assert_true(u[d] != v[d]);
    }
    /* the largest hypercube, and one of a million points without a list of a million */
    fw_latin_point((UINT64_C(1) << 32) - 1, UINT64_C(1) << 32, S, 1, 2, u);
    for (int d = 0; d < S; d++) assert_true(u[d] > 0 && u[d] < 1);
    static bool is_hit[1000003];
    for (uint64_t i = 0; i < 1000003; i++) {
        fw_latin_point(i, 1000003, 1, 1, 2, u);
        size_t at = (size_t)(u[0] * 1000003);
        assert_false(is_hit[at]);
        is_hit[at] = true;
    }
}

/* chi-square against equal chances, within 4 standard errors of its mean. */
static void assert_equal_chances(size_t n_cells, const unsigned *count, double n)
{
    double chi2 = 0, expected = n / (double)n_cells, f = (double)n_cells - 1;
    for (size_t c = 0; c < n_cells; c++) chi2 += (count[c] - expected) * (count[c] - expected) / expected;
    assert_true(fabs(chi2 - f) < 4 * sqrt(2 * f));
}

/* Small sizes: each order of the first `read` points; the place within the interval beside. */
static void all_orders_are_as_likely(void **state)
{
    (void)state;
    enum { REPEATS = 60000 };
    static const struct {
        uint64_t size, read;
        size_t   orders; /* size! / (size - read)! */
    } cases[] = {{2, 2, 2}, {3, 3, 6}, {4, 4, 24}, {5, 3, 60}, {8, 2, 56}, {16, 2, 240}, {17, 1, 17}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        unsigned count[17 * 17] = {0}, cells[32] = {0}, dense[17 * 17] = {0};
        size_t   seen = 0;
        for (uint64_t r = 0; r < REPEATS; r++) {
            size_t code = 0;
            for (uint64_t i = 0; i < cases[k].read; i++) {
                double u;
                fw_latin_point(i, cases[k].size, 1, 3, r, &u);
                size_t at = (size_t)(u * (double)cases[k].size);
                code = code * (size_t)cases[k].size + at;
                if (i == 0) cells[(size_t)((u * (double)cases[k].size - (double)at) * 32)]++;
            }
            count[code]++;
        }
        for (size_t c = 0; c < 17 * 17; c++)
            if (count[c]) dense[seen++] = count[c];
        assert_int_equal(seen, cases[k].orders);
        assert_equal_chances(seen, dense, REPEATS);
        assert_equal_chances(32, cells, REPEATS);
    }
}

/* Moments over replicates of a number with mean `mean` and variance `variance` (closed forms), both within 4 standard errors. */
static void assert_moments(const double *x, size_t n, double mean, double variance)
{
    double m1 = 0, m2 = 0, m4 = 0, k = (double)n;
    for (size_t r = 0; r < n; r++) m1 += x[r] / k;
    for (size_t r = 0; r < n; r++) {
        double e = (x[r] - m1) * (x[r] - m1);
        m2 += e / (k - 1), m4 += e * e / k;
    }
    assert_true(fabs(m1 - mean) < 4 * sqrt(variance / k));
    assert_true(fabs(m2 - variance) < 4 * sqrt((m4 - m2 * m2) / k));
}

/* Orders of different dimensions are independent: their rank correlation has mean 0 and variance 1 / (n - 1) (Kendall and Gibbons, Rank Correlation
 * Methods). Neighbouring replicates likewise. */
static void rank_correlations(void **state)
{
    (void)state;
    enum { REPEATS = 3000 };
    static double  dimensions[REPEATS], replicates[REPEATS];
    const uint64_t sizes[] = {7, 16, 25};
    for (int k = 0; k < 3; k++) {
        double n = (double)sizes[k];
        for (uint64_t r = 0; r < REPEATS; r++) {
            dimensions[r] = replicates[r] = 0;
            for (uint64_t i = 0; i < sizes[k]; i++) {
                double u[S], v[S], scale = 12 / (n * (n * n - 1));
                fw_latin_point(i, sizes[k], S, 4, r, u);
                fw_latin_point(i, sizes[k], S, 4, r + 1, v);
                double a = floor(u[0] * n) - (n - 1) / 2, b = floor(u[S - 1] * n) - (n - 1) / 2, c = floor(v[0] * n) - (n - 1) / 2;
                dimensions[r] += scale * a * b, replicates[r] += scale * a * c;
            }
        }
        assert_moments(dimensions, REPEATS, 0, 1 / (n - 1));
        assert_moments(replicates, REPEATS, 0, 1 / (n - 1));
    }
}

/* The mean of u_1 + ... + u_s: only the places within intervals scatter, variance s / (12 n^3), 1 / n^2 of plain sampling's s / (12 n).
 * The mean of (u_1 - 1/2)(u_2 - 1/2): with v = 1 / (12 n^2) within an interval and S = n (1/12 - v) the sum of squares of the middles,
 * (S^2 / (n - 1) + 2 v S + n v^2) / n^2, close to plain sampling's 1 / (144 n). */
static void variances(void **state)
{
    (void)state;
    enum { REPEATS = 3000 };
    static double  sums[REPEATS], products[REPEATS];
    const uint64_t sizes[] = {2, 7, 25, 64};
    for (int k = 0; k < 4; k++) {
        double n = (double)sizes[k], v = 1 / (12 * n * n), squares = n * (1.0 / 12 - v);
        for (uint64_t r = 0; r < REPEATS; r++) {
            sums[r] = products[r] = 0;
            for (uint64_t i = 0; i < sizes[k]; i++) {
                double u[S];
                fw_latin_point(i, sizes[k], S, 5, r, u);
                for (int d = 0; d < S; d++) sums[r] += u[d] / n;
                products[r] += (u[0] - 0.5) * (u[1] - 0.5) / n;
            }
        }
        assert_moments(sums, REPEATS, 0.5 * S, S / (12 * n * n * n));
        assert_moments(products, REPEATS, 0, (squares * squares / (n - 1) + 2 * v * squares + n * v * v) / (n * n));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_interval_once), cmocka_unit_test(a_point_is_a_function_of_its_index),
        cmocka_unit_test(all_orders_are_as_likely), cmocka_unit_test(rank_correlations), cmocka_unit_test(variances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
