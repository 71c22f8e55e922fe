/* Records that a results file lends are those that it holds bit for bit, whatever the order they are asked for in; ids need only ascend.
 * Expected values: the records themselves, made from their ids. */
#include "h5_help.h"
#include "results_help.h"

/* To the end from a place that may be within a block. */
static void assert_lent(const fw_record_source *s, size_t n_arcs, size_t n_laws, uint64_t from)
{
    fw_record        r, wanted;
    const fw_record *lent;
    size_t           n;
    assert_ok(fw_record_init(&r, n_arcs, n_laws, &msg));
    assert_ok(fw_record_init(&wanted, n_arcs, n_laws, &msg));
    for (uint64_t at = from; at < s->n; at += n) {
        assert_ok(fw_records_lend(s, at, &r, &lent, &n, &msg));
        assert_true(n >= 1 && at + n <= s->n);
        for (size_t i = 0; i < n; i++) {
            help_fill(&wanted, at + i);
            assert_true(lent[i].n_arcs == n_arcs && lent[i].n_laws == n_laws);
            help_assert_same(&lent[i], &wanted);
        }
    }
    fw_record_free(&r);
    fw_record_free(&wanted);
}

static void test_lent(void **state)
{
    (void)state;
    fw_results      *r;
    const fw_record *lent;
    size_t           n;
    assert_ok(write_made("r.h5", 3000, 2, 107)); /* blocks of 21 rows */
    assert_ok(fw_results_open(&r, "r.h5", &msg));
    fw_record_source s = fw_results_records(r), one_by_one = s;
    one_by_one.lend = NULL;
    assert_lent(&s, 3000, 2, 0);
    assert_lent(&one_by_one, 3000, 2, 0);
    assert_lent(&s, 3000, 2, 30);
    assert_ok(s.lend(s.self, 21, &lent, &n, &msg));
    assert_record(&s, 3000, 2, 100);
    assert_ok(s.lend(s.self, 42, &lent, &n, &msg));
    assert_lent(&s, 3000, 2, 0);
    assert_int_equal(s.lend(s.self, 107, &lent, &n, &msg), FW_E_ARG);
    fw_results_close(r);
}

/* A status that there is none of, in a sealed file: the block that its record lies in is refused, those round it are lent. */
static void test_a_row_that_makes_no_sense(void **state)
{
    (void)state;
    int32_t          statuses[107] = {[50] = FW_N_STATUS}; /* in the third block of 21 rows */
    fw_results      *r;
    const fw_record *lent;
    size_t           n = 0;
    assert_ok(write_made("u.h5", 3000, 1, 107));
    hid_t file = H5Fopen("u.h5", H5F_ACC_RDWR, H5P_DEFAULT), dataset = H5Dopen2(file, "/realisations/status", H5P_DEFAULT);
    assert_true(H5Dwrite(dataset, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, statuses) >= 0);
    H5Dclose(dataset);
    assert_true(H5Fclose(file) >= 0);
    help_seal_again("u.h5");
    assert_ok(fw_results_open(&r, "u.h5", &msg));
    fw_record_source s = fw_results_records(r);
    assert_ok(s.lend(s.self, 21, &lent, &n, &msg));
    assert_int_equal(n, 21);
    assert_int_equal(s.lend(s.self, 42, &lent, &n, &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, "u.h5: realisation 50 has the unknown status"));
    assert_ok(s.lend(s.self, 51, &lent, &n, &msg));
    assert_int_equal(n, 12);
    fw_results_close(r);
}

/* Scalars cross their own blocks of 8192 rows. */
static void test_many(void **state)
{
    (void)state;
    fw_results *r;
    assert_ok(write_made("s.h5", 3, 1, 8192 + 1500));
    assert_ok(fw_results_open(&r, "s.h5", &msg));
    fw_record_source s = fw_results_records(r);
    assert_lent(&s, 3, 1, 0);
    assert_record(&s, 3, 1, 8191);
    assert_record(&s, 3, 1, 8192);
    fw_results_close(r);
}

/* Ids 7, 8, 9 and 12 of a campaign. */
static fw_status read_part(void *self, uint64_t index, fw_record *r, fw_msg *m)
{
    (void)self, (void)m;
    help_fill(r, index < 3 ? 7 + index : 9 + index);
    return FW_OK;
}

static fw_status read_falling(void *self, uint64_t index, fw_record *r, fw_msg *m)
{
    (void)self, (void)m;
    help_fill(r, index == 2 ? 7 : 7 + index);
    return FW_OK;
}

static void test_any_ascending_ids(void **state)
{
    (void)state;
    fw_campaign      c = help_campaign(72, 1);
    fw_record_source part = {.n = 4, .read = read_part}, falling = {.n = 4, .read = read_falling};
    fw_results      *r;
    uint64_t         ids[4];
    const uint64_t   wanted[] = {7, 8, 9, 12};
    fw_record        there, made;
    assert_ok(fw_results_write("p.h5", &c, &part, 0, NULL, &msg));
    assert_ok(fw_results_open(&r, "p.h5", &msg));
    fw_record_source s = fw_results_records(r);
    assert_int_equal(s.n, 4);
    assert_true(s.span.first == 7 && s.span.end == 13 && s.span.gap_first == 10 && s.span.gap_end == 12);
    assert_ok(fw_results_ids(r, ids, &msg));
    assert_memory_equal(ids, wanted, sizeof wanted);
    assert_ok(fw_record_init(&there, 72, 1, &msg));
    assert_ok(fw_record_init(&made, 72, 1, &msg));
    for (uint64_t i = 0; i < 4; i++) {
        assert_ok(s.read(s.self, i, &there, &msg));
        help_fill(&made, wanted[i]);
        help_assert_same(&there, &made);
    }
    fw_record_free(&there);
    fw_record_free(&made);
    fw_results_close(r);
    assert_int_equal(fw_results_write("p.h5", &c, &falling, 0, NULL, &msg), FW_E_INTERNAL);
    assert_string_equal(msg.text, "realisation 7 was given after 8");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lent),
        cmocka_unit_test(test_a_row_that_makes_no_sense),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_any_ascending_ids),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
