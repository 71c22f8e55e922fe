#include "store/journal_format.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/memory.h"
#include "store/file.h"

static const char magic[16] = {'f', 'l', 'o', 'e', 'w', 'e', 'a', 'r', ' ', 'j', 'o', 'u', 'r', 'n', 'a', 'l'};

enum {
    OFFSET_VERSION = 16,
    OFFSET_ORDER = 20,
    OFFSET_HASH = 24,
    OFFSET_SEED = 32,
    OFFSET_ARCS = 40,
    OFFSET_LAWS = 44,
    OFFSET_RECORD = 48,
    OFFSET_NAME = 56,
    N_NAME = 64,
    OFFSET_LENGTH = 120,
    OFFSET_SETTINGS = 128
};
/* Far above any campaign, whose settings stay below 64 KiB: a hostile header asks for no memory, and naming what differs
 * takes no minute. */
enum { MAX_SETTINGS = 1 << 20, MAX_ARCS = 1 << 20 };

_Static_assert(sizeof((fw_journal_header *)0)->name == N_NAME, "the name has one size in memory and file");
_Static_assert(sizeof((fw_campaign *)0)->name == N_NAME, "the name has one size in memory and file");

static void put(unsigned char *to, uint64_t v, int n)
{
    for (int i = 0; i < n; i++) { to[i] = (unsigned char)(v >> (8 * i)); }
}

static uint64_t get(const unsigned char *from, int n)
{
    uint64_t v = 0;
    for (int i = 0; i < n; i++) { v |= (uint64_t)from[i] << (8 * i); }
    return v;
}

fw_status fw_journal_header_of(fw_journal_header *h, const fw_campaign *c, fw_msg *m)
{
    memset(h, 0, sizeof *h);
    FW_CHECK(c->model.n_arcs <= MAX_ARCS && c->model.n_laws <= FW_MAX_LAWS, m, FW_E_ARG,
             "a campaign of %zu arcs and %zu laws has no journal", c->model.n_arcs, c->model.n_laws);
    const char *settings = c->settings != NULL ? c->settings : "";
    FW_CHECK(strlen(settings) <= MAX_SETTINGS, m, FW_E_ARG, "settings of %zu bytes, at most %d", strlen(settings),
             (int)MAX_SETTINGS);
    h->settings = fw_strdup(settings);
    FW_CHECK(h->settings != NULL, m, FW_E_NOMEM, "out of memory: settings of a journal");
    h->hash = c->hash;
    h->seed = c->seed;
    h->max_realisations = c->precision.max_realisations;
    h->n_arcs = c->model.n_arcs;
    h->n_laws = c->model.n_laws;
    memcpy(h->name, c->name, strnlen(c->name, N_NAME - 1));
    h->size = OFFSET_SETTINGS + strlen(settings) + 4 + FW_JOURNAL_SLOT_SIZE;
    return FW_OK;
}

void fw_journal_header_free(fw_journal_header *h)
{
    free(h->settings);
    h->settings = NULL;
}

void fw_journal_slot_write(unsigned char bytes[FW_JOURNAL_SLOT_SIZE], uint64_t max_realisations)
{
    put(bytes, max_realisations, 8);
    put(bytes + 8, fw_crc32c(0, bytes, 8), 4);
}

fw_status fw_journal_header_write(const fw_journal_header *h, unsigned char **out, size_t *n, fw_msg *m)
{
    unsigned char *b;
    size_t         n_settings = strlen(h->settings);
    FW_TRY(fw_alloc(&b, h->size, 1, "header of a journal", m));
    memcpy(b, magic, sizeof magic);
    put(b + OFFSET_VERSION, FW_JOURNAL_VERSION, 4);
    put(b + OFFSET_ORDER, 0x01020304, 4);
    put(b + OFFSET_HASH, h->hash, 8);
    put(b + OFFSET_SEED, h->seed, 8);
    put(b + OFFSET_ARCS, h->n_arcs, 4);
    put(b + OFFSET_LAWS, h->n_laws, 4);
    put(b + OFFSET_RECORD, fw_record_packed_size(h->n_arcs, h->n_laws), 8);
    memcpy(b + OFFSET_NAME, h->name, N_NAME);
    put(b + OFFSET_LENGTH, n_settings, 8);
    memcpy(b + OFFSET_SETTINGS, h->settings, n_settings);
    size_t end = OFFSET_SETTINGS + n_settings;
    put(b + end, fw_crc32c(0, b, end), 4);
    fw_journal_slot_write(b + end + 4, h->max_realisations);
    *out = b;
    *n = h->size;
    return FW_OK;
}

