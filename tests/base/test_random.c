#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "base/random.h"

/* Random123 1.14, examples/kat_vectors, lines "philox4x32 10". */
static void philox_known_answers(void **state)
{
    static const struct {
        uint32_t counter[4], key[2], out[4];
    } rows[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    uint32_t out[4];
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fw_philox4x32_10(rows[i].counter, rows[i].key, out);
        assert_memory_equal(out, rows[i].out, sizeof out);
    }
}

/* A stream's words are the blocks of its counter, in order, and the counter carries from word to word. */
static void counter_carries(void **state)
{
    (void)state;
    for (int words = 0; words <= 4; words++) { /* the lowest `words` words are about to wrap */
        fw_random r;
        fw_random_stream(&r, 1, FW_STREAM_TEST, 2, 3);
        uint32_t start[4] = {7, 7, 7, 7}, next[4] = {8, 7, 7, 7}, block[4];
        for (int i = 0; i < words; i++) {
            start[i] = 0xffffffff;
            next[i] = 0;
            if (i + 1 < 4) next[i + 1] = 8;
        }
        memcpy(r.counter, start, sizeof start);
        fw_philox4x32_10(start, r.key, block);
        for (int i = 0; i < 4; i++) assert_int_equal(fw_random_u32(&r), block[i]);
        fw_philox4x32_10(next, r.key, block);
        for (int i = 0; i < 4; i++) assert_int_equal(fw_random_u32(&r), block[i]);
        assert_memory_equal(r.counter + 1, words == 0 ? next + 1 : r.counter + 1, 3 * sizeof(uint32_t));
    }
}

/* A block by its number is what reading up to there gives. */
static void blocks_by_number(void **state)
{
    (void)state;
    fw_random r, start;
    uint32_t  block[4];
    fw_random_stream(&r, 1, FW_STREAM_TEST, 2, 3);
    start = r;
    for (uint64_t n = 0; n < 20; n++) {
        fw_random_block(n % 2 ? &r : &start, n, block);
        for (int i = 0; i < 4; i++) assert_int_equal(fw_random_u32(&r), block[i]);
    }
    r = start;
    r.counter[0] = 5, r.counter[1] = 7;
    fw_random_block(&start, (UINT64_C(7) << 32) + 5, block);
    for (int i = 0; i < 4; i++) assert_int_equal(fw_random_u32(&r), block[i]);
}

/* Read eight blocks at a time a stream is the same stream, also where the counter carries and in a copy. */
static void uniforms_are_those_of_the_stream(void **state)
{
    fw_random   r;
    fw_uniforms u;
    (void)state;
    for (uint64_t start = 0; start <= 0xfffffffcu; start += 0xfffffffcu) {
        fw_random_stream(&r, 1, FW_STREAM_TEST, 2, 3);
        fw_uniforms_stream(&u, 1, FW_STREAM_TEST, 2, 3);
        r.counter[0] = (uint32_t)start;
        u.n_blocks = start;
        for (int i = 0; i < 100; i++) {
            fw_uniforms copy = u;
            double      wanted = fw_random_uniform(&r);
            assert_true(fw_uniforms_next(&u) == wanted && fw_uniforms_next(&copy) == wanted);
        }
    }
}

static void gsl_gives_the_same_words(void **state)
{
    gsl_rng  *g = gsl_rng_alloc(fw_rng_philox());
    fw_random r;
    (void)state;

    fw_rng_stream(g, 20260101, FW_STREAM_FIELD, 5, UINT64_C(1) << 40);
    fw_random_stream(&r, 20260101, FW_STREAM_FIELD, 5, UINT64_C(1) << 40);
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(gsl_rng_get(g), fw_random_u32(&r));
        if (i % 3 == 0) assert_true(gsl_rng_uniform(g) == fw_random_uniform(&r));
    }
    gsl_rng_set(g, 42);
    fw_random_stream(&r, 42, FW_STREAM_TEST, 0, 0);
    for (int i = 0; i < 10; i++) assert_int_equal(gsl_rng_get(g), fw_random_u32(&r));
    assert_int_equal(gsl_rng_max(g), 0xffffffffu);
    assert_int_equal(gsl_rng_min(g), 0);
    gsl_rng_free(g);
}

