/* Ice that crushes: what a rim remembers, what a flat does to a floe that comes back on it, and where the energy goes. */
#include <stdlib.h>
#include <string.h>

#include "kernel/crush_rim.h"
#include "kernel/rig.h"

static const double RS = 3.7, D = 2.5, H = 0.5, P = 1.1e6, V = 2;

static fw_setup setup(bool has_flat, double speed)
{
    fw_pressure_law p = {P, 0};
    return (fw_setup){.structure_radius = RS,
                      .flow = {.ux = speed, .ice_x = speed},
                      .contact = {2e6, 1, 0.1, 1},
                      .floe_contact = {2e6, 1, 0.1, 1},
                      .has_drag = true,
                      .has_rotation = true,
                      .ice_density = 900,
                      .is_crush = true,
                      .crush = {.law = p, .unloading = fw_crush_unloading(&p, exp(-2)), .has_flat = has_flat},
                      .crush_speed = V,
                      .crush_share = 0.1,
                      .method = FW_METHOD_ARK3,
                      .tolerance = 1e-5, .energy_tolerance = 0.01,
                      .velocity_scale = 2,
                      .first_step = 0.02,
                      .growth = 3,
                      .max_step = 2,
                      .wear_tolerance = 1e-6,
                      .solver_share = 1e-3,
                      .landing = 1e-6,
                      .horizon = 4,
                      .margin = 0.3,
                      .half_width = 50,
                      .downstream = INFINITY,
                      .max_evaluations = INFINITY};
}

/* A floe 0.3 m before the touch. */
static rig start(fw_setup s, double y, double drag)
{
    rig    r = open_rig(&s);
    double m = 900 * PI * D * D / 4 * H, reach = RS + D / 2;
    fw_body b = {.x = -sqrt(reach * reach - y * y) - 0.3, .y = y, .vx = V, .radius = D / 2, .thickness = H, .inv_mass = 1 / m, .inv_inertia = 8 / (m * D * D), .drag = drag * D * H};
    put_body(&r, &b);
    fw_world_open_ledger(r.w);
    return r;
}

/* The same floe, in no contact, on a way of its own. */
static void send(rig *r, double x, double y, double vx, double vy, double turned)
{
    fw_body *b = &r->w->bodies[0];
    fw_kernel_destroy(r->k);
    assert_int_equal(fw_kernel_create(&r->k, &r->s, NULL), FW_OK);
    b->x = x, b->y = y, b->vx = vx, b->vy = vy, b->spin = 0, b->angle += turned, b->t = r->w->t;
    fw_world_open_ledger(r->w);
}

static double energy_out(const fw_world *w) { return fw_ledger_energy_truncation(&w->ledger, w->energy_start, fw_world_energy(w)); }

/* --- memory ----------------------------------------------------------------------------------------------------------- */

/* A rim that was pressed in at several places: never deeper anywhere than the deepest imprint there, exactly that at the nodes' own and the last place, and
 * nowhere shallower by more than two imprints can hide between two nodes. */
static void rim_remembers(void **state)
{
    (void)state;
    enum { N = 200 };
    fw_rim *r = calloc(1, sizeof *r + N * sizeof r->node[0]);
    double  R = 1.25, star = R * RS / (R + RS), w = 2 * PI * R / N, slope;
    *r = (fw_rim){.radius = R, .reduced = star, .n = N, .width = w, .own = {.depth = -INFINITY}};
    for (size_t i = 0; i < N; i++) r->node[i].depth = -INFINITY;
    assert_true(fw_rim_deepest(r, 1.7, &slope) == FW_CRUSH_ELASTIC && slope == 0);
    /* the last one is narrower than two nodes are apart, the first lies across the seam, the third was there already, deeper */
    static const double AT[] = {6.27, 0.9, 0.93, 0.9, 1.05, -2.01 - 4 * PI}, DEPTH[] = {0.05, 0.03, 0.02, 0.01, 0.031, 1e-4};
    for (size_t n = 0; n < 6; n++) {
        fw_rim_press(r, (fw_imprint){DEPTH[n], AT[n]});
        CHECK_NEAR(fw_rim_deepest(r, AT[n], &slope), n == 2 ? 0.03 - 0.5 * pow(0.03 * R, 2) / star : n == 3 ? 0.03 : DEPTH[n], 1e-15);
        for (int k = 0; k < 5000; k++) {
            double place = 2 * PI * k / 5000 + 2 * PI * (k % 7 - 3), known = fw_rim_deepest(r, place, &slope), truth = FW_CRUSH_ELASTIC, fall = 0;
            for (size_t i = 0; i <= n; i++) {
                double s = R * remainder(place - AT[i], 2 * PI), d = DEPTH[i] - 0.5 * s * s / star;
                if (d > truth) truth = d, fall = -s / star;
            }
            CHECK_NEAR(known, truth, known < truth ? w * w / (2 * star) : 1e-14);
            if (n == 0) CHECK_NEAR(known, truth, 1e-14);
            if (n == 0) CHECK_NEAR(slope, fall, 1e-12);
        }
    }
    free(r);
}

