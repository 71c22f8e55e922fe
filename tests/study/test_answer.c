/* Answers from made-up records against closed forms, and the laws they obey: rotation, scaling, ranking, failures. */
#include "study/made_up.h"

static const fw_answer_options usual = {0};

static const fw_percentile_row *row_of(const fw_answer *a, size_t point, double percentile)
{
    for (size_t i = 0; i < a->n_percentiles; i++)
        if (a->percentiles[i].point == point && a->percentiles[i].percentile == percentile) return &a->percentiles[i];
    fail_msg("no row for point %zu, P%g", point, percentile);
    return NULL;
}

static const fw_ledger_row *ledger_of(const fw_answer *a, const char *name)
{
    for (size_t i = 0; i < a->n_ledger; i++)
        if (strcmp(a->ledger[i].row, name) == 0) return &a->ledger[i];
    fail_msg("no ledger row '%s'", name);
    return NULL;
}

static void constant_scenes_give_order_statistics(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 400);
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    assert_int_equal(a.n, 400);
    assert_int_equal(a.n_points, 24);
    assert_int_equal(a.n_percentiles, 96);
    /* point 13 looks south, straight into the current: arc 0 */
    const fw_percentile_row *p90 = row_of(&a, 13, 90);
    assert_string_equal(p90->method, "order statistics");
    assert_true(p90->coverage >= 0.95 && p90->coverage < 0.97);
    double depth[400], rate = 0.116 * pow(10, -1.121) * made_up_shape(&s, 0, 360), mean = 0;
    for (size_t i = 0; i < 400; i++) {
        depth[i] = rate * made_up_size(&s, i);
        mean += depth[i] / 400;
    }
    size_t below = 0, below_low = 0, below_high = 0;
    for (size_t i = 0; i < 400; i++) {
        below += depth[i] < p90->depth_mm;
        below_low += depth[i] < p90->low_mm * (1 - 1e-12);
        below_high += depth[i] < p90->high_mm * (1 - 1e-12);
    }
    assert_int_equal(below, 360); /* rank 360.1 of 400 */
    /* ranks 348 and 373 of Bin(400, 0.9) at 2.5 % each: 360 -+ 1.96 sqrt(36) to within the rounding */
    assert_true(below_low >= 346 && below_low <= 349 && below_high >= 370 && below_high <= 373);
    CHECK_RELATIVE(a.points[12].mean_mm, mean, 1e-12);
    CHECK_RELATIVE(a.points[12].impact_share, 0.75, 1e-12);
    CHECK_RELATIVE(a.points[12].high_share, 0.2, 1e-12);
    CHECK_RELATIVE(a.points[12].path_km, 1e-3, 1e-12);
    assert_true(a.points[12].mean_low_mm < mean && mean < a.points[12].mean_high_mm);
    assert_int_equal(a.governing_point, 13);
    CHECK_NEAR(a.design_percentile, 90, 0);
    assert_true(isfinite(row_of(&a, 13, 99)->high_mm));
    fw_answer_free(&a);

    source.records.n = 100; /* P99 has no upper end at 100 */
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_true(isnan(row_of(&a, 13, 99)->high_mm) && isfinite(row_of(&a, 13, 99)->low_mm));
    fw_answer_free(&a);
}

