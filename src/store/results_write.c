#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "store/results.h"
#include "store/results_block.h"
#include "store/tables_put.h"

/* "MPa^1.121 km", or one such text per law when exponents differ: "MPa^1.121 km; MPa^1 km". */
static void load_unit(char *text, size_t size, const fw_model *model)
{
    bool is_one = true;
    for (size_t i = 1; i < model->n_laws; i++) is_one = is_one && model->laws[i].exponent == model->laws[0].exponent;
    size_t n = 0;
    text[0] = '\0';
    for (size_t i = 0; i < (is_one ? 1 : model->n_laws) && n < size; i++) {
        n += (size_t)snprintf(text + n, size - n, "%sMPa^%.12g km", i > 0 ? "; " : "", model->laws[i].exponent);
    }
}

static fw_status put_laws(const fw_h5_file *f, hid_t dataset, const fw_model *model, fw_msg *m)
{
    double      exponents[FW_MAX_LAWS];
    const char *names[FW_MAX_LAWS];
    for (size_t i = 0; i < model->n_laws; i++) {
        exponents[i] = model->laws[i].exponent;
        names[i] = model->laws[i].name;
    }
    FW_TRY(fw_h5_put_doubles(f, dataset, "exponents", model->n_laws, exponents, m));
    return fw_h5_put_texts(f, dataset, "laws", model->n_laws, names, m);
}

static fw_status put_status_names(const fw_h5_file *f, hid_t dataset, fw_msg *m)
{
    const char *names[FW_N_STATUS], *sentences[FW_N_STATUS];
    for (int i = 0; i < FW_N_STATUS; i++) {
        names[i] = fw_status_name((fw_status)i);
        sentences[i] = fw_status_sentence((fw_status)i);
    }
    FW_TRY(fw_h5_put_texts(f, dataset, "names", FW_N_STATUS, names, m));
    return fw_h5_put_texts(f, dataset, "sentences", FW_N_STATUS, sentences, m);
}

static fw_status create_datasets(const fw_h5_file *f, hid_t at, const fw_model *model, uint64_t n,
                                 fw_results_datasets *d, fw_msg *m)
{
    char        unit[160];
    fw_h5_shape scalar = {.rank = 1, .dims = {n}, .chunk_rows = FW_RESULTS_SCALAR_ROWS};
    fw_h5_shape path = {.rank = 2, .dims = {n, model->n_arcs}};
    fw_h5_shape ring = {.rank = 3, .dims = {n, model->n_laws, model->n_arcs}};
    FW_TRY(fw_h5_create_dataset(f, at, "id", H5T_STD_U64LE, &scalar, "1", "number of the realisation", &d->id, m));
    FW_TRY(fw_h5_create_dataset(f, at, "status", H5T_STD_I32LE, &scalar, "1",
                                "0: done; else why the realisation failed, an index into the attribute names",
                                &d->status, m));
    FW_TRY(put_status_names(f, d->status, m));
    hid_t     text = fw_h5_text_type(FW_RESULTS_CAUSE);
    fw_status status = text < 0
                           ? fw_h5_fail(f, FW_E_INTERNAL, "cause", m)
                           : fw_h5_create_dataset(f, at, "cause", text, &scalar, "1",
                                                  "why the realisation failed, empty when it is done", &d->cause, m);
    if (text >= 0) H5Tclose(text);
    FW_TRY(status);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        const fw_record_column *c = &fw_record_columns[i];
        FW_TRY(fw_h5_create_dataset(f, at, c->name, H5T_IEEE_F64LE, &scalar, c->unit, c->long_name, &d->columns[i], m));
    }
    FW_TRY(fw_h5_create_dataset(f, at, "path", H5T_IEEE_F64LE, &path, "km", "sliding path per arc", &d->path, m));
    load_unit(unit, sizeof unit, model);
    for (int i = 0; i < FW_RINGS_PER_LAW; i++) {
        FW_TRY(fw_h5_create_dataset(f, at, fw_results_ring_names[i], H5T_IEEE_F64LE, &ring, unit,
                                    fw_results_ring_long_names[i], &d->rings[i], m));
        FW_TRY(put_laws(f, d->rings[i], model, m));
    }
    return FW_OK;
}

static fw_status put_angles(const fw_h5_file *f, hid_t at, size_t n_arcs, fw_msg *m)
{
    hid_t       dataset;
    double     *angles;
    fw_h5_shape shape = {.rank = 1, .dims = {n_arcs}};
    FW_TRY(fw_alloc(&angles, n_arcs, sizeof *angles, "angles of arcs", m));
    for (size_t k = 0; k < n_arcs; k++) angles[k] = ((double)k + 0.5) * 360.0 / (double)n_arcs;
    fw_status status = fw_h5_create_dataset(
        f, at, "angle_deg", H5T_IEEE_F64LE, &shape, "degree",
        "middle of the arc, clockwise seen from above from where the structure faces the current", &dataset, m);
    if (status == FW_OK) {
        status = fw_h5_write_rows(f, dataset, H5T_NATIVE_DOUBLE, 0, n_arcs, angles, m);
        H5Dclose(dataset);
    }
    free(angles);
    return status;
}

