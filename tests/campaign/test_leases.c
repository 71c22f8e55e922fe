#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/random.h"
#include "campaign/leases.h"

static uint64_t take(fw_leases *l, int rank)
{
    uint64_t id = UINT64_MAX;

    assert_true(fw_leases_take(l, rank, &id));
    return id;
}

static void done(fw_leases *l, int rank, uint64_t id)
{
    assert_int_equal(fw_leases_done(l, rank, id, NULL, NULL), FW_OK);
}

static void test_prefix_waits_for_the_slowest(void **state)
{
    fw_leases l;
    uint64_t  n;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 2, 0, 4, 4, false, 0, NULL, 0, NULL, NULL), FW_OK);
    assert_int_equal(take(&l, 0), 0);
    assert_int_equal(take(&l, 1), 1);
    assert_int_equal(take(&l, 1), 2);
    done(&l, 1, 1);
    done(&l, 1, 2);
    assert_int_equal(fw_leases_prefix(&l), 0);
    assert_int_equal(take(&l, 1), 3);
    assert_false(fw_leases_take(&l, 1, &n)); /* all are given out */
    done(&l, 0, 0);
    assert_int_equal(fw_leases_prefix(&l), 3);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_GO_ON);
    done(&l, 1, 3);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_END);
    assert_int_equal(n, 4);
    /* a record from a rank that does not hold it is a broken promise, and changes nothing */
    assert_int_equal(fw_leases_done(&l, 1, 3, NULL, NULL), FW_E_INTERNAL);
    assert_int_equal(l.n_done, 4);
    fw_leases_destroy(&l);
}

static void test_journal_is_skipped(void **state)
{
    static const uint64_t have[] = {0, 1, 4, 6, 9, 12};
    static const uint64_t rest[] = {2, 3, 5, 7, 8};
    fw_leases             l;
    uint64_t              n;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 1, 0, 10, 10, false, 6, have, 0, NULL, NULL), FW_OK);
    assert_int_equal(l.n_done, 5); /* 12 lies beyond the end */
    assert_int_equal(fw_leases_prefix(&l), 2);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(take(&l, 0), rest[i]);
        done(&l, 0, rest[i]);
    }
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_END);
    assert_int_equal(l.n_done, 10);
    fw_leases_destroy(&l);
}

static void test_everything_is_there(void **state)
{
    static const uint64_t have[] = {0, 1, 2, 3};
    fw_leases             l;
    uint64_t              n, id;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 3, 0, 3, 3, true, 4, have, 0, NULL, NULL), FW_OK);
    assert_false(fw_leases_take(&l, 0, &id));
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_LOOK); /* the end is a look too */
    assert_int_equal(n, 3);
    fw_leases_looked(&l);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_END);
    assert_int_equal(n, 3);
    fw_leases_destroy(&l);
}

/* A part of a campaign: what a journal holds before and behind it, and what failed there, is of no concern. */
static void test_a_part(void **state)
{
    static const uint64_t have[] = {0, 4, 11, 13, 20, 21}, have_failed[] = {0, 4, 13, 21};
    static const uint64_t rest[] = {10, 12, 14, 15, 16, 17, 18, 19};
    fw_leases             l;
    uint64_t              n, id;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 2, 10, 20, 1, false, 6, have, 4, have_failed, NULL), FW_OK);
    assert_int_equal(l.n_done, 2);
    assert_int_equal(l.n_failed, 1);
    assert_int_equal(fw_leases_prefix(&l), 10);
    for (size_t i = 0; i < 8; i++) {
        assert_int_equal(take(&l, 0), rest[i]);
        assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_GO_ON);
        done(&l, 0, rest[i]);
    }
    assert_false(fw_leases_take(&l, 1, &id));
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_END);
    assert_int_equal(n, 20);
    fw_leases_destroy(&l);

    assert_int_equal(fw_leases_create(&l, 1, 10, 20, 0, false, 6, have, 4, have_failed, NULL), FW_OK);
    for (id = 10; id < 13; id += 2) {
        assert_int_equal(take(&l, 0), id);
        done(&l, 0, id);
    }
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_FAILED); /* by 13, not by 0 and 4 */
    assert_int_equal(n, 14);
    fw_leases_destroy(&l);
}

static void test_nothing_asked(void **state)
{
    fw_leases l;
    uint64_t  n = 7;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 1, 0, 0, 0, false, 0, NULL, 0, NULL, NULL), FW_OK);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_END);
    assert_int_equal(n, 0);
    fw_leases_destroy(&l);
}

/* Going on while a look is pending ends at the look after it. */
static void test_bounded_ahead(void **state)
{
    fw_leases l;
    uint64_t  id, n;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 2, 0, 4000, 40, true, 0, NULL, 0, NULL, NULL), FW_OK);
    assert_int_equal(take(&l, 0), 0); /* rank 0 sits on the first one */
    for (uint64_t i = 1; i < 150; i++) {
        assert_int_equal(take(&l, 1), i);
        done(&l, 1, i);
    }
    assert_false(fw_leases_take(&l, 1, &id));
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_GO_ON);
    done(&l, 0, 0);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_LOOK);
    assert_int_equal(n, 100); /* looks come in order, each on its own prefix, though 150 are complete */
    fw_leases_looked(&l);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_LOOK);
    assert_int_equal(n, 150);
    fw_leases_looked(&l);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_GO_ON);
    assert_int_equal(fw_leases_n_open(&l), 338 - 150);
    fw_leases_destroy(&l);
}

