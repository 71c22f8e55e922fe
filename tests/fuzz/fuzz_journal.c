/* Journals: whatever the bytes, a refusal that says why and changes nothing, or a journal whose records can be read,
 * that a run can go on with, and that says the same to reader, writer and status.
 *
 *   byte 0   what is sealed again, so that the code behind the checksums is reached: bits of `seal` below; 0: raw bytes
 *   byte 1   blocks that stay as they are (bit i: blocks i, i + 8, ..), so that torn tails and damage are reached too
 *   rest     the journal */
#include <fcntl.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "fuzz/fuzz.h"
#include "store/journal.h"
#include "store/journal_format.h"

enum seal { SEAL_HEADER = 1, SEAL_SLOT = 2, SEAL_BLOCKS = 4, SEAL_RECORD_SIZE = 8, SEAL_RECORDS = 16 };
enum { AT_ARCS = 40, AT_LAWS = 44, AT_RECORD = 48, AT_LENGTH = 120, AT_SETTINGS = 128 };
enum { MOST_ARCS = 1024 }; /* a million are possible, and cost a fuzzer that clears their memory a tenth of a second */

static const char *const files[] = {"f.journal", "f.journal.tmp", "f.journal.old", NULL};

static char path[FUZZ_PATH];

/* ---- sealing again ---- */

static uint64_t get(const char *from, int n)
{
    uint64_t v = 0;
    for (int i = 0; i < n; i++) v |= (uint64_t)(unsigned char)from[i] << (8 * i);
    return v;
}

static void put(char *to, uint64_t v, int n)
{
    for (int i = 0; i < n; i++) to[i] = (char)(v >> (8 * i));
}

/* A block's length and checksum; with SEAL_RECORDS also what its record repeats: sizes, id and status. */
static void seal_block(char *block, size_t n, unsigned what, uint64_t arcs, uint64_t laws)
{
    if (what & SEAL_RECORDS) {
        char *record = block + FW_JOURNAL_BLOCK_HEAD;
        put(record, arcs, 4);
        put(record + 4, laws, 4);
        memcpy(record + 8, block + 8, 8);
        put(block + 4, get(block + 4, 4) % FW_N_STATUS, 4);
        memcpy(record + 16, block + 4, 4);
    }
    put(block, n, 4);
    put(block + n - 4, fw_crc32c(0, block, n - 4), 4);
}

static void seal(char *bytes, size_t n, unsigned what, unsigned left)
{
    if (n < AT_SETTINGS) return;
    uint64_t arcs = get(bytes + AT_ARCS, 4), laws = get(bytes + AT_LAWS, 4), n_settings = get(bytes + AT_LENGTH, 8);
    if (arcs > 1u << 20 || laws > FW_MAX_LAWS || n_settings > n - AT_SETTINGS) return;
    if ((what & SEAL_HEADER) && arcs > MOST_ARCS) put(bytes + AT_ARCS, arcs %= MOST_ARCS, 4);
    size_t end = AT_SETTINGS + (size_t)n_settings, block = fw_journal_block_size((size_t)arcs, (size_t)laws);
    if (what & SEAL_RECORD_SIZE) put(bytes + AT_RECORD, fw_record_packed_size((size_t)arcs, (size_t)laws), 8);
    if (n - end < 4 + FW_JOURNAL_SLOT_SIZE) return;
    if (what & SEAL_HEADER) put(bytes + end, fw_crc32c(0, bytes, end), 4);
    if (what & SEAL_SLOT) put(bytes + end + 12, fw_crc32c(0, bytes + end + 4, 8), 4);
    if (!(what & SEAL_BLOCKS)) return;
    size_t at = end + 4 + FW_JOURNAL_SLOT_SIZE;
    for (unsigned i = 0; n - at >= block; i++, at += block) {
        if (!(left >> (i % 8) & 1)) seal_block(bytes + at, block, what, arcs, laws);
    }
}

/* ---- laws ---- */

static void check_refusal(fw_status status, const fw_msg *m, double started)
{
    FUZZ_LAW(status == FW_E_FORMAT, "%s: %s", fw_status_name(status), m->text);
    fuzz_check_refusal(status, m, "f.journal", started);
}

