/* Service lives of made-up records: persistence, years, tables of years, laws that are not known well, heights; against closed forms. */
#include "statistics/lives.h"
#include "study/made_up.h"

enum { N = 400, YEARS = 50, WINDOWS = 400 /* a year of 1200 h */ };

typedef struct asked {
    double           bearings[24];
    fw_campaign      c;
    made_up          records;
    fw_answer_source source;
    fw_answer        a;
} asked;

static const size_t             POINTS[] = {13, 10}; /* straight into the current, and 45 degrees off it */
static const fw_answer_options  two_points = {.n_points = 2, .points = POINTS};

static void prepare(asked *q)
{
    memset(q, 0, sizeof *q);
    q->c = made_up_campaign(q->bearings);
    q->records = (made_up){.campaign = &q->c, .sigma = 1};
    q->source = made_up_source(&q->records, N);
}

static void ask(asked *q) { assert_int_equal(fw_answer_make(&q->a, &q->c, &q->source, &two_points, NULL), FW_OK); }

static const fw_ledger_row *ledger_of(const fw_answer *a, const char *name)
{
    for (size_t i = 0; i < a->n_ledger; i++)
        if (strcmp(a->ledger[i].row, name) == 0) return &a->ledger[i];
    fail_msg("no ledger row '%s'", name);
    return NULL;
}

/* E D^2/(E D)^2 of the made-up sizes; the shape cancels. */
static double window_variance(const asked *q)
{
    double mean = 0, square = 0;
    for (size_t i = 0; i < N; i++) mean += made_up_size(&q->records, i) / N, square += pow(made_up_size(&q->records, i), 2) / N;
    return square / (mean * mean) - 1;
}

static void scatter_has_its_sources(void **state)
{
    (void)state;
    asked q;
    prepare(&q);
    q.c.service.persistence = 0.97, q.c.service.year_to_year_cv = 0.4;
    ask(&q);
    const fw_life_point *p = &q.a.service.points[0];
    CHECK_RELATIVE(p->mean_mm, YEARS * WINDOWS * q.a.points[0].mean_mm, 1e-12);
    CHECK_RELATIVE(p->cv_windows, sqrt(window_variance(&q) / (YEARS * WINDOWS)), 1e-10);
    CHECK_RELATIVE(p->cv * p->cv, pow(p->cv_windows, 2) + pow(p->cv_persistence, 2) + pow(p->cv_years, 2), 1e-12);
    /* E F^2 - 1 of a year whose winter has the square s: 0.16 (1 + s) over the years; s is fifty times what windows and persistence leave */
    double s = YEARS * (pow(p->cv_windows, 2) + pow(p->cv_persistence, 2));
    CHECK_RELATIVE(p->cv_years, sqrt(0.16 * (1 + s) / YEARS), 1e-10);
    /* nearly lognormal lives: P50, P90 and P99 from mean and CV */
    double sigma = sqrt(log1p(p->cv * p->cv));
    for (size_t k = 0; k < 4; k++)
        CHECK_RELATIVE(q.a.life[k].depth_mm, p->mean_mm * exp(sigma * gsl_cdf_ugaussian_Pinv(q.a.life[k].percentile / 100) - sigma * sigma / 2), 0.01);
    assert_string_equal(q.a.service.assumption, "windows of persistence 0.97, years of CV 0.4");
    CHECK_RELATIVE(ledger_of(&q.a, "life: persistence")->amount, 1.96 * p->cv_persistence, 1e-12);
    CHECK_RELATIVE(ledger_of(&q.a, "between years")->amount, 1.96 * p->cv_years, 1e-12);
    assert_true(q.a.life[3].low_mm < q.a.life[3].depth_mm && q.a.life[3].depth_mm < q.a.life[3].high_mm && isnan(q.a.life[0].with_law_depth_mm));
    /* common random numbers: loads of one shape have lives of one shape, and the largest governs */
    CHECK_RELATIVE(q.a.life[4 + 1].depth_mm / q.a.life[1].depth_mm, q.a.points[1].mean_mm / q.a.points[0].mean_mm, 1e-9);
    assert_int_equal(q.a.service.governing_point, 13);
    fw_answer_free(&q.a);
}

