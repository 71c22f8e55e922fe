/* The real program on a small campaign of thin, sparse ice: the same bits on one, two and three ranks and without
 * mpirun. FLOEWEAR is the program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mpi/compare.h"
#include "mpi/job.h"

static char folder[256];

static const char campaign[] = "name: small\n"
                               "ice:\n"
                               "  temperature: {uniform: [-12 degC, -2 degC]}\n"
                               "  thickness_mixes:\n"
                               "    - {probability: 0.5, classes: {0.3 m: 1}}\n"
                               "    - {probability: 0.5, classes: {0.3 m: 1, 0.4 m: 1}}\n"
                               "  concentration: {values: [10 %, 30 %], probabilities: [0.5, 0.5]}\n"
                               "current:\n"
                               "  speed: {uniform: [0.5 m/s, 1.5 m/s]}\n"
                               "  direction: {rose: {0 deg: 1, 90 deg: 2}}\n"
                               "abrasion: {laws: [bekker2011, archard]}\n"
                               "exposure: {window: 60 s}\n"
                               "precision: {quantity: P90, half_width: 0 %, max_realisations: 24}\n"
                               "seed: 3\n";

/* All that makes a window's water, air and ice move otherwise; a tide that reverses within the window. */
static const char drift[] = "name: drift\n"
                            "ice:\n"
                            "  temperature: -10 degC\n"
                            "  thickness_mixes: [{probability: 1, classes: {0.5 m: 1, 0.9 m: 1}}]\n"
                            "  concentration: 40 %\n"
                            "current: {speed: {uniform: [0.3 m/s, 1.5 m/s]}, direction: 0 deg, tide: {period: 20 min, minor_ratio: -0.2}}\n"
                            "wind: {speed: {uniform: [5 m/s, 20 m/s]}, angle: {uniform: [0 deg, 360 deg]}}\n"
                            "water: {skin_drag: 0.0055, added_mass: on, deflected_flow: on}\n"
                            "contact: {floe_stiffness: 1000 kN/m, floe_friction: 0.05}\n"
                            "exposure: {window: 10 min, warm_up: 60 s}\n"
                            "precision: {quantity: P90, half_width: 0 %, max_realisations: 8}\n"
                            "seed: 4\n";

static const char *path(const char *name)
{
    static char     paths[4][512];
    static unsigned at;

    at = (at + 1) % 4;
    snprintf(paths[at], sizeof paths[at], "%s/%s", folder, name);
    return paths[at];
}

static int set_up(void **state)
{
    FILE *f;

    (void)state;
    fw_job_make_folder(folder, sizeof folder, "program");
    f = fopen(path("small.yaml"), "w");
    if (!f || fputs(campaign, f) < 0 || fclose(f) != 0) return -1;
    f = fopen(path("drift.yaml"), "w");
    return f && fputs(drift, f) >= 0 && fclose(f) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    fw_job_remove_folder(folder);
    return 0;
}

static void test_same_bits_on_any_number_of_ranks(void **state)
{
    const char *const alone[] = {FLOEWEAR, "run", path("small.yaml"), "-o", path("r0"), "--json", NULL};

    (void)state;
    assert_int_equal(fw_job_run(folder, "r0", 0, alone), 0);
    for (int n_ranks = 1; n_ranks <= 3; n_ranks++) {
        static const char *const stems[] = {"", "r1", "r2", "r3"};
        const char              *stem    = stems[n_ranks];
        const char *const        line[]  = {FLOEWEAR, "run", path("small.yaml"), "-o", path(stem), "--json", NULL};
        char                     h5[16], out[16];

        snprintf(h5, sizeof h5, "%s.h5", stem);
        snprintf(out, sizeof out, "%s.out", stem);
        assert_int_equal(fw_job_run(folder, stem, n_ranks, line), 0);
        assert_true(fw_compare_results(path("r0.h5"), path(h5), 24, 360, 2));
        assert_true(fw_compare_json(path("r0.out"), path(out)));
    }
}

/* Parts run in three places and merged in any order are the campaign of one place; so is what goes on from two of them. */
static void test_same_bits_in_parts(void **state)
{
    static const char *const stems[] = {"p1", "p2", "p3"}, *const ids[] = {"0:7", "7:15", "15:24"};
    const char *const        alone[] = {FLOEWEAR, "run", path("small.yaml"), "-o", path("p0"), "--json", NULL};

    (void)state;
    assert_int_equal(fw_job_run(folder, "p0", 0, alone), 0);
    for (int k = 0; k < 3; k++) {
        const char *const line[] = {FLOEWEAR, "run", path("small.yaml"), "-o", path(stems[k]), "--ids", ids[k], NULL};

        assert_int_equal(fw_job_run(folder, stems[k], k, line), 0);
    }
    const char *const merged[] = {FLOEWEAR, "merge", path("p3.h5"), path("p1.h5"), path("p2.h5"), "-o", path("pm"), "--json", NULL};
    assert_int_equal(fw_job_run(folder, "pm", 0, merged), 0);
    assert_true(fw_compare_results(path("p0.h5"), path("pm.h5"), 24, 360, 2));
    assert_true(fw_compare_json(path("p0.out"), path("pm.out")));

    const char *const holed[] = {FLOEWEAR, "merge", path("p1.h5"), path("p3.h5"), "-o", path("pg"), "--quiet", NULL};
    assert_int_equal(fw_job_run(folder, "pg", 0, holed), 0);
    const char *const going_on[] = {FLOEWEAR, "run", path("small.yaml"), "-o", path("pg"), "--json", NULL};
    assert_int_equal(fw_job_run(folder, "pg", 2, going_on), 0);
    assert_true(fw_compare_results(path("p0.h5"), path("pg.h5"), 24, 360, 2));
    assert_true(fw_compare_json(path("p0.out"), path("pg.out")));
}

static void test_same_bits_with_every_further_effect(void **state)
{
    const char *const alone[] = {FLOEWEAR, "run", path("drift.yaml"), "-o", path("d0"), "--json", NULL};
    const char *const two[] = {FLOEWEAR, "run", path("drift.yaml"), "-o", path("d2"), "--json", NULL};

    (void)state;
    assert_int_equal(fw_job_run(folder, "d0", 0, alone), 0);
    assert_int_equal(fw_job_run(folder, "d2", 2, two), 0);
    assert_true(fw_compare_results(path("d0.h5"), path("d2.h5"), 8, 360, 1));
    assert_true(fw_compare_json(path("d0.out"), path("d2.out")));
}

static void test_bad_file_is_told_once(void **state)
{
    const char *const line[] = {FLOEWEAR,    "run",   path("small.yaml"), "-o",
                                path("bad"), "--set", "ice.density=9 m",  NULL};
    char             *text;

    (void)state;
    assert_int_equal(fw_job_run(folder, "bad", 3, line), 2);
    text = fw_job_read(path("bad.err"), NULL);
    assert_non_null(text);
    assert_non_null(strstr(text, "density"));
    assert_null(strstr(strstr(text, "density") + 1, "floewear run:")); /* by rank 0, not by every rank */
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits_on_any_number_of_ranks),
        cmocka_unit_test(test_same_bits_in_parts),
        cmocka_unit_test(test_same_bits_with_every_further_effect),
        cmocka_unit_test(test_bad_file_is_told_once),
    };

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
