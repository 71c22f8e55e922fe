/* Ice that crushes on the structure: scenes and windows. Single hits against tests/reference/crush.csv (independent of this code), head-on pushes against
 * quadrature of the exact lens, rolling against its criterion, windows against the laws of every run. */
#include "realisation/reference_table.h"

#define PI 3.14159265358979323846

static const double RS = 3.7;

static fw_scene crush_scene(fw_floe *f, double pressure, bool has_flat, double duration, double accuracy)
{
    fw_scene s = scene_of(f, 1, duration, accuracy);
    s.speed = f->vx;
    s.model.effects |= FW_EFFECT_CRUSH_CONTACT;
    s.model.crush = (fw_crush){.law = {pressure, 0}, .has_flat = has_flat};
    return s;
}

/* 0.3 m before the touch, with the current. */
static fw_floe floe_at(double D, double h, double y0, double v)
{
    double reach = RS + D / 2;
    return (fw_floe){.x = -sqrt(reach * reach - y0 * y0) - 0.3, .y = y0, .diameter = D, .thickness = h, .vx = v};
}

static void run(const fw_scene *s, fw_scene_result *r)
{
    fw_msg m = {""};
    if (fw_scene_run(s, NULL, NULL, r, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(r->record.energy_truncation <= s->model.accuracy);
    assert_true(r->record.energy_relative <= 1e-10 && r->record.momentum_relative <= 1e-10 && r->record.wear_conservation <= 1e-10);
    assert_true(r->record.overlap_time_share == 0 && r->record.overlap_wear_share == 0); /* ice that is gone is no breach of the rigid disc */
}

static void motion(const fw_floe *f, double *along, double *orbit)
{
    double r = hypot(f->x, f->y);
    *along = (f->x * f->vy - f->y * f->vx) / r, *orbit = *along / r;
}

/* --- against independent integration ---------------------------------------------------------------------------------- */

static fw_scene reference_scene(const table *t, size_t row, fw_floe *f, double accuracy)
{
    *f = floe_at(value(t, row, "D"), value(t, row, "h"), value(t, row, "y0"), value(t, row, "speed"));
    fw_scene s = crush_scene(f, value(t, row, "pressure"), value(t, row, "flat") > 0, REFERENCE_GAP / f->vx + value(t, row, "t_end"), accuracy);
    s.model.crush.law.exponent = value(t, row, "exponent"), s.model.form_drag = value(t, row, "form_drag");
    return s;
}

static void reference_hits(void **state)
{
    (void)state;
    static const double ACCURACY[] = {1e-1, 1e-2, 1e-3, 1e-4};
    table              *t = malloc(sizeof *t);
    read_table(t, "crush.csv");
    for (size_t k = 0; k < 4; k++) {
        double worst_along = 0, worst_wall = 0, evaluations = 0, a = ACCURACY[k];
        for (size_t row = 1; row < t->n_rows; row++) {
            fw_floe         f;
            fw_scene        s = reference_scene(t, row, &f, a);
            fw_scene_result r;
            double          v, orbit;
            run(&s, &r);
            motion(&r.floes[0], &v, &orbit);
            double along = fabs(r.depth_along_contact / value(t, row, "depth_mm") - 1), wall = fabs(r.depth_x_wall / value(t, row, "W_mm_m") - 1);
            worst_along = fmax(worst_along, along), worst_wall = fmax(worst_wall, wall), evaluations += r.record.force_evaluations;
            if (along > a || wall > a) print_message("accuracy %g, row %zu: %.2e along the contact, %.2e on the wall\n", a, row, along, wall);
            assert_true(along <= a && wall <= a);
            CHECK_RELATIVE(r.max_overlap, value(t, row, "d_max"), 0.5 * a);
            CHECK_RELATIVE(r.record.peak_force, value(t, row, "N_peak"), 0.5 * a);
            CHECK_RELATIVE(r.record.normal_impulse, value(t, row, "J_N"), a);
            if (a < 0.1) {
                CHECK_RELATIVE(r.path, value(t, row, "path"), fmax(5 * a, 2e-3)); /* half of it where next to nothing presses */
                CHECK_NEAR(r.floes[0].spin, value(t, row, "spin"), a);
                CHECK_NEAR(orbit, value(t, row, "orbit"), 10 * a); /* where it is says when it has let go */
            }
            fw_scene_result_free(&r);
        }
        print_message("accuracy %g: along the contact within %.1e, on the wall %.1e, %.0f evaluations\n", a, worst_along, worst_wall, evaluations);
    }
    free(t);
}

/* Order: error control holds a step's error to the tolerance, ~ h^3, so there are tolerance^(-1/3) steps, and the error of a hit falls between tolerance^(2/3),
 * where all of them add up, and tolerance. Slope of log error against log tolerance over three decades, median of the rows: single errors cross zero. */
static void error_follows_tolerance(void **state)
{
    (void)state;
    table *t = malloc(sizeof *t);
    read_table(t, "crush.csv");
    double slope[MAX_ROWS];
    size_t n = 0;
    for (size_t row = 1; row < t->n_rows; row++) {
        double sxy = 0, sxx = 0, mx = 0, my = 0, x[7], y[7];
        for (int k = 0; k < 7; k++) {
            fw_floe         f;
            fw_scene        s = reference_scene(t, row, &f, 0.1);
            fw_scene_result r;
            s.model.numerics.tolerance = 1e-3 * pow(10, -0.5 * k), s.model.numerics.wear_tolerance = 0.4 * s.model.numerics.tolerance;
            s.model.numerics.first_step = 0.1 * pow(10, -0.5 * k / 3);
            run(&s, &r);
            x[k] = log(s.model.numerics.tolerance), y[k] = log(fabs(r.depth_x_wall / value(t, row, "W_mm_m") - 1) + 1e-9);
            mx += x[k] / 7, my += y[k] / 7;
            fw_scene_result_free(&r);
        }
        for (int k = 0; k < 7; k++) sxy += (x[k] - mx) * (y[k] - my), sxx += (x[k] - mx) * (x[k] - mx);
        slope[n++] = sxy / sxx;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 1; k < n; k++)
            if (slope[k] < slope[i]) {
                double swap = slope[i];
                slope[i] = slope[k], slope[k] = swap;
            }
    print_message("error of wear ~ tolerance^%.2f (median; %.2f to %.2f)\n", slope[n / 2], slope[0], slope[n - 1]);
    assert_true(slope[n / 2] > 0.6 && slope[n / 2] < 1.2);
    free(t);
}

/* --- head-on ---------------------------------------------------------------------------------------------------------- */

/* Chord of two discs whose rims overlap by d, by Pythagoras from the distance of its line to one centre. */
static double chord(double d, double R)
{
    double c = R + RS - d, x = (c * c + R * R - RS * RS) / (2 * c);
    return 2 * sqrt(R * R - x * x);
}

/* Deepest overlap by quadrature: midpoints in sqrt d until the work of p b h is the floe's kinetic energy. */
static double deepest(double D, double h, double v, double p)
{
    double R = D / 2, E = 0.5 * 900 * PI * R * R * h * v * v, x = 0, dx = 1e-6;
    for (;;) {
        double xm = x + 0.5 * dx, work = p * h * chord(xm * xm, R) * 2 * xm * dx;
        if (work > E) return (x + dx * E / work) * (x + dx * E / work);
        E -= work, x += dx;
    }
}

static void head_on(void **state)
{
    (void)state;
    static const double FLOE[][4] = {{2.5, 0.5, 2, 1.1e6}, {1.2, 0.3, 0.5, 1.1e6}, {10, 1.1, 1, 0.6e6}, {2.5, 0.5, 2, 5e6}};
    for (size_t i = 0; i < 4; i++) {
        double          D = FLOE[i][0], h = FLOE[i][1], v = FLOE[i][2], p = FLOE[i][3], R = D / 2, star = R * RS / (R + RS), m = 900 * PI * R * R * h;
        double          d = deepest(D, h, v, p), rough = pow(m * v * v / (8.0 / 3 * sqrt(2 * star) * p * h), 2.0 / 3);
        fw_floe         f = floe_at(D, h, 0, v);
        fw_scene        s = crush_scene(&f, p, true, 0.3 / v + 6 * d / v, 1e-3);
        fw_scene_result r;
        s.speed = 0, s.model.form_drag = 0;
        run(&s, &r);
        CHECK_RELATIVE(r.max_overlap, d, 1e-4);
        CHECK_RELATIVE(r.record.peak_force, p * h * chord(d, R), 1e-4);
        CHECK_RELATIVE(r.max_overlap, rough, 0.01);
        /* exp(-2) of the shallow lens; the exact one holds kappa F(D) D against its own work, 0.3 % more where it is deepest */
        CHECK_RELATIVE(-r.floes[0].vx / v, exp(-2), 4e-3);
        assert_true(r.floes[0].vy == 0 && r.floes[0].spin == 0 && r.path == 0);
        CHECK_RELATIVE(r.record.normal_impulse, m * (v - r.floes[0].vx), 1e-10);
        fw_scene_result_free(&r);
    }
}

/* --- rolling ---------------------------------------------------------------------------------------------------------- */

/* A floe rolls when friction's moment mu N R is more than the flat's, N b / 2: b < 2 mu R. */
static void rolls_or_slides(void **state)
{
    (void)state;
    double R = 1.25, v, orbit, accuracy = 0.01;
    /* b < 1.3 mu R, at 1 s after the touch */
    fw_floe         f = floe_at(2 * R, 0.5, 1.5, 0.5);
    fw_scene        s = crush_scene(&f, 6e6, true, 0.3 / f.vx + 1, accuracy);
    fw_scene_result r;
    run(&s, &r);
    motion(&r.floes[0], &v, &orbit);
    double b = chord(r.max_overlap, R);
    print_message("b %.3f m = %.2f mu R: spin %.4f, rolling is %.4f\n", b, b / (0.1 * R), r.floes[0].spin, v / R);
    assert_true(b < 1.3 * 0.1 * R);
    CHECK_RELATIVE(r.floes[0].spin, v / R, 0.05);
    fw_scene_result_free(&r);
    /* b > 4 mu R, at 3 s; the same without the flat's moment rolls */
    for (int flat = 0; flat < 2; flat++) {
        f = floe_at(2 * R, 0.5, 1, 2), s = crush_scene(&f, 0.5e6, flat, 0.3 / f.vx + 3, accuracy);
        run(&s, &r);
        motion(&r.floes[0], &v, &orbit);
        b = chord(r.max_overlap, R);
        print_message("b %.3f m = %.2f mu R: spin %.4f, orbital rate %.4f, rolling is %.4f\n", b, b / (0.1 * R), r.floes[0].spin, orbit, v / R);
        assert_true(b > 4 * 0.1 * R);
        CHECK_RELATIVE(r.floes[0].spin, flat ? orbit : v / R, flat ? 0.25 : 0.05);
        fw_scene_result_free(&r);
    }
}

/* The slip path that the moment stands for: 2 m or so with the flat, 0.03 m without (tests/reference/crush.csv: 2.33 and 0.0286). */
static void path_with_and_without_flat(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        fw_floe         f = floe_at(2.5, 0.5, 0.99, 2);
        fw_scene        s = crush_scene(&f, 0.5e6, flat, 0.15 + 4.9, 0.01);
        fw_scene_result r;
        run(&s, &r);
        CHECK_RELATIVE(r.path, flat ? 2 : 0.03, flat ? 0.2 : 0.1);
        fw_scene_result_free(&r);
    }
}

/* The mirror image of a hit wears as much and spins the other way; locked rotation has no moment to give. */
static void mirrored_and_locked(void **state)
{
    (void)state;
    fw_floe         f = floe_at(5, 0.7, 2.1, 1.3), g = floe_at(5, 0.7, -2.1, 1.3);
    fw_scene        s = crush_scene(&f, 1.1e6, true, 6, 0.001), t = crush_scene(&g, 1.1e6, true, 6, 0.001);
    fw_scene_result a, b;
    run(&s, &a), run(&t, &b);
    CHECK_RELATIVE(b.depth_x_wall, a.depth_x_wall, 1e-6);
    CHECK_RELATIVE(b.floes[0].spin, -a.floes[0].spin, 1e-6);
    fw_scene_result_free(&a), fw_scene_result_free(&b);
    s.model.effects &= ~(uint32_t)FW_EFFECT_ROTATION, t.model.effects = s.model.effects;
    g = f, t.model.crush.has_flat = false;
    run(&s, &a), run(&t, &b);
    assert_true(a.depth_x_wall == b.depth_x_wall && a.floes[0].spin == 0 && a.path > 1);
    fw_scene_result_free(&a), fw_scene_result_free(&b);
}

/* Locked, a floe that spins rubs on and on, and something keeps its spin up: that works, too (run() looks at the balance). */
static void locked_and_spinning(void **state)
{
    (void)state;
    fw_floe         f = floe_at(5, 0.9, 0.9, 2);
    fw_scene        s = crush_scene(&f, 1.1e6, true, 8, 1e-2);
    fw_scene_result r;
    f.spin = 1, s.model.effects &= ~(uint32_t)FW_EFFECT_ROTATION;
    run(&s, &r);
    assert_true(r.floes[0].spin == 1 && r.path > 10);
    fw_scene_result_free(&r);
}

/* The moment is none of friction: beyond the middle a floe on its flat turns with the wall without any, at the orbital rate or near it. */
static void flat_turns_without_friction(void **state)
{
    (void)state;
    fw_floe         f = floe_at(2.5, 0.5, 0.99, 2);
    fw_scene        s = crush_scene(&f, 0.5e6, true, 4, 1e-2);
    fw_scene_result r;
    double          along, orbit;
    s.model.effects &= ~(uint32_t)FW_EFFECT_FRICTION;
    run(&s, &r);
    motion(&r.floes[0], &along, &orbit);
    print_message("without friction: spin %.3f, orbit %.3f rad/s\n", r.floes[0].spin, orbit);
    assert_true(r.floes[0].spin / orbit > 0.5 && r.floes[0].spin / orbit < 1.0001);
    fw_scene_result_free(&r);
    s.model.crush.has_flat = false;
    run(&s, &r);
    assert_true(r.floes[0].spin == 0);
    fw_scene_result_free(&r);
}

/* Wind alone drives a floe against the wall: how fast by its own equation, m v' = a (W - v)^2 - w v^2, how deep by the closed form. */
static void without_a_current(void **state)
{
    (void)state;
    double          D = 5, h = 0.9, W = 20, m = 900 * PI * D * D / 4 * h, star = 0.5 * D * RS / (0.5 * D + RS), p = 1.1e6;
    double          air = 0.5 * 1.3 * (0.0018 * PI * D * D / 4 + 1.1 * D * h * (1 - 900.0 / 1025)), water = 0.5 * 1025 * 10 * D * h, v = 0, dt = 1e-3;
    fw_floe         f = floe_at(D, h, 0, 0);
    fw_scene        s = crush_scene(&f, p, true, 60, 1e-3);
    fw_scene_result r;
    for (double x = 0; x < 0.3; x += dt * v) { /* midpoints */
        double half = v + 0.5 * dt * (air * (W - v) * (W - v) - water * v * v) / m;
        v += dt * (air * (W - half) * (W - half) - water * half * half) / m;
    }
    s.model.effects |= FW_EFFECT_WIND, s.wind_speed = W;
    run(&s, &r);
    CHECK_RELATIVE(r.max_overlap, pow(m * v * v / (8.0 / 3 * sqrt(2 * star) * p * h), 2.0 / 3), 0.01);
    fw_scene_result_free(&r);
}

/* --- springs from the pressure ----------------------------------------------------------------------------------------- */

/* Nothing but k changes: the very bits of a scene that is given that k. On the structure v is the current's, m the floe's. */
static void stiffness_from_pressure(void **state)
{
    (void)state;
    double          R = 1.25, h = 0.5, star = R * RS / (R + RS), m = 900 * PI * R * R * h;
    double          k = exp(-2) * pow(8.0 / 3, 4.0 / 3) * pow(m * 4, -1.0 / 3) * pow(2 * star, 2.0 / 3) * pow(1.07e6 * h, 4.0 / 3);
    fw_floe         f = floe_at(2 * R, h, 1, 2);
    fw_scene        s = scene_of(&f, 1, 8, 1e-4);
    fw_scene_result a, b;
    s.model.crush.law.pressure = 1.07e6;
    s.model.stiffness_from_pressure = true;
    run(&s, &a);
    s.model.stiffness_from_pressure = false, s.model.stiffness = k;
    run(&s, &b);
    CHECK_RELATIVE(a.depth_along_contact, b.depth_along_contact, 1e-9);
    CHECK_RELATIVE(a.max_overlap, b.max_overlap, 1e-9);
    fw_scene_result_free(&a), fw_scene_result_free(&b);
}

/* --- windows ----------------------------------------------------------------------------------------------------------- */

static fw_record window(uint32_t effects, bool has_flat, double concentration, double speed, double seconds, uint64_t id)
{
    fw_model m;
    fw_model_defaults(&m);
    m.effects |= effects, m.crush.has_flat = has_flat, m.window = seconds;
    fw_scenario s = {.seed = 7, .id = id, .concentration = concentration, .speed = speed};
    fw_record   r;
    fw_msg      msg = {""};
    if (fw_realise(&m, &s, NULL, &r, &msg) != FW_OK) fail_msg("%s", msg.text);
    return r;
}

static double load_of(const fw_record *r)
{
    double sum = 0;
    for (size_t k = 0; k < r->n_arcs; k++) sum += fw_record_load(r, 0, FW_RING_LOAD)[k];
    return sum;
}

static void windows_keep_the_laws(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        double load = 0, evaluations = 0, spring = 0, spring_evaluations = 0;
        for (uint64_t id = 0; id < 24; id++) {
            fw_record r = window(FW_EFFECT_CRUSH_CONTACT, flat, 0.4, 2, 120, id), s = window(0, true, 0.4, 2, 120, id);
            if (r.status != FW_OK) fail_msg("window %u failed: %s", (unsigned)id, r.cause);
            assert_true(r.energy_truncation <= 0.01 && r.energy_relative <= 1e-10 && r.momentum_relative <= 1e-10 && r.wear_conservation <= 1e-10);
            load += load_of(&r), evaluations += r.force_evaluations, spring += load_of(&s), spring_evaluations += s.force_evaluations;
            fw_record_free(&r), fw_record_free(&s);
        }
        print_message("%s flat: load %.2f of the spring's, evaluations %.2f\n", flat ? "with" : "without", load / spring, evaluations / spring_evaluations);
        assert_true(evaluations < 4 * spring_evaluations);
    }
}

