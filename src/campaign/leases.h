/* Which realisation is whose: the master's book-keeping, without MPI and without a clock.
 *
 *   id   0 1 2 3 4 5 6 7 8 9 ...
 *        d d d h d h h . . .        d done (in the sink)   h held by a rank   . never given out
 *              ^       ^ next
 *              prefix
 *
 * Ids are given out in ascending order and those in the journal are skipped, so every id below `next` is either done or
 * held: the complete prefix is the smallest id held, and no list of finished ids is ever needed.
 *
 * Decisions (a look, the failure limit, the end) are taken in the order of ids on complete prefixes, so they are a pure
 * function of the records: neither the order of arrival nor a restart can move them.
 *
 * A part of a campaign (first > 0, or an end below its own) is the same with its ids alone: it takes no looks, as its ids are no prefix.
 *
 * Going ahead of a pending look is bounded by the look after it: those ids are needed anyway unless this look ends the
 * campaign. */
#ifndef FW_CAMPAIGN_LEASES_H
#define FW_CAMPAIGN_LEASES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

enum { FW_MAX_HELD = 8, FW_MAX_CAUSES = 4 };

typedef struct fw_held {
    size_t   n;
    uint64_t ids[FW_MAX_HELD]; /* (n) ascending */
} fw_held;

typedef struct fw_failure {
    uint64_t id;
    char     cause[200];
} fw_failure;

typedef struct fw_leases {
    const uint64_t *have; /* (n_have) ascending, borrowed: in the journal already */
    size_t          n_have, have_at;
    uint64_t        first, max, max_failed; /* ids first .. max-1 are to be done */
    uint64_t        next;
    bool            has_looks;
    uint64_t        look; /* the next one to be taken; max + 1 after the last */
    int             n_ranks;
    fw_held        *held; /* (n_ranks), owned */
    uint64_t        n_done;
    uint64_t       *failed; /* (n_failed) ascending, owned */
    size_t          n_failed, failed_capacity;
    size_t          n_causes;
    fw_failure      causes[FW_MAX_CAUSES]; /* (n_causes) the failures of this call with the smallest ids */
} fw_leases;

/* have and have_failed ascending; ids below first and from max on in them are of no concern here. */
fw_status fw_leases_create(fw_leases *l, int n_ranks, uint64_t first, uint64_t max, uint64_t max_failed, bool has_looks,
                           size_t n_have, const uint64_t *have, size_t n_have_failed, const uint64_t *have_failed, fw_msg *m);
void      fw_leases_destroy(fw_leases *l);

/* Give rank the next id; false: none may be given out now (all are, or computing would run too far ahead of a look, or
 * the failure limit is certain to be reached). */
bool fw_leases_take(fw_leases *l, int rank, uint64_t *id);
/* Ids that may be given out now, at most. */
uint64_t fw_leases_n_open(const fw_leases *l);
/* The record of id, held by rank, is in the sink. cause NULL: it did not fail. FW_E_INTERNAL when rank does not hold
 * it. */
fw_status fw_leases_done(fw_leases *l, int rank, uint64_t id, const char *cause, fw_msg *m);
uint64_t  fw_leases_prefix(const fw_leases *l); /* ids first .. prefix-1 are complete */

typedef enum fw_verdict {
    FW_VERDICT_GO_ON,
    FW_VERDICT_LOOK,   /* ask the stop rule about *n, then call fw_leases_looked (or stop there) and ask again */
    FW_VERDICT_FAILED, /* more than max_failed failures among ids first .. *n-1 */
    FW_VERDICT_END     /* all ids below max are complete; *n = max */
} fw_verdict;
fw_verdict fw_leases_judge(const fw_leases *l, uint64_t *n);
void       fw_leases_looked(fw_leases *l); /* the pending look was taken and was not enough */

#endif