static void the_fan_ends_in_the_life_and_the_allowance_reads_it_across(void **state)
{
    (void)state;
    for (int simulated = 0; simulated < 2; simulated++) {
        asked q;
        prepare(&q);
        q.c.service.persistence = simulated ? 0.9 : 0, q.c.service.year_to_year_cv = simulated ? 0.3 : 0;
        ask(&q);
        q.c.service.allowance = q.a.life[0].depth_mm * 40.5 / YEARS;
        fw_answer_free(&q.a);
        ask(&q);
        const fw_service_answer *s = &q.a.service;
        assert_int_equal(s->n_fan, 2 * YEARS * 5);
        for (size_t k = 0; k < 5; k++) {
            const double ps[] = {5, 50, 90, 95, 99};
            for (size_t year = 0; year < YEARS; year++) {
                const fw_fan_row *row = &s->fan[year * 5 + k];
                assert_true(row->year == (double)year + 1 && row->point == 13);
                CHECK_NEAR(row->percentile, ps[k], 1e-12);
                assert_true(year == 0 || row->depth_mm > s->fan[(year - 1) * 5 + k].depth_mm);
                assert_true(k == 0 || row->depth_mm > s->fan[year * 5 + k - 1].depth_mm);
            }
            if (k > 0) assert_true(s->fan[(YEARS - 1) * 5 + k].depth_mm == q.a.life[k - 1].depth_mm);
        }
        double sum = 0;
        assert_int_equal(s->n_allowance, 2 * YEARS);
        for (size_t year = 0; year < YEARS; year++) {
            sum += s->allowance[year].probability;
            assert_true(s->allowance[year].probability >= 0);
            CHECK_NEAR(s->allowance[year].by_then, sum, 1e-12);
        }
        CHECK_NEAR(sum + s->points[0].never, 1, 1e-12);
        assert_true(s->points[0].allowance_year_p50 == 41 && s->points[0].allowance_year_p5 <= 41 && !(s->points[0].allowance_year_p95 < 41));
        for (size_t k = 0; k < 4; k++) { /* the year in which the percentile of depth passes the allowance */
            size_t year = (size_t)q.a.life[k].allowance_year;
            assert_true(s->fan[(year - 1) * 5 + k + 1].depth_mm >= q.c.service.allowance * (1 - 1e-3));
            assert_true(s->fan[(year - 2) * 5 + k + 1].depth_mm < q.c.service.allowance * (1 + 1e-3));
        }
        fw_answer_free(&q.a);
    }
}

static void years_come_from_a_table(void **state)
{
    (void)state;
    asked           q;
    fw_service_year rows[12];
    prepare(&q);
    ask(&q);
    fw_life_row    plain = q.a.life[1];
    fw_answer_free(&q.a);
    q.c.service.table = rows, q.c.service.n_table = 12;
    for (size_t k = 0; k < 12; k++) rows[k] = (fw_service_year){1200, 1}; /* all alike: no table at all */
    ask(&q);
    CHECK_RELATIVE(q.a.life[1].depth_mm, plain.depth_mm, 2e-3);
    CHECK_RELATIVE(q.a.life[1].high_mm - q.a.life[1].low_mm, plain.high_mm - plain.low_mm, 0.02);
    CHECK_NEAR(q.a.service.points[0].years_half_width, 0, 1e-6);
    assert_string_equal(q.a.service.assumption, "independent windows, years drawn from a table of 12");
    fw_answer_free(&q.a);

    /* hours 600 and 1800 in turn, the long winters twice as wearing: x = 200, 1200 windows; CV 5/7 a year */
    for (size_t k = 0; k < 12; k++) rows[k] = k % 2 ? (fw_service_year){1800, 2} : (fw_service_year){600, 1};
    ask(&q);
    const fw_life_point *p = &q.a.service.points[0];
    CHECK_RELATIVE(p->mean_mm, YEARS * 700 * q.a.points[0].mean_mm, 1e-12);
    CHECK_RELATIVE(p->cv_years, 500.0 / 700 / sqrt(YEARS), 1e-10);
    CHECK_RELATIVE(p->cv_windows, sqrt(window_variance(&q) * (200 + 4 * 600) / 2) / 700 / sqrt(YEARS), 1e-10);
    CHECK_RELATIVE(q.a.life[1].depth_mm, p->mean_mm * (1 + 1.2816 * p->cv), 0.01);
    /* half-width for twelve rows: t(11) s/sqrt(12) of their mean, about 2.2 x 0.746/3.46 */
    CHECK_RELATIVE(p->years_half_width, 2.2 * 0.746 / sqrt(12), 0.2);
    CHECK_NEAR(ledger_of(&q.a, "between years")->amount, p->years_half_width, 0);
    assert_true(q.a.life[1].low_mm < plain.low_mm * 700 / 400 && q.a.life[1].high_mm > plain.high_mm * 700 / 400);
    fw_answer_free(&q.a);

    q.c.service.n_table = 5; /* too few to say what they leave unknown */
    ask(&q);
    assert_true(isnan(q.a.life[1].low_mm) && isnan(q.a.service.points[0].years_half_width) && q.a.life[1].depth_mm > 0);
    fw_answer_free(&q.a);
}

