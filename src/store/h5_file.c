#include "store/h5_file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/memory.h"
#include "store/file.h"
#include "store/h5_driver.h"

static const char seal_magic[16] = {'f', 'l', 'o', 'e', 'w', 'e', 'a', 'r', ' ', 's', 'e', 'a', 'l', ' ', '1', '\n'};

enum { COPY_BYTES = 1 << 20 };

/* ---- messages ---- */

typedef struct reason {
    char text[300];
} reason;

static herr_t innermost(unsigned n, const H5E_error2_t *e, void *to)
{
    if (n == 0 && e->desc != NULL) strncpy(((reason *)to)->text, e->desc, sizeof((reason *)to)->text - 1);
    return 0;
}

fw_status fw_h5_fail(const fw_h5_file *f, fw_status code, const char *what, fw_msg *m)
{
    reason why = {.text = ""};
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &why);
    return fw_fail(m, code, "%s: %s%s%s", f->path, what, why.text[0] != '\0' ? ": " : "", why.text);
}

/* HDF5 prints its errors unless told not to, and loads whatever filter a file asks for from a folder of plug-ins. */
static void calm_hdf5(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5PLset_loading_state(0);
}

/* ---- seal ---- */

static void put(unsigned char *to, uint64_t v, int n)
{
    for (int i = 0; i < n; i++) { to[i] = (unsigned char)(v >> (8 * i)); }
}

static fw_status make_seal(unsigned char seal[FW_H5_SEAL_SIZE], int fd, const char *path, uint64_t n, fw_msg *m)
{
    unsigned char *bytes;
    FW_TRY(fw_alloc(&bytes, COPY_BYTES, 1, "a part of an HDF5 file", m));
    uint32_t  crc = 0;
    fw_status status = FW_OK;
    for (uint64_t at = 0; at < n && status == FW_OK;) {
        size_t k = n - at < COPY_BYTES ? (size_t)(n - at) : COPY_BYTES;
        status = fw_file_read_at(fd, path, bytes, k, at, m);
        crc = fw_crc32c(crc, bytes, k);
        at += k;
    }
    free(bytes);
    memset(seal, 0, FW_H5_SEAL_SIZE);
    memcpy(seal, seal_magic, sizeof seal_magic);
    put(seal + 16, n, 8);
    put(seal + 24, fw_crc32c(crc, seal + 16, 8), 4);
    return status;
}

fw_status fw_h5_seal(int fd, const char *path, uint64_t n, fw_msg *m)
{
    unsigned char seal[FW_H5_SEAL_SIZE];
    FW_TRY(make_seal(seal, fd, path, n, m));
    return fw_file_write_at(fd, path, seal, sizeof seal, n, NULL, m);
}

static fw_status check_seal(const fw_h5_file *f, uint64_t *n, fw_msg *m)
{
    unsigned char seal[FW_H5_SEAL_SIZE], wanted[FW_H5_SEAL_SIZE];
    uint64_t      size;
    FW_TRY(fw_file_size(f->disk.fd, f->path, &size, m));
    bool is_there = size > FW_H5_SEAL_SIZE;
    if (is_there) FW_TRY(fw_file_read_at(f->disk.fd, f->path, seal, sizeof seal, size - sizeof seal, m));
    FW_CHECK(is_there && memcmp(seal, seal_magic, sizeof seal_magic) == 0, m, FW_E_FORMAT,
             "%s is no whole file of floewear: its seal is missing at the end (cut off, changed by another program, or "
             "never one); "
             "results are written anew from their journal once this file is out of the way",
             f->path);
    *n = size - sizeof seal;
    FW_TRY(make_seal(wanted, f->disk.fd, f->path, *n, m));
    FW_CHECK(memcmp(seal, wanted, sizeof seal) == 0, m, FW_E_FORMAT,
             "%s is damaged: its checksum is wrong; results are written anew from their journal once this file is out "
             "of the way",
             f->path);
    return FW_OK;
}

/* ---- open and close ---- */

/* HDF5 says "open failed" of a driver that found no memory too. */
static fw_status fail_open(const fw_h5_file *f, fw_status code, const char *what, fw_msg *m)
{
    FW_CHECK(f->disk.code != ENOMEM, m, FW_E_NOMEM, "out of memory: opening %s, %zu bytes", f->path, f->disk.n_bytes);
    return fw_h5_fail(f, code, what, m);
}

static fw_status access_list(fw_h5_file *f, hid_t *list, fw_msg *m)
{
    f->driver = fw_h5_driver_register();
    FW_H5_CHECK(f->driver >= 0, f, FW_E_INTERNAL, "HDF5 driver", m);
    *list = H5Pcreate(H5P_FILE_ACCESS);
    /* Not older than 1.8: attributes without end of the 64 KiB limit; not newer than 1.10: what ParaView and h5py
     * read. */
    FW_H5_CHECK(*list >= 0 && fw_h5_driver_use(*list, f->driver, &f->disk) >= 0 &&
                    H5Pset_fclose_degree(*list, H5F_CLOSE_STRONG) >= 0 &&
                    H5Pset_libver_bounds(*list, H5F_LIBVER_V18, H5F_LIBVER_V110) >= 0,
                f, FW_E_INTERNAL, "HDF5 file access", m);
    return FW_OK;
}

