/* Results files of made-up records, written and looked at. */
#ifndef FW_TESTS_STORE_RESULTS_HELP_H
#define FW_TESTS_STORE_RESULTS_HELP_H

#include "store/results.h"
#include "store_help.h"

static inline fw_status read_made(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    const uint64_t *fails_at = self;
    if (fails_at != NULL && id == *fails_at) return fw_fail(m, FW_E_FORMAT, "the journal is broken at %d", (int)id);
    help_fill(r, id);
    return FW_OK;
}

static inline fw_status write_made(const char *path, size_t n_arcs, size_t n_laws, uint64_t n)
{
    fw_campaign      c = help_campaign(n_arcs, n_laws);
    fw_record_source s = {.n = n, .read = read_made};
    return fw_results_write(path, &c, &s, 0, NULL, &msg);
}

static inline void assert_record(const fw_record_source *s, size_t n_arcs, size_t n_laws, uint64_t id)
{
    fw_record r, wanted;
    assert_ok(fw_record_init(&r, n_arcs, n_laws, &msg));
    assert_ok(fw_record_init(&wanted, n_arcs, n_laws, &msg));
    help_fill(&wanted, id);
    assert_ok(s->read(s->self, id, &r, &msg));
    help_assert_same(&r, &wanted);
    fw_record_free(&r);
    fw_record_free(&wanted);
}

#endif
