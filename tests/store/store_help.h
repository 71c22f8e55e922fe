/* What the tests of the store share: a folder of their own, a small campaign, and records made from their id alone. */
#ifndef FW_TESTS_STORE_HELP_H
#define FW_TESTS_STORE_HELP_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "floewear/campaign.h"

#define assert_ok(call)                                                                                                \
    do {                                                                                                               \
        fw_status status_ = (call);                                                                                    \
        if (status_ != FW_OK) print_error("%s: %s\n", fw_status_name(status_), msg.text);                              \
        assert_int_equal(status_, FW_OK);                                                                              \
    } while (0)

static fw_msg msg; /* of the latest call */

static inline int help_enter_folder(void **state) /* group set-up: everything is written into one new folder */
{
    static char folder[] = "store-test-XXXXXX";
    if (mkdtemp(folder) == NULL || chdir(folder) != 0) return -1;
    *state = folder;
    return 0;
}

static inline int help_leave_folder(void **state)
{
    char command[64];
    if (chdir("..") != 0) return -1;
    snprintf(command, sizeof command, "rm -rf '%s'", (const char *)*state);
    return system(command);
}

static inline fw_campaign help_campaign(size_t n_arcs, size_t n_laws)
{
    static char settings[] = "contact.stiffness = 2e6 N/m\ncurrent.speed = 2 m/s\nice.density = 900 kg/m3\nseed = 7\n";
    static char text[] = "name: small\ncurrent: {speed: 2 m/s}  # \xc3\xa4\n";
    fw_campaign c = {.text = text, .settings = settings, .hash = 0x1234, .seed = 7};
    strcpy(c.name, "small");
    c.model.n_arcs = n_arcs;
    c.model.n_laws = n_laws;
    for (size_t i = 0; i < n_laws; i++) {
        strcpy(c.model.laws[i].name, i == 0 ? "bekker2011" : "archard");
        c.model.laws[i].exponent = i == 0 ? 1.121 : 1.0;
    }
    c.precision.max_realisations = 50;
    return c;
}

static inline uint64_t help_next(uint64_t *state) /* splitmix64 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Any bits at all, every seventh realisation failed; host_cpu_s is a plain number that the caller may change. */
static inline void help_fill(fw_record *r, uint64_t id)
{
    uint64_t state = id * 1000003u + 11;
    r->id = id;
    r->status = id % 7 == 6 ? FW_E_LIMIT : FW_OK;
    memset(r->cause, 0, sizeof r->cause);
    if (r->status != FW_OK) snprintf(r->cause, sizeof r->cause, "realisation %u: limit", (unsigned)id);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        uint64_t bits = help_next(&state);
        memcpy((char *)r + fw_record_columns[i].offset, &bits, 8);
    }
    r->host_cpu_s = 0.25;
    for (size_t i = 0; i < fw_record_n_rings(r->n_arcs, r->n_laws); i++) {
        uint64_t bits = help_next(&state);
        memcpy(&r->rings[i], &bits, 8);
        if (r->status != FW_OK) r->rings[i] = 0.0;
    }
    if (r->status == FW_OK && r->n_arcs > 2) {
        r->rings[0] = NAN;
        r->rings[1] = -0.0;
        r->rings[2] = INFINITY;
    }
}

static inline void help_assert_same(const fw_record *a, const fw_record *b)
{
    assert_true(a->id == b->id);
    assert_int_equal(a->status, b->status);
    assert_string_equal(a->cause, b->cause);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        size_t o = fw_record_columns[i].offset;
        assert_memory_equal((const char *)a + o, (const char *)b + o, 8);
    }
    assert_memory_equal(a->rings, b->rings, 8 * fw_record_n_rings(a->n_arcs, a->n_laws));
}

/* A whole file in memory; the caller frees. */
static inline unsigned char *help_load(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    assert_int_equal(fseek(f, 0, SEEK_END), 0);
    long size = ftell(f);
    assert_true(size >= 0);
    rewind(f);
    unsigned char *bytes = malloc((size_t)size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)size, f), size);
    fclose(f);
    *n = (size_t)size;
    return bytes;
}

static inline void help_save(const char *path, const unsigned char *bytes, size_t n)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, n, f), n);
    assert_int_equal(fclose(f), 0);
}

static inline bool help_exists(const char *path)
{
    struct stat s;
    return lstat(path, &s) == 0;
}

#endif
