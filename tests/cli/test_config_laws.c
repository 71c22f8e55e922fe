/* Distributions and the joint table as campaign files say them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/config_check.h"

/* speed and direction replaced in a small campaign */
static void read_laws(fw_campaign *c, const char *speed, const char *direction, const char *concentration,
                      const char *temperature)
{
    char   text[1024];
    fw_msg m;

    snprintf(text, sizeof text, "ice: {temperature: %s, concentration: %s}\ncurrent: {speed: %s, direction: %s}\n",
             temperature ? temperature : "-10 degC", concentration ? concentration : "40 %", speed ? speed : "1 m/s",
             direction ? direction : "0 deg");
    if (read_campaign_text(c, text, &m) != FW_OK) fail_msg("%s", m.text);
}

static void speeds(void **state)
{
    static const struct {
        const char          *text;
        fw_distribution_kind kind;
        double               a, b, c, low, high;
    } rows[] = {
        {"2 m/s", FW_DIST_CONSTANT, 2, 0, 0, -INFINITY, INFINITY},
        {"2m/s", FW_DIST_CONSTANT, 2, 0, 0, -INFINITY, INFINITY},
        {"{constant: 200 cm/s}", FW_DIST_CONSTANT, 2, 0, 0, -INFINITY, INFINITY},
        {"{uniform: [0.5 m/s, 3.6 km/h]}", FW_DIST_UNIFORM, 0.5, 1, 0, -INFINITY, INFINITY},
        {"{uniform: {low: 0.5 m/s, high: 2 m/s}, max: 1 m/s}", FW_DIST_UNIFORM, 0.5, 2, 0, -INFINITY, 1},
        {"{normal: {mean: 1 m/s, sd: 20 cm/s, min: 0.1 m/s, max: 2 m/s}}", FW_DIST_NORMAL, 1, 0.2, 0, 0.1, 2},
        {"{weibull: {scale: 0.4 m/s, shape: 1.6}}", FW_DIST_WEIBULL, 0.4, 1.6, 0, -INFINITY, INFINITY},
        {"{weibull: {scale: 0.4 m/s, shape: 1.6}, min: 0.1 m/s}", FW_DIST_WEIBULL, 0.4, 1.6, 0, 0.1, INFINITY},
        {"{weibull: {location: 20 cm/s, scale: 0.4 m/s, shape: 1.6}}", FW_DIST_WEIBULL, 0.4, 1.6, 0.2, -INFINITY, INFINITY},
        {"{gamma: {shape: 2, scale: 0.2 m/s}}", FW_DIST_GAMMA, 2, 0.2, 0, -INFINITY, INFINITY},
        {"{triangular: [0.1 m/s, 0.3 m/s, 1 m/s]}", FW_DIST_TRIANGULAR, 0.1, 0.3, 1, -INFINITY, INFINITY},
        {"{lognormal: {median: 0.5 m/s, sigma: 0.3}}", FW_DIST_LOGNORMAL, -0.69314718055994530942, 0.3, 0, -INFINITY,
         INFINITY},
    };
    fw_campaign c;
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        read_laws(&c, rows[i].text, NULL, NULL, NULL);
        const fw_distribution *d = &c.site.speed;
        if (d->kind != rows[i].kind || fabs(d->a - rows[i].a) > 1e-15 || d->b != rows[i].b || d->c != rows[i].c ||
            d->low != rows[i].low || d->high != rows[i].high) {
            fail_msg("%s: %g %g %g [%g, %g]", rows[i].text, d->a, d->b, d->c, d->low, d->high);
        }
        fw_campaign_free(&c);
    }
}

/* mean and cv are those of the value itself: the law's own mean, and its second moment by a fine quantile rule. */
static void lognormal_by_mean_and_cv(void **state)
{
    enum { N = 200000 };
    fw_campaign c;
    double      sum = 0, sum2 = 0;
    (void)state;

    read_laws(&c, "{lognormal: {mean: 0.6 m/s, cv: 30 %}}", NULL, NULL, NULL);
    assert_true(fabs(fw_distribution_mean(&c.site.speed) - 0.6) < 1e-12);
    for (int i = 0; i < N; i++) {
        double x = fw_distribution_quantile(&c.site.speed, (i + 0.5) / N);
        sum += x / N;
        sum2 += x * x / N;
    }
    assert_true(fabs(sqrt(sum2 - sum * sum) / sum - 0.3) < 1e-4); /* what the midpoint rule leaves of the tail */
    fw_campaign_free(&c);
}

static void fractions_and_temperatures(void **state)
{
    fw_campaign c;
    (void)state;

    read_laws(&c, NULL, NULL, "{beta: {alpha: 2, beta: 3, min: 10 %, max: 60 %}}",
              "{triangular: [-20 degC, 263.15 K, -2 degC]}");
    assert_true(c.site.concentration.a == 2 && c.site.concentration.b == 3);
    assert_true(c.site.concentration.c == 0.1 && c.site.concentration.d == 0.6);
    assert_true(fabs(c.site.temperature.b + 10) < 1e-12);
    fw_campaign_free(&c);
    read_laws(&c, NULL, NULL, "{beta: {alpha: 2, beta: 3}, max: 50 %}",
              "{normal: {mean: -8 degC, sd: 2 degC, max: -1.8 degC}}");
    assert_true(c.site.concentration.c == 0 && c.site.concentration.d == 1 && c.site.concentration.high == 0.5);
    assert_true(c.site.temperature.b == 2 && c.site.temperature.high == -1.8);
    fw_campaign_free(&c);
    read_laws(&c, NULL, NULL, "{values: [10 %, 30 %]}", "{values: [-5 degC, -1 degC], max: -2 degC}");
    assert_true(c.site.concentration.weights[0] == 0.5);
    assert_true(fw_distribution_max(&c.site.temperature) == -5);
    fw_campaign_free(&c);
}