/* In slow currents 0.01 to 0.1 N hold a floe on the structure. Windows of as much ice: a step is a floe's way over its speed, so they cost next to the same. */
static void slow_windows(void **state)
{
    (void)state;
    static const double SPEED[] = {1, 0.05, 0.01, 3e-3, 1e-3};
    for (int flat = 0; flat < 2; flat++) {
        double per_metre[5];
        for (int k = 0; k < 5; k++) {
            double way = k == 0 ? 1200 : 240, evaluations = 0;
            for (uint64_t id = 0; id < 6; id++) {
                fw_record r = window(FW_EFFECT_CRUSH_CONTACT, flat, 0.2, SPEED[k], way / SPEED[k], id);
                if (r.status != FW_OK) fail_msg("%g m/s, window %u failed: %s", SPEED[k], (unsigned)id, r.cause);
                assert_true(r.energy_truncation <= 0.01 && r.energy_relative <= 1e-12 && r.momentum_relative <= 1e-12 && r.wear_conservation <= 1e-10);
                evaluations += r.force_evaluations;
                fw_record_free(&r);
            }
            per_metre[k] = evaluations / (6 * way);
            print_message("%s flat, %g m/s: %.0f evaluations a metre\n", flat ? "with" : "without", SPEED[k], per_metre[k]);
            assert_true(per_metre[k] < 10 * per_metre[0]);
        }
    }
}

