/* The defaults of strip width, downstream reach, warm-up and ring, each against something larger, on the same ice where that is
 * possible (tiles are a pure function of seed and id, so a wider strip only adds floes). 40 %, 2 m/s: at higher concentration single
 * windows decouple and only means over fields could be compared. */
#include "check.h"
#include "floewear/realisation.h"

static double load_of(fw_model m, uint64_t id)
{
    fw_scenario s = {.seed = 42, .id = id, .concentration = 0.4, .speed = 2};
    fw_record   r;
    fw_msg      msg = {""};
    if (fw_realise(&m, &s, NULL, &r, &msg) != FW_OK || r.status != FW_OK) fail_msg("%s%s", msg.text, r.cause);
    double sum = 0;
    for (size_t k = 0; k < r.n_arcs; k++) sum += fw_record_load(&r, 0, FW_RING_LOAD)[k] / (double)r.n_arcs;
    fw_record_free(&r);
    return sum;
}

static fw_model model(void)
{
    fw_model m;
    fw_model_defaults(&m);
    m.window = 600;
    return m;
}

static double sum_of(fw_model m)
{
    double sum = 0;
    for (uint64_t id = 0; id < 20; id++) sum += load_of(m, id); /* one in twenty decouples even so */
    return sum;
}

static void strip_width(void **state)
{
    (void)state;
    fw_model narrow = model(), wide = model(), normal = model();
    narrow.strip_width = 60, wide.strip_width = 160;
    double w60 = sum_of(narrow), w100 = sum_of(normal), w160 = sum_of(wide);
    print_message("60 m: %+.2f %%, 160 m: %+.2f %% of the load at 100 m\n", 100 * (w60 / w100 - 1),
                  100 * (w160 / w100 - 1));
    CHECK_RELATIVE(w160, w100, 0.005);
    CHECK_RELATIVE(w60, w100, 0.03);
}

static void downstream_reach(void **state)
{
    (void)state;
    fw_model far = model();
    far.downstream = 60;
    double d20 = sum_of(model()), d60 = sum_of(far);
    print_message("downstream 60 m: %+.2f %% of the load at 20 m\n", 100 * (d60 / d20 - 1));
    CHECK_RELATIVE(d60, d20, 0.005);
}

static void ring_of_arcs(void **state)
{
    (void)state;
    fw_model coarse = model(), fine = model();
    coarse.n_arcs = 72, fine.n_arcs = 1440;
    double a = load_of(coarse, 1), b = load_of(model(), 1), c = load_of(fine, 1);
    CHECK_RELATIVE(a, b,
                   1e-3); /* arcs only share out what the patch collects; where a patch is set down depends on them */
    CHECK_RELATIVE(c, b, 1e-3);
}

/* The rate after the default warm-up against the rate after four times of it: the same ice, met by another pile. */
static void warm_up(void **state)
{
    (void)state;
    enum { N = 40 };
    fw_model early = model(), late = model();
    early.window = late.window = 60, late.warm_up = 240;
    double sum = 0, sum2 = 0, mean = 0;
    for (uint64_t id = 0; id < N; id++) {
        double a = load_of(early, id), b = load_of(late, id);
        sum += b - a, sum2 += (b - a) * (b - a), mean += a / N;
    }
    double difference = sum / N, error = sqrt((sum2 / N - difference * difference) / N);
    print_message("after 240 s: %+.1f %% +- %.1f %% of the rate after 60 s\n", 100 * difference / mean,
                  100 * error / mean);
    CHECK_NEAR(difference, 0, 4 * error);
    assert_true(error < 0.15 * mean);
}

static fw_record record_of(fw_model m, double concentration, uint64_t id)
{
    fw_scenario s = {.seed = 42, .id = id, .concentration = concentration, .speed = 2};
    fw_record   r;
    fw_msg      msg = {""};
    if (fw_realise(&m, &s, NULL, &r, &msg) != FW_OK || r.status != FW_OK) fail_msg("%s%s", msg.text, r.cause);
    return r;
}

/* Where the disturbance stays inside, a strip of any width is the same window to the last bit, and no floe more is made. */
static void width_is_not_paid_for(void **state)
{
    (void)state;
    fw_model wide = model();
    wide.strip_width = 1000;
    size_t n_same = 0;
    for (uint64_t id = 0; id < 6; id++) {
        fw_record a = record_of(model(), 0.1, id), b = record_of(wide, 0.1, id);
        if (a.floes_made == b.floes_made) {
            n_same++;
            assert_memory_equal(a.rings, b.rings, fw_record_n_rings(a.n_arcs, a.n_laws) * sizeof *a.rings);
            assert_true(a.force_evaluations == b.force_evaluations);
        }
        fw_record_free(&a), fw_record_free(&b);
    }
    assert_true(n_same >= 4);
}

/* The window begins on the same ice however long the warm-up, so runs that differ in it (or in accuracy) can be compared. */
static void window_keeps_its_ice(void **state)
{
    (void)state;
    fw_model usual = model(), longer = model();
    longer.warm_up = 240;
    double sum = 0, sum2 = 0;
    for (uint64_t id = 0; id < 4; id++) {
        fw_record a = record_of(usual, 0.1, id), b = record_of(longer, 0.1, id);
        assert_true(fabs(a.hits - b.hits) <= 2);
        sum += a.normal_impulse, sum2 += b.normal_impulse;
        fw_record_free(&a), fw_record_free(&b);
    }
    CHECK_RELATIVE(sum2, sum, 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(width_is_not_paid_for), cmocka_unit_test(window_keeps_its_ice),
                                       cmocka_unit_test(strip_width), cmocka_unit_test(downstream_reach),
                                       cmocka_unit_test(ring_of_arcs), cmocka_unit_test(warm_up)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