static void directions(void **state)
{
    fw_campaign c;
    (void)state;

    read_laws(&c, NULL, "-90 deg", NULL, NULL);
    assert_true(c.site.direction.a == 270);
    fw_campaign_free(&c);
    read_laws(&c, NULL, "{rose: {-90 deg: 1, 270 deg: 1, 360 deg: 2}}", NULL, NULL);
    assert_int_equal(c.site.direction.n, 2);
    assert_true(c.site.direction.values[0] == 0 && c.site.direction.weights[0] == 0.5 &&
                c.site.direction.values[1] == 270);
    fw_campaign_free(&c);
    read_laws(&c, NULL, "{uniform: [-30 deg, 30 deg]}", NULL, NULL);
    assert_true(c.site.direction.a == -30);
    fw_campaign_free(&c);
}

static void value_table(void **state)
{
    fw_campaign c;
    (void)state;

    read_laws(&c, "{table: speeds.csv}", NULL, NULL, NULL); /* 3.6 km/h with 0.25, 7.2 km/h with 75 % */
    assert_int_equal(c.site.speed.n, 2);
    assert_true(fabs(c.site.speed.values[0] - 1) < 1e-15 && fabs(c.site.speed.values[1] - 2) < 1e-15);
    assert_true(c.site.speed.weights[1] == 0.75);
    fw_campaign_free(&c);
}

/* tests/cli/good/joint.csv by hand: rows 1, 2 (one direction, 450 = 90) and 3 make the cell (0.5 m/s, 40 %), row 4
 * the cell (1 m/s, 60 %); each is split over the mixes 0.25 : 0.75. */
static void joint_without_thickness(void **state)
{
    static const double probability[4] = {0.6 * 0.25, 0.6 * 0.75, 0.4 * 0.25, 0.4 * 0.75};
    fw_campaign         c;
    fw_msg              m = {""};
    (void)state;

    if (fw_config_campaign(&c, GOOD "joint.yaml", 0, NULL, -1, &m) != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(c.site.n_cells, 4);
    for (size_t i = 0; i < 4; i++) {
        const fw_site_cell *cell = &c.site.cells[i];
        assert_true(fabs(cell->probability - probability[i]) < 1e-15);
        assert_int_equal(cell->mix, i % 2);
        assert_true(cell->speed == (i < 2 ? 0.5 : 1) && cell->concentration == (i < 2 ? 0.4 : 0.6));
        assert_int_equal(cell->direction.n, i < 2 ? 2 : 1);
    }
    assert_true(c.site.cells[1].direction.values[0] == 90 && fabs(c.site.cells[1].direction.weights[0] - 0.5) < 1e-15);
    assert_true(c.site.cells[1].direction.values[1] == 270 && c.site.cells[2].direction.values[0] == 0);
    fw_campaign_free(&c);
}

/* tests/cli/good/joint-thickness.csv by hand: (0.5, 0.4, 0.5 m): 0.4, (0.5, 0.4, 0.7 m): 0.2, (1, 0.6, 0.7 m): 0.4. */
static void joint_with_thickness(void **state)
{
    fw_campaign c;
    fw_msg      m = {""};
    (void)state;

    if (fw_config_campaign(&c, GOOD "joint-thickness.yaml", 0, NULL, -1, &m) != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(c.model.n_mixes, 2);
    assert_true(c.model.mixes[0].classes[0].thickness == 0.5 && c.model.mixes[1].classes[0].thickness == 0.7);
    assert_true(fabs(c.model.mixes[0].probability - 0.4) < 1e-15 && fabs(c.model.mixes[1].probability - 0.6) < 1e-15);
    assert_int_equal(c.site.n_cells, 3);
    assert_true(c.site.cells[0].mix == 0 && fabs(c.site.cells[0].probability - 0.4) < 1e-15);
    assert_true(fabs(c.site.cells[0].direction.weights[1] - 0.25) < 1e-15 &&
                c.site.cells[0].direction.values[1] == 180);
    assert_true(c.site.cells[1].mix == 1 && fabs(c.site.cells[1].probability - 0.2) < 1e-15);
    assert_true(c.site.cells[2].mix == 1 && c.site.cells[2].speed == 1 && c.site.cells[2].concentration == 0.6);
    uint64_t hash = c.hash;
    fw_campaign_free(&c);

    static const char *const sets[] = {"current.joint=joint-thickness-shuffled.csv"};
    if (fw_config_campaign(&c, GOOD "joint-thickness.yaml", 1, sets, -1, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(c.hash == hash); /* the order of rows does not matter */
    fw_campaign_free(&c);
    static const char *const turned[] = {"current.joint=joint-thickness-turned.csv"};
    if (fw_config_campaign(&c, GOOD "joint-thickness.yaml", 1, turned, -1, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(c.hash != hash); /* its directions do */
    fw_campaign_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(speeds),
        cmocka_unit_test(lognormal_by_mean_and_cv),
        cmocka_unit_test(fractions_and_temperatures),
        cmocka_unit_test(directions),
        cmocka_unit_test(value_table),
        cmocka_unit_test(joint_without_thickness),
        cmocka_unit_test(joint_with_thickness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
