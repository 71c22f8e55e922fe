/* Laws of motion on small worlds: momentum, energy, angular momentum, mirror images, touched floes only. */
#include <stdbool.h>
#include <string.h>

#include "kernel/rig.h"

static fw_setup setup(void)
{
    return (fw_setup){.structure_radius = 3.7,
                      .flow = {0},
                      .contact = {2e6, 1, 0.1, 1},
                      .floe_contact = {2e6, 1, 0.1, 1},
                      .has_floe_contact = true,
                      .has_rotation = true,
                      .ice_density = 900,
                      .method = FW_METHOD_TRBDF2,
                      .tolerance = 1e-5, .energy_tolerance = 0.01,
                      .velocity_scale = 2,
                      .first_step = 0.05,
                      .growth = 3,
                      .max_step = 2,
                      .wear_tolerance = 1e-4,
                      .solver_share = 1e-3,
                      .landing = 1e-4,
                      .horizon = 2,
                      .margin = 0.3,
                      .half_width = 50,
                      .downstream = INFINITY,
                      .max_evaluations = INFINITY};
}

static void put(rig *r, double x, double y, double D, double h, double vx, double vy, double spin, double drag)
{
    double  m = 900 * PI * D * D / 4 * h;
    fw_body b = {.x = x,
                 .y = y,
                 .vx = vx,
                 .vy = vy,
                 .spin = spin,
                 .radius = D / 2,
                 .thickness = h,
                 .inv_mass = 1 / m,
                 .inv_inertia = 8 / (m * D * D),
                 .drag = drag * D * h,
                 .name = r->w->n_bodies};
    put_body(r, &b);
}

/* A cluster of unequal spinning floes far from the structure, no drag: momentum and angular momentum stay, energy falls. */
static void free_cluster(void **state)
{
    (void)state;
    fw_setup s = setup();
    rig      r = open_rig(&s);
    put(&r, -40.0, 0.0, 5.0, 0.5, 1.0, 0.1, 2.0, 0);
    put(&r, -34.0, 0.7, 2.5, 0.5, -1.0, 0.0, -1.0, 0);
    put(&r, -37.0, 6.0, 4.0, 0.9, 0.1, -0.9, 0.0, 0);
    put(&r, -37.5, -5.0, 1.2, 0.3, 0.0, 1.5, 4.0, 0);
    fw_world_open_ledger(r.w);
    double p0[3] = {0}, p1[3] = {0}, e0 = fw_world_energy(r.w), size = 0, last = e0;
    for (int pass = 0; pass < 2; pass++) {
        double *p = pass ? p1 : p0;
        for (size_t i = 0; i < r.w->n_bodies; i++) {
            const fw_body *b = &r.w->bodies[i];
            double         m = 1 / b->inv_mass;
            p[0] += m * b->vx, p[1] += m * b->vy, p[2] += m * (b->x * b->vy - b->y * b->vx) + b->spin / b->inv_inertia;
            size += m * hypot(b->vx, b->vy);
        }
        if (pass) break;
        for (double t = 0.05; t < 6; t += 0.05) { /* no energy from nothing, at any instant */
            run(&r, t);
            double e = fw_world_energy(r.w);
            assert_true(e <= last * (1 + 1e-5));
            last = e;
        }
    }
    assert_true(r.w->ledger.touches >= 3);
    CHECK_NEAR(p1[0], p0[0], 1e-12 * size);
    CHECK_NEAR(p1[1], p0[1], 1e-12 * size);
    CHECK_NEAR(p1[2], p0[2],
               1e-5 * size * 40); /* frozen normals of a stage: to the integrator's order, not to rounding */
    assert_true(last < 0.9 * e0);
    assert_true(fw_ledger_energy_relative(&r.w->ledger) < 1e-12);
    assert_true(fw_ledger_momentum_relative(&r.w->ledger) < 1e-12);
    assert_true(fw_ledger_energy_truncation(&r.w->ledger, e0, last) < 2e-3);
    close_rig(&r);
}

