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
    const struct CMUnitTest tests[] = {cmocka_unit_test(defaults_are_the_papers), cmocka_unit_test(bad_models),
                                       cmocka_unit_test(steep_laws)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
