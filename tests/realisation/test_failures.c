/* Failures: counted, named, tried again with finer steps; records of failed ones are pure functions too. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"
#include "physics/crush.h"

static const fw_scenario SPARSE = {.seed = 7, .concentration = 0.1, .speed = 0.5};

static fw_record run(const fw_model *m, fw_scenario s, uint64_t id)
{
    fw_record r;
    fw_msg    msg = {""};
    s.id = id;
    if (fw_realise(m, &s, NULL, &r, &msg) != FW_OK) fail_msg("%s", msg.text);
    return r;
}

static void expect_same_bits(const fw_model *m, const fw_scenario *s, fw_record *r)
{
    fw_record      again = run(m, *s, r->id);
    size_t         n = fw_record_packed_size(r->n_arcs, r->n_laws);
    unsigned char *p = malloc(n), *q = malloc(n);
    r->host_cpu_s = again.host_cpu_s = 0;
    fw_record_pack(r, p), fw_record_pack(&again, q);
    assert_memory_equal(p, q, n);
    free(p), free(q);
    fw_record_free(&again);
}

static void has_piece(const fw_record *r, const char *piece)
{
    if (!strstr(r->cause, piece)) fail_msg("no \"%s\" in: %s", piece, r->cause);
}

static bool is_empty(const fw_record *r)
{
    for (size_t i = 0; i < fw_record_n_rings(r->n_arcs, r->n_laws); i++)
        if (r->rings[i] != 0) return false;
    return true;
}

/* No second try: finer steps cost more. */
static void too_many_evaluations(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    m.window = 3600;
    fw_record free_one = run(&m, SPARSE, 3);
    assert_int_equal(free_one.status, FW_OK);
    m.max_evaluations = floor(free_one.force_evaluations / 2);
    fw_record r = run(&m, SPARSE, 3);
    assert_int_equal(r.status, FW_E_LIMIT);
    has_piece(&r, "force evaluations");
    assert_true(r.tries == 1 && is_empty(&r) && r.failed_at > 0 && r.failed_at < r.window + r.warm_up);
    /* seen when it is passed, not at the end */
    assert_true(r.force_evaluations > m.max_evaluations && r.force_evaluations < m.max_evaluations + 1000);
    expect_same_bits(&m, &SPARSE, &r);
    m.max_evaluations = free_one.force_evaluations;
    fw_record enough = run(&m, SPARSE, 3);
    assert_int_equal(enough.status, FW_OK);
    fw_record_free(&free_one), fw_record_free(&r), fw_record_free(&enough);
}

/* A spring of 30 kN/m lets a floe of 120 t at 2 m/s through: v sqrt(m / k) / e = 1.5 m deep without a current, which presses on with as much again. */
static void soft_contact(fw_model *m, fw_scenario *s)
{
    fw_model_defaults(m);
    m->stiffness = 3e4, m->window = 600;
    m->mixes[0].n_classes = 1, m->mixes[0].classes[0] = (fw_thickness_class){1.3, 1};
    *s = (fw_scenario){.seed = 7, .concentration = 0.03, .speed = 2};
}

static void goes_through(void **state)
{
    (void)state;
    fw_model    m;
    fw_scenario s;
    size_t      n_failed = 0;
    soft_contact(&m, &s);
    for (uint64_t id = 0; id < 20; id++) {
        fw_record r = run(&m, s, id);
        if (r.status != FW_OK) {
            n_failed++;
            assert_int_equal(r.status, FW_E_NUMERIC);
            has_piece(&r, "finer steps too: floe ");
            has_piece(&r, "m, h 1.3 m)");
            has_piece(&r, "at t = ");
            assert_true(r.tries == 2 && is_empty(&r) && r.failed_at > 0);
            expect_same_bits(&m, &s, &r);
        }
        fw_record_free(&r);
    }
    assert_true(n_failed > 0);
}

/* The limit holds for both tries together; a second one that meets it leaves the first one's failure, and says both. */
static void limit_of_both_tries(void **state)
{
    (void)state;
    fw_model    m;
    fw_scenario s;
    soft_contact(&m, &s);
    for (uint64_t id = 0; id < 20; id++) {
        fw_record r = run(&m, s, id);
        if (r.status == FW_E_NUMERIC) {
            fw_model tight = m;
            tight.max_evaluations = floor(0.6 * r.force_evaluations);
            fw_record both = run(&tight, s, id);
            assert_true(both.status == FW_E_NUMERIC && both.tries == 2 && both.force_evaluations < r.force_evaluations);
            has_piece(&both, "first try: floe ");
            has_piece(&both, "; finer steps: more than ");
            expect_same_bits(&tight, &s, &both);
            fw_record_free(&both), fw_record_free(&r);
            return;
        }
        fw_record_free(&r);
    }
    fail_msg("nobody failed");
}

/* What a failed window looks like shortly before: alone, and it fails the same way. */
static void excerpt(void **state)
{
    (void)state;
    fw_model    m;
    fw_scenario s;
    bool        is_seen = false;
    soft_contact(&m, &s);
    for (uint64_t id = 0; id < 20 && !is_seen; id++) {
        fw_record       r = run(&m, s, id);
        fw_scene        scene;
        fw_scene_result out;
        fw_msg          msg = {""};
        if (r.status != FW_OK) {
            s.id = id;
            assert_int_equal(fw_realise_excerpt(&m, &s, r.failed_at - 3, 10, NULL, &scene, &msg), FW_OK);
            assert_true(scene.n_floes > 0 && scene.n_floes < 100 && scene.speed == 2);
            for (size_t i = 0; i < scene.n_floes; i++)
                for (size_t k = 0; k < i; k++) {
                    const fw_floe *a = &scene.floes[i], *b = &scene.floes[k];
                    assert_true(a->x != b->x || a->y != b->y); /* nobody twice */
                }
            assert_int_equal(fw_scene_run(&scene, NULL, NULL, &out, &msg), FW_E_NUMERIC);
            is_seen = true;
            fw_scene_result_free(&out);
            fw_scene_free(&scene);
        }
        fw_record_free(&r);
    }
    assert_true(is_seen);
}