/* A scene and its mirror image in the x axis: wear on arc k is wear on arc n - 1 - k. */
static void mirror_images(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2};
    rig r[2];
    for (int i = 0; i < 2; i++) {
        double f = i ? -1 : 1;
        r[i] = open_rig(&s);
        put(&r[i], -6.6, f * 2.7, 5, 0.5, 2, 0, f * 0.3, 5125);
        put(&r[i], -6.6, f * -2.6, 5, 0.5, 2, 0, 0, 5125);
        put(&r[i], -11.8, f * 0.2, 5, 1, 2, 0, 0, 5125);
        run(&r[i], 6);
        fw_wear_finish(&r[i].wear);
    }
    for (size_t i = 0; i < 3; i++) {
        CHECK_NEAR(r[1].w->bodies[i].x, r[0].w->bodies[i].x, 1e-9);
        CHECK_NEAR(r[1].w->bodies[i].y, -r[0].w->bodies[i].y, 1e-9);
        CHECK_NEAR(r[1].w->bodies[i].spin, -r[0].w->bodies[i].spin, 1e-8);
    }
    double total = 0;
    for (size_t k = 0; k < 360; k++) total += r[0].wear.load[0][0][k];
    for (size_t k = 0; k < 360; k++) CHECK_NEAR(r[1].wear.load[0][0][359 - k], r[0].wear.load[0][0][k], 1e-7 * total);
    assert_true(fw_wear_conservation(&r[0].wear) < 1e-12);
    close_rig(&r[0]);
    close_rig(&r[1]);
}

/* Two mirror floes hit at the same instant, and stay mirror images; a head-on floe stays on the axis. */
static void symmetric_at_once(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2};
    rig r = open_rig(&s);
    put(&r, -7, 2.5000001, 5, 0.5, 2, 0, 0, 5125);
    put(&r, -7, -2.5000001, 5, 0.5, 2, 0, 0, 5125);
    run(&r, 5);
    CHECK_NEAR(r.w->bodies[0].x, r.w->bodies[1].x, 1e-9);
    CHECK_NEAR(r.w->bodies[0].y, -r.w->bodies[1].y, 1e-9);
    CHECK_NEAR(r.w->bodies[0].spin, -r.w->bodies[1].spin, 1e-8);
    close_rig(&r);
    r = open_rig(&s);
    put(&r, -7, 0, 5, 0.5, 2, 0, 0, 5125);
    run(&r, 20);
    assert_true(r.w->bodies[0].y == 0 && r.w->bodies[0].spin == 0);
    CHECK_NEAR(r.wear.sums[0].path, 0, 0);
    close_rig(&r);
}

/* Untouched ice: only floes that somebody reaches are woken; the others keep their row. */
static void touches_only(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2}, s.drag_per_area = 5125, s.has_drag = true;
    rig    r = open_rig(&s);
    double x[3] = {-8, -8, -30}, y[3] = {0.5, 30, 0.4}, R[3] = {2, 2, 2}, h[3] = {0.5, 0.5, 0.5};
    assert_int_equal(fw_world_add_block(r.w, 3, x, y, R, h, 100, NULL), FW_OK);
    run(&r, 2);
    assert_int_equal(r.w->n_bodies, 1);
    assert_int_equal(r.w->bodies[0].name, 100);
    assert_true(r.w->n_touched == 1);
    assert_int_equal(r.w->blocks[0].n_left, 2);
    CHECK_NEAR(r.w->drift_x, 4, 1e-12);
    run(&r, 30);
    assert_int_equal(r.w->blocks[0].n_left, 1); /* the one at y = 30 passed by */
    close_rig(&r);
}

/* When candidates are listed is bookkeeping: ice drifts onto the structure the same way whether they are listed every half metre of the
 * current's way or every sixteen, and whatever the margin; and nobody is met too late. */
static void listing_moves_nothing(void **state)
{
    (void)state;
    double x[12], y[12], R[12], h[12];
    for (int i = 0; i < 12; i++) x[i] = -8 - 5.5 * (i / 3), y[i] = -5.2 + 5.1 * (i % 3) + 0.3 * (i / 3), R[i] = 2.4 - 0.1 * (i % 5), h[i] = 0.6;
    fw_body end[3][12];
    for (int k = 0; k < 3; k++) {
        fw_setup s = setup();
        s.flow = (fw_flow){.ux = 2, .ice_x = 2}, s.drag_per_area = 5125, s.has_drag = true;
        s.horizon = (const double[]){0.5, 4, 16}[k], s.margin = (const double[]){0.02, 0.3, 1}[k];
        rig r = open_rig(&s);
        assert_int_equal(fw_world_add_block(r.w, 12, x, y, R, h, 0, NULL), FW_OK);
        run(&r, 5);
        assert_true(r.w->ledger.late_touches == 0 && r.w->ledger.touches > 6);
        assert_true(r.w->n_bodies <= 12 && r.w->n_bodies >= 6);
        memset(end[k], 0, sizeof end[k]);
        for (size_t i = 0; i < r.w->n_bodies; i++)
            if (r.w->bodies[i].is_touched) end[k][r.w->bodies[i].name] = r.w->bodies[i];
        close_rig(&r);
    }
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 12; i++) {
            CHECK_NEAR(end[k][i].x, end[0][i].x, 1e-6);
            CHECK_NEAR(end[k][i].y, end[0][i].y, 1e-6);
            CHECK_NEAR(end[k][i].spin, end[0][i].spin, 1e-5);
        }
}

