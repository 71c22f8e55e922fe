/* The journal keeps records bit for bit, drops a torn tail at whatever byte it is torn, and never writes over damage.
 * Expected values: the records themselves, made from their ids; sizes from the layout in journal_format.h. */

#include "journal_help.h"

/* A journal of records 0..n-1, closed. */
static void make(const char *path, uint64_t n)
{
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    remove_all(path);
    assert_ok(fw_journal_open(&j, path, &c, false, &msg));
    append_range(j, 0, n);
    assert_ok(fw_journal_close(j, &msg));
}

static void test_round_trip_in_any_order(void **state)
{
    (void)state;
    static const uint64_t ids[] = {3, 0, 1, 7, UINT64_MAX, 2, 5};
    fw_campaign           c = help_campaign(N_ARCS, N_LAWS);
    fw_journal           *j;
    size_t                n;
    assert_ok(fw_journal_open(&j, "a.journal", &c, false, &msg));
    assert_false(help_exists("a.journal.tmp"));
    fw_journal_ids(j, &n);
    assert_int_equal(n, 0);
    append(j, ids, 4);
    assert_record(j, 3); /* still in the buffer */
    assert_ok(fw_journal_flush(j, &msg));
    append(j, ids + 4, 3);
    assert_int_equal(fw_journal_prefix(j), 4);
    assert_record(j, UINT64_MAX);
    assert_ok(fw_journal_close(j, &msg));

    assert_ok(fw_journal_open(&j, "a.journal", &c, false, &msg));
    static const uint64_t sorted[] = {0, 1, 2, 3, 5, 7, UINT64_MAX};
    const uint64_t       *there = fw_journal_ids(j, &n);
    assert_int_equal(n, 7);
    assert_memory_equal(there, sorted, sizeof sorted);
    assert_int_equal(fw_journal_prefix(j), 4);
    for (size_t i = 0; i < 7; i++) assert_record(j, sorted[i]);
    append(j, (const uint64_t[]){4, 6}, 2);
    assert_int_equal(fw_journal_prefix(j), 8);
    fw_record r;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    assert_int_equal(fw_journal_read(j, 9, &r, &msg), FW_E_ARG);
    fw_record_free(&r);
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS + 1, &msg));
    assert_int_equal(fw_journal_read(j, 0, &r, &msg), FW_E_ARG);
    assert_int_equal(fw_journal_append(j, &r, &msg), FW_E_ARG);
    fw_record_free(&r);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_close(NULL, &msg));
}

static void test_commits_by_itself_after_100(void **state)
{
    (void)state;
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j, *reader;
    size_t      n;
    assert_ok(fw_journal_open(&j, "b.journal", &c, false, &msg));
    append_range(j, 0, 99);
    assert_ok(fw_journal_open_read(&reader, "b.journal", &c, &msg));
    fw_journal_ids(reader, &n);
    assert_int_equal(n, 0);
    assert_ok(fw_journal_close(reader, &msg));
    append_range(j, 99, 100);
    assert_ok(fw_journal_open_read(&reader, "b.journal", NULL, &msg));
    assert_range(reader, 100);
    fw_record r;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    assert_int_equal(fw_journal_append(reader, &r, &msg), FW_E_ARG);
    fw_record_free(&r);
    assert_ok(fw_journal_close(reader, &msg));
    append_range(j, 100, 350);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open(&j, "b.journal", &c, false, &msg));
    assert_range(j, 350);
    assert_ok(fw_journal_close(j, &msg));
}

