/* Strata against products of level widths, and the law that what is placed in a stratum is found there again. */
#include "campaign/strata.h"
#include "check.h"

static const double OPEN = INFINITY;

static fw_distribution law(fw_distribution_kind kind, double a, double b, double low, double high)
{
    return (fw_distribution){.kind = kind, .a = a, .b = b, .low = low, .high = high};
}

static fw_model mixes(size_t n, const double *probability)
{
    fw_model m;
    fw_model_defaults(&m);
    m.n_mixes = n;
    for (size_t i = 0; i < n; i++) m.mixes[i] = m.mixes[0], m.mixes[i].probability = probability[i];
    return m;
}

static double sum_of_shares(const fw_strata *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++) {
        assert_true(fw_strata_share(s, i) >= 0);
        sum += fw_strata_share(s, i);
    }
    return sum;
}

static fw_scenario scenario_at(const fw_strata *s, size_t stratum, double at_speed, double at_concentration)
{
    double      u_speed, u_concentration;
    fw_scenario sc = {.weight = 1};
    fw_strata_place(s, stratum, at_speed, at_concentration, &u_speed, &u_concentration, &sc.mix);
    sc.speed = fw_distribution_quantile(&s->site->speed, u_speed);
    sc.concentration = fw_distribution_quantile(&s->site->concentration, u_concentration);
    return sc;
}

/* Of every stratum with a share: corners and middle of its square. */
static void found_again(const fw_strata *s)
{
    static const double at[] = {1e-6, 0.5, 1 - 1e-6};
    for (size_t i = 0; i < s->n; i++) {
        if (!(fw_strata_share(s, i) > 0)) continue;
        for (size_t k = 0; k < 9; k++) {
            fw_scenario sc = scenario_at(s, i, at[k / 3], at[k % 3]);
            assert_int_equal(fw_strata_find(s, &sc), i);
        }
    }
}

/* Widths in quantile levels. */
static const double SPEED_BINS[] = {0.25, 0.25, 0.15, 0.1, 0.1, 0.07, 0.05, 0.03};
static const double TWO[] = {0.3, 0.7}, SIX[] = {0.1, 0.2, 0.25, 0.25, 0.15, 0.05};

/* Eight bins of speed, finer towards fast currents; the order is speed, concentration, mix. */
static void continuous_laws(void **state)
{
    const struct {
        fw_distribution speed, concentration;
    } sites[] = {
        {law(FW_DIST_WEIBULL, 0.4, 1.6, -OPEN, OPEN), law(FW_DIST_UNIFORM, 0.2, 0.6, -OPEN, OPEN)},
        {law(FW_DIST_WEIBULL, 0.4, 1.6, 0.1, 2), law(FW_DIST_NORMAL, 0.4, 0.1, 0.1, 0.8)},
        {law(FW_DIST_LOGNORMAL, -1, 0.5, -OPEN, 3), law(FW_DIST_UNIFORM, 0.2, 0.6, 0.3, 0.5)},
        {law(FW_DIST_GAMMA, 2, 0.3, 0.01, OPEN), (fw_distribution){.kind = FW_DIST_TRIANGULAR, .a = 0.1, .b = 0.5, .c = 0.7, .low = -OPEN, .high = OPEN}},
    };
    fw_model m = mixes(2, TWO);
    (void)state;
    for (size_t k = 0; k < sizeof sites / sizeof sites[0]; k++) {
        fw_site   site = {.speed = sites[k].speed, .concentration = sites[k].concentration};
        fw_strata s;
        fw_strata_make(&s, &m, &site);
        assert_int_equal(s.n, 8 * 4 * 2);
        CHECK_NEAR(sum_of_shares(&s), 1, 1e-14);
        for (size_t i = 0; i < s.n; i++) CHECK_NEAR(fw_strata_share(&s, i), SPEED_BINS[i / 8] * 0.25 * TWO[i % 2], 1e-15);
        found_again(&s);
    }
}

static void constants(void **state)
{
    static const double one[] = {1};
    fw_site             site = {0};
    fw_model            m = mixes(1, one);
    fw_strata           s;
    (void)state;
    fw_distribution_constant(&site.speed, 0.5);
    fw_distribution_constant(&site.concentration, 0.4);
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 1);
    CHECK_NEAR(fw_strata_share(&s, 0), 1, 0);
    found_again(&s);
    site.speed = law(FW_DIST_UNIFORM, 0.5, 1.5, 0.7, 0.7); /* cut down to one value */
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 1);
    m = mixes(6, SIX);
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 6);
    for (size_t i = 0; i < 6; i++) CHECK_NEAR(fw_strata_share(&s, i), SIX[i], 1e-15);
}

