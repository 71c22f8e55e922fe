/* The other ranks: compute what rank 0 leases, one at a time, with the next one in hand. */
#include <mpi.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "campaign/leases.h"
#include "campaign/protocol.h"
#include "campaign/signals.h"
#include "floewear/campaign.h"

typedef struct worker {
    const fw_campaign *campaign;
    fw_held            queue; /* leases not yet computed; the first is being computed */
    bool               is_stopped;
    size_t             n_bytes;
    /* One buffer per lease that rank 0 may have given: a send never waits for rank 0 to be between two ticks. */
    unsigned char     *bytes; /* (FW_MAX_HELD x n_bytes) owned */
    MPI_Request        sends[FW_MAX_HELD];
} worker;

/* Take in whatever has arrived; never waits. */
static bool worker_listen(worker *w)
{
    bool heard = false;

    for (;;) {
        MPI_Status status;
        int        is_waiting = 0;

        MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &is_waiting, &status);
        if (!is_waiting || status.MPI_TAG == FW_TAG_BYE) return heard; /* BYE is fw_ranks_stop's */
        heard = true;
        if (status.MPI_TAG == FW_TAG_LEASE && w->queue.n < FW_MAX_HELD) {
            MPI_Recv(&w->queue.ids[w->queue.n++], 1, MPI_UINT64_T, 0, FW_TAG_LEASE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        } else if (status.MPI_TAG == FW_TAG_STOP) {
            MPI_Recv(NULL, 0, MPI_BYTE, 0, FW_TAG_STOP, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            w->is_stopped = true;
        } else {
            return heard; /* a lease too many waits in the queue of MPI */
        }
    }
}

static fw_status worker_tick(void *self, double done)
{
    worker *w = self;

    (void)done;
    worker_listen(w);
    return w->is_stopped || fw_signals_received() ? FW_E_STOPPED : FW_OK;
}

static void worker_send(worker *w, const fw_record *r)
{
    int            slot    = 0;
    int            is_free = 0;
    fw_nap         nap     = {0};
    unsigned char *bytes;

    for (;;) {
        for (slot = 0; slot < FW_MAX_HELD; slot++) {
            MPI_Test(&w->sends[slot], &is_free, MPI_STATUS_IGNORE);
            if (is_free) break;
        }
        if (is_free) break;
        fw_nap_take(&nap);
    }
    bytes = w->bytes + (size_t)slot * w->n_bytes;
    fw_record_pack(r, bytes);
    MPI_Isend(bytes, (int)w->n_bytes, MPI_BYTE, 0, FW_TAG_RECORD, MPI_COMM_WORLD, &w->sends[slot]);
}

/* Compute the first lease and send its record. */
static fw_status worker_compute(worker *w, fw_msg *m)
{
    fw_tick     tick = {.call = worker_tick, .self = w};
    fw_scenario scenario;
    fw_record   record;
    uint64_t    id = w->queue.ids[0];
    fw_status   s;

    fw_campaign_scenario(w->campaign, id, &scenario);
    s = fw_realise(&w->campaign->model, &scenario, &tick, &record, m);
    if (s != FW_OK) {
        if (s != FW_E_STOPPED) fw_msg_prefix(m, "realisation %llu: ", (unsigned long long)id);
        return s;
    }
    worker_send(w, &record);
    fw_record_free(&record);
    w->queue.n--;
    memmove(w->queue.ids, w->queue.ids + 1, w->queue.n * sizeof *w->queue.ids);
    return FW_OK;
}

/* Rank 0 has to know why there will be no more records from here. */
static void worker_complain(fw_status s, const char *text)
{
    fw_word word;

    fw_word_fill(&word, 0, s, text);
    MPI_Send(&word, (int)sizeof word, MPI_BYTE, 0, FW_TAG_ERROR, MPI_COMM_WORLD);
}

static void worker_finish_sends(worker *w)
{
    fw_nap nap     = {0};
    int    is_done = 0;

    for (;;) {
        MPI_Testall(FW_MAX_HELD, w->sends, &is_done, MPI_STATUSES_IGNORE);
        if (is_done) return;
        fw_nap_take(&nap);
    }
}

/* Wait for BEGIN; false: there is no work. */
static bool worker_begin(fw_begin *begin)
{
    fw_nap     nap        = {0};
    int        is_waiting = 0;
    MPI_Status status;

    for (;;) {
        MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &is_waiting, &status);
        if (is_waiting) break;
        fw_nap_take(&nap);
    }
    if (status.MPI_TAG != FW_TAG_BEGIN) return false; /* BYE: rank 0 left without a word */
    MPI_Recv(begin, (int)sizeof *begin, MPI_BYTE, 0, FW_TAG_BEGIN, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return begin->is_work != 0;
}

static void worker_loop(worker *w, fw_msg *m)
{
    fw_nap nap          = {0};
    bool   is_complaint = false;

    while (!w->is_stopped) {
        bool      heard = worker_listen(w);
        fw_status s     = FW_OK;

        if (w->is_stopped) break;
        if (!is_complaint && fw_signals_received()) {
            s = FW_E_STOPPED;
        } else if (!is_complaint && w->queue.n) {
            nap = (fw_nap){0};
            s   = worker_compute(w, m);
        } else if (heard) {
            nap = (fw_nap){0};
        } else {
            fw_nap_take(&nap);
        }
        if (s != FW_OK && !w->is_stopped) {
            worker_complain(s, s == FW_E_STOPPED ? "a worker was asked to stop" : m ? m->text : "");
            is_complaint = true;
        }
    }
}

fw_status fw_campaign_serve(const fw_campaign *c, fw_msg *m)
{
    worker    w     = {.campaign = c};
    fw_msg    own   = {.text = ""};
    fw_begin  begin = {0};
    fw_word   word;
    fw_status s = FW_OK;

    FW_CHECK(fw_protocol_rank() > 0, m, FW_E_ARG, "rank 0 runs a campaign, it does not serve it");
    if (!worker_begin(&begin)) return fw_fail(m, FW_E_STOPPED, "rank 0 found nothing to do");

    for (int i = 0; i < FW_MAX_HELD; i++) w.sends[i] = MPI_REQUEST_NULL;
    if (!c) {
        /* The caller could not read the campaign; its sentence is in m. */
        s = fw_fail(&own, FW_E_INPUT, "%s", m ? m->text : "the campaign could not be read");
    } else if (c->hash != begin.hash) {
        s = fw_fail(&own, FW_E_MISMATCH, "this rank reads another campaign (hash %016llx) than rank 0 (hash %016llx): "
                    "the file must be the same on every machine", (unsigned long long)c->hash,
                    (unsigned long long)begin.hash);
    } else {
        w.n_bytes = fw_record_packed_size(c->model.n_arcs, c->model.n_laws);
        s = fw_alloc(&w.bytes, FW_MAX_HELD, w.n_bytes, "records to send", &own);
    }
    fw_word_fill(&word, c ? c->hash : 0, s, own.text);
    MPI_Send(&word, (int)sizeof word, MPI_BYTE, 0, FW_TAG_READY, MPI_COMM_WORLD);

    /* A rank that is not fit for work gets no lease; it waits for STOP like the others. */
    worker_loop(&w, &own);
    worker_finish_sends(&w);
    MPI_Send(NULL, 0, MPI_BYTE, 0, FW_TAG_LEFT, MPI_COMM_WORLD);
    free(w.bytes);
    return FW_OK;
}