/* Two blocks that fill up side by side and are written when they are full, so that a million records need no more memory than these. */
typedef struct blocks {
    fw_results_scalars scalars;
    fw_results_rings   rings;
} blocks;

static fw_status write_full(const fw_h5_file *f, const fw_results_datasets *d, blocks *b, bool is_end, fw_msg *m)
{
    if (b->scalars.n > 0 && (is_end || b->scalars.n == b->scalars.capacity)) {
        FW_TRY(fw_results_scalars_write(f, d, &b->scalars, m));
        b->scalars.first += b->scalars.n;
        b->scalars.n = 0;
    }
    if (b->rings.n > 0 && (is_end || b->rings.n == b->rings.capacity)) {
        FW_TRY(fw_results_rings_write(f, d, &b->rings, m));
        b->rings.first += b->rings.n;
        b->rings.n = 0;
        FW_TRY(fw_h5_file_check(f, m)); /* a full disk ends it here, not after a million records */
    }
    return FW_OK;
}

static fw_status stream_records(const fw_h5_file *f, const fw_results_datasets *d, const fw_record_source *source,
                                blocks *b, fw_record *r, fw_msg *m)
{
    uint64_t last = 0;
    for (uint64_t i = 0; i < source->n; i++) {
        FW_TRY(source->read(source->self, i, r, m));
        FW_CHECK(i == 0 || r->id > last, m, FW_E_INTERNAL, "realisation %" PRIu64 " was given after %" PRIu64, r->id, last);
        last = r->id;
        fw_results_scalars_put(&b->scalars, b->scalars.n++, r);
        fw_results_rings_put(&b->rings, b->rings.n++, r);
        FW_TRY(write_full(f, d, b, false, m));
    }
    FW_TRY(write_full(f, d, b, true, m));
    return fw_h5_file_check(f, m);
}

static fw_status put_records(const fw_h5_file *f, const fw_results_datasets *d, const fw_model *model,
                             const fw_record_source *source, fw_msg *m)
{
    blocks    b = {.rings = {.path = NULL}};
    fw_record r;
    FW_TRY(fw_record_init(&r, model->n_arcs, model->n_laws, m));
    fw_status status = fw_results_scalars_create(&b.scalars, source->n, m);
    if (status == FW_OK) status = fw_results_rings_create(&b.rings, source->n, model->n_arcs, model->n_laws, m);
    if (status == FW_OK) status = stream_records(f, d, source, &b, &r, m);
    fw_results_scalars_free(&b.scalars);
    fw_results_rings_free(&b.rings);
    fw_record_free(&r);
    return status;
}

static fw_status put_realisations(const fw_h5_file *f, const fw_campaign *c, const fw_record_source *source, fw_msg *m)
{
    hid_t               group;
    fw_results_datasets d;
    FW_TRY(fw_results_datasets_create(&d, m));
    fw_status status = fw_h5_create_group(f, "realisations", &group, m);
    if (status == FW_OK) status = create_datasets(f, group, &c->model, source->n, &d, m);
    if (status == FW_OK) status = put_angles(f, group, c->model.n_arcs, m);
    if (status == FW_OK) status = put_records(f, &d, &c->model, source, m);
    fw_results_datasets_close(&d);
    if (group >= 0) H5Gclose(group);
    return status;
}

fw_status fw_results_write(const char *path, const fw_campaign *c, const fw_record_source *records, size_t n_tables,
                           const fw_table *tables, fw_msg *m)
{
    fw_h5_file f;
    FW_CHECK(c->model.n_arcs > 0 && c->model.n_laws > 0 && c->model.n_laws <= FW_MAX_LAWS, m, FW_E_ARG,
             "%s: results of %zu arcs and %zu laws", path, c->model.n_arcs, c->model.n_laws);
    FW_TRY(fw_h5_file_create(&f, path, m));
    fw_status status = fw_tables_put_root(&f, FW_RESULTS_FILETYPE, FW_RESULTS_VERSION, c, m);
    if (status == FW_OK) status = put_realisations(&f, c, records, m);
    for (size_t i = 0; i < n_tables && status == FW_OK; i++) status = fw_tables_put(&f, &tables[i], m);
    if (status == FW_OK) return fw_h5_file_finish(&f, m);
    fw_h5_file_close(&f);
    return status;
}
