/* Closed forms of the effects against the integrals, potentials and balances that they stand for. */
#include <complex.h>
#include <math.h>

#include "check.h"
#include "effects/added_mass.h"
#include "effects/deflected_flow.h"
#include "effects/skin_drag.h"
#include "effects/wind.h"

#define PI 3.14159265358979323846

/* ---- added mass ------------------------------------------------------------------------------------------------- */

/* Lamb, art. 114, for an ellipsoid of half-axes R, R, c that moves along R: a0 = R^2 c int_0^inf ds / ((R^2 + s) D), D = (R^2 + s) sqrt(c^2 + s),
 * C = a0 / (2 - a0). With R = 1 and sqrt(c^2 + s) = c + tan x it is a0 = 2 c int cos^2 x / (1 + 2 c sin x cos x)^2 dx, smooth on [0, pi/2]:
 * Simpson's rule. */
static double integrand(double x, double c)
{
    double d = 1 + 2 * c * sin(x) * cos(x);
    return 2 * c * cos(x) * cos(x) / (d * d);
}

static double added_mass_by_quadrature(double c)
{
    enum { N = 20000 };
    double h = PI / 2 / N, sum = integrand(0, c) + integrand(PI / 2, c);
    for (int i = 1; i < N; i++) sum += (i % 2 ? 4 : 2) * integrand(i * h, c);
    double a0 = sum * h / 3;
    return a0 / (2 - a0);
}

static void added_mass(void **state)
{
    static const double shapes[] = {1e-3, 0.01, 0.1, 0.176, 0.439, 0.9, 0.99, 0.99996, 1, 1.00004, 1.01, 1.5, 4, 20};
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        CHECK_RELATIVE(fw_added_mass_share(2.5, 2.5 * shapes[i]), added_mass_by_quadrature(shapes[i]), 2e-9);
    double draft = 900.0 / 1025; /* of a thickness of 1 m */
    CHECK_RELATIVE(fw_added_mass_share(2.5, 0.5 * draft), 0.127, 0.004);
    CHECK_RELATIVE(fw_added_mass_share(2, 1 * draft), 0.280, 0.002); /* D = 4h */
    CHECK_RELATIVE(fw_added_mass_share(1, 1), 0.5, 1e-14);
    CHECK_RELATIVE(fw_added_mass_share(1, 1e-6), PI / 4 * 1e-6, 1e-5); /* a thin plate: a0 = pi c / 2 */
    CHECK_RELATIVE(fw_added_mass_share(1, 1e4), 1, 1e-6);              /* a cylinder across the flow */
}

/* ---- skin drag -------------------------------------------------------------------------------------------------- */

/* Stress rho Cs / 2 |q| q on the face, q = (V - w y, w x): force against the motion, torque against spin, over 1/2 rho Cs. Midpoints in radius and
 * angle. */
static void over_face(double radius, double speed, double spin, double *force, double *torque)
{
    enum { N_RADIUS = 400, N_ANGLE = 400 };
    *force = *torque = 0;
    for (int i = 0; i < N_RADIUS; i++)
        for (int k = 0; k < N_ANGLE; k++) {
            double r = radius * (i + 0.5) / N_RADIUS, a = 2 * PI * (k + 0.5) / N_ANGLE, x = r * cos(a), y = r * sin(a);
            double qx = speed - spin * y, qy = spin * x, dA = r * (radius / N_RADIUS) * (2 * PI / N_ANGLE), q = hypot(qx, qy);
            *force += q * qx * dA;
            *torque += q * (x * qy - y * qx) * dA;
        }
}

