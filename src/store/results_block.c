#include "store/results_block.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { BLOCK_BYTES = 512 * 1024, MAX_ROWS = 1024 };

const char *const fw_results_ring_names[FW_RINGS_PER_LAW] = {"wear_load", "wear_load_impact", "wear_load_high"};

const char *const fw_results_ring_long_names[FW_RINGS_PER_LAW] = {
    "temperature-free wear load per abrasion law and arc: sigma^m times sliding path",
    "share of wear_load from impacts: within 2/w of a first touch",
    "share of wear_load collected above 5 MPa",
};

size_t fw_results_ring_rows(size_t n_arcs)
{
    size_t rows = BLOCK_BYTES / (sizeof(double) * (n_arcs > 0 ? n_arcs : 1));
    return rows < 1 ? 1 : rows > MAX_ROWS ? MAX_ROWS : rows;
}

static size_t at_most(size_t rows, uint64_t n) { return n < rows ? (size_t)n : rows; }

/* ---- scalars ---- */

fw_status fw_results_scalars_create(fw_results_scalars *b, uint64_t n, fw_msg *m)
{
    size_t capacity = at_most(FW_RESULTS_SCALAR_ROWS, n);
    *b = (fw_results_scalars){.capacity = capacity};
    fw_status status = fw_alloc(&b->id, capacity, sizeof *b->id, "ids", m);
    if (status == FW_OK) status = fw_alloc(&b->status, capacity, sizeof *b->status, "statuses", m);
    if (status == FW_OK) status = fw_alloc(&b->cause, capacity, FW_RESULTS_CAUSE, "causes", m);
    if (status == FW_OK)
        status = fw_alloc(&b->columns, capacity * fw_n_record_columns, sizeof *b->columns, "columns", m);
    if (status != FW_OK) fw_results_scalars_free(b);
    return status;
}

void fw_results_scalars_free(fw_results_scalars *b)
{
    free(b->id);
    free(b->status);
    free(b->cause);
    free(b->columns);
    *b = (fw_results_scalars){0};
}

void fw_results_scalars_put(fw_results_scalars *b, size_t row, const fw_record *r)
{
    b->id[row] = r->id;
    b->status[row] = (int32_t)r->status;
    memset(b->cause + row * FW_RESULTS_CAUSE, 0, FW_RESULTS_CAUSE); /* no bytes left over from earlier sentences */
    memcpy(b->cause + row * FW_RESULTS_CAUSE, r->cause, strnlen(r->cause, FW_RESULTS_CAUSE - 1));
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        memcpy(b->columns + i * b->capacity + row, (const char *)r + fw_record_columns[i].offset, sizeof(double));
    }
}

fw_status fw_results_scalars_get(const fw_results_scalars *b, size_t row, fw_record *r, fw_msg *m)
{
    int32_t status = b->status[row];
    FW_CHECK(status >= 0 && status < FW_N_STATUS, m, FW_E_FORMAT,
             "realisation %" PRIu64 " has the unknown status %" PRId32, b->id[row], status);
    const char *cause = b->cause + row * FW_RESULTS_CAUSE;
    FW_CHECK(memchr(cause, 0, FW_RESULTS_CAUSE) != NULL, m, FW_E_FORMAT,
             "realisation %" PRIu64 " has a cause without end", b->id[row]);
    r->id = b->id[row];
    r->status = (fw_status)status;
    memcpy(r->cause, cause, FW_RESULTS_CAUSE);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        memcpy((char *)r + fw_record_columns[i].offset, b->columns + i * b->capacity + row, sizeof(double));
    }
    return FW_OK;
}

/* ---- rings ---- */

fw_status fw_results_rings_create(fw_results_rings *b, uint64_t n, size_t n_arcs, size_t n_laws, fw_msg *m)
{
    size_t capacity = at_most(fw_results_ring_rows(n_arcs), n);
    *b = (fw_results_rings){.capacity = capacity, .n_arcs = n_arcs, .n_laws = n_laws};
    fw_status status = fw_alloc(&b->path, capacity * n_arcs, sizeof *b->path, "paths", m);
    for (int i = 0; i < FW_RINGS_PER_LAW && status == FW_OK; i++) {
        status = fw_alloc(&b->load[i], capacity * n_arcs * n_laws, sizeof *b->load[i], fw_results_ring_names[i], m);
    }
    if (status != FW_OK) fw_results_rings_free(b);
    return status;
}

void fw_results_rings_free(fw_results_rings *b)
{
    free(b->path);
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) free(b->load[i]);
    *b = (fw_results_rings){0};
}

