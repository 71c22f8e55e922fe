/* The accuracy study: its own checks against the reference solutions, its statistics on made-up numbers with known answers, and
 * the laws of a whole small study. */
#include "made_up.h"
#include "study/accuracy.h"

/* The embedded solutions are those of tests/reference, to the last digit. */
static void hits_are_the_reference(void **state)
{
    (void)state;
    char        name[32];
    double      fine, usual, coarse;
    fw_msg      m = {""};
    fw_numerics loose = {.order = 2, .tolerance = 1e-2, .first_step = 0.05, .growth = 3};
    assert_int_equal(fw_accuracy_hits(1e-4, NULL, &fine, name, sizeof name, &m), FW_OK);
    assert_int_equal(fw_accuracy_hits(1e-2, NULL, &usual, NULL, 0, &m), FW_OK);
    assert_int_equal(fw_accuracy_hits(1e-2, &loose, &coarse, NULL, 0, &m), FW_OK);
    print_message("worst single hit: %.2g, %.2g, %.2g (%s)\n", fine, usual, coarse, name);
    assert_true(fine > 0 && fine < 1e-4 && usual < 1e-2);
    assert_true(fine < usual && fine < coarse);
    assert_non_null(strstr(name, "case"));
}

static void pairs(void **state)
{
    (void)state;
    fw_trial_sample a[4] = {{.is_ok = true, .depth = 1.1}, {.is_ok = true, .depth = 2}, {.is_ok = true}, {.depth = 9}};
    fw_trial_sample b[4] = {
        {.is_ok = true, .depth = 0.9}, {.is_ok = true, .depth = 2}, {.is_ok = true}, {.is_ok = true, .depth = 1}};
    fw_pairs same = fw_pairs_compare(4, a, a, fw_trial_depth, NULL),
             p = fw_pairs_compare(4, a, b, fw_trial_depth, NULL);
    assert_true(same.n == 2 && same.mean == 0 && same.rms == 0 && same.error == 0);
    assert_int_equal(p.n, 2); /* a failed window and one without wear say nothing */
    CHECK_NEAR(p.mean, 0.1, 1e-15);
    CHECK_NEAR(p.rms, sqrt(0.02), 1e-15);
    CHECK_NEAR(p.error, 0.1, 1e-15); /* 0.2 and 0: deviation sqrt(0.02), over sqrt(2) */
    fw_pairs back = fw_pairs_compare(4, b, a, fw_trial_depth, NULL);
    CHECK_NEAR(back.mean, -p.mean, 1e-15); /* a decoupled pair counts alike both ways */
    bool     counts[4] = {false, true, false, false};
    fw_pairs one = fw_pairs_compare(4, a, b, fw_trial_depth, counts);
    assert_true(one.n == 1 && one.mean == 0 && isnan(one.error));
    assert_int_equal(fw_pairs_find_coupled(4, a, b, 0.01, counts), 1);
    assert_true(!counts[0] && counts[1] && !counts[2] && !counts[3]);
}

/* Points that scatter by half of their value, with and without a difference that stays: the scatter is told from the difference. */
static void points(void **state)
{
    (void)state;
    enum { N = 400, P = 24 };
    static double a[N * P], b[N * P], scale[N], weight[N];
    for (int has_bias = 0; has_bias < 2; has_bias++) {
        fw_random g;
        fw_random_stream(&g, 3, FW_STREAM_TEST, (uint64_t)has_bias, 0);
        for (size_t i = 0; i < N; i++) {
            scale[i] = 2, weight[i] = 1 + (double)(i % 3);
            for (size_t p = 0; p < P; p++) {
                double noise = 0.5 * gsl_cdf_ugaussian_Pinv(fw_random_uniform(&g));
                b[i * P + p] = 2;
                a[i * P + p] = 2 * (1 + noise + (has_bias ? p % 2 ? 0.08 : -0.08 : 0));
            }
        }
        fw_pairs r = fw_pairs_compare_points(N, P, a, b, scale, weight);
        print_message("difference %g: %.3g +- %.2g, scatter %.3g\n", has_bias ? 0.08 : 0, r.mean, r.error, r.rms);
        assert_int_equal(r.n, N);
        CHECK_RELATIVE(r.rms, sqrt(0.25 + (has_bias ? 0.0064 : 0)), 0.03);
        CHECK_NEAR(r.mean, has_bias ? 0.08 : 0, has_bias ? 0.012 : 3 * r.error);
        /* 0.5 / sqrt(400), a tenth more because weights differ, times (2 / 24)^(1/4) */
        CHECK_NEAR(r.error, 0.0145, 0.002);
    }
    fw_pairs same = fw_pairs_compare_points(N, P, a, a, scale, weight);
    assert_true(same.mean == 0 && same.rms == 0 && same.error == 0);
    memset(weight, 0, sizeof weight);
    same = fw_pairs_compare_points(N, P, a, b, scale, weight);
    assert_true(same.n == 0 && isnan(same.mean));
}