/* D has no jumps, wherever nodes are: its slope bounds it. */
static void rim_has_no_jumps(void **state)
{
    (void)state;
    enum { N = 64 };
    fw_rim *r = calloc(1, sizeof *r + N * sizeof r->node[0]);
    double  R = 1.25, star = R * RS / (R + RS), slope;
    *r = (fw_rim){.radius = R, .reduced = star, .n = N, .width = 2 * PI * R / N, .own = {.depth = -INFINITY}};
    for (size_t i = 0; i < N; i++) r->node[i].depth = -INFINITY;
    for (int n = 0; n < 40; n++) fw_rim_press(r, (fw_imprint){0.001 + 0.04 * fabs(sin(7.1 * n)), 2.39996 * n}); /* as a sunflower has its seeds */
    double steepest = sqrt(2 * star * 0.041) / star, was = fw_rim_deepest(r, 0, &slope), step = 2 * PI / 100000;
    for (int k = 1; k <= 100000; k++) {
        double now = fw_rim_deepest(r, k * step, &slope);
        assert_true(fabs(now - was) <= 1.5 * (steepest + r->width / star) * R * step + 1e-15);
        was = now;
    }
    free(r);
}

/* --- energy ----------------------------------------------------------------------------------------------------------- */

/* Head-on, no drag. Of m v^2 / 2 the push puts e / (2 kappa) = e^-2 in store and crushes the rest; of what was in store the line gives e^-2 back. */
static void energy_of_a_push(void **state)
{
    (void)state;
    rig r = start(setup(true, 0), 0, 0);
    run(&r, 0.15 + 0.5);
    const fw_ledger *l = &r.w->ledger;
    double           all = 0.5 * V * V / r.w->bodies[0].inv_mass;
    CHECK_RELATIVE(l->crushed, all * (1 - exp(-2)), 2e-3); /* the exact lens is not quite the shallow one */
    CHECK_RELATIVE(l->dashpot + l->dropped, all * (exp(-2) - exp(-4)), 2e-2);
    assert_true(l->dashpot > 0 && l->rolling == 0 && l->turned == 0 && l->friction == 0);
    assert_true(energy_out(r.w) < 1e-4 && fw_ledger_energy_given(l) == 0);
    CHECK_RELATIVE(-r.w->bodies[0].vx / V, exp(-2), 2e-3);
    close_rig(&r);
}

/* Oblique: the flat's moment takes energy, always, and nothing is made. */
static void energy_of_a_slide(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        rig r = start(setup(flat, V), 1, 5125);
        for (double t = 0.2; t < 5; t += 0.1) {
            double was = r.w->ledger.rolling;
            run(&r, t);
            assert_true(r.w->ledger.rolling >= was - 1e-9);
        }
        assert_true(flat ? r.w->ledger.rolling > 1 : r.w->ledger.rolling == 0);
        assert_true(energy_out(r.w) < 1e-3 && fw_ledger_energy_given(&r.w->ledger) == 0);
        assert_true(fw_ledger_energy_relative(&r.w->ledger) < 1e-12 && fw_ledger_momentum_relative(&r.w->ledger) < 1e-12);
        close_rig(&r);
    }
}

/* --- the flat --------------------------------------------------------------------------------------------------------- */

/* Pressed by the current head-on it comes to rest on its flat where the line carries the drag, N = 1/2 rho Cf D h U^2. */
static void rests_on_its_flat(void **state)
{
    (void)state;
    rig r = start(setup(true, V), 0, 5125);
    run(&r, 20);
    double deepest = r.w->ledger.max_overlap, b, F = fw_rim_force(r.w->bodies[0].rim, deepest, &b), N = 5125 * D * H * V * V;
    CHECK_RELATIVE(F, P * b * H, 1e-14);
    CHECK_NEAR(RS + D / 2 + r.w->bodies[0].x, deepest - (F - N) / (r.s.crush.unloading * F / deepest), 1e-7); /* it creeps there */
    close_rig(&r);
}

/* A current of 3 mm/s presses a fresh rim with 0.06 N: it stands where the line of D0 carries that, nothing crushes, and it is found in a few steps. */
static void stands_on_fresh_rim(void **state)
{
    (void)state;
    double   U = 3e-3, b, N = 5125 * D * H * U * U, d;
    fw_setup s = setup(true, U);
    s.velocity_scale = s.crush_speed = U;
    rig r = start(s, 0, 5125);
    send(&r, -(RS + D / 2) - 1e-9, 0, 0, 0, 0);
    run(&r, 2e4);
    double F = fw_rim_force(r.w->bodies[0].rim, FW_CRUSH_ELASTIC, &b), stands = FW_CRUSH_ELASTIC * N / F;
    d = fw_world_overlap(r.w, 0, FW_WALL);
    CHECK_RELATIVE(F, P * b * H, 1e-14);
    CHECK_NEAR(d, stands, 1e-3 * stands + 2e-15); /* rounding of its position */
    assert_true(r.w->ledger.crushed == 0 && r.w->ledger.force_evaluations < 1000);
    assert_true(fw_ledger_energy_given(&r.w->ledger) == 0);
    close_rig(&r);
}

