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
static void s_thick(fw_model *m) { m->mixes[0].classes[0].thickness = 9; }
static void s_accuracy(fw_model *m) { m->accuracy = 1e-9; }
static void s_arcs(fw_model *m) { m->n_arcs = 10; }

static void bad_models(void **state)
{
    (void)state;
    refuses(s_radius, "structure radius");
    refuses(s_nan, "stiffness");
    refuses(s_exponent, "diverges");
    refuses(s_thick, "thickness 9");
    refuses(s_accuracy, "0.01 %");
    refuses(s_arcs, "72");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(defaults_are_the_papers), cmocka_unit_test(bad_models)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
