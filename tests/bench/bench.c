#include "bench/bench.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "mpi/job.h"

static bool has_failed;

bool bench_start(int argc, char **argv)
{
    bool is_quick = argc == 2 && strcmp(argv[1], "--quick") == 0;
    if (argc > 1 && !is_quick) {
        fprintf(stderr, "usage: %s [--quick]\n", argv[0]);
        exit(2);
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    return is_quick;
}

void bench_expect(bool is_sane, const char *fmt, ...)
{
    if (is_sane) return;
    va_list args;
    va_start(args, fmt);
    fputs("not sane: ", stderr);
    vfprintf(stderr, fmt, args);
    fputc('\n', stderr);
    va_end(args);
    has_failed = true;
}

int bench_end(void) { return has_failed ? 1 : 0; }

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(size_t n, const double *values)
{
    double sorted[256];
    if (n == 0 || n > sizeof sorted / sizeof sorted[0]) return NAN;
    memcpy(sorted, values, n * sizeof *values);
    qsort(sorted, n, sizeof *sorted, ascending);
    return n % 2 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

double bench_mean(size_t n, const double *values)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += values[i];
    return sum / (double)n;
}

double bench_standard_error(size_t n, const double *values)
{
    if (n < 2) return NAN;
    double mean = bench_mean(n, values), sum = 0;
    for (size_t i = 0; i < n; i++) sum += (values[i] - mean) * (values[i] - mean);
    return sqrt(sum / (double)(n - 1) / (double)n);
}

static double now(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_cpu_now(void) { return now(CLOCK_PROCESS_CPUTIME_ID); }
double bench_wall_now(void) { return now(CLOCK_MONOTONIC); }

fw_record bench_realise(double concentration, double speed, double window, double accuracy, double plain_step, uint64_t id)
{
    fw_model m;
    fw_model_defaults(&m);
    m.window = window, m.accuracy = accuracy, m.numerics.step = plain_step;
    if (plain_step > 0) m.numerics.scheme = FW_SCHEME_EULER, m.numerics.wear_rule = FW_WEAR_NAIVE;
    fw_scenario s = {.seed = 20260101, .id = id, .concentration = concentration, .speed = speed};
    fw_record   r;
    fw_msg      msg = {""};
    if (fw_realise(&m, &s, NULL, &r, &msg) != FW_OK) {
        fprintf(stderr, "%s\n", msg.text);
        exit(1);
    }
    bench_expect(r.status == FW_OK, "realisation %u failed: %s", (unsigned)id, r.cause);
    bench_expect(r.host_cpu_s > 0, "realisation %u took no time", (unsigned)id);
    return r;
}

double bench_depth(const fw_record *r)
{
    fw_model m;
    fw_model_defaults(&m);
    double sum = 0;
    size_t n   = 0;
    for (size_t k = 0; k < r->n_arcs; k++) {
        double angle = 360 * ((double)k + 0.5) / (double)r->n_arcs;
        if (angle < 75 || angle > 285) sum += fw_record_load(r, 0, FW_RING_LOAD)[k], n++;
    }
    return sum / (double)n * fw_abrasion_rate(&m.laws[0], -10);
}

bench_end_of_child bench_wait(pid_t pid)
{
    struct rusage      used;
    bench_end_of_child end = {.exit_code = -1};
    int                status;
    if (wait4(pid, &status, 0, &used) != pid) return end;
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    end.peak_mib  = (double)used.ru_maxrss / 1024; /* Linux counts in KiB */
    end.cpu_s     = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    return end;
}

void bench_make_folder(char *path, size_t size) { fw_job_make_folder(path, size, "bench"); }
void bench_remove_folder(const char *path) { fw_job_remove_folder(path); }

double bench_run_program(const char *folder, const char *name, int n_ranks, const char *campaign, const char *const *more,
                         bench_end_of_child *end)
{
    char        out[4096];
    const char *line[32] = {FLOEWEAR, "run", campaign, "--fresh", "--quiet", "-o", out};
    int         n        = 7;
    snprintf(out, sizeof out, "%s/%s", folder, name);
    while (more && *more && n < 31) line[n++] = *more++;
    double start = bench_wall_now();
    fw_job j     = fw_job_start(folder, name, n_ranks, line);
    *end         = bench_wait(j.pid);
    double took  = bench_wall_now() - start;
    bench_expect(end->exit_code == 0, "floewear run ended with %d; its words are in %s", end->exit_code, j.err);
    if (end->exit_code != 0) {
        char *words = fw_job_read(j.err, NULL);
        fprintf(stderr, "%s\n", words ? words : "");
        free(words);
    }
    return took;
}
