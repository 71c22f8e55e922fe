/* The printed reference of keys, and the tables behind it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/config.h"
#include "cli/tables.h"

static char *printed(bool as_json)
{
    char  *text = NULL;
    size_t n = 0;
    FILE  *f = open_memstream(&text, &n);

    assert_non_null(f);
    fw_config_print_keys(f, as_json);
    assert_int_equal(fclose(f), 0);
    return text;
}

static void every_key_is_printed(void **state)
{
    char *text = printed(false), *json = printed(true);
    char  quoted[100];
    (void)state;

    for (size_t i = 0; i < fw_n_tables; i++) {
        for (size_t k = 0; k < fw_tables[i].section->n_keys; k++) {
            const char *name = fw_tables[i].section->keys[k].name;
            assert_non_null(strstr(text, name));
            snprintf(quoted, sizeof quoted, "\"%s\"", name);
            assert_non_null(strstr(json, quoted));
        }
    }
    assert_non_null(strstr(text, "default 2000 kN/m"));
    assert_non_null(strstr(text, "weibull"));
    free(text);
    free(json);
}

/* A default is a value like any other: each must read back, inside its own range; names are unique in a section. */
static void tables_are_sound(void **state)
{
    fw_units *u;
    fw_msg    m = {""};
    (void)state;

    assert_int_equal(fw_units_open(&u, &m), FW_OK);
    for (size_t i = 0; i < fw_n_tables; i++) {
        const fw_section *s = fw_tables[i].section;
        unsigned char     room[sizeof(fw_values)] = {0};
        assert_true(s->n_keys <= 64);
        if (fw_keys_defaults(s, u, room, &m) != FW_OK) fail_msg("%s", m.text);
        for (size_t k = 0; k < s->n_keys; k++) {
            const fw_key *key = &s->keys[k];
            assert_ptr_equal(fw_keys_find(s, key->name), key);
            assert_true(strlen(key->meaning) > 3);
            assert_true(key->least <= key->most);
            assert_true(key->unit || (key->kind != FW_KEY_NUMBER && key->kind != FW_KEY_AUTO));
            assert_true(key->words || (key->kind != FW_KEY_CHOICE && key->kind != FW_KEY_SHAPED));
        }
    }
    fw_units_close(u);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_key_is_printed), cmocka_unit_test(tables_are_sound)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
