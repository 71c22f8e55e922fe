/* Shared by the fuzz targets: a law that ends the program when it is broken, the second that a refusal may take, and
 * a folder for the readers that want a file. */
#ifndef FW_TESTS_FUZZ_H
#define FW_TESTS_FUZZ_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "floewear/status.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* abort, so that libFuzzer keeps the input and a debugger stops at the law. */
static inline void fuzz_broken(const char *file, int line, const char *law, const char *fmt, ...)
    __attribute__((format(printf, 4, 5), noreturn));
static inline void fuzz_broken(const char *file, int line, const char *law, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    fprintf(stderr, "%s:%d: broken law: %s\n  ", file, line, law);
    vfprintf(stderr, fmt, ap);
    fputc('\n', stderr);
    va_end(ap);
    abort();
}

#define FUZZ_LAW(cond, ...)                                                                                            \
    do {                                                                                                               \
        if (!(cond)) fuzz_broken(__FILE__, __LINE__, #cond, __VA_ARGS__);                                              \
    } while (0)

/* Processor time, because a busy machine is no fault of the reader's. */
#define FUZZ_SECONDS 1.0

/* A refusal says why: a sentence with the name of what is wrong in it (name NULL: any), and within a second. */
static inline void fuzz_check_refusal(fw_status status, const fw_msg *m, const char *name, double started)
{
    double took = fw_cpu_seconds() - started;
    FUZZ_LAW(memchr(m->text, 0, sizeof m->text) != NULL && strlen(m->text) >= 10, "%s without a message",
             fw_status_name(status));
    FUZZ_LAW(name == NULL || strstr(m->text, name) != NULL, "%s does not name %s: %s", fw_status_name(status), name,
             m->text);
    FUZZ_LAW(took < FUZZ_SECONDS, "%.2f s for: %s", took, m->text);
}

/* ---- the folder ---- */

enum { FUZZ_PATH = 256 };

static char        fuzz_folder[FUZZ_PATH - 64];
static const char *fuzz_names[8]; /* the files that may be in it */

static inline void fuzz_path(char path[FUZZ_PATH], const char *name)
{
    snprintf(path, FUZZ_PATH, "%s/%s", fuzz_folder, name);
}

static inline void fuzz_leave_folder(void)
{
    char path[FUZZ_PATH];
    for (size_t i = 0; i < sizeof fuzz_names / sizeof fuzz_names[0] && fuzz_names[i] != NULL; i++) {
        fuzz_path(path, fuzz_names[i]);
        unlink(path);
    }
    rmdir(fuzz_folder);
}

/* Once per program; removed at its end, with the named files (NULL at the end). */
static inline void fuzz_enter_folder(const char *const *names)
{
    if (fuzz_folder[0] != '\0') return;
    const char *above = getenv("TMPDIR");
    snprintf(fuzz_folder, sizeof fuzz_folder, "%s/floewear-fuzz-XXXXXX", above != NULL ? above : "/tmp");
    FUZZ_LAW(mkdtemp(fuzz_folder) != NULL, "no folder %s", fuzz_folder);
    for (size_t i = 0; names[i] != NULL && i < sizeof fuzz_names / sizeof fuzz_names[0]; i++) fuzz_names[i] = names[i];
    atexit(fuzz_leave_folder);
}

static inline void fuzz_save(const char *path, const void *bytes, size_t n)
{
    FILE *f = fopen(path, "wb");
    FUZZ_LAW(f != NULL && fwrite(bytes, 1, n, f) == n && fclose(f) == 0, "%s cannot be written", path);
}

/* A copy with nothing behind it, so that the sanitizer sees a reader that goes too far; the caller frees. */
static inline char *fuzz_copy(const void *bytes, size_t n)
{
    char *copy = malloc(n > 0 ? n : 1);
    FUZZ_LAW(copy != NULL, "no memory");
    if (n > 0) memcpy(copy, bytes, n);
    return copy;
}

#endif
