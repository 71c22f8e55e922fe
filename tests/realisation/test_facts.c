/* Facts about scenes, against the laws that they are taken from. */
#include <string.h>

#include "check.h"
#include "realisation/facts.h"

static void of_a_campaign(void **state)
{
    fw_model       m;
    fw_site        s;
    fw_scene_facts f;
    fw_msg         msg = {""};
    (void)state;

    memset(&s, 0, sizeof s);
    fw_model_defaults(&m);
    m.given = FW_GIVEN_WIND_SPEED | FW_GIVEN_WIND;
    fw_distribution_constant(&s.concentration, 0.3);
    s.speed = (fw_distribution){.kind = FW_DIST_UNIFORM, .a = 0.2, .b = 1.5, .low = -INFINITY, .high = INFINITY};
    s.wind_speed = (fw_distribution){.kind = FW_DIST_WEIBULL, .a = 6, .b = 2, .low = -INFINITY, .high = 25};
    assert_int_equal(fw_facts_campaign(&m, &s, &f, &msg), FW_OK);
    assert_true(f.given == m.given && f.n_floes == 0);
    assert_true(f.speed.low == 0.2 && f.speed.high == 1.5 && f.concentration.low == 0.3 && f.concentration.high == 0.3);
    assert_true(f.wind_speed.low == 0 && f.wind_speed.high == 25);
    /* 4h to sqrt(130h - 11) of 0.5 to 1.3 m: the smallest floe is 2 m, the largest sqrt(158) m; h/R is 1/2 at 4h, least where D/h is largest */
    CHECK_RELATIVE(f.diameter.low, 2, 1e-12);
    CHECK_RELATIVE(f.diameter.high, sqrt(158), 1e-12);
    assert_true(f.thickness.low == 0.5 && f.thickness.high == 1.3);
    CHECK_RELATIVE(f.aspect.high, 0.5, 1e-12);
    CHECK_RELATIVE(f.aspect.low, 2 * 0.5 / sqrt(54), 1e-12);
    m.given = 0; /* nobody asked for wind */
    assert_int_equal(fw_facts_campaign(&m, &s, &f, &msg), FW_OK);
    assert_true(f.wind_speed.high == 0);
}

/* One size of floe: C / (pi D^2 / 4) floes a square metre, on 2 D (2 Rs + D); the densest ice and the likely cells alone count. */
static void encounters(void **state)
{
    fw_model       m;
    fw_site        s;
    fw_scene_facts f;
    fw_site_cell   cells[] = {{.probability = 0.5, .speed = 1, .concentration = 0.1},
                              {.probability = 0.5, .speed = 2, .concentration = 0.2},
                              {.probability = 0, .speed = 9, .concentration = 0.8}};
    fw_msg         msg = {""};
    double         h = 8.039, D = sqrt(130 * h - 11); /* both ends of the law in one place, nearly */
    (void)state;

    memset(&s, 0, sizeof s);
    fw_model_defaults(&m);
    m.mixes[0] = (fw_thickness_mix){.probability = 1, .n_classes = 1, .classes = {{h, 1}}};
    s.n_cells = 3, s.cells = cells;
    assert_int_equal(fw_facts_campaign(&m, &s, &f, &msg), FW_OK);
    assert_true(f.speed.low == 1 && f.speed.high == 2 && f.concentration.low == 0.1 && f.concentration.high == 0.2);
    CHECK_RELATIVE(f.encounters, 0.2 / (acos(-1) * D * D / 4) * 2 * D * (7.4 + D), 1e-3);
    double before = f.encounters;
    cells[1].concentration = 0.4;
    assert_int_equal(fw_facts_campaign(&m, &s, &f, &msg), FW_OK);
    CHECK_RELATIVE(f.encounters, 2 * before, 1e-12);
}

static void of_a_scene(void **state)
{
    fw_floe        floes[] = {{.x = -9, .diameter = 2.5, .thickness = 0.5}, {.x = -20, .diameter = 5, .thickness = 0.6}};
    fw_scene       s;
    fw_scene_facts f;
    (void)state;

    memset(&s, 0, sizeof s);
    fw_model_defaults(&s.model);
    s.speed = 2, s.wind_speed = 7, s.n_floes = 2, s.floes = floes, s.model.given = FW_GIVEN_TIDE;
    fw_facts_scene(&s, &f);
    assert_true(f.n_floes == 2 && f.speed.high == 2 && f.wind_speed.high == 7 && f.given == FW_GIVEN_TIDE);
    assert_true(f.diameter.low == 2.5 && f.diameter.high == 5 && f.thickness.high == 0.6);
    CHECK_RELATIVE(f.aspect.low, 0.24, 1e-12);
    CHECK_RELATIVE(f.aspect.high, 0.4, 1e-12);
    s.n_floes = 0; /* no floes: no ranges, but numbers */
    fw_facts_scene(&s, &f);
    assert_true(f.diameter.low == 0 && f.diameter.high == 0 && f.aspect.high == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(of_a_campaign), cmocka_unit_test(encounters), cmocka_unit_test(of_a_scene)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