static fw_status start(fw_h5_file *f, const char *path, fw_msg *m)
{
    *f = (fw_h5_file){.disk = {.fd = -1}, .driver = H5I_INVALID_HID, .id = H5I_INVALID_HID};
    calm_hdf5();
    return fw_file_suffixed(&f->path, path, "", m);
}

static void close_hdf5(fw_h5_file *f)
{
    if (f->id > 0) H5Fclose(f->id);
    if (f->driver > 0) H5FDunregister(f->driver);
    f->id = f->driver = H5I_INVALID_HID;
}

void fw_h5_file_close(fw_h5_file *f)
{
    if (f == NULL || f->path == NULL) return;
    close_hdf5(f);
    if (f->temporary != NULL && f->disk.fd >= 0) unlink(f->temporary);
    if (f->disk.fd >= 0) close(f->disk.fd);
    free(f->path);
    free(f->temporary);
    *f = (fw_h5_file){.disk = {.fd = -1}};
}

static fw_status create_hdf5(fw_h5_file *f, fw_msg *m)
{
    FW_TRY(fw_file_suffixed(&f->temporary, f->path, ".tmp", m));
    FW_TRY(fw_file_claim(&f->disk.fd, f->temporary, true, m));
    FW_CHECK(ftruncate(f->disk.fd, 0) == 0, m, FW_E_IO, "%s: cannot be emptied", f->temporary);
    hid_t     list = H5I_INVALID_HID, creation = H5Pcreate(H5P_FILE_CREATE);
    fw_status status = access_list(f, &list, m);
    /* No times, so that two runs of one campaign differ in what is named host, cpu or wall only. */
    if (status == FW_OK && H5Pset_obj_track_times(creation, 0) >= 0) {
        f->id = H5Fcreate(f->temporary, H5F_ACC_TRUNC, creation, list);
    }
    if (status == FW_OK && f->id < 0) status = fail_open(f, FW_E_IO, "HDF5 file", m);
    if (list >= 0) H5Pclose(list);
    if (creation >= 0) H5Pclose(creation);
    return status;
}

fw_status fw_h5_file_create(fw_h5_file *f, const char *path, fw_msg *m)
{
    fw_status status = start(f, path, m);
    if (status == FW_OK) status = create_hdf5(f, m);
    if (status != FW_OK) fw_h5_file_close(f);
    return status;
}

fw_status fw_h5_file_check(const fw_h5_file *f, fw_msg *m)
{
    FW_CHECK(f->disk.code == 0, m, FW_E_IO,
             "%s: %zu bytes at %" PRIu64 " could not be written: %s; what was there before is as it was", f->path,
             f->disk.n_bytes, f->disk.offset, strerror(f->disk.code));
    return FW_OK;
}

fw_status fw_h5_file_finish(fw_h5_file *f, fw_msg *m)
{
    uint64_t  n;
    herr_t    closed = H5Fclose(f->id);
    fw_status status = closed < 0 ? fw_h5_fail(f, FW_E_IO, "closing", m) : FW_OK;
    f->id = H5I_INVALID_HID;
    if (f->disk.code != 0) status = fw_h5_file_check(f, m);
    if (status == FW_OK) status = fw_file_size(f->disk.fd, f->path, &n, m);
    if (status == FW_OK) status = fw_h5_seal(f->disk.fd, f->path, n, m);
    if (status == FW_OK) status = fw_file_publish(f->disk.fd, f->temporary, f->path, m);
    if (status == FW_OK) {
        free(f->temporary); /* it has its name: nothing to unlink */
        f->temporary = NULL;
    }
    fw_h5_file_close(f);
    return status;
}

fw_status fw_h5_file_open(fw_h5_file *f, const char *path, fw_msg *m)
{
    hid_t     list = H5I_INVALID_HID;
    fw_status status = start(f, path, m);
    if (status == FW_OK) status = fw_file_open_read(&f->disk.fd, path, m);
    if (status == FW_OK) status = check_seal(f, &f->disk.size, m);
    if (status == FW_OK) status = access_list(f, &list, m);
    if (status == FW_OK) {
        f->id = H5Fopen(path, H5F_ACC_RDONLY, list);
        if (f->id < 0) status = fail_open(f, FW_E_FORMAT, "no HDF5 file", m);
    }
    if (list >= 0) H5Pclose(list);
    if (status != FW_OK) fw_h5_file_close(f);
    return status;
}
