#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "base/units.h"

static int open_units(void **state) { return fw_units_open((fw_units **)state, NULL) != FW_OK; }

static int close_units(void **state)
{
    fw_units_close(*state);
    return 0;
}

/* Expected values by the units' definitions (SI brochure; year of 365.25 d is this project's own). */
static void quantities(void **state)
{
    static const struct {
        const char *text, *unit;
        double      value;
    } rows[] = {
        {"7.4 m", "m", 7.4},
        {"7.4m", "m", 7.4},
        {"  7.4   m  ", "m", 7.4},
        {"+.5 m", "m", 0.5},
        {"5. m", "m", 5},
        {"1e-3 km", "m", 1},
        {"1E3m", "m", 1000},
        {"2000 kN/m", "N/m", 2e6},
        {"2 MN/m", "N/m", 2e6},
        {"3 kNs/m", "N s/m", 3000},
        {"3 kN s/m", "N s/m", 3000},
        {"1.1 MPa", "Pa", 1.1e6},
        {"900 kg/m3", "kg/m3", 900},
        {"900 kg m-3", "kg/m3", 900},
        {"900 kg/m^3", "kg/m3", 900},
        {"3 h", "s", 10800},
        {"90 min", "s", 5400},
        {"2h", "s", 7200},
        {"50 year", "year", 50},
        {"1 year", "s", 31557600},
        {"1 year", "d", 365.25},
        {"1200 h", "h", 1200},
        {"20 mm", "mm", 20},
        {"7 mm", "m", 0.007},
        {"20 mm", "m", 0.02},
        {"40 %", "1", 0.4},
        {"7%", "1", 0.07},
        {"0.4", "1", 0.4},
        {"0.4 1", "1", 0.4},
        {"90 deg", "deg", 90},
        {"-75deg", "deg", -75},
        {"90 degree", "deg", 90},
        {"2 rad/s", "rad/s", 2},
        {"2 m/s", "m/s", 2},
        {"36 km/h", "m/s", 10},
        {"0.2 m s-1", "m/s", 0.2},
        {"-5 degC", "degC", -5},
        {"-12 degC", "degC", -12},
        {"1.8 K", "K", 1.8},
        {"1.8 degC", "K", 1.8}, /* a difference has no offset */
        {"0.1 mm/km", "mm/km", 0.1},
        {"-0 m", "m", 0},
    };
    static const struct {
        const char *text, *unit;
        double      value;
    } near[] = {
        {"180 deg", "rad", 3.14159265358979323846},
        {"57.29577951308232 deg/s", "rad/s", 1},
        {"268.15 K", "degC", -5},
        {"14 degF", "degC", -10},
        {"18 degF", "K", 10},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double x = NAN;
        fw_msg m = {""};
        if (fw_units_read(*state, rows[i].text, rows[i].unit, &x, &m) != FW_OK)
            fail_msg("%s: %s", rows[i].text, m.text);
        if (x != rows[i].value) fail_msg("%s gave %.17g %s", rows[i].text, x, rows[i].unit);
    }
    for (size_t i = 0; i < sizeof near / sizeof near[0]; i++) {
        double x = NAN;
        fw_msg m = {""};
        if (fw_units_read(*state, near[i].text, near[i].unit, &x, &m) != FW_OK)
            fail_msg("%s: %s", near[i].text, m.text);
        if (!(fabs(x - near[i].value) < 1e-11)) fail_msg("%s gave %.17g %s", near[i].text, x, near[i].unit);
    }
}

static void refusals(void **state)
{
    static const char *const rows[][2] = {
        {"7.4", "m"},        {"7.4 s", "m"},       {"7.4 m m", "m"},     {"7.4 m 3", "m"},    {"7.4 m3", "m"},
        {"7.4 m,", "m"},     {"7,4 m", "m"},       {"nan m", "m"},       {"NaN m", "m"},      {"inf m", "m"},
        {"-inf m", "m"},     {".inf m", "m"},      {".nan m", "m"},      {"1e999 m", "m"},    {"-1e999 m", "m"},
        {"1e-999 m", "m"},   {"1e307 km", "m"},    {"0x10 m", "m"},      {"", "m"},           {"   ", "m"},
        {"m", "m"},          {"- 5 m", "m"},       {"--5 m", "m"},       {"1e m", "m"},       {"5 furlongs!", "m"},
        {"5 nosuch", "m"},   {"5 m @ 2", "m"},     {"5 m since 2", "m"}, {"5 lg(re m)", "m"}, {"5 (m)", "m"},
        {"5 2 m", "m"},      {"5 *m", "m"},        {"5 m/", "m"},        {"5 m^", "m"},       {"5 m-", "m"},
        {"1.2.3 m", "m"},    {"40 %%", "1"},       {"40 m", "1"},        {"0.4 rad", "1"},    {"40 deg", "1"},
        {"90", "deg"},       {"90 %", "deg"},      {"90 1", "deg"},      {"3 1/s", "rad/s"},  {"-5", "degC"},
        {"-5 C m", "degC"},  {"5 \xc2\xb5m", "m"}, {"5 m\x01", "m"},     {"5\nm", "m"},       {"1_000 m", "m"},
        {"5 12/s", "rad/s"}, {"auto", "m"},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double x = 42;
        fw_msg m = {""};
        if (fw_units_read(*state, rows[i][0], rows[i][1], &x, &m) != FW_E_INPUT) {
            fail_msg("\"%s\" was read as %.17g %s: %s", rows[i][0], x, rows[i][1], m.text);
        }
        assert_true(x == 42);
        assert_true(m.text[0] == '"');
    }
}

static void long_junk_is_cut(void **state)
{
    char   text[100000];
    double x;
    fw_msg m;

    memset(text, '9', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    assert_int_equal(fw_units_read(*state, text, "m", &x, &m), FW_E_INPUT);
    assert_true(strlen(m.text) < 200);
    memset(text + 3, 'q', sizeof text - 4);
    assert_int_equal(fw_units_read(*state, text, "m", &x, &m), FW_E_INPUT);
    assert_true(strlen(m.text) < 300);
}

static void bare_numbers(void **state)
{
    double x;
    (void)state;

    assert_int_equal(fw_units_number(" 0.25 ", &x, NULL), FW_OK);
    assert_true(x == 0.25);
    assert_int_equal(fw_units_number("0.25 m", &x, NULL), FW_E_INPUT);
    assert_int_equal(fw_units_number("nan", &x, NULL), FW_E_INPUT);
    assert_int_equal(fw_units_number("1e999", &x, NULL), FW_E_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantities),
        cmocka_unit_test(refusals),
        cmocka_unit_test(long_junk_is_cut),
        cmocka_unit_test(bare_numbers),
    };
    return cmocka_run_group_tests(tests, open_units, close_units);
}
