/* Control variates on made-up windows whose law is known (made_up_site.h): weights, what they reproduce, unbiased and narrower estimates, and intervals
 * that hold (under designs in randomisations: test_control_designs.c). */
#include "study/repeats.h"

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
        cmocka_unit_test(weights_reproduce_the_law), cmocka_unit_test(plain_sampling),
        cmocka_unit_test(one_scenario_has_no_control), cmocka_unit_test(too_little_to_know),
    };
    return cmocka_run_group_tests(tests, find_truth, NULL);
}
