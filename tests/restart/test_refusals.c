/* What `floewear run` refuses, and that it leaves everything as it was: foreign files, full disks, wrong arguments. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "restart/bench.h"

static const char *const few[]  = {"--set", "precision.max_realisations=40", NULL};
static const char *const none[] = {NULL};
static const char *const few_failed[] = {"--set", "precision.max_failed=2", NULL};

static int set_up(void **state)
{
    if (fw_bench_set_up(state)) return -1;
    fw_bench_cost("0");
    return fw_bench_run("good", 1, few);
}

static void put(const char *stem, const char *ending, const char *text)
{
    FILE *f = fopen(fw_bench_path(stem, ending), "w");

    assert_non_null(f);
    assert_true(fputs(text, f) >= 0);
    assert_int_equal(fclose(f), 0);
}

static void test_journal_of_another_campaign(void **state)
{
    (void)state;
    assert_int_equal(rename(fw_bench_path("good", "journal"), fw_bench_path("other", "journal")), 0);
    for (int n_ranks = 0; n_ranks <= 2; n_ranks += 2) {
        assert_int_equal(fw_bench_run("other", n_ranks, (const char *const[]){"--seed", "8", NULL}), 4);
        assert_true(fw_bench_says("other", "err", "seed"));
    }
    assert_int_equal(fw_bench_run("other", 0, (const char *const[]){"--set", "contact.friction=0.2", NULL}), 4);
    assert_true(fw_bench_says("other", "err", "friction"));
    assert_int_equal(fw_bench_journal_n("other"), 40);
    assert_int_equal(rename(fw_bench_path("other", "journal"), fw_bench_path("good", "journal")), 0);
}

/* The results file of another campaign, its journal gone: would be lost. */
static void test_results_of_another_campaign(void **state)
{
    (void)state;
    assert_int_equal(fw_bench_run("mine", 0, few), 0);
    assert_int_equal(remove(fw_bench_path("mine", "journal")), 0);
    assert_int_equal(link(fw_bench_path("mine", "h5"), fw_bench_path("kept", "h5")), 0);
    assert_int_equal(fw_bench_run("mine", 0, (const char *const[]){"--seed", "8", few[0], few[1], NULL}), 4);
    assert_true(fw_bench_says("mine", "err", "another campaign"));
    assert_true(fw_bench_same_file("mine", "kept", "h5"));
    assert_false(fw_bench_exists("mine", "journal"));
    assert_int_equal(fw_bench_run("mine", 0, (const char *const[]){"--fresh", "--seed", "8", few[0], few[1], NULL}), 0);
    assert_int_equal(fw_bench_run("mine", 0, (const char *const[]){"--seed", "8", few[0], few[1], NULL}), 0);
}

static void test_foreign_files(void **state)
{
    (void)state;
    put("notes", "h5", "these are my notes, not results\n");
    assert_int_equal(fw_bench_run("notes", 0, few), 4);
    assert_true(fw_bench_says("notes", "h5", "these are my notes"));
    assert_false(fw_bench_exists("notes", "journal"));
    put("diary", "journal", "dear diary\n");
    assert_int_equal(fw_bench_run("diary", 2, few), 4);
    assert_true(fw_bench_says("diary", "journal", "dear diary"));
    assert_false(fw_bench_exists("diary", "h5"));
}

static void test_missing_folder(void **state)
{
    const char *const line[] = {fw_bench_path("campaign", "yaml"), "-o", fw_bench_path("nowhere/x", ""), NULL};

    (void)state;
    for (int n_ranks = 0; n_ranks <= 2; n_ranks += 2) {
        assert_int_equal(fw_bench_call("call", n_ranks, line), 4);
        assert_true(fw_bench_says("call", "err", "nowhere"));
    }
}

static void test_unwritable_folder(void **state)
{
    (void)state;
    if (geteuid() == 0) skip(); /* root may write anywhere */
    assert_int_equal(mkdir(fw_bench_path("locked", ""), 0500), 0);
    assert_int_equal(fw_bench_run("locked/x", 0, few), 4);
    assert_int_equal(rmdir(fw_bench_path("locked", "")), 0);
}

/* The disk fills up in mid-campaign: exit 4 with the reason; with room again the same command ends with the same
 * bits. */
