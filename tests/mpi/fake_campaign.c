/* A whole campaign over the stand-in simulation, for mpirun: fake_campaign N OUT [enough_at [max_failed [budget_s]]]
 *
 * Rank 0 writes the records, sorted by id, to OUT and one line of facts to stdout, and leaves with the campaign's exit
 * code. Every rank says `ready` on stderr. FAKE_OTHER_RANK=r makes rank r read another campaign;
 * FAKE_NO_CAMPAIGN_RANK=r makes it read none. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "campaign/fake_realisation.h"
#include "campaign/memory_sink.h"

static fw_status look(void *self, uint64_t n, bool *is_enough, fw_msg *m)
{
    const uint64_t *at = self;

    (void)m;
    *is_enough = n >= *at;
    return FW_OK;
}

static double seconds(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool is_rank(const char *variable, int rank)
{
    const char *s = getenv(variable);

    return s && atoi(s) == rank;
}

static int lead(const fw_campaign *c, const char *path, uint64_t enough_at)
{
    fw_memory_sink sink;
    fw_run_result  result;
    fw_msg         m     = {.text = ""};
    fw_run         run   = {.campaign = c, .only_id = -1};
    double         start = seconds(CLOCK_MONOTONIC);
    fw_status      s;
    FILE          *f;

    fw_memory_sink_create(&sink, c);
    run.sink = fw_memory_sink_of(&sink);
    if (enough_at) run.stop = (fw_stop_rule){.look = look, .self = &enough_at};
    s = fw_campaign_run(&run, &result, &m);
    printf("status=%s prefix=%llu done=%llu failed=%llu enough=%d mine=%lld elapsed=%.3f\n", fw_status_name(s),
           (unsigned long long)result.n_prefix, (unsigned long long)result.n_done, (unsigned long long)result.n_failed,
           result.is_enough, (long long)fw_fake_settings.n_calls, seconds(CLOCK_MONOTONIC) - start);
    if (s != FW_OK) fprintf(stderr, "%s\n", m.text);
    fw_memory_sink_sort(&sink);
    f = fopen(path, "wb");
    if (!f || (sink.n && fwrite(sink.bytes, sink.n_bytes, sink.n, f) != sink.n) || fclose(f)) s = FW_E_IO;
    fw_memory_sink_destroy(&sink);
    return fw_status_exit_code(s);
}

int main(int argc, char **argv)
{
    fw_campaign c;
    fw_msg      m  = {.text = ""};
    int         rc = 0, rank, n_ranks;

    if (argc < 3) return 2;
    fw_fake_from_environment();
    if (fw_ranks_start(&argc, &argv, &rank, &n_ranks, &m) != FW_OK) return 5;
    fprintf(stderr, "ready\n"); /* signals are caught from here on */
    if (fw_fake_campaign(&c, is_rank("FAKE_OTHER_RANK", rank) ? 43 : 42, strtoull(argv[1], NULL, 10), &m) != FW_OK) {
        fw_ranks_abort(5);
    }
    if (argc > 4) c.precision.max_failed = strtoull(argv[4], NULL, 10);
    if (argc > 5) c.precision.budget_s = strtod(argv[5], NULL);

    if (rank == 0) {
        rc = lead(&c, argv[2], argc > 3 ? strtoull(argv[3], NULL, 10) : 0);
    } else {
        double start = seconds(CLOCK_PROCESS_CPUTIME_ID);

        if (is_rank("FAKE_NO_CAMPAIGN_RANK", rank)) {
            fw_fail(&m, FW_E_INPUT, "campaign.yaml: no such file");
            fw_campaign_serve(NULL, &m);
        } else {
            fw_campaign_serve(&c, &m);
        }
        if (getenv("FAKE_REPORT_CPU")) {
            fprintf(stderr, "rank %d cpu=%.3f\n", rank, seconds(CLOCK_PROCESS_CPUTIME_ID) - start);
        }
    }
    fw_ranks_stop();
    fw_campaign_free(&c);
    return rc;
}
