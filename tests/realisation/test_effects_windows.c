/* Windows with wind, deflected flow, tides, added mass and skin drag, alone and together: none fails, books close, records repeat to the bit. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"
#include "realisation/flow.h"

static const double PI = 3.14159265358979323846;
enum { N_WINDOWS = 6 };

typedef struct kind {
    const char *name;
    uint32_t    effects;
    double      wind_angle;           /* [deg] */
    double      period, minor, phase; /* [s], [-], [rad] in the window's middle; phase < 0: another one in each window */
} kind;

static const double M2 = 12.42 * 3600;
static const kind   KINDS[] = {
    {"wind along", FW_EFFECT_WIND, 0, 0, 0, 0},
    {"wind across", FW_EFFECT_WIND, 90, 0, 0, 0},
    {"wind against", FW_EFFECT_WIND, 180, 0, 0, 0},
    {"deflected flow", FW_EFFECT_DEFLECTED_FLOW, 0, 0, 0, 0},
    {"tide of 12.42 h", FW_EFFECT_TIDE, 0, M2, 0.3, -1},
    {"tide that reverses", FW_EFFECT_TIDE, 0, 2400, 0.1, 0.5},
    {"to and fro", FW_EFFECT_TIDE, 0, 2400, 0, 0.5},
    {"added mass, skin drag", FW_EFFECT_ADDED_MASS | FW_EFFECT_SKIN_DRAG, 0, 0, 0, 0},
    {"all, 12.42 h", 0xf0 | FW_EFFECT_DEFLECTED_FLOW, 60, M2, 0.3, -1},
    {"all, reversing", 0xf0 | FW_EFFECT_DEFLECTED_FLOW, 60, 2400, 0.1, 0.5},
};

static fw_model model(double minutes)
{
    fw_model m;
    fw_model_defaults(&m);
    m.window = 60 * minutes;
    return m;
}

static double load(const fw_record *r)
{
    double sum = 0;
    for (size_t k = 0; k < r->n_arcs; k++) sum += fw_record_load(r, 0, FW_RING_LOAD)[k];
    return sum;
}

static fw_record sound(const fw_model *m, const fw_scenario *sc, const char *name)
{
    fw_record r;
    fw_msg    msg = {""};
    assert_int_equal(fw_realise(m, sc, NULL, &r, &msg), FW_OK);
    if (r.status != FW_OK) fail_msg("%s, window %d: %s", name, (int)sc->id, r.cause);
    assert_true(r.energy_relative <= 1e-10 && r.momentum_relative <= 1e-10 && r.wear_conservation <= 1e-10);
    assert_true(r.energy_truncation <= m->accuracy);
    return r;
}

static void none_fails(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof KINDS / sizeof KINDS[0]; k++) {
        const kind *to = &KINDS[k];
        double      sum = 0, tries = 0, cpu = 0;
        for (int id = 1; id <= N_WINDOWS; id++) {
            fw_model    m = model(20);
            fw_scenario sc = {.seed = 7, .id = (uint64_t)id, .concentration = 0.4, .speed = 1};
            m.effects |= to->effects;
            if (to->effects & FW_EFFECT_WIND) sc.wind_speed = 15, sc.wind_angle = to->wind_angle * PI / 180;
            if (to->period > 0) m.tide.period = to->period, m.tide.minor_ratio = to->minor;
            sc.tide_phase = to->phase < 0 ? 2 * PI * fmod(0.618 * id, 1) : to->phase * PI;
            fw_record r = sound(&m, &sc, to->name);
            sum += load(&r), tries += r.tries, cpu += r.host_cpu_s;
            fw_record_free(&r);
        }
        print_message("%-22s load %.3g MPa^m km  tries %g  CPU %.3f s a window\n", to->name, sum / N_WINDOWS, tries / N_WINDOWS, cpu / N_WINDOWS);
        assert_true(sum > 0);
    }
}

/* Ice so thin that a window has a hit or none: what balances are measured against is next to nothing. */
static void none_fails_in_sparse_ice(void **state)
{
    (void)state;
    const kind *const some[] = {&KINDS[1], &KINDS[5], &KINDS[8], &KINDS[9]};
    for (size_t k = 0; k < sizeof some / sizeof some[0]; k++) {
        double tries = 0;
        for (int id = 0; id < 150; id++) {
            fw_model    m = model(5);
            fw_scenario sc = {.seed = 7, .id = (uint64_t)id, .concentration = id % 3 == 2 ? 0.1 : 0.02, .speed = 1};
            m.effects |= some[k]->effects;
            if (some[k]->effects & FW_EFFECT_WIND) sc.wind_speed = 15, sc.wind_angle = some[k]->wind_angle * PI / 180;
            if (some[k]->period > 0) m.tide.period = some[k]->period, m.tide.minor_ratio = some[k]->minor;
            sc.tide_phase = some[k]->phase < 0 ? 2 * PI * fmod(0.618034 * id, 1) : some[k]->phase * PI;
            fw_record r = sound(&m, &sc, some[k]->name);
            tries += r.tries - 1;
            fw_record_free(&r);
        }
        print_message("%-22s %g of 150 windows needed a second try\n", some[k]->name, tries);
        assert_true(tries <= 15);
    }
}

