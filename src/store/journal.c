#include "store/journal.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "store/file.h"
#include "store/journal_format.h"

enum { MAX_COMMIT = 100 }; /* records in one write: what a torn tail can cost */
enum { SCAN_BYTES = 4 * 1024 * 1024 };

struct fw_journal {
    int               fd;
    char             *path;
    bool              is_writer;
    fw_journal_header header;
    size_t            block_size;
    uint64_t          n_committed; /* blocks in the file */
    uint64_t          torn_bytes;

    /* The index: ids ascending, each with the number of its block; blocks >= n_committed are in the buffer. */
    size_t    n, ids_capacity, blocks_capacity;
    uint64_t *ids, *blocks;
    uint64_t  prefix;

    size_t         n_buffered, buffer_capacity; /* capacity in bytes */
    unsigned char *buffer;
    unsigned char *block;      /* one block, for reading */
    fw_record      one, other; /* for comparing two records of one id */
};

static uint64_t block_offset(const fw_journal *j, uint64_t block) { return j->header.size + block * j->block_size; }

static void destroy(fw_journal *j)
{
    if (j == NULL) return;
    if (j->fd >= 0) close(j->fd);
    fw_journal_header_free(&j->header);
    fw_record_free(&j->one);
    fw_record_free(&j->other);
    free(j->ids);
    free(j->blocks);
    free(j->buffer);
    free(j->block);
    free(j->path);
    free(j);
}

/* ---- reading blocks ---- */

static fw_status load_block(fw_journal *j, uint64_t number, const unsigned char **block, fw_msg *m)
{
    if (number >= j->n_committed) {
        *block = j->buffer + (number - j->n_committed) * j->block_size;
        return FW_OK;
    }
    FW_TRY(fw_file_read_at(j->fd, j->path, j->block, j->block_size, block_offset(j, number), m));
    FW_CHECK(fw_journal_block_is_good(j->block, j->block_size), m, FW_E_FORMAT,
             "%s: record number %" PRIu64 " at byte %" PRIu64 " is damaged (its checksum is wrong)", j->path,
             number + 1, block_offset(j, number));
    *block = j->block;
    return FW_OK;
}

/* A block whose checksum is right may still hold no record of this program: name file and place. */
static fw_status load_record(fw_journal *j, uint64_t number, fw_record *r, fw_msg *m)
{
    const unsigned char *block = NULL;
    FW_TRY(load_block(j, number, &block, m));
    fw_status status = fw_journal_block_read(block, j->block_size, r, m);
    if (status != FW_OK) {
        fw_msg_prefix(m, "%s: record number %" PRIu64 " at byte %" PRIu64 ": ", j->path, number + 1,
                      block_offset(j, number));
    }
    return status;
}

/* ---- index ---- */

typedef struct entry {
    uint64_t id, block;
} entry;

static int compare_entries(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    if (x->id != y->id) return x->id < y->id ? -1 : 1;
    return x->block < y->block ? -1 : x->block > y->block;
}

static void advance_prefix(fw_journal *j)
{
    while (j->prefix < j->n && j->ids[j->prefix] == j->prefix) j->prefix++;
}

