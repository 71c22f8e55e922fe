/* NAME.h5 gives records back bit for bit, is the same file for the same campaign, survives a full disk as it was, and
 * damaged or foreign files are refused without a crash.
 * Expected values: the records themselves, made from their ids; HDF5's own view of the file; unit and exponent texts
 * from the description in results.h. */
#include <errno.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "h5_help.h"
#include "results_help.h"

static void test_round_trip(void **state)
{
    (void)state;
    /* 3000 arcs: blocks of 21 rows, so that blocks and their ends are crossed; 72 arcs: one short block */
    static const struct {
        size_t   n_arcs, n_laws;
        uint64_t n;
    } cases[] = {{72, 1, 0}, {72, 1, 1}, {72, 4, 50}, {3000, 2, 21}, {3000, 1, 22}, {3000, 1, 107}, {1, 1, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        size_t      n_arcs = cases[i].n_arcs, n_laws = cases[i].n_laws;
        fw_results *r;
        assert_ok(write_made("a.h5", n_arcs, n_laws, cases[i].n));
        assert_false(help_exists("a.h5.tmp"));
        assert_ok(fw_results_open(&r, "a.h5", &msg));
        fw_record_source s = fw_results_records(r);
        assert_int_equal(s.n, cases[i].n);
        for (uint64_t id = 0; id < s.n; id++) assert_record(&s, n_arcs, n_laws, id);
        for (uint64_t id = s.n; id-- > 0;) assert_record(&s, n_arcs, n_laws, id);
        fw_record other;
        assert_ok(fw_record_init(&other, n_arcs, n_laws, &msg));
        assert_int_equal(s.read(s.self, s.n, &other, &msg), FW_E_ARG);
        fw_record_free(&other);
        assert_ok(fw_record_init(&other, n_arcs + 1, n_laws, &msg));
        if (s.n > 0) assert_int_equal(s.read(s.self, 0, &other, &msg), FW_E_FORMAT);
        fw_record_free(&other);
        fw_results_close(r);
    }
    fw_results_close(NULL);
}

static void test_campaign_comes_back(void **state)
{
    (void)state;
    fw_campaign      c = help_campaign(72, 1);
    fw_record_source s = {.n = 2, .read = read_made};
    char             first[] = "ice.concentration=60%", second[] = "name=\xc3\xa4", *sets[] = {first, second};
    size_t           length = 300000; /* beyond HDF5's 64 KiB limit for compact attributes */
    char            *text = malloc(length + 1);
    assert_non_null(text);
    memset(text, '#', length);
    text[length] = '\0';
    c.text = text;
    c.sets = sets;
    c.n_sets = 2;
    c.seed = INT64_MAX;
    assert_ok(fw_results_write("b.h5", &c, &s, 0, NULL, &msg));
    fw_results        *r;
    const char *const *there;
    assert_ok(fw_results_open(&r, "b.h5", &msg));
    assert_string_equal(fw_results_campaign_text(r), text);
    assert_int_equal(fw_results_sets(r, &there), 2);
    assert_string_equal(there[0], first);
    assert_string_equal(there[1], second);
    assert_true(fw_results_seed(r) == INT64_MAX);
    fw_results_close(r);
    free(text);

    c = help_campaign(72, 1);
    c.text = NULL; /* a campaign that came from no file */
    assert_ok(fw_results_write("b.h5", &c, &s, 0, NULL, &msg));
    assert_ok(fw_results_open(&r, "b.h5", &msg));
    assert_string_equal(fw_results_campaign_text(r), "");
    assert_int_equal(fw_results_sets(r, &there), 0);
    assert_true(fw_results_seed(r) == 7);
    fw_results_close(r);
}

static void assert_text(hid_t file, const char *object, const char *name, const char *wanted)
{
    hid_t at = H5Oopen(file, object, H5P_DEFAULT), attribute = H5Aopen(at, name, H5P_DEFAULT),
          type = H5Aget_type(attribute);
    char *text = NULL;
    assert_true(H5Aread(attribute, type, &text) >= 0);
    assert_string_equal(text, wanted);
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    H5Oclose(at);
}

static void read_all(hid_t file, const char *name, hid_t type, void *to)
{
    hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    assert_true(dataset >= 0);
    assert_true(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0);
    H5Dclose(dataset);
}

static void test_seen_with_hdf5(void **state)
{
    (void)state;
    double            depth[] = {0.5, NAN, -0.0};
    int64_t           point[] = {1, 2, INT64_MIN};
    const char *const method[] = {"order statistics", NULL, "sectioning"};
    fw_column         columns[] = {
                {.name = "depth_mm", .unit = "mm", .long_name = "design depth", .number = depth},
                {.name = "point", .integer = point}, /* unit and long name left out */
                {.name = "method", .unit = "1", .long_name = "kind of interval", .text = method},
    };
    fw_table         tables[] = {{.name = "percentiles", .n_rows = 3, .n_columns = 3, .columns = columns},
                                 {.name = "service_life", .n_rows = 0, .n_columns = 3, .columns = columns},
                                 {.name = "empty", .n_rows = 0, .n_columns = 0}};
    fw_campaign      c = help_campaign(72, 2);
    fw_record_source s = {.n = 9, .read = read_made};
    assert_ok(fw_results_write("c.h5", &c, &s, 3, tables, &msg));

    help_census census = help_take_census("c.h5");
    assert_int_equal(census.n_datasets, fw_n_record_columns + 3 + 1 + 3 + 1 + 6);
    assert_int_equal(census.n_bare, 0);
    assert_int_equal(census.n_timed, 0);

    hid_t file = H5Fopen("c.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    assert_text(file, "/", "filetype", "floewear results");
    assert_text(file, "/realisations/wear_load", "units", "MPa^1.121 km; MPa^1 km");
    assert_text(file, "/realisations/wear_load_high", "units", "MPa^1.121 km; MPa^1 km");
    assert_text(file, "/realisations/path", "units", "km");
    assert_text(file, "/realisations/angle_deg", "units", "degree");
    assert_text(file, "/percentiles/depth_mm", "units", "mm");
    assert_text(file, "/percentiles/point", "units", "1");
    assert_text(file, "/percentiles/point", "long_name", "point");
    double  angles[72], back[3], load[9][2][72];
    int64_t points[3];
    char    methods[3][16];
    read_all(file, "/realisations/angle_deg", H5T_NATIVE_DOUBLE, angles);
    assert_true(angles[0] == 2.5 && angles[71] == 357.5); /* middles of arcs of 5 degrees */
    read_all(file, "/realisations/wear_load", H5T_NATIVE_DOUBLE, load);
    fw_record r;
    assert_ok(fw_record_init(&r, 72, 2, &msg));
    help_fill(&r, 5);
    assert_memory_equal(load[5][1], fw_record_load(&r, 1, FW_RING_LOAD), sizeof load[5][1]);
    fw_record_free(&r);
    read_all(file, "/percentiles/depth_mm", H5T_NATIVE_DOUBLE, back);
    assert_memory_equal(back, depth, sizeof depth);
    read_all(file, "/percentiles/point", H5T_NATIVE_INT64, points);
    assert_memory_equal(points, point, sizeof point);
    hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 16);
    H5Tset_cset(text, H5T_CSET_UTF8);
    H5Tset_strpad(text, H5T_STR_NULLPAD);
    read_all(file, "/percentiles/method", text, methods);
    assert_memory_equal(methods[0], "order statistics", 16);
    assert_memory_equal(methods[1], "\0\0", 2);
    assert_memory_equal(methods[2], "sectioning\0", 11);
    H5Tclose(text);
    H5Fclose(file);

    /* one exponent for both laws is said once */
    c.model.laws[1].exponent = c.model.laws[0].exponent;
    assert_ok(fw_results_write("c.h5", &c, &s, 0, NULL, &msg));
    file = H5Fopen("c.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_text(file, "/realisations/wear_load", "units", "MPa^1.121 km");
    H5Fclose(file);

    columns[0].integer = point; /* two kinds at once */
    assert_int_equal(fw_results_write("c2.h5", &c, &s, 3, tables, &msg), FW_E_ARG);
    assert_false(help_exists("c2.h5") || help_exists("c2.h5.tmp"));
}

static void test_same_file_twice(void **state)
{
    (void)state;
    /* Only host_wall_time may differ, and within one second it does not: then the files are equal byte for byte. */
    for (int i = 0; i < 5; i++) {
        size_t n, n_again;
        assert_ok(write_made("d.h5", 360, 1, 30));
        unsigned char *bytes = help_load("d.h5", &n);
        assert_ok(write_made("d.h5", 360, 1, 30));
        unsigned char *again = help_load("d.h5", &n_again);
        bool           is_same = n == n_again && memcmp(bytes, again, n) == 0;
        assert_int_equal(n, n_again);
        free(bytes);
        free(again);
        if (is_same) return;
    }
    fail_msg("five pairs of files all differ");
}

static void assert_intact(const char *path, uint64_t n)
{
    char temporary[64];
    snprintf(temporary, sizeof temporary, "%s.tmp", path);
    assert_false(help_exists(temporary));
    fw_results *r;
    assert_ok(fw_results_open(&r, path, &msg));
    fw_record_source s = fw_results_records(r);
    assert_int_equal(s.n, n);
    for (uint64_t id = 0; id < n; id++) assert_record(&s, 72, 1, id);
    fw_results_close(r);
}

static void test_failing_source_leaves_the_old_file(void **state)
{
    (void)state;
    assert_ok(write_made("e.h5", 72, 1, 5));
    fw_campaign      c = help_campaign(72, 1);
    uint64_t         at = 1500; /* in the second block of 910 */
    fw_record_source s = {.n = 2000, .read = read_made, .self = &at};
    assert_int_equal(fw_results_write("e.h5", &c, &s, 0, NULL, &msg), FW_E_FORMAT);
    assert_string_equal(msg.text, "the journal is broken at 1500");
    assert_intact("e.h5", 5);
    c.model.n_laws = 0;
    assert_int_equal(fw_results_write("e.h5", &c, &s, 0, NULL, &msg), FW_E_ARG);
    assert_intact("e.h5", 5);
}

static void test_unwritable_places(void **state)
{
    (void)state;
    assert_int_equal(write_made("missing-folder/x.h5", 72, 1, 2), FW_E_IO);
    assert_non_null(strstr(msg.text, "missing-folder/x.h5"));
    help_save("plain", (const unsigned char *)"x", 1);
    assert_int_equal(write_made("plain/x.h5", 72, 1, 2), FW_E_IO);
    assert_int_equal(mkdir("folder.h5", 0700), 0);
    assert_int_equal(write_made("folder.h5", 72, 1, 2), FW_E_IO); /* found out by rename */
    assert_false(help_exists("folder.h5.tmp"));
    fw_results *r;
    assert_int_equal(fw_results_open(&r, "folder.h5", &msg), FW_E_FORMAT);
    assert_int_equal(fw_results_open(&r, "nothing.h5", &msg), FW_E_IO);
    assert_int_equal(fw_results_open(&r, "plain", &msg), FW_E_FORMAT);
    assert_null(r);
}

static int write_under_limit(size_t limit)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct rlimit l = {.rlim_cur = limit, .rlim_max = limit};
        signal(SIGXFSZ, SIG_IGN); /* write then says EFBIG after a short write, as ENOSPC comes from a full disk */
        if (setrlimit(RLIMIT_FSIZE, &l) != 0) _exit(99);
        fw_status status = write_made("f.h5", 72, 1, 60);
        bool      says = strstr(msg.text, "f.h5") != NULL && strstr(msg.text, strerror(EFBIG)) != NULL;
        _exit(status == FW_OK ? 0 : status == FW_E_IO && says ? 1 : 2); /* exit handlers of HDF5 run in other tests */
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void test_full_disk(void **state)
{
    (void)state;
    size_t n;
    assert_ok(write_made("f.h5", 72, 1, 60));
    free(help_load("f.h5", &n));
    assert_ok(write_made("f.h5", 72, 1, 4));
    for (size_t limit = 1; limit < n; limit += limit < 3000 ? 401 : n / 23) { /* head, metadata, chunks, and the seal */
        assert_int_equal(write_under_limit(limit), 1);
        assert_intact("f.h5", 4);
    }
    assert_int_equal(write_under_limit(n - 1), 1);
    assert_intact("f.h5", 4);
    assert_int_equal(write_under_limit(2 * n), 0); /* room to spare: HDF5 gives some back at the end */
    assert_intact("f.h5", 60);
}

static void test_damaged_files(void **state)
{
    (void)state;
    fw_results *r;
    size_t      n;
    uint64_t    chaos = 7;
    assert_ok(write_made("g.h5", 72, 1, 20));
    unsigned char *whole = help_load("g.h5", &n);
    for (size_t i = 0; i < 400; i++) { /* cut: near both ends byte by byte, elsewhere anywhere */
        size_t size = i < 100 ? i : i < 200 ? n - (i - 99) : help_next(&chaos) % n;
        help_save("g.h5", whole, size);
        assert_int_equal(fw_results_open(&r, "g.h5", &msg), FW_E_FORMAT);
        assert_null(r);
        assert_non_null(strstr(msg.text, "g.h5"));
    }
    for (size_t i = 0; i < 600; i++) {
        size_t at = help_next(&chaos) % n;
        if (i % 3 == 0) at = at % 2000; /* superblock and headers more often */
        unsigned char kept = whole[at], change = (unsigned char)(1 + help_next(&chaos) % 255);
        whole[at] ^= change;
        help_save("g.h5", whole, n);
        whole[at] = kept;
        assert_int_equal(fw_results_open(&r, "g.h5", &msg), FW_E_FORMAT);
        assert_null(r);
    }
    help_save("g.h5", whole, n);
    assert_ok(fw_results_open(&r, "g.h5", &msg));
    fw_results_close(r);
    free(whole);
}

/* Replace one dataset by another kind of thing and seal the file again: what comes behind the seal must hold too. */
static fw_status open_with(const char *dataset, hid_t type, int rank, const hsize_t *dims)
{
    fw_results *r;
    char        name[96];
    assert_ok(write_made("h.h5", 72, 1, 20));
    hid_t file = H5Fopen("h.h5", H5F_ACC_RDWR, H5P_DEFAULT);
    snprintf(name, sizeof name, "/realisations/%s", dataset);
    assert_true(file >= 0 && H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    if (rank >= 0) {
        hid_t   list = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(rank, dims, NULL);
        hsize_t chunk[4] = {20, 1, 72, 1};
        if (rank == 1) chunk[0] = dims[0] < 20 ? dims[0] : 20;
        if (rank == 0) H5Sclose(space), space = H5Screate(H5S_SCALAR);
        if (rank == 2) chunk[1] = 72;
        for (int i = 0; i < rank; i++) chunk[i] = chunk[i] < dims[i] ? chunk[i] : dims[i];
        if (rank > 0) H5Pset_chunk(list, rank, chunk);
        hid_t made = H5Dcreate2(file, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT);
        assert_true(made >= 0);
        H5Dclose(made);
        H5Sclose(space);
        H5Pclose(list);
    }
    assert_true(H5Fclose(file) >= 0);
    help_seal_again("h.h5");
    fw_status status = fw_results_open(&r, "h.h5", &msg);
    assert_true(status != FW_OK || r != NULL);
    if (status == FW_OK) fw_results_close(r);
    return status;
}

static void test_hostile_shapes(void **state)
{
    (void)state;
    const hsize_t huge[] = {UINT64_C(1) << 60, 1, 72}, n20[] = {20}, n19[] = {19}, wide[] = {20, 1, UINT64_C(1) << 40},
                  laws[] = {20, 5, 72}, path[] = {20, 72}, short_path[] = {20, 71}, right[] = {20, 1, 72};
    static const char *const names[] = {
        "id",        "status",           "cause",          "speed",    "host_cpu_s", "path",
        "wear_load", "wear_load_impact", "wear_load_high", "angle_deg"};
    hid_t growing = H5Tcopy(H5T_C_S1);
    H5Tset_size(growing, H5T_VARIABLE);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_int_equal(open_with(names[i], 0, -1, NULL), FW_E_FORMAT); /* missing */
        assert_int_equal(open_with(names[i], H5T_IEEE_F64LE, 0, NULL), FW_E_FORMAT);
        assert_int_equal(open_with(names[i], growing, 1, n20), FW_E_FORMAT);
        assert_int_equal(open_with(names[i], H5T_IEEE_F64LE, 1, huge), FW_E_FORMAT);
        assert_int_equal(open_with(names[i], H5T_STD_I64LE, 1, n19), FW_E_FORMAT);
    }
    assert_int_equal(open_with("id", H5T_STD_U64LE, 1, huge), FW_E_FORMAT);
    assert_int_equal(open_with("id", H5T_STD_U64LE, 1, n20), FW_E_FORMAT); /* all zero */
    assert_int_equal(open_with("wear_load", H5T_IEEE_F64LE, 3, huge), FW_E_FORMAT);
    assert_int_equal(open_with("wear_load", H5T_IEEE_F64LE, 3, wide), FW_E_FORMAT);
    assert_int_equal(open_with("wear_load", H5T_IEEE_F64LE, 3, laws), FW_E_FORMAT);
    assert_int_equal(open_with("wear_load", H5T_STD_I64LE, 3, right), FW_E_FORMAT);
    assert_int_equal(open_with("path", H5T_IEEE_F64LE, 2, short_path), FW_E_FORMAT);
    /* and what is as it should be is taken, so that the refusals above are for their reasons */
    assert_int_equal(open_with("path", H5T_IEEE_F64LE, 2, path), FW_OK);
    assert_int_equal(open_with("wear_load", H5T_IEEE_F64LE, 3, right), FW_OK);
    assert_int_equal(open_with("speed", H5T_IEEE_F32LE, 1, n20), FW_OK);
    H5Tclose(growing);
}

static void test_foreign_files(void **state)
{
    (void)state;
    fw_results *r;
    hid_t       file = H5Fcreate("i.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    assert_int_equal(fw_results_open(&r, "i.h5", &msg), FW_E_FORMAT); /* no seal */
    help_seal_again("i.h5");
    assert_int_equal(fw_results_open(&r, "i.h5", &msg), FW_E_FORMAT); /* no filetype */
    assert_non_null(strstr(msg.text, "filetype"));
    help_save("i.h5", (const unsigned char *)"no HDF5 at all, but sealed", 26);
    help_seal_again("i.h5");
    assert_int_equal(fw_results_open(&r, "i.h5", &msg), FW_E_FORMAT);
    fw_scene       scene = {.duration = 1.0};
    fw_trajectory *t;
    unlink("i.h5"); /* a trajectory does not take the place of something else */
    assert_ok(fw_trajectory_create(&t, "i.h5", &scene, &msg));
    assert_ok(fw_trajectory_close(t, &msg));
    assert_int_equal(fw_results_open(&r, "i.h5", &msg), FW_E_FORMAT);
    assert_non_null(strstr(msg.text, "floewear trajectory"));
}

/* A status number from nowhere, and a cause without end, sit in rows and show only when the row is read. */
static void test_hostile_rows(void **state)
{
    (void)state;
    fw_results *r;
    fw_record   to;
    assert_ok(fw_record_init(&to, 72, 1, &msg));
    for (int k = 0; k < 2; k++) {
        assert_ok(write_made("k.h5", 72, 1, 20));
        hid_t   file = H5Fopen("k.h5", H5F_ACC_RDWR, H5P_DEFAULT);
        hid_t   dataset = H5Dopen2(file, k == 0 ? "/realisations/status" : "/realisations/cause", H5P_DEFAULT);
        hid_t   type = H5Dget_type(dataset);
        int32_t statuses[20] = {[3] = -1, [4] = FW_N_STATUS};
        char    causes[20 * 200];
        memset(causes, 'x', sizeof causes);
        assert_true(
            H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, k == 0 ? (void *)statuses : (void *)causes) >= 0);
        H5Tclose(type);
        H5Dclose(dataset);
        assert_true(H5Fclose(file) >= 0);
        help_seal_again("k.h5");
        assert_ok(fw_results_open(&r, "k.h5", &msg));
        fw_record_source s = fw_results_records(r);
        assert_int_equal(s.read(s.self, 3, &to, &msg), FW_E_FORMAT);
        assert_non_null(strstr(msg.text, "realisation 3"));
        assert_int_equal(s.read(s.self, 4, &to, &msg), FW_E_FORMAT);
        assert_int_equal(s.read(s.self, 5, &to, &msg), k == 0 ? FW_OK : FW_E_FORMAT);
        fw_results_close(r);
    }
    fw_record_free(&to);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_campaign_comes_back),
        cmocka_unit_test(test_seen_with_hdf5),
        cmocka_unit_test(test_same_file_twice),
        cmocka_unit_test(test_failing_source_leaves_the_old_file),
        cmocka_unit_test(test_unwritable_places),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_damaged_files),
        cmocka_unit_test(test_hostile_shapes),
        cmocka_unit_test(test_foreign_files),
        cmocka_unit_test(test_hostile_rows),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
