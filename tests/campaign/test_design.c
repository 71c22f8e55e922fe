#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "campaign/fake_realisation.h"

enum { N = 20000 };

static fw_campaign campaign(uint64_t seed)
{
    fw_campaign c;
    fw_msg      m;

    assert_int_equal(fw_fake_campaign(&c, seed, N, &m), FW_OK);
    return c;
}

/* Asking twice, backwards, or for a far id changes nothing; seed and id both matter. */
static void test_is_pure(void **state)
{
    fw_campaign c = campaign(7), d = campaign(8);
    fw_scenario first[100], again;

    (void)state;
    for (uint64_t i = 0; i < 100; i++) fw_campaign_scenario(&c, i, &first[i]);
    for (uint64_t i = 100; i-- > 0;) {
        fw_campaign_scenario(&c, UINT64_MAX - i, &again);
        fw_campaign_scenario(&c, i, &again);
        assert_memory_equal(&again, &first[i], sizeof again);
        assert_int_equal(again.id, i);
        assert_int_equal(again.seed, 7);
        fw_campaign_scenario(&d, i, &again);
        assert_true(again.speed != first[i].speed);
        if (i > 0) assert_true(first[i].speed != first[i - 1].speed);
    }
    fw_campaign_free(&c);
    fw_campaign_free(&d);
}

/* Turning one quantity into a constant leaves the numbers of the others alone. */
static void test_quantities_have_their_own_numbers(void **state)
{
    fw_campaign c = campaign(7), d = campaign(7);
    fw_scenario a, b;

    (void)state;
    fw_distribution_constant(&d.site.concentration, 0.4);
    for (uint64_t i = 0; i < 50; i++) {
        fw_campaign_scenario(&c, i, &a);
        fw_campaign_scenario(&d, i, &b);
        assert_true(b.concentration == 0.4);
        assert_true(a.speed == b.speed && a.mix == b.mix);
    }
    fw_campaign_free(&c);
    fw_campaign_free(&d);
}

/* Wind and tide draw from streams of their own: switched on they leave the rest alone, and each other. Expected: uniform angles clockwise on
 * [0, 90] deg are anticlockwise on [-pi/2, 0], mean -pi/4; phases even over 2 pi, mean pi. */
static void test_wind_and_tide(void **state)
{
    fw_campaign  c = campaign(7), d = campaign(7);
    fw_scenario  a, b;
    double       angle = 0, phase = 0, product = 0, pi = acos(-1);
    const double sd_angle = pi / 2 / sqrt(12), sd_phase = 2 * pi / sqrt(12);

    (void)state;
    d.model.effects |= FW_EFFECT_WIND | FW_EFFECT_TIDE;
    d.model.tide = (fw_tide){.period = 44712, .phase = NAN};
    fw_distribution_constant(&d.site.wind_speed, 8);
    d.site.wind_angle = (fw_distribution){.kind = FW_DIST_UNIFORM, .b = 90, .low = -INFINITY, .high = INFINITY};
    for (uint64_t i = 0; i < N; i++) {
        fw_campaign_scenario(&c, i, &a);
        fw_campaign_scenario(&d, i, &b);
        assert_true(a.wind_speed == 0 && a.wind_angle == 0 && a.tide_phase == 0);
        assert_true(b.wind_speed == 8 && b.wind_angle <= 0 && b.wind_angle >= -pi / 2 && b.tide_phase > 0 && b.tide_phase < 2 * pi);
        assert_true(a.concentration == b.concentration && a.speed == b.speed && a.mix == b.mix);
        angle += b.wind_angle / N, phase += b.tide_phase / N;
        product += (b.wind_angle + pi / 4) * (b.tide_phase - pi) / N;
        if (i < 20) {
            double was = b.wind_angle;
            d.model.effects &= ~(uint32_t)FW_EFFECT_TIDE;
            fw_campaign_scenario(&d, i, &b);
            assert_true(b.wind_angle == was && b.tide_phase == 0);
            d.model.effects |= FW_EFFECT_TIDE;
        }
    }
    assert_true(fabs(angle + pi / 4) < 5 * sd_angle / sqrt(N));
    assert_true(fabs(phase - pi) < 5 * sd_phase / sqrt(N));
    assert_true(fabs(product) < 5 * sd_angle * sd_phase / sqrt(N));
    d.model.tide.phase = 1;
    fw_campaign_scenario(&d, 3, &b);
    assert_true(b.tide_phase == 1);
    fw_campaign_free(&c);
    fw_campaign_free(&d);
}