static void a_law_that_is_not_known(void **state)
{
    (void)state;
    asked q;
    prepare(&q);
    q.c.after.has_law_coefficient = true;
    fw_distribution_constant(&q.c.after.law_coefficient, 2);
    ask(&q);
    for (size_t k = 0; k < 4; k++) {
        const fw_life_row *row = &q.a.life[k];
        CHECK_RELATIVE(row->with_law_low_mm, 2 * row->depth_mm, 1e-12);
        CHECK_RELATIVE(row->with_law_high_mm, 2 * row->depth_mm, 1e-12);
        CHECK_RELATIVE(row->with_law_depth_mm, 2 * row->depth_mm, 3e-3); /* simulated against Pearson's law */
    }
    CHECK_NEAR(ledger_of(&q.a, "law and its scatter")->amount, 0, 1e-12);
    fw_answer_free(&q.a);

    /* A factor far wider than lives: its own percentiles on a life's mean. Latin hypercube: scatter and coefficient multiply. */
    q.c.after.has_law_scatter = true;
    q.c.after.law_coefficient = made_up_law(FW_DIST_LOGNORMAL, 0, 0.3), q.c.after.law_scatter = made_up_law(FW_DIST_LOGNORMAL, 0, 0.4);
    ask(&q);
    CHECK_RELATIVE(q.a.life[1].with_law_depth_mm, q.a.service.points[0].mean_mm * exp(0.5 * gsl_cdf_ugaussian_Pinv(0.9)), 0.02);
    CHECK_RELATIVE(q.a.law_scatter.high, exp(0.5 * 1.959964), 0.02);
    CHECK_RELATIVE(q.a.life[1].with_law_high_mm, q.a.life[1].depth_mm * q.a.law_scatter.high, 1e-9);
    CHECK_RELATIVE(q.a.law_scatter.mean, exp(0.125), 5e-3);
    fw_answer_free(&q.a);
}

