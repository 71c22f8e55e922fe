/* The emulator on loads that are made up: it finds a law that is log-linear in its functions exactly, and says how large the noise is that was put in. */
#include "study/made_up_site.h"
#include "study/emulator.h"

enum { MOST = 4000 };

typedef double law_of(const fw_scenario *s);

/* n windows with loads law x exp(sigma z); returns the fit, its inputs in static memory. */
static fw_scenario scenarios[MOST];
static double      load[MOST];

static double noise(uint64_t id)
{
    fw_random r;
    fw_random_stream(&r, 5, FW_STREAM_TEST, id, 3);
    return gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r));
}

static void make_windows(const fw_campaign *c, size_t n, law_of *law, double sigma)
{
    for (size_t i = 0; i < n; i++) {
        scenarios[i] = site_scenario(c, SITE_PLAIN, 3, i);
        scenarios[i].wind_speed = 5 + 10 * fabs(sin((double)i)), scenarios[i].wind_angle = 0.7 * (double)i, scenarios[i].tide_phase = 1.3 * (double)i;
        load[i] = law(&scenarios[i]) * exp(sigma * noise(i));
    }
}

static fw_emulator fit(const fw_campaign *c, const fw_sanity *strip, size_t n)
{
    fw_emulator e;
    assert_int_equal(fw_emulator_fit(&e, c, strip, n, scenarios, load, NULL), FW_OK);
    return e;
}

/* Off by how much at scenarios that it was not fitted to, the worst of 200. */
static double worst(const fw_campaign *c, const fw_emulator *e, law_of *law)
{
    double most = 0;
    for (uint64_t i = 0; i < 200; i++) {
        fw_scenario s = site_scenario(c, SITE_PLAIN, 99, i);
        s.wind_speed = 8, s.wind_angle = 1, s.tide_phase = (double)i;
        most = fmax(most, fabs(fw_emulator_ln_load(e, &s) - log(law(&s))));
    }
    return most;
}

static double quadratic(const fw_scenario *s)
{
    double u = log(s->speed), i = log(s->concentration);
    return exp(1 + 2.8 * u + 1.4 * i + 0.1 * u * u - 0.2 * u * i + 0.3 * i * i + (s->mix ? 0.5 + 0.2 * i : 0));
}

static double in_weather(const fw_scenario *s)
{
    double a = cos(s->wind_angle), w = s->wind_speed;
    return site_load(s) * exp(0.05 * w + 0.02 * w * a - 0.001 * w * w + 0.03 * w * a * a + 0.2 * cos(2 * s->tide_phase) - 0.1 * sin(2 * s->tide_phase));
}

static void a_log_linear_law_is_found(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    fw_emulator e;
    (void)state;
    make_windows(&c, 200, site_load, 0);
    e = fit(&c, NULL, 200);
    CHECK_NEAR(worst(&c, &e, site_load), 0, 1e-9);
    CHECK_NEAR(e.held_out, 0, 1e-9);
    CHECK_NEAR(e.dry_share, 0, 0);
    assert_true(e.n == 200 && e.n_functions == 8 && e.strip == NULL); /* 1, u, C, u^2, uC, C^2, mix, mix C */
    make_windows(&c, 200, quadratic, 0);
    e = fit(&c, NULL, 200);
    CHECK_NEAR(worst(&c, &e, quadratic), 0, 1e-8);
    c.model.effects |= FW_EFFECT_WIND | FW_EFFECT_TIDE;
    make_windows(&c, 200, in_weather, 0);
    e = fit(&c, NULL, 200);
    CHECK_NEAR(worst(&c, &e, in_weather), 0, 1e-8);
    c.model.effects = 0;
    e = fit(&c, NULL, 200); /* which it does not look at then */
    assert_true(e.held_out > 0.1);
    fw_site_free(&c.site);
}

/* Errors of windows that were not fitted to: the noise, and what p coefficients from 9/10 of n windows add to its variance, p / (0.9 n). */
static void held_out_errors_are_the_noise(void **state)
{
    double      bearings[24], sigma = 0.15;
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (size_t n = 100; n <= MOST; n *= 2) {
        make_windows(&c, n, site_load, sigma);
        fw_emulator e = fit(&c, NULL, n);
        double      wanted = sigma * sqrt(1 + (double)e.n_functions / (0.9 * (double)n));
        CHECK_RELATIVE(e.held_out, wanted, 4 / sqrt(2 * (double)n));
        double mean = 0, squares = 0;
        for (size_t i = 0; i < n; i++) mean += log(load[i]) / (double)n;
        for (size_t i = 0; i < n; i++) squares += pow(log(load[i]) - mean, 2);
        CHECK_RELATIVE(e.scatter, sqrt(squares / ((double)n - 1)), 1e-12);
        assert_true(worst(&c, &e, site_load) < 20 * sigma / sqrt((double)n)); /* the rim of the scenarios */
    }
    fw_site_free(&c.site);
}

