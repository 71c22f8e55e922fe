/* Dense ice for hours: does a jam find a state of its own, are the books closed, do two accuracies agree? All cores; a quarter of an hour on
 * two. Label long. Prints Markdown; the committed dense.md is its output.
 *
 *   validate_dense [FILE]    to FILE as well; exit code 1 when a law does not hold */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"

enum { MAX_RUNS = 60 };

typedef struct runs {
    const char *name;
    double      concentration, length, accuracy;
    size_t      n;
} runs;
enum { SEVENTY, SEVENTY_FINE, SEVENTY_SHORT, EIGHTY, N_CASES };
static const runs CASE[N_CASES] = {{"70 %, 3 h", 0.7, 10800, 0.01, 60},
                                   {"70 %, 3 h, accuracy 0.1 %", 0.7, 10800, 0.001, 32},
                                   {"70 %, 1 h", 0.7, 3600, 0.01, 32},
                                   {"80 %, 3 h", 0.8, 10800, 0.01, 10}};

typedef struct result {
    fw_record r; /* without its rings */
    double    depth;
    char      cause[200];
} result;
static result (*found)[MAX_RUNS]; /* (N_CASES) shared by all processes */

static FILE *copy;
#define SAY(...) (printf(__VA_ARGS__), copy ? fprintf(copy, __VA_ARGS__) : 0)

/* Mean load over the arcs within 75 degrees [MPa^m km]. */
static double front(const fw_record *r)
{
    double sum = 0;
    size_t n = 0;
    for (size_t k = 0; k < r->n_arcs; k++) {
        double degrees = ((double)k + 0.5) * 360 / (double)r->n_arcs;
        if (degrees > 75 && degrees < 285) continue;
        sum += fw_record_load(r, 0, FW_RING_LOAD)[k], n++;
    }
    return sum / (double)n;
}

static void run(const runs *c, uint64_t id, result *to)
{
    fw_model    m;
    fw_scenario s = {.seed = 20260101, .id = id, .concentration = c->concentration, .speed = 2};
    fw_msg      msg = {""};
    fw_record   r;
    fw_model_defaults(&m);
    m.window = c->length, m.accuracy = c->accuracy;
    fw_status status = fw_realise(&m, &s, NULL, &r, &msg);
    if (status != FW_OK) {
        to->r.status = status;
        snprintf(to->cause, sizeof to->cause, "%.190s", msg.text);
        return;
    }
    snprintf(to->cause, sizeof to->cause, "%.190s", r.cause);
    to->depth = r.status == FW_OK ? front(&r) : 0;
    to->r = r;
    fw_record_free(&r);
}

