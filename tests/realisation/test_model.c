#include <string.h>

#include "check.h"
#include "floewear/realisation.h"

static void defaults_are_the_papers(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    assert_int_equal(fw_model_check(&m, NULL), FW_OK);
    CHECK_NEAR(m.structure_radius, 3.7, 0);
    CHECK_NEAR(m.stiffness, 2e6, 0);
    assert_int_equal(m.mixes[0].n_classes, 5);
}

static void refuses(void (*spoil)(fw_model *), const char *word)
{
    fw_model m;
    fw_msg   msg = {""};
    fw_model_defaults(&m);
    spoil(&m);
    assert_int_equal(fw_model_check(&m, &msg), FW_E_ARG);
    if (!strstr(msg.text, word)) fail_msg("'%s' does not say '%s'", msg.text, word);
}
static void s_radius(fw_model *m) { m->structure_radius = -1; }
static void s_nan(fw_model *m) { m->stiffness = NAN; }
static void s_exponent(fw_model *m) { m->laws[0].exponent = 2; }
static void s_steep(fw_model *m) { m->effects |= FW_EFFECT_CRUSHING_LIMIT, m->laws[0].exponent = 4.1; }
static void s_area(fw_model *m)
{
    m->effects |= FW_EFFECT_CRUSHING_LIMIT, m->crushing_limit = (fw_pressure_law){7.4e6, 0.7}, m->laws[0].exponent = 2.9;
}
static void s_limit(fw_model *m) { m->effects |= FW_EFFECT_CRUSHING_LIMIT, m->crushing_limit.pressure = 0; }
static void s_limit_area(fw_model *m) { m->effects |= FW_EFFECT_CRUSHING_LIMIT, m->crushing_limit.exponent = 1; }
static void s_thick(fw_model *m) { m->mixes[0].classes[0].thickness = 9; }
static void s_accuracy(fw_model *m) { m->accuracy = 1e-9; }
static void s_arcs(fw_model *m) { m->n_arcs = 10; }

static fw_course_row rows[2];
static void set_course(fw_model *m, double time, double factor, double turn)
{
    rows[0] = (fw_course_row){10, 1, 0}, rows[1] = (fw_course_row){time, factor, turn};
    m->tide.rows = rows, m->tide.n_rows = 2, m->effects |= FW_EFFECT_TIDE;
}
static void s_course_back(fw_model *m) { set_course(m, 10, 1, 0); }
static void s_course_nan(fw_model *m) { set_course(m, 20, NAN, 0); }
static void s_course_turn(fw_model *m) { set_course(m, 20, 1, INFINITY); }
static void s_wear(fw_model *m) { m->numerics.wear_tolerance = NAN; }
static void s_plain_tide(fw_model *m) { m->effects |= FW_EFFECT_TIDE, m->numerics = (fw_numerics){.scheme = FW_SCHEME_RK4, .step = 1e-3}; }
static void s_plain_crush(fw_model *m) { m->effects |= FW_EFFECT_CRUSH_CONTACT, m->numerics = (fw_numerics){.scheme = FW_SCHEME_EULER, .step = 1e-3}; }
static void s_plain_pressure(fw_model *m) { m->stiffness_from_pressure = true, m->numerics = (fw_numerics){.scheme = FW_SCHEME_VERLET, .step = 1e-3}; }

/* What a scenario brings along for effects that are on. */
static void bad_scenarios(void **state)
{
    (void)state;
    fw_scenario good = {.concentration = 0.1, .speed = 1}, s;
    fw_model    m;
    fw_record   r;
    fw_msg      msg = {""};
    fw_model_defaults(&m);
    m.window = m.warm_up = 1;
    s = good, s.wind_speed = s.wind_angle = s.tide_phase = NAN; /* off */
    assert_int_equal(fw_realise(&m, &s, NULL, &r, &msg), FW_OK);
    fw_record_free(&r);
    m.effects |= FW_EFFECT_WIND | FW_EFFECT_TIDE;
#define REFUSED(change, word)                                                                                          \
    (s = good, change, assert_int_equal(fw_realise(&m, &s, NULL, &r, &msg), FW_E_ARG), assert_non_null(strstr(msg.text, word)))
    REFUSED(s.wind_speed = NAN, "wind of");
    REFUSED(s.wind_speed = -1, "wind of");
    REFUSED(s.wind_angle = INFINITY, "wind of");
    REFUSED(s.tide_phase = NAN, "phase of the tide");
    fw_floe         f = {.x = -6, .diameter = 4, .thickness = 0.5};
    fw_scene        scene = {.model = m, .speed = NAN, .duration = 1, .n_floes = 1, .floes = &f};
    fw_scene_result out;
    assert_int_equal(fw_scene_run(&scene, NULL, NULL, &out, &msg), FW_E_ARG);
    scene.speed = 1, scene.wind_speed = NAN;
    assert_int_equal(fw_scene_run(&scene, NULL, NULL, &out, &msg), FW_E_ARG);
}

static void bad_models(void **state)
{
    (void)state;
    refuses(s_radius, "structure radius");
    refuses(s_nan, "stiffness");
    refuses(s_exponent, "diverges");
    refuses(s_steep, "0 < m <= 4");
    refuses(s_area, "product below 2");
    refuses(s_limit, "crushing limit 0 Pa");
    refuses(s_limit_area, "0 <= q < 1");
    refuses(s_thick, "thickness 9");
    refuses(s_accuracy, "0.01 %");
    refuses(s_arcs, "72");
    refuses(s_course_back, "row 2: 10 s");
    refuses(s_course_nan, "row 2: 20 s");
    refuses(s_course_turn, "row 2: 20 s");
    refuses(s_wear, "wear tolerance");
    refuses(s_plain_tide, "a current that changes");
    refuses(s_plain_crush, "contacts that crush");
    refuses(s_plain_pressure, "stiffness from pressure");
}

/* Exponents from 2 on want a limit, and one that does not diverge itself. A limit that is off is not looked at. */
static void steep_laws(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    m.crushing_limit.pressure = NAN;
    assert_int_equal(fw_model_check(&m, NULL), FW_OK);
    m.effects |= FW_EFFECT_CRUSHING_LIMIT, m.laws[0].exponent = 4, m.crushing_limit = (fw_pressure_law){5e6, 0.49};
    assert_int_equal(fw_model_check(&m, NULL), FW_OK);
    m.laws[0].exponent = 2.8, m.crushing_limit = (fw_pressure_law){7.4e6, 0.7};
    assert_int_equal(fw_model_check(&m, NULL), FW_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(defaults_are_the_papers), cmocka_unit_test(bad_models), cmocka_unit_test(bad_scenarios),
                                       cmocka_unit_test(steep_laws)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
