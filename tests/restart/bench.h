/* A folder with a campaign file, and runs of the stand-in program in it. FAKE_FLOEWEAR is the program of
 * fake_floewear.c. */
#ifndef TESTS_RESTART_BENCH_H
#define TESTS_RESTART_BENCH_H

#include <stdbool.h>
#include <stdint.h>

#include "mpi/job.h"

enum { BENCH_REALISATIONS = 1200 };

extern char fw_bench_folder[256];

/* Makes the folder and campaign.yaml (1200 realisations on rings of 72 arcs, precision not asked) in it. */
int  fw_bench_set_up(void **state);
int  fw_bench_tear_down(void **state);

void fw_bench_cost(const char *ms); /* of one realisation; costs scatter by id between 0 and twice that */

/* `run campaign.yaml -o FOLDER/stem --json extra...`; extra ends with NULL. stdout and stderr go to FOLDER/stem.out,
 * .err. */
fw_job fw_bench_start(const char *stem, int n_ranks, const char *const *extra);
int    fw_bench_run(const char *stem, int n_ranks, const char *const *extra);
/* fw_bench_run without -o, every argument given */
int    fw_bench_call(const char *name, int n_ranks, const char *const *arguments);

const char *fw_bench_path(const char *stem, const char *ending); /* FOLDER/stem.ending; eight at a time */
bool        fw_bench_says(const char *stem, const char *ending, const char *part);
bool        fw_bench_exists(const char *stem, const char *ending);
bool        fw_bench_same_file(const char *stem_a, const char *stem_b, const char *ending);

/* Both runs printed the same JSON (what has cpu in its name aside). */
bool fw_bench_same_answer(const char *stem_a, const char *stem_b);
/* That, and both results files hold records 0 .. n-1 with the same bits (host_cpu_s aside). */
bool fw_bench_same_results(const char *stem_a, const char *stem_b, uint64_t n);
/* Records that the journal holds now. */
uint64_t fw_bench_journal_n(const char *stem);
/* Wait until it holds n; false after 20 s. */
bool     fw_bench_wait_for_records(const char *stem, uint64_t n);

#endif
