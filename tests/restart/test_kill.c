/* A record is a pure function of campaign and id, so nothing that happens to a job may show in its results: kill -9 of
 * all or of one rank at random moments, Ctrl-C, time budgets, other numbers of ranks. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "restart/bench.h"

static const char *const nothing[] = {NULL};

static int set_up(void **state)
{
    if (fw_bench_set_up(state)) return -1;
    fw_bench_cost("2");
    return fw_bench_run("whole", 1, nothing); /* undisturbed: what all the others are compared with */
}

static void test_kill_at_random_moments(void **state)
{
    unsigned seed    = (unsigned)time(NULL) ^ (unsigned)getpid();
    int      n_kills = 0;

    (void)state;
    print_message("seed of the moments: %u\n", seed);
    srand(seed); /* moments are meant to differ from run to run; the results must not */
    fw_bench_cost("3");
    while (n_kills < 6) {
        fw_job j = fw_bench_start("killed", 1 + rand() % 3, nothing);

        fw_job_sleep(0.2 + 0.4 * (double)rand() / RAND_MAX);
        if (fw_job_is_over(&j)) { /* too late for this kill: begin again */
            assert_int_equal(fw_job_wait(&j, 1.0), 0);
            assert_int_equal(remove(fw_bench_path("killed", "journal")), 0);
        } else if (n_kills % 3 == 2 && fw_job_rank(&j, 0)) { /* one rank only: mpirun ends the others */
            kill(fw_job_rank(&j, 0), SIGKILL);
            assert_true(fw_job_wait(&j, 10.0) > 0);
            n_kills++;
        } else {
            fw_job_kill(&j);
            n_kills++;
        }
    }
    assert_int_equal(fw_bench_run("killed", 2, nothing), 0); /* the last one goes through */
    assert_true(fw_bench_same_results("whole", "killed", BENCH_REALISATIONS));
}

/* The loss of a kill is bounded: the journal grows once a second, also while rank 0 is busy with realisations of its
 * own and far fewer than a hundred records wait. */
static void test_kill_loses_a_second_at_most(void **state)
{
    fw_job   j;
    uint64_t n = 0;
    double   start, grown = 0.0, longest = 0.0;

    (void)state;
    fw_bench_cost("60");
    setenv("FAKE_SPREAD", "0", 1);
    j = fw_bench_start("second", 2, nothing);
    for (start = fw_job_seconds(); fw_job_seconds() - start < 4.0; fw_job_sleep(0.05)) {
        uint64_t now_n = fw_bench_exists("second", "journal") ? fw_bench_journal_n("second") : 0;
        double   now   = fw_job_seconds();

        if (now_n == n) continue;
        if (n > 0 && now - grown > longest) longest = now - grown;
        n     = now_n;
        grown = now;
    }
    fw_job_kill(&j);
    setenv("FAKE_SPREAD", "1", 1);
    assert_true(longest > 0.0); /* twice at least */
    assert_true(longest < 1.5); /* 0.8 s and a realisation on a quiet machine */
    assert_true(fw_bench_journal_n("second") >= n);
}

static void test_interrupt_and_go_on(void **state)
{
    fw_job j;

    (void)state;
    fw_bench_cost("3");
    j = fw_bench_start("interrupted", 0, nothing); /* alone, as from a terminal */
    assert_true(fw_bench_wait_for_records("interrupted", 100));
    fw_job_signal(&j, SIGINT);
    assert_int_equal(fw_job_wait(&j, 5.0), 75);
    assert_true(fw_bench_says("interrupted", "err", "run the same command again to go on"));
    assert_true(fw_bench_exists("interrupted", "h5")); /* of the prefix so far */

    j = fw_bench_start("interrupted", 2, nothing);
    assert_true(fw_bench_wait_for_records("interrupted", fw_bench_journal_n("interrupted") + 100));
    fw_job_signal(&j, SIGUSR1); /* what a batch system sends ahead of its limit */
    assert_int_equal(fw_job_wait(&j, 5.0), 75);

    assert_int_equal(fw_bench_run("interrupted", 2, (const char *const[]){"--time-budget", "0.4s", NULL}), 75);
    assert_true(fw_bench_says("interrupted", "err", "time budget"));
    assert_int_equal(fw_bench_run("interrupted", 3, nothing), 0);
    assert_true(fw_bench_same_results("whole", "interrupted", BENCH_REALISATIONS));
}

/* Where precision ends a campaign is a function of its records: the same on one and two ranks, killed or not. */
static void test_precision_stop(void **state)
{
    static const char *const ask[] = {"--set", "precision.half_width=5%", NULL};
    fw_job                   j;

    (void)state;
    fw_bench_cost("4");
    assert_int_equal(fw_bench_run("precise", 1, ask), 0);
    assert_int_equal(fw_bench_run("precise2", 2, ask), 0);
    assert_true(fw_bench_same_answer("precise", "precise2"));
    j = fw_bench_start("precise3", 2, ask);
    fw_job_sleep(0.35);
    fw_job_kill(&j);
    assert_int_equal(fw_bench_run("precise3", 3, ask), 0);
    assert_true(fw_bench_same_answer("precise", "precise3"));
    /* and it did stop early, at a look */
    assert_true(fw_bench_journal_n("precise") < BENCH_REALISATIONS);
    assert_int_equal(fw_bench_journal_n("precise"), 338);
    /* a finer wish continues the same journal, to the bits of the undisturbed run */
    assert_int_equal(fw_bench_run("precise2", 2, nothing), 0);
    assert_true(fw_bench_same_results("whole", "precise2", BENCH_REALISATIONS));
}

static void test_nothing_left_to_do(void **state)
{
    (void)state;
    fw_bench_cost("1000");
    assert_int_equal(fw_bench_run("whole", 2, nothing), 0); /* at once, with the same answer */
    assert_true(fw_bench_same_results("whole", "interrupted", BENCH_REALISATIONS));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kill_at_random_moments), cmocka_unit_test(test_kill_loses_a_second_at_most),
        cmocka_unit_test(test_interrupt_and_go_on),    cmocka_unit_test(test_precision_stop),
        cmocka_unit_test(test_nothing_left_to_do),
    };

    return cmocka_run_group_tests(tests, set_up, fw_bench_tear_down);
}
