/* One campaign on one, two and three ranks over the stand-in simulation: the same bytes, the same decisions, and
 * orderly ends. FAKE_CAMPAIGN is the program of fake_campaign.c. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mpi/job.h"

static char folder[256];

static void settings(const char *cost_ms, const char *spread, const char *fail_every, const char *nomem_id)
{
    setenv("FAKE_COST_MS", cost_ms, 1);
    setenv("FAKE_SPREAD", spread, 1);
    setenv("FAKE_FAIL_EVERY", fail_every, 1);
    setenv("FAKE_NOMEM_ID", nomem_id, 1);
    unsetenv("FAKE_OTHER_RANK");
    unsetenv("FAKE_NO_CAMPAIGN_RANK");
    unsetenv("FAKE_REPORT_CPU");
    /* After a non-zero exit mpirun waits twice this time before it ends; nothing of ours is left to be killed by
     * then. */
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "0", 1);
}

/* Arguments of one run: records go to FOLDER/records<n_ranks>. */
typedef struct arguments {
    char        path[512];
    const char *list[8];
} arguments;

static const char *const *line(arguments *a, int n_ranks, const char *n, const char *enough_at, const char *max_failed,
                               const char *budget_s)
{
    snprintf(a->path, sizeof a->path, "%s/records%d", folder, n_ranks);
    a->list[0] = FAKE_CAMPAIGN;
    a->list[1] = n;
    a->list[2] = a->path;
    a->list[3] = enough_at;
    a->list[4] = max_failed;
    a->list[5] = budget_s;
    a->list[6] = NULL;
    return a->list;
}

static char *text_of(const char *suffix)
{
    char  path[512];
    char *text;

    snprintf(path, sizeof path, "%s/job.%s", folder, suffix);
    text = fw_job_read(path, NULL);
    assert_non_null(text);
    return text;
}

static void assert_says(const char *suffix, const char *part)
{
    char *text = text_of(suffix);

    if (!strstr(text, part)) fail_msg("job.%s lacks '%s': %s", suffix, part, text);
    free(text);
}

static void test_same_bytes(void **state)
{
    arguments a;
    char     *alone, *more;
    size_t    n_alone, n_more;

    (void)state;
    settings("2", "1", "13", "-1"); /* uneven costs mix up the order of arrival; some fail */
    assert_int_equal(fw_job_run(folder, "job", 0, line(&a, 0, "300", "0", "300", "0")), 0); /* without mpirun */
    assert_says("out", "prefix=300 done=300 failed=24 ");                                   /* ids 0, 13, ... 299 */
    alone = fw_job_read(a.path, &n_alone);
    assert_true(n_alone > 300 * 72 * 4 * 8); /* four rings of 72 doubles each */
    for (int n_ranks = 1; n_ranks <= 3; n_ranks++) {
        assert_int_equal(fw_job_run(folder, "job", n_ranks, line(&a, n_ranks, "300", "0", "300", "0")), 0);
        more = fw_job_read(a.path, &n_more);
        assert_int_equal(n_more, n_alone);
        assert_memory_equal(more, alone, n_alone);
        free(more);
    }
    free(alone);
}

static void test_more_ranks_than_work(void **state)
{
    arguments a;

    (void)state;
    settings("1", "0", "0", "-1");
    assert_int_equal(fw_job_run(folder, "job", 5, line(&a, 5, "2", "0", "2", "0")), 0);
    assert_says("out", "prefix=2 done=2 ");
}

/* Where the campaign ends is the same for any number of ranks, though surplus records differ. */
static void test_same_decisions(void **state)
{
    arguments a;
    char     *alone, *more;
    size_t    n_alone, n_more;

    (void)state;
    settings("1", "1", "0", "-1");
    assert_int_equal(fw_job_run(folder, "job", 1, line(&a, 1, "4000", "200", "40", "0")), 0);
    assert_says("out", "prefix=225 ");
    alone = fw_job_read(a.path, &n_alone);
    for (int n_ranks = 2; n_ranks <= 3; n_ranks++) {
        assert_int_equal(fw_job_run(folder, "job", n_ranks, line(&a, n_ranks, "4000", "200", "40", "0")), 0);
        assert_says("out", "prefix=225 ");
        assert_says("out", "enough=1 ");
        more = fw_job_read(a.path, &n_more);
        assert_true(n_more >= n_alone); /* 225 records at least, and at most those up to the look after it */
        assert_true(n_more <= n_alone / 225 * 338);
        assert_memory_equal(more, alone, n_alone);
        free(more);
    }
    free(alone);
    settings("1", "1", "10", "-1");
    for (int n_ranks = 1; n_ranks <= 3; n_ranks++) {
        assert_int_equal(fw_job_run(folder, "job", n_ranks, line(&a, n_ranks, "4000", "0", "3", "0")), 3);
        assert_says("out", "status=FW_E_FAILURES prefix=31 ");
        assert_says("err", "id 0 (seed 42): failed on purpose");
    }
}

