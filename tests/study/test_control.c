/* Control variates on made-up windows whose law is known (made_up_site.h): weights, what they reproduce, unbiased and narrower estimates, and intervals
 * that hold, under plain sampling and under designs in randomisations. */
#include "study/made_up_site.h"

static const double SIGMA = 0.15; /* of ln ice, as on the default campaign */

/* Weighted mean over the kept records minus that over the law. */
static double off(const fw_depth *d, double (*f)(const fw_depth *d, const fw_scenario *s))
{
    double      sum = 0;
    fw_scenario s;
    for (size_t i = 0; i < d->n; i++) sum += d->units.weight[i] * f(d, &d->row[i].scenario);
    for (uint64_t i = 0; i < SITE_LAW; i++) {
        site_law_point(d->campaign, i, &s);
        sum -= s.weight * f(d, &s);
    }
    return sum;
}

static double emulated(const fw_depth *d, const fw_scenario *s) { return exp(fw_emulator_ln_load(&d->control.emulator, s)); }
static double ln_concentration(const fw_depth *d, const fw_scenario *s) { return (void)d, log(s->concentration); }
static double second_mix(const fw_depth *d, const fw_scenario *s) { return (void)d, s->mix; }
static double both(const fw_depth *d, const fw_scenario *s) { return (void)d, s->mix * log(s->concentration); }

static void weights_reproduce_the_law(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    fw_depth    d;
    size_t      n_loads = 0;
    (void)state;
    for (int way = 0; way < SITE_WAYS; way++)
        for (uint64_t seed = 1; seed <= 10; seed++) {
            site_records s = {.campaign = &c, .way = (site_way)way, .seed = seed, .sigma = SIGMA};
            double       sum = 0, plain = 0;
            site_depth(&d, &s, 600, &SITE, 0);
            assert_true(d.control.is_on && d.control.least > 0 && d.control.most < 5);
            for (size_t i = 0; i < d.n; i++) {
                assert_true(d.units.weight[i] > 0);
                sum += d.units.weight[i], plain += d.plain[i];
            }
            CHECK_NEAR(sum, 1, 1e-9);
            CHECK_NEAR(plain, 1, 1e-12);
            assert_int_equal(d.n_units, way ? SITE_RANDOMISATIONS : 600);
            if (d.control.has_load) { /* the first attempt, with all functions */
                n_loads++;
                CHECK_NEAR(off(&d, emulated), 0, 1e-9);
                CHECK_NEAR(off(&d, ln_concentration), 0, 1e-9);
                CHECK_NEAR(off(&d, second_mix), 0, 1e-9);
                CHECK_NEAR(off(&d, both), 0, 1e-9);
            }
            fw_depth_free(&d);
        }
    assert_true(n_loads >= 20); /* without it only where few windows of the fastest currents were drawn */
    fw_site_free(&c.site);
}

/* ---- estimates and intervals ------------------------------------------------------------------------------------- */

enum { N_LEVELS = 2, MEAN = N_LEVELS, N_ESTIMATES };
static const double LEVEL[N_LEVELS] = {0.5, 0.9};

typedef struct repeats {
    double sum[N_ESTIMATES], squares[N_ESTIMATES]; /* of F at the true percentile less its level, of the mean over its truth less 1 */
    double width[N_ESTIMATES];                     /* sums of relative half-widths */
    size_t n, covered[N_ESTIMATES], n_controlled;
} repeats;

static void take(repeats *to, int k, double error, double truth, fw_interval v)
{
    to->sum[k] += error, to->squares[k] += error * error;
    to->width[k] += 0.5 * (v.high - v.low) / truth;
    to->covered[k] += v.low <= truth && truth <= v.high;
}

/* E D: the product of means, that of |T|^-m by closed form. */
static double mean_depth(const fw_campaign *c)
{
    const double m = 1.121;
    double       load = 0, factor = 0.116 * (pow(12, 1 - m) - pow(2, 1 - m)) / (1 - m) / 10;
    fw_scenario  s;
    for (uint64_t i = 0; i < SITE_LAW; i++) {
        site_law_point(c, i, &s);
        load += s.weight * site_load(&s);
    }
    return factor * load * site_shape(0, c->model.n_arcs);
}

static double truth[N_ESTIMATES]; /* by quadrature */

static int find_truth(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (int k = 0; k < N_LEVELS; k++) truth[k] = site_percentile(&c, SIGMA, LEVEL[k]);
    truth[MEAN] = mean_depth(&c);
    fw_site_free(&c.site);
    return 0;
}

static repeats repeat(const fw_campaign *c, site_way way, size_t n, const fw_scenario_law *law, size_t n_repeats)
{
    repeats out = {.n = n_repeats};
    for (size_t i = 0; i < n_repeats; i++) {
        site_records s = {.campaign = c, .way = way, .seed = 1000 + i, .sigma = SIGMA};
        fw_depth     d;
        fw_window    w;
        site_depth(&d, &s, n, law, 0);
        assert_int_equal(fw_window_make(&w, &d, 0, NULL), FW_OK);
        out.n_controlled += d.control.is_on;
        for (int k = 0; k < N_LEVELS; k++) take(&out, k, fw_mixture_cdf(&w.mixture, truth[k]) - LEVEL[k], truth[k], fw_window_interval(&w, LEVEL[k], 0.95));
        take(&out, MEAN, w.moment[1] / truth[MEAN] - 1, truth[MEAN], fw_window_mean_interval(&w, 0.95));
        fw_window_free(&w);
        fw_depth_free(&d);
    }
    return out;
}

static double spread_over(const repeats *r, int k) { return sqrt(r->squares[k] / (double)r->n - pow(r->sum[k] / (double)r->n, 2)); }

