/* The law of a |T|^-m against its closed form for uniform T, and its tabulated CDF against the exact one. */
#include "statistics/scale.h"

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

static void uniform_temperature_has_a_closed_form(void **state)
{
    (void)state;
    const double    a = 0.116, m = 1.121;
    fw_distribution T = uniform(-12, -2);
    fw_scale        s;
    assert_int_equal(fw_scale_make(&s, a, m, &T, NULL), FW_OK);
    for (double u = 0.05; u < 1; u += 0.1) { /* P(Y <= y) = (12 - (a/y)^(1/m))/10, so y = a (12 - 10 u)^-m */
        double y = a * pow(12 - 10 * u, -m);
        assert_near(fw_scale_quantile(&s, u), y, 1e-13);
        assert_near(fw_scale_cdf(&s, y), u, 1e-12);
        assert_near(fw_scale_cdf_ln(&s, log(y)), u, 1e-7);
    }
    /* E Y^k = a^k (2^(1-km) - 12^(1-km))/(10 (km - 1)) */
    for (int k = 1; k <= 3; k++) {
        double q = k * m - 1;
        assert_near(s.moment[k], pow(a, k) * (pow(2, -q) - pow(12, -q)) / (10 * q), 1e-12);
    }
    assert_true(fw_scale_cdf(&s, 0) == 0 && fw_scale_cdf(&s, -1) == 0 && fw_scale_cdf(&s, 1e3) == 1);
    assert_true(fw_scale_cdf_ln(&s, -INFINITY) == 0 && fw_scale_cdf_ln(&s, 99) == 1);
    fw_scale_free(&s);
}

static void the_table_agrees_with_the_exact_law(void **state)
{
    (void)state;
    fw_distribution laws[] = {
        uniform(-25, -1.8),
        {.kind = FW_DIST_NORMAL, .a = -10, .b = 4, .low = -INFINITY, .high = -1.8},
        {.kind = FW_DIST_TRIANGULAR, .a = -20, .b = -8, .c = -2, .low = -INFINITY, .high = INFINITY},
        {.kind = FW_DIST_BETA, .a = 2, .b = 3, .c = -30, .d = -2, .low = -INFINITY, .high = INFINITY}};
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        fw_scale s;
        assert_int_equal(fw_scale_make(&s, 1, 1.121, &laws[i], NULL), FW_OK);
        double mean = 0;
        enum { N = 20000 };
        for (int k = 0; k < N; k++) {
            double u = (k + 0.5) / N, y = fw_scale_quantile(&s, u);
            mean += y / N;
            assert_true(fabs(fw_scale_cdf_ln(&s, log(y)) - u) < 1e-7);
        }
        assert_near(s.moment[1], mean, 1e-5); /* midpoint sum over equal probabilities */
        fw_scale_free(&s);
    }
}

static void constants_and_values_are_atoms(void **state)
{
    (void)state;
    fw_scale        s;
    fw_distribution T;
    fw_distribution_constant(&T, -10);
    assert_int_equal(fw_scale_make(&s, 0.116, 1.121, &T, NULL), FW_OK);
    assert_true(s.is_discrete && s.n == 1);
    assert_near(s.values[0], 0.116 * pow(10, -1.121), 1e-14);
    fw_scale_free(&s);
    assert_int_equal(fw_scale_make(&s, 0.5, 1, NULL, NULL), FW_OK); /* a law without temperature */
    assert_near(s.values[0], 0.5, 0);
    assert_near(s.moment[3], 0.125, 1e-15);
    fw_scale_free(&s);

    const double t[] = {-20, -10, -5}, w[] = {0.5, 0.25, 0.25};
    assert_int_equal(fw_distribution_values(&T, 3, t, w, NULL), FW_OK);
    T.low = -15;
    assert_int_equal(fw_scale_make(&s, 1, 1, &T, NULL), FW_OK);
    assert_int_equal(s.n, 2); /* -20 is cut off */
    assert_near(fw_scale_cdf(&s, 0.15), 0.5, 1e-15);
    assert_near(fw_scale_quantile(&s, 0.7), 0.2, 1e-15);
    assert_near(s.moment[1], 0.15, 1e-15);
    fw_scale_free(&s);
    fw_distribution_free(&T);
}

static void warm_laws_are_refused(void **state)
{
    (void)state;
    fw_distribution T = uniform(-5, 0);
    fw_scale        s;
    fw_msg          m;
    assert_int_equal(fw_scale_make(&s, 1, 1, &T, &m), FW_E_ARG);
    assert_int_equal(fw_scale_make(&s, 0, 1, NULL, &m), FW_E_ARG);
    fw_scale_free(&s);
    fw_scale_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_temperature_has_a_closed_form), cmocka_unit_test(the_table_agrees_with_the_exact_law),
        cmocka_unit_test(constants_and_values_are_atoms), cmocka_unit_test(warm_laws_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
