/* The pilot of levels: verdicts on made-up windows whose correlation and cost are known, and laws of a small stream. */
#include "made_up.h"
#include "study/levels_inside.h"

enum { N = 256 };

/* ---- made-up windows --------------------------------------------------------------------------------------------- */

static void fill(fw_levels_way *way, const fw_campaign *c, const made_up *s, uint64_t first, double cpu_s)
{
    fw_record r;
    assert_int_equal(fw_depth_make(&way->depth, c, 0, c->points.n, c->points.bearing, NULL), FW_OK);
    assert_int_equal(fw_record_init(&r, c->model.n_arcs, 1, NULL), FW_OK);
    way->cpu_s = calloc(N, sizeof *way->cpu_s);
    for (uint64_t id = 0; id < N; id++) {
        assert_int_equal(made_up_read((void *)(uintptr_t)s, first + id, &r, NULL), FW_OK);
        assert_int_equal(fw_depth_add(&way->depth, &r, NULL), FW_OK);
        way->cpu_s[id] = cpu_s, way->evaluations += cpu_s;
    }
    fw_record_free(&r);
    assert_int_equal(fw_depth_settle(&way->depth, NULL, NULL, NULL), FW_OK);
}

static void free_way(fw_levels_way *way)
{
    fw_depth_free(&way->depth);
    free(way->cpu_s);
}

/* x: the 90th percentile of the lognormal windows at a point of shape 1. */
static fw_levels ask(double percentile)
{
    return (fw_levels){.point = 7, .percentile = percentile, .confidence = 0.95, .depth_mm = fw_abrasion_rate(&(fw_abrasion_law){"bekker2011", 0.116, 1.121, true}, -10) * exp(gsl_cdf_ugaussian_Pinv(0.9))};
}

/* One more load in the cheap way of the window whose depth is largest below x. */
static void lift_one(const fw_levels *l, fw_levels_way *way)
{
    size_t    at = 0;
    double    most = 0;
    fw_window w;
    fw_depth *d = &way->depth;
    assert_int_equal(fw_window_make(&w, d, l->point - 1, NULL), FW_OK);
    for (size_t i = 0; i < N; i++)
        if (w.means[i] < l->depth_mm && w.means[i] > most) most = w.means[i], at = i;
    for (size_t k = 0; k < d->directions.n_used; k++) d->load[at * d->directions.n_used + k] *= 1e3;
    fw_window_free(&w);
}

static void verdicts(void **state)
{
    (void)state;
    double        bearings[24];
    fw_campaign   c = made_up_campaign(bearings);
    made_up       s = {.campaign = &c, .sigma = 1};
    fw_levels     l = ask(90);
    fw_levels_row row[3] = {{.name = "same"}, {.name = "unrelated"}, {.name = "one off"}};
    fw_levels_way own = {0}, cheap[3] = {{.row = &row[0]}, {.row = &row[1]}, {.row = &row[2]}};
    fill(&own, &c, &s, 0, 10);
    fill(&cheap[0], &c, &s, 0, 1);
    fill(&cheap[1], &c, &s, 1000, 1);
    fill(&cheap[2], &c, &s, 0, 0.1);
    lift_one(&l, &cheap[2]);
    assert_int_equal(fw_levels_compare(&l, &c, &own, 3, cheap, NULL), FW_OK);
    for (size_t k = 0; k < 3; k++) print_message("%-10s %s\n", row[k].name, row[k].verdict);
    assert_true(row[0].is_promising && fabs(row[0].pairs.correlation - 1) < 1e-12 && fabs(row[0].evaluations_ratio - 10) < 1e-9);
    assert_string_equal(row[0].verdict, "promises x10.00 [10.00, 10.00]");
    assert_true(!row[1].is_promising && row[1].pairs.multifidelity.gain < 1 && strncmp(row[1].verdict, "refused: promises x0.", 21) == 0);
    /* One pair in 256 beyond x one way and not the other. Closed form: p = k / N of the dear ones beyond, p + 1 / N of the cheap ones. */
    double p = 0, q;
    for (uint64_t id = 0; id < N; id++) p += made_up_size(&s, id) > exp(gsl_cdf_ugaussian_Pinv(0.9)) ? 1.0 / N : 0;
    q = p + 1.0 / N;
    CHECK_NEAR(row[2].pairs.correlation, p * (1 - q) / sqrt(p * (1 - p) * q * (1 - q)), 1e-9);
    assert_true(!row[2].is_promising && row[2].pairs.multifidelity.low > 2 && row[2].pairs.kurtosis > 200);
    assert_non_null(strstr(row[2].verdict, "a few pairs carry the difference"));
    /* nor is a promise taken from a pilot that has fewer control variates than a run */
    l.n_functions = 7, l.n_windows = 128;
    assert_int_equal(fw_levels_compare(&l, &c, &own, 3, cheap, NULL), FW_OK);
    assert_true(!row[0].is_promising && row[0].pairs.multifidelity.low > 2);
    assert_non_null(strstr(row[0].verdict, "128 windows are too few"));
    /* nor is anything paid for what the strip knows for nothing */
    l.n_functions = 0;
    memset(cheap[2].cpu_s, 0, N * sizeof *cheap[2].cpu_s);
    cheap[2].is_strip = true;
    assert_int_equal(fw_levels_compare(&l, &c, &own, 3, cheap, NULL), FW_OK);
    assert_true(!row[0].is_promising && row[0].pairs.multifidelity.gain < row[2].pairs.multifidelity.gain);
    assert_non_null(strstr(row[0].verdict, "for nothing"));
    cheap[2].is_strip = false;
    /* a campaign that asks for a mean is about means: the one that was lifted spoils it */
    l = ask(NAN);
    assert_int_equal(fw_levels_compare(&l, &c, &own, 3, cheap, NULL), FW_OK);
    assert_true(row[0].is_promising && !row[2].is_promising && row[2].pairs.correlation == row[2].correlation_mean && row[2].pairs.correlation < 0.5);
    free_way(&own);
    for (size_t k = 0; k < 3; k++) free_way(&cheap[k]);
}

