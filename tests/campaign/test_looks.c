#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "campaign/looks.h"

/* 100 x 1.5^k rounded half up, by hand. */
static void test_schedule(void **state)
{
    static const uint64_t want[] = {100, 150, 225, 338, 507, 761, 1142, 1713, 2570, 3855, 4000, 4000};
    uint64_t              look   = fw_looks_first(4000);

    (void)state;
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        assert_int_equal(look, want[i]);
        look = fw_looks_next(look, 4000);
    }
}

static void test_ends(void **state)
{
    (void)state;
    assert_int_equal(fw_looks_first(30), 30);
    assert_int_equal(fw_looks_next(30, 30), 30);
    assert_int_equal(fw_looks_first(0), 0);
    assert_int_equal(fw_looks_next(0, 0), 0);
    assert_int_equal(fw_looks_first(100), 100);
    assert_int_equal(fw_looks_next(100, 120), 120);
    assert_int_equal(fw_looks_next(100, 150), 150);
    /* no overflow near the end of the ids */
    assert_int_equal(fw_looks_next(UINT64_MAX - 10, UINT64_MAX), UINT64_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_schedule), cmocka_unit_test(test_ends)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