/* The longest ones first, every process the next that nobody has. */
static void run_all(void)
{
    size_t *next = mmap(NULL, sizeof *next, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    long    cores = sysconf(_SC_NPROCESSORS_ONLN);
    for (long p = 0; p < cores; p++) {
        if (fork() != 0) continue;
        for (;;) {
            size_t k = __atomic_fetch_add(next, 1, __ATOMIC_RELAXED), c = N_CASES;
            while (c > 0 && k >= CASE[c - 1].n) k -= CASE[--c].n;
            if (c == 0) _exit(0);
            run(&CASE[c - 1], k, &found[c - 1][k]);
        }
    }
    while (wait(NULL) > 0) {}
}

typedef struct spread {
    double mean, error, largest;
} spread;

static spread of(const double *x, size_t n)
{
    spread s = {0, 0, 0};
    double square = 0;
    for (size_t i = 0; i < n; i++) s.mean += x[i] / (double)n, s.largest = fmax(s.largest, x[i]);
    for (size_t i = 0; i < n; i++) square += (x[i] - s.mean) * (x[i] - s.mean);
    s.error = sqrt(square / (double)(n * (n - 1)));
    return s;
}

static spread column(size_t c, size_t n, double (*value)(const result *))
{
    double x[MAX_RUNS];
    for (size_t i = 0; i < n; i++) x[i] = value(&found[c][i]);
    return of(x, n);
}
static double depth(const result *q) { return q->depth; }
static double reach(const result *q) { return q->r.reach; }
static double awake(const result *q) { return q->r.awake_floes; }
static double hits(const result *q) { return q->r.hits; }
static double late(const result *q) { return q->r.late_touches; }
static double cpu(const result *q) { return q->r.host_cpu_s; }
static double evaluations(const result *q) { return q->r.force_evaluations; }
static double balance(const result *q) { return q->r.energy_truncation; }
static double books(const result *q) { return fmax(q->r.energy_relative, fmax(q->r.momentum_relative, q->r.wear_conservation)); }
static double overlap(const result *q) { return q->r.overlap_time_share; }

static void tell(size_t c)
{
    const runs *k = &CASE[c];
    size_t      n_failed = 0;
    for (size_t i = 0; i < k->n; i++) {
        if (found[c][i].r.status == FW_OK) continue;
        n_failed++;
        SAY("\n%s, id %zu failed: %s\n\n", k->name, i, found[c][i].cause);
    }
    spread d = column(c, k->n, depth), h = column(c, k->n, hits), r = column(c, k->n, reach), a = column(c, k->n, awake);
    spread l = column(c, k->n, late), e = column(c, k->n, balance), b = column(c, k->n, books), o = column(c, k->n, overlap);
    SAY("| %s | %zu | %zu | %.3g +- %.1g %% | %.0f | %.0f, %.0f | %.0f, %.0f | %.2g | %.1e | %.0e | %.2g %% | %.2g | %.1f |\n", k->name, k->n, n_failed,
        d.mean, 100 * d.error / d.mean, h.mean, r.mean, r.largest, a.mean, a.largest, l.mean, e.largest, b.largest, 100 * o.mean,
        column(c, k->n, evaluations).mean, column(c, k->n, cpu).mean);
    bench_expect(n_failed == 0, "%s: no realisation fails", k->name);
    bench_expect(e.largest <= k->accuracy, "%s: energy balance within the accuracy", k->name);
    bench_expect(b.largest <= 1e-10, "%s: energy, momentum and wear are booked to 1e-10", k->name);
    bench_expect(l.mean < 1e-3 * h.mean, "%s: late touches are fewer than one in a thousand hits", k->name);
}

int main(int argc, char **argv)
{
    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
        fprintf(stderr, "usage: validate_dense [FILE]\n");
        return 2;
    }
    if (argc == 2 && !(copy = fopen(argv[1], "w"))) {
        perror(argv[1]);
        return 1;
    }
    found = mmap(NULL, N_CASES * sizeof *found, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (found == MAP_FAILED) {
        perror("mmap");
        return 1;
    }
    run_all();
    SAY("# Dense ice\n\nOutput of `build/tests/validation/validate_dense`, which `tests/run --long` runs. 2 m/s, five classes 0.5-1.3 m, accuracy 1 %% unless "
        "named. Reach: how far upstream ice is disturbed; awake: floes moving at once; each mean and largest over the windows.\n\n");
    SAY("| ice | windows | failed | wear load | hits | reach m | awake | late touches | energy balance, worst | books, worst | time with an overlap beyond "
        "a tenth | force evaluations | CPU s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < N_CASES; c++) tell(c);

    double change[MAX_RUNS];
    size_t n = CASE[SEVENTY_FINE].n;
    spread fine = column(SEVENTY_FINE, n, depth);
    for (size_t i = 0; i < n; i++) change[i] = (found[SEVENTY][i].depth - found[SEVENTY_FINE][i].depth) / fine.mean;
    spread s = of(change, n);
    SAY("\nSame %zu fields at 70 %%, accuracy 1 %% against 0.1 %%: mean wear load %+.2g +- %.1g %%.\n", n, 100 * s.mean, 100 * s.error);
    bench_expect(fabs(s.mean) <= 0.01 + 2 * s.error, "%s: two accuracies agree in the mean", "70 %");
    double early = column(SEVENTY_SHORT, CASE[SEVENTY_SHORT].n, reach).mean, later = column(SEVENTY, CASE[SEVENTY_SHORT].n, reach).mean;
    SAY("\nThe jam at 70 %% reaches %.0f m within the first hour and %.0f m within three: it finds a length of its own, and inflow is what the current brings.\n",
        early, later);
    bench_expect(later < 1.25 * early, "%s: a jam does not grow on and on", "70 %");
    if (copy && fclose(copy) != 0) {
        perror(argv[1]);
        return 1;
    }
    return bench_end();
}
