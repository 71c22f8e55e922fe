/* The swept strip against closed forms, against hits solved one by one, and against the kernel's own windows of ice whose floes do not meet each other:
 * there the two must agree in the mean, though one packs fields and follows hundreds of floes and the other solves some hits. */
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "check.h"
#include "floewear/realisation.h"
#include "study/swept.h"

enum { N_ARCS = 360 };

/* The default model and a second, thinner mix. */
static fw_model two_mixes(void)
{
    fw_model m;
    fw_model_defaults(&m);
    m.n_mixes = 2;
    m.mixes[0].probability = 0.6;
    m.mixes[1] = (fw_thickness_mix){.probability = 0.4, .n_classes = 2, .classes = {{0.5, 2.0 / 3}, {0.7, 1.0 / 3}}};
    return m;
}

static fw_swept made(const fw_model *m, double slowest, double fastest)
{
    fw_swept s;
    fw_msg   msg = {""};
    if (fw_swept_make(&s, m, slowest, fastest, 0, &msg) != FW_OK) fail_msg("%s", msg.text);
    return s;
}

static double sum_of(const double *ring)
{
    double sum = 0;
    for (size_t k = 0; k < N_ARCS; k++) sum += ring[k];
    return sum;
}

/* D uniform in [4h, sqrt(130h - 11)] of two classes: E[D], E[A] in closed form. */
static void hits_are_the_closed_form(void **state)
{
    (void)state;
    fw_model m = two_mixes();
    fw_swept s = made(&m, 0.5, 1);
    double   diameter = 0, area = 0;
    for (size_t k = 0; k < 2; k++) {
        double h = m.mixes[1].classes[k].thickness, low = 4 * h, high = sqrt(130 * h - 11), share = m.mixes[1].classes[k].share;
        diameter += share * (low + high) / 2;
        area += share * 3.14159265358979324 / 4 * (low * low + low * high + high * high) / 3;
    }
    fw_scenario sc = {.concentration = 0.3, .speed = 0.7, .mix = 1};
    CHECK_RELATIVE(fw_swept_hits(&s, &sc), 0.3 * 0.7 * 10800 * (7.4 + diameter) / area, 1e-12);
    assert_true(s.force_evaluations < 30000); /* classes that mixes share are solved once: 300 hits at two speeds */
    fw_swept_free(&s);
}

static void load_goes_with_concentration_and_a_power_of_speed(void **state)
{
    (void)state;
    fw_model    m = two_mixes();
    fw_swept    s = made(&m, 0.1, 2);
    fw_scenario a = {.concentration = 0.1, .speed = 0.3, .mix = 0}, b = a;
    double      one[N_ARCS], other[N_ARCS], var_one[N_ARCS], var_other[N_ARCS];
    b.concentration = 0.4;
    fw_swept_ring(&s, &a, one, var_one), fw_swept_ring(&s, &b, other, var_other);
    for (size_t k = 0; k < N_ARCS; k++) {
        CHECK_RELATIVE(other[k], 4 * one[k], 1e-12);
        CHECK_RELATIVE(var_other[k], 4 * var_one[k], 1e-12);
    }
    CHECK_RELATIVE(fw_swept_hits(&s, &b), 4 * fw_swept_hits(&s, &a), 1e-12);
    /* beyond the last node: rate x a hit's load, u x u^power */
    a.speed = 2, b = a, b.speed = 4;
    fw_swept_ring(&s, &a, one, NULL), fw_swept_ring(&s, &b, other, NULL);
    CHECK_RELATIVE(sum_of(other), pow(2, 1 + s.power) * sum_of(one), 1e-12);
    CHECK_RELATIVE(fw_swept_hits(&s, &b), 2 * fw_swept_hits(&s, &a), 1e-12);
    assert_true(s.power > 1.9 && s.power < 2.2);
    /* ice that stands still is taken as the slowest current that is simulated */
    a.speed = 0, b.speed = FW_SLOWEST;
    CHECK_RELATIVE(fw_swept_hits(&s, &a), fw_swept_hits(&s, &b), 1e-15);
    /* a speed between two nodes against hits at that speed */
    fw_swept t = made(&m, 0.3, 0.6);
    a.speed = 0.6;
    fw_swept_ring(&s, &a, one, NULL), fw_swept_ring(&t, &a, other, NULL);
    CHECK_RELATIVE(sum_of(one), sum_of(other), 0.02);
    fw_swept_free(&t);
    fw_swept_free(&s);
}

