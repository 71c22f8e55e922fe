#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "store/results.h"
#include "store/results_block.h"
#include "store/tables_put.h"

enum { MAX_ARCS = 1 << 20, ID_BLOCK = 8192 };

/* Records to be lent: those of the block of rings that was read last. */
typedef struct lending {
    fw_record *records; /* (rows of a block) */
    double    *rings;   /* (rows of a block x doubles per record) */
} lending;

struct fw_results {
    fw_tables          *tables; /* the open file */
    char               *text;
    size_t              n_sets;
    char              **sets;
    int64_t             seed;
    uint64_t            n;
    size_t              n_arcs, n_laws;
    fw_id_span          span;
    fw_results_datasets datasets;
    fw_results_scalars  scalars; /* rows read last; n = 0: none */
    fw_results_rings    rings;   /* likewise */
    lending             lending; /* made when records are first asked to be lent */
};

/* The file, for its path and HDF5. */
static const fw_h5_file *file_of(const fw_results *r) { return &r->tables->file; }

void fw_results_close(fw_results *r)
{
    if (r == NULL) return;
    free(r->lending.records);
    free(r->lending.rings);
    fw_results_rings_free(&r->rings);
    fw_results_scalars_free(&r->scalars);
    fw_results_datasets_close(&r->datasets);
    fw_tables_close(r->tables);
    fw_h5_free_texts(r->n_sets, r->sets);
    free(r->text);
    free(r);
}

static fw_status read_root(fw_results *r, fw_msg *m)
{
    const fw_h5_file *f = file_of(r);
    uint64_t          version, seed;
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
    const fw_h5_file    *f = file_of(r);
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
    r->n_arcs = n_arcs;
    r->n_laws = n_laws;
    FW_TRY(fw_results_scalars_create(&r->scalars, r->n, m));
    return fw_results_rings_create(&r->rings, r->n, n_arcs, n_laws, m);
}

static fw_status check_id(fw_results *r, uint64_t row, uint64_t id, fw_msg *m)
{
    fw_id_span *s = &r->span;
    if (row == 0) {
        s->first = id;
    } else {
        FW_CHECK(id >= s->end, m, FW_E_FORMAT, "%s: row %" PRIu64 " of /realisations/id is %" PRIu64 ", after %" PRIu64,
                 file_of(r)->path, row, id, s->end - 1);
        if (id > s->end && s->gap_first == s->gap_end) s->gap_first = s->end, s->gap_end = id;
    }
    FW_CHECK(id < UINT64_MAX, m, FW_E_FORMAT, "%s: row %" PRIu64 " of /realisations/id is %" PRIu64, file_of(r)->path, row, id);
    s->end = id + 1;
    return FW_OK;
}

/* Ids ascend. It also unmasks a dataset that claims a huge length without holding data: its second id is 0. */
static fw_status check_ids(fw_results *r, fw_msg *m)
{
    uint64_t *ids;
    FW_TRY(fw_alloc(&ids, ID_BLOCK, sizeof *ids, "ids", m));
    fw_status status = FW_OK;
    for (uint64_t first = 0; first < r->n && status == FW_OK; first += ID_BLOCK) {
        uint64_t n = r->n - first < ID_BLOCK ? r->n - first : ID_BLOCK;
        status = fw_h5_read_rows(file_of(r), r->datasets.id, H5T_NATIVE_UINT64, first, n, ids, m);
        for (uint64_t i = 0; i < n && status == FW_OK; i++) status = check_id(r, first + i, ids[i], m);
    }
    free(ids);
    return status;
}

