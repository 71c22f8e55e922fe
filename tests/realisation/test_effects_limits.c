/* What an effect that is off, or on and neutral, leaves as it is; and what turned and mirrored scenes have in common. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"

static const double PI = 3.14159265358979323846;
static const double SPEED = 2;

/* Three floes that meet each other and the structure. */
enum { N = 3 };
static const fw_floe FLOES[N] = {{-6.6, 0.8, 5, 0.9, 2, 0, 0.3}, {-10.6, -0.4, 2.5, 0.5, 2, 0, -0.2}, {-8.6, 3.6, 1.6, 0.4, 2, 0, 0}};

static fw_scene scene(fw_floe floes[N])
{
    memcpy(floes, FLOES, sizeof FLOES);
    fw_scene s = {.speed = SPEED, .temperature = -10, .duration = 9, .n_floes = N, .floes = floes};
    fw_model_defaults(&s.model);
    s.model.window = s.duration;
    return s;
}

static void run(const fw_scene *s, fw_scene_result *r)
{
    fw_msg m = {""};
    if (fw_scene_run(s, NULL, NULL, r, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(r->record.normal_impulse > 0);
}

static size_t ring_bytes(const fw_record *r) { return fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof *r->rings; }

static void same_bits(const fw_scene *a, const fw_scene *b)
{
    fw_scene_result x, y;
    run(a, &x);
    run(b, &y);
    assert_memory_equal(x.floes, y.floes, N * sizeof *x.floes);
    assert_memory_equal(x.record.rings, y.record.rings, ring_bytes(&x.record));
    assert_true(x.record.force_evaluations == y.record.force_evaluations && x.record.steps == y.record.steps);
    assert_true(x.record.energy_truncation == y.record.energy_truncation && x.record.peak_force == y.record.peak_force);
    fw_scene_result_free(&x);
    fw_scene_result_free(&y);
}

/* --- off is absent ---------------------------------------------------------------------------------------------------- */

static fw_course_row storm[2] = {{0, 0.3, 1}, {5, 2, -1}};

/* What the effect of this bit acts with, far from its default. */
static void fill(fw_model *m, uint32_t bit)
{
    switch (bit) {
    case FW_EFFECT_FRICTION: m->friction = 0.7, m->slip_damping_ratio = 0.2; break;
    case FW_EFFECT_FORM_DRAG: m->form_drag = 3; break;
    case FW_EFFECT_SKIN_DRAG: m->skin_drag = 0.5; break;
    case FW_EFFECT_WIND: m->wind = (fw_wind){3, 0.1, 5}; break;
    case FW_EFFECT_TIDE: m->tide = (fw_tide){.period = 100, .minor_ratio = -0.7, .phase = 1, .n_rows = 2, .rows = storm}; break;
    case FW_EFFECT_CRUSHING_LIMIT: m->crushing_limit = (fw_pressure_law){2e3, 0.4}; break;
    case FW_EFFECT_ICE_ON_ICE: m->floe_stiffness = 3e5, m->floe_friction = 0.9; break;
    case FW_EFFECT_CRUSH_CONTACT: m->crush = (fw_crush){{3e5, 0.3}, 7, false}; break;
    default: break; /* floe contact, rotation, added mass, deflected flow: on or off, nothing else */
    }
}

enum { N_EFFECTS = 12, OPTIONAL = ~FW_EFFECTS_CORE };

static void off_is_absent_in_scenes(void **state)
{
    (void)state;
    for (int k = 0; k < N_EFFECTS; k++) {
        fw_floe  f[N], g[N];
        fw_scene plain = scene(f), other = scene(g);
        uint32_t bit = 1u << k;
        plain.model.effects &= ~bit, other.model.effects &= ~bit;
        fill(&other.model, bit);
        if (bit == FW_EFFECT_WIND) other.wind_speed = 20, other.wind_angle = 1;
        if (bit == FW_EFFECT_TIDE) other.tide_phase = 2;
        same_bits(&plain, &other);
    }
}

static fw_record window(const fw_model *m, const fw_scenario *sc)
{
    fw_record r;
    fw_msg    msg = {""};
    assert_int_equal(fw_realise(m, sc, NULL, &r, &msg), FW_OK);
    if (r.status != FW_OK) fail_msg("%s", r.cause);
    return r;
}

static void off_is_absent_in_windows(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    m.window = 120;
    fw_scenario sc = {.seed = 3, .id = 1, .concentration = 0.4, .speed = 1}, other = sc;
    fw_record   plain = window(&m, &sc);
    for (int k = 0; k < N_EFFECTS; k++)
        if ((1u << k) & (uint32_t)OPTIONAL) fill(&m, 1u << k);
    other.wind_speed = 20, other.wind_angle = 1, other.tide_phase = 2;
    fw_record r = window(&m, &other);
    assert_memory_equal(plain.rings, r.rings, ring_bytes(&r));
    assert_true(plain.force_evaluations == r.force_evaluations && plain.steps == r.steps && plain.hits == r.hits);
    assert_true(plain.awake_floes == r.awake_floes && plain.reach == r.reach && plain.floes_made == r.floes_made);
    fw_record_free(&plain);
    fw_record_free(&r);
}

/* --- neutral ---------------------------------------------------------------------------------------------------------- */

/* On, with a parameter that makes it act like nothing, by the same arithmetic: to the bit. */
static void neutral_to_the_bit(void **state)
{
    (void)state;
    fw_course_row same[2] = {{0, 1, 0}, {4, 1, 0}};
    fw_floe       f[N], g[N];
    fw_scene      plain = scene(f), on = scene(g);
    on.model.effects |= FW_EFFECT_TIDE; /* a course that keeps to the scenario's current */
    on.model.tide.rows = same, on.model.tide.n_rows = 2;
    same_bits(&plain, &on);
    on = scene(g);
    on.model.effects |= FW_EFFECT_TIDE; /* half of twice as much */
    same[0].factor = same[1].factor = 0.5, on.speed = 2 * SPEED;
    on.model.tide.rows = same, on.model.tide.n_rows = 2;
    same_bits(&plain, &on);
    on = scene(g);
    on.model.effects |= FW_EFFECT_ICE_ON_ICE; /* its defaults are the structure's */
    same_bits(&plain, &on);
    on = scene(g);
    on.model.effects |= FW_EFFECT_SKIN_DRAG, on.model.skin_drag = 0;
    same_bits(&plain, &on);
}

/* Floes that feel the air, or parted water, fly by no closed form: then neutral is within the accuracy. Returns the worst of depth and impulse. */
static double far_off(const fw_scene *a, const fw_scene *b)
{
    fw_scene_result x, y;
    run(a, &x);
    run(b, &y);
    double off = fmax(fabs(y.depth_along_contact / x.depth_along_contact - 1), fabs(y.record.normal_impulse / x.record.normal_impulse - 1));
    for (size_t i = 0; i < N; i++) off = fmax(off, 0.1 * hypot(x.floes[i].x - y.floes[i].x, x.floes[i].y - y.floes[i].y)); /* [m], grown 10-fold */
    fw_scene_result_free(&x);
    fw_scene_result_free(&y);
    return off;
}

static void neutral_within_accuracy(void **state)
{
    (void)state;
    const double ACCURACIES[] = {1e-2, 1e-3, 1e-4};
    for (size_t k = 0; k < 3; k++) {
        fw_floe  f[N], g[N];
        fw_scene plain = scene(f), on = scene(g);
        plain.model.accuracy = on.model.accuracy = ACCURACIES[k];
        on.model.effects |= FW_EFFECT_WIND; /* no air */
        on.model.wind.density = 0, on.wind_speed = 15, on.wind_angle = 1;
        double air = far_off(&plain, &on);
        on = scene(g), on.model.accuracy = ACCURACIES[k];
        on.model.effects |= FW_EFFECT_ADDED_MASS; /* water so heavy that floes hardly dip, with the drag it has */
        on.model.water_density = 2000, plain.model.water_density = 2000;
        on.model.ice_density = plain.model.ice_density = 100;
        double dry = far_off(&plain, &on); /* C is pi / 4 draft / R or so: 1.6 % of the mass */
        on = scene(g), on.model.accuracy = ACCURACIES[k];
        plain = scene(f), plain.model.accuracy = ACCURACIES[k];
        on.model.effects |= FW_EFFECT_TIDE; /* a slow tide at its height: 1 - cos over half of 9 s of 12.42 h, 5e-8 */
        on.model.tide.minor_ratio = 0, on.tide_phase = 0;
        double tide = far_off(&plain, &on);
        print_message("at %g: no air %.1e, ice that hardly dips %.1e, slow tide %.1e\n", ACCURACIES[k], air, dry, tide);
        assert_true(air <= ACCURACIES[k]);
        assert_true(dry <= 0.01);
        assert_true(tide <= ACCURACIES[k]);
    }
}

/* --- symmetry --------------------------------------------------------------------------------------------------------- */

/* All effects at once; phase and angles of a current along +x. */
static fw_scene full(fw_floe f[N], fw_course_row course[2], double turn, int hand)
{
    fw_scene s = scene(f);
    s.model.effects |= FW_EFFECT_SKIN_DRAG | FW_EFFECT_WIND | FW_EFFECT_ADDED_MASS | FW_EFFECT_DEFLECTED_FLOW | FW_EFFECT_ICE_ON_ICE | FW_EFFECT_TIDE;
    s.model.accuracy = 1e-3;
    s.model.skin_drag = 0.02, s.model.floe_friction = 0.05;
    s.wind_speed = 15, s.wind_angle = hand * PI / 3 + turn;
    course[0] = (fw_course_row){0, 0.8, turn}, course[1] = (fw_course_row){9, 1, turn + hand * 0.3};
    s.model.tide.rows = course, s.model.tide.n_rows = 2;
    double c = cos(turn), q = sin(turn);
    for (size_t i = 0; i < N; i++) {
        fw_floe o = f[i];
        o.y *= hand, o.spin *= hand;
        f[i].x = c * o.x - q * o.y, f[i].y = q * o.x + c * o.y, f[i].vx = c * o.vx - q * o.vy, f[i].vy = q * o.vx + c * o.vy, f[i].spin = o.spin;
    }
    return s;
}

/* The ring's theta runs clockwise seen from above from where x is most negative, so a scene turned anticlockwise has arcs with smaller theta. */
static void compare_turned(double turn, int hand)
{
    fw_floe         f[N], g[N];
    fw_course_row   a[2], b[2];
    fw_scene        s = full(f, a, 0, 1), t = full(g, b, turn, hand);
    fw_scene_result x, y;
    run(&s, &x);
    run(&t, &y);
    double c = cos(turn), q = sin(turn);
    for (size_t i = 0; i < N; i++) {
        fw_floe o = x.floes[i];
        o.y *= hand, o.vy *= hand, o.spin *= hand;
        CHECK_NEAR(y.floes[i].x, c * o.x - q * o.y, 1e-7);
        CHECK_NEAR(y.floes[i].y, q * o.x + c * o.y, 1e-7);
        CHECK_NEAR(y.floes[i].vx, c * o.vx - q * o.vy, 1e-7);
        CHECK_NEAR(y.floes[i].spin, o.spin, 1e-7);
    }
    CHECK_RELATIVE(y.depth_along_contact, x.depth_along_contact, 1e-7);
    size_t        n = x.record.n_arcs;
    long          shift = lround(turn / (2 * PI) * (double)n);
    const double *from = fw_record_load(&x.record, 0, FW_RING_LOAD), *to = fw_record_load(&y.record, 0, FW_RING_LOAD);
    double        most = 0;
    for (size_t k = 0; k < n; k++) most = fmax(most, from[k]);
    for (size_t k = 0; k < n; k++) {
        size_t mirrored = hand > 0 ? k : n - 1 - k, where = (size_t)(((long)mirrored - shift + 2 * (long)n) % (long)n);
        CHECK_NEAR(to[where], from[k], 1e-6 * most);
    }
    fw_scene_result_free(&x);
    fw_scene_result_free(&y);
}

static void turned_and_mirrored_scenes(void **state)
{
    (void)state;
    compare_turned(0.5 * PI, 1);
    compare_turned(-37 * PI / 180, 1);
    compare_turned(0, -1);
    compare_turned(PI, -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(off_is_absent_in_scenes), cmocka_unit_test(off_is_absent_in_windows), cmocka_unit_test(neutral_to_the_bit),
        cmocka_unit_test(neutral_within_accuracy), cmocka_unit_test(turned_and_mirrored_scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