/* Weibull of three parameters: x_p = location + scale (-ln(1 - p))^(1/shape). Percentiles of windows do not know of it. */
static void scatter_of_the_law_is_a_row(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a, plain;
    fw_answer_source source = made_up_source(&s, 400);
    assert_int_equal(fw_answer_make(&plain, &c, &source, &usual, NULL), FW_OK);
    assert_true(!plain.law_scatter.is_given && isnan(ledger_of(&plain, "law and its scatter")->amount));
    c.after.has_law_scatter = true;
    c.after.law_scatter = made_up_law(FW_DIST_WEIBULL, 0.9, 1.4);
    c.after.law_scatter.c = 0.25;
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    double x[3], p[3] = {0.025, 0.5, 0.975};
    for (int i = 0; i < 3; i++) x[i] = 0.25 + 0.9 * pow(-log(1 - p[i]), 1 / 1.4);
    const fw_ledger_row *row = ledger_of(&a, "law and its scatter");
    CHECK_RELATIVE(row->amount, (x[2] - x[0]) / (2 * x[1]), 1e-12);
    CHECK_RELATIVE(a.law_scatter.mean, 0.25 + 0.9 * tgamma(1 + 1 / 1.4), 1e-12);
    char text[64];
    snprintf(text, sizeof text, "P90 %.3g .. %.3g mm", x[0] * row_of(&a, 13, 90)->depth_mm, x[2] * row_of(&a, 13, 90)->depth_mm);
    if (!strstr(row->shrinks_with, text)) fail_msg("'%s' does not say '%s'", row->shrinks_with, text);
    for (size_t i = 0; i < a.n_percentiles; i++) assert_true(a.percentiles[i].depth_mm == plain.percentiles[i].depth_mm);
    fw_answer_free(&a);
    fw_answer_free(&plain);
}

static void uniform_temperature_on_one_load_is_a_closed_form(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 0}; /* every record the same: only T scatters */
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 50);
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    double       load = made_up_shape(&s, 0, 360);
    const double ps[] = {50, 90, 95, 99};
    for (size_t k = 0; k < 4; k++) {
        const fw_percentile_row *row = row_of(&a, 13, ps[k]);
        double                   want = 0.116 * load * pow(12 - 10 * ps[k] / 100, -1.121);
        CHECK_RELATIVE(row->depth_mm, want, 1e-6);
        assert_string_equal(row->method, "averaged CDF");
        CHECK_RELATIVE(row->low_mm, want, 0.01); /* no scatter between records: the ends close in */
        CHECK_RELATIVE(row->high_mm, want, 0.01);
    }
    /* E |T|^-m = (2^(1-m) - 12^(1-m))/(10 (m - 1)) */
    CHECK_RELATIVE(a.points[12].mean_mm, 0.116 * load * (pow(2, -0.121) - pow(12, -0.121)) / (10 * 0.121), 1e-10);
    fw_answer_free(&a);
}

static void a_rose_mixes_lognormals(void **state)
{
    (void)state;
    /* two directions; the depth of a point is a mixture of two lognormals, whose CDF is known */
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 0.8};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 3000);
    const double     to[] = {0, 90}, weights[] = {0.3, 0.7};
    assert_int_equal(fw_distribution_values(&c.site.direction, 2, to, weights, NULL), FW_OK);
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    double rate = 0.116 * pow(10, -1.121), m1 = rate * made_up_shape(&s, 0, 360),
           m2 = rate * made_up_shape(&s, 270, 360);
    const double ps[] = {50, 90, 99};
    for (size_t k = 0; k < 3; k++) {
        const fw_percentile_row *row = row_of(&a, 13, ps[k]);
        double                   low = 0.3 * gsl_cdf_ugaussian_P(log(row->low_mm / m1) / 0.8) +
                     0.7 * gsl_cdf_ugaussian_P(log(row->low_mm / m2) / 0.8);
        double high = 0.3 * gsl_cdf_ugaussian_P(log(row->high_mm / m1) / 0.8) +
                      0.7 * gsl_cdf_ugaussian_P(log(row->high_mm / m2) / 0.8);
        assert_true(low < ps[k] / 100 && ps[k] / 100 < high);
        assert_true(row->low_mm < row->depth_mm && row->depth_mm < row->high_mm);
    }
    CHECK_RELATIVE(a.points[12].mean_mm, (0.3 * m1 + 0.7 * m2) * exp(0.32), 0.05); /* sampling error 1.7 % */
    fw_answer_free(&a);
    fw_distribution_free(&c.site.direction);
}

