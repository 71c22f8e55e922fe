/* A lone floe on the structure, stepped by closed forms: against the closed form of the whole hit, against the method that all other
 * contacts are stepped by, its order, and its books. */
#include <stdbool.h>
#include <string.h>

#include "kernel/rig.h"

static const double RS = 3.7, D = 5, H = 0.5, K = 2e6;

static double mass(void) { return 900 * PI * D * D / 4 * H; }
static double omega(void) { return sqrt(K / mass()); }

static fw_setup setup(double zeta, double mu, double slip_ratio)
{
    return (fw_setup){.structure_radius = RS,
                      .flow = {.ux = 2, .ice_x = 2},
                      .contact = {K, zeta, mu, slip_ratio},
                      .floe_contact = {K, zeta, mu, slip_ratio},
                      .has_drag = true,
                      .has_rotation = true,
                      .ice_density = 900,
                      .method = FW_METHOD_ARK3,
                      .is_lone_exact = true,
                      .tolerance = 1e-6, .energy_tolerance = 0.01,
                      .velocity_scale = 2,
                      .first_step = 0.02,
                      .growth = 3,
                      .max_step = 2,
                      .wear_tolerance = 1e-7,
                      .solver_share = 1e-3,
                      .landing = 1e-9,
                      .horizon = 4,
                      .margin = 0.3,
                      .half_width = 50,
                      .downstream = INFINITY,
                      .max_evaluations = INFINITY};
}

/* A floe at lateral offset y, 0.3 m before the touch if it goes straight on. */
static rig start(fw_setup s, double y, double vx, double vy, double spin, double drag, bool rotates)
{
    rig     r = open_rig(&s);
    double  m = mass(), reach = RS + D / 2;
    fw_body b = {.x = -sqrt(reach * reach - y * y) - 0.3,
                 .y = y,
                 .vx = vx,
                 .vy = vy,
                 .spin = spin,
                 .radius = D / 2,
                 .thickness = H,
                 .inv_mass = 1 / m,
                 .inv_inertia = rotates ? 8 / (m * D * D) : 0,
                 .drag = drag * D * H};
    put_body(&r, &b);
    fw_world_open_ledger(r.w);
    return r;
}

/* Head-on without drag: d'' + 2 zeta w d' + w^2 d = 0 from (0, v). */
static double depth(double zeta, double w, double v, double t)
{
    double b = w * sqrt(fabs(zeta * zeta - 1)), e = v * exp(-zeta * w * t);
    return zeta < 1 ? e * sin(b * t) / b : zeta > 1 ? e * sinh(b * t) / b : e * t;
}

static void head_on(void **state)
{
    (void)state;
    static const double ZETA[] = {0, 0.5, 0.999, 1, 1.0001, 2};
    for (size_t z = 0; z < 6; z++)
        for (int n = 1; n <= 64; n *= 8) { /* however often the caller wants a stop */
            rig    r = start(setup(ZETA[z], 0.1, 1), 0, 1.7, 0, 0, 0, true);
            double touch = 0.3 / 1.7, until = 1.2 / omega(); /* while the force lasts at any of these */
            for (int i = 1; i <= n; i++) {
                double t = until * i / n;
                run(&r, touch + t);
                const fw_body *b = &r.w->bodies[0];
                CHECK_NEAR(b->x + RS + D / 2, depth(ZETA[z], omega(), 1.7, t), 1e-13 * D);
                assert_true(b->y == 0 && b->vy == 0 && b->spin == 0);
            }
            run(&r, touch + 10 / omega());
            if (ZETA[z] == 0) CHECK_RELATIVE(r.w->bodies[0].vx, -1.7, 1e-12);
            if (ZETA[z] == 1) CHECK_RELATIVE(r.w->bodies[0].vx, -1.7 * exp(-2), 1e-12);
            if (ZETA[z] == 1) CHECK_RELATIVE(r.w->ledger.contact_time, 2 / omega(), 1e-10);
            close_rig(&r);
        }
}

/* Slip at Coulomb's cap from the touch to the release: spin is mu times the normal impulse, on whatever way. */
static void sliding(void **state)
{
    (void)state;
    rig r = start(setup(1, 0.1, 1), 2.5, 2, 0.6, -3, 0, true);
    run(&r, 0.3 / 2 + 3);
    const fw_body *b = &r.w->bodies[0];
    assert_true(r.w->ledger.normal_impulse > 0 && r.w->n_contacts == 0);
    CHECK_RELATIVE(b->spin + 3, 0.1 * r.w->ledger.normal_impulse * b->radius * b->inv_inertia, 1e-12);
    close_rig(&r);
}

typedef struct result {
    double state[5], depth, x_wall, path, evaluations;
} result;

static result result_of(rig *r, double t)
{
    run(r, t);
    const fw_body      *b = &r->w->bodies[0];
    const fw_wear_sums *w = &r->wear.sums[0];
    return (result){{b->x, b->y, b->vx, b->vy, b->spin}, w->along, w->x_wall, w->path, r->w->ledger.force_evaluations};
}

