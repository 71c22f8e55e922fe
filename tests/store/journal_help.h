/* Journals of made-up records for the journal tests. */
#ifndef FW_TESTS_JOURNAL_HELP_H
#define FW_TESTS_JOURNAL_HELP_H

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

#include "base/hash.h"
#include "store/journal.h"
#include "store_help.h"

enum { N_ARCS = 72, N_LAWS = 1 };

static void remove_all(const char *path)
{
    char other[64];
    unlink(path);
    snprintf(other, sizeof other, "%s.old", path);
    unlink(other);
}

static void append(fw_journal *j, const uint64_t *ids, size_t n)
{
    fw_record r;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    for (size_t i = 0; i < n; i++) {
        help_fill(&r, ids[i]);
        assert_ok(fw_journal_append(j, &r, &msg));
    }
    fw_record_free(&r);
}

static void append_range(fw_journal *j, uint64_t first, uint64_t end)
{
    for (uint64_t id = first; id < end; id++) append(j, &id, 1);
}

static void assert_record(fw_journal *j, uint64_t id)
{
    fw_record r, wanted;
    assert_ok(fw_record_init(&r, N_ARCS, N_LAWS, &msg));
    assert_ok(fw_record_init(&wanted, N_ARCS, N_LAWS, &msg));
    help_fill(&wanted, id);
    assert_ok(fw_journal_read(j, id, &r, &msg));
    help_assert_same(&r, &wanted);
    fw_record_free(&r);
    fw_record_free(&wanted);
}

static void assert_range(fw_journal *j, uint64_t end)
{
    size_t          n;
    const uint64_t *ids = fw_journal_ids(j, &n);
    assert_int_equal(n, end);
    assert_int_equal(fw_journal_prefix(j), end);
    for (uint64_t id = 0; id < end; id++) {
        assert_true(ids[id] == id);
        assert_record(j, id);
    }
}

static size_t header_size(const fw_campaign *c) { return 128 + strlen(c->settings) + 4 + 12; }

static size_t block_size(void) { return 16 + fw_record_packed_size(N_ARCS, N_LAWS) + 4; }


#endif
