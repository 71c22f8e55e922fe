#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/keys.h"

typedef struct boat {
    double   length, speed, rest, draught;
    uint64_t crew;
    bool     has_sail;
    int      hull;
    char     name[FW_KEY_TEXT_SIZE];
} boat;

#define AT(member) offsetof(boat, member)
static const fw_key BOAT[] = {
    {"length", FW_KEY_NUMBER, AT(length), "m", "5 m", 0, 100, true, NULL, "over all"},
    {"top_speed", FW_KEY_NUMBER, AT(speed), "m/s", NULL, 0, INFINITY, false, NULL, "in calm water"},
    {"rest", FW_KEY_AUTO, AT(rest), "s", "auto", 0, 3600, false, NULL, "between trips"},
    {"crew", FW_KEY_COUNT, AT(crew), NULL, "2", 1, 12, false, NULL, "heads"},
    {"sail", FW_KEY_FLAG, AT(has_sail), NULL, "off", 0, 0, false, NULL, "carries one"},
    {"hull", FW_KEY_CHOICE, AT(hull), NULL, "wood", 0, 0, false, "steel|wood|fibre", "material"},
    {"name", FW_KEY_TEXT, AT(name), NULL, "", 0, 0, false, NULL, "on the bow"},
    {"draught", FW_KEY_AUTO, AT(draught), "m", "measured", 0.1, 10, false, "measured", "below the waterline"},
    {"ports", FW_KEY_SHAPED, 0, NULL, "", 0, 0, false, "list of names", "it calls at"},
};
static const fw_section SECTION = {"boat", "a boat", sizeof BOAT / sizeof BOAT[0], BOAT};

static int open_units(void **state) { return fw_units_open((fw_units **)state, NULL) != FW_OK; }

static int close_units(void **state)
{
    fw_units_close(*state);
    return 0;
}

static fw_status read(void **state, const char *key, const char *text, boat *b, fw_msg *m)
{
    return fw_keys_read(fw_keys_find(&SECTION, key), *state, text, b, m);
}

static void defaults_and_values(void **state)
{
    boat   b = {0};
    fw_msg m;

    assert_int_equal(fw_keys_defaults(&SECTION, *state, &b, &m), FW_OK);
    assert_true(b.length == 5 && b.rest == -1 && b.draught == -1 && b.crew == 2 && !b.has_sail && b.hull == 1);
    assert_int_equal(read(state, "length", "1200 cm", &b, &m), FW_OK);
    assert_int_equal(read(state, "rest", "2 min", &b, &m), FW_OK);
    assert_int_equal(read(state, "crew", "12", &b, &m), FW_OK);
    assert_int_equal(read(state, "sail", "yes", &b, &m), FW_OK);
    assert_int_equal(read(state, "hull", "fibre", &b, &m), FW_OK);
    assert_int_equal(read(state, "name", "Sisu", &b, &m), FW_OK);
    assert_true(b.length == 12 && b.rest == 120 && b.crew == 12 && b.has_sail && b.hull == 2);
    assert_string_equal(b.name, "Sisu");
    assert_int_equal(read(state, "top_speed", "0 m/s", &b, &m), FW_OK); /* a closed end */
}

static void refusals_leave_the_value(void **state)
{
    static const char *const rows[][2] = {
        {"length", "0 m"},
        {"length", "100.1 m"},
        {"length", "5"},
        {"length", "auto"},
        {"top_speed", "-1 m/s"},
        {"rest", "-1 s"},
        {"rest", "2 h"},
        {"draught", "auto"},
        {"draught", "-1 m"},
        {"crew", "0"},
        {"crew", "13"},
        {"crew", "2.5"},
        {"crew", "-2"},
        {"crew", ""},
        {"crew", "2 heads"},
        {"sail", "maybe"},
        {"sail", "On"},
        {"hull", "steel|wood"},
        {"hull", "st"},
        {"hull", ""},
        {"ports", "Raahe"},
        {"crew", "99999999999999999999999999"},
        {"name", "0123456789012345678901234567890123456789012345678901234567890123456789"},
    };
    boat   b = {0}, before;
    fw_msg m;

    fw_keys_defaults(&SECTION, *state, &b, &m);
    before = b;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (read(state, rows[i][0], rows[i][1], &b, &m) == FW_OK) fail_msg("%s: %s was read", rows[i][0], rows[i][1]);
        assert_memory_equal(&b, &before, sizeof b);
    }
    read(state, "length", "0 m", &b, &m);
    assert_string_equal(m.text, "\"0 m\" is out of range, wanted more than 0 m and at most 100 m");
    read(state, "crew", "13", &b, &m);
    assert_string_equal(m.text, "\"13\" is out of range, wanted at least 1 and at most 12");
    assert_null(fw_keys_find(&SECTION, "mast"));
}

/* What is printed reads back to the same bits. */
static void printed_lines_read_back(void **state)
{
    boat   b = {0};
    char   line[200];
    fw_msg m;

    fw_keys_defaults(&SECTION, *state, &b, &m);
    b.length = nextafter(7.4, 8);
    assert_true(fw_keys_print(&SECTION, &BOAT[0], &b, line, sizeof line) > 0);
    assert_string_equal(line, "boat.length = 7.4000000000000012 m\n");
    boat c = {0};
    line[strlen(line) - 1] = '\0';
    assert_int_equal(read(state, "length", strchr(line, '=') + 2, &c, &m), FW_OK);
    assert_true(c.length == b.length);
    fw_keys_print(&SECTION, &BOAT[2], &b, line, sizeof line);
    assert_string_equal(line, "boat.rest = auto\n");
    fw_keys_print(&SECTION, &BOAT[7], &b, line, sizeof line);
    assert_string_equal(line, "boat.draught = measured\n"); /* a word of its own */
    fw_keys_print(&SECTION, &BOAT[3], &b, line, sizeof line);
    assert_string_equal(line, "boat.crew = 2\n");
    fw_keys_print(&SECTION, &BOAT[5], &b, line, sizeof line);
    assert_string_equal(line, "boat.hull = wood\n");
}

static void nearest_names(void **state)
{
    (void)state;
    assert_string_equal(fw_keys_nearest(&SECTION, "lenght"), "length");
    assert_string_equal(fw_keys_nearest(&SECTION, "Length"), "length");
    assert_string_equal(fw_keys_nearest(&SECTION, "top-speed"), "top_speed");
    assert_string_equal(fw_keys_nearest(&SECTION, "top"), "top_speed");
    assert_string_equal(fw_keys_nearest(&SECTION, "crw"), "crew");
    assert_null(fw_keys_nearest(&SECTION, "displacement"));
    assert_null(fw_keys_nearest(&SECTION, ""));
    assert_null(fw_keys_nearest(&SECTION, "a_very_long_name_that_no_table_of_keys_would_ever_have_in_it"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_and_values),
        cmocka_unit_test(refusals_leave_the_value),
        cmocka_unit_test(printed_lines_read_back),
        cmocka_unit_test(nearest_names),
    };
    return cmocka_run_group_tests(tests, open_units, close_units);
}