fw_status fw_results_open(fw_results **out, const char *path, fw_msg *m)
{
    fw_results *r;
    *out = NULL;
    FW_TRY(fw_alloc(&r, 1, sizeof *r, "a results file", m));
    fw_status status = fw_tables_open(&r->tables, path, FW_RESULTS_FILETYPE, m);
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

const fw_tables *fw_results_tables(const fw_results *r) { return r->tables; }

const char *fw_results_settings(const fw_results *r) { return fw_tables_settings(r->tables); }

fw_status fw_results_ids(const fw_results *r, uint64_t *ids, fw_msg *m)
{
    if (r->n == 0) return FW_OK;
    return fw_h5_read_rows(file_of(r), r->datasets.id, H5T_NATIVE_UINT64, 0, r->n, ids, m);
}

/* ---- reading records ---- */

static bool holds(uint64_t first, size_t n, uint64_t row) { return row >= first && row - first < n; }

static size_t rows_from(const fw_results *r, uint64_t first, size_t capacity)
{
    return r->n - first < capacity ? (size_t)(r->n - first) : capacity;
}

/* All of one record but its rings. */
static fw_status read_head(fw_results *r, uint64_t row, fw_record *to, fw_msg *m)
{
    fw_results_scalars *b = &r->scalars;
    if (!holds(b->first, b->n, row)) {
        b->first = row - row % b->capacity;
        b->n = rows_from(r, b->first, b->capacity);
        fw_status status = fw_results_scalars_read(file_of(r), &r->datasets, b, m);
        if (status != FW_OK) {
            b->n = 0;
            return status;
        }
    }
    fw_status status = fw_results_scalars_get(b, (size_t)(row - b->first), to, m);
    if (status != FW_OK) fw_msg_prefix(m, "%s: ", file_of(r)->path);
    return status;
}

static fw_status find_rings(fw_results *r, uint64_t row, fw_msg *m)
{
    fw_results_rings *b = &r->rings;
    if (holds(b->first, b->n, row)) return FW_OK;
    b->first = row - row % b->capacity;
    b->n = rows_from(r, b->first, b->capacity);
    fw_status status = fw_results_rings_read(file_of(r), &r->datasets, b, m);
    if (status != FW_OK) b->n = 0;
    return status;
}

static fw_status check_index(const fw_results *r, uint64_t index, fw_msg *m)
{
    FW_CHECK(index < r->n, m, FW_E_ARG, "%s: no record number %" PRIu64 "; there are %" PRIu64, file_of(r)->path, index, r->n);
    return FW_OK;
}

static fw_status read_record(void *self, uint64_t index, fw_record *to, fw_msg *m)
{
    fw_results *r = self;
    FW_TRY(check_index(r, index, m));
    FW_CHECK(to->n_arcs == r->n_arcs && to->n_laws == r->n_laws, m, FW_E_FORMAT,
             "%s: rings of %zu laws and %zu arcs where the file's campaign asks for %zu and %zu", file_of(r)->path,
             r->n_laws, r->n_arcs, to->n_laws, to->n_arcs);
    FW_TRY(read_head(r, index, to, m));
    FW_TRY(find_rings(r, index, m));
    fw_results_rings_get(&r->rings, (size_t)(index - r->rings.first), to);
    return FW_OK;
}

static fw_status make_lending(fw_results *r, fw_msg *m)
{
    lending *l = &r->lending;
    size_t   rows = r->rings.capacity, n_rings = fw_record_n_rings(r->n_arcs, r->n_laws);
    if (l->records) return FW_OK;
    FW_TRY(fw_alloc(&l->rings, rows * n_rings, sizeof *l->rings, "rings to lend", m));
    fw_status status = fw_alloc(&l->records, rows, sizeof *l->records, "records to lend", m);
    if (status != FW_OK) {
        free(l->rings);
        l->rings = NULL;
        return status;
    }
    for (size_t i = 0; i < rows; i++) l->records[i] = (fw_record){.n_arcs = r->n_arcs, .n_laws = r->n_laws, .rings = l->rings + i * n_rings};
    return FW_OK;
}

/* From index to the end of its block. */
static fw_status lend_records(void *self, uint64_t index, const fw_record **records, size_t *n, fw_msg *m)
{
    fw_results *r = self;
    FW_TRY(check_index(r, index, m));
    FW_TRY(make_lending(r, m));
    FW_TRY(find_rings(r, index, m));
    const fw_results_rings *b = &r->rings;
    size_t                  skip = (size_t)(index - b->first);
    for (size_t i = skip; i < b->n; i++) {
        FW_TRY(read_head(r, b->first + i, &r->lending.records[i], m));
        fw_results_rings_get(b, i, &r->lending.records[i]);
    }
    *records = r->lending.records + skip;
    *n = b->n - skip;
    return FW_OK;
}

fw_record_source fw_results_records(fw_results *r)
{
    return (fw_record_source){.n = r->n, .read = read_record, .lend = lend_records, .self = r, .span = r->span};
}