/* What the law acts with counts only while it is on. */
static void off_is_absent(void **state)
{
    (void)state;
    fw_record a = window(0, true, 0.4, 1.5, 60, 3), b = window(0, false, 0.4, 1.5, 60, 3);
    size_t    n = fw_record_packed_size(a.n_arcs, a.n_laws);
    unsigned char *p = malloc(n), *q = malloc(n);
    a.host_cpu_s = b.host_cpu_s = 0;
    fw_record_pack(&a, p), fw_record_pack(&b, q);
    assert_memory_equal(p, q, n);
    free(p), free(q);
    fw_record_free(&a), fw_record_free(&b);
}

/* What is refused says why. */
static void refusals(void **state)
{
    (void)state;
    fw_model m;
    fw_msg   msg = {""};
    fw_model_defaults(&m);
    m.crush.law.pressure = -1;
    assert_int_equal(fw_model_check(&m, &msg), FW_OK); /* off */
    m.effects |= FW_EFFECT_CRUSH_CONTACT;
    assert_int_equal(fw_model_check(&m, &msg), FW_E_ARG);
    assert_non_null(strstr(msg.text, "crush pressure"));
    m.crush.law = (fw_pressure_law){1e6, 1};
    assert_int_equal(fw_model_check(&m, &msg), FW_E_ARG);
    m.crush.law.exponent = 0.3, m.crush.unloading = 0.3;
    assert_int_equal(fw_model_check(&m, &msg), FW_E_ARG);
    assert_non_null(strstr(msg.text, "unloading"));
    m.crush.unloading = 0, m.numerics.scheme = FW_SCHEME_RK4, m.numerics.step = 1e-3;
    assert_int_equal(fw_model_check(&m, &msg), FW_E_ARG);
    m.numerics.scheme = FW_SCHEME_EVENTS;
    assert_int_equal(fw_model_check(&m, &msg), FW_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(reference_hits), cmocka_unit_test(error_follows_tolerance), cmocka_unit_test(head_on), cmocka_unit_test(rolls_or_slides),
                                       cmocka_unit_test(path_with_and_without_flat), cmocka_unit_test(mirrored_and_locked), cmocka_unit_test(locked_and_spinning),
                                       cmocka_unit_test(flat_turns_without_friction), cmocka_unit_test(without_a_current), cmocka_unit_test(stiffness_from_pressure),
                                       cmocka_unit_test(windows_keep_the_laws), cmocka_unit_test(slow_windows), cmocka_unit_test(off_is_absent), cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
