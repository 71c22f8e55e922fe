/* One input of the campaign and scene targets, taken apart. It stays readable and is a file of its kind:
 *
 *   #set ice.concentration=60 %        first lines of this kind: --set
 *   name: made                         the file
 *   ...
 *   #table                             behind such a line: the file table.csv beside it
 *   speed, direction, ...
 */
#ifndef FW_TESTS_FUZZ_CONFIG_INPUT_H
#define FW_TESTS_FUZZ_CONFIG_INPUT_H

#include "fuzz/fuzz.h"

enum { FUZZ_SETS = 8 };

typedef struct fuzz_config {
    char       *text, *table; /* owned; table NULL: none */
    size_t      n_text, n_table;
    size_t      n_sets;
    char       *sets[FUZZ_SETS]; /* owned */
    const char *set_list[FUZZ_SETS];
} fuzz_config;

/* The first line of bytes that is `line`, or n. */
static inline size_t fuzz_find_line(const char *bytes, size_t n, const char *line)
{
    size_t k = strlen(line);
    for (size_t i = 0; i + k <= n; i++) {
        if ((i == 0 || bytes[i - 1] == '\n') && memcmp(bytes + i, line, k) == 0) return i;
    }
    return n;
}

static inline void fuzz_config_take(fuzz_config *c, const uint8_t *data, size_t size)
{
    static const char set[] = "#set ", table[] = "#table\n";
    const char       *bytes = (const char *)data;
    size_t            at = 0, end = size;

    memset(c, 0, sizeof *c);
    if (size == 0) bytes = "";
    while (c->n_sets < FUZZ_SETS && size - at > strlen(set) && memcmp(bytes + at, set, strlen(set)) == 0) {
        const char *line = bytes + at + strlen(set), *stop = memchr(line, '\n', size - at - strlen(set));
        if (stop == NULL || memchr(line, 0, (size_t)(stop - line)) != NULL) break; /* no argument of a program */
        char *text = fuzz_copy(line, (size_t)(stop - line) + 1);
        text[stop - line] = '\0';
        c->sets[c->n_sets] = text;
        c->set_list[c->n_sets++] = text;
        at = (size_t)(stop + 1 - bytes);
    }
    end = at + fuzz_find_line(bytes + at, size - at, table);
    c->n_text = end - at;
    c->text = fuzz_copy(bytes + at, c->n_text);
    if (end < size) {
        c->n_table = size - end - strlen(table);
        c->table = fuzz_copy(bytes + end + strlen(table), c->n_table);
    }
}

static inline void fuzz_config_free(fuzz_config *c)
{
    for (size_t i = 0; i < c->n_sets; i++) free(c->sets[i]);
    free(c->text);
    free(c->table);
}

/* What was wrong is named by its file, or by the --set that it came from. */
static inline void fuzz_check_config_refusal(const fuzz_config *c, fw_status status, const fw_msg *m, const char *file,
                                             double started)
{
    FUZZ_LAW(status == FW_E_INPUT || status == FW_E_UNSUPPORTED || status == FW_E_IO, "%s: %s", fw_status_name(status),
             m->text);
    bool names_other = (c->n_sets > 0 && strstr(m->text, "--set") != NULL) || strstr(m->text, "table.csv") != NULL;
    fuzz_check_refusal(status, m, names_other ? NULL : file, started);
}

#endif