static void turning_the_current_permutes_the_points(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings), turned = c;
    made_up          s = {.campaign = &c, .sigma = 1, .twist_deg = 35};
    fw_answer        a, b;
    fw_answer_source source = made_up_source(&s, 60);
    c.site.temperature = turned.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    c.site.direction = made_up_law(FW_DIST_NORMAL, 20, 25);
    turned.site.direction = made_up_law(FW_DIST_NORMAL, 20 + 45, 25);
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    assert_int_equal(fw_answer_make(&b, &turned, &source, &usual, NULL), FW_OK);
    for (size_t p = 1; p <= 24; p++) { /* 45 degrees are three points on */
        size_t q = (p + 2) % 24 + 1;
        CHECK_RELATIVE(row_of(&b, q, 90)->depth_mm, row_of(&a, p, 90)->depth_mm, 1e-9);
        CHECK_RELATIVE(b.points[q - 1].mean_mm, a.points[p - 1].mean_mm, 1e-10);
    }
    fw_answer_free(&a);
    fw_answer_free(&b);
}

static void two_laws_on_one_load_rank_the_points_alike(void **state)
{
    (void)state;
    double            bearings[24];
    fw_campaign       c = made_up_campaign(bearings);
    made_up           s = {.campaign = &c, .sigma = 1, .twist_deg = 20};
    fw_answer         a, b;
    fw_answer_options second = {.law = 1};
    fw_answer_source  source = made_up_source(&s, 60);
    c.model.n_laws = 2;
    c.model.laws[1] = (fw_abrasion_law){"power", 0.02, 0.7, false};
    c.site.direction = made_up_law(FW_DIST_NORMAL, 20, 25);
    assert_int_equal(fw_answer_make(&a, &c, &source, &usual, NULL), FW_OK);
    assert_int_equal(fw_answer_make(&b, &c, &source, &second, NULL), FW_OK);
    for (size_t p = 0; p < 24; p++)
        for (size_t q = 0; q < 24; q++)
            assert_int_equal(a.points[p].mean_mm < a.points[q].mean_mm, b.points[p].mean_mm < b.points[q].mean_mm);
    assert_int_equal(a.governing_point, b.governing_point);
    CHECK_RELATIVE(b.points[0].mean_mm / a.points[0].mean_mm, 0.02 / (0.116 * pow(10, -1.121)), 1e-12);
    fw_answer_free(&a);
    fw_answer_free(&b);
}

static void options_choose_points_and_percentiles(void **state)
{
    (void)state;
    double            bearings[24];
    fw_campaign       c = made_up_campaign(bearings);
    made_up           s = {.campaign = &c, .sigma = 1};
    fw_answer         all, some;
    const double      ps[] = {90, 80}, wrong[] = {100};
    const size_t      points[] = {13, 1}, no_point[] = {25};
    fw_answer_source  source = made_up_source(&s, 100);
    fw_answer_options o = {.n_percentiles = 2, .percentiles = ps, .n_points = 2, .points = points};
    fw_msg            m;
    assert_int_equal(fw_answer_make(&all, &c, &source, NULL, NULL), FW_OK);
    assert_int_equal(fw_answer_make(&some, &c, &source, &o, NULL), FW_OK);
    assert_int_equal(some.n_percentiles, 4);
    assert_true(some.percentiles[0].point == 13 && some.percentiles[0].percentile == 90 &&
                some.percentiles[3].percentile == 80);
    CHECK_NEAR(some.percentiles[0].depth_mm, row_of(&all, 13, 90)->depth_mm, 0);
    CHECK_NEAR(some.points[1].bearing_deg, 0, 0);
    fw_answer_free(&some);
    o.percentiles = wrong;
    o.n_percentiles = 1;
    assert_int_equal(fw_answer_make(&some, &c, &source, &o, &m), FW_E_ARG);
    o.n_percentiles = 0;
    o.points = no_point;
    o.n_points = 1;
    assert_int_equal(fw_answer_make(&some, &c, &source, &o, &m), FW_E_ARG);
    o = (fw_answer_options){.law = 3};
    assert_int_equal(fw_answer_make(&some, &c, &source, &o, &m), FW_E_ARG);
    fw_answer_free(&all);
    c.precision.percentile = 97; /* the campaign's own percentile joins the usual four */
    assert_int_equal(fw_answer_make(&all, &c, &source, NULL, NULL), FW_OK);
    assert_true(all.percentiles[3].percentile == 97 && all.percentiles[4].percentile == 99 &&
                all.design_percentile == 97);
    fw_answer_free(&all);
}