/* Any change of seed, purpose, id or part gives other numbers, and the two are uncorrelated: for n = 4000 pairs of
 * independent uniforms the correlation has standard deviation 1/sqrt(n), so 5 of them is a bound one in 1.7 million
 * breaks. */
static void streams_are_independent(void **state)
{
    static const struct {
        uint64_t   seed;
        fw_purpose purpose;
        uint64_t   id, part;
    } rows[] = {{1, FW_STREAM_SCENARIO, 0, 0},
                {2, FW_STREAM_SCENARIO, 0, 0},
                {UINT64_C(1) << 32 | 1, FW_STREAM_SCENARIO, 0, 0},
                {1, FW_STREAM_FIELD, 0, 0},
                {1, FW_STREAM_SCENARIO, 1, 0},
                {1, FW_STREAM_SCENARIO, UINT64_C(1) << 32, 0},
                {1, FW_STREAM_SCENARIO, 0, 1},
                {1, FW_STREAM_SCENARIO, 0, UINT64_C(1) << 32},
                {1, FW_STREAM_SCENARIO, 0, UINT64_MAX}}; /* part = tile -1 */
    enum { N_ROWS = sizeof rows / sizeof rows[0], N = 4000 };
    (void)state;

    for (int a = 0; a < N_ROWS; a++) {
        for (int b = a + 1; b < N_ROWS; b++) {
            fw_random ra, rb;
            double    sum = 0;
            int       n_equal = 0;
            fw_random_stream(&ra, rows[a].seed, rows[a].purpose, rows[a].id, rows[a].part);
            fw_random_stream(&rb, rows[b].seed, rows[b].purpose, rows[b].id, rows[b].part);
            for (int i = 0; i < N; i++) {
                double u = fw_random_uniform(&ra), v = fw_random_uniform(&rb);
                n_equal += u == v;
                sum += 12 * (u - 0.5) * (v - 0.5);
            }
            assert_int_equal(n_equal, 0);
            assert_true(fabs(sum / N) < 5 / sqrt((double)N));
        }
    }
}

/* Ids of one purpose never share a (key, upper counter): Philox is a bijection of its counter. */
static void neighbouring_streams_differ_in_their_state(void **state)
{
    fw_random r[256];
    (void)state;

    for (uint64_t i = 0; i < 256; i++) fw_random_stream(&r[i], 9, FW_STREAM_FIELD, i / 16, i % 16);
    for (int i = 0; i < 256; i++) {
        for (int j = i + 1; j < 256; j++) {
            assert_false(memcmp(r[i].key, r[j].key, sizeof r[i].key) == 0 &&
                         memcmp(r[i].counter, r[j].counter, sizeof r[i].counter) == 0);
        }
    }
}

/* Moments of the uniform law: mean 1/2 with sd sqrt(1/12 n), variance 1/12 with sd sqrt(1/180 n); 5 sd each. */
static void uniform_is_open_and_even(void **state)
{
    enum { N = 200000 };
    fw_random r;
    double    sum = 0, sum2 = 0;
    (void)state;

    fw_random_stream(&r, 3, FW_STREAM_TEST, 0, 0);
    for (int i = 0; i < N; i++) {
        double u = fw_random_uniform(&r);
        assert_true(u > 0 && u < 1);
        sum += u - 0.5;
        sum2 += (u - 0.5) * (u - 0.5);
    }
    assert_true(fabs(sum / N) < 5 * sqrt(1 / (12.0 * N)));
    assert_true(fabs(sum2 / N - 1 / 12.0) < 5 * sqrt(1 / (180.0 * N)));

    /* the ends: words of all zeros and all ones stay inside */
    r.n_used = 0;
    memset(r.block, 0xff, sizeof r.block);
    assert_true(fw_random_uniform(&r) < 1);
    r.n_used = 0;
    memset(r.block, 0, sizeof r.block);
    assert_true(fw_random_uniform(&r) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_known_answers),
        cmocka_unit_test(counter_carries),
        cmocka_unit_test(blocks_by_number),
        cmocka_unit_test(uniforms_are_those_of_the_stream),
        cmocka_unit_test(gsl_gives_the_same_words),
        cmocka_unit_test(streams_are_independent),
        cmocka_unit_test(neighbouring_streams_differ_in_their_state),
        cmocka_unit_test(uniform_is_open_and_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