/* ---- a stream ---------------------------------------------------------------------------------------------------- */

static fw_campaign small_campaign(double *bearings)
{
    fw_campaign c = made_up_campaign(bearings);
    fw_model_defaults(&c.model);
    c.model.mixes[0].n_classes = 1;
    c.model.mixes[0].classes[0] = (fw_thickness_class){0.9, 1}; /* few large floes: cheap */
    c.model.window = 240;
    c.seed = 11;
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    c.site.direction = made_up_law(FW_DIST_NORMAL, 20, 25);
    fw_distribution_constant(&c.site.speed, 1);
    fw_distribution_constant(&c.site.concentration, 0.1);
    return c;
}

static void one_condition(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = -1, .concentration = 0.1, .speed = 1};
}

static const fw_levels_row *find(const fw_levels *l, const char *name)
{
    for (size_t i = 0; i < l->n_rows; i++)
        if (strcmp(l->rows[i].name, name) == 0) return &l->rows[i];
    return NULL;
}

static fw_levels measure(const fw_campaign *c)
{
    fw_levels         l;
    fw_msg            m = {""};
    fw_levels_options o = {.scenario = one_condition};
    if (fw_levels_measure(&l, c, &o, &m) != FW_OK) fail_msg("%s", m.text);
    for (size_t i = 0; i < l.n_rows; i++)
        print_message("%-16s rho %.3f, 1/%.3g of the evaluations, %s%s\n", l.rows[i].name, l.rows[i].pairs.correlation, l.rows[i].evaluations_ratio, l.rows[i].verdict,
                      l.rows[i].note);
    assert_true(l.n_windows == 128 && l.n_failed == 0 && l.n_functions == 0 && l.depth_mm > 0);
    return l;
}

static void a_stream(void **state)
{
    (void)state;
    double      bearings[24];
    fw_campaign c = small_campaign(bearings);
    fw_levels   l = measure(&c), again = measure(&c);
    assert_true(l.percentile == 90 && l.point == again.point && l.depth_mm == again.depth_mm);
    assert_null(find(&l, "spring")); /* no crushing ice, no spring instead of it */
    for (size_t i = 0; i < l.n_rows; i++) {
        const fw_levels_row *a = &l.rows[i], *b = &again.rows[i];
        assert_true(a->pairs.correlation == b->pairs.correlation && a->correlation_mean == b->correlation_mean && a->evaluations_ratio == b->evaluations_ratio); /* only clocks differ */
        assert_true(a->note[0] == 0 && fabs(a->correlation_before - a->pairs.correlation) < 1e-9 && a->pairs.consistency < 1);
    }
    /* In thin ice steps move depths by hardly anything. */
    const fw_levels_row *coarse = find(&l, "coarse steps");
    assert_true(coarse->correlation_mean > 0.99 && coarse->evaluations_ratio > 1.05 && coarse->evaluations_ratio < 3);
    /* Of three thirds with scatters of their own one knows 1 / sqrt(3); 4 standard errors. */
    const fw_levels_row *part = find(&l, "third of window");
    assert_true(fabs(part->correlation_mean - sqrt(1. / 3)) < 4 * (1 - 1. / 3) / sqrt(128) && part->evaluations_ratio > 1.5 && part->evaluations_ratio < 3.5);
    /* One condition is one number for the strip. */
    const fw_levels_row *strip = find(&l, "swept strip");
    assert_true(strip->pairs.correlation == 0 && isinf(strip->pairs.cost_ratio) && strip->pairs.multifidelity.gain == 1 && !strip->is_promising);
}

/* What cannot be had says why. Floes that never meet are the same both ways. */
static void what_is_not_there(void **state)
{
    (void)state;
    double      bearings[24];
    fw_campaign c = small_campaign(bearings);
    c.model.effects &= ~(uint32_t)FW_EFFECT_FLOE_CONTACT;
    c.model.accuracy = 0.1;
    c.precision.quantity = FW_QUANTITY_MEAN;
    fw_levels l = measure(&c);
    assert_true(isnan(l.percentile));
    assert_string_equal(find(&l, "no floe contact")->note, "the campaign has none");
    assert_string_equal(find(&l, "coarse steps")->note, "the campaign's own are as coarse");
    assert_true(find(&l, "third of window")->note[0] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(verdicts), cmocka_unit_test(a_stream), cmocka_unit_test(what_is_not_there)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
