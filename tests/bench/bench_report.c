/* A million records on rings of 360 arcs: NAME.h5 written from a source of records, opened (its seal covers every byte), streamed, and
 * reported on by the program. Wanted of the report: below 60 s and 4 GiB. Each row is a child process, so that its peak memory is its own.
 *
 * The records are made up: the default campaign's scenarios, windows of widely scattered size with a shape round the ring, two thirds of the
 * arcs worn. The current comes from everywhere, so that every point is reached by all 360 arcs of every record: the most that an answer can be
 * asked for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/random.h"
#include "bench/bench.h"
#include "cli/config.h"
#include "store/results.h"

enum { N_ARCS = 360, WORN = 240 };

typedef struct sample {
    fw_campaign campaign;
    uint64_t    n;
    char        path[4200];
    double      shape[N_ARCS];
} sample;

static fw_status make_record(void *self, uint64_t index, fw_record *r, fw_msg *m)
{
    const sample *s = self;
    fw_random     random;
    fw_scenario   scenario;
    (void)m;
    fw_random_stream(&random, 1, FW_STREAM_TEST, index, 0);
    fw_campaign_scenario(&s->campaign, index, &scenario);
    double   size = exp(1.2 * (fw_random_uniform(&random) + fw_random_uniform(&random) + fw_random_uniform(&random) - 1.5) * 2);
    uint64_t bits = (uint64_t)(fw_random_uniform(&random) * 0x1p52);
    double  *path = r->rings, *load = path + N_ARCS, *impact = load + N_ARCS, *high = impact + N_ARCS;
    r->id = index;
    r->status = FW_OK;
    r->weight = scenario.weight;
    r->randomisation = (double)scenario.randomisation;
    r->speed = scenario.speed;
    r->concentration = r->concentration_achieved = scenario.concentration;
    r->mix = (double)scenario.mix;
    r->cell = (double)scenario.cell;
    r->window = s->campaign.model.window;
    r->wear_thickness = 0.5 + 0.1 * (double)(index % 7);
    r->force_evaluations = 1e6;
    r->host_cpu_s = 0.5;
    for (size_t k = 0; k < N_ARCS; k++) {
        bits = bits * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        double u = (double)(bits >> 11) * 0x1p-53;
        load[k] = size * s->shape[k] * (0.5 + u);
        path[k] = 0.01 * load[k] * (1.5 - u);
        impact[k] = 0.3 * load[k] * u;
        high[k] = 0.01 * load[k] * u * u;
    }
    return FW_OK;
}

static fw_status write_file(const sample *s, fw_msg *m)
{
    fw_record_source source = {.n = s->n, .read = make_record, .self = (void *)(uintptr_t)s};
    return fw_results_write(s->path, &s->campaign, &source, 0, NULL, m);
}

static fw_status open_file(const sample *s, fw_msg *m)
{
    fw_results *r;
    FW_TRY(fw_results_open(&r, s->path, m));
    fw_results_close(r);
    return FW_OK;
}

/* Every number of every ring once, as an answer takes them. */
static fw_status sum_records(const fw_record_source *source, fw_record *r, double *sum, fw_msg *m)
{
    const fw_record *lent;
    size_t           n;
    for (uint64_t at = 0; at < source->n; at += n) {
        FW_TRY(fw_records_lend(source, at, r, &lent, &n, m));
        for (size_t i = 0; i < n; i++) {
            for (size_t k = 0; k < fw_record_n_rings(N_ARCS, 1); k++) *sum += lent[i].rings[k];
        }
    }
    return FW_OK;
}

static fw_status stream_file(const sample *s, bool is_lent, fw_msg *m)
{
    fw_results *r;
    fw_record   record;
    double      sum = 0;
    FW_TRY(fw_record_init(&record, N_ARCS, 1, m));
    fw_status status = fw_results_open(&r, s->path, m);
    if (status == FW_OK) {
        fw_record_source source = fw_results_records(r);
        if (!is_lent) source.lend = NULL;
        status = sum_records(&source, &record, &sum, m);
        fw_results_close(r);
    }
    bench_expect(status != FW_OK || sum > 0, "a million records without any wear");
    fw_record_free(&record);
    return status;
}