/* The fixed part: kind, version and every size that the rest is read by. */
static fw_status check_fixed(const unsigned char *b, uint64_t file_size, const char *path, fw_msg *m)
{
    FW_CHECK(file_size >= sizeof magic && memcmp(b, magic, sizeof magic) == 0, m, FW_E_FORMAT,
             "%s is no floewear journal (its first bytes are others)", path);
    FW_CHECK(file_size >= OFFSET_SETTINGS, m, FW_E_FORMAT,
             "%s: the journal's header is cut off after %" PRIu64 " bytes", path, file_size);
    uint64_t version = get(b + OFFSET_VERSION, 4), order = get(b + OFFSET_ORDER, 4);
    FW_CHECK(order == 0x01020304, m, FW_E_FORMAT,
             "%s: the journal's byte order mark is 0x%08" PRIx64 ", not 0x01020304", path, order);
    FW_CHECK(version == FW_JOURNAL_VERSION, m, FW_E_FORMAT,
             "%s: journal format %" PRIu64 "; this program reads format %d", path, version, (int)FW_JOURNAL_VERSION);
    uint64_t n_arcs = get(b + OFFSET_ARCS, 4), n_laws = get(b + OFFSET_LAWS, 4), n_settings = get(b + OFFSET_LENGTH, 8);
    FW_CHECK(n_arcs <= MAX_ARCS && n_laws <= FW_MAX_LAWS && n_settings <= MAX_SETTINGS &&
                 file_size >= OFFSET_SETTINGS + n_settings + 4 + FW_JOURNAL_SLOT_SIZE,
             m, FW_E_FORMAT,
             "%s: the journal's header is damaged: %" PRIu64 " arcs, %" PRIu64 " laws, settings of %" PRIu64
             " bytes in a file of %" PRIu64,
             path, n_arcs, n_laws, n_settings, file_size);
    return FW_OK;
}

fw_status fw_journal_header_read(fw_journal_header *h, int fd, const char *path, fw_msg *m)
{
    unsigned char fixed[OFFSET_SETTINGS] = {0}, slot[FW_JOURNAL_SLOT_SIZE], crc[4];
    uint64_t      file_size;
    memset(h, 0, sizeof *h);
    FW_TRY(fw_file_size(fd, path, &file_size, m));
    size_t n_fixed = file_size < sizeof fixed ? (size_t)file_size : sizeof fixed;
    FW_TRY(fw_file_read_at(fd, path, fixed, n_fixed, 0, m));
    FW_TRY(check_fixed(fixed, file_size, path, m));

    size_t n_settings = (size_t)get(fixed + OFFSET_LENGTH, 8);
    FW_TRY(fw_alloc(&h->settings, n_settings + 1, 1, "settings of a journal", m));
    fw_status status = fw_file_read_at(fd, path, h->settings, n_settings, OFFSET_SETTINGS, m);
    if (status == FW_OK) status = fw_file_read_at(fd, path, crc, sizeof crc, OFFSET_SETTINGS + n_settings, m);
    if (status == FW_OK) status = fw_file_read_at(fd, path, slot, sizeof slot, OFFSET_SETTINGS + n_settings + 4, m);
    if (status == FW_OK && (fw_crc32c(fw_crc32c(0, fixed, sizeof fixed), h->settings, n_settings) != get(crc, 4) ||
                            strlen(h->settings) != n_settings || memchr(fixed + OFFSET_NAME, 0, N_NAME) == NULL)) {
        status = fw_fail(m, FW_E_FORMAT, "%s: the journal's header is damaged (its checksum is wrong)", path);
    }
    h->hash = get(fixed + OFFSET_HASH, 8);
    h->seed = get(fixed + OFFSET_SEED, 8);
    h->n_arcs = (size_t)get(fixed + OFFSET_ARCS, 4);
    h->n_laws = (size_t)get(fixed + OFFSET_LAWS, 4);
    h->size = OFFSET_SETTINGS + n_settings + 4 + FW_JOURNAL_SLOT_SIZE;
    memcpy(h->name, fixed + OFFSET_NAME, N_NAME);
    if (status == FW_OK && get(fixed + OFFSET_RECORD, 8) != fw_record_packed_size(h->n_arcs, h->n_laws)) {
        status = fw_fail(m, FW_E_FORMAT,
                         "%s: records of %" PRIu64
                         " bytes where this program has %zu: a program with other columns wrote it",
                         path, get(fixed + OFFSET_RECORD, 8), fw_record_packed_size(h->n_arcs, h->n_laws));
    }
    if (status != FW_OK) {
        fw_journal_header_free(h);
        return status;
    }
    h->max_realisations = get(slot + 8, 4) == fw_crc32c(0, slot, 8) ? get(slot, 8) : 0;
    return FW_OK;
}

