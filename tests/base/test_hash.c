#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <string.h>

#include "base/hash.h"

typedef uint32_t crc_of(uint32_t crc, const void *bytes, size_t n);

static crc_of *const crcs[] = {fw_crc32c, fw_crc32c_by_table};

/* RFC 3720 appendix B.4 (iSCSI): 32 zeros, 32 ones, ascending, descending, a read command; and the catalogue's check string. */
static void crc32c_vectors(void **state)
{
    const unsigned char command[48] = {0x01, 0xc0, [16] = 0x14, [22] = 0x04, [27] = 0x14, [31] = 0x18, 0x28, [40] = 0x02};
    unsigned char       bytes[32];
    (void)state;

    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(crcs[k](0, "123456789", 9), 0xe3069283u);
        assert_int_equal(crcs[k](0, "", 0), 0);
        memset(bytes, 0, sizeof bytes);
        assert_int_equal(crcs[k](0, bytes, 32), 0x8a9136aau);
        memset(bytes, 0xff, sizeof bytes);
        assert_int_equal(crcs[k](0, bytes, 32), 0x62a8ab43u);
        for (int i = 0; i < 32; i++) bytes[i] = (unsigned char)i;
        assert_int_equal(crcs[k](0, bytes, 32), 0x46dd794eu);
        for (int i = 0; i < 32; i++) bytes[i] = (unsigned char)(31 - i);
        assert_int_equal(crcs[k](0, bytes, 32), 0x113fdb5cu);
        assert_int_equal(crcs[k](0, command, sizeof command), 0xd9963a56u);
    }
}

static void crc32c_goes_on_where_it_stopped(void **state)
{
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        for (size_t cut = 0; cut <= 9; cut++) {
            assert_int_equal(crcs[k](crcs[k](0, "123456789", cut), "123456789" + cut, 9 - cut), 0xe3069283u);
        }
    }
}

/* The polynomial's own definition, a bit at a time. */
static uint32_t crc_by_bits(uint32_t crc, const unsigned char *p, size_t n)
{
    crc = ~crc;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        for (int k = 0; k < 8; k++) crc = (crc >> 1) ^ (crc & 1 ? 0x82f63b78u : 0);
    }
    return ~crc;
}

/* Lengths round the widths that the bytes are taken in (8, and three times 4096), from addresses of every alignment. */
static void crc32c_is_the_same_by_every_way(void **state)
{
    enum { N = 3 * 3 * 4096 + 64 };
    static unsigned char bytes[N];
    const size_t         lengths[] = {0, 1, 7, 8, 9, 15, 16, 63, 4095, 4096, 12287, 12288, 12289, 12295, 24576, 24583, 36864, 36873};
    (void)state;

    for (size_t i = 0; i < N; i++) bytes[i] = (unsigned char)(i * i * 2654435761u >> 13);
    for (size_t l = 0; l < sizeof lengths / sizeof lengths[0]; l++) {
        for (size_t at = 0; at < 9; at++) {
            uint32_t wanted = crc_by_bits(0x12345678, bytes + at, lengths[l]);

            for (size_t k = 0; k < 2; k++) assert_int_equal(crcs[k](0x12345678, bytes + at, lengths[l]), wanted);
        }
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
        cmocka_unit_test(crc32c_is_the_same_by_every_way),
        cmocka_unit_test(fnv1a64_vectors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
