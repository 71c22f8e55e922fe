/* A record and its bytes: what is packed comes back bit for bit, and bytes that are something else are refused.
 * Expected values: the layout written at the top of record.c, laid out by hand, and IEEE 754 (1.0 =
 * 0x3ff0000000000000). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floewear/record.h"

enum { OFFSET_COLUMNS = 220 };

static uint64_t next(uint64_t *state) /* xorshift64: any bit pattern will do, NaN and infinities among them */
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static void fill(fw_record *r, uint64_t id)
{
    uint64_t state = 88172645463325252u + id;
    r->id = id;
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        uint64_t bits = next(&state);
        memcpy((char *)r + fw_record_columns[i].offset, &bits, 8);
    }
    for (size_t i = 0; i < fw_record_n_rings(r->n_arcs, r->n_laws); i++) {
        uint64_t bits = next(&state);
        memcpy(&r->rings[i], &bits, 8);
    }
    r->rings[0] = NAN;
    r->rings[1] = -0.0;
    r->rings[2] = 5e-324; /* the smallest subnormal */
}

static void test_round_trip(void **state)
{
    (void)state;
    for (size_t n_laws = 0; n_laws <= FW_MAX_LAWS; n_laws++) {
        fw_record a, b;
        fw_msg    m;
        assert_int_equal(fw_record_init(&a, 72, n_laws, &m), FW_OK);
        assert_int_equal(fw_record_init(&b, 72, n_laws, &m), FW_OK);
        fill(&a, UINT64_MAX - n_laws);
        size_t         n = fw_record_packed_size(72, n_laws);
        unsigned char *bytes = malloc(n), *again = malloc(n);
        assert_non_null(bytes);
        assert_non_null(again);
        fw_record_pack(&a, bytes);
        assert_int_equal(fw_record_unpack(&b, bytes, n, &m), FW_OK);
        assert_true(b.id == UINT64_MAX - n_laws);
        assert_memory_equal(a.rings, b.rings, 8 * fw_record_n_rings(72, n_laws));
        for (size_t i = 0; i < fw_n_record_columns; i++) {
            size_t o = fw_record_columns[i].offset;
            assert_memory_equal((char *)&a + o, (char *)&b + o, 8);
        }
        fw_record_pack(&b, again);
        assert_memory_equal(bytes, again, n);
        free(bytes);
        free(again);
        fw_record_free(&a);
        fw_record_free(&b);
    }
}