static void limits_and_failures(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.flow = (fw_flow){.ux = 2, .ice_x = 2}, s.max_evaluations = 50;
    rig r = open_rig(&s);
    put(&r, -7, 0.1, 5, 0.5, 2, 0, 0, 5125);
    fw_msg    m = {""};
    fw_status st = FW_OK;
    while (st == FW_OK && r.w->t < 60) st = fw_kernel_step(r.k, r.w, &r.wear, 60, &m);
    assert_int_equal(st, FW_E_LIMIT);
    assert_non_null(strstr(m.text, "force evaluations"));
    close_rig(&r);
    /* a floe thrown at the structure with far more energy than the spring can hold: named, with floe and time */
    s = setup(), s.contact.stiffness = 1e3, s.velocity_scale = 50;
    r = open_rig(&s);
    put(&r, -12, 0.1, 5, 3, 50, 0, 0, 0);
    st = FW_OK;
    while (st == FW_OK && r.w->t < 5) st = fw_kernel_step(r.k, r.w, &r.wear, 5, &m);
    assert_int_equal(st, FW_E_NUMERIC);
    assert_non_null(strstr(m.text, "inside the structure"));
    close_rig(&r);
}

/* Floes that were never seated are no part of what forgetting closes up: who stays flies by no closed form in the wind. */
static void forgotten_at_the_first_listing(void **state)
{
    (void)state;
    fw_setup s = setup();
    s.has_wind = s.has_body_forces = true, s.flow.wind_x = 20, s.downstream = 50, s.velocity_scale = 0.1;
    rig r = open_rig(&s);
    put(&r, 60, 0, 5, 0.9, 0, 0, 0, 0);
    put(&r, -20, 0, 5, 0.9, 0, 0, 0, 0);
    r.w->bodies[1].air = 0.5;
    while (r.w->t < 10) assert_int_equal(fw_kernel_step(r.k, r.w, &r.wear, 10, NULL), FW_OK);
    assert_int_equal(r.w->n_bodies, 1);
    CHECK_RELATIVE(r.w->bodies[0].vx, 0.5 * 400 * 10 * r.w->bodies[0].inv_mass, 0.02); /* it hardly moves yet */
    close_rig(&r);
}

/* Ice that is awake upstream of the structure is asked for across the whole strip, whichever way that runs. */
static void asks_for_all_that_is_awake(void **state)
{
    (void)state;
    for (int k = 0; k < 16; k++) {
        fw_setup s = setup();
        double   cx = cos(k * PI / 8), cy = sin(k * PI / 8);
        s.flow = (fw_flow){.ux = 2 * cx, .uy = 2 * cy, .ice_x = 2 * cx, .ice_y = 2 * cy}, s.wake_upstream = 100;
        rig    r = open_rig(&s);
        fw_box box = fw_kernel_needs_ice(r.k, r.w);
        for (double along = -100; along <= 0; along += 10)
            for (double across = -50; across <= 50; across += 10) {
                double x = cx * along - cy * across, y = cy * along + cx * across;
                assert_true(x >= box.x0 && x <= box.x1 && y >= box.y0 && y <= box.y1);
            }
        close_rig(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(free_cluster), cmocka_unit_test(mirror_images),
                                       cmocka_unit_test(symmetric_at_once), cmocka_unit_test(touches_only), cmocka_unit_test(asks_for_all_that_is_awake), cmocka_unit_test(forgotten_at_the_first_listing),
                                        cmocka_unit_test(listing_moves_nothing),
                                       cmocka_unit_test(limits_and_failures)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