/* Back on its flat, slowly: nothing crushes, and it comes to a stop without a bounce. Turned by a quarter: fresh rim, which crushes. Turned back and
 * harder than before: it crushes on from where the flat is. */
static void comes_back_on_its_flat(void **state)
{
    (void)state;
    rig    r = start(setup(true, 0), 0, 0);
    double all = 0.5 * V * V / r.w->bodies[0].inv_mass, x = -(RS + D / 2 + 0.2);
    run(&r, 1);
    double deepest = r.w->ledger.max_overlap, restitution = -r.w->bodies[0].vx / V;
    assert_true(r.w->n_contacts == 0);
    /* in any bearing */
    send(&r, x * cos(0.7), x * sin(0.7), 0.3 * cos(0.7), 0.3 * sin(0.7), 0.7);
    run(&r, r.w->t + 3);
    assert_true(r.w->ledger.crushed == 0 && r.w->ledger.max_overlap < deepest && r.w->ledger.peak_force > 0);
    assert_true(fabs(r.w->bodies[0].vx) < 1e-6);
    send(&r, x, 0, 0.3, 0, 0.5 * PI - 0.7);
    run(&r, r.w->t + 3);
    CHECK_RELATIVE(r.w->ledger.crushed, all * pow(0.3 / V, 2) * (1 - exp(-2)), 5e-3);
    send(&r, x, 0, 1.5 * V, 0, -0.5 * PI);
    run(&r, r.w->t + 3);
    /* the line holds up to F(D) d / kappa or so, then p b h: what is crushed is the work from D on, less what more is in store */
    double more = r.w->ledger.max_overlap;
    assert_true(more > deepest && more < deepest * pow(1.5, 4.0 / 3));
    double b, F0 = fw_rim_force(r.w->bodies[0].rim, deepest, &b), F1 = fw_rim_force(r.w->bodies[0].rim, more, &b), kappa = r.s.crush.unloading;
    CHECK_RELATIVE(r.w->ledger.crushed, (F1 * more - F0 * deepest) * (2.0 / 3 - 0.5 / kappa), 5e-3);
    CHECK_RELATIVE(r.w->ledger.peak_force, F1, 1e-6);
    assert_true(restitution > 0.13 && energy_out(r.w) < 1e-3);
    close_rig(&r);
}

/* A floe that spins while it is pushed leaves all of its way in its rim, however few steps the push takes: seen by a run that is stopped every
 * 0.1 ms, known by the rim of one that is not. */
static void a_push_that_turns(void **state)
{
    (void)state;
    enum { N = 250 };
    double deep[N], place[N], slope, lack = 0;
    fw_setup coarse = setup(true, 0);
    coarse.tolerance = coarse.wear_tolerance = 0.01, coarse.first_step = 0.2, coarse.growth = 10, coarse.crush_share = 1, coarse.energy_tolerance = 1;
    rig fine = start(setup(true, 0), 0, 0), r = start(coarse, 0, 0);
    fine.w->bodies[0].spin = r.w->bodies[0].spin = 60;
    fine.w->energy_start = fw_world_energy(fine.w), r.w->energy_start = fw_world_energy(r.w);
    for (int i = 0; i < N; i++) {
        run(&fine, 0.1502 + 1e-4 * i);
        const fw_body *b = &fine.w->bodies[0];
        double         y[8] = {b->x, b->y, b->angle};
        deep[i] = fw_world_overlap(fine.w, 0, FW_WALL), place[i] = fw_rim_place(y);
    }
    run(&r, 0.3);
    const fw_rim *rim = r.w->bodies[0].rim;
    assert_true(fabs(place[N - 1] - place[0]) * D / 2 > 5 * rim->width);
    int n = 0;
    for (int i = 0; i + 1 < N && deep[i + 1] > deep[i]; i++, n++)
        lack = fmax(lack, deep[i] - fw_rim_deepest(rim, place[i], &slope));
    assert_true(n > 100 && lack < 1e-3); /* imprints at its steps' ends alone: 2.7e-2 */
    close_rig(&fine), close_rig(&r);
}

/* A floe that never touched the structure has no rim. */
static void no_rim_without_a_touch(void **state)
{
    (void)state;
    rig r = start(setup(true, V), 1, 5125);
    run(&r, 0.1);
    assert_null(r.w->bodies[0].rim);
    run(&r, 1);
    assert_non_null(r.w->bodies[0].rim);
    close_rig(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rim_remembers), cmocka_unit_test(rim_has_no_jumps), cmocka_unit_test(energy_of_a_push), cmocka_unit_test(energy_of_a_slide),
                                       cmocka_unit_test(rests_on_its_flat), cmocka_unit_test(stands_on_fresh_rim), cmocka_unit_test(comes_back_on_its_flat), cmocka_unit_test(a_push_that_turns), cmocka_unit_test(no_rim_without_a_touch)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
