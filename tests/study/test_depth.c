/* What is kept of many records, what the stop rule makes of it, and control variates of a joint table: on the made-up site and on cells with direction laws
 * of their own. */
#include "study/made_up_site.h"

static const double SIGMA = 0.15;

/* ---- thinning ------------------------------------------------------------------------------------------------------ */

/* An eighth of the records, under every way to draw them: each randomisation is left its share, the answers are inside of the intervals, and those grow as the
 * root of the stride at most (where windows are independent; a design's points that are left are spread less evenly). */
static void thinned_records_say_the_same(void **state)
{
    enum { N = 4096, STRIDE = 8 };
    static const double levels[] = {0.5, 0.9};
    double              bearings[24];
    fw_campaign         c = site_campaign(bearings);
    fw_depth            all, few;
    fw_window           of_all, of_few;
    (void)state;
    for (int way = 0; way < SITE_WAYS; way++) {
        site_records s = {.campaign = &c, .way = (site_way)way, .seed = 4, .sigma = SIGMA};
        double       sum = 0;
        size_t       of_unit[SITE_RANDOMISATIONS] = {0};
        site_depth(&all, &s, N, &SITE, 0);
        site_depth(&few, &s, N, &SITE, N / STRIDE);
        assert_true(all.stride == 1 && all.n == N);
        assert_int_equal(few.stride, STRIDE);
        assert_int_equal(few.n, N / STRIDE);
        assert_true(few.n_good == N && few.weight == all.weight && few.n_failed == 0 && few.cpu_s == all.cpu_s);
        for (size_t i = 0; i < few.n; i++) {
            fw_scenario wanted = site_scenario(&c, s.way, s.seed, few.row[i].scenario.id);
            assert_true(wanted.speed == few.row[i].scenario.speed && wanted.weight == few.row[i].scenario.weight);
            if (i > 0) assert_true(few.row[i].scenario.id > few.row[i - 1].scenario.id);
            sum += few.units.weight[i];
            if (way) of_unit[few.row[i].scenario.randomisation]++;
        }
        CHECK_NEAR(sum, 1, 1e-9);
        assert_int_equal(few.n_units, way ? SITE_RANDOMISATIONS : N / STRIDE);
        for (size_t r = 0; r < SITE_RANDOMISATIONS && way; r++) assert_int_equal(of_unit[r], N / STRIDE / SITE_RANDOMISATIONS);
        CHECK_NEAR(fw_depth_ring_mean(&few, 0, FW_DEPTH_RING_LOAD), fw_depth_ring_mean(&all, 0, FW_DEPTH_RING_LOAD), 0); /* of all records */
        assert_int_equal(fw_window_make(&of_all, &all, 0, NULL), FW_OK);
        assert_int_equal(fw_window_make(&of_few, &few, 0, NULL), FW_OK);
        for (size_t k = 0; k < 2; k++) {
            double      x = fw_window_percentile(&of_all, levels[k]);
            fw_interval v = fw_window_interval(&of_few, levels[k], 0.9999), u = fw_window_interval(&of_all, levels[k], 0.9999);
            assert_true(isfinite(v.low) && isfinite(v.high) && v.low < x && x < v.high);
            assert_true(u.high - u.low < v.high - v.low && v.high - v.low < 2.5 * sqrt(STRIDE) * (u.high - u.low));
        }
        fw_interval v = fw_window_mean_interval(&of_few, 0.9999);
        assert_true(v.low < of_all.moment[1] && of_all.moment[1] < v.high);
        fw_window_level l;
        fw_window_look(&of_few, 0.9, &l, few.scratch);
        assert_true(isfinite(l.at.spread.vov) && isfinite(fw_window_mean_vov(&of_few)));
        fw_window_free(&of_all);
        fw_window_free(&of_few);
        fw_depth_free(&all);
        fw_depth_free(&few);
    }
    fw_site_free(&c.site);
}

