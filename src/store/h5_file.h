/* A whole HDF5 file on disk: how one comes into being, and how one is opened without trusting it.
 *
 *   write: claim PATH.tmp -> HDF5 through a driver of our own -> seal -> fsync, rename, fsync of the folder
 *   read:  seal checked -> HDF5, which sees the bytes before the seal only
 *
 * Why a driver: HDF5 1.10.8 dies of a segmentation fault when writes begin to fail (tried with a file size limit of
 * 100 B to 1 MB). Ours takes every write; the first one that fails is remembered, the later ones go nowhere, HDF5
 * closes in good order, and then the whole file is thrown away with the remembered reason.
 * Why a seal: HDF5 trusts the addresses and sizes that it reads; damaged ones may end in a crash. The seal, 32 bytes
 * behind HDF5's own end of file, which HDF5 ignores, holds length and CRC32C of all before it. No seal: not ours, cut
 * off, or changed by another program; the journal can write the file again.
 *
 *   seal (little-endian): magic "floewear seal 1\n" 16 | content's length 8 | CRC32C of both 4 | zero 4 */
#ifndef FW_STORE_H5_FILE_H
#define FW_STORE_H5_FILE_H

#include <hdf5.h>
#include <stdint.h>

#include "floewear/status.h"

enum { FW_H5_SEAL_SIZE = 32 };

/* Where the driver reads and writes, and the first thing that went wrong there. */
typedef struct fw_h5_disk {
    int      fd;
    uint64_t size;   /* of the content when opened for reading */
    int      code;   /* errno of the first failed write, 0: none */
    uint64_t offset; /* where it was */
    size_t   n_bytes;
} fw_h5_disk;

/* Must stay where it is while open: HDF5's driver keeps the address of disk. */
typedef struct fw_h5_file {
    char      *path, *temporary; /* temporary is NULL when reading */
    fw_h5_disk disk;
    hid_t      driver, id; /* id: the HDF5 file */
} fw_h5_file;

/* Not seen under its name before fw_h5_file_finish; objects carry no times. FW_E_IO: unwritable or in use. */
fw_status fw_h5_file_create(fw_h5_file *f, const char *path, fw_msg *m);
/* FW_E_IO when a write failed since creation: names path, bytes and the system's reason. */
fw_status fw_h5_file_check(const fw_h5_file *f, fw_msg *m);
/* Close, check, seal, give it its name. On error PATH is as it was and nothing of the new file is left. f is closed. */
fw_status fw_h5_file_finish(fw_h5_file *f, fw_msg *m);

/* FW_E_FORMAT: no seal, a wrong one, or not HDF5. */
fw_status fw_h5_file_open(fw_h5_file *f, const char *path, fw_msg *m);
/* Close a file that is read, or give up one that is written (the temporary goes). A zeroed f is fine. */
void      fw_h5_file_close(fw_h5_file *f);

/* Append the seal to the n bytes of fd. */
fw_status fw_h5_seal(int fd, const char *path, uint64_t n, fw_msg *m);

/* "PATH: WHAT: HDF5's innermost reason". Call it right after the HDF5 function that failed. */
fw_status fw_h5_fail(const fw_h5_file *f, fw_status code, const char *what, fw_msg *m);

#define FW_H5_CHECK(cond, f, code, what, m)                                                                            \
    do {                                                                                                               \
        if (!(cond)) return fw_h5_fail((f), (code), (what), (m));                                                      \
    } while (0)

#endif