static void check_unchanged(const char *bytes, size_t n)
{
    FILE *f = fopen(path, "rb");
    char *now = malloc(n + 1);
    FUZZ_LAW(f != NULL && now != NULL && fread(now, 1, n + 1, f) == n && memcmp(now, bytes, n) == 0,
             "a refused journal was changed");
    free(now);
    fclose(f);
}

/* A record comes whole, or its block is named as one that no program of ours wrote. */
static void check_record(fw_journal *j, uint64_t id, fw_record *r)
{
    fw_msg    m = {""};
    double    started = fw_cpu_seconds();
    fw_status status = fw_journal_read(j, id, r, &m);
    if (status != FW_OK) {
        check_refusal(status, &m, started);
        return;
    }
    FUZZ_LAW(r->id == id && (int)r->status >= 0 && r->status < FW_N_STATUS, "record %llu, status %d",
             (unsigned long long)r->id, (int)r->status);
    FUZZ_LAW(memchr(r->cause, 0, sizeof r->cause) != NULL, "a cause without end");
    size_t         n = fw_record_packed_size(r->n_arcs, r->n_laws);
    unsigned char *packed = malloc(n), *again = malloc(n);
    FUZZ_LAW(packed != NULL && again != NULL, "no memory");
    fw_record_pack(r, packed);
    FUZZ_LAW(fw_record_unpack(r, packed, n, &m) == FW_OK, "%s", m.text);
    fw_record_pack(r, again);
    FUZZ_LAW(memcmp(packed, again, n) == 0, "a record changes when it is packed");
    free(packed);
    free(again);
}

static size_t check_journal(fw_journal *j, const fw_journal_header *h)
{
    size_t          n;
    const uint64_t *ids = fw_journal_ids(j, &n);
    uint64_t        prefix = fw_journal_prefix(j);
    fw_record       r;
    FUZZ_LAW(prefix <= n && (prefix == 0 || ids[prefix - 1] == prefix - 1) && (prefix == n || ids[prefix] != prefix),
             "prefix %llu of %zu", (unsigned long long)prefix, n);
    FUZZ_LAW(fw_record_init(&r, h->n_arcs, h->n_laws, NULL) == FW_OK, "%zu arcs", h->n_arcs);
    uint64_t absent = 0;
    for (size_t i = 0; i < n; i++) {
        FUZZ_LAW(i == 0 || ids[i - 1] < ids[i], "ids are not ascending");
        if (ids[i] == absent) absent++;
        check_record(j, ids[i], &r);
    }
    fw_msg m = {""};
    FUZZ_LAW(fw_journal_read(j, absent, &r, &m) == FW_E_ARG && strstr(m.text, "f.journal") != NULL, "%s", m.text);
    fw_record_free(&r);
    return n;
}

/* What `floewear status` shows is what the reader sees. */
static void check_facts(const fw_journal_header *h, size_t n)
{
    fw_journal_facts facts;
    fw_msg           m = {""};
    double           started = fw_cpu_seconds();
    fw_status        status = fw_journal_facts_of(path, &facts, &m);
    if (status == FW_OK) {
        FUZZ_LAW(facts.n_done == n && facts.hash == h->hash && facts.seed == h->seed && facts.n_failed <= n &&
                     !facts.is_running,
                 "%llu records", (unsigned long long)facts.n_done);
    } else {
        check_refusal(status, &m, started);
    }
}