static void test_layout(void **state)
{
    (void)state;
    fw_record r;
    fw_msg    m;
    assert_int_equal(fw_record_init(&r, 2, 1, &m), FW_OK);
    r.id = 0x0102030405060708u;
    r.concentration = 1.0;
    r.rings[7] = -2.0; /* load_high of the second arc */
    size_t n = fw_record_packed_size(2, 1);
    assert_int_equal(n, 220 + 8 * fw_n_record_columns + 8 * 2 * 4);
    unsigned char *bytes = malloc(n);
    assert_non_null(bytes);
    fw_record_pack(&r, bytes);
    static const unsigned char head[20] = {2, 0, 0, 0, 1, 0, 0, 0, 8, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 0};
    static const unsigned char one[8] = {0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
    static const unsigned char two[8] = {0, 0, 0, 0, 0, 0, 0x00, 0xc0};
    assert_memory_equal(bytes, head, sizeof head);
    assert_memory_equal(bytes + OFFSET_COLUMNS, one, 8);
    assert_memory_equal(bytes + n - 8, two, 8);
    assert_ptr_equal(fw_record_load(&r, 0, FW_RING_HIGH), r.rings + 6);
    free(bytes);
    fw_record_free(&r);
}

static void test_failed_record_has_no_rings_and_no_leftovers(void **state)
{
    (void)state;
    fw_record a, b;
    fw_msg    m;
    assert_int_equal(fw_record_init(&a, 10, 2, &m), FW_OK);
    assert_int_equal(fw_record_init(&b, 10, 2, &m), FW_OK);
    fill(&a, 3);
    a.status = FW_E_NUMERIC;
    memset(a.cause, 'x', sizeof a.cause); /* left over from a longer sentence */
    strcpy(a.cause, "floe 7: overlap of a whole radius");
    size_t         n = fw_record_packed_size(10, 2);
    unsigned char *bytes = malloc(n);
    assert_non_null(bytes);
    fw_record_pack(&a, bytes);
    assert_null(memchr(bytes + 20, 'x', 200));
    fill(&b, 4);
    assert_int_equal(fw_record_unpack(&b, bytes, n, &m), FW_OK);
    assert_int_equal(b.status, FW_E_NUMERIC);
    assert_string_equal(b.cause, a.cause);
    for (size_t i = 0; i < fw_record_n_rings(10, 2); i++) { assert_true(b.rings[i] == 0.0); }
    memset(a.cause, 'x', sizeof a.cause); /* no NUL at all: cut, not run over */
    fw_record_pack(&a, bytes);
    assert_int_equal(fw_record_unpack(&b, bytes, n, &m), FW_OK);
    assert_int_equal(strlen(b.cause), sizeof b.cause - 1);
    free(bytes);
    fw_record_free(&a);
    fw_record_free(&b);
}

static void test_refused_bytes(void **state)
{
    (void)state;
    fw_record r, other;
    fw_msg    m;
    assert_int_equal(fw_record_init(&r, 8, 1, &m), FW_OK);
    size_t         n = fw_record_packed_size(8, 1);
    unsigned char *bytes = malloc(n);
    assert_non_null(bytes);
    fw_record_pack(&r, bytes);
    assert_int_equal(fw_record_unpack(&r, bytes, n - 1, &m), FW_E_FORMAT);
    assert_int_equal(fw_record_unpack(&r, bytes, 0, NULL), FW_E_FORMAT);
    /* The same number of bytes under other sizes: 8 x (1 + 3) = 32 = 32 x (1 + 0) */
    assert_int_equal(fw_record_init(&other, 32, 0, &m), FW_OK);
    assert_int_equal(fw_record_unpack(&other, bytes, n, &m), FW_E_FORMAT);
    bytes[16] = FW_N_STATUS;
    assert_int_equal(fw_record_unpack(&r, bytes, n, &m), FW_E_FORMAT);
    bytes[16] = 0;
    memset(bytes + 20, 'y', 200);
    assert_int_equal(fw_record_unpack(&r, bytes, n, &m), FW_E_FORMAT);
    free(bytes);
    fw_record_free(&r);
    fw_record_free(&other);
}

static void test_sizes(void **state)
{
    (void)state;
    fw_record r;
    fw_msg    m;
    assert_int_equal(fw_record_init(&r, 0, 0, &m), FW_OK);
    fw_record_free(&r);
    fw_record_free(&r);
    fw_record_free(NULL);
    assert_int_equal(fw_record_init(&r, SIZE_MAX, 1, &m), FW_E_ARG);
    assert_null(r.rings);
    assert_int_equal(fw_record_init(&r, 72, FW_MAX_LAWS + 1, &m), FW_E_ARG);
    fw_record_free(&r);
    for (size_t i = 0; i < fw_n_record_columns; i++) { /* no two columns share a place, each says what it is */
        assert_true(fw_record_columns[i].unit[0] != '\0' && fw_record_columns[i].long_name[0] != '\0');
        for (size_t k = 0; k < i; k++) {
            assert_true(fw_record_columns[i].offset != fw_record_columns[k].offset);
            assert_string_not_equal(fw_record_columns[i].name, fw_record_columns[k].name);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_failed_record_has_no_rings_and_no_leftovers),
        cmocka_unit_test(test_refused_bytes),
        cmocka_unit_test(test_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
