/* Calibrated weights and the variance of means: closed forms and laws of least squares. */
#include "statistics/calibrate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"
#include "statistics/spread.h"

enum { N = 200, P = 4 };

/* Functions of x uniform on (0, 1): x, x^2, twice the sum of both (dependent), a step at 1/2. */
static const double TOTALS[P] = {1.0 / 2, 1.0 / 3, 2 * (1.0 / 2 + 1.0 / 3), 1.0 / 2};
static void functions(double x, double *values)
{
    values[0] = x, values[1] = x * x, values[2] = 2 * (x + x * x), values[3] = x < 0.5;
}

typedef struct rig {
    double         x[N], plain[N], basis[N * P];
    fw_calibration c;
} rig;

static void make(rig *r, uint64_t part, bool is_weighted)
{
    fw_random random;
    double    sum = 0;
    fw_random_stream(&random, 3, FW_STREAM_TEST, 77, part);
    for (size_t i = 0; i < N; i++) {
        r->x[i] = fw_random_uniform(&random);
        r->plain[i] = is_weighted ? 0.5 + fw_random_uniform(&random) : 1;
        sum += r->plain[i];
        functions(r->x[i], r->basis + i * P);
    }
    for (size_t i = 0; i < N; i++) r->plain[i] /= sum;
    assert_int_equal(fw_calibration_make(&r->c, N, r->plain, P, r->basis, TOTALS, NULL), FW_OK);
}

static void means_of_the_functions_are_the_laws(void **state)
{
    (void)state;
    for (int w = 0; w < 2; w++) {
        rig *r = malloc(sizeof *r);
        make(r, 1, w);
        assert_int_equal(r->c.n_functions, 4); /* the constant and three: one depends on the others */
        double sum = 0, mean[P] = {0};
        for (size_t i = 0; i < N; i++) {
            sum += r->c.weight[i];
            for (size_t k = 0; k < P; k++) mean[k] += r->c.weight[i] * r->basis[i * P + k];
        }
        assert_near(sum, 1, 1e-12);
        for (size_t k = 0; k < P; k++) assert_near(mean[k], TOTALS[k], 1e-11);
        fw_calibration_free(&r->c);
        free(r);
    }
}

/* Raked weights are positive, have the same means, and are near the straight ones where those are near the plain. */
static void raking(void **state)
{
    (void)state;
    rig   *r = malloc(sizeof *r);
    double straight[N], mean[P] = {0}, sum = 0;
    bool   is_done = false;
    make(r, 5, true);
    memcpy(straight, r->c.weight, sizeof straight);
    assert_int_equal(fw_calibration_rake(&r->c, &is_done, NULL), FW_OK);
    assert_true(is_done);
    for (size_t i = 0; i < N; i++) {
        assert_true(r->c.weight[i] > 0);
        assert_true(fabs(r->c.weight[i] - straight[i]) < 0.1 * r->plain[i]);
        sum += r->c.weight[i];
        for (size_t k = 0; k < P; k++) mean[k] += r->c.weight[i] * r->basis[i * P + k];
    }
    assert_near(sum, 1, 1e-10);
    for (size_t k = 0; k < P; k++) assert_near(mean[k], TOTALS[k], 1e-9);
    fw_calibration_free(&r->c);
    free(r);
    /* a law far from the sample: straight weights fall below nothing, raked ones do not; a law beyond it has none */
    double x[20], plain[20], near_end = 0.93, beyond = 1.2, least = 1, raked_least = 1, got = 0;
    for (size_t i = 0; i < 20; i++) x[i] = ((double)i + 0.5) / 20, plain[i] = 0.05;
    fw_calibration c;
    assert_int_equal(fw_calibration_make(&c, 20, plain, 1, x, &near_end, NULL), FW_OK);
    for (size_t i = 0; i < 20; i++) least = fmin(least, c.weight[i]);
    assert_int_equal(fw_calibration_rake(&c, &is_done, NULL), FW_OK);
    for (size_t i = 0; i < 20; i++) raked_least = fmin(raked_least, c.weight[i]), got += c.weight[i] * x[i];
    assert_true(is_done && least < 0 && raked_least > 0);
    assert_near(got, 0.93, 1e-9);
    fw_calibration_free(&c);
    assert_int_equal(fw_calibration_make(&c, 20, plain, 1, x, &beyond, NULL), FW_OK);
    memcpy(straight, c.weight, 20 * sizeof *straight);
    assert_int_equal(fw_calibration_rake(&c, &is_done, NULL), FW_OK);
    assert_true(!is_done && memcmp(straight, c.weight, 20 * sizeof *straight) == 0);
    fw_calibration_free(&c);
}

/* What lies in the functions' span has its exact mean, 3 + 2/2 - 5/3 + 7/2, whatever was drawn, and no residual. */
static void the_span_is_exact(void **state)
{
    (void)state;
    rig   *r = malloc(sizeof *r);
    double f[N], mean = 0;
    make(r, 2, true);
    for (size_t i = 0; i < N; i++) {
        f[i] = 3 + 2 * r->x[i] - 5 * r->x[i] * r->x[i] + 7 * (r->x[i] < 0.5);
        mean += r->c.weight[i] * f[i];
    }
    assert_near(mean, 3 + 1 - 5.0 / 3 + 3.5, 1e-11);
    fw_calibration_residuals(&r->c, f);
    for (size_t i = 0; i < N; i++) assert_true(fabs(f[i]) < 1e-10);
    fw_calibration_free(&r->c);
    free(r);
}

/* One function, equal weights: the textbook's control variate, mean f + b (t - mean x) with b = cov / var, and leave-one-out residuals e / (1 - h),
 * h = 1/n + (x - mean x)^2 / sum (x - mean x)^2. */