static void failed_runs_are_counted_at_both_ends(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          clean = {.campaign = &c, .sigma = 1}, holed = {.campaign = &c, .sigma = 1, .fail_every = 20};
    fw_answer        a, b;
    fw_msg           m;
    fw_reached       r;
    fw_answer_source source = made_up_source(&clean, 400), with_failures = made_up_source(&holed, 400);
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_int_equal(fw_answer_make(&b, &c, &with_failures, NULL, NULL), FW_OK);
    assert_int_equal(b.n_failed, 20);
    assert_true(row_of(&b, 13, 90)->low_mm < row_of(&a, 13, 90)->low_mm);
    assert_true(row_of(&b, 13, 90)->high_mm > row_of(&a, 13, 90)->high_mm);
    assert_true(isnan(row_of(&b, 13, 99)->high_mm)); /* 5 % at infinity */
    assert_true(isnan(b.points[12].mean_high_mm) && b.points[12].mean_low_mm < a.points[12].mean_low_mm);
    assert_true(ledger_of(&a, "failed runs")->amount == 0 && ledger_of(&b, "failed runs")->amount > 0.1);
    fw_answer_free(&a);
    fw_answer_free(&b);

    holed.fail_every = 1; /* nothing but failures */
    assert_int_equal(fw_answer_make(&b, &c, &with_failures, NULL, &m), FW_E_FAILURES);
    assert_int_equal(fw_answer_reached(&c, &with_failures, &r, &m), FW_OK);
    assert_true(r.half_width == INFINITY && isnan(r.value_mm) && !r.is_enough);
    with_failures.records.n = 0;
    assert_int_equal(fw_answer_reached(&c, &with_failures, &r, &m), FW_OK);
    assert_true(r.half_width == INFINITY && !r.is_enough);
    assert_int_equal(fw_answer_make(&b, &c, &with_failures, NULL, &m), FW_E_FAILURES);
}

static void the_stop_rule_asks_for_what_the_answer_says(void **state)
{
    (void)state;
    double           bearings[24], half;
    fw_reached       r;
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 400);
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    half = r.half_width;
    CHECK_NEAR(half, a.half_width, 0);
    assert_int_equal(r.point, 13);
    const fw_percentile_row *row = row_of(&a, 13, 90);
    CHECK_NEAR(r.value_mm, row->depth_mm, 0);
    double own = (row->high_mm - row->low_mm) / (2 * row->depth_mm);
    assert_true(half >= own);
    CHECK_RELATIVE(ledger_of(&a, "sampling")->amount, own, 1e-12);
    CHECK_RELATIVE(ledger_of(&a, "sampling")->cost_to_halve_cpu_s, 3 * 400 * 2.0, 1e-12);
    assert_true(isnan(ledger_of(&a, "life: independent windows")->amount));
    fw_answer_free(&a);
    source.records.n = 1600; /* the half-width shrinks with 1/sqrt(n) */
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(r.half_width > 0.35 * half && r.half_width < 0.7 * half);
    source.records.n = 10;
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(r.half_width == INFINITY);
    c.precision.quantity = FW_QUANTITY_MEAN;
    source.records.n = 400;
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(r.half_width > 0.05 && r.half_width < 0.3); /* CV 1.3 to 1.7 over sqrt(400), times 1.96, and skewness */
}