static void test_worker_errors(void **state)
{
    arguments a;

    (void)state;
    settings("2", "0", "0", "30");
    for (int n_ranks = 1; n_ranks <= 3; n_ranks++) {
        assert_int_equal(fw_job_run(folder, "job", n_ranks, line(&a, n_ranks, "4000", "0", "3", "0")), 5);
        assert_says("out", "status=FW_E_NOMEM ");
        if (n_ranks == 1) assert_says("out", "prefix=30 ");
        assert_says("err", "realisation 30: out of memory on purpose");
    }
    settings("2", "0", "0", "-1");
    setenv("FAKE_OTHER_RANK", "1", 1);
    assert_int_equal(fw_job_run(folder, "job", 2, line(&a, 2, "4000", "0", "3", "0")), 4);
    assert_says("err", "another campaign");
    unsetenv("FAKE_OTHER_RANK");
    setenv("FAKE_NO_CAMPAIGN_RANK", "2", 1);
    assert_int_equal(fw_job_run(folder, "job", 3, line(&a, 3, "4000", "0", "3", "0")), 2);
    assert_says("err", "campaign.yaml: no such file");
    assert_says("err", "rank 2 on ");
}

static void test_budget(void **state)
{
    arguments a;
    double    start = fw_job_seconds();

    (void)state;
    settings("20", "1", "0", "-1");
    assert_int_equal(fw_job_run(folder, "job", 2, line(&a, 2, "4000", "0", "3", "0.5")), 75);
    assert_says("err", "the time budget of 0.5 s is used up");
    assert_true(fw_job_seconds() - start < 10.0);
}

/* mpirun passes SIGUSR1 on to all ranks and keeps rank 0's exit code; long realisations are dropped, not finished. */
static void test_signals(void **state)
{
    arguments a;
    fw_job    j;

    (void)state;
    settings("30000", "0", "0", "-1");
    j = fw_job_start(folder, "job", 2, line(&a, 2, "4", "0", "3", "0"));
    assert_true(fw_job_wait_for(&j, "ready", 2));
    fw_job_sleep(0.2);
    fw_job_signal(&j, SIGUSR1);
    assert_int_equal(fw_job_wait(&j, 5.0), 75);
    assert_says("err", "stopped by signal");

    /* Ctrl-C without mpirun */
    j = fw_job_start(folder, "job", 0, line(&a, 0, "4", "0", "3", "0"));
    assert_true(fw_job_wait_for(&j, "ready", 1));
    fw_job_sleep(0.2);
    fw_job_signal(&j, SIGINT);
    assert_int_equal(fw_job_wait(&j, 5.0), 75);

    /* one rank alone is asked to stop: all do */
    for (int which = 0; which < 2; which++) {
        j = fw_job_start(folder, "job", 2, line(&a, 2, "4", "0", "3", "0"));
        assert_true(fw_job_wait_for(&j, "ready", 2));
        fw_job_sleep(0.2);
        assert_true(fw_job_rank(&j, which) > 0);
        kill(fw_job_rank(&j, which), SIGTERM);
        assert_int_equal(fw_job_wait(&j, 5.0), 75);
    }
}

/* SIGINT to mpirun itself: it sends SIGTERM to the ranks and reports failure in its own way, whatever they say; what
 * counts is that all is in the sink within the second it grants. */
static void test_interrupted_mpirun(void **state)
{
    arguments a;
    fw_job    j;
    char     *records;
    size_t    n;

    (void)state;
    settings("5", "0", "0", "-1");
    unsetenv("OMPI_MCA_odls_base_sigkill_timeout");
    j = fw_job_start(folder, "job", 2, line(&a, 2, "100000", "0", "3", "0"));
    remove(a.path);
    assert_true(fw_job_wait_for(&j, "ready", 2));
    fw_job_sleep(0.4);
    fw_job_signal(&j, SIGINT);
    assert_true(fw_job_wait(&j, 10.0) > 0);
    assert_says("err", "stopped by signal");
    records = fw_job_read(a.path, &n);
    assert_non_null(records);
    assert_true(n > 0);
    free(records);
}

/* A killed worker takes the job with it: nobody waits for ever. */
static void test_killed_worker(void **state)
{
    arguments a;
    fw_job    j;

    (void)state;
    settings("30000", "0", "0", "-1");
    for (int which = 0; which < 2; which++) {
        j = fw_job_start(folder, "job", 2, line(&a, 2, "4", "0", "3", "0"));
        assert_true(fw_job_wait_for(&j, "ready", 2));
        fw_job_sleep(0.2);
        assert_true(fw_job_rank(&j, which) > 0);
        kill(fw_job_rank(&j, which), SIGKILL);
        assert_true(fw_job_wait(&j, 10.0) > 0);
    }
}

/* Workers without work leave the processor to others. */
static void test_idle_is_cheap(void **state)
{
    arguments a;
    char     *text, *facts;
    double    cpu;

    (void)state;
    settings("1000", "0", "0", "-1");
    setenv("FAKE_REPORT_CPU", "1", 1);
    assert_int_equal(fw_job_run(folder, "job", 2, line(&a, 2, "1", "0", "3", "0")), 0);
    text  = text_of("err");
    facts = text_of("out");
    assert_int_equal(sscanf(strstr(text, "rank 1 "), "rank 1 cpu=%lf", &cpu), 1);
    if (strstr(facts, "mine=1 ")) assert_true(cpu < 0.1); /* rank 0 had the only one */
    free(text);
    free(facts);
}

static int set_up(void **state)
{
    (void)state;
    fw_job_make_folder(folder, sizeof folder, "ranks");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    fw_job_remove_folder(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bytes),    cmocka_unit_test(test_more_ranks_than_work),
        cmocka_unit_test(test_same_decisions), cmocka_unit_test(test_worker_errors),
        cmocka_unit_test(test_budget),        cmocka_unit_test(test_signals),
        cmocka_unit_test(test_interrupted_mpirun), cmocka_unit_test(test_killed_worker),
        cmocka_unit_test(test_idle_is_cheap),
    };

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
