/* The JSON writer: expected texts are RFC 8259 by hand. */
#include "cli/json.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

typedef struct sink {
    FILE  *to;
    char  *text;
    size_t size;
} sink;

static fw_json start(sink *s)
{
    s->to = open_memstream(&s->text, &s->size);
    assert_non_null(s->to);
    return fw_json_onto(s->to);
}

static void expect(sink *s, const char *want)
{
    fclose(s->to);
    assert_string_equal(s->text, want);
    free(s->text);
}

static void numbers_come_back_as_they_were(void **state)
{
    (void)state;
    const double xs[] = {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.53e-4, 0};
    for (size_t i = 0; i < sizeof xs / sizeof *xs; i++) {
        sink    s;
        fw_json j = start(&s);
        fw_json_number(&j, xs[i]);
        fclose(s.to);
        assert_true(strtod(s.text, NULL) == xs[i]);
        free(s.text);
    }
}

static void what_is_not_finite_is_null(void **state)
{
    (void)state;
    sink    s;
    fw_json j = start(&s);
    fw_json_begin_array(&j);
    fw_json_number(&j, NAN);
    fw_json_number(&j, -INFINITY);
    fw_json_string(&j, NULL);
    fw_json_end(&j);
    expect(&s, "[\n  null,\n  null,\n  null\n]\n");
}

static void strings_are_escaped(void **state)
{
    (void)state;
    sink    s;
    fw_json j = start(&s);
    fw_json_string(&j, "a\"b\\c\n\t\x01\x7f \xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\x8a");
    expect(&s, "\"a\\\"b\\\\c\\n\\t\\u0001\\u007f \xc3\xa9 \xe2\x82\xac \xf0\x9f\xa7\x8a\"\n");
    /* bytes that are no UTF-8: stray, overlong, surrogate, cut short */
    j = start(&s);
    fw_json_string(&j, "\xff.\xc0\xaf.\xed\xa0\x80.\xe2\x82");
    expect(&s, "\"\\ufffd.\\ufffd\\ufffd.\\ufffd\\ufffd\\ufffd.\\ufffd\\ufffd\"\n");
}

static void containers_nest(void **state)
{
    (void)state;
    sink    s;
    fw_json j = start(&s);
    fw_json_begin_object(&j);
    fw_json_key(&j, "empty");
    fw_json_begin_array(&j);
    fw_json_end(&j);
    fw_json_key(&j, "rows");
    fw_json_begin_array(&j);
    for (int i = 0; i < 2; i++) {
        fw_json_begin_object(&j);
        fw_json_key(&j, "i");
        fw_json_integer(&j, i - 1);
        fw_json_key(&j, "v");
        fw_json_begin_array(&j);
        fw_json_bool(&j, true);
        fw_json_null(&j);
        fw_json_end(&j);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_end(&j);
    expect(&s, "{\n  \"empty\": [],\n  \"rows\": [\n    {\"i\": -1, \"v\": [true, null]},\n    {\"i\": 0, \"v\": "
               "[true, null]}\n  ]\n}\n");
    j = start(&s);
    fw_json_begin_object(&j);
    fw_json_end(&j);
    expect(&s, "{}\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_come_back_as_they_were),
                                       cmocka_unit_test(what_is_not_finite_is_null),
                                       cmocka_unit_test(strings_are_escaped), cmocka_unit_test(containers_nest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