static void a_life_is_a_sum_of_windows(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 400);
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    const size_t      point[] = {13};
    fw_answer_options o = {.n_points = 1, .points = point};
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    double mu = a.points[0].mean_mm, n = 50 * 1200 / 3.0;
    CHECK_NEAR(a.life[0].windows, n, 0);
    /* 20000 windows of CV about 1.9: CV of the sum 1.4 %, skewness 0.05; the mean's interval carries over */
    CHECK_RELATIVE(a.life[0].depth_mm, n * mu, 2e-3);
    assert_true(a.life[3].depth_mm > a.life[0].depth_mm * 1.02 && a.life[3].depth_mm < a.life[0].depth_mm * 1.06);
    /* an interval like the mean's: what is not known of a window's variance moves a life's percentile next to nothing */
    CHECK_RELATIVE((a.life[3].high_mm - a.life[3].low_mm) / a.life[3].depth_mm, (a.points[0].mean_high_mm - a.points[0].mean_low_mm) / mu, 0.15);
    assert_true(a.life[3].low_mm < a.life[3].depth_mm && a.life[3].depth_mm < a.life[3].high_mm);
    assert_true(isnan(a.life[0].allowance_year)); /* none asked */
    fw_answer_free(&a);

    c.service.allowance = n * mu * 20.5 / 50; /* the mean gets there in year 21 */
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    CHECK_NEAR(a.life[0].allowance_year, 21, 0);
    assert_true(a.life[3].allowance_year <= 21 && a.life[3].allowance_year >= 19);
    fw_answer_free(&a);
    c.service.allowance = n * mu * 2;
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    assert_true(isnan(a.life[3].allowance_year));
    fw_answer_free(&a);
}

static void a_short_life_is_resampled(void **state)
{
    (void)state;
    double            bearings[24];
    fw_campaign       c = made_up_campaign(bearings);
    made_up           s = {.campaign = &c, .sigma = 1};
    fw_answer         a;
    fw_answer_source  source = made_up_source(&s, 400);
    const size_t      point[] = {13};
    fw_answer_options o = {.n_points = 1, .points = point};
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    c.service.life_years = 1;
    c.service.ice_hours_per_year = 3; /* one window: the life is the window */
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    CHECK_NEAR(a.life[0].windows, 1, 0);
    for (size_t k = 0; k < 4; k++)
        CHECK_RELATIVE(a.life[k].depth_mm, a.percentiles[k].depth_mm, 0.05); /* 100000 lives */
    fw_answer_free(&a);
    c.service.life_years = 4; /* 20 windows in four years; mean and ordering hold */
    c.service.ice_hours_per_year = 15;
    c.service.allowance = 1e-6;
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    CHECK_NEAR(a.life[0].windows, 20, 0);
    assert_true(a.life[0].depth_mm < 20 * a.points[0].mean_mm && a.life[0].depth_mm > 14 * a.points[0].mean_mm);
    for (size_t k = 0; k < 3; k++) assert_true(a.life[k].depth_mm < a.life[k + 1].depth_mm);
    CHECK_NEAR(a.life[0].allowance_year, 1, 0);
    fw_answer_free(&a);
}

static void nonsense_in_records_is_refused(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = -800}; /* exp(-800 z) under- and overflows: half the sizes are 0 */
    fw_answer        a;
    fw_msg           m;
    fw_answer_source source = made_up_source(&s, 40);
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, &m), FW_E_FORMAT); /* infinite loads are refused by name */
    assert_non_null(strstr(m.text, "wear load"));
    c.points.n = 0;
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, &m), FW_E_ARG);
}

static fw_status read_zeros(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    fw_status s = made_up_read(self, id, r, m);
    memset(r->rings, 0, fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof *r->rings);
    return s;
}

static void no_wear_at_all(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = {.records = {.n = 100, .read = read_zeros, .self = &s}};
    for (int is_integrated = 0; is_integrated < 2; is_integrated++) {
        if (is_integrated) c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
        assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
        assert_true(row_of(&a, 13, 90)->depth_mm == 0 && a.points[12].mean_mm == 0 && isnan(a.points[12].impact_share));
        assert_true(a.life[0].depth_mm == 0 && isnan(a.life[0].allowance_year));
        fw_answer_free(&a);
        fw_reached r;
        assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
        assert_true(r.half_width == INFINITY);
    }
}

