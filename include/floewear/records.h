/* floewear/records.h: where finished records are read from, in ascending order of id: a journal, a results file, a test's
 * own.
 *
 * A source holds n records; index 0 .. n-1 counts them, and the record says its id. A whole campaign's source has id = index; a part's (`run
 * --ids`, or merged parts with a gap) does not, and span says which ids they are.
 *
 * Two ways to read, of the same bits:
 *   read   one record by index, copied into the caller's
 *   lend   as many records as the source likes to show at once: what an answer over a million records streams. Optional; fw_records_lend shows one
 *          record at a time where it is NULL. */
#ifndef FLOEWEAR_RECORDS_H
#define FLOEWEAR_RECORDS_H

#include "floewear/record.h"

/* The records are n of the ids first .. end-1; zeros: ids 0 .. n-1. */
typedef struct fw_id_span {
    uint64_t first, end;
    uint64_t gap_first, gap_end; /* the first run of ids that is missing between them; equal: none is */
} fw_id_span;

typedef struct fw_record_source {
    uint64_t n;
    fw_status (*read)(void *self, uint64_t index, fw_record *r, fw_msg *m); /* r initialised with the campaign's sizes */
    /* Records from index on, *n of them, at least one; they and their rings are the source's and stay until it is next called. FW_E_ARG: no such
     * index. */
    fw_status (*lend)(void *self, uint64_t index, const fw_record **records, size_t *n, fw_msg *m);
    void      *self;
    fw_id_span span;
} fw_record_source;

/* source's lend, or one record read into r, which is initialised with the campaign's sizes and says them. FW_E_FORMAT: the
 * source has others.
 *
 *     for (uint64_t at = 0; at < source->n; at += n) {
 *         FW_TRY(fw_records_lend(source, at, &r, &records, &n, m));
 *         for (size_t i = 0; i < n; i++) ... records[i] ...
 *     } */
static inline fw_status fw_records_lend(const fw_record_source *source, uint64_t index, fw_record *r, const fw_record **records, size_t *n, fw_msg *m)
{
    *records = r;
    *n = 1;
    if (!source->lend) return source->read(source->self, index, r, m);
    FW_TRY(source->lend(source->self, index, records, n, m));
    const fw_record *first = *records;
    FW_CHECK(first->n_arcs == r->n_arcs && first->n_laws == r->n_laws, m, FW_E_FORMAT,
             "records of %zu laws and %zu arcs where the campaign asks for %zu and %zu", first->n_laws, first->n_arcs, r->n_laws, r->n_arcs);
    return FW_OK;
}

#endif
