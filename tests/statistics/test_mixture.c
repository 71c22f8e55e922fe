/* Averaged CDFs: closed forms, atoms, joined entries. */
#include "statistics/mixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

static fw_distribution uniform(double a, double b)
{
    return (fw_distribution){.kind = FW_DIST_UNIFORM, .a = a, .b = b, .low = -INFINITY, .high = INFINITY};
}

static void one_load_gives_the_factors_own_law(void **state)
{
    (void)state;
    fw_distribution  T = uniform(-12, -2);
    fw_scale         s;
    fw_mixture       x;
    fw_mixture_entry one = {3, 0.7};
    assert_int_equal(fw_scale_make(&s, 0.116, 1.121, &T, NULL), FW_OK);
    assert_int_equal(fw_mixture_make(&x, &s, 1, &one, NULL), FW_OK);
    for (double u = 0.05; u < 1; u += 0.1)
        assert_near(fw_mixture_quantile(&x, u), 3 * 0.116 * pow(12 - 10 * u, -1.121), 1e-7);
    assert_near(fw_mixture_quantile(&x, 1), 3 * 0.116 * pow(2, -1.121), 1e-9);
    assert_true(isnan(fw_mixture_quantile(&x, 0)) && isnan(fw_mixture_quantile(&x, 1.1)) &&
                isnan(fw_mixture_quantile(&x, NAN)));
    fw_mixture_free(&x);
    fw_scale_free(&s);
}

static void product_of_lognormals_is_lognormal(void **state)
{
    (void)state;
    /* |T| lognormal is not among the temperature laws (T < 0), but loads are: with T constant the mixture is the load
     * law itself, scaled. Midpoint loads of a lognormal: quantiles return to O(1/n). */
    enum { N = 20000 };
    fw_scale          s;
    fw_mixture        x;
    fw_mixture_entry *e = malloc(N * sizeof *e);
    double            sigma = lognormal_sigma(1.5);
    for (size_t i = 0; i < N; i++)
        e[(i * 7919) % N] = (fw_mixture_entry){lognormal_quantile(sigma, ((double)i + 0.5) / N), 1};
    assert_int_equal(fw_scale_make(&s, 0.25, 1, NULL, NULL), FW_OK);
    assert_int_equal(fw_mixture_make(&x, &s, N, e, NULL), FW_OK);
    const double ps[] = {0.5, 0.9, 0.95, 0.99};
    for (size_t k = 0; k < 4; k++)
        assert_near(fw_mixture_quantile(&x, ps[k]), 0.25 * lognormal_quantile(sigma, ps[k]), 3e-3);
    fw_mixture_free(&x);
    fw_scale_free(&s);
    free(e);
}

static void steps_are_exact(void **state)
{
    (void)state;
    const double           t[] = {-4, -2}, w[] = {0.5, 0.5};
    const fw_mixture_entry e[] = {{8, 1}, {0, 2}, {4, 1}}; /* depths: 0 (1/2), 1 and 2 (1/8 each), 2 and 4 (1/8 each) */
    fw_distribution        T;
    fw_scale               s;
    fw_mixture             x;
    assert_int_equal(fw_distribution_values(&T, 2, t, w, NULL), FW_OK);
    assert_int_equal(fw_scale_make(&s, 1, 1, &T, NULL), FW_OK);
    assert_int_equal(fw_mixture_make(&x, &s, 3, e, NULL), FW_OK);
    assert_near(fw_mixture_cdf(&x, 0), 0.5, 1e-15);
    assert_near(fw_mixture_cdf(&x, 1), 0.625, 1e-15);
    assert_near(fw_mixture_cdf(&x, 1.99), 0.625, 1e-15);
    assert_near(fw_mixture_cdf(&x, 2), 0.875, 1e-15);
    assert_near(fw_mixture_cdf(&x, 4), 1, 1e-15);
    assert_true(fw_mixture_cdf(&x, -1) == 0 && fw_mixture_cdf(&x, NAN) == 0);
    assert_true(fw_mixture_quantile(&x, 0.5) == 0); /* exactly the atom */
    assert_near(fw_mixture_quantile(&x, 0.6), 1, 1e-12);
    assert_near(fw_mixture_quantile(&x, 0.8), 2, 1e-12);
    assert_near(fw_mixture_quantile(&x, 0.875), 2, 1e-12);
    assert_near(fw_mixture_quantile(&x, 0.88), 4, 1e-12);
    assert_near(fw_mixture_quantile(&x, 1), 4, 1e-12);
    fw_mixture_free(&x);
    fw_scale_free(&s);
    fw_distribution_free(&T);
}

