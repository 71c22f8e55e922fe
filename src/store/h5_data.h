/* Attributes and datasets as this project writes and reads them.
 *
 * Every dataset has `units` (UDUNITS where it can say it) and `long_name`. Texts in attributes are UTF-8 of variable
 * length (str in h5py, no 64 KiB limit), texts in datasets have a fixed length (numpy bytes, compressible). Numbers are
 * little-endian. Chunked datasets are shuffled and deflated. */
#ifndef FW_STORE_H5_DATA_H
#define FW_STORE_H5_DATA_H

#include <stddef.h>

#include "store/h5_file.h"

/* ---- writing; `at` is a group, a dataset or the file's id ---- */

fw_status fw_h5_put_text(const fw_h5_file *f, hid_t at, const char *name, const char *text, fw_msg *m);
fw_status fw_h5_put_texts(const fw_h5_file *f, hid_t at, const char *name, size_t n, const char *const *texts,
                          fw_msg *m);
fw_status fw_h5_put_u64(const fw_h5_file *f, hid_t at, const char *name, uint64_t value, fw_msg *m);
fw_status fw_h5_put_double(const fw_h5_file *f, hid_t at, const char *name, double value, fw_msg *m);
fw_status fw_h5_put_doubles(const fw_h5_file *f, hid_t at, const char *name, size_t n, const double *values, fw_msg *m);

/* filetype, format_version, code_version, git_revision and what the host puts in: host_name, host_system,
 * host_wall_time. */
fw_status fw_h5_put_origin(const fw_h5_file *f, const char *filetype, uint64_t format_version, fw_msg *m);

fw_status fw_h5_create_group(const fw_h5_file *f, const char *name, hid_t *group, fw_msg *m);

typedef struct fw_h5_shape {
    int     rank; /* 1 .. 3 */
    hsize_t dims[3];
    hsize_t chunk_rows; /* of the first dimension; 0: in one piece, unpacked. Along the others: all */
    bool    is_growing; /* the first dimension has no end */
} fw_h5_shape;

/* type: H5T_IEEE_F64LE and the like. unit NULL: "1"; long_name NULL: name. */
fw_status fw_h5_create_dataset(const fw_h5_file *f, hid_t at, const char *name, hid_t type, const fw_h5_shape *shape,
                               const char *unit, const char *long_name, hid_t *dataset, fw_msg *m);
hid_t     fw_h5_text_type(size_t n_bytes); /* fixed length, NUL-padded UTF-8; the caller closes; < 0 on error */

/* Rows [first, first + n) of a dataset of any rank; a growing one ends with them. */
fw_status fw_h5_write_rows(const fw_h5_file *f, hid_t dataset, hid_t memory_type, hsize_t first, hsize_t n,
                           const void *values, fw_msg *m);

/* ---- reading; all errors are FW_E_FORMAT and name file and object ---- */

fw_status fw_h5_get_text(const fw_h5_file *f, const char *name, char **text,
                         fw_msg *m); /* root attribute; caller frees */
fw_status fw_h5_get_texts(const fw_h5_file *f, const char *name, size_t *n, char ***texts, fw_msg *m);
void      fw_h5_free_texts(size_t n, char **texts);
fw_status fw_h5_get_u64(const fw_h5_file *f, const char *name, uint64_t *value, fw_msg *m);

#define FW_H5_ANY ((hsize_t)-1)
typedef struct fw_h5_wanted { /* a size of FW_H5_ANY is filled in, another one must be the file's */
    H5T_class_t class;        /* H5T_FLOAT, H5T_INTEGER, or H5T_STRING of fixed length */
    size_t  n_bytes;          /* of an element, for strings */
    int     rank;
    hsize_t dims[3];
} fw_h5_wanted;
fw_status fw_h5_open_dataset(const fw_h5_file *f, const char *path, fw_h5_wanted *w, hid_t *dataset, fw_msg *m);
fw_status fw_h5_read_rows(const fw_h5_file *f, hid_t dataset, hid_t memory_type, hsize_t first, hsize_t n, void *values,
                          fw_msg *m);

#endif
