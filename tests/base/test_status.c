#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <string.h>

#include "floewear/status.h"

static void names_and_exit_codes(void **state)
{
    (void)state;
    assert_string_equal(fw_status_name(FW_E_IO), "FW_E_IO");
    assert_int_equal(fw_status_exit_code(FW_OK), 0);
    assert_int_equal(fw_status_exit_code(FW_E_INPUT), 2); /* exit codes: the table of the user's manual */
    assert_int_equal(fw_status_exit_code(FW_E_IO), 4);
    assert_int_equal(fw_status_exit_code(FW_E_STOPPED), 75);
    for (int s = 0; s < FW_N_STATUS; s++) assert_true(strlen(fw_status_sentence((fw_status)s)) > 3);
    assert_string_equal(fw_status_name((fw_status)-1), "FW_E_UNKNOWN");
    assert_int_equal(fw_status_exit_code((fw_status)9999), 5);
}

static fw_status half(int n, int *out, fw_msg *m)
{
    FW_CHECK(n % 2 == 0, m, FW_E_ARG, "%d is odd", n);
    *out = n / 2;
    return FW_OK;
}

static fw_status quarter(int n, int *out, fw_msg *m)
{
    FW_TRY(half(n, out, m));
    FW_TRY(half(*out, out, m));
    return FW_OK;
}

static void failures_travel_up(void **state)
{
    fw_msg m = {""};
    int    q = 0;
    (void)state;

    assert_int_equal(quarter(8, &q, &m), FW_OK);
    assert_int_equal(q, 2);
    assert_int_equal(quarter(6, &q, &m), FW_E_ARG);
    assert_string_equal(m.text, "3 is odd");
    fw_msg_prefix(&m, "floe %d: ", 17);
    assert_string_equal(m.text, "floe 17: 3 is odd");
    assert_int_equal(quarter(6, &q, NULL), FW_E_ARG);
    fw_msg_prefix(NULL, "floe");
}

static void long_messages_end_in_dots(void **state)
{
    fw_msg m;
    char   text[3000];
    (void)state;

    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    fw_fail(&m, FW_E_ARG, "%s", text);
    assert_int_equal(strlen(m.text), sizeof m.text - 1);
    assert_string_equal(m.text + sizeof m.text - 5, "x...");
    fw_msg_prefix(&m, "prefix ");
    assert_memory_equal(m.text, "prefix xx", 9);
    assert_string_equal(m.text + sizeof m.text - 5, "x...");
    fw_msg_prefix(&m, "%s", text);
    assert_string_equal(m.text + sizeof m.text - 5, "x...");
    for (size_t i = 0; i + 2 < sizeof text; i += 2) memcpy(text + i, "\xc3\xa4", 2); /* never half a character */
    for (size_t shift = 0; shift < 2; shift++) {
        fw_fail(&m, FW_E_ARG, "%s%s", shift ? "a" : "", text);
        size_t n = strlen(m.text);
        assert_string_equal(m.text + n - 3, "...");
        assert_int_equal((unsigned char)m.text[n - 4], 0xa4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_and_exit_codes),
        cmocka_unit_test(failures_travel_up),
        cmocka_unit_test(long_messages_end_in_dots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