/* P90 of a lognormal from n windows: sqrt(q (1 - q) / n) sigma / phi(z_q), the asymptotic law of a sample quantile. */
static void percentile_error(void **state)
{
    (void)state;
    enum { N = 1024 };
    static double    bearings[24];
    static fw_record records[N];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          source = {.campaign = &c, .sigma = 0.5};
    fw_msg           m = {""};
    c.seed = 5;
    for (size_t i = 0; i < N; i++) {
        assert_int_equal(fw_record_init(&records[i], c.model.n_arcs, c.model.n_laws, &m), FW_OK);
        made_up_read(&source, i, &records[i], &m);
    }
    double z = gsl_cdf_ugaussian_Pinv(0.9), phi = exp(-0.5 * z * z) / sqrt(2 * 3.14159265358979323846),
           before = INFINITY;
    for (size_t n = 32; n <= 512; n *= 4) {
        double error, value, known = sqrt(0.09 / (double)n) * 0.5 / phi;
        assert_int_equal(fw_accuracy_percentile_error(&c, N, records, 0.9, n, &error, &value, &m), FW_OK);
        print_message("n = %zu: %.3g, known %.3g\n", n, error, known);
        CHECK_RELATIVE(error, known,
                       0.3); /* 64 sub-sets know their r.m.s. to 9 %, one pool of 1024 has a density of its own */
        assert_true(error < 0.75 * before);
        before = error;
    }
    double error, value;
    assert_int_equal(fw_accuracy_percentile_error(&c, N, records, 0.9, N / 2 + 1, &error, &value, &m), FW_E_ARG);
    for (size_t i = 0; i < N; i++) fw_record_free(&records[i]);
}

/* ---- a whole study ---------------------------------------------------------------------------------------------- */

static fw_campaign small_campaign(double *bearings)
{
    fw_campaign c = made_up_campaign(bearings);
    fw_model_defaults(&c.model);
    c.model.mixes[0].n_classes = 1;
    c.model.mixes[0].classes[0] = (fw_thickness_class){0.5, 1};
    c.model.window = 600;
    c.seed = 11;
    c.precision.max_realisations = 100;
    return c;
}

static void scenario(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = -1, .concentration = 0.4, .speed = id % 2 ? 2 : 1};
}

static const fw_accuracy_row *find(const fw_accuracy *a, bool (*is)(const fw_accuracy_row *))
{
    for (size_t i = 0; i < a->n_rows; i++)
        if (is(&a->rows[i])) return &a->rows[i];
    fail_msg("no such row");
    return NULL;
}
static bool is_reference(const fw_accuracy_row *r) { return r->is_reference; }
static bool is_chosen(const fw_accuracy_row *r) { return r->is_chosen; }

/* What the study says a level is off by: a bound, so few windows make it large. */
static double bound(const fw_accuracy_row *r)
{
    return fmax(fmax(r->hit_error, r->truncation), fabs(r->coupled.mean) + 2 * r->coupled.error);
}

/* The cheapest of all that are within the accuracy, and the built-in level is asked like any other. */
static void check_choice(const fw_accuracy *a, double accuracy)
{
    const fw_accuracy_row *chosen = find(a, is_chosen);
    size_t                 n_within = 0, n_defaults = 0;
    assert_true(a->choice.is_within && a->choice.error <= accuracy);
    assert_true(chosen->numerics.tolerance == a->choice.numerics.tolerance &&
                chosen->numerics.scheme == FW_SCHEME_EVENTS);
    for (size_t i = 0; i < a->n_rows; i++) {
        const fw_accuracy_row *r = &a->rows[i];
        if (r->group != FW_ACCURACY_STEP || r->is_reference || r->numerics.scheme != FW_SCHEME_EVENTS ||
            r->numerics.wear_rule != FW_WEAR_HERMITE)
            continue;
        n_defaults += r->is_default;
        if (bound(r) > accuracy) continue;
        n_within++;
        assert_true(chosen->evaluations <= r->evaluations);
    }
    assert_true(n_within > 3 && n_defaults == 1 && bound(chosen) <= accuracy);
}

