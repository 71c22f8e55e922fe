/* Intervals of all points together, and effective sample sizes, from made-up records of closed form. */
#include "study/made_up.h"

enum { N_POINTS = 24 };

static fw_answer answer_of(const fw_campaign *c, const fw_answer_source *source, double confidence, size_t n_points, const size_t *points)
{
    fw_answer_options o = {.confidence = confidence, .n_points = n_points, .points = points};
    fw_answer         a;
    assert_int_equal(fw_answer_make(&a, c, source, &o, NULL), FW_OK);
    return a;
}

static double normal(uint64_t id, uint64_t part)
{
    fw_random r;
    fw_random_stream(&r, 8, FW_STREAM_TEST, id, part);
    return gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r));
}

/* Each quarter of the ring has a factor of its own beside the record's; every randomisation holds each 16th record. */
static fw_status quarters_read(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    FW_TRY(made_up_read(self, id, r, m));
    double factor[4];
    for (size_t quarter = 0; quarter < 4; quarter++) factor[quarter] = exp(0.7 * normal(id, quarter));
    for (size_t k = 0; k < r->n_arcs; k++)
        for (size_t ring = 1; ring < 4; ring++) r->rings[ring * r->n_arcs + k] *= factor[4 * k / r->n_arcs];
    return FW_OK;
}

static fw_status randomised_read(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    FW_TRY(quarters_read(self, id, r, m));
    r->randomisation = (int32_t)(id % 16);
    return FW_OK;
}

/* Ends that do not exist lie outside everything. */
static double low_of(double low) { return isnan(low) ? -INFINITY : low; }
static double high_of(double high) { return isnan(high) ? INFINITY : high; }

static void points_that_wear_alike_need_no_band(void **state)
{
    (void)state;
    double           bearings[N_POINTS];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1}; /* every point's depth is a multiple of the record's size */
    fw_answer_source source = made_up_source(&s, 400);
    fw_answer        a = answer_of(&c, &source, 0.95, 0, NULL);
    for (size_t i = 0; i < a.n_percentiles; i++) {
        const fw_percentile_row *row = &a.percentiles[i];
        assert_true(row->band_low_mm == row->low_mm && row->band_high_mm == row->high_mm);
        assert_true(row->n_effective == 400); /* order statistics */
    }
    fw_answer_free(&a);
    s.fail_every = 10; /* 40 of 400 are in the sample all the same */
    a = answer_of(&c, &source, 0.95, 0, NULL);
    assert_true(a.percentiles[0].n_effective == 400);
    fw_answer_free(&a);
}

static void check_band(const fw_campaign *c, const fw_answer_source *source, const char *method)
{
    fw_answer a = answer_of(c, source, 0.95, 0, NULL), less = answer_of(c, source, 0.8, 0, NULL), again = answer_of(c, source, 0.95, 0, NULL);
    /* 24 points that were independent would need 0.95^(1/24) each */
    fw_answer independent = answer_of(c, source, pow(0.95, 1.0 / N_POINTS), 0, NULL);
    size_t    wider = 0;
    assert_string_equal(a.percentiles[0].method, method);
    for (size_t i = 0; i < a.n_percentiles; i++) {
        const fw_percentile_row *row = &a.percentiles[i];
        assert_true(low_of(row->band_low_mm) <= low_of(row->low_mm) && high_of(row->band_high_mm) >= high_of(row->high_mm));
        assert_true(low_of(row->band_low_mm) <= low_of(less.percentiles[i].band_low_mm));
        assert_true(high_of(row->band_high_mm) >= high_of(less.percentiles[i].band_high_mm));
        assert_true(low_of(row->band_low_mm) >= low_of(independent.percentiles[i].low_mm));
        assert_true(high_of(row->band_high_mm) <= high_of(independent.percentiles[i].high_mm));
        assert_memory_equal(&row->band_low_mm, &again.percentiles[i].band_low_mm, 2 * sizeof(double));
        wider += row->band_low_mm < row->low_mm && row->band_high_mm > row->high_mm;
    }
    assert_true(wider > a.n_percentiles / 2);

    /* one point is its own band; two are narrower than all */
    const size_t two[] = {13, 8};
    fw_answer    one = answer_of(c, source, 0.95, 1, two), both = answer_of(c, source, 0.95, 2, two);
    const size_t p90 = 12 * 4 + 1;
    assert_true(one.percentiles[1].band_high_mm == one.percentiles[1].high_mm && one.percentiles[1].band_low_mm == one.percentiles[1].low_mm);
    assert_true(both.percentiles[1].high_mm == a.percentiles[p90].high_mm && both.percentiles[1].band_high_mm <= a.percentiles[p90].band_high_mm);
    assert_true(both.percentiles[1].band_high_mm > both.percentiles[1].high_mm);
    fw_answer_free(&one);
    fw_answer_free(&both);
    fw_answer_free(&a);
    fw_answer_free(&less);
    fw_answer_free(&again);
    fw_answer_free(&independent);
}

