/* Rank 0: gives out ids, gathers records, decides when it is enough, and computes too.
 *
 * Everything that has to happen while rank 0 is inside a long realisation (messages, group commit, live line, signals,
 * the budget) happens in master_attend, which the realisation's tick calls every few milliseconds. */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "campaign/leases.h"
#include "campaign/protocol.h"
#include "campaign/signals.h"
#include "floewear/campaign.h"

enum { MASTER_RECEIVES = 32 }; /* records that may be on their way to rank 0 at once */

typedef struct master {
    const fw_run      *run;
    const fw_campaign *campaign;
    int                n_ranks, n_away; /* n_away: workers that have left */
    bool              *is_ready;        /* (n_ranks) the worker may be given leases */
    fw_leases          leases;
    fw_record          record;   /* the one that has just arrived */
    unsigned char     *bytes;    /* (MASTER_RECEIVES, n_bytes) packed records on their way */
    size_t             n_bytes;
    MPI_Request        receives[MASTER_RECEIVES];

    bool      is_over, is_enough, is_sink_broken, is_unflushed;
    bool      is_prefix_fixed; /* a decision named the prefix that the answer is made from */
    uint64_t  prefix;
    fw_status status; /* of the campaign, once is_over */
    fw_msg    why;

    uint64_t n_fresh;  /* records made by this call */
    double   started, flushed, shown;
    double   served_s; /* processor time spent on messages and looks (wall time would count others' use of the core) */
} master;

/* In hand beyond the one it computes, a worker holds enough short realisations to bridge the longest time that rank
 * 0 is away (a tick, a commit, a look): 0.05 s, at least one and at most seven. */
static const double master_bridge = 0.05; /* [s] */
/* Beyond this share of its time spent on the others, rank 0 of a large job stops computing itself. */
static const double master_busy_share = 0.25;
enum { MASTER_SMALL_JOB = 8 };
/* A commit once a second is promised; records that arrive just after one must not wait longer. */
static const double master_commit_s = 0.8, master_show_s = 0.2; /* [s] */

static void master_end(master *a, fw_status s)
{
    if (a->is_over) return; /* the first reason counts */
    a->is_over = true;
    a->status  = s;
}

static void master_break(master *a, fw_status s)
{
    a->is_sink_broken = true;
    master_end(a, s);
}

static void master_flush(master *a)
{
    fw_msg    m = {.text = ""};
    fw_status s = FW_OK;

    a->flushed = fw_seconds();
    if (!a->is_unflushed || a->is_sink_broken) return;
    a->is_unflushed = false;
    if (a->run->sink.flush) s = a->run->sink.flush(a->run->sink.self, &m);
    if (s != FW_OK) {
        if (!a->is_over) a->why = m;
        /* Losing records at the very end is an error even when all seemed well before. */
        if (a->is_over && (a->status == FW_OK || a->status == FW_E_STOPPED)) {
            a->status = s;
            a->why    = m;
        }
        master_break(a, s);
    }
}

/* How many leases a worker should hold now. */
static size_t master_depth(const master *a)
{
    double elapsed = fw_seconds() - a->started;
    double cost    = a->n_fresh ? elapsed * a->n_ranks / (double)a->n_fresh : INFINITY; /* [s] per realisation */
    double extra   = fmax(1.0, ceil(master_bridge / fmax(cost, 1e-6)));

    return 1 + (size_t)fmin(extra, FW_MAX_HELD - 1);
}

static void master_give(master *a, int rank)
{
    const fw_held *held  = &a->leases.held[rank];
    size_t         depth = master_depth(a);
    uint64_t       id;

    if (!a->is_ready[rank] || a->is_over) return;
    while (held->n < depth) {
        /* Towards the end nobody takes a second one that another rank could start at once. */
        if (held->n && fw_leases_n_open(&a->leases) <= (uint64_t)a->n_ranks) return;
        if (!fw_leases_take(&a->leases, rank, &id)) return;
        MPI_Send(&id, 1, MPI_UINT64_T, rank, FW_TAG_LEASE, MPI_COMM_WORLD);
    }
}

