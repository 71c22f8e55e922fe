/* Head-on, zeta = 1, no drag: d = v t exp(-wt), N = m w v exp(-wt) (2 - wt) until wt = 2, then no force and the floe leaves with
 * v exp(-2). Derived from m d'' + c d' + k d = 0; checked to 1e-12 against Runge-Kutta in tests/physics. */
#include "check.h"
#include "floewear/realisation.h"

typedef struct outcome {
    double position, speed, impulse, peak; /* relative errors, position over v / w */
} outcome;

static outcome head_on(double accuracy, double D, double h, double v, double wt)
{
    fw_floe  f = {.x = -(3.7 + D / 2 + 0.37), .diameter = D, .thickness = h, .vx = v};
    double   m = 900 * 3.14159265358979323846 * D * D / 4 * h, w = sqrt(2e6 / m), after = wt / w;
    fw_scene s = {.speed = v, .temperature = -10, .duration = 0.37 / v + after, .n_floes = 1, .floes = &f};
    fw_model_defaults(&s.model);
    s.model.accuracy = accuracy;
    s.model.effects &= ~(uint32_t)FW_EFFECT_FORM_DRAG;
    fw_scene_result r;
    fw_msg          msg = {""};
    if (fw_scene_run(&s, NULL, NULL, &r, &msg) != FW_OK) fail_msg("%s", msg.text);
    double t2 = fmin(wt, 2), d, u, J;
    d = v * t2 / w * exp(-t2), u = v * exp(-t2) * (1 - t2); /* u: closing rate */
    if (wt > 2) d += u * (wt - 2) / w;
    J = m * (v - u);
    outcome o = {(r.floes[0].x + 3.7 + D / 2 - d) / (v / w), (r.floes[0].vx - u) / v, r.record.normal_impulse / J - 1,
                 r.record.peak_force / (2 * m * w * v) - 1};
    assert_true(r.floes[0].y == 0 && r.floes[0].spin == 0);
    fw_scene_result_free(&r);
    return o;
}

static void within(double accuracy, double tolerance)
{
    static const double D[] = {1.2, 2.5, 5, 12.56}, H[] = {0.3, 0.5, 1, 1.3}, V[] = {0.1, 2}, WT[] = {0.5, 1.5, 3, 10};
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 2; k++)
            for (size_t q = 0; q < 4; q++) {
                outcome o = head_on(accuracy, D[i], H[i], V[k], WT[q]);
                CHECK_NEAR(o.position, 0, tolerance);
                CHECK_NEAR(o.speed, 0, tolerance);
                CHECK_NEAR(o.impulse, 0, tolerance);
                CHECK_NEAR(o.peak, 0, tolerance);
            }
}

static void at_10(void **state)
{
    (void)state;
    within(0.1, 0.1);
}
static void at_1(void **state)
{
    (void)state;
    within(0.01, 0.02); /* the motion is not promised, it follows */
}
static void at_01(void **state)
{
    (void)state;
    within(0.001, 0.001);
}
static void at_finest(void **state)
{
    (void)state;
    within(0.0001, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(at_10), cmocka_unit_test(at_1), cmocka_unit_test(at_01),
                                       cmocka_unit_test(at_finest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
