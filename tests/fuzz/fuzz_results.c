/* Results files: whatever the bytes, a refusal that says why, or records that are whole. Nothing of HDF5 stays open.
 *
 *   byte 0   0: the rest is the file; 1: the rest, sealed; else the rest orders a file (results_builder.h)
 *
 * Sealed bytes that HDF5 would take for its own are left out: what libhdf5 does with a damaged file is not ours. */
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "fuzz/fuzz.h"
#include "fuzz/results_builder.h"
#include "store/h5_file.h"
#include "store/results.h"

static const char *const files[] = {"f.h5", "f.h5.tmp", "f.h5.pipe", NULL};

static char path[FUZZ_PATH];

/* Everything of HDF5 that a caller can forget to close. */
static hsize_t n_open(void)
{
    static const H5I_type_t kinds[] = {H5I_FILE,    H5I_GROUP, H5I_DATATYPE,    H5I_DATASPACE,
                                       H5I_DATASET, H5I_ATTR,  H5I_GENPROP_LST, H5I_VFL};
    hsize_t                 all = 0, n;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (H5Inmembers(kinds[i], &n) >= 0) all += n;
    }
    return all;
}

static void check_refusal(fw_status status, const fw_msg *m, double started)
{
    FUZZ_LAW(status == FW_E_FORMAT || (status == FW_E_MISMATCH && strstr(m->text, "another version") != NULL), "%s: %s",
             fw_status_name(status), m->text);
    fuzz_check_refusal(status, m, "f.h5", started);
}

static bool has_same_bits(const fw_record *a, const fw_record *b)
{
    if (a->id != b->id || a->status != b->status || strcmp(a->cause, b->cause) != 0) return false;
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        size_t o = fw_record_columns[i].offset;
        if (memcmp((const char *)a + o, (const char *)b + o, sizeof(double)) != 0) return false;
    }
    return memcmp(a->rings, b->rings, fw_record_n_rings(a->n_arcs, a->n_laws) * sizeof *a->rings) == 0;
}

/* Records are lent or refused, and lent ones are those that are read. */
static void check_lent(const fw_record_source *s, const fuzz_built *b)
{
    fw_record        wanted;
    const fw_record *lent;
    size_t           n = 1;
    fw_msg           m = {""};
    FUZZ_LAW(fw_record_init(&wanted, b->n_arcs, b->n_laws, NULL) == FW_OK, "%zu arcs", b->n_arcs);
    for (uint64_t at = 0; at < s->n && at < 20; at += n) {
        double    started = fw_cpu_seconds();
        fw_status status = s->lend(s->self, at, &lent, &n, &m);
        if (status != FW_OK) {
            check_refusal(status, &m, started);
            FUZZ_LAW(!b->is_good, "%s", m.text);
            break;
        }
        FUZZ_LAW(n >= 1 && at + n <= s->n, "%zu records from %llu on", n, (unsigned long long)at);
        if (!b->is_good) continue;
        fuzz_expected_record(b, at, &wanted);
        FUZZ_LAW(has_same_bits(&lent[0], &wanted), "record %llu", (unsigned long long)at);
    }
    fw_record_free(&wanted);
}

static void check_record(const fw_record_source *s, uint64_t id, const fuzz_built *b)
{
    fw_record r, wanted;
    fw_msg    m = {""};
    double    started = fw_cpu_seconds();
    FUZZ_LAW(fw_record_init(&r, b->n_arcs, b->n_laws, NULL) == FW_OK, "%zu arcs", b->n_arcs);
    FUZZ_LAW(fw_record_init(&wanted, b->n_arcs, b->n_laws, NULL) == FW_OK, "%zu arcs", b->n_arcs);
    fw_status status = s->read(s->self, id, &r, &m);
    if (status == FW_OK) {
        FUZZ_LAW(r.id >= id && (int)r.status >= 0 && r.status < FW_N_STATUS &&
                     memchr(r.cause, 0, sizeof r.cause) != NULL,
                 "record %llu: id %llu, status %d", (unsigned long long)id, (unsigned long long)r.id, (int)r.status);
    } else {
        check_refusal(status, &m, started);
    }
    if (b->is_good) {
        fuzz_expected_record(b, id, &wanted);
        FUZZ_LAW(status == FW_OK && has_same_bits(&r, &wanted), "record %llu: %s", (unsigned long long)id, m.text);
    }
    fw_record_free(&wanted);
    fw_record_free(&r);
}

