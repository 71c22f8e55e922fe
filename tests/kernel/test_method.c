/* Order conditions of the Butcher tables (Hairer, Norsett, Wanner, Solving ODEs I, table II.2.2), to rounding, and the
 * family's promises: explicit first stage, one diagonal value, stage order 2, stiffly accurate, L-stable. */
#include "check.h"
#include "kernel/method.h"

static double dot(size_t n, const double *a, const double *b)
{
    double s = 0;
    for (size_t i = 0; i < n; i++) s += a[i] * b[i];
    return s;
}

static void order_conditions(const fw_method *m, const double *b, int order)
{
    size_t n = m->n_stages;
    double one[FW_MAX_STAGES], c2[FW_MAX_STAGES], c3[FW_MAX_STAGES], ac[FW_MAX_STAGES], ac2[FW_MAX_STAGES],
        aac[FW_MAX_STAGES], cac[FW_MAX_STAGES];
    for (size_t i = 0; i < n; i++) {
        one[i] = 1, c2[i] = m->c[i] * m->c[i], c3[i] = c2[i] * m->c[i];
        ac[i] = dot(n, m->a[i], m->c);
        cac[i] = m->c[i] * ac[i];
    }
    for (size_t i = 0; i < n; i++) ac2[i] = dot(n, m->a[i], c2), aac[i] = dot(n, m->a[i], ac);
    const double tol = 1e-14;
    CHECK_NEAR(dot(n, b, one), 1, tol);
    if (order >= 2) CHECK_NEAR(dot(n, b, m->c), 1.0 / 2, tol);
    if (order >= 3) {
        CHECK_NEAR(dot(n, b, c2), 1.0 / 3, tol);
        CHECK_NEAR(dot(n, b, ac), 1.0 / 6, tol);
    }
    if (order >= 4) {
        CHECK_NEAR(dot(n, b, c3), 1.0 / 4, tol);
        CHECK_NEAR(dot(n, b, cac), 1.0 / 8, tol);
        CHECK_NEAR(dot(n, b, ac2), 1.0 / 12, tol);
        CHECK_NEAR(dot(n, b, aac), 1.0 / 24, tol);
    }
}

static void family(const fw_method *m)
{
    size_t n = m->n_stages;
    for (size_t i = 0; i < n; i++) {
        double sum = 0, ac = 0;
        for (size_t j = 0; j < n; j++) sum += m->a[i][j], ac += m->a[i][j] * m->c[j];
        CHECK_NEAR(sum, m->c[i], 1e-14);
        CHECK_NEAR(ac, 0.5 * m->c[i] * m->c[i], 1e-14); /* stage order 2 */
        CHECK_NEAR(m->a[i][i], i ? m->gamma : 0, 1e-15);
        for (size_t j = i + 1; j < n; j++) assert_true(m->a[i][j] == 0);
        CHECK_NEAR(m->b[i], m->a[n - 1][i], 0);
    }
    /* L-stability on the test equation y' = z y, one step: |R| <= 1 on the imaginary axis side (real samples), R -> 0 */
    for (double z = -1e-3; z > -1e8; z *= 3) {
        double Y[FW_MAX_STAGES];
        for (size_t i = 0; i < n; i++) {
            double r = 1;
            for (size_t j = 0; j < i; j++) r += z * m->a[i][j] * Y[j];
            Y[i] = r / (1 - z * m->a[i][i]);
        }
        assert_true(fabs(Y[n - 1]) <= 1);
        if (z < -1e6) CHECK_NEAR(Y[n - 1], 0, 1e-5);
    }
}

static void tables(void **state)
{
    (void)state;
    const fw_method *all[] = {FW_METHOD_TRBDF2, FW_METHOD_ARK3, FW_METHOD_ARK4};
    static const int EMBEDDED[] = {3, 2, 3};
    for (size_t i = 0; i < 3; i++) {
        double hat[FW_MAX_STAGES];
        for (size_t s = 0; s < all[i]->n_stages; s++) hat[s] = all[i]->b[s] - all[i]->e[s];
        order_conditions(all[i], all[i]->b, all[i]->order);
        order_conditions(all[i], hat, EMBEDDED[i]);
        family(all[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
