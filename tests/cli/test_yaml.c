/* The tree that YAML text becomes: kinds, places, --set. What is refused stands in test_config_bad.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "cli/yaml.h"

static const char TEXT[] = "# first line\n"
                           "name: \"a: b\"\n"
                           "ice:\n"
                           "  density: 900 kg/m3 # the paper's\n"
                           "  classes: {0.5 m: 1, 0.7 m: 2}\n"
                           "floes: [{x: 1 m}, 2]\n"
                           "empty:\n";

static void parse(fw_yaml *y)
{
    fw_msg m = {""};

    if (fw_yaml_parse(y, "file.yaml", TEXT, strlen(TEXT), &m) != FW_OK) fail_msg("%s", m.text);
}

static void kinds_and_places(void **state)
{
    fw_yaml y;
    (void)state;

    parse(&y);
    assert_int_equal(y.root->kind, FW_NODE_MAP);
    assert_int_equal(y.root->n, 4);
    const fw_node *name = fw_yaml_get(y.root, "name");
    assert_string_equal(name->text, "a: b");
    assert_false(name->is_plain);
    const fw_node *ice = fw_yaml_get(y.root, "ice"), *density = fw_yaml_get(ice, "density");
    assert_string_equal(density->text, "900 kg/m3");
    assert_true(density->is_plain && density->line == 4 && density->column == 12);
    const fw_node *classes = fw_yaml_get(ice, "classes");
    assert_int_equal(classes->n, 2);
    assert_string_equal(classes->keys[1]->text, "0.7 m");
    assert_true(classes->keys[1]->line == 5 && classes->keys[1]->column == 23);
    const fw_node *floes = fw_yaml_get(y.root, "floes");
    assert_int_equal(floes->kind, FW_NODE_LIST);
    assert_int_equal(floes->values[0]->kind, FW_NODE_MAP);
    assert_string_equal(floes->values[1]->text, "2");
    assert_string_equal(fw_yaml_get(y.root, "empty")->text, "");
    assert_null(fw_yaml_get(y.root, "nothing"));
    assert_null(fw_yaml_get(density, "below a scalar"));
    assert_null(fw_yaml_get(NULL, "x"));
    fw_yaml_free(&y);
    fw_yaml_free(&y); /* emptied, so a second time is harmless */
    fw_yaml_free(NULL);
}

static void messages_begin_with_the_place(void **state)
{
    fw_yaml y;
    fw_msg  m = {""};
    (void)state;

    parse(&y);
    const fw_node *density = fw_yaml_get(fw_yaml_get(y.root, "ice"), "density");
    assert_int_equal(fw_yaml_fail(density, &m, "%s", "too heavy"), FW_E_INPUT);
    assert_string_equal(m.text, "file.yaml:4:12: too heavy");
    fw_fail(&m, FW_E_IO, "gone");
    assert_int_equal(fw_yaml_blame(density, "ice.density", FW_E_IO, &m), FW_E_IO);
    assert_string_equal(m.text, "file.yaml:4:12: ice.density: gone");
    fw_yaml_free(&y);
}

static void sets_replace_and_add(void **state)
{
    fw_yaml y;
    fw_msg  m = {""};
    (void)state;

    parse(&y);
    assert_int_equal(fw_yaml_set(&y, "ice.density=910 kg/m3", &m), FW_OK);
    const fw_node *ice = fw_yaml_get(y.root, "ice");
    assert_int_equal(ice->n, 2);
    assert_string_equal(fw_yaml_get(ice, "density")->text, "910 kg/m3");
    fw_yaml_fail(fw_yaml_get(ice, "density"), &m, "why");
    assert_string_equal(m.text, "--set ice.density=910 kg/m3: why");
    assert_int_equal(fw_yaml_set(&y, "water.deep.down={a: [1, 2]}", &m), FW_OK);
    const fw_node *down = fw_yaml_get(fw_yaml_get(fw_yaml_get(y.root, "water"), "deep"), "down");
    assert_int_equal(fw_yaml_get(down, "a")->n, 2);
    assert_int_equal(fw_yaml_set(&y, "water.deep.down=5", &m), FW_OK); /* the last one counts */
    assert_string_equal(fw_yaml_get(fw_yaml_get(fw_yaml_get(y.root, "water"), "deep"), "down")->text, "5");
    assert_int_equal(fw_yaml_set(&y, "floes.0=1", &m), FW_E_INPUT); /* a list is set whole */
    assert_int_equal(fw_yaml_set(&y, "name=a=b", &m), FW_OK);
    assert_string_equal(fw_yaml_get(y.root, "name")->text, "a=b");
    fw_yaml_free(&y);
}

/* 400 keys can be added to one map and no more. */
static void sets_are_bounded(void **state)
{
    fw_yaml y;
    fw_msg  m = {""};
    char    set[32];
    size_t  n;
    (void)state;

    parse(&y);
    n = y.root->n;
    for (int i = 0; i < FW_YAML_MAX_KEYS + 5; i++) {
        snprintf(set, sizeof set, "k%d=1", i);
        fw_status wanted = n < FW_YAML_MAX_KEYS ? FW_OK : FW_E_INPUT;
        assert_int_equal(fw_yaml_set(&y, set, &m), wanted);
        n += wanted == FW_OK;
        assert_int_equal(y.root->n, n);
    }
    fw_yaml_free(&y);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_and_places),
        cmocka_unit_test(messages_begin_with_the_place),
        cmocka_unit_test(sets_replace_and_add),
        cmocka_unit_test(sets_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