/* built NULL: nothing is known of the file. */
static void check_accepted(fw_results *r, const fuzz_built *built)
{
    const fuzz_built   unknown = {.n_laws = 1, .n_arcs = 1}, *b = built != NULL ? built : &unknown;
    const char *const *sets;
    size_t             n_sets = fw_results_sets(r, &sets);
    fw_record_source   s = fw_results_records(r);

    FUZZ_LAW(fw_results_campaign_text(r) != NULL && fw_results_seed(r) >= 0, "seed %lld",
             (long long)fw_results_seed(r));
    for (size_t i = 0; i < n_sets; i++) FUZZ_LAW(sets[i] != NULL, "set %zu", i);
    if (b->is_good) {
        FUZZ_LAW(strcmp(fw_results_campaign_text(r), FUZZ_CAMPAIGN) == 0 && fw_results_seed(r) == FUZZ_SEED, "%s",
                 fw_results_campaign_text(r));
        FUZZ_LAW(n_sets == FUZZ_N_SETS && strcmp(sets[0], "seed=7") == 0 && sets[1][0] == '\0', "%zu sets", n_sets);
        FUZZ_LAW(s.n == b->n, "%llu records", (unsigned long long)s.n);
    }
    check_lent(&s, b);
    for (uint64_t i = 0; i < s.n && i < 20; i++) check_record(&s, i, b);
    if (s.n > 0) check_record(&s, s.n - 1, b), check_record(&s, 0, b);

    fw_record none;
    fw_msg    m = {""};
    FUZZ_LAW(fw_record_init(&none, b->n_arcs, b->n_laws, NULL) == FW_OK, "%zu arcs", b->n_arcs);
    FUZZ_LAW(s.read(s.self, s.n, &none, &m) == FW_E_ARG && strstr(m.text, "f.h5") != NULL, "%s", m.text);
    fw_record_free(&none);
}

static bool is_hdf5_inside(const uint8_t *bytes, size_t n)
{
    for (size_t i = 0; i + 4 <= n; i++) {
        if (memcmp(bytes + i, "\211HDF", 4) == 0) return true;
    }
    return false;
}

static void save_sealed(const uint8_t *bytes, size_t n)
{
    fuzz_save(path, bytes, n);
    int fd = open(path, O_RDWR);
    FUZZ_LAW(fd >= 0 && fw_h5_seal(fd, path, n, NULL) == FW_OK, "%s cannot be sealed", path);
    close(fd);
}

static bool make_file(const uint8_t *data, size_t size, fuzz_built *built)
{
    if (data[0] == 0) fuzz_save(path, data + 1, size - 1);
    if (data[0] == 0) return true;
    if (data[0] > 1) return fuzz_build_results(path, data + 1, size - 1, built);
    if (is_hdf5_inside(data + 1, size - 1)) return false;
    save_sealed(data + 1, size - 1);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fw_results *r;
    fuzz_built  built = {0};
    fw_msg      m = {""};
    char        pipe[FUZZ_PATH];

    if (size == 0) return 0;
    fuzz_enter_folder(files);
    fuzz_path(path, files[0]);
    fuzz_path(pipe, "f.h5.pipe");
    mkfifo(pipe, 0600);
    if (!make_file(data, size, &built)) return 0;

    hsize_t   before = n_open();
    double    started = fw_cpu_seconds();
    fw_status status = fw_results_open(&r, path, &m);
    if (status == FW_OK) {
        check_accepted(r, data[0] > 1 ? &built : NULL);
        fw_results_close(r);
    } else {
        FUZZ_LAW(r == NULL && !built.is_good, "a good file is refused: %s", m.text);
        check_refusal(status, &m, started);
    }
    FUZZ_LAW(n_open() == before, "%llu handles of HDF5 stay open", (unsigned long long)(n_open() - before));
    return 0;
}