/* The method of all other contacts and this one have nothing in common but the model. */
static void agrees_with_the_method(void **state)
{
    (void)state;
    static const struct {
        double y, zeta, mu, slip_ratio, drag, vy, spin;
        bool   rotates;
    } CASE[] = {
        {0.5, 1, 0.1, 1, 5125, 0, 0, true},    {3.5, 1, 0.1, 1, 5125, 0, 0, true},  {5.5, 1, 0.1, 1, 5125, 0, 0, true},
        {2, 0.2, 0.1, 1, 5125, 0, 0, true},    {2, 3, 0.1, 1, 5125, 0.3, -1, true}, {2, 1, 0.1, 0.1, 5125, 0, 2, true},
        {2, 1, 0.5, 1, 5125, 0, 0, true},      {2, 1, 0, 1, 5125, 0, 0, true},      {2, 1, 0.1, 0, 5125, 0, 0, true},
        {2, 1, 0.1, 1, 5125, 0, 0, false},     {2, 1, 0.1, 1, 512, 0, 0, true},     {3, 1, 0.1, 1, 0, 0, 1, true},
        {-4, 0.7, 0.2, 0.5, 5125, 0, 1, true}, {2, 0, 0.1, 1, 5125, 0, 0, true}};
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        result is[2];
        for (int exact = 0; exact < 2; exact++) {
            fw_setup s = setup(CASE[i].zeta, CASE[i].mu, CASE[i].slip_ratio);
            s.is_lone_exact = exact;
            rig r = start(s, CASE[i].y, 2, CASE[i].vy, CASE[i].spin, CASE[i].drag, CASE[i].rotates);
            is[exact] = result_of(&r, 6);
            assert_true(fw_ledger_energy_relative(&r.w->ledger) < 1e-12);
            assert_true(fw_ledger_momentum_relative(&r.w->ledger) < 1e-12);
            close_rig(&r);
        }
        print_message("case %zu: %.0f evaluations, the method %.0f; depth %.2e apart\n", i, is[1].evaluations,
                      is[0].evaluations, is[1].depth / is[0].depth - 1);
        for (int q = 0; q < 5; q++) CHECK_NEAR(is[1].state[q], is[0].state[q], 1e-4);
        CHECK_RELATIVE(is[1].depth, is[0].depth, 1e-4);
        CHECK_RELATIVE(is[1].x_wall, is[0].x_wall, 1e-4);
        CHECK_RELATIVE(is[1].path, is[0].path, 5e-4);
    }
}

/* Equal steps h, no error control: third order or better. */
static void order(void **state)
{
    (void)state;
    double   error[4];
    fw_setup s = setup(1, 0.1, 1);
    rig      r = start(s, 2.5, 2, 0, 0, 5125, true);
    s.tolerance = 1e-9, s.wear_tolerance = 1e-10;
    close_rig(&r);
    r = start(s, 2.5, 2, 0, 0, 5125, true);
    result ref = result_of(&r, 2);
    close_rig(&r);
    for (int i = 0; i < 4; i++) {
        s.tolerance = s.wear_tolerance = 1e9;
        s.max_step = 2 * 0.4 / omega() / (1 << i); /* a way */
        r = start(s, 2.5, 2, 0, 0, 5125, true);
        result is = result_of(&r, 2);
        error[i] = 0;
        for (int q = 0; q < 5; q++) error[i] = fmax(error[i], fabs(is.state[q] - ref.state[q]));
        close_rig(&r);
    }
    print_message("errors at h, h/2, h/4, h/8: %.1e %.1e %.1e %.1e\n", error[0], error[1], error[2], error[3]);
    assert_true(error[3] < 1e-5 && log2(error[2] / error[3]) > 2.5);
}

/* dashpot + friction + dropped against drag and energies: each by its own quadrature, so an error of the motion shows */
static void energy(void **state)
{
    (void)state;
    static const double Y[] = {0.3, 2, 4, 5.5}, TOLERANCE[] = {1e-3, 1e-4, 1e-6};
    for (int i = 0; i < 4; i++)
        for (int q = 0; q < 3; q++) {
            fw_setup s = setup(1, 0.1, 1);
            s.tolerance = TOLERANCE[q], s.wear_tolerance = 0.2 * TOLERANCE[q];
            rig    r = start(s, Y[i], 2, 0, 0, 5125, true);
            double e0 = fw_world_energy(r.w);
            run(&r, 4);
            double off = fw_ledger_energy_truncation(&r.w->ledger, e0, fw_world_energy(r.w));
            print_message("offset %g m, tolerance %g: energy off by %.1e\n", Y[i], TOLERANCE[q], off);
            assert_true(off < 10 * TOLERANCE[q]);
            assert_true(r.w->ledger.drag_work != 0 && r.w->ledger.dashpot > 0 && r.w->ledger.friction > 0);
            close_rig(&r);
        }
}

static void mirror_images(void **state)
{
    (void)state;
    for (double y = 0.2; y < 6; y += 0.7) {
        rig a = start(setup(1, 0.1, 1), y, 2, 0.1, 0.5, 5125, true),
            b = start(setup(1, 0.1, 1), -y, 2, -0.1, -0.5, 5125, true);
        run(&a, 5), run(&b, 5);
        const fw_body *p = &a.w->bodies[0], *q = &b.w->bodies[0];
        assert_true(p->x == q->x && p->y == -q->y && p->vx == q->vx && p->vy == -q->vy && p->spin == -q->spin);
        close_rig(&a), close_rig(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(head_on), cmocka_unit_test(sliding), cmocka_unit_test(agrees_with_the_method),
        cmocka_unit_test(order),   cmocka_unit_test(energy),  cmocka_unit_test(mirror_images)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