static const char *const NAME[N_ESTIMATES] = {"P50", "P90", "mean"};

/* Within four standard errors over the repeats. The mean is off by more, to one side: without the load among the functions it goes with what was drawn, and
 * samples without fast windows are those that have no room for it. That is less than a tenth of what plain sampling scatters by. */
static void is_unbiased(const repeats *r, const char *what, double plain_scatter)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double mean = r->sum[k] / (double)r->n, error = spread_over(r, k) / sqrt((double)r->n);
        if (!(fabs(mean) < 4 * error + (k == MEAN ? 0.1 * plain_scatter : 0))) fail_msg("%s, %s: off by %g +- %g", what, NAME[k], mean, error);
    }
}

/* 95 % to within three standard errors of 500 repeats. */
static void is_covered(const repeats *r, const char *what)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double covered = (double)r->covered[k] / (double)r->n;
        if (!(covered >= (k == MEAN ? 0.91 : 0.92) && covered <= 0.98)) fail_msg("%s, %s: covered %.3f", what, NAME[k], covered);
    }
}

/* Percentiles scatter by less than this part of what they do without control. */
static void is_narrower(const repeats *with, const repeats *without, const char *what, double part)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double ratio = spread_over(with, k) / spread_over(without, k);
        if (!(ratio < part)) fail_msg("%s, %s: %.3f of the scatter without control", what, NAME[k], ratio);
    }
}

/* With control variates as with 16 times as many windows; measured 30 to 70 times for P50 and P90. */
static void plain_sampling(void **state)
{
    enum { REPEATS = 500, FEWER = 100 };
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (size_t n = 200; n <= 400; n *= 2) {
        char what[32];
        snprintf(what, sizeof what, "plain, n = %zu", n);
        repeats with = repeat(&c, SITE_PLAIN, n, &SITE, REPEATS), without = repeat(&c, SITE_PLAIN, n, NULL, FEWER);
        assert_true(with.n_controlled >= 0.9 * REPEATS && without.n_controlled == 0);
        is_unbiased(&with, what, spread_over(&without, MEAN));
        is_unbiased(&without, what, 0);
        is_covered(&with, what);
        is_narrower(&with, &without, what, 0.3);
    }
    fw_site_free(&c.site);
}

/* What a design has gained already cannot be gained again: Sobol points know P50 twice as well as plain ones to begin with. */
static void designs(void **state)
{
    enum { REPEATS = 500, FEWER = 100, N = 256 };
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (int way = 1; way < SITE_WAYS; way++) {
        repeats with = repeat(&c, (site_way)way, N, &SITE, REPEATS), without = repeat(&c, (site_way)way, N, NULL, FEWER);
        is_unbiased(&with, SITE_WAY[way], spread_over(&without, MEAN));
        is_unbiased(&without, SITE_WAY[way], 0);
        is_covered(&with, SITE_WAY[way]);
        is_narrower(&with, &without, SITE_WAY[way], 0.65);
    }
    fw_site_free(&c.site);
}

/* ---- sites with nothing to gain ----------------------------------------------------------------------------------- */

static void one_point(const fw_campaign *c, uint64_t i, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = i, .weight = 1, .randomisation = -1, .speed = 0.7, .concentration = 0.4};
}

static void is_plain(const fw_depth *d)
{
    assert_true(!d->control.is_on && !d->control.has_load && d->control.least == 1 && d->control.most == 1);
    assert_int_equal(d->units.n_fitted, 1);
    for (size_t i = 0; i < d->n; i++) CHECK_NEAR(d->units.weight[i], d->plain[i], 1e-15);
}

static void one_scenario_has_no_control(void **state)
{
    const fw_scenario_law one = {1, one_point};
    double                bearings[24];
    fw_campaign           c = site_campaign(bearings);
    fw_depth              d;
    fw_window             w;
    (void)state;
    fw_site_free(&c.site);
    fw_distribution_constant(&c.site.speed, 0.7);
    fw_distribution_constant(&c.site.concentration, 0.4);
    c.model.n_mixes = 1, c.model.mixes[0].probability = 1;
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    site_records s = {.campaign = &c, .seed = 1, .sigma = 0.5};
    site_depth(&d, &s, 400, &one, 0);
    is_plain(&d);
    assert_int_equal(fw_window_make(&w, &d, 0, NULL), FW_OK);
    assert_string_equal(fw_window_method(&w), "averaged CDF");
    fw_window_free(&w);
    fw_depth_free(&d);
}

static double alike(const fw_scenario *s)
{
    (void)s;
    return 0.01;
}

/* Few windows; a law that is not known; scenarios that all wear alike. */
static void too_little_to_know(void **state)
{
    double       bearings[24];
    fw_campaign  c = site_campaign(bearings);
    site_records s = {.campaign = &c, .seed = 1, .sigma = SIGMA}, same = {.campaign = &c, .seed = 1, .load = alike};
    fw_depth     d;
    (void)state;
    site_depth(&d, &s, 59, &SITE, 0);
    is_plain(&d);
    fw_depth_free(&d);
    site_depth(&d, &s, 400, NULL, 0);
    is_plain(&d);
    fw_depth_free(&d);
    site_depth(&d, &same, 400, &SITE, 0);
    is_plain(&d);
    fw_depth_free(&d);
    fw_site_free(&c.site);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_reproduce_the_law), cmocka_unit_test(plain_sampling),     cmocka_unit_test(designs),
        cmocka_unit_test(one_scenario_has_no_control), cmocka_unit_test(too_little_to_know),
    };
    return cmocka_run_group_tests(tests, find_truth, NULL);
}
