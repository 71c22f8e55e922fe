/* The fixed-step schemes: their orders where the motion is smooth (closed forms of free flight and of a head-on contact), first
 * order where a touch lies inside a step, and the reference solution of one hit as the step goes to zero. */
#include <string.h>

#include "check.h"
#include "kernel/plain.h"
#include "physics/contact.h"
#include "physics/drag.h"

#define PI 3.14159265358979323846

/* Case 2, offset 3 m of tests/reference/single_floe.csv: D 5 m, h 0.5 m, 2 m/s; depth along the contact [mm], path [m], J_N [N s]. */
static const double D = 5, H = 0.5, OFFSET = 3, DEPTH = 7.321553761161649e-07, PATH = 0.19153766111867288,
                    IMPULSE = 97031.15251102486;

static fw_setup setup(void)
{
    return (fw_setup){.structure_radius = 3.7,
                      .contact = {2e6, 1, 0.1, 1},
                      .floe_contact = {2e6, 1, 0.1, 1},
                      .has_floe_contact = true,
                      .has_drag = true,
                      .has_rotation = true,
                      .ice_density = 900,
                      .drag_per_area = 0.5 * 1025 * 10,
                      .velocity_scale = 2,
                      .skin = 2,
                      .half_width = INFINITY,
                      .downstream = INFINITY,
                      .max_evaluations = INFINITY};
}

typedef struct outcome {
    fw_body floe;
    double  depth, path, impulse, hits, conservation, evaluations;
} outcome;

static double mass(void) { return 900 * PI * D * D / 4 * H; }

/* One floe of D and H from a given state for a while. */
static outcome run(fw_setup s, fw_scheme scheme, fw_wear_rule rule, double dt, fw_body b, double duration)
{
    const fw_abrasion_law law = {"bekker2011", 0.116, 1.121, true};
    fw_numerics           n = {.scheme = scheme, .wear_rule = rule, .step = dt};
    fw_plain             *p;
    fw_world             *w;
    fw_wear               wear;
    fw_msg                m = {""};
    b.radius = D / 2, b.thickness = H, b.inv_mass = 1 / mass(), b.inv_inertia = 8 / (mass() * D * D);
    b.drag = s.drag_per_area * D * H;
    assert_int_equal(fw_wear_init(&wear, s.structure_radius, 360, 1, &law, &m), FW_OK);
    assert_int_equal(fw_world_create(&w, s.structure_radius, &m), FW_OK);
    assert_int_equal(fw_plain_create(&p, &s, &n, -60, &m), FW_OK);
    assert_int_equal(fw_world_add_body(w, &b, &m), FW_OK);
    w->bodies[0].is_touched = true;
    wear.rule = rule;
    wear.is_open = true;
    while (w->t < duration)
        if (fw_plain_step(p, w, &wear, duration, &m) != FW_OK) fail_msg("%s", m.text);
    fw_wear_finish(&wear);
    /* rate of eq. (1) at -10 degC; Pa^m m -> MPa^m km */
    double  edge = pow(1e-6, 1.121) * 1e-3 * 0.116 * pow(10, -1.121);
    outcome o = {.floe = w->bodies[0],
                 .depth = wear.sums[0].along * edge,
                 .path = wear.sums[0].path,
                 .impulse = w->ledger.normal_impulse,
                 .hits = w->ledger.hits,
                 .conservation = fw_wear_conservation(&wear),
                 .evaluations = w->ledger.force_evaluations};
    fw_plain_destroy(p);
    fw_world_destroy(w);
    fw_wear_free(&wear);
    return o;
}

/* Slopes between a step and half of it: the order that is promised, to a few tenths. */
static void expect_order(const char *what, double coarse, double fine, double order)
{
    double seen = log2(coarse / fine);
    print_message("%s: errors %.3g, %.3g, order %.2f\n", what, coarse, fine, seen);
    assert_true(seen > order - 0.25 && seen < order + 0.6);
}

static const struct {
    const char *name;
    fw_scheme   scheme;
    double      order;
} SCHEMES[] = {{"euler", FW_SCHEME_EULER, 1}, {"verlet", FW_SCHEME_VERLET, 2}, {"rk4", FW_SCHEME_RK4, 4}};