static void test_torn_tail_at_every_byte(void **state)
{
    (void)state;
    make("c.journal", 3);
    fw_campaign    c = help_campaign(N_ARCS, N_LAWS);
    size_t         n, block = block_size();
    unsigned char *whole = help_load("c.journal", &n);
    assert_int_equal(n, header_size(&c) + 3 * block);
    for (size_t cut = 1; cut <= block; cut++) {
        fw_journal *j;
        help_save("c.journal", whole, n - cut);
        if (cut % 97 == 1) {
            assert_ok(fw_journal_open_read(&j, "c.journal", &c, &msg));
            assert_int_equal(fw_journal_torn(j), block - cut);
            assert_range(j, 2);
            assert_ok(fw_journal_close(j, &msg));
        }
        assert_ok(fw_journal_open(&j, "c.journal", &c, false, &msg));
        assert_int_equal(fw_journal_torn(j), block - cut);
        assert_range(j, 2);
        append_range(j, 2, 3);
        assert_ok(fw_journal_close(j, &msg));
        size_t         n_again;
        unsigned char *again = help_load("c.journal", &n_again);
        assert_int_equal(n_again, n);
        assert_memory_equal(again, whole, n);
        free(again);
    }
    /* The last block is there in full length but with other bytes: torn as well (zeros are what a power cut leaves). */
    for (size_t at = n - block; at < n; at += 13) {
        fw_journal   *j;
        unsigned char kept = whole[at];
        whole[at] ^= 0x10;
        help_save("c.journal", whole, n);
        whole[at] = kept;
        assert_ok(fw_journal_open(&j, "c.journal", &c, false, &msg));
        assert_range(j, 2);
        assert_ok(fw_journal_close(j, &msg));
    }
    free(whole);
}

static void assert_refused_untouched(const char *path, fw_status wanted)
{
    fw_campaign    c = help_campaign(N_ARCS, N_LAWS);
    size_t         n, n_after;
    fw_journal    *j;
    unsigned char *before = help_load(path, &n);
    assert_int_equal(fw_journal_open(&j, path, &c, false, &msg), wanted);
    assert_null(j);
    assert_non_null(strstr(msg.text, path));
    assert_int_equal(fw_journal_open_read(&j, path, &c, NULL), wanted);
    assert_null(j);
    unsigned char *after = help_load(path, &n_after);
    assert_int_equal(n, n_after);
    assert_memory_equal(before, after, n);
    free(before);
    free(after);
}

static void test_damage_in_the_middle(void **state)
{
    (void)state;
    make("d.journal", 5);
    fw_campaign    c = help_campaign(N_ARCS, N_LAWS);
    size_t         n, block = block_size(), head = header_size(&c);
    unsigned char *whole = help_load("d.journal", &n);
    for (size_t at = head; at < n - block; at += 29) {
        whole[at] ^= 0x01;
        help_save("d.journal", whole, n);
        whole[at] ^= 0x01;
        assert_refused_untouched("d.journal", FW_E_FORMAT);
    }
    /* the message names record and byte: here the third one, whose length field says something else */
    whole[head + 2 * block] ^= 0x01;
    help_save("d.journal", whole, n);
    assert_refused_untouched("d.journal", FW_E_FORMAT);
    char wanted[64];
    snprintf(wanted, sizeof wanted, "record number 3 at byte %zu", head + 2 * block);
    fw_journal *j;
    assert_int_equal(fw_journal_open(&j, "d.journal", &c, false, &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, wanted));
    free(whole);

    /* a byte lost in a long journal: all that follows is out of step, more than any crash can tear */
    make("d.journal", 150);
    whole = help_load("d.journal", &n);
    memmove(whole + head + 5, whole + head + 6, n - head - 6);
    help_save("d.journal", whole, n - 1);
    assert_refused_untouched("d.journal", FW_E_FORMAT);
    free(whole);
}

