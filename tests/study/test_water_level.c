/* Wear over height against closed forms: a level that stands still, a normal one, a few levels, two thicknesses. */
#include <gsl/gsl_cdf.h>

#include "check.h"
#include "study/made_up.h"
#include "study/water_level.h"

static const double AFLOAT = 900.0 / 1025, H = 0.8;

static fw_water_level of(const fw_distribution *level, size_t n, const double *thickness, const double *weight)
{
    fw_water_level w;
    assert_int_equal(fw_water_level_make(&w, level, AFLOAT, n, thickness, weight, NULL), FW_OK);
    assert_int_equal(w.n, FW_WATER_LEVEL_HEIGHTS);
    /* law: whatever the level does, the wear over all heights is that of a wall line times the thickness */
    double sum = 0, step = w.height[1] - w.height[0];
    for (size_t i = 0; i < w.n; i++) sum += step * w.share[i];
    CHECK_NEAR(sum, w.thickness, step);
    assert_true(w.share[0] < 2e-5 && w.share[w.n - 1] < 2e-5 && w.band_low < w.band_high);
    return w;
}

/* A box of height h with share 1. */
static void still_water(void **state)
{
    (void)state;
    fw_distribution level;
    fw_distribution_constant(&level, 0.3);
    double         draft = AFLOAT * H, low = 0.3 - draft, high = low + H, thickness[3] = {H, H, H}, weight[3] = {1, 0.3, 7};
    fw_water_level w = of(&level, 3, thickness, weight);
    for (size_t i = 0; i < w.n; i++) {
        bool is_clear = fabs(w.height[i] - low) > 1e-9 && fabs(w.height[i] - high) > 1e-9;
        if (is_clear) assert_true(w.share[i] == (w.height[i] > low && w.height[i] < high ? 1 : 0));
    }
    assert_true(w.most_share == 1 && w.thickness == H);
    CHECK_NEAR(w.most_height, low + 0.5 * H, 1e-3);
    CHECK_NEAR(w.band_low, low + 0.05 * H, 1e-9);
    CHECK_NEAR(w.band_high, high - 0.05 * H, 1e-9);
}

/* The difference of two normal CDFs; symmetrical about the middle of the ice. */
static void normal_water(void **state)
{
    (void)state;
    static const double SD[] = {0.1, 0.5, 2};
    for (int i = 0; i < 3; i++) {
        fw_distribution level = made_up_law(FW_DIST_NORMAL, -0.2, SD[i]);
        double          draft = AFLOAT * H, freeboard = H - draft, one = 1, middle = -0.2 + 0.5 * (freeboard - draft);
        fw_water_level  w = of(&level, 1, &H, &one);
        for (size_t k = 0; k < w.n; k++) {
            double z = w.height[k] + 0.2;
            CHECK_NEAR(w.share[k], gsl_cdf_gaussian_P(z + draft, SD[i]) - gsl_cdf_gaussian_P(z - freeboard, SD[i]), 1e-14);
        }
        CHECK_NEAR(w.most_height, middle, SD[i] == 0.1 ? 0.1 : 1e-5); /* all but flat where the ice is thick against the level's scatter */
        CHECK_NEAR(w.most_share, 2 * gsl_cdf_gaussian_P(0.5 * H, SD[i]) - 1, 1e-12);
        CHECK_NEAR(0.5 * (w.band_low + w.band_high), middle, 1e-9);
        /* height of wear = level + a place evenly in the ice: its CDF is a mean of normal ones */
        double below = 0;
        for (int q = 0; q < 20000; q++) below += gsl_cdf_gaussian_P(w.band_low + 0.2 + draft - H * (q + 0.5) / 20000, SD[i]) / 20000;
        CHECK_NEAR(below, 0.05, 1e-5); /* 4096 quantiles */
    }
}

/* Levels of 0 m (a third of the time) and 2 m, ice of 0.4 m that wore three times as much as ice of 1 m: boxes that lie apart. */
static void few_levels_and_thicknesses(void **state)
{
    (void)state;
    fw_distribution level;
    const double    levels[2] = {0, 2}, share[2] = {1.0 / 3, 2.0 / 3}, h[2] = {0.4, 1}, weight[2] = {3, 1};
    assert_int_equal(fw_distribution_values(&level, 2, levels, share, NULL), FW_OK);
    fw_water_level w = of(&level, 2, h, weight);
    CHECK_RELATIVE(w.thickness, 0.75 * 0.4 + 0.25, 1e-14);
    for (size_t k = 0; k < w.n; k++) {
        double want = 0;
        bool   is_clear = true;
        for (int i = 0; i < 2; i++)
            for (int l = 0; l < 2; l++) {
                double low = levels[l] - AFLOAT * h[i], high = low + h[i], z = w.height[k];
                is_clear &= fabs(z - low) > 1e-9 && fabs(z - high) > 1e-9;
                if (z > low && z < high) want += share[l] * weight[i] / 4;
            }
        if (is_clear) CHECK_NEAR(w.share[k], want, 1e-14);
    }
    CHECK_NEAR(w.most_share, 2.0 / 3, 1e-14);
    CHECK_NEAR(w.most_height, 2 + 0.4 * (0.5 - AFLOAT), 2e-3);
    fw_distribution_free(&level);
}

static void nothing_and_wrong(void **state)
{
    (void)state;
    fw_distribution level;
    fw_water_level  w;
    double          h[2] = {0, 0.5}, weight[2] = {1, 0}, nan = NAN;
    fw_distribution_constant(&level, 0);
    assert_int_equal(fw_water_level_make(&w, &level, AFLOAT, 0, NULL, NULL, NULL), FW_OK);
    assert_int_equal(w.n, 0);
    assert_int_equal(fw_water_level_make(&w, &level, AFLOAT, 2, h, weight, NULL), FW_OK);
    assert_int_equal(w.n, 0);
    assert_int_equal(fw_water_level_make(&w, &level, 1, 1, &H, &H, NULL), FW_E_ARG);
    assert_int_equal(fw_water_level_make(&w, &level, AFLOAT, 1, &nan, &H, NULL), FW_E_ARG);
}

/* Through an answer: the governing point's windows weigh; without the key there is none. */
static void in_an_answer(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings);
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 100);
    c.model.ice_density = 900, c.model.water_density = 1025;
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_int_equal(a.water_level.n, 0);
    fw_answer_free(&a);
    c.after.has_water_level = true;
    fw_distribution_constant(&c.after.water_level, 0);
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    double sum = 0, load = 0;
    for (uint64_t id = 0; id < 100; id++) sum += made_up_size(&s, id) * made_up_thickness(id), load += made_up_size(&s, id);
    CHECK_RELATIVE(a.water_level.thickness, sum / load, 1e-12);
    fw_answer_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(still_water), cmocka_unit_test(normal_water), cmocka_unit_test(few_levels_and_thicknesses),
                                       cmocka_unit_test(nothing_and_wrong), cmocka_unit_test(in_an_answer)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