/* ---- the stop rule ------------------------------------------------------------------------------------------------- */

typedef struct one_carries_all {
    fw_campaign *campaign;
    double       heavy; /* load of window 17, the others have about 0.01 */
} one_carries_all;

static fw_status read_heavy(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    (void)m;
    one_carries_all *s = self;
    fw_scenario      sc = {.id = id, .speed = 0.7, .concentration = 0.4, .weight = 1, .randomisation = -1};
    site_record(r, &sc, id == 17 ? s->heavy : 0.01 * site_ice(5, id, 0.3));
    return FW_OK;
}

/* However wide an interval is allowed to be: where one window carries the variance, nothing is known about it. */
static void one_window_does_not_stop_a_campaign(void **state)
{
    double          bearings[24];
    fw_campaign     c = site_campaign(bearings);
    one_carries_all s = {&c, 0.01};
    fw_reached      r;
    (void)state;
    c.precision.quantity = FW_QUANTITY_MEAN;
    c.precision.half_width = 1e6;
    fw_answer_source source = {.records = {.n = 400, .read = read_heavy, .self = &s}};
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(r.is_enough && r.vov < FW_ANSWER_MOST_VOV && r.most_vov == FW_ANSWER_MOST_VOV);
    s.heavy = 100;
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(!r.is_enough && r.half_width < 1e6);
    CHECK_NEAR(r.vov, 1, 0.01); /* sum z^4 / (sum z^2)^2 of one large z */
    c.precision.quantity = FW_QUANTITY_PERCENTILE, c.precision.percentile = 50; /* which does not feel it */
    assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
    assert_true(r.is_enough && r.vov < FW_ANSWER_MOST_VOV);
    fw_site_free(&c.site);
}

/* Few randomisations have a larger relative variance of their variance without any fault: near 2/R for normal shares, and 3/R is allowed, which normal shares
 * of 16 exceed 6 times of 100 (counted out). 47 campaigns of 50 are expected to be let go, 40 is three standard errors away. */
static void few_randomisations_are_allowed_more(void **state)
{
    enum { CAMPAIGNS = 50 };
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    size_t      n_enough = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= CAMPAIGNS; seed++) {
        site_records     s = {.campaign = &c, .way = SITE_SKEWED, .seed = seed, .sigma = SIGMA};
        fw_answer_source source = {.records = {.n = 320, .read = site_read, .self = &s}, .law = SITE};
        fw_reached       r;
        assert_int_equal(fw_answer_reached(&c, &source, &r, NULL), FW_OK);
        CHECK_NEAR(r.most_vov, 3.0 / SITE_RANDOMISATIONS, 1e-15);
        assert_true(r.vov > 0 && r.half_width < 0.1 && r.is_enough == (r.vov <= r.most_vov));
        n_enough += r.is_enough;
    }
    assert_true(n_enough >= 40);
    fw_site_free(&c.site);
}

