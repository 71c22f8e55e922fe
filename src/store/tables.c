#include "store/tables.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "store/tables_put.h"

enum { TABLES_VERSION = 1, MAX_WIDTH = 1 << 16 };

fw_status fw_tables_put_root(const fw_h5_file *f, const char *filetype, uint64_t version, const fw_campaign *c,
                             fw_msg *m)
{
    char hash[20];
    snprintf(hash, sizeof hash, "%016" PRIx64, c->hash);
    FW_TRY(fw_h5_put_origin(f, filetype, version, m));
    FW_TRY(fw_h5_put_text(f, f->id, "name", c->name, m));
    FW_TRY(fw_h5_put_text(f, f->id, "campaign", c->text != NULL ? c->text : "", m));
    FW_TRY(fw_h5_put_texts(f, f->id, "sets", c->n_sets, (const char *const *)c->sets, m));
    FW_TRY(fw_h5_put_text(f, f->id, "settings", c->settings != NULL ? c->settings : "", m));
    FW_TRY(fw_h5_put_text(f, f->id, "settings_hash", hash, m));
    return fw_h5_put_u64(f, f->id, "seed", c->seed, m);
}

/* Texts of a column as fixed-length rows of the longest one. */
static fw_status put_text_column(const fw_h5_file *f, hid_t group, const fw_column *c, const fw_h5_shape *shape,
                                 fw_msg *m)
{
    size_t n = (size_t)shape->dims[0], width = 1;
    for (size_t i = 0; i < n; i++) {
        size_t length = c->text[i] != NULL ? strlen(c->text[i]) : 0;
        if (length > width) width = length;
    }
    char *rows;
    FW_TRY(fw_alloc(&rows, n, width, c->name, m));
    for (size_t i = 0; i < n; i++) {
        if (c->text[i] != NULL) memcpy(rows + i * width, c->text[i], strlen(c->text[i]));
    }
    hid_t     dataset, type = fw_h5_text_type(width);
    fw_status status = type < 0
                           ? fw_h5_fail(f, FW_E_INTERNAL, c->name, m)
                           : fw_h5_create_dataset(f, group, c->name, type, shape, c->unit, c->long_name, &dataset, m);
    if (status == FW_OK) {
        status = fw_h5_write_rows(f, dataset, type, 0, n, rows, m);
        H5Dclose(dataset);
    }
    if (type >= 0) H5Tclose(type);
    free(rows);
    return status;
}

static fw_status put_column(const fw_h5_file *f, hid_t group, const fw_column *c, const fw_h5_shape *shape, fw_msg *m)
{
    FW_CHECK((c->number != NULL) + (c->integer != NULL) + (c->text != NULL) == 1, m, FW_E_ARG,
             "column %s: exactly one of number, integer, text must be given", c->name);
    if (c->text != NULL) return put_text_column(f, group, c, shape, m);
    hid_t dataset;
    bool  is_number = c->number != NULL;
    FW_TRY(fw_h5_create_dataset(f, group, c->name, is_number ? H5T_IEEE_F64LE : H5T_STD_I64LE, shape, c->unit,
                                c->long_name, &dataset, m));
    fw_status status = fw_h5_write_rows(f, dataset, is_number ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64, 0, shape->dims[0],
                                        is_number ? (const void *)c->number : (const void *)c->integer, m);
    H5Dclose(dataset);
    return status;
}

fw_status fw_tables_put(const fw_h5_file *f, const fw_table *t, fw_msg *m)
{
    hid_t       group;
    fw_h5_shape shape = {.rank = 1, .dims = {t->n_rows}};
    FW_TRY(fw_h5_create_group(f, t->name, &group, m));
    fw_status status = FW_OK;
    for (size_t i = 0; i < t->n_columns && status == FW_OK; i++) {
        status = put_column(f, group, &t->columns[i], &shape, m);
    }
    H5Gclose(group);
    return status;
}

/* ---- a file of tables alone ------------------------------------------------------------------------------------- */

fw_status fw_tables_check_kind(const char *path, const char *filetype, fw_msg *m)
{
    struct stat s;
    fw_tables  *old = NULL;
    fw_msg      why = {""};
    if (stat(path, &s) != 0) return FW_OK;
    fw_status status = fw_tables_open(&old, path, filetype, &why);
    fw_tables_close(old);
    FW_CHECK(status != FW_E_NOMEM, m, FW_E_NOMEM, "%s", why.text); /* that says nothing of the file */
    FW_CHECK(status == FW_OK, m, FW_E_MISMATCH, "will not replace a file that is no %s of ours: %s", filetype,
             why.text);
    return FW_OK;
}

fw_status fw_tables_write(const char *path, const char *filetype, const fw_campaign *c, size_t n_tables,
                          const fw_table *tables, fw_msg *m)
{
    fw_h5_file f;
    FW_TRY(fw_tables_check_kind(path, filetype, m));
    FW_TRY(fw_h5_file_create(&f, path, m));
    fw_status status = fw_tables_put_root(&f, filetype, TABLES_VERSION, c, m);
    for (size_t i = 0; i < n_tables && status == FW_OK; i++) status = fw_tables_put(&f, &tables[i], m);
    if (status == FW_OK) return fw_h5_file_finish(&f, m);
    fw_h5_file_close(&f);
    return status;
}

