#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "store/h5_data.h"

enum { MAX_TEXTS = 1 << 16, MAX_TEXT_BYTES = 1 << 28 };
enum { MAX_CHUNK_BYTES = 1 << 24 }; /* ten times the largest of ours, 8192 causes; a frame of 2^21 floes */

static fw_status bad(const fw_h5_file *f, const char *name, const char *wanted, fw_msg *m)
{
    return fw_fail(m, FW_E_FORMAT, "%s: %s is missing or is not %s", f->path, name, wanted);
}

/* A root attribute of this class with rank 0 or 1; *n is 1 for rank 0. */
static fw_status open_attribute(const fw_h5_file *f, const char *name, H5T_class_t class, int rank, hid_t *attribute,
                                hid_t *type, size_t *n, const char *wanted, fw_msg *m)
{
    hsize_t dims[1] = {1};
    *attribute = H5Aexists(f->id, name) > 0 ? H5Aopen(f->id, name, H5P_DEFAULT) : H5I_INVALID_HID;
    *type = *attribute >= 0 ? H5Aget_type(*attribute) : H5I_INVALID_HID;
    hid_t space = *attribute >= 0 ? H5Aget_space(*attribute) : H5I_INVALID_HID;
    bool  good = *type >= 0 && space >= 0 && H5Tget_class(*type) == class && H5Sis_simple(space) > 0 &&
                H5Sget_simple_extent_ndims(space) == rank && H5Sget_simple_extent_type(space) != H5S_NULL &&
                (rank == 0 || H5Sget_simple_extent_dims(space, dims, NULL) == rank) && dims[0] <= MAX_TEXTS;
    if (good && class == H5T_STRING) good = H5Tis_variable_str(*type) > 0;
    if (good && class == H5T_INTEGER) good = H5Tget_size(*type) <= 8;
    if (space >= 0) H5Sclose(space);
    *n = (size_t)dims[0];
    if (good) return FW_OK;
    if (*type >= 0) H5Tclose(*type);
    if (*attribute >= 0) H5Aclose(*attribute);
    return bad(f, name, wanted, m);
}

/* Variable-length texts belong to HDF5's memory: copy them and give them back. An empty one may be NULL. */
static fw_status read_texts(const fw_h5_file *f, const char *name, hid_t attribute, size_t n, char **out, fw_msg *m)
{
    char    **raw;
    fw_status status = FW_OK;
    FW_TRY(fw_alloc(&raw, n, sizeof *raw, "texts of an HDF5 file", m));
    hid_t memory = H5Tcopy(H5T_C_S1);
    if (memory < 0 || H5Tset_size(memory, H5T_VARIABLE) < 0 || H5Tset_cset(memory, H5T_CSET_UTF8) < 0)
        status = fw_h5_fail(f, FW_E_INTERNAL, name, m);
    if (status == FW_OK && n > 0 && H5Aread(attribute, memory, raw) < 0) status = fw_h5_fail(f, FW_E_FORMAT, name, m);
    for (size_t i = 0; i < n; i++) {
        const char *text = raw[i] != NULL ? raw[i] : "";
        if (status == FW_OK && strnlen(text, MAX_TEXT_BYTES) == MAX_TEXT_BYTES) status = bad(f, name, "a text", m);
        if (status == FW_OK && (out[i] = fw_strdup(text)) == NULL) {
            status = fw_fail(m, FW_E_NOMEM, "%s: out of memory: %s", f->path, name);
        }
        if (raw[i] != NULL) H5free_memory(raw[i]);
    }
    free(raw);
    if (memory >= 0) H5Tclose(memory);
    return status;
}

fw_status fw_h5_get_text(const fw_h5_file *f, const char *name, char **text, fw_msg *m)
{
    hid_t  attribute, type;
    size_t n;
    *text = NULL;
    FW_TRY(open_attribute(f, name, H5T_STRING, 0, &attribute, &type, &n, "a text", m));
    fw_status status = read_texts(f, name, attribute, 1, text, m);
    H5Tclose(type);
    H5Aclose(attribute);
    return status;
}

void fw_h5_free_texts(size_t n, char **texts)
{
    for (size_t i = 0; texts != NULL && i < n; i++) free(texts[i]);
    free(texts);
}

fw_status fw_h5_get_texts(const fw_h5_file *f, const char *name, size_t *n, char ***texts, fw_msg *m)
{
    hid_t attribute, type;
    *texts = NULL;
    *n = 0;
    FW_TRY(open_attribute(f, name, H5T_STRING, 1, &attribute, &type, n, "a list of texts", m));
    fw_status status = fw_alloc(texts, *n, sizeof **texts, name, m);
    if (status == FW_OK) status = read_texts(f, name, attribute, *n, *texts, m);
    if (status != FW_OK) {
        fw_h5_free_texts(*n, *texts);
        *texts = NULL;
        *n = 0;
    }
    H5Tclose(type);
    H5Aclose(attribute);
    return status;
}

