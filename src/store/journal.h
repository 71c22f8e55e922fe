/* The journal: append-only truth of a campaign, and what resume starts from.
 *
 * A header names the campaign (hash, settings, sizes); then one block per record: length, status, id, packed record,
 * CRC32C. The bytes are described in journal_format.h. Records arrive in any order; each id counts once. A failed one may be followed by a later try, which counts then.
 *
 *   append --> buffer --(100 records, or flush)--> one write + fdatasync --> on disk
 *
 * What a kill or a power cut can do, and what follows from it when the journal is opened again:
 *   - during creation: no journal, or a whole header (written under PATH.tmp, fsynced, renamed, folder fsynced);
 *   - during a commit: a torn tail of at most one commit; it is dropped and its records are computed again;
 *   - a bad block with good ones behind it is damage to what had been committed: FW_E_FORMAT names record and offset
 *     and nothing is written, because only a person can decide to give up what lies behind it.
 * A full disk during a commit is FW_E_IO; the file is cut back to its last whole record, the records that found no room
 * stay in memory, and a later flush tries again.
 *
 * One thread. Memory: 16 bytes per record for the index, at most 100 packed records of buffer. */
#ifndef FW_STORE_JOURNAL_H
#define FW_STORE_JOURNAL_H

#include "floewear/campaign.h"

typedef struct fw_journal fw_journal;

/* Open for going on: create it, or check the header against the campaign, index the ids and drop a torn tail. Of the
 * campaign it uses name, settings, hash, seed, n_arcs, n_laws and max_realisations (kept for `status`; may change from
 * call to call). is_fresh: start anew; the old file is renamed to PATH.old.
 * Errors: FW_E_MISMATCH names the differing settings; FW_E_FORMAT: damaged, or no journal; FW_E_IO: cannot be written,
 * or an exclusive lock says that another run is using it. On error *out is NULL and the file is as it was. */
fw_status fw_journal_open(fw_journal **out, const char *path, const fw_campaign *c, bool is_fresh, fw_msg *m);

/* Read-only, for status and for reports while a run goes on: what had been committed at this moment. No lock; a torn
 * tail is skipped. c may be NULL: no check whose journal it is. */
fw_status fw_journal_open_read(fw_journal **out, const char *path, const fw_campaign *c, fw_msg *m);

/* Copies r into the buffer; commits by itself after 100 records. A record that is already there is ignored when it has
 * the same bits (everything but the columns with host, cpu or wall in their names). One that failed is replaced by another result (the later
 * record counts from then on). Else FW_E_FORMAT: a record that is not a pure function of campaign and id is a fault to be seen. FW_E_ARG: other sizes than the campaign's. */
fw_status fw_journal_append(fw_journal *j, const fw_record *r, fw_msg *m);
fw_status fw_journal_flush(fw_journal *j, fw_msg *m);
fw_status fw_journal_close(fw_journal *j, fw_msg *m); /* flushes; NULL is fine; frees even on error */

const uint64_t *fw_journal_ids(const fw_journal *j, size_t *n); /* ascending, borrowed until the next append */
uint64_t        fw_journal_prefix(const fw_journal *j);         /* ids 0..prefix-1 are all there */
uint64_t        fw_journal_torn(const fw_journal *j);           /* bytes of torn tail that open dropped or skipped */

/* r must be initialised with the campaign's sizes. Appended, unflushed ones can be read too.
 * FW_E_ARG: no such id, or other sizes; FW_E_FORMAT: the block went bad since it was indexed. */
fw_status fw_journal_read(fw_journal *j, uint64_t id, fw_record *r, fw_msg *m);

/* Progress of a running or stopped campaign, seen from outside. */
typedef struct fw_journal_facts {
    char     name[64];
    uint64_t hash, seed;
    uint64_t max_realisations; /* of the latest call; 0: not known */
    uint64_t n_done;           /* records, failed ones included */
    uint64_t n_failed;
    uint64_t prefix;     /* ids 0..prefix-1 are all there */
    uint64_t first, end; /* the smallest id and one beyond the largest; both 0: none is there */
    uint64_t torn_bytes; /* at the end; a running writer may be in the middle of a commit */
    size_t   n_arcs, n_laws;
    double   host_cpu_s; /* sum over records */
    bool     is_running; /* somebody holds the lock */
} fw_journal_facts;
fw_status fw_journal_facts_of(const char *path, fw_journal_facts *out, fw_msg *m);

#endif