static void skin_torque(void **state)
{
    const double R = 2.5, rho = 1025, Cs = 0.0055, c = fw_skin_drag_coefficient(rho, Cs, R);
    double       worst = 0;
    (void)state;
    CHECK_RELATIVE(c, 0.5 * rho * Cs * PI * R * R, 1e-14);
    for (double ratio = 0.01; ratio < 200; ratio *= 1.2) { /* R w / V */
        double V = 0.7, w = ratio * V / R, force, torque;
        over_face(R, V, w, &force, &torque);
        double e = w * fw_skin_drag_torque_rate(c, R, V, w) / (0.5 * rho * Cs * torque) - 1;
        assert_true(e > -1e-4);
        worst = fmax(worst, e);
    }
    CHECK_RELATIVE(worst, 0.060, 0.02);
    CHECK_RELATIVE(fw_skin_drag_torque_rate(c, R, 0.7, 1e-9), 3.0 / 8 * PI * rho * Cs * pow(R, 4) * 0.7, 1e-12);
    CHECK_RELATIVE(0.3 * fw_skin_drag_torque_rate(c, R, 0, 0.3), PI / 5 * rho * Cs * pow(R, 5) * 0.09, 1e-12);
    CHECK_RELATIVE(fw_skin_drag_torque_rate(c, R, 0.7, -0.4), fw_skin_drag_torque_rate(c, R, 0.7, 0.4), 1e-15); /* either way round */
}

/* What is left out of the force, as the header says. */
static void spin_adds_to_the_force(void **state)
{
    static const double rows[][2] = {{0.1, 0.004}, {0.36, 0.05}, {1, 0.36}};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        double force, torque;
        over_face(1, 1, rows[i][0], &force, &torque);
        CHECK_RELATIVE(force / PI - 1, rows[i][1], 0.08);
    }
}

/* ---- wind ------------------------------------------------------------------------------------------------------- */

/* The speed at which the air's force and the water's are equal: root of a (W - s)^2 = b s^2 by halving. */
static double balance(double air, double water, double W)
{
    double low = 0, high = W;
    for (int i = 0; i < 200; i++) {
        double s = 0.5 * (low + high);
        if (air * (W - s) * (W - s) > water * s * s)
            low = s;
        else
            high = s;
    }
    return low;
}

static void free_drift(void **state)
{
    const fw_wind w = {1.3, 0.0018, 1.1}, skin = {1.3, 0.0018, 0};
    const double  R = 2.5, h = 0.5, freeboard = 0.5 - 0.5 * 900 / 1025; /* Archimedes: what the water does not carry */
    (void)state;
    CHECK_RELATIVE(fw_wind_drag(&w, 900, 1025, R, h), 0.65 * (0.0018 * PI * R * R + 1.1 * 2 * R * freeboard), 1e-13);
    double form = 0.5 * 1025 * 10 * 2 * R * h, face = fw_skin_drag_coefficient(1025, 0.0055, R);
    double a = fw_wind_drag(&w, 900, 1025, R, h), b = fw_wind_drag(&skin, 900, 1025, R, h);
    CHECK_RELATIVE(fw_wind_free_drift(a, form, 10) / 10, 0.0043, 0.01);
    CHECK_RELATIVE(fw_wind_free_drift(b, face, 10) / 10, 0.020, 0.01);
    for (double air = 1e-3; air < 1e4; air *= 7)
        for (double water = 1e-2; water < 1e5; water *= 9) CHECK_RELATIVE(fw_wind_free_drift(air, water, 12), balance(air, water, 12), 1e-11);
    CHECK_RELATIVE(fw_wind_free_drift(a, 0, 12), 12, 1e-14);
    assert_true(fw_wind_free_drift(0, form, 12) == 0 && fw_wind_free_drift(0, 0, 12) == 0);
    assert_true(fw_wind_drag(&skin, 1030, 1025, R, h) == b); /* ice that sinks has no freeboard, and no less than none */
}

/* ---- deflected flow --------------------------------------------------------------------------------------------- */

/* Complex potential of a stream along e^(i a) round a circle, U (z e^(-ia) + Rs^2 e^(ia) / z): its derivative is vx - i vy. */
static double complex potential_flow(double Rs, double U, double a, double complex z)
{
    return conj(U * (cexp(-I * a) - Rs * Rs * cexp(I * a) / (z * z)));
}

static void upstream_is_potential_flow(void **state)
{
    const double Rs = 3.7, U = 1.7;
    (void)state;
    for (double a = -3; a < 3.2; a += 0.37)
        for (double r = Rs; r < 40; r *= 1.3)
            for (double p = PI / 2; p <= 1.501 * PI; p += PI / 24) { /* the half that faces the current */
                double complex z = r * cexp(I * (a + p)), wanted = potential_flow(Rs, U, a, z);
                double         vx, vy;
                fw_deflected_flow(Rs, U * cos(a), U * sin(a), creal(z), cimag(z), &vx, &vy);
                assert_true(cabs(vx + I * vy - wanted) < 1e-12 * U);
            }
}