static void test_full_disk(void **state)
{
    char small[512];

    (void)state;
    snprintf(small, sizeof small, "%s", fw_bench_path("small", ""));
    assert_int_equal(mkdir(small, 0700), 0);
    if (mount("tmpfs", small, "tmpfs", 0, "size=80k") != 0) {
        assert_int_equal(rmdir(small), 0);
        skip(); /* only root may, and not in every container */
    }
    for (int n_ranks = 1; n_ranks <= 2; n_ranks++) {
        const char *const line[] = {fw_bench_path("campaign", "yaml"), "-o", fw_bench_path("small/a", ""), "--json",
                                    few[0], few[1], NULL};

        assert_int_equal(fw_bench_call("full", n_ranks, line), 4);
        assert_true(fw_bench_says("full", "err", "space"));
    }
    assert_int_equal(mount("tmpfs", small, "tmpfs", MS_REMOUNT, "size=40m"), 0);
    {
        const char *const line[] = {fw_bench_path("campaign", "yaml"), "-o", fw_bench_path("small/a", ""), "--json",
                                    few[0], few[1], NULL};

        assert_int_equal(fw_bench_call("full", 2, line), 0);
    }
    assert_true(fw_bench_same_answer("full", "good"));
    assert_int_equal(umount(small), 0);
    assert_int_equal(rmdir(small), 0);
}

static void test_fresh_keeps_the_old_journal(void **state)
{
    (void)state;
    assert_int_equal(fw_bench_run("anew", 0, few), 0);
    assert_int_equal(fw_bench_run("anew", 0, (const char *const[]){"--fresh", few[0], few[1], NULL}), 0);
    assert_true(fw_bench_exists("anew", "journal.old"));
    assert_int_equal(fw_bench_journal_n("anew"), 40);
    assert_true(fw_bench_same_answer("anew", "good"));
}

static void test_output_names(void **state)
{
    const char *const line[] = {fw_bench_path("campaign", "yaml"), "-o", fw_bench_path("named", "h5"), few[0], few[1],
                                NULL};

    (void)state;
    assert_int_equal(fw_bench_call("call", 0, line), 0); /* -o NAME.h5 is NAME */
    assert_true(fw_bench_exists("named", "h5") && fw_bench_exists("named", "journal"));
    assert_false(fw_bench_exists("named.h5", "h5"));
}

static void test_only_id_writes_nothing(void **state)
{
    const char *const text[] = {fw_bench_path("campaign", "yaml"), "-o", fw_bench_path("single", ""), "--only-id", "17",
                                NULL};

    (void)state;
    assert_int_equal(fw_bench_run("single", 2, (const char *const[]){"--only-id", "17", NULL}), 0);
    assert_true(fw_bench_says("single", "out", "\"id\": 17"));
    assert_true(fw_bench_says("single", "out", "\"wear_load\""));
    assert_int_equal(fw_bench_call("text", 0, text), 0);
    assert_true(fw_bench_says("text", "out", "normal_impulse"));
    setenv("FAKE_FAIL_EVERY", "17", 1);
    assert_int_equal(fw_bench_run("single", 0, (const char *const[]){"--only-id", "17", NULL}), 3);
    unsetenv("FAKE_FAIL_EVERY");
    assert_true(fw_bench_says("single", "out", "failed on purpose"));
    assert_false(fw_bench_exists("single", "journal") || fw_bench_exists("single", "h5"));
}

static void test_failures(void **state)
{
    (void)state;
    setenv("FAKE_FAIL_EVERY", "7", 1);
    for (int n_ranks = 1; n_ranks <= 2; n_ranks++) {
        assert_int_equal(fw_bench_run("failing", n_ranks, few_failed), 3);
        assert_true(fw_bench_says("failing", "err", "failed: id 14 (seed 20260101): failed on purpose"));
    }
    unsetenv("FAKE_FAIL_EVERY");
    assert_true(fw_bench_journal_n("failing") >= 15);
}

static void test_arguments(void **state)
{
    static const char *const wrong[][6] = {
        {"--seed", "-1"}, {"--seed", "7x"}, {"--only-id", "x"}, {"--time-budget", "2 parsecs"}, {"--time-budget", "0s"},
        {"--set", "novalue"}, {"--set", "precision.half_widht=3%"}, {"--set", "ice.concentration=150%"}, {"--nonsense"},
        {"another.yaml"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char *text;

        assert_int_equal(fw_bench_run("wrong", i % 3 == 0 ? 2 : 0, wrong[i]), 2);
        text = fw_job_read(fw_bench_path("wrong", "err"), NULL);
        assert_non_null(text);
        assert_true(strlen(text) > 10);
        free(text);
        assert_false(fw_bench_exists("wrong", "journal"));
    }
    assert_int_equal(fw_bench_call("wrong", 0, none), 2);
    assert_int_equal(fw_bench_call("wrong", 2, (const char *const[]){"missing.yaml", NULL}), 4);
    assert_true(fw_bench_says("wrong", "err", "missing.yaml"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_journal_of_another_campaign), cmocka_unit_test(test_results_of_another_campaign),
        cmocka_unit_test(test_foreign_files),               cmocka_unit_test(test_missing_folder),
        cmocka_unit_test(test_unwritable_folder),           cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_fresh_keeps_the_old_journal), cmocka_unit_test(test_output_names),
        cmocka_unit_test(test_only_id_writes_nothing),      cmocka_unit_test(test_failures),
        cmocka_unit_test(test_arguments),
    };

    return cmocka_run_group_tests(tests, set_up, fw_bench_tear_down);
}