/* A floe at rest in a current of 2 m/s, far from everything: r = r0 / (1 + K r0 t). */
static void free_flight(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2};
    double       K = s.drag_per_area * D * H / mass(), t = 0.8;
    fw_drag_flow exact = fw_drag_free(K, 2, t);
    for (size_t k = 0; k < 3; k++) {
        double error[2];
        for (size_t i = 0; i < 2; i++) {
            fw_body b = {.x = -30, .y = 40};
            outcome o = run(s, SCHEMES[k].scheme, FW_WEAR_HERMITE, i ? 0.02 : 0.04, b, t);
            error[i] = fabs(o.floe.x - (-30 + 2 * t - exact.distance)) + t * fabs(o.floe.vx - (2 - exact.speed));
        }
        expect_order(SCHEMES[k].name, error[0], error[1], SCHEMES[k].order);
    }
}

/* Head-on without drag and friction, started shortly after the touch: d = v t exp(-wt). */
static void head_on(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.has_drag = false, s.drag_per_area = 0, s.contact.friction = 0;
    double w = sqrt(2e6 / mass()), v = 2, t0 = 0.1 / w, t1 = 1.5 / w;
    double d0 = fw_contact_critical_depth(w, v, t0), d1 = fw_contact_critical_depth(w, v, t1);
    for (size_t k = 0; k < 3; k++) {
        double error[2];
        for (size_t i = 0; i < 2; i++) {
            fw_body b = {.x = -(3.7 + D / 2 - d0), .vx = v * exp(-0.1) * (1 - 0.1)};
            outcome o = run(s, SCHEMES[k].scheme, FW_WEAR_HERMITE, (t1 - t0) / (i ? 40 : 20), b, t1 - t0);
            error[i] = fabs(3.7 + D / 2 + o.floe.x - d1) / d1;
        }
        expect_order(SCHEMES[k].name, error[0], error[1], SCHEMES[k].order);
        assert_true(error[1] < 0.1);
    }
}

static outcome hit(fw_scheme scheme, fw_wear_rule rule, double dt)
{
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2};
    double  reach = 3.7 + D / 2;
    fw_body b = {.x = -(sqrt(reach * reach - OFFSET * OFFSET) + 0.3017), .y = OFFSET, .vx = 2};
    return run(s, scheme, rule, dt, b, 5.3);
}

/* The touch lies anywhere in a step, so errors are not monotone; they stay below a bound that goes with the step. */
static void reference_hit(void **state)
{
    (void)state;
    for (size_t k = 0; k < 3; k++)
        for (double dt = 2e-3; dt > 0.2e-3; dt /= 3) {
            outcome o = hit(SCHEMES[k].scheme, FW_WEAR_HERMITE, dt);
            print_message("%s %.3g ms: depth %+.2e, path %+.2e, impulse %+.2e, %.0f evaluations\n", SCHEMES[k].name,
                          1e3 * dt, o.depth / DEPTH - 1, o.path / PATH - 1, o.impulse / IMPULSE - 1, o.evaluations);
            CHECK_RELATIVE(o.depth, DEPTH, 20 * dt);
            CHECK_RELATIVE(o.path, PATH, 20 * dt);
            CHECK_RELATIVE(o.impulse, IMPULSE, 5 * dt);
            assert_true(o.hits == 1 && o.conservation < 1e-10);
        }
}

/* The singular start of the pressure: the naive sum is far off at a step whose trajectory is good to a per cent. */
static void naive_rule(void **state)
{
    (void)state;
    outcome good = hit(FW_SCHEME_EULER, FW_WEAR_HERMITE, 1e-3), naive = hit(FW_SCHEME_EULER, FW_WEAR_NAIVE, 1e-3);
    CHECK_RELATIVE(naive.floe.x, good.floe.x, 1e-14); /* the rule never changes the motion */
    assert_true(naive.floe.spin == good.floe.spin && naive.hits == 1);
    assert_true(naive.evaluations == good.evaluations);
    double error = fabs(naive.depth / DEPTH - 1);
    print_message("naive sum at 1 ms: %.3g of the depth\n", error);
    assert_true(error > 0.05 && error < 0.5);
}

static void refusals(void **state)
{
    (void)state;
    fw_setup    s = setup();
    fw_plain   *p = NULL;
    fw_msg      m = {""};
    fw_numerics n = {.scheme = FW_SCHEME_VERLET, .step = 0};
    assert_int_equal(fw_plain_create(&p, &s, &n, -60, &m), FW_E_ARG);
    n.step = 1e-3, n.scheme = FW_SCHEME_EVENTS;
    assert_int_equal(fw_plain_create(&p, &s, &n, -60, &m), FW_E_ARG);
    n.scheme = FW_SCHEME_RK4;
    assert_int_equal(fw_plain_create(&p, &s, &n, 0, &m), FW_E_ARG);
    assert_non_null(strstr(m.text, "inlet"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(free_flight), cmocka_unit_test(head_on),
                                       cmocka_unit_test(reference_hit), cmocka_unit_test(naive_rule),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