void fw_results_rings_put(fw_results_rings *b, size_t row, const fw_record *r)
{
    size_t n_arcs = b->n_arcs;
    memcpy(b->path + row * n_arcs, fw_record_path(r), n_arcs * sizeof(double));
    for (size_t law = 0; law < b->n_laws; law++) {
        for (int i = 0; i < FW_RINGS_PER_LAW; i++) {
            memcpy(b->load[i] + (row * b->n_laws + law) * n_arcs, fw_record_load(r, law, i), n_arcs * sizeof(double));
        }
    }
}

void fw_results_rings_get(const fw_results_rings *b, size_t row, fw_record *r)
{
    size_t n_arcs = b->n_arcs;
    memcpy(r->rings, b->path + row * n_arcs, n_arcs * sizeof(double));
    for (size_t law = 0; law < b->n_laws; law++) {
        for (size_t i = 0; i < FW_RINGS_PER_LAW; i++) {
            memcpy(r->rings + n_arcs * (1 + FW_RINGS_PER_LAW * law + i), b->load[i] + (row * b->n_laws + law) * n_arcs,
                   n_arcs * sizeof(double));
        }
    }
}

/* ---- datasets ---- */

fw_status fw_results_datasets_create(fw_results_datasets *d, fw_msg *m)
{
    *d = (fw_results_datasets){
        .id = H5I_INVALID_HID, .status = H5I_INVALID_HID, .cause = H5I_INVALID_HID, .path = H5I_INVALID_HID};
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) d->rings[i] = H5I_INVALID_HID;
    FW_TRY(fw_alloc(&d->columns, fw_n_record_columns, sizeof *d->columns, "handles of datasets", m));
    for (size_t i = 0; i < fw_n_record_columns; i++) d->columns[i] = H5I_INVALID_HID;
    return FW_OK;
}

static void close_one(hid_t dataset)
{
    if (dataset > 0) H5Dclose(dataset);
}

void fw_results_datasets_close(fw_results_datasets *d)
{
    close_one(d->id);
    close_one(d->status);
    close_one(d->cause);
    close_one(d->path);
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) close_one(d->rings[i]);
    for (size_t i = 0; d->columns != NULL && i < fw_n_record_columns; i++) close_one(d->columns[i]);
    free(d->columns);
    *d = (fw_results_datasets){0};
}

/* One walk over the datasets for both directions, so that they cannot drift apart. */
typedef fw_status (*move_rows)(const fw_h5_file *f, hid_t dataset, hid_t memory_type, hsize_t first, hsize_t n, void *values, fw_msg *m);

static fw_status write_rows(const fw_h5_file *f, hid_t dataset, hid_t memory_type, hsize_t first, hsize_t n, void *values, fw_msg *m)
{
    return fw_h5_write_rows(f, dataset, memory_type, first, n, values, m);
}

static fw_status move_scalars(move_rows move, const fw_h5_file *f, const fw_results_datasets *d,
                              const fw_results_scalars *b, fw_msg *m)
{
    hid_t     text = fw_h5_text_type(FW_RESULTS_CAUSE);
    fw_status status = text < 0 ? fw_h5_fail(f, FW_E_INTERNAL, "cause", m) : FW_OK;
    if (status == FW_OK) status = move(f, d->cause, text, b->first, b->n, b->cause, m);
    if (text >= 0) H5Tclose(text);
    FW_TRY(status);
    FW_TRY(move(f, d->id, H5T_NATIVE_UINT64, b->first, b->n, b->id, m));
    FW_TRY(move(f, d->status, H5T_NATIVE_INT32, b->first, b->n, b->status, m));
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        FW_TRY(move(f, d->columns[i], H5T_NATIVE_DOUBLE, b->first, b->n, b->columns + i * b->capacity, m));
    }
    return FW_OK;
}

fw_status fw_results_scalars_write(const fw_h5_file *f, const fw_results_datasets *d, const fw_results_scalars *b,
                                   fw_msg *m)
{
    return move_scalars(write_rows, f, d, b, m);
}

fw_status fw_results_scalars_read(const fw_h5_file *f, const fw_results_datasets *d, fw_results_scalars *b, fw_msg *m)
{
    return move_scalars(fw_h5_read_rows, f, d, b, m);
}

static fw_status move_rings(move_rows move, const fw_h5_file *f, const fw_results_datasets *d, const fw_results_rings *b, fw_msg *m)
{
    FW_TRY(move(f, d->path, H5T_NATIVE_DOUBLE, b->first, b->n, b->path, m));
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) FW_TRY(move(f, d->rings[i], H5T_NATIVE_DOUBLE, b->first, b->n, b->load[i], m));
    return FW_OK;
}

fw_status fw_results_rings_write(const fw_h5_file *f, const fw_results_datasets *d, const fw_results_rings *b, fw_msg *m)
{
    return move_rings(write_rows, f, d, b, m);
}

fw_status fw_results_rings_read(const fw_h5_file *f, const fw_results_datasets *d, fw_results_rings *b, fw_msg *m)
{
    return move_rings(fw_h5_read_rows, f, d, b, m);
}
