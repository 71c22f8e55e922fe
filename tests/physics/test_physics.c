#include <string.h>

#include "check.h"
#include "physics/abrasion.h"
#include "physics/contact.h"
#include "physics/crush.h"
#include "physics/drag.h"
#include "physics/unbreakable.h"

static void contact_constants(void **state)
{
    (void)state;
    /* m = 4 kg, k = 9 N/m: critical c = 2 sqrt(k m) = 12, w = 1.5 by hand */
    fw_contact_law       law = {9, 1, 0.1, 0.5};
    fw_contact_constants c = fw_contact_law_apply(&law, 4);
    CHECK_NEAR(c.c, 12, 1e-14);
    CHECK_NEAR(c.ct, 6, 1e-14);
    CHECK_NEAR(c.omega, 1.5, 1e-15);
    assert_true(fw_contact_normal(&c, 0.1, -1) == 0); /* never tension */
    CHECK_NEAR(fw_contact_normal(&c, 0.1, 0.5), 6.9, 1e-14);
    CHECK_NEAR(fw_contact_friction(&c, 10, 100), -1, 0);
    CHECK_NEAR(fw_contact_friction(&c, 10, -100), 1, 0);
    CHECK_NEAR(fw_contact_friction(&c, 10, 0.01), -0.06, 1e-15);
}

