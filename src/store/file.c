#include "store/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/memory.h"

enum { LOCK_TRIES = 25, LOCK_PAUSE_NS = 20 * 1000 * 1000 };

/* O_NONBLOCK: opening a pipe that somebody put in the file's place must not wait for its other end. */
static int open_file(const char *path, int flags)
{
    int fd;
    do {
        fd = open(path, flags | O_CLOEXEC | O_NONBLOCK, 0666);
    } while (fd < 0 && errno == EINTR);
    return fd;
}

static fw_status check_regular(int fd, const char *path, fw_msg *m)
{
    struct stat s;
    FW_CHECK(fstat(fd, &s) == 0, m, FW_E_IO, "%s: %s", path, strerror(errno));
    FW_CHECK(S_ISREG(s.st_mode), m, FW_E_FORMAT, "%s is not a regular file", path);
    return FW_OK;
}

static bool lock_soon(int fd)
{
    for (int i = 0; i < LOCK_TRIES; i++) {
        if (flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
        if (errno != EWOULDBLOCK && errno != EINTR) return false;
        nanosleep(&(struct timespec){.tv_nsec = LOCK_PAUSE_NS}, NULL);
    }
    errno = EWOULDBLOCK;
    return false;
}

/* Does fd still have this name? Between open and flock another run may have renamed or removed the file; the lock would
 * then guard something that nobody else will ever open. */
static bool has_name(int fd, const char *path)
{
    struct stat a, b;
    return fstat(fd, &a) == 0 && stat(path, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

fw_status fw_file_claim(int *out, const char *path, bool may_create, fw_msg *m)
{
    *out = -1;
    for (int i = 0; i < LOCK_TRIES; i++) {
        int fd = open_file(path, O_RDWR | (may_create ? O_CREAT : 0));
        if (fd < 0 && errno == ENOENT && !may_create) return FW_OK;
        FW_CHECK(fd >= 0, m, FW_E_IO, "%s: cannot be opened for writing: %s", path, strerror(errno));
        fw_status status = check_regular(fd, path, m);
        if (status == FW_OK && !lock_soon(fd)) {
            status = errno == EWOULDBLOCK
                         ? fw_fail(m, FW_E_IO, "%s is in use by another run; wait for its end or stop it first", path)
                         : fw_fail(m, FW_E_IO, "%s: cannot be locked: %s", path, strerror(errno));
        }
        if (status == FW_OK && has_name(fd, path)) {
            *out = fd;
            return FW_OK;
        }
        close(fd);
        FW_TRY(status);
    }
    return fw_fail(m, FW_E_IO, "%s is replaced again and again by another run", path);
}

fw_status fw_file_open_read(int *out, const char *path, fw_msg *m)
{
    *out = -1;
    int fd = open_file(path, O_RDONLY);
    FW_CHECK(fd >= 0, m, FW_E_IO, "%s: cannot be opened: %s", path, strerror(errno));
    fw_status status = check_regular(fd, path, m);
    if (status != FW_OK) {
        close(fd);
        return status;
    }
    *out = fd;
    return FW_OK;
}

bool fw_file_is_locked(int fd)
{
    if (flock(fd, LOCK_SH | LOCK_NB) == 0) {
        flock(fd, LOCK_UN);
        return false;
    }
    return errno == EWOULDBLOCK;
}

fw_status fw_file_write_at(int fd, const char *path, const void *bytes, size_t n, uint64_t offset, size_t *done,
                           fw_msg *m)
{
    size_t    written = 0;
    fw_status status = FW_OK;
    while (written < n && status == FW_OK) {
        ssize_t k = pwrite(fd, (const char *)bytes + written, n - written, (off_t)(offset + written));
        if (k > 0) {
            written += (size_t)k;
        } else if (k == 0 || errno != EINTR) {
            /* A full disk first takes a part of the bytes and says why only when asked again. */
            status = fw_fail(m, FW_E_IO, "%s: only %zu of %zu bytes could be written: %s", path, written, n,
                             k == 0 ? "no reason given" : strerror(errno));
        }
    }
    if (done != NULL) *done = written;
    return status;
}

fw_status fw_file_read_at(int fd, const char *path, void *bytes, size_t n, uint64_t offset, fw_msg *m)
{
    size_t done = 0;
    while (done < n) {
        ssize_t k = pread(fd, (char *)bytes + done, n - done, (off_t)(offset + done));
        if (k > 0) {
            done += (size_t)k;
        } else if (k == 0 || errno != EINTR) {
            return fw_fail(m, FW_E_IO, "%s: only %zu of %zu bytes could be read at %llu: %s", path, done, n,
                           (unsigned long long)offset, k == 0 ? "end of file" : strerror(errno));
        }
    }
    return FW_OK;
}

fw_status fw_file_size(int fd, const char *path, uint64_t *size, fw_msg *m)
{
    struct stat s;
    FW_CHECK(fstat(fd, &s) == 0, m, FW_E_IO, "%s: %s", path, strerror(errno));
    *size = (uint64_t)s.st_size;
    return FW_OK;
}

/* Of the folder that path lies in. Without memory of its own: it comes after the rename, when there is no way back. */
static fw_status sync_folder(const char *path, fw_msg *m)
{
    char        folder[4096];
    const char *slash = strrchr(path, '/');
    size_t      n = slash == path ? 1 : slash != NULL ? (size_t)(slash - path) : 0; /* "/x" lies in "/" */
    FW_CHECK(n < sizeof folder, m, FW_E_IO, "folder %s: %s", path, strerror(ENAMETOOLONG));
    memcpy(folder, n > 0 ? path : ".", n > 0 ? n : 1);
    folder[n > 0 ? n : 1] = '\0';
    int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int code = fd < 0 ? errno : 0;
    if (fd >= 0) {
        /* Some network file systems have no fsync of folders and say EINVAL; there is nothing more to be done on
         * them. */
        if (fsync(fd) != 0 && errno != EINVAL) code = errno;
        close(fd);
    }
    FW_CHECK(code == 0, m, FW_E_IO, "folder %s: %s", folder, strerror(code));
    return FW_OK;
}

fw_status fw_file_publish(int fd, const char *from, const char *to, fw_msg *m)
{
    FW_CHECK(fsync(fd) == 0, m, FW_E_IO, "%s: fsync: %s", from, strerror(errno));
    FW_CHECK(rename(from, to) == 0, m, FW_E_IO, "%s: cannot be renamed to %s: %s", from, to, strerror(errno));
    return sync_folder(to, m);
}

fw_status fw_file_suffixed(char **out, const char *path, const char *suffix, fw_msg *m)
{
    size_t n = strlen(path) + strlen(suffix) + 1;
    FW_TRY(fw_alloc(out, n, 1, "name of a file", m));
    strcpy(*out, path);
    strcat(*out, suffix);
    return FW_OK;
}