/* Numerical rows: from the campaign's own study when there is one, else from the Raahe campaign's, and the text says which. */
static void the_ledger_takes_what_was_measured(void **state)
{
    (void)state;
    double            bearings[24];
    fw_campaign       c = made_up_campaign(bearings);
    made_up           s = {.campaign = &c, .sigma = 1};
    fw_answer         a;
    fw_answer_source  source = made_up_source(&s, 100);
    fw_measured       own = {.origin = "on this campaign, with 8 windows", .is_own = true, .n_rows = 3};
    fw_answer_options o = {.measured = &own};
    own.rows[0] = (fw_measured_row){"discretisation", 0.002, 0.001, 1.5, "accuracy:", "tolerance 1e-4"};
    own.rows[1] = (fw_measured_row){"ring", 0.01, 0.004, 1.25, "ring.arcs", "720 arcs"};
    own.rows[2] = (fw_measured_row){"warm-up", NAN, NAN, NAN, "exposure.warm_up", "no level that was tried"};
    assert_int_equal(fw_answer_make(&a, &c, &source, &o, NULL), FW_OK);
    const fw_ledger_row *step = ledger_of(&a, "discretisation"), *ring = ledger_of(&a, "ring");
    assert_true(step->amount == 0.002 && ring->amount == 0.01 && isnan(ledger_of(&a, "warm-up")->amount));
    CHECK_RELATIVE(step->cost_to_halve_cpu_s, 1.5 * 100 * 2.0, 1e-12); /* everything again at the finer step */
    assert_non_null(strstr(step->shrinks_with, own.origin));
    assert_non_null(strstr(ring->cost_to_halve, "720 arcs"));
    CHECK_NEAR(ledger_of(&a, "window, domain and warm-up")->amount, 0.01, 1e-15); /* of what is known */
    assert_true(a.measured.is_own && a.measured.n_rows == 3);
    fw_answer_free(&a);

    fw_model_defaults(&c.model);
    double before = 0;
    for (double accuracy = 1e-4; accuracy < 0.2; accuracy *= 10) {
        c.model.accuracy = accuracy;
        assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
        step = ledger_of(&a, "discretisation");
        assert_true(step->amount > before &&
                    step->amount < accuracy); /* the promise is kept, and looser ones are looser */
        assert_non_null(strstr(step->shrinks_with, "on the Raahe campaign"));
        before = step->amount;
        fw_answer_free(&a);
    }
    c.model.n_arcs = 360, c.model.strip_width = 60, c.model.numerics.tolerance = 1e-3; /* not what was measured there */
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_true(isnan(ledger_of(&a, "discretisation")->amount) && isnan(ledger_of(&a, "strip width")->amount));
    assert_true(ledger_of(&a, "ring")->amount > 0);
    fw_answer_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_scenes_give_order_statistics),
        cmocka_unit_test(scatter_of_the_law_is_a_row),
        cmocka_unit_test(uniform_temperature_on_one_load_is_a_closed_form),
        cmocka_unit_test(a_rose_mixes_lognormals),
        cmocka_unit_test(turning_the_current_permutes_the_points),
        cmocka_unit_test(two_laws_on_one_load_rank_the_points_alike),
        cmocka_unit_test(options_choose_points_and_percentiles),
        cmocka_unit_test(failed_runs_are_counted_at_both_ends),
        cmocka_unit_test(the_stop_rule_asks_for_what_the_answer_says),
        cmocka_unit_test(a_life_is_a_sum_of_windows),
        cmocka_unit_test(a_short_life_is_resampled),
        cmocka_unit_test(nonsense_in_records_is_refused),
        cmocka_unit_test(no_wear_at_all),
        cmocka_unit_test(the_ledger_takes_what_was_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
