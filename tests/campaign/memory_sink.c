#include "campaign/memory_sink.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/memory.h"

static double seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static fw_status memory_append(void *self, const fw_record *r, fw_msg *m)
{
    fw_memory_sink *k = self;
    fw_record       copy = *r; /* shares rings; only packed */

    if (k->break_at >= 0 && k->n == (size_t)k->break_at) return fw_fail(m, FW_E_IO, "the disk is full on purpose");
    FW_TRY(fw_grow(&k->ids, &k->capacity, k->n + 1, sizeof *k->ids, "ids", m));
    FW_TRY(fw_grow(&k->bytes, &k->byte_capacity, (k->n + 1) * k->n_bytes, 1, "records", m));
    copy.host_cpu_s = 0.0;
    fw_record_pack(&copy, k->bytes + k->n * k->n_bytes);
    k->ids[k->n++] = r->id;
    if (k->waiting_since <= 0.0) k->waiting_since = seconds();
    return FW_OK;
}

static fw_status memory_flush(void *self, fw_msg *m)
{
    fw_memory_sink *k = self;

    (void)m;
    if (k->waiting_since > 0.0 && seconds() - k->waiting_since > k->longest_gap_s) {
        k->longest_gap_s = seconds() - k->waiting_since;
    }
    k->waiting_since = 0.0;
    k->n_flushes++;
    return FW_OK;
}

void fw_memory_sink_create(fw_memory_sink *k, const fw_campaign *c)
{
    *k = (fw_memory_sink){.n_bytes = fw_record_packed_size(c->model.n_arcs, c->model.n_laws), .break_at = -1};
}

void fw_memory_sink_destroy(fw_memory_sink *k)
{
    free(k->ids);
    free(k->bytes);
    memset(k, 0, sizeof *k);
}

fw_sink fw_memory_sink_of(fw_memory_sink *k)
{
    return (fw_sink){.append = memory_append, .flush = memory_flush, .self = k};
}

void fw_memory_sink_sort(fw_memory_sink *k)
{
    unsigned char *swap = malloc(k->n_bytes);

    for (size_t i = 1; swap && i < k->n; i++) { /* insertion: arrival is nearly in order */
        uint64_t id = k->ids[i];
        size_t   at = i;

        memcpy(swap, k->bytes + i * k->n_bytes, k->n_bytes);
        for (; at > 0 && k->ids[at - 1] > id; at--) {
            k->ids[at] = k->ids[at - 1];
            memcpy(k->bytes + at * k->n_bytes, k->bytes + (at - 1) * k->n_bytes, k->n_bytes);
        }
        k->ids[at] = id;
        memcpy(k->bytes + at * k->n_bytes, swap, k->n_bytes);
    }
    free(swap);
}

bool fw_memory_sink_equal(const fw_memory_sink *a, const fw_memory_sink *b, size_t n)
{
    return a->n >= n && b->n >= n && a->n_bytes == b->n_bytes && memcmp(a->ids, b->ids, n * sizeof *a->ids) == 0 &&
           memcmp(a->bytes, b->bytes, n * a->n_bytes) == 0;
}