/* Precision of two points of 24 is that of a campaign that has no others, whatever their order. */
static void named_points_are_asked_alone(void **state)
{
    double      bearings[24], two[24];
    size_t      named[] = {7, 13}, turned[] = {13, 7}, rear[] = {1};
    fw_campaign c = site_campaign(bearings), alone = site_campaign(two);
    fw_reached  of_two, of_named, of_turned, of_all, of_rear;
    (void)state;
    c.points.n = 24;
    for (size_t i = 0; i < 24; i++) bearings[i] = 15.0 * (double)i;
    alone.points.n = 2, two[0] = bearings[6], two[1] = bearings[12];
    site_records     s = {.campaign = &c, .seed = 3, .sigma = SIGMA};
    fw_answer_source source = {.records = {.n = 400, .read = site_read, .self = &s}, .law = SITE};
    assert_int_equal(fw_answer_reached(&alone, &source, &of_two, NULL), FW_OK);
    assert_int_equal(fw_answer_reached(&c, &source, &of_all, NULL), FW_OK);
    c.precision.n_points = 2, c.precision.points = named;
    assert_int_equal(fw_answer_reached(&c, &source, &of_named, NULL), FW_OK);
    c.precision.points = turned;
    assert_int_equal(fw_answer_reached(&c, &source, &of_turned, NULL), FW_OK);
    assert_true(of_named.half_width == of_two.half_width && of_named.value_mm == of_two.value_mm && of_named.vov == of_two.vov);
    assert_true(of_turned.half_width == of_two.half_width && of_turned.value_mm == of_two.value_mm);
    assert_true(of_named.point == 13 && of_turned.point == 13 && of_two.point == 2);
    assert_true(of_all.point == 12 || of_all.point == 13); /* on both sides of the middle that faces the current */
    c.precision.n_points = 1, c.precision.points = rear;
    assert_int_equal(fw_answer_reached(&c, &source, &of_rear, NULL), FW_OK);
    assert_true(of_rear.point == 1 && of_rear.value_mm < 0.01 * of_all.value_mm);
    c.precision.n_points = 0, c.precision.points = NULL;
    fw_site_free(&c.site);
    fw_site_free(&alone.site);
}

/* ---- a joint table -------------------------------------------------------------------------------------------------- */

/* 60 cells of five concentrations; what flows fast flows to the north or to the east, more and more to the north. T is -10 degC. */
enum { N_CELLS = 60 };

static fw_campaign joint_campaign(double *bearings)
{
    static const double to[] = {0, 90};
    fw_campaign         c = site_campaign(bearings);
    double              sum = 0;
    fw_site_free(&c.site);
    fw_distribution_constant(&c.site.temperature, -10);
    c.points.n = 2, bearings[0] = 180, bearings[1] = 270;
    c.site.n_cells = N_CELLS;
    assert_int_equal(fw_alloc(&c.site.cells, N_CELLS, sizeof *c.site.cells, "cells", NULL), FW_OK);
    for (size_t i = 0; i < N_CELLS; i++) {
        double north = 0.2 + 0.01 * (double)i, weights[] = {north, 1 - north};
        c.site.cells[i] = (fw_site_cell){.speed = 0.1 + 0.025 * (double)i, .concentration = 0.1 + 0.1 * (double)(i % 5), .mix = i % 2,
                                         .probability = exp(-0.05 * (double)i)};
        assert_int_equal(fw_distribution_values(&c.site.cells[i].direction, 2, to, weights, NULL), FW_OK);
        sum += c.site.cells[i].probability;
    }
    for (size_t i = 0; i < N_CELLS; i++) c.site.cells[i].probability /= sum;
    return c;
}

static void cell_point(const fw_campaign *c, uint64_t i, fw_scenario *out)
{
    const fw_site_cell *cell = &c->site.cells[i];
    *out = (fw_scenario){.id = i, .weight = cell->probability, .randomisation = -1, .speed = cell->speed, .concentration = cell->concentration,
                         .mix = cell->mix, .cell = (uint32_t)i};
}

static const fw_scenario_law CELLS = {N_CELLS, cell_point};

/* P(D <= depth): of each cell the share of the time that flows against the point, on its arc 0; the rest of the time it is met from the side, on arc 6 or
 * 18 of 24: bearing - direction - 180 is 90 or 270 degrees. */
static double joint_cdf(const fw_campaign *c, size_t point, double depth)
{
    double      sum = 0, factor = 0.116 * pow(10, -1.121);
    fw_scenario s;
    for (uint64_t i = 0; i < N_CELLS; i++) {
        cell_point(c, i, &s);
        for (size_t k = 0; k < 2; k++) {
            size_t arc = k == point ? 0 : point == 0 ? 18 : 6;
            double ln_load = log(factor * site_load(&s) * site_shape(arc, 24)) - 0.5 * SIGMA * SIGMA;
            sum += s.weight * c->site.cells[i].direction.weights[k] * gsl_cdf_ugaussian_P((log(depth) - ln_load) / SIGMA);
        }
    }
    return sum;
}