/* Classical fourth-order Runge-Kutta of m d'' = -(k d + c d') against the closed form. */
static void critical_closed_form(void **state)
{
    (void)state;
    double w = 30, v = 2, m = 2200, d = 0, u = v, dt = 1e-5 / 3, t = 0;
    for (int i = 0; i < 12000; i++, t += dt) {
        double a1 = -w * w * d - 2 * w * u, d2 = d + dt / 2 * u, u2 = u + dt / 2 * a1;
        double a2 = -w * w * d2 - 2 * w * u2, d3 = d + dt / 2 * u2, u3 = u + dt / 2 * a2;
        double a3 = -w * w * d3 - 2 * w * u3, d4 = d + dt * u3, u4 = u + dt * a3, a4 = -w * w * d4 - 2 * w * u4;
        d += dt / 6 * (u + 2 * u2 + 2 * u3 + u4), u += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    CHECK_NEAR(fw_contact_critical_depth(w, v, t), d, 1e-12);
    CHECK_RELATIVE(fw_contact_critical_force(m, w, v, t), m * (w * w * d + 2 * w * u), 1e-9);
    CHECK_RELATIVE(fw_contact_critical_force(m, w, v, 0), 2 * m * w * v, 1e-15); /* the jump at touch */
    assert_true(fw_contact_critical_force(m, w, v, 2 / w + 1e-9) == 0);
    CHECK_NEAR(fw_contact_critical_depth(w, v, 4 / w), 0, 1e-15); /* overlap closes at wt = 4 */
}

/* The exact flow solves r' = -K r^2: checked as a law (semigroup) and by its limits. */
static void drag_flow(void **state)
{
    (void)state;
    for (double K = 1e-9; K < 100; K *= 7) {
        fw_drag_flow whole = fw_drag_free(K, 1.7, 2.5), first = fw_drag_free(K, 1.7, 1.1),
                     rest = fw_drag_free(K, first.speed, 1.4);
        CHECK_RELATIVE(rest.speed, whole.speed, 1e-14);
        CHECK_RELATIVE(first.distance + rest.distance, whole.distance, 1e-13);
        /* dr/dt = -K r^2 by a central difference */
        double slope = (fw_drag_free(K, 1.7, 1e-4).speed - fw_drag_free(K, 1.7, 0).speed) / 1e-4;
        CHECK_RELATIVE(slope, -K * 1.7 * fw_drag_free(K, 1.7, 1e-4).speed, 1e-6 + 1e-12 / K);
    }
    CHECK_NEAR(fw_drag_free(0, 2, 3).distance, 6, 1e-15);
    CHECK_NEAR(fw_drag_free(5, 0, 3).distance, 0, 0);
    CHECK_NEAR(fw_drag_coefficient(1025, 10, 2.5, 0.5), 0.5 * 1025 * 10 * 1.25, 1e-9);
}

static void unbreakable_floes(void **state)
{
    (void)state;
    CHECK_NEAR(fw_unbreakable_max_diameter(1.3), sqrt(158), 1e-12); /* sqrt(130 h - 11) by hand */
    assert_true(fw_unbreakable_max_diameter(0.08) == 0);
    assert_false(fw_unbreakable_class_exists(0.0854));
    assert_true(fw_unbreakable_class_exists(0.5));
    assert_false(fw_unbreakable_class_exists(8.05));
    assert_false(fw_unbreakable_class_exists(NAN));
}

static void abrasion_laws(void **state)
{
    (void)state;
    const fw_abrasion_law *b = fw_abrasion_find("bekker2011");
    assert_non_null(b);
    /* equation (1) of the source paper at sigma = 2 MPa, T = -10 degC, 3 km: 0.116 (10/2)^-1.121 x 3 mm */
    CHECK_RELATIVE(fw_abrasion_rate(b, -10) * pow(2, b->exponent) * 3, 0.116 * pow(5, -1.121) * 3, 1e-14);
    CHECK_RELATIVE(fw_abrasion_rate(b, -2) / fw_abrasion_rate(b, -10), pow(5, 1.121), 1e-13); /* x 6.1 in warmer ice */
    assert_null(fw_abrasion_find("bekker"));
    const fw_abrasion_entry *all;
    size_t                   n = fw_abrasion_list(&all);
    for (size_t i = 0; i < n; i++) assert_true(all[i].law.exponent > 0 && all[i].law.exponent < 2);
}

/* A head-on push against F = P0 (b h)^(1-q), b = 2 sqrt(2 R* d), the work of F summed over x = sqrt(d) by the midpoint rule until it has
 * taken m v^2 / 2; then the line with its damper from rest, by the midpoint method in time, until N = 0. */
static void one_push(double q, double *deepest, double *restitution)
{
    double m = 2209, v = 2, star = 0.934, h = 0.5, P0 = 1.1e6, d = 0, u = v, dt = 2e-7;
    fw_pressure_law p = {P0, q};
    double          g = 2 * sqrt(2 * star) * h;
    /* energy: m u^2 / 2 falls by int F, F = P0 (g sqrt d)^(1-q); midpoint in sqrt d, to rest */
    double E = 0.5 * m * v * v, x = 0, dx = 1e-6;
    while (E > 0) {
        double xm = x + 0.5 * dx, work = P0 * pow(fmax(0.01, g * xm), -q) * g * xm * 2 * xm * dx;
        if (work > E) dx *= E / work, work = E;
        E -= work, x += dx;
        if (dx < 1e-12) break;
    }
    *deepest = d = x * x;
    double F = P0 * pow(g * x, 1 - q), S = fw_crush_unloading(&p, exp(-2)) * F / d, c = 2 * sqrt(S * m), y = F / S;
    u = 0;
    for (double N = F; N > 0;) { /* y is what the line is pressed in by, u its rate */
        double a1 = -(S * y + c * u) / m, um = u + 0.5 * dt * a1, ym = y + 0.5 * dt * u, a2 = -(S * ym + c * um) / m;
        y += dt * um, u += dt * a2, N = S * y + c * u;
    }
    *restitution = -u / v;
}

static void crushing(void **state)
{
    (void)state;
    fw_pressure_law p = {1.1e6, 0}, area = {1.1e6, 0.3};
    CHECK_RELATIVE(fw_crush_force(&p, 0.5), 5.5e5, 1e-15);
    CHECK_RELATIVE(fw_crush_force(&area, 0.5), 1.1e6 * pow(0.5, 0.7), 1e-14);
    CHECK_RELATIVE(fw_crush_pressure(&area, 0.5) * 0.5, fw_crush_force(&area, 0.5), 1e-14);
    assert_true(fw_crush_force(&area, 0) == 0);
    /* the end of the line of D moves by 1 - 1/kappa of what D has gone past D0 */
    assert_true(fw_crush_kappa(5.5, FW_CRUSH_ELASTIC) == 1 && fw_crush_kappa(5.5, 0) == 1);
    for (double past = 1e-12; past < 1; past *= 10) {
        double D = FW_CRUSH_ELASTIC + past;
        CHECK_RELATIVE(D / fw_crush_kappa(5.5, D), D - (1 - 1 / 5.5) * past, 1e-12);
    }
    for (double q = 0; q < 0.7; q += 0.3) {
        double          D, e;
        fw_pressure_law law = {1.1e6, q};
        one_push(q, &D, &e);
        CHECK_RELATIVE(fw_crush_depth(&law, 2209, 2, 0.934, 0.5), D, 1e-6);
        CHECK_RELATIVE(e, exp(-2), q > 0 ? 3e-3 : 1e-4); /* the work below 0.01 m2 is not that of the power law */
        CHECK_RELATIVE(fw_crush_depth(&law, 2209 * 1e-12, 2, 0.934, 0.5), pow(2209e-12 * 4 / (8.0 / 3 * sqrt(2 * 0.934) * 1.1e6 * pow(0.01, -q) * 0.5), 2.0 / 3), 1e-12);
    }
    /* d_max = [m v^2 / ((8/3) sqrt(2R*) p h)]^(2/3), N_max = 2 p h sqrt(2R* d) by hand */
    double D = fw_crush_depth(&p, 2209, 2, 0.934, 0.5);
    CHECK_RELATIVE(D, pow(2209 * 4 / (8.0 / 3 * sqrt(2 * 0.934) * 1.1e6 * 0.5), 2.0 / 3), 1e-13);
    CHECK_RELATIVE(fw_crush_force(&p, fw_crush_chord(0.934, D) * 0.5), 2 * 1.1e6 * 0.5 * sqrt(2 * 0.934 * D), 1e-14);
}

/* k = 0.50 h p^(4/3) [2Rs/(R+Rs)]^(2/3) (pi rho v^2)^(-1/3), 0.50 standing for e^-2 (8/3)^(4/3); the source paper's four floes at p = 1.07 MPa and 2 m/s give
 * 1.6, 1.4, 2.8 and 2.2 MN/m, mean 2.0, which is the paper's stiffness. */
static void stiffness_from_pressure(void **state)
{
    (void)state;
    static const struct {
        double D, h, k;
    } FLOE[] = {{2.5, 0.5, 1.6e6}, {5, 0.5, 1.4e6}, {5, 1, 2.8e6}, {10, 1, 2.2e6}};
    fw_pressure_law p = {1.07e6, 0};
    double          pi = 3.14159265358979323846, Rs = 3.7, v = 2, mean = 0;
    for (size_t i = 0; i < 4; i++) {
        double R = 0.5 * FLOE[i].D, h = FLOE[i].h, m = 900 * pi * R * R * h, k = fw_crush_stiffness(&p, m, v, R * Rs / (R + Rs), h);
        CHECK_RELATIVE(k, exp(-2) * pow(8.0 / 3, 4.0 / 3) * h * pow(1.07e6, 4.0 / 3) * pow(2 * Rs / (R + Rs), 2.0 / 3) * pow(pi * 900 * v * v, -1.0 / 3), 1e-12);
        /* as deep as the push: v / (w exp 1) of the critically damped spring */
        CHECK_RELATIVE(v / (sqrt(k / m) * exp(1)), fw_crush_depth(&p, m, v, R * Rs / (R + Rs), h), 1e-13);
        CHECK_NEAR(k, FLOE[i].k, 0.06e6); /* two digits of k, three of p */
        mean += k / 4;
    }
    CHECK_NEAR(mean, 2.0e6, 0.05e6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(contact_constants), cmocka_unit_test(critical_closed_form),
                                       cmocka_unit_test(crushing), cmocka_unit_test(stiffness_from_pressure),
                                       cmocka_unit_test(drag_flow), cmocka_unit_test(unbreakable_floes),
                                       cmocka_unit_test(abrasion_laws)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
