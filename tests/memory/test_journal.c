/* Memory runs out while a journal is made, continued, appended to and read. After a failure the files are as they were,
 * and a journal that is open goes on when there is memory again. */
#include "memory/inject.h"
#include "store/journal.h"
#include "store/store_help.h"

enum { N_ARCS = 72, N_LAWS = 1, N_RECORDS = 130 }; /* beyond one commit of 100 */

static const char path[] = "a.journal", temporary[] = "a.journal.tmp", kept[] = "a.journal.old";

typedef struct keeping {
    fw_campaign    campaign;
    fw_journal    *journal;
    bool           is_fresh;
    unsigned char *before; /* (n_before) what the file holds before the operation; NULL: there is none */
    size_t         n_before;
    uint64_t       hash;
} keeping;

static void append_all(fw_journal *j, uint64_t first, uint64_t end)
{
    fw_record r;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    for (uint64_t i = first; i < end; i++) {
        help_fill(&r, i ^ 1); /* pairs in the wrong order */
        assert_ok(fw_journal_append(j, &r, &msg));
    }
    fw_record_free(&r);
}

/* A journal of n records, and n_torn bytes of the next one's block. */
static void make_journal(keeping *k, size_t n, size_t n_torn)
{
    unsigned char *whole;
    size_t         n_whole, size;
    fw_journal    *j;
    unlink(path);
    assert_ok(fw_journal_open(&j, path, &k->campaign, false, &msg));
    append_all(j, 0, n);
    assert_ok(fw_journal_flush(j, &msg));
    whole = help_load(path, &size);
    free(whole);
    append_all(j, n, n + 2);
    assert_ok(fw_journal_close(j, &msg));
    whole = help_load(path, &n_whole);
    assert_true(size + n_torn <= n_whole);
    k->before = whole;
    k->n_before = size + n_torn;
    unlink(path);
}

static void begin(void *self)
{
    keeping *k = self;
    unlink(path), unlink(kept);
    if (k->before) help_save(path, k->before, k->n_before);
}

static void assert_untouched(const keeping *k)
{
    assert_false(help_exists(temporary) || help_exists(kept));
    assert_true(help_exists(path) == (k->before != NULL));
    if (!k->before) return;
    size_t         n;
    unsigned char *now = help_load(path, &n);
    assert_int_equal(n, k->n_before);
    assert_memory_equal(now, k->before, n);
    free(now);
}

/* ---- opening ---- */

static fw_status open_writer(void *self, fw_msg *m)
{
    keeping *k = self;
    return fw_journal_open(&k->journal, path, &k->campaign, k->is_fresh, m);
}

static uint64_t end_open(void *self, fw_status status)
{
    keeping *k = self;
    if (status != FW_OK) {
        assert_null(k->journal);
        assert_untouched(k);
        return 0;
    }
    size_t          n;
    const uint64_t *ids = fw_journal_ids(k->journal, &n);
    uint64_t        h = inject_hash(fw_journal_prefix(k->journal), ids, n * sizeof *ids);
    assert_ok(fw_journal_close(k->journal, &msg));
    k->journal = NULL;
    assert_false(help_exists(temporary));
    return inject_hash_file(inject_hash_file(h, path), kept);
}

static void opening(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool        is_there, is_fresh;
        size_t      n, n_torn;
    } cases[] = {{"journal, new", false, false, 0, 0},      {"journal, new, --fresh", false, true, 0, 0},
                 {"journal of 0 records", true, false, 0, 0}, {"journal of 0 records, torn", true, false, 0, 99},
                 {"journal of 40 records", true, false, 40, 0}, {"journal of 40 records, torn", true, false, 40, 99},
                 {"journal of 40 records, --fresh", true, true, 40, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        keeping k = {.campaign = help_campaign(N_ARCS, N_LAWS), .is_fresh = cases[i].is_fresh};
        if (cases[i].is_there) make_journal(&k, cases[i].n, cases[i].n_torn);
        k.campaign.precision.max_realisations = 77; /* another number than in the file: its slot is to be written */
        inject_walk(&(inject_case){
            .name = cases[i].name, .begin = begin, .run = open_writer, .end = end_open, .self = &k, .stride = 1});
        free(k.before);
    }
}

