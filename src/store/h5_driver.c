#include "store/h5_driver.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct driver_file {
    H5FD_t      pub; /* HDF5's own part comes first */
    fw_h5_disk *disk;
    haddr_t     eoa, eof;
} driver_file;

typedef struct driver_info { /* what travels in the file access list */
    fw_h5_disk *disk;
} driver_info;

static void remember(fw_h5_disk *disk, int code, haddr_t offset, size_t n)
{
    if (disk->code != 0) return;
    disk->code = code;
    disk->offset = offset;
    disk->n_bytes = n;
}

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t access_list, haddr_t max_address)
{
    (void)name;
    (void)flags;
    (void)max_address;
    const driver_info *info = H5Pget_driver_info(access_list);
    if (info == NULL) return NULL;
    driver_file *f = calloc(1, sizeof *f);
    if (f == NULL) {
        remember(info->disk, ENOMEM, 0, sizeof *f);
        return NULL;
    }
    f->disk = info->disk;
    f->eof = info->disk->size;
    return &f->pub;
}

static herr_t driver_close(H5FD_t *file)
{
    free(file);
    return 0;
}

static herr_t driver_query(const H5FD_t *file, unsigned long *flags)
{
    (void)file;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t driver_get_eoa(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const driver_file *)file)->eoa;
}

static herr_t driver_set_eoa(H5FD_t *file, H5FD_mem_t type, haddr_t address)
{
    (void)type;
    ((driver_file *)file)->eoa = address;
    return 0;
}

static haddr_t driver_get_eof(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const driver_file *)file)->eof;
}

static herr_t driver_read(H5FD_t *file, H5FD_mem_t type, hid_t list, haddr_t address, size_t n, void *bytes)
{
    (void)type;
    (void)list;
    const driver_file *f = (const driver_file *)file;
    size_t             done = 0;
    while (done < n) {
        size_t left = n - done;
        if (address + done >= f->eof) { /* never written: zeros, as HDF5's own driver has it */
            memset((char *)bytes + done, 0, left);
            break;
        }
        if (left > f->eof - (address + done)) left = (size_t)(f->eof - (address + done));
        ssize_t k = pread(f->disk->fd, (char *)bytes + done, left, (off_t)(address + done));
        if (k < 0 && errno == EINTR) continue;
        if (k < 0 && f->disk->code == 0) return -1;
        if (k <= 0) { /* the file is shorter than what it was to hold: a write has failed before */
            memset((char *)bytes + done, 0, n - done);
            break;
        }
        done += (size_t)k;
    }
    return 0;
}

static herr_t driver_write(H5FD_t *file, H5FD_mem_t type, hid_t list, haddr_t address, size_t n, const void *bytes)
{
    (void)type;
    (void)list;
    driver_file *f = (driver_file *)file;
    size_t       done = 0;
    while (done < n && f->disk->code == 0) {
        ssize_t k = pwrite(f->disk->fd, (const char *)bytes + done, n - done, (off_t)(address + done));
        if (k > 0)
            done += (size_t)k;
        else if (k == 0 || errno != EINTR)
            remember(f->disk, k == 0 ? EIO : errno, address, n);
    }
    if (address + n > f->eof) f->eof = address + n;
    return 0;
}

/* HDF5 reserves space before it writes; the file ends where the reservation ends. */
static herr_t driver_truncate(H5FD_t *file, hid_t list, hbool_t is_closing)
{
    (void)list;
    (void)is_closing;
    driver_file *f = (driver_file *)file;
    if (f->eoa == f->eof) return 0;
    if (f->disk->code == 0 && ftruncate(f->disk->fd, (off_t)f->eoa) != 0) remember(f->disk, errno, f->eoa, 0);
    f->eof = f->eoa;
    return 0;
}

hid_t fw_h5_driver_register(void)
{
    static const H5FD_class_t class = {
        .name = "floewear",
        .maxaddr = (haddr_t)INT64_MAX, /* off_t */
        .fc_degree = H5F_CLOSE_STRONG,
        .fapl_size = sizeof(driver_info),
        .open = driver_open,
        .close = driver_close,
        .query = driver_query,
        .get_eoa = driver_get_eoa,
        .set_eoa = driver_set_eoa,
        .get_eof = driver_get_eof,
        .read = driver_read,
        .write = driver_write,
        .truncate = driver_truncate,
        .fl_map = H5FD_FLMAP_DICHOTOMY,
    };
    return H5FDregister(&class);
}

herr_t fw_h5_driver_use(hid_t access_list, hid_t driver, fw_h5_disk *disk)
{
    driver_info info = {.disk = disk};
    return H5Pset_driver(access_list, driver, &info);
}