static void test_header_damage_and_foreign_files(void **state)
{
    (void)state;
    make("e.journal", 2);
    fw_campaign    c = help_campaign(N_ARCS, N_LAWS);
    fw_journal    *j;
    size_t         n, head = header_size(&c);
    unsigned char *whole = help_load("e.journal", &n);
    for (size_t at = 0; at < head - 12; at++) {
        whole[at] ^= 0x04;
        help_save("e.journal", whole, n);
        whole[at] ^= 0x04;
        assert_refused_untouched("e.journal", FW_E_FORMAT);
    }
    for (size_t size = 0; size < head; size++) {
        help_save("e.journal", whole, size);
        assert_refused_untouched("e.journal", FW_E_FORMAT);
    }
    /* the slot is outside: damage there costs the total only, and the next call writes it anew */
    fw_journal_facts facts;
    whole[head - 12] ^= 0x04;
    help_save("e.journal", whole, n);
    assert_ok(fw_journal_facts_of("e.journal", &facts, &msg));
    assert_int_equal(facts.max_realisations, 0);
    assert_int_equal(facts.n_done, 2);
    c.precision.max_realisations = 4000;
    assert_ok(fw_journal_open(&j, "e.journal", &c, false, &msg));
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_facts_of("e.journal", &facts, &msg));
    assert_int_equal(facts.max_realisations, 4000);
    free(whole);

    help_save("e.journal", (const unsigned char *)"name: small\n", 12);
    assert_refused_untouched("e.journal", FW_E_FORMAT);
    unlink("e.journal");
    assert_int_equal(mkfifo("e.journal", 0600), 0);
    assert_int_equal(fw_journal_open_read(&j, "e.journal", &c, &msg), FW_E_FORMAT);
    assert_int_equal(fw_journal_open(&j, "e.journal", &c, false, &msg), FW_E_FORMAT);
    unlink("e.journal");
    assert_int_equal(mkdir("e.journal", 0700), 0);
    assert_int_equal(fw_journal_open(&j, "e.journal", &c, false, &msg), FW_E_IO);
    assert_int_equal(rmdir("e.journal"), 0);
}

static void test_unwritable_places(void **state)
{
    (void)state;
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    assert_int_equal(fw_journal_open(&j, "missing-folder/x.journal", &c, false, &msg), FW_E_IO);
    assert_non_null(strstr(msg.text, "missing-folder/x.journal"));
    help_save("plain", (const unsigned char *)"x", 1);
    assert_int_equal(fw_journal_open(&j, "plain/x.journal", &c, false, &msg), FW_E_IO);
    assert_int_equal(fw_journal_open(&j, "plain/x.journal", &c, true, &msg), FW_E_IO);
    assert_int_equal(fw_journal_open(&j, "", &c, false, &msg), FW_E_IO);
    assert_int_equal(fw_journal_open_read(&j, "nothing.journal", &c, &msg), FW_E_IO);
    assert_false(help_exists("nothing.journal"));
    fw_journal_facts facts;
    assert_int_equal(fw_journal_facts_of("nothing.journal", &facts, &msg), FW_E_IO);
}

