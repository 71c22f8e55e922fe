/* The effects ledger: laws of a small one, closed forms of temperature, signs and sizes that the single hit and the stream have by other means. */
#include "made_up.h"
#include "study/effects_ledger.h"

static const double M = 1.121; /* exponent of the law */

static const fw_effects_switch SWITCHES[] = {{"floe_contact", FW_EFFECT_FLOE_CONTACT, NULL, "of course"},
                                             {"friction", FW_EFFECT_FRICTION, NULL, "of course"},
                                             {"rotation", FW_EFFECT_ROTATION, NULL, "of course"},
                                             {"form_drag", FW_EFFECT_FORM_DRAG, NULL, "of course"},
                                             {"nothing", 1u << 20, NULL, "of course"}, /* a bit that no part of the program knows */
                                             {"wind", FW_EFFECT_WIND, "there is no wind.speed", "it blows"}};
enum { N_SWITCHES = sizeof SWITCHES / sizeof SWITCHES[0] };

static fw_campaign small_campaign(double *bearings)
{
    fw_campaign c = made_up_campaign(bearings);
    fw_model_defaults(&c.model);
    c.model.mixes[0].n_classes = 1;
    c.model.mixes[0].classes[0] = (fw_thickness_class){0.9, 1}; /* few large floes: cheap */
    c.model.window = 900;
    c.seed = 11;
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    c.site.direction = made_up_law(FW_DIST_NORMAL, 20, 25);
    return c;
}

static void fast(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = -1, .concentration = 0.4, .speed = 2};
}

static void fast_and_slow(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    fast(c, id, out);
    out->speed = id % 2 ? 2 : 0.1;
}

static void thin(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    fast(c, id, out);
    out->concentration = 0.1;
}

static fw_effects_options options(size_t n, double way)
{
    return (fw_effects_options){.scenario = fast, .n_switches = N_SWITCHES, .switches = SWITCHES, .n_windows = n, .way = way};
}

static const fw_effects_row *find(const fw_effects_ledger *l, const char *name, size_t which)
{
    for (size_t i = 0; i < l->n_rows; i++)
        if (strcmp(l->rows[i].name, name) == 0 && which-- == 0) return &l->rows[i];
    fail_msg("no row %s", name);
    return NULL;
}

static bool is_zero(const fw_change *c) { return c->change == 0 && c->low == 0 && c->high == 0; }

/* Shares telescope; CPU seconds add up to those of another run of the same windows. */
static void check_costs(const fw_effects_ledger *l)
{
    double cpu = l->cpu_bare, evaluations = l->evaluations_bare;
    for (size_t i = 0; i < l->n_rows; i++)
        if (isfinite(l->rows[i].cpu_share)) cpu += l->rows[i].cpu_share, evaluations += l->rows[i].evaluations_share;
    print_message("shares add up to %.3f of CPU time (noise %.2g), %.15g of evaluations\n", cpu, l->cpu_noise, evaluations);
    CHECK_NEAR(evaluations, 1, 1e-12);
    CHECK_NEAR(cpu, 1, 0.05 + 3 * l->cpu_noise);
    assert_true(l->evaluations_bare > 0 && l->evaluations_bare < 0.2 && l->cpu_s > 0);
    for (size_t i = 0; i < 4; i++) assert_true(isfinite(l->rows[i].cpu_share));
    assert_true(isnan(find(l, "nothing", 0)->cpu_share));
}

/* E|T|^-m over uniform T, by hand. */
static double mean_factor(double coldest, double warmest) { return (pow(coldest, 1 - M) - pow(warmest, 1 - M)) / ((1 - M) * (coldest - warmest)); }