static void ring_is_even_and_shares_are_rows(void **state)
{
    (void)state;
    fw_model       m = two_mixes();
    fw_swept       s = made(&m, 0.2, 1);
    fw_scenario    sc = {.concentration = 0.4, .speed = 0.5, .mix = 1};
    double         load[N_ARCS], variance[N_ARCS];
    fw_swept_share a = fw_swept_share_of(&s, &sc);
    fw_swept_ring(&s, &sc, load, variance);
    for (size_t k = 0; k < N_ARCS; k++) {
        CHECK_RELATIVE(load[k], load[N_ARCS - 1 - k], 1e-12);
        CHECK_RELATIVE(load[k], a.share[0] * s.load[a.row * N_ARCS + k] + a.share[1] * s.load[(a.row + 1) * N_ARCS + k], 1e-12);
        assert_true(load[k] >= 0 && variance[k] >= 0 && (variance[k] == 0 || load[k] > 0));
    }
    assert_true(load[180] == 0 && load[45] > 2 * load[5] && load[45] > 2 * load[75]);
    fw_swept_free(&s);
}

/* The sum over the ring against hits solved one by one: 4000 floes of one class at stratified places, none of them a node of the strip. */
static void ring_is_the_sum_over_hits(void **state)
{
    (void)state;
    enum { N = 4000 };
    fw_model m;
    fw_model_defaults(&m);
    m.mixes[0].n_classes = 1, m.mixes[0].classes[0] = (fw_thickness_class){0.7, 1};
    fw_swept  s = made(&m, 0.5, 1);
    double    low = 2.8, high = sqrt(130 * 0.7 - 11), sum = 0, squares = 0, ring[N_ARCS] = {0}, load[N_ARCS];
    fw_random r;
    fw_random_stream(&r, 11, FW_STREAM_TEST, 0, 0);
    for (size_t i = 0; i < N; i++) {
        double   D = low + (high - low) * fw_random_uniform(&r), reach = 3.7 + D / 2, y = reach * (2 * ((double)i + fw_random_uniform(&r)) / N - 1);
        fw_floe  floe = {.x = -sqrt(reach * reach - y * y) - 0.1, .y = y, .diameter = D, .thickness = 0.7, .vx = 1};
        fw_scene scene = {.model = m, .speed = 1, .temperature = -10, .duration = 150, .n_floes = 1, .floes = &floe};
        fw_scene_result out;
        assert_int_equal(fw_scene_run(&scene, NULL, NULL, &out, NULL), FW_OK);
        double own = 2 * reach * sum_of(fw_record_load(&out.record, 0, FW_RING_LOAD)) / N;
        for (size_t k = 0; k < N_ARCS; k++) ring[k] += 2 * reach * fw_record_load(&out.record, 0, FW_RING_LOAD)[k] / N;
        sum += own, squares += own * own;
        fw_scene_result_free(&out);
    }
    double error = sqrt(squares - sum * sum / N); /* of the sum, were places not stratified: an upper bound */
    fw_scenario sc = {.concentration = 0.1, .speed = 1};
    fw_swept_ring(&s, &sc, load, NULL);
    double per_metre = 0.1 * 10800 / s.area[0];
    CHECK_NEAR(sum_of(load), per_metre * sum, per_metre * (2 * error + 0.01 * sum));
    for (size_t from = 0; from < 75; from += 15) { /* fifteen degrees and their mirror image */
        double got = 0, wanted = 0;
        for (size_t k = from; k < from + 15; k++) got += load[k], wanted += per_metre * 0.5 * (ring[k] + ring[N_ARCS - 1 - k]);
        CHECK_RELATIVE(got, wanted, 0.08);
    }
    fw_swept_free(&s);
}

typedef struct mean {
    double n, sum, squares;
} mean;
static void   add(mean *a, double x) { a->n++, a->sum += x, a->squares += x * x; }
static double mean_of(const mean *a) { return a->sum / a->n; }
static double error_of(const mean *a) { return sqrt(fmax(0, a->squares - a->sum * a->sum / a->n) / (a->n - 1) / a->n); }

/* share: what the strip itself may be off. */
static void check_mean(const char *what, const mean *windows, double strip, double share)
{
    if (fabs(mean_of(windows) - strip) > 4 * error_of(windows) + share * strip)
        fail_msg("%s: windows %g +- %g, strip %g", what, mean_of(windows), error_of(windows), strip);
}

static void check_windows(const fw_model *m, const fw_scenario *sc, const fw_swept *s, size_t n, bool has_loads)
{
    enum { SECTORS = 6 };
    mean     hits = {0}, all = {0}, sectors[SECTORS] = {{0}}, off = {0};
    double   load[N_ARCS], variance[N_ARCS];
    fw_swept_ring(s, sc, load, variance);
    double load_per_square = 0;
    for (size_t k = 0; k < N_ARCS; k++) load_per_square += variance[k];
    for (size_t i = 0; i < n; i++) {
        fw_scenario own = *sc;
        fw_record   r;
        own.seed = 5, own.id = i;
        assert_int_equal(fw_realise(m, &own, NULL, &r, NULL), FW_OK);
        assert_int_equal(r.status, FW_OK);
        const double *ring = fw_record_load(&r, 0, FW_RING_LOAD);
        double        squares = 0;
        add(&hits, r.hits);
        add(&all, sum_of(ring));
        for (size_t k = 0; k < N_ARCS; k++) squares += (ring[k] - load[k]) * (ring[k] - load[k]);
        add(&off, squares);
        for (size_t q = 0; q < SECTORS; q++) {
            double sum = 0;
            for (size_t k = 15 * q; k < 15 * q + 15; k++) sum += ring[k] + ring[N_ARCS - 1 - k];
            add(&sectors[q], sum);
        }
        fw_record_free(&r);
    }
    if (sc->speed >= 0.5) check_mean("hits", &hits, fw_swept_hits(s, sc), 0.01); /* slower floes bounce for more than a second */
    if (!has_loads) return;
    check_mean("load", &all, sum_of(load), 0.005);
    for (size_t q = 0; q < SECTORS; q++) {
        double sum = 0;
        for (size_t k = 15 * q; k < 15 * q + 15; k++) sum += load[k] + load[N_ARCS - 1 - k];
        check_mean("load of a sector", &sectors[q], sum, q == 0 || q == 5 ? 0.1 : 0.03);
    }
    check_mean("variance of load, summed over arcs", &off, load_per_square, 0.05);
}