static double joint_percentile(const fw_campaign *c, size_t point, double p)
{
    double from = log(1e-9), to = log(1e3);
    for (int i = 0; i < 60; i++) {
        double x = 0.5 * (from + to);
        if (joint_cdf(c, point, exp(x)) < p)
            from = x;
        else
            to = x;
    }
    return exp(from);
}

static void joint_depth(fw_depth *d, const fw_campaign *c, uint64_t seed, size_t n, const fw_scenario_law *law)
{
    fw_record   r;
    fw_random   random;
    fw_scenario s;
    assert_int_equal(fw_depth_make(d, c, 0, c->points.n, c->points.bearing, NULL), FW_OK);
    assert_int_equal(fw_record_init(&r, c->model.n_arcs, 1, NULL), FW_OK);
    for (uint64_t id = 0; id < n; id++) {
        fw_random_stream(&random, seed, FW_STREAM_TEST, id, SITE_STREAM_SCENARIO);
        double u = fw_random_uniform(&random);
        size_t i = 0;
        while (i + 1 < N_CELLS && u >= c->site.cells[i].probability) u -= c->site.cells[i++].probability;
        cell_point(c, i, &s);
        s.id = id, s.weight = 1;
        site_record(&r, &s, site_load(&s) * site_ice(seed, id, SIGMA));
        assert_int_equal(fw_depth_add(d, &r, NULL), FW_OK);
    }
    fw_record_free(&r);
    assert_int_equal(fw_depth_settle(d, law, NULL, NULL), FW_OK);
}

/* Unbiased, half the scatter, and intervals that hold: they are a little too long here, where 25 functions are fitted to 400 windows. */
static void cells_with_directions_of_their_own(void **state)
{
    enum { REPEATS = 500, N = 400 };
    double      bearings[24], truth[2], off[2] = {0}, scatter[2][2] = {{0}};
    size_t      covered[2] = {0}, n_on = 0;
    fw_campaign c = joint_campaign(bearings);
    fw_depth    d;
    fw_window   w;
    (void)state;
    for (size_t p = 0; p < 2; p++) truth[p] = joint_percentile(&c, p, 0.9);
    for (uint64_t seed = 1; seed <= REPEATS; seed++)
        for (size_t with = 0; with < 2; with++) {
            joint_depth(&d, &c, seed, N, with ? &CELLS : NULL);
            n_on += d.control.is_on;
            for (size_t p = 0; p < 2; p++) {
                assert_int_equal(fw_window_make(&w, &d, p, NULL), FW_OK);
                double error = fw_mixture_cdf(&w.mixture, truth[p]) - 0.9;
                scatter[with][p] += error * error / REPEATS;
                off[p] += with ? error / REPEATS : 0;
                fw_interval v = with ? fw_window_interval(&w, 0.9, 0.95) : (fw_interval){0};
                covered[p] += with && v.low <= truth[p] && truth[p] <= v.high;
                fw_window_free(&w);
            }
            fw_depth_free(&d);
        }
    assert_true(n_on > 0.95 * REPEATS);
    for (size_t p = 0; p < 2; p++) {
        CHECK_NEAR(off[p], 0, 4 * sqrt(scatter[1][p] / REPEATS));
        assert_true(scatter[1][p] < 0.25 * scatter[0][p]);
        assert_in_range(covered[p], 0.92 * REPEATS, 0.99 * REPEATS);
    }
    fw_site_free(&c.site);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thinned_records_say_the_same),        cmocka_unit_test(one_window_does_not_stop_a_campaign),
        cmocka_unit_test(few_randomisations_are_allowed_more), cmocka_unit_test(named_points_are_asked_alone),
        cmocka_unit_test(cells_with_directions_of_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
