#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "store/results.h"
#include "store/results_block.h"

enum { MAX_ARCS = 1 << 20, ID_BLOCK = 8192 };

struct fw_results {
    fw_h5_file          file;
    char               *text;
    size_t              n_sets;
    char              **sets;
    int64_t             seed;
    uint64_t            n;
    fw_results_datasets datasets;
    fw_results_block    block; /* the rows read last; n = 0: none */
};

void fw_results_close(fw_results *r)
{
    if (r == NULL) return;
    fw_results_block_free(&r->block);
    fw_results_datasets_close(&r->datasets);
    fw_h5_file_close(&r->file);
    fw_h5_free_texts(r->n_sets, r->sets);
    free(r->text);
    free(r);
}

static fw_status read_root(fw_results *r, fw_msg *m)
{
    const fw_h5_file *f = &r->file;
    char             *filetype;
    uint64_t          version, seed;
    FW_TRY(fw_h5_get_text(f, "filetype", &filetype, m));
    fw_status status = strcmp(filetype, FW_RESULTS_FILETYPE) == 0
                           ? FW_OK
                           : fw_fail(m, FW_E_FORMAT, "%s is a file of type '%.60s', not '%s'", f->path, filetype,
                                     FW_RESULTS_FILETYPE);
    free(filetype);
    FW_TRY(status);
    FW_TRY(fw_h5_get_u64(f, "format_version", &version, m));
    FW_CHECK(version == FW_RESULTS_VERSION, m, FW_E_MISMATCH,
             "%s holds results of another version of floewear (format %" PRIu64 ", this program's is %d)", f->path, version,
             (int)FW_RESULTS_VERSION);
    FW_TRY(fw_h5_get_u64(f, "seed", &seed, m));
    FW_CHECK(seed <= INT64_MAX, m, FW_E_FORMAT, "%s: seed %" PRIu64 " is beyond %" PRId64, f->path, seed, INT64_MAX);
    r->seed = (int64_t)seed;
    FW_TRY(fw_h5_get_text(f, "campaign", &r->text, m));
    return fw_h5_get_texts(f, "sets", &r->n_sets, &r->sets, m);
}

static fw_status open_datasets(fw_results *r, fw_msg *m)
{
    const fw_h5_file    *f = &r->file;
    fw_results_datasets *d = &r->datasets;
    FW_TRY(fw_results_datasets_create(d, m));
    fw_h5_wanted id = {.class = H5T_INTEGER, .rank = 1, .dims = {FW_H5_ANY}};
    FW_TRY(fw_h5_open_dataset(f, "/realisations/id", &id, &d->id, m));
    r->n = id.dims[0];
    fw_h5_wanted ring = {.class = H5T_FLOAT, .rank = 3, .dims = {r->n, FW_H5_ANY, FW_H5_ANY}};
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) { /* the first one says how many laws and arcs, the others must agree */
        char path[64];
        snprintf(path, sizeof path, "/realisations/%s", fw_results_ring_names[i]);
        FW_TRY(fw_h5_open_dataset(f, path, &ring, &d->rings[i], m));
    }
    size_t n_laws = (size_t)ring.dims[1], n_arcs = (size_t)ring.dims[2];
    FW_CHECK(ring.dims[1] >= 1 && ring.dims[1] <= FW_MAX_LAWS && ring.dims[2] >= 1 && ring.dims[2] <= MAX_ARCS, m,
             FW_E_FORMAT, "%s: /realisations/wear_load has %llu laws and %llu arcs; 1 to %d and 1 to %d are possible",
             f->path, (unsigned long long)ring.dims[1], (unsigned long long)ring.dims[2], (int)FW_MAX_LAWS,
             (int)MAX_ARCS);
    fw_h5_wanted path = {.class = H5T_FLOAT, .rank = 2, .dims = {r->n, n_arcs}};
    FW_TRY(fw_h5_open_dataset(f, "/realisations/path", &path, &d->path, m));
    fw_h5_wanted angle = {.class = H5T_FLOAT, .rank = 1, .dims = {n_arcs}};
    hid_t        angles;
    FW_TRY(fw_h5_open_dataset(f, "/realisations/angle_deg", &angle, &angles, m));
    H5Dclose(angles);
    fw_h5_wanted scalar = {.class = H5T_INTEGER, .rank = 1, .dims = {r->n}};
    FW_TRY(fw_h5_open_dataset(f, "/realisations/status", &scalar, &d->status, m));
    scalar.class = H5T_STRING;
    scalar.n_bytes = FW_RESULTS_CAUSE;
    FW_TRY(fw_h5_open_dataset(f, "/realisations/cause", &scalar, &d->cause, m));
    scalar.class = H5T_FLOAT;
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        char name[96];
        snprintf(name, sizeof name, "/realisations/%s", fw_record_columns[i].name);
        FW_TRY(fw_h5_open_dataset(f, name, &scalar, &d->columns[i], m));
    }
    return fw_results_block_create(&r->block, fw_results_block_rows(n_arcs), n_arcs, n_laws, m);
}

