#include "abrasion/power.h"
#include "check.h"

/* The C library's pow is the other program. */
static void agrees_with_pow(void **state)
{
    (void)state;
    static const double M[] = {1e-6, 0.05, 0.3, 1, 1.121, 1.5, 1.9, 1.999999};
    for (int i = 0; i < 8; i++) {
        fw_power t;
        fw_power_init(&t, M[i]);
        for (double p = 1e-22; p < 1e22; p *= 1.0137) CHECK_RELATIVE(fw_power_of(&t, p), pow(p, M[i]), 2e-12);
        /* on both sides of a bin's and of an octave's edge */
        for (int b = 0; b <= 128; b++) {
            double edge = 4096 * (1 + b / 64.0);
            CHECK_RELATIVE(fw_power_of(&t, edge), pow(edge, M[i]), 2e-12);
            CHECK_RELATIVE(fw_power_of(&t, nextafter(edge, 0)), pow(edge, M[i]), 2e-12);
        }
    }
}

static void ugly_pressures(void **state)
{
    (void)state;
    fw_power t;
    fw_power_init(&t, 1.121);
    assert_true(fw_power_of(&t, 0) == 0);
    assert_true(fw_power_of(&t, INFINITY) == INFINITY);
    assert_true(isnan(fw_power_of(&t, NAN)));
    assert_true(isnan(fw_power_of(&t, -1)));
    CHECK_RELATIVE(fw_power_of(&t, 5e-324), pow(5e-324, 1.121), 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(agrees_with_pow), cmocka_unit_test(ugly_pressures)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