static void one_function_is_the_textbooks_control_variate(void **state)
{
    (void)state;
    enum { n = 50 };
    double         x[n], f[n], plain[n], mx = 0, mf = 0, xx = 0, xf = 0, got = 0, total = 0.5;
    fw_random      r;
    fw_calibration c;
    fw_random_stream(&r, 3, FW_STREAM_TEST, 78, 0);
    for (size_t i = 0; i < n; i++) {
        x[i] = fw_random_uniform(&r), f[i] = exp(x[i]) + 0.1 * fw_random_uniform(&r), plain[i] = 1.0 / n;
        mx += x[i] / n, mf += f[i] / n;
    }
    for (size_t i = 0; i < n; i++) xx += (x[i] - mx) * (x[i] - mx), xf += (x[i] - mx) * (f[i] - mf);
    assert_int_equal(fw_calibration_make(&c, n, plain, 1, x, &total, NULL), FW_OK);
    for (size_t i = 0; i < n; i++) got += c.weight[i] * f[i];
    assert_near(got, mf + xf / xx * (total - mx), 1e-12);
    double values[n];
    memcpy(values, f, sizeof f);
    fw_calibration_residuals(&c, values);
    for (size_t i = 0; i < n; i++) {
        double e = f[i] - mf - xf / xx * (x[i] - mx), h = 1.0 / n + (x[i] - mx) * (x[i] - mx) / xx;
        assert_true(fabs(values[i] - e / (1 - h)) < 1e-12);
    }
    fw_calibration_free(&c);
}

/* Without functions a mean is a mean, and its variance s^2/n to within the jackknife's n/(n - 1). */
static void no_function_is_plain_sampling(void **state)
{
    (void)state;
    double         f[N], plain[N], mean = 0, squares = 0, scratch[8];
    int32_t        unit[N];
    fw_calibration c;
    for (size_t i = 0; i < N; i++) f[i] = (double)(i * i % 17), plain[i] = 1.0 / N, mean += f[i] / N, unit[i] = (int32_t)(i % 8);
    for (size_t i = 0; i < N; i++) squares += (f[i] - mean) * (f[i] - mean);
    assert_int_equal(fw_calibration_make(&c, N, plain, 0, NULL, NULL, NULL), FW_OK);
    for (size_t i = 0; i < N; i++) assert_near(c.weight[i], 1.0 / N, 1e-13);
    double means[8] = {0}, between = 0;
    for (size_t i = 0; i < N; i++) means[i % 8] += (f[i] - mean) / (N / 8);
    for (int k = 0; k < 8; k++) between += means[k] * means[k];
    fw_calibration_residuals(&c, f);
    fw_units  alone = {.n = N, .weight = plain, .n_units = N, .n_fitted = 1}, units = {.n = N, .weight = plain, .unit = unit, .n_units = 8, .n_fitted = 1};
    fw_spread a = fw_spread_of(&alone, f, NULL), u = fw_spread_of(&units, f, scratch);
    assert_near(a.variance, squares / (N - 1) / N * N / (N - 1.0), 1e-10);
    assert_near(a.dof, N - 1, 0);
    assert_near(u.variance, between / 7 / 8 * pow(N / (N - 1.0), 2), 1e-10);
    assert_near(u.dof, 7, 0);
    fw_calibration_free(&c);
}

/* Relative variance of a variance: normal shares 2/n (kurtosis 3); one that carries all: 1 - 1/n. */
static void variance_of_the_variance(void **state)
{
    (void)state;
    double    z[N], plain[N];
    fw_units  u = {.n = N, .weight = plain, .n_units = N, .n_fitted = 1};
    fw_random r;
    double    mean = 0;
    enum { REPEATS = 400 };
    fw_random_stream(&r, 3, FW_STREAM_TEST, 79, 0);
    for (size_t i = 0; i < N; i++) plain[i] = 1.0 / N;
    for (int k = 0; k < REPEATS; k++) {
        for (size_t i = 0; i < N; i++) z[i] = gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r));
        mean += fw_spread_of(&u, z, NULL).vov / REPEATS;
    }
    assert_near(mean, 2.0 / N, 0.06); /* E sum z^4 / (sum z^2)^2 = 3 / (n + 2); scatter of one is 17 % */
    memset(z, 0, sizeof z);
    z[3] = 1;
    assert_near(fw_spread_of(&u, z, NULL).vov, 1 - 1.0 / N, 1e-12);
    u.n_units = u.n = 1;
    assert_true(isnan(fw_spread_of(&u, z, NULL).variance));
}

static void nothing_to_weigh_is_refused(void **state)
{
    (void)state;
    fw_calibration c;
    assert_int_equal(fw_calibration_make(&c, 0, NULL, 0, NULL, NULL, NULL), FW_E_ARG);
    double one = 1, x = 0.3, total = 0.5; /* one realisation: no function fits beside the constant */
    assert_int_equal(fw_calibration_make(&c, 1, &one, 1, &x, &total, NULL), FW_OK);
    assert_int_equal(c.n_functions, 1);
    assert_near(c.weight[0], 1, 0);
    fw_calibration_free(&c);
    fw_calibration_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(means_of_the_functions_are_the_laws),
                                       cmocka_unit_test(raking),
                                       cmocka_unit_test(the_span_is_exact),
                                       cmocka_unit_test(one_function_is_the_textbooks_control_variate),
                                       cmocka_unit_test(no_function_is_plain_sampling),
                                       cmocka_unit_test(variance_of_the_variance),
                                       cmocka_unit_test(nothing_to_weigh_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