fw_status fw_h5_get_u64(const fw_h5_file *f, const char *name, uint64_t *value, fw_msg *m)
{
    hid_t  attribute, type;
    size_t n;
    FW_TRY(open_attribute(f, name, H5T_INTEGER, 0, &attribute, &type, &n, "an integer", m));
    fw_status status = H5Aread(attribute, H5T_NATIVE_UINT64, value) < 0 ? fw_h5_fail(f, FW_E_FORMAT, name, m) : FW_OK;
    H5Tclose(type);
    H5Aclose(attribute);
    return status;
}

static bool has_type(hid_t dataset, const fw_h5_wanted *w)
{
    hid_t type = H5Dget_type(dataset);
    bool  good = type >= 0 && H5Tget_class(type) == w->class;
    if (good && w->class == H5T_STRING)
        good = H5Tis_variable_str(type) == 0 && H5Tget_size(type) == w->n_bytes;
    else if (good)
        good = H5Tget_size(type) <= 8;
    if (type >= 0) H5Tclose(type);
    return good;
}

static bool has_shape(hid_t dataset, fw_h5_wanted *w)
{
    hsize_t dims[3] = {0};
    hid_t   space = H5Dget_space(dataset);
    bool    good = space >= 0 && H5Sis_simple(space) > 0 && H5Sget_simple_extent_type(space) == H5S_SIMPLE &&
                H5Sget_simple_extent_ndims(space) == w->rank && H5Sget_simple_extent_dims(space, dims, NULL) == w->rank;
    for (int i = 0; good && i < w->rank; i++) {
        good = w->dims[i] == FW_H5_ANY || w->dims[i] == dims[i];
        w->dims[i] = dims[i];
    }
    if (space >= 0) H5Sclose(space);
    return good;
}

/* The seal vouches for what is in the file. A dataset may also name other files that its values are to be read from, a
 * pipe that nobody fills among them, and a chunk of gigabytes that a few deflated bytes grow into. */
static bool has_values_here(hid_t dataset)
{
    hsize_t      chunk[3] = {0}, n_bytes;
    hid_t        list = H5Dget_create_plist(dataset), type = H5Dget_type(dataset);
    H5D_layout_t layout = list >= 0 ? H5Pget_layout(list) : H5D_LAYOUT_ERROR;
    bool         good = type >= 0 && (layout == H5D_COMPACT || layout == H5D_CONTIGUOUS || layout == H5D_CHUNKED) &&
                H5Pget_external_count(list) == 0;
    if (good && layout == H5D_CHUNKED) {
        int rank = H5Pget_chunk(list, 3, chunk);
        n_bytes = H5Tget_size(type);
        good = rank > 0 && rank <= 3;
        for (int i = 0; good && i < rank; i++) { /* HDF5's chunks have dimensions below 2^32 */
            n_bytes *= chunk[i];
            good = n_bytes <= MAX_CHUNK_BYTES;
        }
    }
    if (type >= 0) H5Tclose(type);
    if (list >= 0) H5Pclose(list);
    return good;
}

fw_status fw_h5_open_dataset(const fw_h5_file *f, const char *path, fw_h5_wanted *w, hid_t *dataset, fw_msg *m)
{
    *dataset = H5Dopen2(f->id, path, H5P_DEFAULT);
    if (*dataset >= 0 && has_type(*dataset, w) && has_values_here(*dataset) && has_shape(*dataset, w)) return FW_OK;
    if (*dataset >= 0) H5Dclose(*dataset);
    *dataset = H5I_INVALID_HID;
    return bad(f, path, "a dataset of the right type and shape with its values in this file", m);
}

fw_status fw_h5_read_rows(const fw_h5_file *f, hid_t dataset, hid_t memory_type, hsize_t first, hsize_t n, void *values,
                          fw_msg *m)
{
    hsize_t start[3] = {first}, count[3] = {0};
    hid_t   space = H5Dget_space(dataset), memory = H5I_INVALID_HID;
    int     rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : -1;
    bool    good = rank > 0 && rank <= 3 && H5Sget_simple_extent_dims(space, count, NULL) == rank;
    count[0] = n;
    if (good) {
        memory = H5Screate_simple(rank, count, NULL);
        good = memory >= 0 && H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL) >= 0 &&
               H5Dread(dataset, memory_type, memory, space, H5P_DEFAULT, values) >= 0;
    }
    fw_status status = good ? FW_OK : fw_h5_fail(f, FW_E_FORMAT, "reading a dataset", m);
    if (memory >= 0) H5Sclose(memory);
    if (space >= 0) H5Sclose(space);
    return status;
}