static void joining_entries_moves_quantiles_by_less_than_1e_6(void **state)
{
    (void)state;
    /* the same loads, once as 30000 entries (joined) and once evaluated one by one */
    enum { N = 30000 };
    fw_distribution   T = uniform(-12, -2);
    fw_scale          s;
    fw_mixture        x;
    fw_random         r;
    fw_mixture_entry *e = malloc(N * sizeof *e);
    fw_random_stream(&r, 3, FW_STREAM_TEST, 0, 0);
    for (size_t i = 0; i < N; i++)
        e[i] = (fw_mixture_entry){lognormal_quantile(1.5, fw_random_uniform(&r)), fw_random_uniform(&r)};
    assert_int_equal(fw_scale_make(&s, 0.116, 1.121, &T, NULL), FW_OK);
    assert_int_equal(fw_mixture_make(&x, &s, N, e, NULL), FW_OK);
    assert_true(x.n < N);
    double total = 0;
    for (size_t i = 0; i < N; i++) total += e[i].weight;
    const double ps[] = {0.01, 0.5, 0.9, 0.99};
    for (size_t k = 0; k < 4; k++) {
        double q = fw_mixture_quantile(&x, ps[k]), below[2] = {0, 0};
        for (size_t i = 0; i < N; i++) {
            below[0] += e[i].weight * fw_scale_cdf(&s, q * (1 - 1e-6) / e[i].load) / total;
            below[1] += e[i].weight * fw_scale_cdf(&s, q * (1 + 1e-6) / e[i].load) / total;
        }
        assert_true(below[0] < ps[k] && ps[k] < below[1]);
    }
    fw_mixture_free(&x);
    fw_scale_free(&s);
    free(e);
}

static void nothing_and_nonsense(void **state)
{
    (void)state;
    fw_scale         s;
    fw_mixture       x;
    fw_mixture_entry zeros[] = {{0, 1}, {0, 1}}, negative = {-1, 1}, not_a_number = {NAN, 1}, weightless = {1, 0};
    assert_int_equal(fw_scale_make(&s, 1, 1, NULL, NULL), FW_OK);
    assert_int_equal(fw_mixture_make(&x, &s, 0, NULL, NULL), FW_E_ARG);
    assert_int_equal(fw_mixture_make(&x, &s, 1, &negative, NULL), FW_E_ARG);
    assert_int_equal(fw_mixture_make(&x, &s, 1, &not_a_number, NULL), FW_E_ARG);
    assert_int_equal(fw_mixture_make(&x, &s, 1, &weightless, NULL), FW_E_ARG);
    assert_int_equal(fw_mixture_make(&x, &s, 2, zeros, NULL), FW_OK); /* a wall that no floe ever touches */
    assert_true(fw_mixture_quantile(&x, 0.99) == 0 && fw_mixture_cdf(&x, 0) == 1);
    fw_mixture_free(&x);
    fw_mixture_free(NULL);
    fw_scale_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_load_gives_the_factors_own_law), cmocka_unit_test(product_of_lognormals_is_lognormal),
        cmocka_unit_test(steps_are_exact), cmocka_unit_test(joining_entries_moves_quantiles_by_less_than_1e_6),
        cmocka_unit_test(nothing_and_nonsense)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
