#include "campaign/leases.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "campaign/looks.h"

/* Failures among ids first .. n-1. */
static uint64_t leases_failed_below(const fw_leases *l, uint64_t n)
{
    size_t low = 0, high = l->n_failed;

    while (low < high) {
        size_t middle = low + (high - low) / 2;

        if (l->failed[middle] < n) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Step next over what is done already. */
static void leases_skip(fw_leases *l)
{
    while (l->have_at < l->n_have && l->have[l->have_at] <= l->next) {
        if (l->have[l->have_at] == l->next) l->next++;
        l->have_at++;
    }
    if (l->next > l->max) l->next = l->max;
}

/* Ids from here on are not given out. */
static uint64_t leases_limit(const fw_leases *l)
{
    if (l->has_looks && l->look < l->max) return fw_looks_next(l->look, l->max);
    return l->max;
}

fw_status fw_leases_create(fw_leases *l, int n_ranks, uint64_t first, uint64_t max, uint64_t max_failed, bool has_looks,
                           size_t n_have, const uint64_t *have, size_t n_have_failed, const uint64_t *have_failed, fw_msg *m)
{
    fw_status s;

    *l = (fw_leases){.have       = have,
                     .n_have     = n_have,
                     .first      = first,
                     .next       = first,
                     .max        = max,
                     .max_failed = max_failed,
                     .has_looks  = has_looks,
                     .look       = fw_looks_first(max),
                     .n_ranks    = n_ranks};
    for (size_t i = 0; i < n_have && have[i] < max; i++) l->n_done += have[i] >= first;
    s = fw_alloc(&l->held, (size_t)n_ranks, sizeof *l->held, "leases of ranks", m);
    if (s == FW_OK) s = fw_grow(&l->failed, &l->failed_capacity, n_have_failed, sizeof *l->failed, "failed ids", m);
    if (s != FW_OK) {
        fw_leases_destroy(l);
        return s;
    }
    for (size_t i = 0; i < n_have_failed && have_failed[i] < max; i++) {
        if (have_failed[i] >= first) l->failed[l->n_failed++] = have_failed[i];
    }
    leases_skip(l);
    return FW_OK;
}

void fw_leases_destroy(fw_leases *l)
{
    if (!l) return;
    free(l->held);
    free(l->failed);
    memset(l, 0, sizeof *l);
}

uint64_t fw_leases_n_open(const fw_leases *l)
{
    uint64_t limit = leases_limit(l);

    /* Every id below next will be complete one day, so more failures than allowed below next end the campaign whatever
     * comes after (or an earlier look ends it): further work would be thrown away. */
    if (leases_failed_below(l, l->next) > l->max_failed) return 0;
    return l->next < limit ? limit - l->next : 0;
}

bool fw_leases_take(fw_leases *l, int rank, uint64_t *id)
{
    fw_held *h = &l->held[rank];

    if (h->n == FW_MAX_HELD || fw_leases_n_open(l) == 0) return false;
    *id            = l->next++;
    h->ids[h->n++] = *id;
    leases_skip(l);
    return true;
}

/* Keep the sentences of the few failures with the smallest ids, for the message of a failed campaign. */
static void leases_keep_cause(fw_leases *l, uint64_t id, const char *cause)
{
    size_t at = l->n_causes;

    while (at > 0 && l->causes[at - 1].id > id) at--;
    if (at == FW_MAX_CAUSES) return;
    if (l->n_causes < FW_MAX_CAUSES) l->n_causes++;
    memmove(&l->causes[at + 1], &l->causes[at], (l->n_causes - 1 - at) * sizeof *l->causes);
    l->causes[at].id = id;
    snprintf(l->causes[at].cause, sizeof l->causes[at].cause, "%s", cause);
}

fw_status fw_leases_done(fw_leases *l, int rank, uint64_t id, const char *cause, fw_msg *m)
{
    fw_held *h  = &l->held[rank];
    size_t   at = 0;

    while (at < h->n && h->ids[at] != id) at++;
    FW_CHECK(at < h->n, m, FW_E_INTERNAL, "rank %d sent realisation %llu, which it was not given", rank,
             (unsigned long long)id);
    if (cause) {
        size_t place = (size_t)leases_failed_below(l, id);

        FW_TRY(fw_grow(&l->failed, &l->failed_capacity, l->n_failed + 1, sizeof *l->failed, "failed ids", m));
        memmove(l->failed + place + 1, l->failed + place, (l->n_failed - place) * sizeof *l->failed);
        l->failed[place] = id;
        l->n_failed++;
        leases_keep_cause(l, id, cause);
    }
    memmove(h->ids + at, h->ids + at + 1, (h->n - at - 1) * sizeof *h->ids);
    h->n--;
    l->n_done++;
    return FW_OK;
}

uint64_t fw_leases_prefix(const fw_leases *l)
{
    uint64_t prefix = l->next;

    for (int r = 0; r < l->n_ranks; r++) {
        if (l->held[r].n && l->held[r].ids[0] < prefix) prefix = l->held[r].ids[0];
    }
    return prefix;
}

fw_verdict fw_leases_judge(const fw_leases *l, uint64_t *n)
{
    uint64_t prefix  = fw_leases_prefix(l);
    bool     is_look = l->has_looks && l->look <= prefix;
    uint64_t end     = is_look ? l->look : prefix;

    if (leases_failed_below(l, end) > l->max_failed) {
        *n = l->failed[l->max_failed] + 1;
        return FW_VERDICT_FAILED;
    }
    *n = end;
    if (is_look) return FW_VERDICT_LOOK;
    return prefix == l->max ? FW_VERDICT_END : FW_VERDICT_GO_ON;
}

void fw_leases_looked(fw_leases *l)
{
    l->look = l->look < l->max ? fw_looks_next(l->look, l->max) : l->max + 1;
}
