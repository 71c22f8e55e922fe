#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static void alloc_zeroes_and_takes_none(void **state)
{
    double *a = NULL;
    fw_msg  m;
    (void)state;

    assert_int_equal(fw_alloc(&a, 100, sizeof *a, "doubles", &m), FW_OK);
    for (int i = 0; i < 100; i++) assert_true(a[i] == 0);
    free(a);
    a = NULL;
    assert_int_equal(fw_alloc(&a, 0, sizeof *a, "none", &m), FW_OK);
    assert_non_null(a);
    free(a);
}

static void too_much_is_a_status(void **state)
{
    double *a = NULL;
    size_t  capacity = 0;
    fw_msg  m = {""};
    (void)state;

    assert_int_equal(fw_alloc(&a, SIZE_MAX / 4, sizeof *a, "the moon", &m), FW_E_NOMEM);
    assert_null(a);
    assert_non_null(strstr(m.text, "the moon"));
    assert_int_equal(fw_grow(&a, &capacity, SIZE_MAX / 4, sizeof *a, "the moon", &m), FW_E_NOMEM);
    assert_null(a);
    assert_int_equal(capacity, 0);
    assert_int_equal(fw_alloc(&a, SIZE_MAX / 4, sizeof *a, "the moon", NULL), FW_E_NOMEM);
}

static void grow_keeps_and_zeroes(void **state)
{
    int   *a = NULL;
    size_t capacity = 0;
    fw_msg m;
    (void)state;

    for (int i = 0; i < 1000; i++) {
        size_t before = capacity;
        assert_int_equal(fw_grow(&a, &capacity, (size_t)i + 1, sizeof *a, "ints", &m), FW_OK);
        for (size_t k = before; k < capacity; k++) assert_int_equal(a[k], 0);
        a[i] = i;
    }
    for (int i = 0; i < 1000; i++) assert_int_equal(a[i], i);
    assert_true(capacity < 2048 + 1);
    free(a);
}

static void strdup_copies(void **state)
{
    char *s = fw_strdup("ice");
    (void)state;

    assert_string_equal(s, "ice");
    free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alloc_zeroes_and_takes_none),
        cmocka_unit_test(too_much_is_a_status),
        cmocka_unit_test(grow_keeps_and_zeroes),
        cmocka_unit_test(strdup_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