/* ---- reading ---------------------------------------------------------------------------------------------------- */

void fw_tables_close(fw_tables *t)
{
    if (!t) return;
    fw_h5_file_close(&t->file);
    free(t->settings);
    free(t);
}

static fw_status check_filetype(const fw_h5_file *f, const char *wanted, fw_msg *m)
{
    char *filetype;
    FW_TRY(fw_h5_get_text(f, "filetype", &filetype, m));
    fw_status status = !wanted || strcmp(filetype, wanted) == 0
                           ? FW_OK
                           : fw_fail(m, FW_E_FORMAT, "%s is a file of type '%.60s', not '%s'", f->path, filetype,
                                     wanted);
    free(filetype);
    return status;
}

fw_status fw_tables_open(fw_tables **out, const char *path, const char *filetype, fw_msg *m)
{
    fw_tables *t;
    *out = NULL;
    FW_TRY(fw_alloc(&t, 1, sizeof *t, "a file of tables", m));
    fw_status status = fw_h5_file_open(&t->file, path, m);
    if (status == FW_OK) status = check_filetype(&t->file, filetype, m);
    if (status == FW_OK) status = fw_h5_get_text(&t->file, "settings", &t->settings, m);
    if (status == FW_OK)
        *out = t;
    else
        fw_tables_close(t);
    return status;
}

const char *fw_tables_settings(const fw_tables *t) { return t->settings; }

bool fw_tables_has(const fw_tables *t, const char *table) { return H5Lexists(t->file.id, table, H5P_DEFAULT) > 0; }

static fw_status check_length(const fw_tables *t, const char *path, hsize_t n, size_t most, fw_msg *m)
{
    FW_CHECK(n <= most, m, FW_E_FORMAT, "%s: %s has %llu rows; at most %zu are possible", t->file.path, path,
             (unsigned long long)n, most);
    return FW_OK;
}

fw_status fw_tables_numbers(const fw_tables *t, const char *table, const char *column, size_t most, size_t *n,
                            double **values, fw_msg *m)
{
    char         path[160];
    fw_h5_wanted w = {.class = H5T_FLOAT, .rank = 1, .dims = {FW_H5_ANY}};
    hid_t        dataset;
    *values = NULL;
    snprintf(path, sizeof path, "/%s/%s", table, column);
    FW_TRY(fw_h5_open_dataset(&t->file, path, &w, &dataset, m));
    *n = (size_t)w.dims[0];
    fw_status status = check_length(t, path, w.dims[0], most, m);
    if (status == FW_OK) status = fw_alloc(values, *n, sizeof **values, path, m);
    if (status == FW_OK && *n) status = fw_h5_read_rows(&t->file, dataset, H5T_NATIVE_DOUBLE, 0, w.dims[0], *values, m);
    H5Dclose(dataset);
    if (status != FW_OK) {
        free(*values);
        *values = NULL;
    }
    return status;
}

/* The width of a text column is whatever its longest text needed. */
static fw_status text_width(const fw_tables *t, const char *path, size_t *width, fw_msg *m)
{
    hid_t dataset = H5Dopen2(t->file.id, path, H5P_DEFAULT),
          type = dataset >= 0 ? H5Dget_type(dataset) : H5I_INVALID_HID;
    bool is_text = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    *width = is_text ? H5Tget_size(type) : 0;
    if (type >= 0) H5Tclose(type);
    if (dataset >= 0) H5Dclose(dataset);
    FW_CHECK(*width > 0 && *width <= MAX_WIDTH, m, FW_E_FORMAT, "%s: %s is missing or is not a column of texts",
             t->file.path, path);
    return FW_OK;
}

fw_status fw_tables_texts(const fw_tables *t, const char *table, const char *column, size_t most, size_t *n,
                          size_t *width, char **texts, fw_msg *m)
{
    char   path[160];
    size_t stored;
    hid_t  dataset;
    *texts = NULL;
    snprintf(path, sizeof path, "/%s/%s", table, column);
    FW_TRY(text_width(t, path, &stored, m));
    fw_h5_wanted w = {.class = H5T_STRING, .n_bytes = stored, .rank = 1, .dims = {FW_H5_ANY}};
    FW_TRY(fw_h5_open_dataset(&t->file, path, &w, &dataset, m));
    *n = (size_t)w.dims[0];
    *width = stored + 1; /* room for the NUL that a full row has none of */
    hid_t     memory = fw_h5_text_type(*width);
    fw_status status = memory < 0 ? fw_h5_fail(&t->file, FW_E_INTERNAL, path, m)
                                  : check_length(t, path, w.dims[0], most, m);
    if (status == FW_OK) status = fw_alloc(texts, *n, *width, path, m);
    if (status == FW_OK && *n) status = fw_h5_read_rows(&t->file, dataset, memory, 0, w.dims[0], *texts, m);
    for (size_t i = 0; status == FW_OK && i < *n; i++) (*texts)[i * *width + stored] = '\0';
    if (memory >= 0) H5Tclose(memory);
    H5Dclose(dataset);
    if (status != FW_OK) {
        free(*texts);
        *texts = NULL;
    }
    return status;
}