static fw_status stream_lent(const sample *s, fw_msg *m) { return stream_file(s, true, m); }

static fw_status stream_read(const sample *s, fw_msg *m) { return stream_file(s, false, m); }

static void print_row(const char *what, double took, const bench_end_of_child *end, double most_mib)
{
    printf("| %s | %.1f | %.1f | %.0f |\n", what, took, end->cpu_s, end->peak_mib);
    bench_expect(end->exit_code == 0 && end->peak_mib > 0 && end->peak_mib < most_mib, "%s: exit %d, peak memory %.0f MiB, wanted below %.0f", what,
                 end->exit_code, end->peak_mib, most_mib);
}

static void in_child(const char *what, const sample *s, fw_status (*call)(const sample *s, fw_msg *m))
{
    double start = bench_wall_now();
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) {
        fw_msg    m = {.text = ""};
        fw_status status = call(s, &m);
        bench_expect(status == FW_OK, "%s: %s", what, m.text);
        _exit(bench_end());
    }
    bench_end_of_child end = bench_wait(pid);
    print_row(what, bench_wall_now() - start, &end, 500);
}

static void report(const sample *s)
{
    double start = bench_wall_now();
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) {
        if (!freopen("/dev/null", "w", stdout)) _exit(4);
        execl(FLOEWEAR, "floewear", "report", s->path, (char *)NULL);
        _exit(5);
    }
    bench_end_of_child end = bench_wait(pid);
    print_row("floewear report (wanted: below 60 s and 4096 MiB)", bench_wall_now() - start, &end, 4096);
}

int main(int argc, char **argv)
{
    bool        is_quick = bench_start(argc, argv);
    sample      s = {.n = is_quick ? 2000 : 1000000};
    char        folder[4096];
    struct stat file;
    fw_msg      m = {.text = ""};

    static const char *const sets[] = {"current.direction={uniform: [0 deg, 360 deg]}"};
    if (fw_config_campaign(&s.campaign, FW_SOURCE_DIR "/campaigns/raahe.yaml", 1, sets, -1, &m) != FW_OK) {
        fprintf(stderr, "bench: %s\n", m.text);
        return 1;
    }
    for (size_t k = 0; k < N_ARCS; k++) {
        double theta = ((double)k + 0.5) * 2 * 3.14159265358979 / N_ARCS;
        s.shape[k] = k < WORN / 2 || k >= N_ARCS - WORN / 2 ? 0.1 + pow(cos(0.75 * (theta > 3.15 ? theta - 6.28318530717959 : theta)), 2) : 0;
    }
    bench_make_folder(folder, sizeof folder);
    snprintf(s.path, sizeof s.path, "%s/records.h5", folder);
    struct statvfs room;
    double         wanted = (double)s.n * N_ARCS * 4 * 8 * 1.2;
    bool           fits = statvfs(folder, &room) == 0 && (double)room.f_bavail * (double)room.f_frsize > wanted;
    bench_expect(fits, "%s has no room for %.1f GB", folder, wanted / 1e9);
    printf("### %g records of %d arcs\n\n", (double)s.n, N_ARCS);
    printf("The current comes from everywhere: each of the points takes all arcs of every record. Read from the page cache where that holds the file.\n\n");
    printf("| step | wall s | CPU s | peak MiB |\n|---|---|---|---|\n");
    if (fits) {
        in_child("NAME.h5 written, records made up on the way", &s, write_file);
        in_child("opened: seal checked, ids read", &s, open_file);
        in_child("opened and streamed, records lent", &s, stream_lent);
        in_child("opened and streamed, records read one by one", &s, stream_read);
        report(&s);
    }
    if (fits && stat(s.path, &file) == 0) printf("\nThe file: %.2f GB.\n", (double)file.st_size / 1e9);
    bench_remove_folder(folder);
    fw_campaign_free(&s.campaign);
    printf("\n");
    return bench_end();
}
