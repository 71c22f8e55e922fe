/* What journal and results files share: a locked file that appears whole under its name or not at all.
 *
 *   claim PATH.tmp -> write -> publish: fsync, rename PATH.tmp to PATH, fsync the folder
 *
 * A kill at any moment leaves the old PATH or the new one, never half of one; a left-over PATH.tmp is taken over by the
 * next claim. The lock (flock) belongs to the open file and so follows it through the rename. */
#ifndef FW_STORE_FILE_H
#define FW_STORE_FILE_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

#include "floewear/status.h"

/* Open PATH for reading and writing and lock it for this process alone. Waits at most half a second for the lock,
 * because somebody who only asks who runs (fw_file_is_locked) holds it for an instant. may_create: an absent file is
 * made. *fd is -1 on error and when the file is absent and may_create is false (FW_OK then).
 * Errors: FW_E_IO: cannot be opened, or in use by another run; FW_E_FORMAT: not a regular file. */
fw_status fw_file_claim(int *fd, const char *path, bool may_create, fw_msg *m);

/* Open for reading; FW_E_IO, FW_E_FORMAT as above. */
fw_status fw_file_open_read(int *fd, const char *path, fw_msg *m);
bool      fw_file_is_locked(int fd);

/* All n bytes at offset, or FW_E_IO with path, bytes and the system's reason (path is for the message). *done, unless
 * NULL: the bytes that were written, on error too. */
fw_status fw_file_write_at(int fd, const char *path, const void *bytes, size_t n, uint64_t offset, size_t *done,
                           fw_msg *m);
/* Fewer than n bytes is FW_E_IO as well. */
fw_status fw_file_read_at(int fd, const char *path, void *bytes, size_t n, uint64_t offset, fw_msg *m);
fw_status fw_file_size(int fd, const char *path, uint64_t *size, fw_msg *m);

/* fsync fd, rename from to to, fsync the folder that it lies in; takes no memory. On error `from` may still be there: the
 * caller unlinks it. */
fw_status fw_file_publish(int fd, const char *from, const char *to, fw_msg *m);

/* path + suffix, allocated; the caller frees. */
fw_status fw_file_suffixed(char **out, const char *path, const char *suffix, fw_msg *m);

#endif