/* A quarter as many functions as windows, and none below twelve. */
static void few_windows_have_few_functions(void **state)
{
    static const size_t n[] = {0, 1, 5, 11, 12, 15, 16, 31, 32, 400}, functions[] = {0, 0, 0, 0, 3, 3, 4, 7, 8, 8};
    double              bearings[24];
    fw_campaign         c = site_campaign(bearings);
    (void)state;
    make_windows(&c, 400, site_load, 0.1);
    for (size_t k = 0; k < sizeof n / sizeof n[0]; k++) {
        fw_emulator e = fit(&c, NULL, n[k]);
        assert_int_equal(e.n_functions, functions[k]);
        assert_int_equal(e.n, functions[k] ? n[k] : 0);
        assert_true(isfinite(e.held_out) == (functions[k] > 0) && isfinite(e.scatter) == (functions[k] > 0));
        CHECK_NEAR(e.dry_share, n[k] ? 0 : 1, 0);
        assert_true(isfinite(fw_emulator_ln_load(&e, &scenarios[0])));
    }
    fw_site_free(&c.site);
}

static void dry_windows_are_counted_and_not_fitted(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    fw_emulator e;
    (void)state;
    make_windows(&c, 400, site_load, 0);
    for (size_t i = 0; i < 400; i++) load[i] = i % 4 ? load[i] : 0;
    e = fit(&c, NULL, 400);
    assert_int_equal(e.n, 300);
    CHECK_NEAR(e.dry_share, 0.25, 1e-15);
    CHECK_NEAR(worst(&c, &e, site_load), 0, 1e-9);
    for (size_t i = 0; i < 400; i++) load[i] = i < 11 ? load[i] : 0;
    e = fit(&c, NULL, 400);
    assert_int_equal(e.n_functions, 0);
    for (size_t i = 0; i < 400; i++) load[i] = 0;
    e = fit(&c, NULL, 400);
    assert_true(e.n_functions == 0 && e.dry_share == 1);
    fw_site_free(&c.site);
}

static double constant(const fw_scenario *s)
{
    (void)s;
    return 0.02;
}

/* What the campaign does not vary gets no coefficient: the mean of ln load is left. */
static void a_constant_campaign_is_its_mean(void **state)
{
    double      bearings[24], mean = 0;
    fw_campaign c = site_campaign(bearings);
    (void)state;
    fw_site_free(&c.site);
    fw_distribution_constant(&c.site.speed, 0.7);
    fw_distribution_constant(&c.site.concentration, 0.4);
    c.model.n_mixes = 1, c.model.mixes[0].probability = 1;
    make_windows(&c, 100, constant, 0.3);
    fw_emulator e = fit(&c, NULL, 100);
    for (size_t i = 0; i < 100; i++) mean += log(load[i]) / 100;
    CHECK_NEAR(fw_emulator_ln_load(&e, &scenarios[0]), mean, 1e-9);
    CHECK_RELATIVE(e.held_out, 0.3, 0.3);
    make_windows(&c, 100, constant, 0); /* not even scatter */
    e = fit(&c, NULL, 100);
    CHECK_NEAR(fw_emulator_ln_load(&e, &scenarios[0]), log(0.02), 1e-9);
    CHECK_NEAR(e.scatter, 0, 1e-12);
    CHECK_NEAR(e.held_out, 0, 1e-9);
}

/* ---- with the swept strip ------------------------------------------------------------------------------------------- */

static const fw_sanity *the_strip;

/* The strip, in whose speeds no quadratic is, and a factor of the concentration. */
static double strip_like(const fw_scenario *s) { return exp(fw_sanity_ln_strip(the_strip, s)) * pow(s->concentration, 0.4); }

static void the_strip_is_a_function(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    fw_sanity   strip;
    (void)state;
    fw_model_defaults(&c.model);
    c.model.n_mixes = 2;
    c.model.mixes[0].probability = 0.6;
    c.model.mixes[1] = (fw_thickness_mix){.probability = 0.4, .n_classes = 1, .classes = {{0.5, 1}}};
    assert_int_equal(fw_sanity_begin(&strip, &c, 0, NULL), FW_OK);
    assert_true(strip.why[0] == 0);
    the_strip = &strip;
    make_windows(&c, 200, strip_like, 0);
    fw_emulator with = fit(&c, &strip, 200), without = fit(&c, NULL, 200);
    assert_true(with.strip == &strip && with.n_functions == 9);
    CHECK_NEAR(worst(&c, &with, strip_like), 0, 1e-7);
    assert_true(with.held_out < 1e-7 && without.held_out > 1e-3);
    snprintf(strip.why, sizeof strip.why, "there is none"); /* then it is as if it were not given */
    fw_emulator none = fit(&c, &strip, 200);
    assert_true(none.strip == NULL && none.held_out == without.held_out);
    fw_sanity_free(&strip);
    fw_site_free(&c.site);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_log_linear_law_is_found),
        cmocka_unit_test(held_out_errors_are_the_noise),
        cmocka_unit_test(few_windows_have_few_functions),
        cmocka_unit_test(dry_windows_are_counted_and_not_fitted),
        cmocka_unit_test(a_constant_campaign_is_its_mean),
        cmocka_unit_test(the_strip_is_a_function),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