static void test_mismatch_names_the_settings(void **state)
{
    (void)state;
    make("f.journal", 2);
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    char        other[] = "contact.friction = 0.2\ncontact.stiffness = 2e6 N/m\ncurrent.speed = 1.5 m/s\nseed = 7\n";
    c.settings = other;
    c.hash = 0x999;
    assert_int_equal(fw_journal_open(&j, "f.journal", &c, false, &msg), FW_E_MISMATCH);
    assert_non_null(strstr(msg.text, "f.journal"));
    assert_non_null(strstr(msg.text, "current.speed (journal: 2 m/s, campaign: 1.5 m/s)"));
    assert_non_null(strstr(msg.text, "ice.density (journal: 900 kg/m3, campaign: nothing)"));
    assert_non_null(strstr(msg.text, "contact.friction (journal: nothing, campaign: 0.2)"));
    assert_null(strstr(msg.text, "stiffness"));
    assert_null(strstr(msg.text, "seed"));
    assert_int_equal(fw_journal_open_read(&j, "f.journal", &c, &msg), FW_E_MISMATCH);

    /* at most five, and long values are cut */
    char many[4096] = "";
    for (int i = 0; i < 20; i++) {
        snprintf(many + strlen(many), sizeof many - strlen(many), "key%d = %0100d\n", i, i);
    }
    c.settings = many;
    assert_int_equal(fw_journal_open(&j, "f.journal", &c, false, &msg), FW_E_MISMATCH);
    assert_non_null(strstr(msg.text, "and 19 more")); /* 20 new and 4 missing ones, five named */
    assert_null(strstr(msg.text, "key1 "));

    /* the same text under another seed or hash */
    c = help_campaign(N_ARCS, N_LAWS);
    c.seed = 8;
    assert_int_equal(fw_journal_open(&j, "f.journal", &c, false, &msg), FW_E_MISMATCH);
    assert_non_null(strstr(msg.text, "seed 7"));
    assert_non_null(strstr(msg.text, "seed 8"));

    /* nothing was changed by all this; --fresh keeps the old one beside the new one */
    assert_ok(fw_journal_open_read(&j, "f.journal", NULL, &msg));
    assert_range(j, 2);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open(&j, "f.journal", &c, true, &msg));
    assert_range(j, 0);
    append_range(j, 0, 1);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open_read(&j, "f.journal.old", NULL, &msg));
    assert_range(j, 2);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open_read(&j, "f.journal", &c, &msg));
    assert_range(j, 1);
    assert_ok(fw_journal_close(j, &msg));
}

static void test_lock(void **state)
{
    (void)state;
    remove_all("g.journal");
    fw_campaign      c = help_campaign(N_ARCS, N_LAWS);
    fw_journal      *j, *second;
    fw_journal_facts facts;
    assert_ok(fw_journal_open(&j, "g.journal", &c, false, &msg)); /* new: the lock came along through the rename */
    assert_int_equal(fw_journal_open(&second, "g.journal", &c, false, &msg), FW_E_IO);
    assert_non_null(strstr(msg.text, "another run"));
    assert_int_equal(fw_journal_open(&second, "g.journal", &c, true, &msg), FW_E_IO);
    assert_false(help_exists("g.journal.old"));
    append_range(j, 0, 9);
    assert_ok(fw_journal_flush(j, &msg));
    assert_ok(fw_journal_facts_of("g.journal", &facts, &msg));
    assert_true(facts.is_running);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open(&j, "g.journal", &c, false, &msg)); /* old: locked afresh */
    assert_int_equal(fw_journal_open(&second, "g.journal", &c, false, &msg), FW_E_IO);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_facts_of("g.journal", &facts, &msg));
    assert_false(facts.is_running);
    assert_string_equal(facts.name, "small");
    assert_int_equal(facts.hash, 0x1234);
    assert_int_equal(facts.seed, 7);
    assert_int_equal(facts.max_realisations, 50);
    assert_int_equal(facts.n_done, 9);
    assert_int_equal(facts.n_failed, 1); /* id 6 */
    assert_int_equal(facts.prefix, 9);
    assert_int_equal(facts.torn_bytes, 0);
    assert_int_equal(facts.n_arcs, N_ARCS);
    assert_int_equal(facts.n_laws, N_LAWS);
    assert_true(facts.host_cpu_s == 9 * 0.25);
}