static void master_explain_failures(master *a, uint64_t n)
{
    const fw_leases *l    = &a->leases;
    size_t           used = 0;
    char             list[800];

    list[0] = '\0';
    for (size_t i = 0; i < l->n_causes && used < sizeof list - 1; i++) {
        int k = snprintf(list + used, sizeof list - used, "; id %llu (seed %llu): %s",
                         (unsigned long long)l->causes[i].id, (unsigned long long)a->campaign->seed,
                         l->causes[i].cause);

        used += k > 0 ? (size_t)k : 0;
    }
    if (l->first > 0) {
        fw_fail(&a->why, FW_E_FAILURES, "more than %llu of realisations %llu to %llu failed%s", (unsigned long long)l->max_failed,
                (unsigned long long)l->first, (unsigned long long)(n - 1), list);
    } else {
        fw_fail(&a->why, FW_E_FAILURES, "more than %llu of the first %llu realisations failed%s",
                (unsigned long long)l->max_failed, (unsigned long long)n, list);
    }
}

static void master_judge(master *a)
{
    while (!a->is_over) {
        uint64_t   n       = 0;
        fw_verdict verdict = fw_leases_judge(&a->leases, &n);

        if (verdict == FW_VERDICT_GO_ON) return;
        if (verdict == FW_VERDICT_LOOK) {
            bool      is_enough = false;
            fw_status s         = a->run->stop.look(a->run->stop.self, n, &is_enough, &a->why);

            if (s != FW_OK) {
                master_end(a, s);
                return;
            }
            if (!is_enough) {
                fw_leases_looked(&a->leases);
                for (int r = 1; r < a->n_ranks; r++) master_give(a, r); /* the next look's ids are open now */
                continue;
            }
            a->is_enough = true;
        }
        a->is_prefix_fixed = true;
        a->prefix          = n;
        if (verdict == FW_VERDICT_FAILED) {
            master_explain_failures(a, n);
            master_end(a, FW_E_FAILURES);
        } else {
            master_end(a, FW_OK);
        }
    }
}

/* A finished record, from a worker or from rank 0 itself. */
static void master_keep(master *a, int rank, const fw_record *r)
{
    fw_msg    m = {.text = ""};
    fw_status s;

    if (a->is_sink_broken) return;
    s = a->run->sink.append(a->run->sink.self, r, &m);
    if (s != FW_OK) {
        if (!a->is_over) a->why = m;
        master_break(a, s);
        return;
    }
    a->is_unflushed = true;
    a->n_fresh++;
    s = fw_leases_done(&a->leases, rank, r->id, r->status == FW_OK ? NULL : r->cause, &m);
    if (s != FW_OK) {
        if (!a->is_over) a->why = m;
        master_end(a, s);
    }
}

/* Nobody waits in a receive: a record larger than MPI's eager limit moves only while its sender calls MPI as well, and that one
 * may be deep in a realisation. */
static void master_take_record(master *a, int slot, const MPI_Status *status)
{
    int       rank = status->MPI_SOURCE;
    int       n    = 0;
    fw_msg    m    = {.text = ""};
    fw_status s;

    MPI_Get_count(status, MPI_BYTE, &n);
    s = fw_record_unpack(&a->record, a->bytes + (size_t)slot * a->n_bytes, (size_t)n, &m);
    if (s != FW_OK) {
        if (!a->is_over) fw_fail(&a->why, FW_E_INTERNAL, "rank %d sent a record that cannot be read: %s", rank, m.text);
        master_end(a, FW_E_INTERNAL);
        return;
    }
    master_keep(a, rank, &a->record);
    master_give(a, rank); /* before a look, which may take a while */
    master_judge(a);
}