/* Ids are 0 .. n-1 in order. It also unmasks a dataset that claims a huge length without holding data: its second
 * id is 0. */
static fw_status check_ids(const fw_results *r, fw_msg *m)
{
    uint64_t *ids;
    FW_TRY(fw_alloc(&ids, ID_BLOCK, sizeof *ids, "ids", m));
    fw_status status = FW_OK;
    for (uint64_t first = 0; first < r->n && status == FW_OK; first += ID_BLOCK) {
        uint64_t n = r->n - first < ID_BLOCK ? r->n - first : ID_BLOCK;
        status = fw_h5_read_rows(&r->file, r->datasets.id, H5T_NATIVE_UINT64, first, n, ids, m);
        for (uint64_t i = 0; i < n && status == FW_OK; i++) {
            if (ids[i] != first + i) {
                status = fw_fail(m, FW_E_FORMAT, "%s: row %" PRIu64 " of /realisations/id is %" PRIu64, r->file.path,
                                 first + i, ids[i]);
            }
        }
    }
    free(ids);
    return status;
}

fw_status fw_results_open(fw_results **out, const char *path, fw_msg *m)
{
    fw_results *r;
    *out = NULL;
    FW_TRY(fw_alloc(&r, 1, sizeof *r, "a results file", m));
    fw_status status = fw_h5_file_open(&r->file, path, m);
    if (status == FW_OK) status = read_root(r, m);
    if (status == FW_OK) status = open_datasets(r, m);
    if (status == FW_OK) status = check_ids(r, m);
    if (status == FW_OK)
        *out = r;
    else
        fw_results_close(r);
    return status;
}

const char *fw_results_campaign_text(const fw_results *r) { return r->text; }

size_t fw_results_sets(const fw_results *r, const char *const **sets)
{
    *sets = (const char *const *)r->sets;
    return r->n_sets;
}

int64_t fw_results_seed(const fw_results *r) { return r->seed; }

static fw_status read_record(void *self, uint64_t id, fw_record *to, fw_msg *m)
{
    fw_results       *r = self;
    fw_results_block *b = &r->block;
    FW_CHECK(id < r->n, m, FW_E_ARG, "%s: no realisation %" PRIu64 "; there are %" PRIu64, r->file.path, id, r->n);
    FW_CHECK(to->n_arcs == b->n_arcs && to->n_laws == b->n_laws, m, FW_E_FORMAT,
             "%s: rings of %zu laws and %zu arcs where the file's campaign asks for %zu and %zu", r->file.path,
             b->n_laws, b->n_arcs, to->n_laws, to->n_arcs);
    if (b->n == 0 || id < b->first || id - b->first >= b->n) {
        b->first = id - id % b->capacity;
        b->n = r->n - b->first < b->capacity ? (size_t)(r->n - b->first) : b->capacity;
        fw_status status = fw_results_block_read(&r->file, &r->datasets, b, m);
        if (status != FW_OK) {
            b->n = 0;
            return status;
        }
    }
    fw_status status = fw_results_block_get(b, (size_t)(id - b->first), to, m);
    if (status != FW_OK) fw_msg_prefix(m, "%s: ", r->file.path);
    return status;
}

fw_record_source fw_results_records(fw_results *r)
{
    return (fw_record_source){.n = r->n, .read = read_record, .self = r};
}