/* Where id is or would be. */
static size_t find(const fw_journal *j, uint64_t id)
{
    size_t low = 0, high = j->n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (j->ids[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static fw_status reserve(fw_journal *j, size_t n, fw_msg *m)
{
    FW_TRY(fw_grow(&j->ids, &j->ids_capacity, n, sizeof *j->ids, "ids of a journal", m));
    return fw_grow(&j->blocks, &j->blocks_capacity, n, sizeof *j->blocks, "index of a journal", m);
}

/* Of two records of one id the first counts, if the second says the same. One that failed gives way to a second: it was run again by a
 * program that can do better. */
static fw_status which_counts(fw_journal *j, entry first, entry second, bool *is_second, fw_msg *m)
{
    FW_TRY(load_record(j, first.block, &j->one, m));
    FW_TRY(load_record(j, second.block, &j->other, m));
    bool is_same = fw_journal_has_same_bits(&j->one, &j->other);
    *is_second = !is_same && j->one.status != FW_OK;
    FW_CHECK(is_same || *is_second, m, FW_E_FORMAT,
             "%s: realisation %" PRIu64 " is there twice with different results (records number %" PRIu64
             " and %" PRIu64 ")",
             j->path, first.id, first.block + 1, second.block + 1);
    return FW_OK;
}

static fw_status build_index(fw_journal *j, entry *entries, size_t n, fw_msg *m)
{
    bool is_sorted = true;
    for (size_t i = 1; i < n && is_sorted; i++) is_sorted = entries[i - 1].id < entries[i].id;
    if (!is_sorted) qsort(entries, n, sizeof *entries, compare_entries);
    FW_TRY(reserve(j, n, m));
    for (size_t i = 0; i < n; i++) {
        if (j->n > 0 && entries[i].id == j->ids[j->n - 1]) {
            bool  is_second;
            entry first = {.id = entries[i].id, .block = j->blocks[j->n - 1]};
            FW_TRY(which_counts(j, first, entries[i], &is_second, m));
            if (is_second) j->blocks[j->n - 1] = entries[i].block;
            continue;
        }
        j->ids[j->n] = entries[i].id;
        j->blocks[j->n++] = entries[i].block;
    }
    advance_prefix(j);
    return FW_OK;
}

/* ---- the scan at opening ---- */

typedef struct scan {
    size_t   n, capacity;
    entry   *entries;
    uint64_t n_blocks; /* whole ones in the file, good or bad */
    uint64_t n_good;   /* before the first bad one */
} scan;

static fw_status scan_blocks(const fw_journal *j, scan *s, unsigned char *bytes, size_t blocks_at_once, fw_msg *m)
{
    bool is_bad_seen = false;
    for (uint64_t block = 0; block < s->n_blocks;) {
        size_t k = s->n_blocks - block < blocks_at_once ? (size_t)(s->n_blocks - block) : blocks_at_once;
        FW_TRY(fw_file_read_at(j->fd, j->path, bytes, k * j->block_size, block_offset(j, block), m));
        for (size_t i = 0; i < k; i++, block++) {
            const unsigned char *at = bytes + i * j->block_size;
            if (!fw_journal_block_is_good(at, j->block_size)) {
                is_bad_seen = true;
                continue;
            }
            FW_CHECK(!is_bad_seen, m, FW_E_FORMAT,
                     "%s is damaged: record number %" PRIu64 " at byte %" PRIu64
                     " has a wrong checksum and good records follow it;"
                     " nothing was changed. To give up all but the first %" PRIu64 " records: truncate -s %" PRIu64
                     " on the file",
                     j->path, s->n_good + 1, block_offset(j, s->n_good), s->n_good, block_offset(j, s->n_good));
            FW_TRY(fw_grow(&s->entries, &s->capacity, s->n + 1, sizeof *s->entries, "index of a journal", m));
            s->entries[s->n++] = (entry){.id = fw_journal_block_id(at), .block = block};
            s->n_good = block + 1;
        }
    }
    /* A crash tears at most the one commit that was under way; more is damage, and cutting it off would destroy it. */
    FW_CHECK(s->n_blocks - s->n_good <= MAX_COMMIT, m, FW_E_FORMAT,
             "%s is damaged: from record number %" PRIu64 " at byte %" PRIu64 " on %" PRIu64
             " records have wrong checksums, more than "
             "the %d that a crash can tear; nothing was changed",
             j->path, s->n_good + 1, block_offset(j, s->n_good), s->n_blocks - s->n_good, (int)MAX_COMMIT);
    return FW_OK;
}

static fw_status scan_file(fw_journal *j, fw_msg *m)
{
    uint64_t size;
    FW_TRY(fw_file_size(j->fd, j->path, &size, m));
    FW_CHECK(size >= j->header.size, m, FW_E_FORMAT, "%s: cut off inside the header", j->path);
    scan   s = {.n_blocks = (size - j->header.size) / j->block_size};
    size_t n_once = SCAN_BYTES / j->block_size + 1;
    if (n_once > s.n_blocks) n_once = (size_t)s.n_blocks;
    unsigned char *bytes;
    FW_TRY(fw_alloc(&bytes, n_once, j->block_size, "blocks of a journal", m));
    fw_status status = scan_blocks(j, &s, bytes, n_once, m);
    free(bytes);
    j->n_committed = s.n_good;
    j->torn_bytes = size - block_offset(j, s.n_good);
    if (status == FW_OK) status = build_index(j, s.entries, s.n, m);
    free(s.entries);
    return status;
}

/* ---- opening ---- */

static fw_status allocate(fw_journal **out, const char *path, fw_msg *m)
{
    *out = NULL;
    fw_journal *j;
    FW_TRY(fw_alloc(&j, 1, sizeof *j, "a journal", m));
    j->fd = -1;
    fw_status status = fw_file_suffixed(&j->path, path, "", m);
    if (status != FW_OK)
        destroy(j);
    else
        *out = j;
    return status;
}

/* Sizes are known: what every open journal needs. */
static fw_status prepare(fw_journal *j, const fw_journal_header *h, fw_msg *m)
{
    j->block_size = fw_journal_block_size(h->n_arcs, h->n_laws);
    FW_TRY(fw_alloc(&j->block, 1, j->block_size, "a block of a journal", m));
    FW_TRY(fw_record_init(&j->one, h->n_arcs, h->n_laws, m));
    return fw_record_init(&j->other, h->n_arcs, h->n_laws, m);
}

static fw_status write_header(int fd, const char *path, const fw_journal_header *h, fw_msg *m)
{
    unsigned char *bytes;
    size_t         n;
    FW_CHECK(ftruncate(fd, 0) == 0, m, FW_E_IO, "%s: %s", path, strerror(errno));
    FW_TRY(fw_journal_header_write(h, &bytes, &n, m));
    fw_status status = fw_file_write_at(fd, path, bytes, n, 0, NULL, m);
    free(bytes);
    /* before the old journal loses its name: a full disk may show only now */
    FW_CHECK(status != FW_OK || fsync(fd) == 0, m, FW_E_IO, "%s: fsync: %s", path, strerror(errno));
    return status;
}

/* Make a new journal under PATH.tmp and give it its name. *is_taken: somebody else made PATH in the meantime. */
static fw_status create(fw_journal *j, const fw_journal_header *h, bool is_fresh, bool *is_taken, fw_msg *m)
{
    char       *temporary = NULL, *old = NULL;
    struct stat s;
    int         fd = -1;
    *is_taken = false;
    fw_status status = fw_file_suffixed(&temporary, j->path, ".tmp", m);
    if (status == FW_OK) status = fw_file_suffixed(&old, j->path, ".old", m);
    if (status == FW_OK) status = fw_file_claim(&fd, temporary, true, m);
    if (status == FW_OK) {
        /* Who holds PATH.tmp alone may make PATH; it may have been made before we got hold of it. */
        *is_taken = !is_fresh && stat(j->path, &s) == 0;
        if (!*is_taken) status = write_header(fd, temporary, h, m);
        if (status == FW_OK && !*is_taken && is_fresh && rename(j->path, old) != 0 && errno != ENOENT) {
            status = fw_fail(m, FW_E_IO, "%s: cannot be renamed to %s: %s", j->path, old, strerror(errno));
        }
        if (status == FW_OK && !*is_taken) status = fw_file_publish(fd, temporary, j->path, m);
        if (status != FW_OK || *is_taken) {
            unlink(temporary);
            close(fd);
            fd = -1;
        }
    }
    j->fd = fd; /* the lock of PATH.tmp is now the lock of PATH */
    free(temporary);
    free(old);
    return status;
}

/* The header is ours: index the records, cut a torn tail off and note the new number of realisations. */
static fw_status go_on(fw_journal *j, uint64_t max_realisations, fw_msg *m)
{
    FW_TRY(scan_file(j, m));
    bool is_changed = false;
    if (j->torn_bytes > 0) {
        FW_CHECK(ftruncate(j->fd, (off_t)block_offset(j, j->n_committed)) == 0, m, FW_E_IO,
                 "%s: a torn tail of %" PRIu64 " bytes cannot be cut off: %s", j->path, j->torn_bytes, strerror(errno));
        is_changed = true;
    }
    if (j->header.max_realisations != max_realisations) {
        unsigned char slot[FW_JOURNAL_SLOT_SIZE];
        fw_journal_slot_write(slot, max_realisations);
        FW_TRY(fw_file_write_at(j->fd, j->path, slot, sizeof slot, j->header.size - sizeof slot, NULL, m));
        j->header.max_realisations = max_realisations;
        is_changed = true;
    }
    FW_CHECK(!is_changed || fdatasync(j->fd) == 0, m, FW_E_IO, "%s: fdatasync: %s", j->path, strerror(errno));
    return FW_OK;
}

/* All memory is taken before a file is made or changed. */
static fw_status open_writer(fw_journal *j, fw_journal_header *wanted, bool is_fresh, fw_msg *m)
{
    FW_TRY(prepare(j, wanted, m));
    for (bool is_taken = true; is_taken;) {
        is_taken = false;
        FW_TRY(fw_file_claim(&j->fd, j->path, false, m));
        if (j->fd >= 0 && !is_fresh) {
            FW_TRY(fw_journal_header_read(&j->header, j->fd, j->path, m));
            FW_TRY(fw_journal_header_match(&j->header, wanted, j->path, m)); /* sizes too */
            return go_on(j, wanted->max_realisations, m);
        }
        int old_fd = j->fd; /* keeps the lock of the old file until the new one is in its place */
        j->fd = -1;
        fw_status status = create(j, wanted, is_fresh, &is_taken, m);
        if (old_fd >= 0) close(old_fd);
        FW_TRY(status);
    }
    j->header = *wanted;
    wanted->settings = NULL; /* the journal's now */
    return FW_OK;
}

fw_status fw_journal_open(fw_journal **out, const char *path, const fw_campaign *c, bool is_fresh, fw_msg *m)
{
    fw_journal_header wanted;
    fw_journal       *j;
    *out = NULL;
    FW_TRY(fw_journal_header_of(&wanted, c, m));
    fw_status status = allocate(&j, path, m);
    if (status == FW_OK) {
        status = open_writer(j, &wanted, is_fresh, m);
        j->is_writer = true;
        if (status == FW_OK)
            *out = j;
        else
            destroy(j);
    }
    fw_journal_header_free(&wanted);
    return status;
}

fw_status fw_journal_open_read(fw_journal **out, const char *path, const fw_campaign *c, fw_msg *m)
{
    fw_journal *j;
    *out = NULL;
    FW_TRY(allocate(&j, path, m));
    fw_status status = fw_file_open_read(&j->fd, path, m);
    if (status == FW_OK) status = fw_journal_header_read(&j->header, j->fd, path, m);
    if (status == FW_OK && c != NULL) {
        fw_journal_header wanted;
        status = fw_journal_header_of(&wanted, c, m);
        if (status == FW_OK) status = fw_journal_header_match(&j->header, &wanted, path, m);
        fw_journal_header_free(&wanted);
    }
    if (status == FW_OK) status = prepare(j, &j->header, m);
    if (status == FW_OK) status = scan_file(j, m);
    if (status == FW_OK)
        *out = j;
    else
        destroy(j);
    return status;
}

/* ---- appending ---- */

fw_status fw_journal_append(fw_journal *j, const fw_record *r, fw_msg *m)
{
    FW_CHECK(j->is_writer, m, FW_E_ARG, "%s is open for reading only", j->path);
    FW_CHECK(r->n_arcs == j->header.n_arcs && r->n_laws == j->header.n_laws, m, FW_E_ARG,
             "%s: a record of %zu arcs and %zu laws in a journal of %zu and %zu", j->path, r->n_arcs, r->n_laws,
             j->header.n_arcs, j->header.n_laws);
    if (j->n_buffered == MAX_COMMIT) FW_TRY(fw_journal_flush(j, m)); /* the last commit failed: try again or refuse */
    FW_TRY(fw_grow(&j->buffer, &j->buffer_capacity, (j->n_buffered + 1) * j->block_size, 1, "buffer of a journal", m));
    unsigned char *block = j->buffer + j->n_buffered * j->block_size;
    fw_journal_block_write(block, r);

    size_t at = find(j, r->id);
    entry new = {.id = r->id, .block = j->n_committed + j->n_buffered};
    if (at < j->n && j->ids[at] == r->id) {
        bool is_second;
        FW_TRY(which_counts(j, (entry){.id = r->id, .block = j->blocks[at]}, new, &is_second, m));
        if (!is_second) return FW_OK;
        j->blocks[at] = new.block;
        j->n_buffered++;
        return j->n_buffered == MAX_COMMIT ? fw_journal_flush(j, m) : FW_OK;
    }
    FW_TRY(reserve(j, j->n + 1, m));
    memmove(j->ids + at + 1, j->ids + at, (j->n - at) * sizeof *j->ids);
    memmove(j->blocks + at + 1, j->blocks + at, (j->n - at) * sizeof *j->blocks);
    j->ids[at] = new.id;
    j->blocks[at] = new.block;
    j->n++;
    j->n_buffered++;
    advance_prefix(j);
    return j->n_buffered == MAX_COMMIT ? fw_journal_flush(j, m) : FW_OK;
}

/* The first k blocks of the buffer are on disk. */
static void commit(fw_journal *j, size_t k)
{
    j->n_committed += k;
    j->n_buffered -= k;
    memmove(j->buffer, j->buffer + k * j->block_size, j->n_buffered * j->block_size);
}

/* A commit failed after `written` bytes: keep the whole records among them and cut the rest off, so that the file ends
 * with a whole record for whoever reads it next. Should even that fail, the tail is torn and the next open drops it. */
static fw_status cut_back(fw_journal *j, size_t written, fw_status status, fw_msg *m)
{
    size_t whole = written / j->block_size;
    bool   is_cut = ftruncate(j->fd, (off_t)block_offset(j, j->n_committed + whole)) == 0 && fdatasync(j->fd) == 0;
    if (is_cut) commit(j, whole);
    fw_msg reason = m != NULL ? *m : (fw_msg){.text = ""};
    return fw_fail(m, status,
                   "%s; the file %s %" PRIu64 " whole records (%" PRIu64 " bytes): make room, then run again to go on",
                   reason.text, is_cut ? "was cut back to its" : "has a torn tail after", j->n_committed,
                   block_offset(j, j->n_committed));
}

fw_status fw_journal_flush(fw_journal *j, fw_msg *m)
{
    if (j->n_buffered == 0) return FW_OK;
    size_t    n = j->n_buffered * j->block_size, written;
    fw_status status = fw_file_write_at(j->fd, j->path, j->buffer, n, block_offset(j, j->n_committed), &written, m);
    if (status != FW_OK) return cut_back(j, written, status, m);
    if (fdatasync(j->fd) != 0) {
        /* What reached the disk is unknown, and asking again may say yes without writing: keep nothing of it. */
        return cut_back(j, 0, fw_fail(m, FW_E_IO, "%s: fdatasync of %zu bytes: %s", j->path, n, strerror(errno)), m);
    }
    commit(j, j->n_buffered);
    return FW_OK;
}

fw_status fw_journal_close(fw_journal *j, fw_msg *m)
{
    if (j == NULL) return FW_OK;
    fw_status status = fw_journal_flush(j, m);
    destroy(j);
    return status;
}

/* ---- looking at it ---- */

const uint64_t *fw_journal_ids(const fw_journal *j, size_t *n)
{
    *n = j->n;
    return j->ids;
}

uint64_t fw_journal_prefix(const fw_journal *j) { return j->prefix; }

uint64_t fw_journal_torn(const fw_journal *j) { return j->torn_bytes; }

fw_status fw_journal_read(fw_journal *j, uint64_t id, fw_record *r, fw_msg *m)
{
    size_t at = find(j, id);
    FW_CHECK(at < j->n && j->ids[at] == id, m, FW_E_ARG, "%s: no realisation %" PRIu64, j->path, id);
    FW_CHECK(r->n_arcs == j->header.n_arcs && r->n_laws == j->header.n_laws, m, FW_E_ARG,
             "%s: records of %zu arcs and %zu laws, asked for %zu and %zu", j->path, j->header.n_arcs, j->header.n_laws,
             r->n_arcs, r->n_laws);
    return load_record(j, j->blocks[at], r, m);
}

fw_status fw_journal_facts_of(const char *path, fw_journal_facts *out, fw_msg *m)
{
    fw_journal *j;
    memset(out, 0, sizeof *out);
    FW_TRY(fw_journal_open_read(&j, path, NULL, m));
    const fw_journal_header *h = &j->header;
    memcpy(out->name, h->name, sizeof out->name);
    out->hash = h->hash;
    out->seed = h->seed;
    out->max_realisations = h->max_realisations;
    out->n_arcs = h->n_arcs;
    out->n_laws = h->n_laws;
    out->n_done = j->n;
    out->prefix = j->prefix;
    out->first = j->n > 0 ? j->ids[0] : 0;
    out->end = j->n > 0 ? j->ids[j->n - 1] + 1 : 0;
    out->torn_bytes = j->torn_bytes;
    out->is_running = fw_file_is_locked(j->fd);
    fw_status status = FW_OK;
    for (size_t i = 0; i < j->n && status == FW_OK;
         i++) { /* in order of id, so that the sum has the same bits each time */
        status = fw_journal_read(j, j->ids[i], &j->one, m);
        out->n_failed += j->one.status != FW_OK;
        out->host_cpu_s += j->one.host_cpu_s;
    }
    fw_journal_close(j, NULL);
    return status;
}