static void a_band_holds_the_interval_and_grows_with_confidence(void **state)
{
    (void)state;
    double           bearings[N_POINTS];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 0.3, .fail_every = 150};
    fw_answer_source source = {.records = {.n = 600, .read = quarters_read, .self = &s}};
    c.service.is_asked = false;
    check_band(&c, &source, "order statistics");
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    c.site.direction = made_up_law(FW_DIST_NORMAL, 0, 10);
    check_band(&c, &source, "averaged CDF"); /* 596 units in 512 groups */
    source.records.read = randomised_read;
    check_band(&c, &source, "averaged CDF, randomisations");
}

/* Two directions of equal weight and load laws, independent: the CDF of a record is the mean of two independent steps, worth two records. */
static fw_status halves_read(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    FW_TRY(made_up_read(self, id, r, m));
    const double load[2] = {exp(normal(id, 0)), exp(normal(id, 1))};
    for (size_t k = 0; k < r->n_arcs; k++)
        for (size_t ring = 1; ring < 4; ring++) r->rings[ring * r->n_arcs + k] = load[2 * k / r->n_arcs];
    return FW_OK;
}

static void two_directions_are_worth_two_records(void **state)
{
    (void)state;
    double           bearings[N_POINTS];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer_source source = {.records = {.n = 3000, .read = halves_read, .self = &s}};
    const double     to[] = {0, 180}, weights[] = {0.5, 0.5};
    c.service.is_asked = false;
    assert_int_equal(fw_distribution_values(&c.site.direction, 2, to, weights, NULL), FW_OK);
    fw_answer a = answer_of(&c, &source, 0.95, 0, NULL);
    /* variance of a variance from 3000 means of two steps, kurtosis below 7 at P90: 5 %; P95 and P99 have more */
    for (size_t i = 0; i < a.n_percentiles; i++)
        if (a.percentiles[i].percentile <= 90) CHECK_RELATIVE(a.percentiles[i].n_effective, 6000, 4 * 0.05);
    fw_answer_free(&a);
    fw_distribution_free(&c.site.direction);
}

static void nothing_scatters(void **state)
{
    (void)state;
    double           bearings[N_POINTS];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 0}; /* every record the same */
    fw_answer_source source = made_up_source(&s, 50);
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    fw_answer a = answer_of(&c, &source, 0.95, 0, NULL);
    for (size_t i = 0; i < a.n_percentiles; i++) {
        assert_true(isnan(a.percentiles[i].n_effective));
        assert_true(a.percentiles[i].band_low_mm == a.percentiles[i].low_mm && a.percentiles[i].band_high_mm == a.percentiles[i].high_mm);
    }
    fw_answer_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_that_wear_alike_need_no_band),
                                       cmocka_unit_test(a_band_holds_the_interval_and_grows_with_confidence),
                                       cmocka_unit_test(two_directions_are_worth_two_records), cmocka_unit_test(nothing_scatters)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