/* The header's own campaign goes on with it: the torn tail goes, a new record joins the old ones, whoever reads it. */
static void check_going_on(const fw_journal_header *h, const fw_campaign *c, size_t n)
{
    fw_journal *j;
    fw_record   r;
    fw_msg      m = {""};
    fw_status   status = fw_journal_open(&j, path, c, false, &m);
    FUZZ_LAW(status == FW_OK, "opened for reading, not for going on: %s", m.text);
    FUZZ_LAW(check_journal(j, h) == n, "not the reader's %zu records", n);
    FUZZ_LAW(fw_record_init(&r, h->n_arcs, h->n_laws, NULL) == FW_OK, "%zu arcs", h->n_arcs);
    size_t          n_ids;
    const uint64_t *ids = fw_journal_ids(j, &n_ids);
    r.id = fw_journal_prefix(j);
    for (size_t i = 0; i < n_ids; i++) r.id += ids[i] == r.id;
    FUZZ_LAW(fw_journal_append(j, &r, &m) == FW_OK && fw_journal_close(j, &m) == FW_OK, "%s", m.text);
    fw_record_free(&r);

    FUZZ_LAW(fw_journal_open_read(&j, path, c, &m) == FW_OK, "%s", m.text);
    FUZZ_LAW(fw_journal_torn(j) == 0 && check_journal(j, h) == n + 1, "not one more than %zu", n);
    fw_journal_close(j, NULL);
}

static void check_other_campaign(const fw_campaign *own, const char *bytes, size_t n)
{
    static char settings[] = "contact.stiffness = 2e6 N/m\ncurrent.speed = 2 m/s\nseed = 7\n";
    fw_campaign other = *own;
    fw_journal *j;
    fw_msg      m = {""};
    double      started = fw_cpu_seconds();
    other.settings = settings;
    other.hash = own->hash + 1;
    fw_status status = fw_journal_open(&j, path, &other, false, &m);
    FUZZ_LAW(j == NULL && status == FW_E_MISMATCH, "%s: %s", fw_status_name(status), m.text);
    fuzz_check_refusal(status, &m, "f.journal", started);
    check_unchanged(bytes, n);
}

/* The campaign that a header names; false: it has none. c borrows from h. */
static bool campaign_of(fw_journal_header *h, fw_campaign *c)
{
    int  fd = open(path, O_RDONLY);
    bool is_there = fd >= 0 && fw_journal_header_read(h, fd, path, NULL) == FW_OK;
    if (fd >= 0) close(fd);
    if (!is_there) return false;
    *c = (fw_campaign){.settings = h->settings, .hash = h->hash, .seed = h->seed};
    memcpy(c->name, h->name, sizeof c->name);
    c->model.n_arcs = h->n_arcs;
    c->model.n_laws = h->n_laws;
    c->precision.max_realisations = h->max_realisations + 1;
    return true;
}

static void check_accepted(fw_journal *j, const char *bytes, size_t n_bytes)
{
    fw_journal_header h;
    fw_campaign       c;
    FUZZ_LAW(campaign_of(&h, &c), "header");
    size_t n = check_journal(j, &h);
    check_facts(&h, n);
    check_other_campaign(&c, bytes, n_bytes);
    check_going_on(&h, &c, n);
    fw_journal_header_free(&h);
}

/* Behind a good header too, and whoever asks: damage is for a person to decide about. */
static void check_refused(fw_status status, const fw_msg *said, double started, const char *bytes, size_t n)
{
    fw_journal_header h;
    fw_campaign       c;
    check_refusal(status, said, started);
    if (campaign_of(&h, &c)) {
        fw_journal *j;
        fw_msg      m = {""};
        started = fw_cpu_seconds();
        status = fw_journal_open(&j, path, &c, false, &m);
        FUZZ_LAW(j == NULL, "refused for reading, opened for going on");
        check_refusal(status, &m, started);
        fw_journal_header_free(&h);
    }
    check_unchanged(bytes, n);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fw_journal *j;
    fw_msg      m = {""};

    if (size < 2) return 0;
    fuzz_enter_folder(files);
    fuzz_path(path, files[0]);
    size_t n = size - 2;
    char  *bytes = fuzz_copy(data + 2, n);
    seal(bytes, n, data[0], data[1]);
    fuzz_save(path, bytes, n);

    double    started = fw_cpu_seconds();
    fw_status status = fw_journal_open_read(&j, path, NULL, &m);
    if (status == FW_OK) {
        check_accepted(j, bytes, n);
        fw_journal_close(j, NULL);
    } else {
        FUZZ_LAW(j == NULL, "refused and open");
        check_refused(status, &m, started, bytes, n);
    }
    free(bytes);
    return 0;
}