/* All laws have the same loads and T = -10 degC, so that ln(depth/coefficient) = ln(load) - m ln 10 is straight in the exponent. */
static void exponents_lie_between_the_campaigns_laws(void **state)
{
    (void)state;
    asked q;
    prepare(&q);
    q.c.model.n_laws = 4;
    q.c.model.laws[1] = (fw_abrasion_law){"power", 0.5, 1.4, true};
    q.c.model.laws[2] = (fw_abrasion_law){"power", 0.01, 0.9, true};
    q.c.model.laws[3] = (fw_abrasion_law){"archard", 0.2, 1, false}; /* without temperature: no neighbour */
    q.c.after.has_law_exponent = true;
    fw_distribution_constant(&q.c.after.law_exponent, 1.3);
    ask(&q);
    CHECK_RELATIVE(q.a.life[1].with_law_low_mm, q.a.life[1].depth_mm * pow(10, -(1.3 - 1.121)), 1e-10);
    CHECK_RELATIVE(q.a.life[4 + 1].with_law_low_mm, q.a.life[4 + 1].depth_mm * pow(10, -(1.3 - 1.121)), 1e-10);
    fw_answer_free(&q.a);
    q.c.after.law_exponent = made_up_law(FW_DIST_UNIFORM, 0.9, 1.4);
    ask(&q);
    CHECK_RELATIVE(q.a.law_scatter.median, pow(10, 1.121 - 1.15), 1e-3);
    CHECK_RELATIVE(q.a.law_scatter.high, pow(10, 1.121 - 0.9125), 1e-3);
    fw_answer_free(&q.a);
    fw_answer_options other = two_points;
    other.law = 1; /* what is said is said of the first law */
    assert_int_equal(fw_answer_make(&q.a, &q.c, &q.source, &other, NULL), FW_OK);
    assert_true(isnan(q.a.life[1].with_law_depth_mm) && isnan(ledger_of(&q.a, "law and its scatter")->amount));
    fw_answer_free(&q.a);
    q.c.after.law_exponent = made_up_law(FW_DIST_UNIFORM, 0.9, 1.5);
    assert_int_equal(fw_answer_make(&q.a, &q.c, &q.source, &two_points, NULL), FW_E_ARG);
}

static void the_map_spreads_a_life_over_height(void **state)
{
    (void)state;
    asked q;
    prepare(&q);
    q.c.model.ice_density = 900, q.c.model.water_density = 1000;
    q.c.after.has_water_level = true;
    q.c.after.water_level = made_up_law(FW_DIST_NORMAL, 0, 0.4);
    ask(&q);
    const fw_service_answer *s = &q.a.service;
    assert_true(s->n_map > 0 && s->n_map % 2 == 0);
    double sum = 0, step = s->map[1].height_m - s->map[0].height_m, most = 0;
    for (size_t i = 0; i < s->n_map / 2; i++) sum += s->map[i].depth_mm * step, most = fmax(most, s->map[i].depth_mm);
    /* the level runs its law: over height the depth times the thickness of the ice stays, a height of the wall wears as long as ice is there */
    CHECK_RELATIVE(sum, q.a.life[1].depth_mm * q.a.water_level.thickness, 2e-3);
    CHECK_RELATIVE(most, q.a.life[1].depth_mm * q.a.water_level.most_share, 5e-3);
    for (size_t i = 0; i < s->n_map / 2; i++) {
        const fw_map_row *row = &s->map[s->n_map / 2 + i];
        assert_true(row->point == 10 && row->height_m == s->map[i].height_m && row->percentile == 90);
        CHECK_NEAR(row->depth_mm, s->map[i].depth_mm * q.a.life[4 + 1].depth_mm / q.a.life[1].depth_mm, 1e-9 * most); /* loads of one shape */
    }
    fw_answer_free(&q.a);
}

static void a_point_without_wear(void **state)
{
    (void)state;
    asked             q;
    const size_t      lee[] = {1}; /* its load is 1 + cos of half an arc from 180 degrees: next to nothing, then nothing */
    fw_answer_options o = {.n_points = 1, .points = lee};
    prepare(&q);
    q.records.sigma = 0;
    q.c.service.persistence = 0.9, q.c.service.year_to_year_cv = 0.3, q.c.service.allowance = 1;
    q.records.twist_deg = 0.5; /* the lee arc exactly */
    assert_int_equal(fw_answer_make(&q.a, &q.c, &q.source, &o, NULL), FW_OK);
    assert_true(q.a.life[3].depth_mm < 1e-6 && q.a.service.points[0].never == 1);
    fw_answer_free(&q.a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scatter_has_its_sources),
        cmocka_unit_test(the_fan_ends_in_the_life_and_the_allowance_reads_it_across),
        cmocka_unit_test(years_come_from_a_table),
        cmocka_unit_test(a_law_that_is_not_known),
        cmocka_unit_test(exponents_lie_between_the_campaigns_laws),
        cmocka_unit_test(the_map_spreads_a_life_over_height),
        cmocka_unit_test(a_point_without_wear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