/* Wind that is faster with the ice than the water is, from anywhere; against a slow current ice comes from behind the structure. */
static void strong_wind_over_slow_water(void **state)
{
    (void)state;
    for (int id = 0; id < 4; id++) {
        fw_model    m = model(20);
        fw_scenario sc = {.seed = 5, .id = (uint64_t)id, .concentration = 0.4, .speed = 0.03, .wind_speed = 25, .wind_angle = 0.5 * PI * id};
        m.effects |= FW_EFFECT_WIND, m.warm_up = 300;
        fw_record r = sound(&m, &sc, "strong wind");
        size_t    n = r.n_arcs;
        double    all = load(&r), there = 0;
        for (size_t k = n / 4; k < n - n / 4; k++) there += fw_record_load(&r, 0, FW_RING_LOAD)[k];
        print_message("wind to %3d deg: load %.2g, %.0f %% on the downstream half\n", 90 * id, all, 100 * there / all);
        assert_true(all > 0 && r.hits > 3);
        assert_true(id == 0 ? there < 0.1 * all : id == 2 ? there > 0.9 * all : there > 0.1 * all && there < 0.9 * all);
        fw_record_free(&r);
    }
}

/* A course that falls to nothing does so whatever the segments are that it is cut into. */
static void the_current_goes_on_changing(void **state)
{
    (void)state;
    double sum[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        for (int id = 0; id < 3; id++) {
            fw_course_row rows[2] = {{0, 1, 0}, {191 + k, 0, 0}};
            fw_model      m = model(10);
            fw_scenario   sc = {.seed = 7, .id = (uint64_t)id, .concentration = 0.4, .speed = 1};
            m.effects |= FW_EFFECT_TIDE, m.tide.rows = rows, m.tide.n_rows = 2;
            fw_record r = sound(&m, &sc, "course to nothing");
            sum[k] += load(&r);
            fw_record_free(&r);
        }
    print_message("to nothing in 191, 192, 193 s: %.3g, %.3g, %.3g\n", sum[0], sum[1], sum[2]);
    CHECK_RELATIVE(sum[1], sum[0], 0.3);
    CHECK_RELATIVE(sum[1], sum[2], 0.3);
}

/* The same of a tide whose 115th segment ends where the window begins, but for a rounding either way. */
static void the_tide_goes_on_turning(void **state)
{
    (void)state;
    double sum[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        for (int id = 0; id < 3; id++) {
            fw_model    m = model(3);
            fw_scenario sc = {.seed = 7, .id = (uint64_t)id, .concentration = 0.4, .speed = 1, .tide_phase = PI / 4};
            m.effects |= FW_EFFECT_TIDE, m.tide.period = 720, m.warm_up = 115 * (0.005 * 720 / (2 * PI));
            if (k != 1) m.warm_up = nextafter(m.warm_up, k ? INFINITY : 0);
            fw_record r = sound(&m, &sc, "tide to slack water");
            sum[k] += load(&r);
            fw_record_free(&r);
        }
    print_message("to slack water from a rounding before, at, after: %.3g, %.3g, %.3g\n", sum[0], sum[1], sum[2]);
    CHECK_RELATIVE(sum[0], sum[1], 0.1);
    CHECK_RELATIVE(sum[2], sum[1], 0.1);
}

/* A current that jumps is cut up there and nowhere else, as far as it makes a way meanwhile; each segment has the course's value at its middle. */
static void segments_follow_the_course(void **state)
{
    (void)state;
    static fw_course_row rows[] = {{0, 1, 0}, {900, 1, 0}, {910, -1, 0}, {1800, -1, 1}, {1800.001, 1, 1}};
    fw_model             m = model(40);
    fw_scenario          sc = {.speed = 2};
    fw_setup             set = {0};
    fw_weather           w;
    m.effects |= FW_EFFECT_TIDE, m.tide.rows = rows, m.tide.n_rows = 5;
    assert_int_equal(fw_weather_init(&w, &set, &m, &sc, 60, m.window, -1, NULL), FW_OK);
    double n = 0, t = 0, end, ux = 2, uy = 0;
    for (; (end = fw_weather_segment_end(&w, t)) < INFINITY; t = end, n++) {
        fw_flow f = fw_weather_flow(&w, t);
        double  at = 0.5 * (t + end) - 60, factor = at < 900 ? 1 : at < 910 ? 1 - 0.2 * (at - 900) : at < 1800 ? -1 : -1 + 2000 * (at - 1800), turn = at < 910 ? 0 : at > 1800 ? 1 : (at - 910) / 890;
        assert_true(end > t && (at > 1800 || hypot(f.ux - ux, f.uy - uy) <= 2 * 0.005 * 1.001));
        CHECK_NEAR(f.ux, 2 * factor * cos(turn), 1e-6);
        CHECK_NEAR(f.uy, 2 * factor * sin(turn), 1e-6);
        ux = f.ux, uy = f.uy;
    }
    CHECK_NEAR(t, 1860.001, 1e-9);
    CHECK_NEAR(n, 1 + 2 / 0.005 + 1 / 0.005 + 1, 1); /* warm-up and the first 15 minutes are one, and 2 mm of way */
    CHECK_NEAR(fw_weather_flow(&w, 5000).ux, 2 * cos(1), 1e-9);
}

/* The fixed-step methods step the same ice wherever the wind brings it from: nearly the same load, hit by hit. */
static void fixed_steps_in_the_wind(void **state)
{
    (void)state;
    for (int turn = 0; turn < 4; turn++) {
        double sum[2] = {0, 0}, hits[2] = {0, 0};
        for (int id = 0; id < 6; id++)
            for (int k = 0; k < 2; k++) {
                fw_model    m = model(10);
                fw_scenario sc = {.seed = 5, .id = (uint64_t)id, .concentration = 0.3, .speed = 0.05, .wind_speed = 25, .wind_angle = 0.5 * PI * turn};
                m.effects |= FW_EFFECT_WIND, m.warm_up = 200;
                if (k) m.numerics = (fw_numerics){.scheme = FW_SCHEME_VERLET, .step = 4e-3};
                fw_record r = sound(&m, &sc, "fixed steps");
                sum[k] += load(&r), hits[k] += r.hits;
                fw_record_free(&r);
            }
        print_message("wind to %3d deg: %g and %g hits, load %.3g and %.3g\n", 90 * turn, hits[0], hits[1], sum[0], sum[1]);
        CHECK_RELATIVE(sum[1], sum[0], 0.05);
        CHECK_RELATIVE(hits[1], hits[0], 0.05);
    }
}

/* Turned by any angle the ice is another, but the law of it is the same: the ring's centre of load turns along. */
static void load_turns_with_the_current(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        double turn = (37 + 100 * k) * PI / 180, x = 0, y = 0;
        for (int id = 0; id < 6; id++) {
            fw_course_row rows[2] = {{0, 1, turn}, {600, 1, turn}};
            fw_model      m = model(10);
            fw_scenario   sc = {.seed = 9, .id = (uint64_t)id, .concentration = 0.4, .speed = 1};
            m.effects |= FW_EFFECT_TIDE, m.tide.rows = rows, m.tide.n_rows = 2;
            fw_record r = sound(&m, &sc, "turned");
            for (size_t i = 0; i < r.n_arcs; i++) {
                double theta = ((double)i + 0.5) * 2 * PI / (double)r.n_arcs, q = fw_record_load(&r, 0, FW_RING_LOAD)[i];
                x += q * cos(theta), y += q * sin(theta);
            }
            fw_record_free(&r);
        }
        double off = remainder(atan2(y, x) + turn, 2 * PI); /* theta is clockwise from the side that the current meets, turn anticlockwise */
        print_message("current turned by %.0f deg: centre of load %.1f deg off\n", turn * 180 / PI, off * 180 / PI);
        CHECK_NEAR(off, 0, 12 * PI / 180);
    }
}

static void records_repeat(void **state)
{
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        unsigned char *bytes[2];
        size_t         size = 0;
        for (int n = 0; n < 2; n++) {
            fw_model    m = model(10);
            fw_scenario sc = {.seed = 11, .id = 3, .concentration = 0.4, .speed = 1, .wind_speed = 15, .wind_angle = 1, .tide_phase = 0.5 * PI};
            m.effects |= 0xf0 | FW_EFFECT_DEFLECTED_FLOW;
            m.tide.period = k ? M2 : 1200, m.tide.minor_ratio = -0.2;
            fw_record r = sound(&m, &sc, "repeated");
            r.host_cpu_s = 0;
            size = fw_record_packed_size(r.n_arcs, r.n_laws);
            bytes[n] = malloc(size);
            fw_record_pack(&r, bytes[n]);
            fw_record_free(&r);
        }
        assert_memory_equal(bytes[0], bytes[1], size);
        free(bytes[0]);
        free(bytes[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(none_fails), cmocka_unit_test(none_fails_in_sparse_ice), cmocka_unit_test(strong_wind_over_slow_water),
                                       cmocka_unit_test(the_current_goes_on_changing), cmocka_unit_test(the_tide_goes_on_turning),
                                       cmocka_unit_test(segments_follow_the_course), cmocka_unit_test(load_turns_with_the_current),
                                       cmocka_unit_test(records_repeat), cmocka_unit_test(fixed_steps_in_the_wind)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