static void a_stream(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger l;
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(32, 300);
    fw_msg                   m = {""};
    if (fw_effects_ledger_make(&l, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(l.n_windows == 32 && l.way == 300 && l.percentile == 90 && l.confidence == 0.95);
    assert_true(l.point >= 1 && l.point <= 24 && l.percentile_mm > l.mean_mm && l.mean_mm > 0);
    check_costs(&l);
    for (size_t i = 0; i < l.n_rows; i++) {
        const fw_effects_row *r = &l.rows[i];
        print_message("%-26s %-16s mean %+.3f [%+.3f, %+.3f], P90 %+.3f [%+.3f, %+.3f], evaluations %+.3f\n", r->name, r->change, r->mean.change, r->mean.low,
                      r->mean.high, r->percentile.change, r->percentile.low, r->percentile.high, r->evaluations_saved);
        if (r->note[0]) continue;
        assert_true(r->n_pairs + r->n_failed == 32 && r->n_failed <= 1);
        assert_true(r->mean.low <= r->mean.change && r->mean.change <= r->mean.high);
        assert_true(r->percentile.low <= r->percentile.change && r->percentile.change <= r->percentile.high);
    }
    /* What is off both ways gives the same bits: no change, no width. */
    const fw_effects_row *nothing = find(&l, "nothing", 0);
    assert_true(is_zero(&nothing->mean) && is_zero(&nothing->percentile) && nothing->evaluations_saved == 0);
    const fw_effects_row *wind = find(&l, "wind", 0);
    assert_true(isnan(wind->mean.change) && strstr(wind->note, "not asked for: there is no wind.speed") != NULL);
    /* A factor after the run: known exactly in the mean, and it is the same ice. */
    const fw_effects_row *warm = find(&l, "ice.temperature", 0);
    double                factor = pow(2, -M) / mean_factor(12, 2) - 1;
    CHECK_RELATIVE(warm->mean.change, factor, 1e-6);
    assert_true(warm->mean.low == warm->mean.change && warm->mean.high == warm->mean.change && warm->evaluations_saved == 0);
    assert_true(warm->percentile.low > 0);
    /* Locked floes in a stream wear 3 to 5 times more (an independent prototype); without friction they slide all the way too. */
    const fw_effects_row *rotation = find(&l, "rotation", 0);
    assert_true(rotation->mean.low > 0 && rotation->percentile.low > 0);
    assert_true(rotation->mean.low < 4 && rotation->mean.high > 2);
    assert_true(find(&l, "friction", 0)->mean.low > 0);
    assert_true(find(&l, "water.form_drag", 0)->mean.high < 0);
}

static void only_clocks_differ(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger l, again;
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(6, 60);
    fw_msg                   m = {""};
    if (fw_effects_ledger_make(&l, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    if (fw_effects_ledger_make(&again, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    again.cpu_s = l.cpu_s, again.cpu_s_first = l.cpu_s_first, again.cpu_bare = l.cpu_bare, again.cpu_noise = l.cpu_noise, again.cpu_s_study = l.cpu_s_study;
    for (size_t i = 0; i < l.n_rows; i++) again.rows[i].cpu_saved = l.rows[i].cpu_saved, again.rows[i].cpu_share = l.rows[i].cpu_share;
    assert_memory_equal(&l, &again, sizeof l);
}

/* Under an exponent of 2 and more the wear of a touch is infinite without a crushing limit: its row says so, and the limit is part of the bare rest. */
static void what_cannot_be_switched_off(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger l;
    fw_effects_switch        switches[N_SWITCHES];
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(4, 60);
    fw_msg                   m = {""};
    memcpy(switches, SWITCHES, sizeof switches);
    switches[4] = (fw_effects_switch){"crushing_limit", FW_EFFECT_CRUSHING_LIMIT, NULL, "ice bears no more"};
    o.switches = switches;
    c.model.effects |= (uint32_t)FW_EFFECT_CRUSHING_LIMIT;
    c.model.laws[0].exponent = 2.5;
    if (fw_effects_ledger_make(&l, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    const fw_effects_row *limit = find(&l, "crushing_limit", 0);
    assert_true(strstr(limit->note, "not possible here") != NULL && isnan(limit->cpu_share));
    double sum = l.evaluations_bare;
    for (size_t i = 0; i < 4; i++) sum += l.rows[i].evaluations_share;
    CHECK_NEAR(sum, 1, 1e-12);
}

/* One floe of 2.5 x 0.5 m at 2 m/s, offset 1 and 3 m: locked it wears 43 and 4 times as much (independent adaptive code with located events). */
static void a_single_hit(void **state)
{
    (void)state;
    static const double offsets[] = {1, 3}, ratios[] = {43, 4};
    for (int k = 0; k < 2; k++) {
        double depth[2];
        for (int is_locked = 0; is_locked < 2; is_locked++) {
            double          reach = 3.7 + 1.25, gap = 0.3;
            fw_floe         floe = {.x = -sqrt(reach * reach - offsets[k] * offsets[k]) - gap, .y = offsets[k], .diameter = 2.5, .thickness = 0.5, .vx = 2};
            fw_scene        scene = {.speed = 2, .temperature = -10, .duration = 60, .n_floes = 1, .floes = &floe};
            fw_scene_result r;
            fw_msg          m = {""};
            fw_model_defaults(&scene.model);
            scene.model.accuracy = 1e-3;
            if (is_locked) scene.model.effects &= ~(uint32_t)FW_EFFECT_ROTATION;
            if (fw_scene_run(&scene, NULL, NULL, &r, &m) != FW_OK) fail_msg("%s", m.text);
            depth[is_locked] = r.depth_along_contact;
            fw_scene_result_free(&r);
        }
        print_message("offset %g m: locked x%.3g\n", offsets[k], depth[1] / depth[0]);
        CHECK_RELATIVE(depth[1] / depth[0], ratios[k], 0.1);
    }
}

/* Short windows stand for whole ones: the mean is the same, within scatter, and the work is not. */
static void short_windows_stand_for_whole_ones(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger part, whole;
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(40, 300);
    fw_msg                   m = {""};
    o.scenario = fast_and_slow, o.n_switches = 4;
    if (fw_effects_ledger_make(&part, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    o.way = INFINITY;
    if (fw_effects_ledger_make(&whole, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    print_message("mean %.3g of %g m, %.3g of whole windows\n", part.mean_mm, part.way, whole.mean_mm);
    CHECK_RELATIVE(part.mean_mm, whole.mean_mm, 0.2); /* 20 fast windows, each with a scatter of some 40 and 20 % at one point */
    assert_true(part.evaluations < 0.5 * whole.evaluations);
    const fw_effects_row *a = find(&part, "rotation", 0), *b = find(&whole, "rotation", 0);
    assert_true(a->mean.low < b->mean.high && b->mean.low < a->mean.high); /* intervals meet */
}

static void a_budget_gives_sizes(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger l, more;
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(0, 0);
    fw_msg                   m = {""};
    o.n_switches = 4, o.scenario = thin, o.cpu_budget_s = 0.01;
    if (fw_effects_ledger_make(&l, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(l.n_windows == 32 && l.way == 60); /* the least there is */
    o.cpu_budget_s = 1;
    if (fw_effects_ledger_make(&more, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    print_message("%zu windows of %g m for 1 s: %.2g s\n", more.n_windows, more.way, more.cpu_s_study);
    assert_true(more.n_windows > l.n_windows && more.way > l.way);
}

static fw_effects_row made_row(const char *name, double change, double half, double saved)
{
    fw_effects_row r = {.is_effect = true, .was_on = true, .mean = {change, change - half, change + half}, .percentile = {-change, -change - half, -change + half}, .cpu_saved = saved};
    snprintf(r.name, sizeof r.name, "%s", name);
    return r;
}

static void what_may_be_left_out(void **state)
{
    (void)state;
    static fw_effects_ledger l;
    const fw_effects_row    *rows[FW_EFFECTS_ROWS];
    l.cpu_noise = 0.005;
    l.rows[l.n_rows++] = made_row("cheap", 1e-6, 1e-6, 0.01);     /* costs nothing: stays */
    l.rows[l.n_rows++] = made_row("noisy", 1e-6, 1e-6, 0.019);    /* within twice the noise */
    l.rows[l.n_rows++] = made_row("small", 0.002, 0.002, 0.1);
    l.rows[l.n_rows++] = made_row("other", -0.003, 0.002, 0.3);
    l.rows[l.n_rows++] = made_row("third", 0.001, 0.001, 0.05);   /* small alone, too much with the two before it */
    l.rows[l.n_rows++] = made_row("unsure", 0.001, 0.02, 0.5);
    l.rows[l.n_rows++] = made_row("large", 0.5, 0.01, 0.6);
    l.rows[l.n_rows++] = made_row("unknown", 0.001, NAN, 0.7);
    l.rows[l.n_rows++] = made_row("off", 0.0, 0.0, 0.7);
    l.rows[l.n_rows - 1].was_on = false;
    assert_int_equal(fw_effects_ledger_drops(&l, 0, rows), 0);
    assert_int_equal(fw_effects_ledger_drops(&l, 0.001, rows), 0);
    assert_int_equal(fw_effects_ledger_drops(&l, 0.01, rows), 2);
    assert_string_equal(rows[0]->name, "other");
    assert_string_equal(rows[1]->name, "small");
    assert_int_equal(fw_effects_ledger_drops(&l, 0.012, rows), 3);
    assert_string_equal(rows[2]->name, "third");
}

static fw_status stop(void *self, double done)
{
    (void)done;
    return --*(int *)self < 0 ? FW_E_STOPPED : FW_OK;
}

static void ends_that_are_none(void **state)
{
    (void)state;
    static double            bearings[24];
    static fw_effects_ledger l;
    fw_campaign              c = small_campaign(bearings);
    fw_effects_options       o = options(4, 30);
    int                      left = 5;
    fw_tick                  tick = {stop, &left};
    fw_msg                   m = {""};
    o.tick = &tick;
    assert_int_equal(fw_effects_ledger_make(&l, &c, &o, &m), FW_E_STOPPED);
    assert_true(l.n_rows == 0 && l.n_windows == 0);
    o.tick = NULL, o.n_switches = 3; /* form drag is on and nobody says how to switch it */
    assert_int_equal(fw_effects_ledger_make(&l, &c, &o, &m), FW_E_ARG);
    c.points.n = 0;
    assert_int_equal(fw_effects_ledger_make(&l, &c, &o, &m), FW_E_ARG);
    /* windows that all fail have nothing to compare with */
    c = small_campaign(bearings), o.n_switches = 4;
    c.model.max_evaluations = 1;
    assert_int_equal(fw_effects_ledger_make(&l, &c, &o, &m), FW_E_FAILURES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_stream), cmocka_unit_test(only_clocks_differ), cmocka_unit_test(what_cannot_be_switched_off), cmocka_unit_test(a_single_hit), cmocka_unit_test(short_windows_stand_for_whole_ones),
                                       cmocka_unit_test(a_budget_gives_sizes), cmocka_unit_test(what_may_be_left_out), cmocka_unit_test(ends_that_are_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