/* A concentration of at most eight values has a bin for each that can happen. */
static void few_values(void **state)
{
    double          values[] = {0.1, 0.2, 0.4, 0.6, 0.75}, weights[] = {0.1, 0.3, 0, 0.4, 0.2};
    fw_distribution given = {.kind = FW_DIST_VALUES, .low = -OPEN, .high = OPEN, .n = 5, .values = values, .weights = weights};
    fw_site         site = {.speed = law(FW_DIST_WEIBULL, 0.4, 1.6, 0.05, 2), .concentration = given};
    fw_model        m = mixes(2, TWO);
    fw_strata       s;
    (void)state;
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 8 * 4 * 2); /* 40 % never happens */
    CHECK_NEAR(sum_of_shares(&s), 1, 1e-14);
    static const double of[] = {0.1, 0.2, 0.6, 0.75}, share[] = {0.1, 0.3, 0.4, 0.2};
    for (size_t i = 0; i < s.n; i++) {
        size_t bin = i / 2 % 4;
        CHECK_NEAR(fw_strata_share(&s, i), SPEED_BINS[i / 8] * share[bin] * TWO[i % 2], 1e-15);
        assert_true(scenario_at(&s, i, 0.5, 1e-6).concentration == of[bin]);
        assert_true(scenario_at(&s, i, 0.5, 1 - 1e-6).concentration == of[bin]);
    }
    found_again(&s);
    site.concentration.low = 0.15, site.concentration.high = 0.7; /* two are left, 3 : 4 */
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 8 * 2 * 2);
    CHECK_NEAR(fw_strata_share(&s, 0), 0.25 * 3 / 7 * 0.3, 1e-15);
    CHECK_NEAR(sum_of_shares(&s), 1, 1e-14);
    found_again(&s);
}

/* Where values lie across bins a stratum is one of those that can give the scenario, and the same one each time. */
static void many_values(void **state)
{
    double values[12], weights[12];
    for (size_t i = 0; i < 12; i++) values[i] = 0.05 * (double)(i + 1), weights[i] = (double)(i + 1) / 78;
    fw_distribution given = {.kind = FW_DIST_VALUES, .low = -OPEN, .high = OPEN, .n = 12, .values = values, .weights = weights};
    fw_site         site = {.speed = given, .concentration = given};
    fw_model        m = mixes(2, TWO);
    fw_strata       s;
    (void)state;
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 8 * 4 * 2);
    CHECK_NEAR(sum_of_shares(&s), 1, 1e-14);
    for (size_t i = 0; i < s.n; i++)
        for (size_t k = 0; k < 4; k++) {
            fw_scenario sc = scenario_at(&s, i, 0.1 + 0.2 * (double)k, 0.9 - 0.2 * (double)k);
            size_t      at = fw_strata_find(&s, &sc);
            assert_int_equal(at % 2, i % 2);
            fw_scenario low = scenario_at(&s, at, 1e-9, 1e-9), high = scenario_at(&s, at, 1 - 1e-9, 1 - 1e-9);
            assert_true(low.speed <= sc.speed && sc.speed <= high.speed);
            assert_true(low.concentration <= sc.concentration && sc.concentration <= high.concentration);
        }
}

static void impossible_mix(void **state)
{
    static const double probability[] = {0, 0.4, 0, 0.6};
    fw_site             site = {.speed = law(FW_DIST_UNIFORM, 0.5, 1.5, -OPEN, OPEN)};
    fw_model            m = mixes(4, probability);
    fw_strata           s;
    (void)state;
    fw_distribution_constant(&site.concentration, 0.4);
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 8 * 4);
    for (size_t i = 0; i < s.n; i++) assert_true((fw_strata_share(&s, i) > 0) == (i % 2 == 1));
    CHECK_NEAR(sum_of_shares(&s), 1, 1e-14);
    found_again(&s);
}

/* The cells themselves, one of which never happens. */
static void joint_table(void **state)
{
    fw_site_cell cells[3] = {{.probability = 0.2, .speed = 0.3, .concentration = 0.4},
                             {.probability = 0, .speed = 0.6, .concentration = 0.4},
                             {.probability = 0.8, .speed = 0.6, .concentration = 0.4, .mix = 1}};
    fw_site      site = {.n_cells = 3, .cells = cells};
    fw_model     m = mixes(2, TWO);
    fw_strata    s;
    (void)state;
    fw_strata_make(&s, &m, &site);
    assert_int_equal(s.n, 3);
    for (uint32_t i = 0; i < 3; i++) {
        fw_scenario sc = {.cell = i, .speed = cells[i].speed, .concentration = 0.4};
        CHECK_NEAR(fw_strata_share(&s, i), cells[i].probability, 0);
        assert_int_equal(fw_strata_find(&s, &sc), i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(continuous_laws), cmocka_unit_test(constants),      cmocka_unit_test(few_values),
        cmocka_unit_test(many_values),     cmocka_unit_test(impossible_mix), cmocka_unit_test(joint_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