static void windows_of_floes_that_do_not_meet_agree(void **state)
{
    (void)state;
    fw_model m = two_mixes();
    m.effects &= ~(uint32_t)FW_EFFECT_FLOE_CONTACT;
    fw_swept s = made(&m, 0.1, 2);
    check_windows(&m, &(fw_scenario){.concentration = 0.05, .speed = 1, .mix = 0}, &s, 60, true);
    check_windows(&m, &(fw_scenario){.concentration = 0.02, .speed = 0.3, .mix = 1}, &s, 60, true);
    check_windows(&m, &(fw_scenario){.concentration = 0.4, .speed = 0.5, .mix = 1}, &s, 12, true);
    fw_swept_free(&s);
}

static void windows_of_thin_ice_touch_as_often(void **state)
{
    (void)state;
    fw_model m = two_mixes();
    fw_swept s = made(&m, 0.5, 2);
    check_windows(&m, &(fw_scenario){.concentration = 0.01, .speed = 2, .mix = 0}, &s, 60, true);
    check_windows(&m, &(fw_scenario){.concentration = 0.05, .speed = 1, .mix = 1}, &s, 30, false);
    fw_swept_free(&s);
}

/* Effects come along: hits without friction wear more, water that goes round the structure takes floes with it. */
static void effects_come_along(void **state)
{
    (void)state;
    fw_model m = two_mixes();
    m.n_mixes = 1, m.mixes[0].probability = 1;
    fw_scenario sc = {.concentration = 0.1, .speed = 1};
    double      load[N_ARCS];
    fw_swept    s = made(&m, 0.7, 1);
    fw_swept_ring(&s, &sc, load, NULL);
    double plain = sum_of(load);
    fw_swept_free(&s);

    m.effects &= ~(uint32_t)FW_EFFECT_FRICTION;
    s = made(&m, 0.7, 1);
    fw_swept_ring(&s, &sc, load, NULL);
    assert_true(sum_of(load) > 2 * plain);
    fw_swept_free(&s);

    m.effects |= FW_EFFECT_FRICTION | FW_EFFECT_DEFLECTED_FLOW;
    s = made(&m, 0.7, 1);
    fw_swept_ring(&s, &sc, load, NULL);
    assert_true(sum_of(load) < plain);
    fw_swept_free(&s);

    /* what takes a window is left out: the same strip, bit for bit */
    m.effects = FW_EFFECTS_CORE | FW_EFFECT_WIND | FW_EFFECT_TIDE;
    s = made(&m, 0.7, 1);
    fw_swept_ring(&s, &sc, load, NULL);
    assert_true(sum_of(load) == plain);
    fw_swept_free(&s);
}

static void wrong_questions_are_refused(void **state)
{
    (void)state;
    fw_model m = two_mixes();
    fw_swept s;
    fw_msg   msg = {""};
    assert_int_equal(fw_swept_make(&s, &m, 0.1, 1, 1, &msg), FW_E_ARG);
    assert_int_equal(fw_swept_make(&s, &m, 1, 0.1, 0, &msg), FW_E_ARG);
    assert_int_equal(fw_swept_make(&s, &m, 0, 1, 0, &msg), FW_E_ARG);
    assert_int_equal(fw_swept_make(&s, &m, 1, INFINITY, 0, &msg), FW_E_ARG);
    fw_swept_free(&s);
    fw_swept_free(NULL);
    s = made(&m, 1, 1); /* one speed is enough of a range */
    assert_true(s.n_speeds == 2);
    fw_swept_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_are_the_closed_form),
        cmocka_unit_test(load_goes_with_concentration_and_a_power_of_speed),
        cmocka_unit_test(ring_is_even_and_shares_are_rows),
        cmocka_unit_test(ring_is_the_sum_over_hits),
        cmocka_unit_test(windows_of_floes_that_do_not_meet_agree),
        cmocka_unit_test(windows_of_thin_ice_touch_as_often),
        cmocka_unit_test(effects_come_along),
        cmocka_unit_test(wrong_questions_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
