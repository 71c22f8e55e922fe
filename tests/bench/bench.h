/* What the benchmarks share: windows of the source paper's model, medians, children with their wall time and memory.
 *
 * Every benchmark prints Markdown rows on stdout (tests/bench/run gathers them in RESULTS.md) and has two sizes: the
 * full one for the record, and --quick, seconds long, which ctest runs (label bench) so that no benchmark rots. Both
 * check that their own rows are sane; how fast they are is never a test, because it depends on the machine's other users.
 *
 * CPU times are CLOCK_PROCESS_CPUTIME_ID. What is compared is run alternately in the same minute, and medians are kept. */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "floewear/realisation.h"

/* Reads the command line: --quick or nothing. Exits with usage on anything else. */
bool bench_start(int argc, char **argv);
/* A row that cannot be true: the sentence goes to stderr and bench_end gives 1. */
void bench_expect(bool is_sane, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
int  bench_end(void);

double bench_median(size_t n, const double *values); /* n >= 1, at most 256; values stay as they are */
double bench_mean(size_t n, const double *values);
double bench_standard_error(size_t n, const double *values); /* of the mean; NAN for n < 2 */

double bench_cpu_now(void);  /* of this process [s] */
double bench_wall_now(void); /* monotonic [s] */

/* One window of the paper's model (five classes 0.5-1.3 m, 7.4 m structure) with automatic warm-up. plain_step > 0: the
 * plain every-floe method. The caller frees the record; a realisation that fails fails bench_expect. */
fw_record bench_realise(double concentration, double speed, double window, double accuracy, double plain_step, uint64_t id);
/* Mean depth over the arcs within 75 degrees of the current, at -10 degC [mm]. */
double bench_depth(const fw_record *r);

/* Wait for a child: wall time is the caller's; peak memory of the largest process among it and what it waited for [MiB]. */
typedef struct bench_end_of_child {
    int    exit_code; /* 128 + signal when it was killed */
    double peak_mib;
    double cpu_s;     /* of it and of what it waited for */
} bench_end_of_child;
bench_end_of_child bench_wait(pid_t pid);

/* A new folder under TMPDIR, and its removal with the files in it. */
void bench_make_folder(char *path, size_t size);
void bench_remove_folder(const char *path);
/* Wall time of `floewear run CAMPAIGN -o FOLDER/NAME ...` (further arguments NULL-terminated, may be NULL) on n_ranks
 * (0: without mpirun), started anew: old results of that name are removed. Output goes to FOLDER/NAME.out and .err. */
double bench_run_program(const char *folder, const char *name, int n_ranks, const char *campaign, const char *const *more,
                         bench_end_of_child *end);

#endif
