/* Looking at result files with HDF5 itself, without the code under test. */
#ifndef FW_TESTS_H5_HELP_H
#define FW_TESTS_H5_HELP_H

#include <fcntl.h>
#include <hdf5.h>

#include "store/h5_file.h"
#include "store_help.h"

typedef struct help_census {
    size_t n_datasets, n_bare, n_timed; /* bare: without units or long_name; timed: with object times */
} help_census;

static inline bool help_has_text(hid_t object, const char *name)
{
    if (H5Aexists(object, name) <= 0) return false;
    hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
    char *text = NULL;
    bool  is_there = H5Tis_variable_str(type) > 0 && H5Aread(attribute, type, &text) >= 0 && text != NULL &&
                    text[0] != '\0';
    if (text != NULL) H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return is_there;
}

static inline herr_t help_count(hid_t root, const char *name, const H5O_info_t *info, void *to)
{
    help_census *c = to;
    c->n_timed += info->atime != 0 || info->mtime != 0 || info->ctime != 0 || info->btime != 0;
    if (info->type != H5O_TYPE_DATASET) return 0;
    hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
    bool  is_full = help_has_text(dataset, "units") && help_has_text(dataset, "long_name");
    if (!is_full) print_error("%s has no units or no long_name\n", name);
    c->n_bare += !is_full;
    c->n_datasets++;
    H5Dclose(dataset);
    return 0;
}

static inline help_census help_take_census(const char *path)
{
    help_census c = {0};
    hid_t       file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    assert_true(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, help_count, &c, H5O_INFO_ALL) >= 0);
    assert_true(H5Fclose(file) >= 0);
    return c;
}

/* After a change with HDF5: a seal that fits, so that what lies behind the seal is tested. */
static inline void help_seal_again(const char *path)
{
    struct stat s;
    int         fd = open(path, O_RDWR);
    assert_true(fd >= 0);
    assert_int_equal(fstat(fd, &s), 0);
    assert_ok(fw_h5_seal(fd, path, (uint64_t)s.st_size, &msg));
    close(fd);
}

#endif
