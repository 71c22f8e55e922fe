/* fw_campaign_law: the law of scenarios as weighted points, against closed forms and quadrature over quantile levels. */
#include "campaign/designs.h"

static void weights_sum_to_one(const fw_campaign *c)
{
    fw_scenario_law law = fw_campaign_law(c);
    fw_scenario     s, again;
    double          sum = 0;
    for (uint64_t i = 0; i < law.n; i++) {
        law.point(c, i, &s);
        if (i % 16 == 0) law.point(c, i, &again);
        assert_true(s.weight >= 0 && s.randomisation < 0 && (i % 16 || (s.speed == again.speed && s.weight == again.weight)));
        sum += s.weight;
    }
    CHECK_NEAR(sum, 1, 1e-12);
}

/* Whatever the design: the law knows of none. */
static void every_kind_of_site(void **state)
{
    (void)state;
    for (int way = 0; way < N_WAYS; way++) {
        fw_campaign c = designs_campaign(7, way, 16), joint = designs_joint_campaign(7, way);
        weights_sum_to_one(&c);
        weights_sum_to_one(&joint);
        designs_add_weather(&c);
        designs_add_weather(&joint);
        weights_sum_to_one(&c);
        weights_sum_to_one(&joint);
        fw_campaign_free(&c);
        fw_campaign_free(&joint);
    }
}

static void a_constant_campaign_is_one_point(void **state)
{
    fw_campaign c = designs_campaign(7, 4, 16);
    fw_scenario s;
    (void)state;
    fw_distribution_constant(&c.site.speed, 0.7);
    fw_distribution_constant(&c.site.concentration, 0.4);
    assert_true(fw_campaign_law(&c).n > 1); /* two mixes */
    c.model.n_mixes = 1, c.model.mixes[0].probability = 1;
    fw_scenario_law law = fw_campaign_law(&c);
    assert_int_equal(law.n, 1);
    law.point(&c, 0, &s);
    assert_true(s.weight == 1 && s.speed == 0.7 && s.concentration == 0.4 && s.mix == 0 && s.cell == 0);
    designs_add_weather(&c);
    assert_true(fw_campaign_law(&c).n > 1);
    weights_sum_to_one(&c);
    fw_campaign_free(&c);
}

/* The cells themselves, the impossible one with nothing. */
static void a_joint_table_is_exact(void **state)
{
    fw_campaign     c = designs_joint_campaign(7, 0);
    fw_scenario_law law = fw_campaign_law(&c);
    fw_scenario     s;
    (void)state;
    assert_int_equal(law.n, 4);
    for (uint32_t i = 0; i < 4; i++) {
        law.point(&c, i, &s);
        assert_true(s.cell == i && s.weight == CELL_SHARE[i] && s.speed == CELL_SPEED[i] && s.concentration == 0.1 * (i + 1) && s.mix == i % 2);
    }
    fw_campaign_free(&c);
}

/* E and E^2 of x^power by the midpoint rule over v of quantile levels 1 - (1 - v)^3, smooth up to the upper end; a law of values by its sum. */
static void moments_of_power(const fw_distribution *d, double power, double *one, double *two)
{
    enum { LEVELS = 20000 };
    bool   is_values = d->kind == FW_DIST_VALUES;
    size_t n = is_values ? d->n : LEVELS;
    *one = *two = 0;
    for (size_t i = 0; i < n; i++) {
        double back = 1 - ((double)i + 0.5) / LEVELS;
        double x = pow(is_values ? d->values[i] : fw_distribution_quantile(d, 1 - back * back * back), power);
        double w = is_values ? d->weights[i] : 3 * back * back / LEVELS;
        *one += w * x, *two += w * x * x;
    }
}

/* exp of a sum of ln u, ln C and something of the mix: the product of three averages. Errors over the scatter of the function, of the default
 * campaign's exponents and others. */
enum { N_FUNCTIONS = 6 };
static const double EXPONENT[N_FUNCTIONS][2] = {{1, 0}, {3, 0}, {0, 1.5}, {3, 1.5}, {2, 3}, {-0.2, -1}};

static void log_linear_functions(const fw_campaign *c, const char *site)
{
    fw_scenario_law law = fw_campaign_law(c);
    fw_scenario     s;
    double          got[N_FUNCTIONS] = {0}, heavy = c->model.mixes[1].probability, factor = 1.4;
    for (uint64_t i = 0; i < law.n; i++) {
        law.point(c, i, &s);
        for (size_t k = 0; k < N_FUNCTIONS; k++) got[k] += s.weight * pow(s.speed, EXPONENT[k][0]) * pow(s.concentration, EXPONENT[k][1]) * (s.mix ? factor : 1);
    }
    for (size_t k = 0; k < N_FUNCTIONS; k++) {
        double u1, u2, c1, c2;
        moments_of_power(&c->site.speed, EXPONENT[k][0], &u1, &u2);
        moments_of_power(&c->site.concentration, EXPONENT[k][1], &c1, &c2);
        double mean = u1 * c1 * (1 - heavy + heavy * factor), scatter = sqrt(u2 * c2 * (1 - heavy + heavy * factor * factor) - mean * mean);
        if (!(fabs(got[k] - mean) < 1e-4 * scatter))
            fail_msg("%s, u^%g C^%g: %.2g of the scatter", site, EXPONENT[k][0], EXPONENT[k][1], (got[k] - mean) / scatter);
    }
}

static void averages_are_right_to_a_ten_thousandth(void **state)
{
    static const double values[] = {0.2, 0.4, 0.6}, weights[] = {0.3, 0.5, 0.2};
    (void)state;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        fw_campaign c = designs_campaign(seed, 0, 0);
        log_linear_functions(&c, "uniform laws");
        c.site.speed = (fw_distribution){.kind = FW_DIST_WEIBULL, .a = 0.4, .b = 1.6, .low = 0.05, .high = 2};
        log_linear_functions(&c, "a Weibull speed");
        assert_int_equal(fw_distribution_values(&c.site.concentration, 3, values, weights, NULL), FW_OK);
        log_linear_functions(&c, "three concentrations");
        fw_campaign_free(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_site), cmocka_unit_test(a_constant_campaign_is_one_point), cmocka_unit_test(a_joint_table_is_exact),
        cmocka_unit_test(averages_are_right_to_a_ten_thousandth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