static void master_take_word(master *a, int rank, int tag)
{
    fw_word word;

    MPI_Recv(&word, (int)sizeof word, MPI_BYTE, rank, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    word.text[sizeof word.text - 1] = word.host[sizeof word.host - 1] = '\0';
    if (word.status == FW_OK) {
        a->is_ready[rank] = true;
        master_give(a, rank);
        return;
    }
    a->is_ready[rank] = false;
    if (!a->is_over) fw_fail(&a->why, (fw_status)word.status, "rank %d on %s: %s", rank, word.host, word.text);
    master_end(a, (fw_status)word.status);
}

static bool master_is_receiving(const master *a)
{
    for (int i = 0; i < MASTER_RECEIVES; i++)
        if (a->receives[i] != MPI_REQUEST_NULL) return true;
    return false;
}

/* Answer everything that has arrived; never waits. */
static bool master_listen(master *a)
{
    bool   heard = false;
    double start;

    if (a->n_ranks == 1) return false;
    start = fw_cpu_seconds();
    for (;;) {
        MPI_Status status;
        int        is_waiting = 0, slot = 0;

        MPI_Testany(MASTER_RECEIVES, a->receives, &slot, &is_waiting, &status);
        if (is_waiting && slot != MPI_UNDEFINED) {
            heard = true;
            master_take_record(a, slot, &status);
            continue;
        }
        slot = 0;
        while (slot < MASTER_RECEIVES && a->receives[slot] != MPI_REQUEST_NULL) slot++;
        if (slot == MASTER_RECEIVES) break;
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_waiting, &status);
        if (!is_waiting) break;
        if (status.MPI_TAG == FW_TAG_RECORD) {
            MPI_Irecv(a->bytes + (size_t)slot * a->n_bytes, (int)a->n_bytes, MPI_BYTE, status.MPI_SOURCE, FW_TAG_RECORD,
                      MPI_COMM_WORLD, &a->receives[slot]);
            continue;
        }
        heard = true;
        switch (status.MPI_TAG) {
        case FW_TAG_LEFT:
            MPI_Recv(NULL, 0, MPI_BYTE, status.MPI_SOURCE, FW_TAG_LEFT, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            a->n_away++;
            break;
        default: master_take_word(a, status.MPI_SOURCE, status.MPI_TAG); break;
        }
    }
    if (heard) a->served_s += fw_cpu_seconds() - start;
    return heard;
}

static void master_show(master *a)
{
    fw_progress p = {.done      = a->leases.n_done,
                     .failed    = a->leases.n_failed,
                     .prefix    = fw_leases_prefix(&a->leases) - a->leases.first,
                     .total     = a->leases.max - a->leases.first,
                     .elapsed_s = fw_seconds() - a->started,
                     .ranks     = a->n_ranks};

    p.rate_per_s = p.elapsed_s > 0.0 ? (double)a->n_fresh / p.elapsed_s : 0.0;
    p.eta_s      = p.rate_per_s > 0.0 ? (double)(p.total - p.done) / p.rate_per_s : INFINITY;
    a->run->watcher.show(a->run->watcher.self, &p);
    a->shown = fw_seconds(); /* what the watcher itself took does not count */
}

/* Messages, commit, live line, signals, budget. Called between realisations and from inside them. */
static bool master_attend(master *a)
{
    bool   heard  = master_listen(a);
    double now    = fw_seconds();
    double budget = a->campaign->precision.budget_s;

    if (now - a->flushed > master_commit_s) master_flush(a);
    if (a->run->watcher.show && now - a->shown >= master_show_s) master_show(a);
    if (a->is_over) return heard;
    if (fw_signals_received()) {
        fw_fail(&a->why, FW_E_STOPPED, "stopped by signal %d", fw_signals_received());
        master_end(a, FW_E_STOPPED);
    } else if (budget > 0.0 && now - a->started > budget) {
        fw_fail(&a->why, FW_E_STOPPED, "the time budget of %.4g s is used up", budget);
        master_end(a, FW_E_STOPPED);
    }
    return heard;
}

static fw_status master_tick(void *self, double done)
{
    master *a = self;

    (void)done;
    master_attend(a);
    return a->is_over ? FW_E_STOPPED : FW_OK;
}

static bool master_has_time(const master *a)
{
    double elapsed = fw_seconds() - a->started;

    return a->n_ranks <= MASTER_SMALL_JOB || a->served_s < master_busy_share * elapsed;
}

static void master_compute(master *a, uint64_t id)
{
    fw_tick     tick = {.call = master_tick, .self = a};
    fw_scenario scenario;
    fw_record   record;
    fw_msg      m = {.text = ""};
    fw_status   s;

    fw_campaign_scenario(a->campaign, id, &scenario);
    s = fw_realise(&a->campaign->model, &scenario, &tick, &record, &m);
    if (s == FW_OK) {
        master_keep(a, 0, &record);
        fw_record_free(&record);
        master_judge(a);
    } else if (!a->is_over) {
        fw_fail(&a->why, s, "realisation %llu: %s", (unsigned long long)id, m.text);
        master_end(a, s);
    }
}

static void master_loop(master *a)
{
    fw_nap nap = {0};

    master_judge(a); /* the journal may hold the answer already */
    while (!a->is_over) {
        uint64_t id;
        bool     heard = master_attend(a);

        if (a->is_over) break;
        if (master_has_time(a) && fw_leases_take(&a->leases, 0, &id)) {
            nap = (fw_nap){0};
            master_compute(a, id);
        } else if (heard) {
            nap = (fw_nap){0};
        } else {
            fw_nap_take(&nap);
        }
    }
}

/* Send the workers home; records that are on their way are still kept. */
static void master_close(master *a)
{
    fw_nap nap = {0};

    for (int r = 1; r < a->n_ranks; r++) MPI_Send(NULL, 0, MPI_BYTE, r, FW_TAG_STOP, MPI_COMM_WORLD);
    master_flush(a); /* first of all: mpirun follows its SIGTERM with a SIGKILL one second later */
    while (a->n_away < a->n_ranks - 1 || master_is_receiving(a)) {
        if (!master_listen(a)) fw_nap_take(&nap);
    }
    master_flush(a);
    if (a->run->watcher.show) master_show(a);
}

static uint64_t master_end_id(const fw_run *run) { return run->end_id ? run->end_id : run->campaign->precision.max_realisations; }

static bool master_is_part(const fw_run *run) { return run->first_id > 0 || run->end_id > 0; }

static fw_status master_open(master *a, const fw_run *run, fw_msg *m)
{
    const fw_campaign *c = run->campaign;

    a->run      = run;
    a->campaign = c;
    a->n_ranks  = fw_protocol_ranks();
    for (int i = 0; i < MASTER_RECEIVES; i++) a->receives[i] = MPI_REQUEST_NULL;
    a->n_bytes  = fw_record_packed_size(c->model.n_arcs, c->model.n_laws);
    FW_TRY(fw_leases_create(&a->leases, a->n_ranks, run->first_id, master_end_id(run), c->precision.max_failed,
                            run->stop.look != NULL && !master_is_part(run), run->n_have, run->have, run->n_have_failed, run->have_failed, m));
    FW_TRY(fw_alloc(&a->is_ready, (size_t)a->n_ranks, sizeof *a->is_ready, "states of ranks", m));
    FW_TRY(fw_alloc(&a->bytes, a->n_bytes, MASTER_RECEIVES, "packed records", m));
    return fw_record_init(&a->record, c->model.n_arcs, c->model.n_laws, m);
}

static void master_free(master *a)
{
    fw_leases_destroy(&a->leases);
    fw_record_free(&a->record);
    free(a->is_ready);
    free(a->bytes);
}

/* One realisation, alone and whatever the journal holds. */
static fw_status master_run_one(const fw_run *run, fw_run_result *result, fw_msg *m)
{
    fw_tick     tick = {.call = fw_signals_tick};
    fw_scenario scenario;
    fw_record   record;
    fw_status   s;

    fw_campaign_cancel();
    fw_campaign_scenario(run->campaign, (uint64_t)run->only_id, &scenario);
    s = fw_realise(&run->campaign->model, &scenario, &tick, &record, m);
    if (s == FW_E_STOPPED) return fw_fail(m, s, "stopped by signal %d", fw_signals_received());
    if (s != FW_OK) return s;
    result->n_done   = 1;
    result->n_failed = record.status != FW_OK;
    s                = run->sink.append(run->sink.self, &record, m);
    fw_record_free(&record);
    return s;
}

fw_status fw_campaign_run(const fw_run *run, fw_run_result *result, fw_msg *m)
{
    master    a = {.status = FW_OK};
    fw_status s;

    FW_CHECK(run && result && run->campaign && run->sink.append, m, FW_E_ARG,
             "a campaign needs its settings, a result and a sink");
    FW_CHECK(fw_protocol_rank() == 0, m, FW_E_ARG, "only rank 0 runs a campaign");
    *result = (fw_run_result){0};
    FW_CHECK(run->first_id < master_end_id(run) || run->first_id == 0, m, FW_E_ARG, "a part from realisation %llu to before %llu has none",
             (unsigned long long)run->first_id, (unsigned long long)master_end_id(run));
    if (run->only_id >= 0) return master_run_one(run, result, m);

    s = master_open(&a, run, m);
    if (s != FW_OK) {
        fw_campaign_cancel();
        master_free(&a);
        return s;
    }
    a.started = a.flushed = fw_seconds();
    a.shown               = a.started - master_show_s;
    fw_protocol_begin(run->campaign->hash, true);
    master_loop(&a);
    master_close(&a);

    s = a.status;
    result->n_prefix  = (a.is_prefix_fixed ? a.prefix : fw_leases_prefix(&a.leases)) - run->first_id;
    result->n_done    = a.leases.n_done;
    result->n_failed  = a.leases.n_failed;
    result->is_enough = a.is_enough;
    if (s != FW_OK) fw_fail(m, s, "%s", a.why.text);
    master_free(&a);
    return s;
}