size_t fw_journal_block_size(size_t n_arcs, size_t n_laws)
{
    return FW_JOURNAL_BLOCK_HEAD + fw_record_packed_size(n_arcs, n_laws) + 4;
}

void fw_journal_block_write(unsigned char *block, const fw_record *r)
{
    size_t n = fw_journal_block_size(r->n_arcs, r->n_laws);
    put(block, n, 4);
    put(block + 4, (uint32_t)r->status, 4);
    put(block + 8, r->id, 8);
    fw_record_pack(r, block + FW_JOURNAL_BLOCK_HEAD);
    put(block + n - 4, fw_crc32c(0, block, n - 4), 4);
}

bool fw_journal_block_is_good(const unsigned char *block, size_t n)
{
    return get(block, 4) == n && get(block + n - 4, 4) == fw_crc32c(0, block, n - 4);
}

uint64_t fw_journal_block_id(const unsigned char *block) { return get(block + 8, 8); }

uint32_t fw_journal_block_status(const unsigned char *block) { return (uint32_t)get(block + 4, 4); }

fw_status fw_journal_block_read(const unsigned char *block, size_t n, fw_record *r, fw_msg *m)
{
    FW_TRY(fw_record_unpack(r, block + FW_JOURNAL_BLOCK_HEAD, n - FW_JOURNAL_BLOCK_HEAD - 4, m));
    FW_CHECK(r->id == fw_journal_block_id(block) && (uint32_t)r->status == fw_journal_block_status(block), m,
             FW_E_FORMAT,
             "a block of id %" PRIu64 " and status %" PRIu32 " holds a record of id %" PRIu64 " and status %d",
             fw_journal_block_id(block), fw_journal_block_status(block), r->id, (int)r->status);
    return FW_OK;
}

static bool is_host_column(const char *name)
{
    return strstr(name, "host") != NULL || strstr(name, "cpu") != NULL || strstr(name, "wall") != NULL;
}

bool fw_journal_has_same_bits(const fw_record *a, const fw_record *b)
{
    if (a->id != b->id || a->status != b->status || strcmp(a->cause, b->cause) != 0) return false;
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        size_t      o = fw_record_columns[i].offset;
        const char *x = (const char *)a + o, *y = (const char *)b + o;
        if (!is_host_column(fw_record_columns[i].name) && memcmp(x, y, sizeof(double)) != 0) return false;
    }
    return memcmp(a->rings, b->rings, fw_record_n_rings(a->n_arcs, a->n_laws) * sizeof *a->rings) == 0;
}
