#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <string.h>

#include "base/hash.h"

/* RFC 3720 appendix B.4 (iSCSI): 32 zeros, 32 ones, ascending, descending; and the catalogue's check string. */
static void crc32c_vectors(void **state)
{
    unsigned char bytes[32];
    (void)state;

    assert_int_equal(fw_crc32c(0, "123456789", 9), 0xe3069283u);
    assert_int_equal(fw_crc32c(0, "", 0), 0);
    memset(bytes, 0, sizeof bytes);
    assert_int_equal(fw_crc32c(0, bytes, 32), 0x8a9136aau);
    memset(bytes, 0xff, sizeof bytes);
    assert_int_equal(fw_crc32c(0, bytes, 32), 0x62a8ab43u);
    for (int i = 0; i < 32; i++) bytes[i] = (unsigned char)i;
    assert_int_equal(fw_crc32c(0, bytes, 32), 0x46dd794eu);
    for (int i = 0; i < 32; i++) bytes[i] = (unsigned char)(31 - i);
    assert_int_equal(fw_crc32c(0, bytes, 32), 0x113fdb5cu);
}

static void crc32c_goes_on_where_it_stopped(void **state)
{
    (void)state;
    for (size_t cut = 0; cut <= 9; cut++) {
        assert_int_equal(fw_crc32c(fw_crc32c(0, "123456789", cut), "123456789" + cut, 9 - cut), 0xe3069283u);
    }
}

/* Vectors of the FNV reference (Fowler, Noll, Vo; draft-eastlake-fnv appendix C). */
static void fnv1a64_vectors(void **state)
{
    (void)state;
    assert_true(fw_fnv1a64("", 0) == UINT64_C(0xcbf29ce484222325));
    assert_true(fw_fnv1a64("a", 1) == UINT64_C(0xaf63dc4c8601ec8c));
    assert_true(fw_fnv1a64("foobar", 6) == UINT64_C(0x85944171f73967e8));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crc32c_vectors),
        cmocka_unit_test(crc32c_goes_on_where_it_stopped),
        cmocka_unit_test(fnv1a64_vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