static void test_failure_limit_in_order(void **state)
{
    fw_leases l;
    uint64_t  n, id;
    fw_msg    m;

    (void)state;
    assert_int_equal(fw_leases_create(&l, 2, 0, 1000, 1, true, 0, NULL, 0, NULL, &m), FW_OK);
    assert_int_equal(take(&l, 0), 0);
    for (uint64_t i = 1; i <= 5; i++) {
        take(&l, 1);
        assert_int_equal(fw_leases_done(&l, 1, i, i == 3 || i == 5 ? "why" : NULL, NULL), FW_OK);
    }
    /* two failures are more than one, but 0 is still out: no verdict yet, and no new work either */
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_GO_ON);
    assert_false(fw_leases_take(&l, 1, &id));
    assert_int_equal(fw_leases_done(&l, 0, 0, "late", NULL), FW_OK);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_FAILED);
    assert_int_equal(n, 4); /* ids 0 and 3: the second failure decides, 5 does not matter */
    assert_int_equal(l.n_causes, 3);
    assert_int_equal(l.causes[0].id, 0);
    assert_string_equal(l.causes[0].cause, "late");
    assert_int_equal(l.causes[2].id, 5);
    fw_leases_destroy(&l);
}

/* Failures beyond a look that is enough do not count, wherever the records came from. */
static void test_look_comes_before_later_failures(void **state)
{
    uint64_t              have[150];
    static const uint64_t failed[] = {120, 130};
    fw_leases             l;
    uint64_t              n;

    (void)state;
    for (uint64_t i = 0; i < 150; i++) have[i] = i;
    assert_int_equal(fw_leases_create(&l, 1, 0, 1000, 1, true, 150, have, 2, failed, NULL), FW_OK);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_LOOK);
    assert_int_equal(n, 100);
    fw_leases_looked(&l);
    assert_int_equal(fw_leases_judge(&l, &n), FW_VERDICT_FAILED);
    assert_int_equal(n, 131);
    fw_leases_destroy(&l);
}

/* The law behind all of it: whatever the order of arrival, the number of ranks and the restarts, the campaign ends
 * on the same prefix with the same verdict. Failures and "enough" are fixed functions of id and n here. */
static bool fails(uint64_t id) { return id % 37 == 5; }
static bool enough(uint64_t n, uint64_t at) { return n >= at; }

static fw_verdict play(uint64_t seed, int n_ranks, uint64_t enough_at, uint64_t max_failed, uint64_t *n_end)
{
    static uint64_t have[2000], failed[2000];
    size_t          n_have = 0, n_failed = 0;
    fw_random       random;

    fw_random_stream(&random, seed, FW_STREAM_TEST, 0, 0);
    for (;;) { /* one turn per restart */
        fw_leases  l;
        fw_verdict v = FW_VERDICT_GO_ON;
        bool       is_done[2000] = {false};
        int        patience = (int)(fw_random_u32(&random) % 400);

        for (size_t i = 0; i < n_have; i++) is_done[have[i]] = true;
        assert_int_equal(fw_leases_create(&l, n_ranks, 0, 600, max_failed, true, n_have, have, n_failed, failed, NULL),
                         FW_OK);
        for (;;) {
            int      rank = (int)(fw_random_u32(&random) % (uint32_t)n_ranks);
            uint64_t id;

            v = fw_leases_judge(&l, n_end);
            if (v == FW_VERDICT_LOOK && !enough(*n_end, enough_at)) {
                fw_leases_looked(&l);
                continue;
            }
            if (v != FW_VERDICT_GO_ON || patience-- == 0) break;
            if (fw_random_u32(&random) % 2) fw_leases_take(&l, rank, &id);
            if (fw_random_u32(&random) % 2 && l.held[rank].n) { /* any of the held ones may come first */
                id = l.held[rank].ids[fw_random_u32(&random) % l.held[rank].n];
                assert_false(is_done[id]);
                is_done[id] = true;
                assert_int_equal(fw_leases_done(&l, rank, id, fails(id) ? "x" : NULL, NULL), FW_OK);
            }
        }
        for (uint64_t i = 0; i < fw_leases_prefix(&l); i++) assert_true(is_done[i]);
        fw_leases_destroy(&l);
        if (v != FW_VERDICT_GO_ON) return v;
        n_have = n_failed = 0;
        for (uint64_t i = 0; i < 2000; i++) {
            if (is_done[i]) have[n_have++] = i;
            if (is_done[i] && fails(i)) failed[n_failed++] = i;
        }
    }
}

static void test_verdict_is_a_function_of_the_records(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        int      n_ranks = 1 + (int)(seed % 9);
        uint64_t n;

        /* enough at the look 225; failures below it: 5, 42, 79, 116, 153, 190 */
        assert_int_equal(play(seed, n_ranks, 200, 6, &n), FW_VERDICT_LOOK);
        assert_int_equal(n, 225);
        /* the fifth failure, id 153, comes before the look 225 */
        assert_int_equal(play(seed, n_ranks, 200, 4, &n), FW_VERDICT_FAILED);
        assert_int_equal(n, 154);
        /* never enough: the end; 16 failures below 600 (5 + 37 k, k = 0 .. 15) */
        assert_int_equal(play(seed, n_ranks, 5000, 17, &n), FW_VERDICT_END);
        assert_int_equal(n, 600);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_prefix_waits_for_the_slowest),
        cmocka_unit_test(test_journal_is_skipped),
        cmocka_unit_test(test_everything_is_there),
        cmocka_unit_test(test_a_part),
        cmocka_unit_test(test_nothing_asked),
        cmocka_unit_test(test_bounded_ahead),
        cmocka_unit_test(test_failure_limit_in_order),
        cmocka_unit_test(test_look_comes_before_later_failures),
        cmocka_unit_test(test_verdict_is_a_function_of_the_records),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