static void test_one_id_twice(void **state)
{
    (void)state;
    make("h.journal", 3);
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    fw_record   r;
    size_t      n;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    assert_ok(fw_journal_open(&j, "h.journal", &c, false, &msg));
    help_fill(&r, 1);
    r.host_cpu_s = 99.0; /* another machine: the same record */
    assert_ok(fw_journal_append(j, &r, &msg));
    assert_record(j, 1); /* the first one counts */
    fw_journal_ids(j, &n);
    assert_int_equal(n, 3);
    r.rings[5] = nextafter(r.rings[5], INFINITY);
    assert_int_equal(fw_journal_append(j, &r, &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, "realisation 1"));
    assert_ok(fw_journal_close(j, &msg));

    /* in a file, as two runs that were pasted together would leave it */
    fw_campaign    same = help_campaign(N_ARCS, N_LAWS);
    size_t         head = header_size(&same), block = block_size();
    unsigned char *bytes = help_load("h.journal", &n);
    assert_int_equal(n, head + 3 * block);
    unsigned char *twice = malloc(n + block);
    assert_non_null(twice);
    memcpy(twice, bytes, n);
    memcpy(twice + n, bytes + head, block);
    help_save("h.journal", twice, n + block);
    assert_ok(fw_journal_open(&j, "h.journal", &c, false, &msg));
    assert_range(j, 3);
    append_range(j, 3, 4); /* lands behind the superfluous block */
    assert_range(j, 4);
    assert_ok(fw_journal_close(j, &msg));
    assert_ok(fw_journal_open(&j, "h.journal", &c, false, &msg));
    assert_range(j, 4);
    assert_ok(fw_journal_close(j, &msg));

    unsigned char *last = twice + n; /* other bits under a right checksum */
    last[16 + 250] ^= 0x01;
    uint32_t crc = fw_crc32c(0, last, block - 4);
    for (int i = 0; i < 4; i++) last[block - 4 + (size_t)i] = (unsigned char)(crc >> (8 * i));
    help_save("h.journal", twice, n + block);
    assert_int_equal(fw_journal_open(&j, "h.journal", &c, false, &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, "twice"));
    free(bytes);
    free(twice);
    fw_record_free(&r);
}

/* A failed realisation that was run again with another outcome: the later one counts, also after a kill and for who reads only. */
static void test_failed_one_run_again(void **state)
{
    (void)state;
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    fw_record   good, r;
    size_t      n;
    remove_all("f.journal");
    assert_ok(fw_record_init(&good, N_ARCS, N_LAWS, &msg));
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    help_fill(&good, 100), good.id = 6; /* 6 fails in help_fill, 100 does not */
    assert_ok(fw_journal_open(&j, "f.journal", &c, false, &msg));
    append_range(j, 0, 8);
    append(j, (const uint64_t[]){6}, 1); /* the same failure again: nothing new */
    assert_ok(fw_journal_append(j, &good, &msg));
    assert_ok(fw_journal_append(j, &good, &msg));
    for (int opened = 0; opened < 3; opened++) {
        fw_journal_ids(j, &n);
        assert_true(n == 8 && fw_journal_prefix(j) == 8);
        assert_ok(fw_journal_read(j, 6, &r, &msg));
        help_assert_same(&r, &good);
        assert_record(j, 5);
        assert_record(j, 7);
        if (opened < 2) {
            assert_ok(fw_journal_close(j, &msg));
            assert_ok(opened ? fw_journal_open_read(&j, "f.journal", &c, &msg) : fw_journal_open(&j, "f.journal", &c, false, &msg));
        }
    }
    assert_ok(fw_journal_close(j, &msg));
    fw_journal_facts facts;
    assert_ok(fw_journal_facts_of("f.journal", &facts, &msg));
    assert_true(facts.n_done == 8 && facts.n_failed == 0);
    /* the other way round is a fault: what succeeded is a pure function */
    assert_ok(fw_journal_open(&j, "f.journal", &c, false, &msg));
    assert_int_equal(fw_journal_append(j, (help_fill(&r, 6), &r), &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, "twice"));
    fw_journal_close(j, &msg);
    fw_record_free(&good);
    fw_record_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip_in_any_order),
        cmocka_unit_test(test_commits_by_itself_after_100),
        cmocka_unit_test(test_torn_tail_at_every_byte),
        cmocka_unit_test(test_damage_in_the_middle),
        cmocka_unit_test(test_header_damage_and_foreign_files),
        cmocka_unit_test(test_unwritable_places),
        cmocka_unit_test(test_mismatch_names_the_settings),
        cmocka_unit_test(test_lock),
        cmocka_unit_test(test_one_id_twice),
        cmocka_unit_test(test_failed_one_run_again),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