/* ---- appending ---- */

static void begin_append(void *self)
{
    keeping *k = self;
    begin(self);
    assert_ok(fw_journal_open(&k->journal, path, &k->campaign, false, &msg));
}

static fw_status append_records(void *self, fw_msg *m)
{
    keeping  *k = self;
    fw_record r;
    FW_TRY(fw_record_init(&r, N_ARCS, N_LAWS, m));
    fw_status status = FW_OK;
    for (uint64_t i = 0; i < N_RECORDS && status == FW_OK; i++) {
        help_fill(&r, i);
        status = fw_journal_append(k->journal, &r, m);
    }
    if (status == FW_OK) status = fw_journal_flush(k->journal, m);
    fw_record_free(&r);
    return status;
}

/* The journal that found no memory is still good: with memory it takes the same records, those that it has too. */
static uint64_t end_append(void *self, fw_status status)
{
    keeping *k = self;
    if (status != FW_OK) assert_ok(append_records(k, &msg));
    assert_int_equal(fw_journal_prefix(k->journal), N_RECORDS);
    assert_ok(fw_journal_close(k->journal, &msg));
    k->journal = NULL;
    uint64_t h = inject_hash_file(0, path);
    if (status == FW_OK) k->hash = h;
    assert_true(h == k->hash);
    return h;
}

static void appending(void **state)
{
    (void)state;
    keeping k = {.campaign = help_campaign(N_ARCS, N_LAWS)};
    inject_walk(&(inject_case){.name = "journal, 130 appended",
                               .begin = begin_append,
                               .run = append_records,
                               .end = end_append,
                               .self = &k,
                               .stride = 1});
}

/* ---- reading ---- */

static fw_status read_all(void *self, fw_msg *m)
{
    keeping         *k = self;
    fw_record        r;
    fw_journal_facts facts;
    size_t           n;
    k->hash = 0;
    FW_TRY(fw_journal_facts_of(path, &facts, m));
    k->hash = inject_hash(facts.n_failed, &facts.host_cpu_s, sizeof facts.host_cpu_s);
    FW_TRY(fw_journal_open_read(&k->journal, path, &k->campaign, m));
    FW_TRY(fw_record_init(&r, N_ARCS, N_LAWS, m));
    const uint64_t *ids = fw_journal_ids(k->journal, &n);
    fw_status       status = FW_OK;
    for (size_t i = 0; i < n && status == FW_OK; i++) {
        status = fw_journal_read(k->journal, ids[i], &r, m);
        k->hash = inject_hash(k->hash, r.rings, fw_record_n_rings(N_ARCS, N_LAWS) * sizeof(double));
    }
    fw_record_free(&r);
    return status;
}

static uint64_t end_read(void *self, fw_status status)
{
    keeping *k = self;
    assert_ok(fw_journal_close(k->journal, &msg));
    k->journal = NULL;
    assert_untouched(k);
    return status == FW_OK ? k->hash : 0;
}

static void reading(void **state)
{
    (void)state;
    for (size_t n = 0; n <= 40; n += 40) {
        keeping k = {.campaign = help_campaign(N_ARCS, N_LAWS)};
        make_journal(&k, n, 99);
        inject_walk(&(inject_case){.name = n ? "journal of 40 records, read" : "journal of 0 records, read",
                                   .begin = begin,
                                   .run = read_all,
                                   .end = end_read,
                                   .self = &k,
                                   .stride = 1});
        free(k.before);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opening),
        cmocka_unit_test(appending),
        cmocka_unit_test(reading),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