/* Behind the axis the part along the current is the potential flow's, and there is none across. */
static void no_cross_flow_behind(void **state)
{
    const double Rs = 3.7, U = 1.7;
    (void)state;
    for (double a = -3; a < 3.2; a += 0.37)
        for (double r = Rs; r < 40; r *= 1.3)
            for (double p = -0.49 * PI; p < 0.5 * PI; p += PI / 24) {
                double complex z = r * cexp(I * (a + p)), wanted = potential_flow(Rs, U, a, z) * cexp(-I * a);
                double         vx, vy;
                fw_deflected_flow(Rs, U * cos(a), U * sin(a), creal(z), cimag(z), &vx, &vy);
                double complex got = (vx + I * vy) * cexp(-I * a);
                assert_true(fabs(creal(got) - creal(wanted)) < 1e-12 * U && fabs(cimag(got)) < 1e-12 * U);
            }
}

/* At the centre of a floe that touches, on every bearing of the half that faces the current and for any direction of it. */
static void factors_of_touching_floes(void **state)
{
    static const double rows[][3] = {{2.5, 0.441, 1.559}, {5, 0.644, 1.356}, {10, 0.819, 1.181}};
    const double        Rs = 3.7;
    (void)state;
    for (size_t i = 0; i < 3; i++)
        for (double a = 0; a < 2 * PI; a += 0.71)
            for (double p = 0.51 * PI; p < 1.5 * PI; p += 0.05) {
                double r = Rs + rows[i][0] / 2, nx = cos(a + p), ny = sin(a + p), ux = 2 * cos(a), uy = 2 * sin(a), vx, vy;
                fw_deflected_flow(Rs, ux, uy, r * nx, r * ny, &vx, &vy);
                double normal = ux * nx + uy * ny, along = uy * nx - ux * ny;
                assert_true(fabs((vx * nx + vy * ny) - rows[i][1] * normal) < 6e-4 * 2);
                assert_true(fabs((vy * nx - vx * ny) - rows[i][2] * along) < 6e-4 * 2);
            }
}

static void flow_at_odd_places(void **state)
{
    double vx, vy, wx, wy;
    (void)state;
    fw_deflected_flow(3.7, 2, 0, -3.7, 0, &vx, &vy); /* where it meets the wall */
    assert_true(fabs(vx) < 1e-14 && fabs(vy) < 1e-14);
    fw_deflected_flow(3.7, 0, 2, -3.7, 0, &vx, &vy); /* beside it: twice the flow */
    assert_true(fabs(vx) < 1e-14 && fabs(vy - 4) < 1e-14);
    fw_deflected_flow(3.7, 2, 0, -1e6, 1e6, &vx, &vy);
    assert_true(fabs(vx - 2) < 1e-10 && fabs(vy) < 1e-10);
    fw_deflected_flow(3.7, 0, 0, -5, 1, &vx, &vy); /* slack water */
    assert_true(vx == 0 && vy == 0);
    fw_deflected_flow(3.7, 2, 0, -3.7 * 0.6, 3.7 * 0.8, &vx, &vy);
    fw_deflected_flow(3.7, 2, 0, -0.6, 0.8, &wx, &wy); /* inside: as on the rim */
    assert_true(fabs(vx - wx) < 1e-14 && fabs(vy - wy) < 1e-14);
    fw_deflected_flow(3.7, 2, 0, 0, 0, &vx, &vy);
    assert_true(isfinite(vx) && isfinite(vy));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(added_mass),
        cmocka_unit_test(skin_torque),
        cmocka_unit_test(spin_adds_to_the_force),
        cmocka_unit_test(free_drift),
        cmocka_unit_test(upstream_is_potential_flow),
        cmocka_unit_test(no_cross_flow_behind),
        cmocka_unit_test(factors_of_touching_floes),
        cmocka_unit_test(flow_at_odd_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