/* With the wind behind it ice comes three times as fast as the current: all that comes within the scene's time is there. */
static void excerpt_in_the_wind(void **state)
{
    (void)state;
    fw_model    m;
    fw_scenario s = {.seed = 3, .id = 1, .concentration = 0.1, .speed = 0.05, .wind_speed = 25};
    fw_scene    scene;
    fw_msg      msg = {""};
    double      farthest = 0, way = (0.05 + 0.003 * 25) * 2000; /* floes drift by 0.4 % of the wind or so */
    fw_model_defaults(&m);
    m.effects |= FW_EFFECT_WIND, m.warm_up = 0;
    if (fw_realise_excerpt(&m, &s, 10, 2000, NULL, &scene, &msg) != FW_OK) fail_msg("%s", msg.text);
    for (size_t i = 0; i < scene.n_floes; i++) farthest = fmax(farthest, -scene.floes[i].x);
    assert_true(farthest > way);
    fw_scene_free(&scene);
}

/* A scene has one current. In another one than the tide's largest springs from the pressure are as stiff as they were. */
static void excerpt_keeps_stiffness(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        fw_model    m;
        fw_scenario s = {.seed = 3, .id = 1, .concentration = 0.1, .speed = 1, .tide_phase = 1};
        fw_scene    scene;
        fw_msg      msg = {""};
        fw_model_defaults(&m);
        m.effects |= FW_EFFECT_TIDE, m.stiffness_from_pressure = true, m.crush.law.exponent = 0.3 * k;
        m.window = 60, m.warm_up = 0, m.tide.period = 3600;
        if (fw_realise_excerpt(&m, &s, 10, 5, NULL, &scene, &msg) != FW_OK) fail_msg("%s", msg.text);
        CHECK_RELATIVE(scene.speed, cos(1 - 2 * acos(-1) * 20 / 3600), 0.005); /* phase is the middle's */
        CHECK_RELATIVE(fw_crush_stiffness(&scene.model.crush.law, 2e4, scene.speed, 1.5, 0.9), fw_crush_stiffness(&m.crush.law, 2e4, 1, 1.5, 0.9), 1e-3);
        fw_scene_free(&scene);
    }
}

/* One window of some thousand has an energy balance beyond 1 % at its first try, and the tenth of the tolerances cures it. */
static void cured_by_finer_steps(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    m.window = 300, m.warm_up = 0;
    size_t n_cured = 0;
    for (uint64_t id = 0; id < 4000; id++) {
        fw_record r = run(&m, SPARSE, id);
        assert_int_equal(r.status, FW_OK);
        assert_true(r.energy_truncation <= m.accuracy);
        if (r.tries == 2) {
            n_cured++;
            has_piece(&r, "first try: energy balance of the trajectory");
            assert_true(!is_empty(&r) && r.failed_at == 0 && r.hits > 0 && r.energy_truncation < 0.2 * m.accuracy);
            expect_same_bits(&m, &SPARSE, &r);
        } else {
            assert_true(r.tries == 1 && r.cause[0] == 0);
        }
        fw_record_free(&r);
    }
    print_message("%zu of 4000 windows took a second try\n", n_cured);
    assert_true(n_cured > 0 && n_cured < 40);
}

typedef struct film {
    size_t n, n_starts;
    double last;
} film;

static fw_status take(void *self, double t, size_t n_floes, const fw_floe *floes, fw_msg *m)
{
    film *f = self;
    (void)n_floes, (void)floes, (void)m;
    if (t == 0)
        f->n_starts++, f->n = 0;
    else
        assert_true(t > f->last);
    f->last = t, f->n++;
    return FW_OK;
}

/* Frames of a scene that is tried again begin again at 0. */
static void frames_begin_again(void **state)
{
    (void)state;
    fw_floe  floe = {.x = -12, .y = 0.1, .diameter = 11.5, .thickness = 1.3, .vx = 2};
    fw_scene scene = {.speed = 2, .temperature = -10, .duration = 20, .n_floes = 1, .floes = &floe};
    film     f = {0};
    fw_model_defaults(&scene.model);
    scene.model.stiffness = 3e3;
    fw_frame_sink   sink = {.frame = take, .self = &f, .interval = 0.1};
    fw_scene_result out;
    fw_msg          msg = {""};
    assert_int_equal(fw_scene_run(&scene, NULL, &sink, &out, &msg), FW_E_NUMERIC);
    assert_true(f.n_starts == 2 && f.n > 5 && out.record.tries == 2);
    has_piece(&out.record, "finer steps too: floe 1 ");
    assert_non_null(strstr(msg.text, "floe 1 "));
    fw_scene_result_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(too_many_evaluations), cmocka_unit_test(goes_through), cmocka_unit_test(limit_of_both_tries),
                                       cmocka_unit_test(excerpt), cmocka_unit_test(excerpt_in_the_wind), cmocka_unit_test(excerpt_keeps_stiffness),
                                       cmocka_unit_test(cured_by_finer_steps),
                                       cmocka_unit_test(frames_begin_again)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