/* Means and correlations within five standard errors; uniform on [a, b]: mean (a + b)/2, variance (b - a)^2/12. */
static void test_sampled_means(void **state)
{
    fw_campaign c = campaign(11);
    double      speed = 0, concentration = 0, product = 0, second_mix = 0, mix_speed = 0, root_n = sqrt((double)N);
    fw_scenario s;

    (void)state;
    for (uint64_t i = 0; i < N; i++) {
        fw_campaign_scenario(&c, i, &s);
        assert_true(s.speed > 0.5 && s.speed < 1.5 && s.concentration > 0.2 && s.concentration < 0.6 && s.mix < 2);
        speed += s.speed / N;
        concentration += s.concentration / N;
        product += (s.speed - 1.0) * (s.concentration - 0.4) / N;
        second_mix += (double)s.mix / N;
        mix_speed += ((double)s.mix - 0.75) * (s.speed - 1.0) / N;
    }
    assert_true(fabs(speed - 1.0) < 5 * sqrt(1.0 / 12) / root_n);
    assert_true(fabs(concentration - 0.4) < 5 * sqrt(0.16 / 12) / root_n);
    assert_true(fabs(second_mix - 0.75) < 5 * sqrt(0.75 * 0.25) / root_n);
    /* independent: the covariance's standard error is the product of the standard deviations over sqrt(n) */
    assert_true(fabs(product) < 5 * sqrt(1.0 / 12) * sqrt(0.16 / 12) / root_n);
    assert_true(fabs(mix_speed) < 5 * sqrt(0.75 * 0.25) * sqrt(1.0 / 12) / root_n);
    fw_campaign_free(&c);
}

/* A lognormal speed (mean of ln 0, sd 0.5): E = exp(0.125), Var = (exp(0.25) - 1) exp(0.25). */
static void test_lognormal_speed(void **state)
{
    fw_campaign c = campaign(3);
    double      mean = 0;
    fw_scenario s;

    (void)state;
    c.site.speed = (fw_distribution){.kind = FW_DIST_LOGNORMAL, .b = 0.5, .low = -INFINITY, .high = INFINITY};
    for (uint64_t i = 0; i < N; i++) {
        fw_campaign_scenario(&c, i, &s);
        mean += s.speed / N;
    }
    assert_true(fabs(mean - exp(0.125)) < 5 * sqrt((exp(0.25) - 1) * exp(0.25) / N));
    fw_campaign_free(&c);
}

/* A joint table: every cell is met in its share of realisations and brings all its values together. */
static void test_joint_table(void **state)
{
    static const double probability[] = {0.1, 0.0, 0.4, 0.5}, speed[] = {0.2, 0.3, 1.0, 2.0};
    fw_campaign         c        = campaign(5);
    double              count[4] = {0};
    fw_scenario         s;

    (void)state;
    c.site.n_cells = 4;
    assert_int_equal(fw_alloc(&c.site.cells, 4, sizeof *c.site.cells, "cells", NULL), FW_OK);
    for (uint32_t i = 0; i < 4; i++) {
        c.site.cells[i] = (fw_site_cell){.probability   = probability[i],
                                         .speed         = speed[i],
                                         .concentration = 0.1 * (i + 1),
                                         .mix           = i % 2};
        fw_distribution_constant(&c.site.cells[i].direction, 45.0 * i);
    }
    for (uint64_t i = 0; i < N; i++) {
        fw_campaign_scenario(&c, i, &s);
        assert_in_range(s.cell, 0, 3);
        assert_true(s.speed == speed[s.cell] && s.concentration == 0.1 * (s.cell + 1) && s.mix == s.cell % 2);
        assert_true(fw_site_direction(&c.site, &s) == &c.site.cells[s.cell].direction);
        count[s.cell] += 1;
    }
    for (int i = 0; i < 4; i++) {
        double p = probability[i];

        assert_true(fabs(count[i] / N - p) <= 5 * sqrt(p * (1 - p) / N)); /* an impossible cell is never met */
    }
    fw_campaign_free(&c);
}

static void test_free_twice(void **state)
{
    fw_campaign c = campaign(1), empty;

    (void)state;
    fw_campaign_free(&c);
    fw_campaign_free(&c);
    memset(&empty, 0, sizeof empty);
    fw_campaign_free(&empty);
    fw_campaign_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_is_pure),         cmocka_unit_test(test_quantities_have_their_own_numbers),
        cmocka_unit_test(test_wind_and_tide),
        cmocka_unit_test(test_sampled_means),   cmocka_unit_test(test_lognormal_speed),
        cmocka_unit_test(test_joint_table),     cmocka_unit_test(test_free_twice),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
