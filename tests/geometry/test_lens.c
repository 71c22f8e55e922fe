#include "check.h"
#include "geometry/lens.h"

/* Chord from the circle equation: the corner of the lens solved by bisection on the angle, independent of Heron's form. */
static double chord_by_bisection(double depth, double r1, double r2)
{
    double D = r1 + r2 - depth, lo = 0, hi = 3.14159265358979323846;
    for (int i = 0; i < 200; i++) { /* point (r1 cos a, r1 sin a) on circle 1; inside circle 2 for small a */
        double a = 0.5 * (lo + hi), x = r1 * cos(a) - D, y = r1 * sin(a);
        if (x * x + y * y < r2 * r2)
            lo = a;
        else
            hi = a;
    }
    return 2 * r1 * sin(lo);
}

static void agrees_with_circle_equations(void **state)
{
    (void)state;
    static const double R[] = {0.6, 1.25, 2.5, 5, 6.28};
    static const double SHARE[] = {1e-6, 1e-3, 0.05, 0.2, 0.6};
    for (size_t i = 0; i < 5; i++)
        for (size_t k = 0; k < 5; k++) {
            double depth = SHARE[k] * R[i];
            CHECK_RELATIVE(fw_lens_chord(depth, R[i], 3.7), chord_by_bisection(depth, 3.7, R[i]), 1e-9);
        }
}

static void is_symmetric_and_shallow_limit(void **state)
{
    (void)state;
    assert_true(fw_lens_chord(0.01, 1.25, 3.7) == fw_lens_chord(0.01, 3.7, 1.25));
    /* b -> 2 sqrt(2 R* d), 1/R* = 1/R + 1/Rs, as d -> 0 */
    double rs = 1 / (1 / 1.25 + 1 / 3.7), d = 1e-10;
    CHECK_RELATIVE(fw_lens_chord(d, 1.25, 3.7), 2 * sqrt(2 * rs * d), 1e-9);
}

static void ugly_depths(void **state)
{
    (void)state;
    assert_true(fw_lens_chord(0, 1, 2) == 0);
    assert_true(fw_lens_chord(-1, 1, 2) == 0);
    assert_true(fw_lens_chord(NAN, 1, 2) == 0);
    assert_true(fw_lens_chord(1.9, 1, 2) == 2); /* the small disc is nearly swallowed: its diameter */
    assert_true(fw_lens_chord(2.5, 1, 2) == 2);
    double last = 0;
    for (double d = 0; d < 2; d += 0.01) {
        double b = fw_lens_chord(d, 1, 2);
        assert_true(b >= last - 1e-12);
        last = b;
    }
}

static void four_at_once(void **state)
{
    (void)state;
    static const double R[] = {0.6, 1.25, 3.7, 6.28};
    for (size_t i = 0; i < 4; i++)
        for (double d = -0.1; d < 9; d += 0.37) {
            double depth[4] = {d, d * 1e-6, d * 0.5, 2 * d}, chord[4];
            fw_lens_chords(depth, R[i], 3.7, chord);
            for (int q = 0; q < 4; q++) assert_true(chord[q] == fw_lens_chord(depth[q], R[i], 3.7));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(agrees_with_circle_equations),
                                       cmocka_unit_test(is_symmetric_and_shallow_limit), cmocka_unit_test(ugly_depths),
                                       cmocka_unit_test(four_at_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
