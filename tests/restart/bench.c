#include "restart/bench.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "mpi/compare.h"
#include "store/journal.h"

char fw_bench_folder[256];

static const char bench_campaign[] = "name: restart\n"
                                     "structure: {diameter: 7.4 m, measuring_points: {count: 3, spacing: 30 deg}}\n"
                                     "ice:\n"
                                     "  temperature: {uniform: [-12 degC, -2 degC]}\n"
                                     "  concentration: {uniform: [20 %, 60 %]}\n"
                                     "current:\n"
                                     "  speed: {uniform: [0.5 m/s, 1.5 m/s]}\n"
                                     "  direction: {rose: {0 deg: 1, 90 deg: 2}}\n"
                                     "exposure: {window: 60 s}\n"
                                     "precision: {quantity: P90, half_width: 0 %, max_realisations: 1200}\n"
                                     "ring: {arcs: 72}\n"
                                     "seed: 20260101\n";

int fw_bench_set_up(void **state)
{
    FILE *f;

    (void)state;
    fw_job_make_folder(fw_bench_folder, sizeof fw_bench_folder, "restart");
    f = fopen(fw_bench_path("campaign", "yaml"), "w");
    if (!f || fputs(bench_campaign, f) < 0 || fclose(f) != 0) return -1;
    setenv("FAKE_SPREAD", "1", 1);
    /* After a non-zero exit mpirun waits twice this time before it ends; nothing of ours is left to be killed by
     * then. */
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "0", 1);
    return 0;
}

int fw_bench_tear_down(void **state)
{
    (void)state;
    fw_job_remove_folder(fw_bench_folder);
    return 0;
}

void fw_bench_cost(const char *ms)
{
    setenv("FAKE_COST_MS", ms, 1);
}

const char *fw_bench_path(const char *stem, const char *ending)
{
    static char     paths[8][512];
    static unsigned at;
    char           *path = paths[at++ % 8];

    snprintf(path, sizeof paths[0], "%s/%s%s%s", fw_bench_folder, stem, *ending ? "." : "", ending);
    return path;
}

fw_job fw_bench_start(const char *stem, int n_ranks, const char *const *extra)
{
    const char *line[32];
    int         n = 0;

    line[n++] = FAKE_FLOEWEAR;
    line[n++] = "run";
    line[n++] = fw_bench_path("campaign", "yaml");
    line[n++] = "-o";
    line[n++] = fw_bench_path(stem, "");
    line[n++] = "--json";
    while (*extra && n < 31) line[n++] = *extra++;
    line[n] = NULL;
    return fw_job_start(fw_bench_folder, stem, n_ranks, line);
}

int fw_bench_run(const char *stem, int n_ranks, const char *const *extra)
{
    fw_job j = fw_bench_start(stem, n_ranks, extra);

    return fw_job_wait(&j, 60.0);
}

int fw_bench_call(const char *name, int n_ranks, const char *const *arguments)
{
    const char *line[32];
    int         n = 0;

    line[n++] = FAKE_FLOEWEAR;
    line[n++] = "run";
    while (*arguments && n < 31) line[n++] = *arguments++;
    line[n] = NULL;
    return fw_job_run(fw_bench_folder, name, n_ranks, line);
}

bool fw_bench_says(const char *stem, const char *ending, const char *part)
{
    char *text = fw_job_read(fw_bench_path(stem, ending), NULL);
    bool  is   = text && strstr(text, part);

    if (!is) print_message("%s.%s lacks '%s':\n%s\n", stem, ending, part, text ? text : "(no such file)");
    free(text);
    return is;
}

bool fw_bench_exists(const char *stem, const char *ending)
{
    struct stat s;

    return stat(fw_bench_path(stem, ending), &s) == 0;
}

bool fw_bench_same_file(const char *stem_a, const char *stem_b, const char *ending)
{
    size_t n_a, n_b;
    char  *a  = fw_job_read(fw_bench_path(stem_a, ending), &n_a);
    char  *b  = fw_job_read(fw_bench_path(stem_b, ending), &n_b);
    bool   is = a && b && n_a == n_b && memcmp(a, b, n_a) == 0;

    free(a);
    free(b);
    return is;
}

bool fw_bench_same_answer(const char *stem_a, const char *stem_b)
{
    return fw_compare_json(fw_bench_path(stem_a, "out"), fw_bench_path(stem_b, "out"));
}

bool fw_bench_same_results(const char *stem_a, const char *stem_b, uint64_t n)
{
    return fw_compare_results(fw_bench_path(stem_a, "h5"), fw_bench_path(stem_b, "h5"), n, 72, 1) &&
           fw_bench_same_answer(stem_a, stem_b);
}

uint64_t fw_bench_journal_n(const char *stem)
{
    fw_journal_facts facts = {.n_done = 0};

    return fw_journal_facts_of(fw_bench_path(stem, "journal"), &facts, NULL) == FW_OK ? facts.n_done : 0;
}

bool fw_bench_wait_for_records(const char *stem, uint64_t n)
{
    double end = fw_job_seconds() + 20.0;

    while (fw_bench_journal_n(stem) < n) {
        if (fw_job_seconds() > end) return false;
        fw_job_sleep(0.02);
    }
    return true;
}