/* Errors of order 2 fall with the tolerance, and the finest of its levels is much better than the coarsest. */
static void check_levels(const fw_accuracy *a)
{
    double first = 0, last = 0;
    for (size_t i = 0; i < a->n_rows; i++) {
        const fw_accuracy_row *r = &a->rows[i];
        if (strcmp(r->method, "events 2, hermite") != 0) continue;
        if (first == 0) first = r->coupled.rms;
        last = r->coupled.rms;
    }
    print_message("order 2: %.3g at the coarsest, %.3g at the finest level\n", first, last);
    assert_true(first > 0 && last > 0 && last < 0.1 * first);
}

static void whole_study(void **state)
{
    (void)state;
    static double       bearings[24];
    fw_campaign         c = small_campaign(bearings);
    fw_accuracy_options o = {.scenario = scenario, .cpu_budget_s = 0};
    fw_accuracy         a;
    fw_msg              m = {""};
    if (fw_accuracy_study(&a, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    CHECK_NEAR(a.mean_speed, 2, 1e-12); /* the faster half of the ids */
    const fw_accuracy_row *reference = find(&a, is_reference);
    assert_true(reference->depth.n > 0 && reference->depth.mean == 0 && reference->depth.rms == 0);
    assert_true(a.reference_hit_error < 1e-4);
    check_choice(&a, c.model.accuracy);
    check_levels(&a);
    size_t groups[6] = {0};
    for (size_t i = 0; i < a.n_rows; i++) {
        const fw_accuracy_row *r = &a.rows[i];
        groups[r->group]++;
        assert_true(r->evaluations > 0 && r->cpu_s > 0);
        if (r->is_reference) assert_true(r->depth.rms == 0);
        assert_true(i == 0 || r->group >= a.rows[i - 1].group);
    }
    for (size_t g = 0; g < 6; g++) assert_true(groups[g] >= 3);
    assert_int_equal(a.measured.n_rows, FW_MEASURED_ROWS);
    assert_true(a.measured.is_own && a.measured.rows[0].amount > 0 && a.measured.rows[0].cost_factor > 1);
    assert_true(a.n_percentile >= 2 && a.error_one > 0 && a.n_budget > 0 && a.cpu_s_window > 0);
    for (size_t i = 0; i < a.n_budget; i++)
        CHECK_RELATIVE(a.budget[i].total_error, hypot(a.budget[i].step_error, a.budget[i].sampling_error), 1e-12);
    fw_accuracy_free(&a);
    assert_null(a.rows);
}

/* Ice that crushes, in a tide: the fixed-step methods have neither, and the study goes on without them. */
static void without_fixed_steps(void **state)
{
    (void)state;
    static double       bearings[24];
    fw_campaign         c = small_campaign(bearings);
    fw_accuracy_options o = {.scenario = scenario, .cpu_budget_s = 0};
    fw_accuracy         a;
    fw_msg              m = {""};
    c.model.effects |= FW_EFFECT_CRUSH_CONTACT | FW_EFFECT_TIDE;
    if (fw_accuracy_study(&a, &c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(find(&a, is_chosen)->evaluations > 0);
    for (size_t i = 0; i < a.n_rows; i++) assert_int_equal(a.rows[i].numerics.scheme, FW_SCHEME_EVENTS);
    fw_accuracy_free(&a);
}

static fw_status stop(void *self, double done)
{
    (void)done;
    return --*(int *)self < 0 ? FW_E_STOPPED : FW_OK;
}

static void stopped(void **state)
{
    (void)state;
    static double       bearings[24];
    fw_campaign         c = small_campaign(bearings);
    int                 left = 5;
    fw_tick             tick = {stop, &left};
    fw_accuracy_options o = {.scenario = scenario, .tick = &tick};
    fw_accuracy         a;
    fw_msg              m = {""};
    assert_int_equal(fw_accuracy_study(&a, &c, &o, &m), FW_E_STOPPED);
    assert_true(a.n_rows == 0 && a.rows == NULL);
    c.points.n = 0;
    assert_int_equal(fw_accuracy_study(&a, &c, &o, &m), FW_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_are_the_reference), cmocka_unit_test(pairs),       cmocka_unit_test(points),
        cmocka_unit_test(percentile_error),       cmocka_unit_test(whole_study), cmocka_unit_test(without_fixed_steps), cmocka_unit_test(stopped)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
