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

#include <math.h>

#include "effects/effects.h"
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

/* table.csv beside the file; none without one. */
static inline void fuzz_save_table(const fuzz_config *c)
{
    char path[FUZZ_PATH];
    fuzz_path(path, "table.csv");
    if (c->table != NULL)
        fuzz_save(path, c->table, c->n_table);
    else
        unlink(path);
}

static inline void fuzz_config_free(fuzz_config *c)
{
    for (size_t i = 0; i < c->n_sets; i++) free(c->sets[i]);
    free(c->text);
    free(c->table);
}

static inline bool fuzz_is_number_word(const char *text)
{
    for (const char *at = text; *at != '\0'; at += strcspn(at, " ")) {
        at += strspn(at, " -+");
        if (strncmp(at, "nan", 3) == 0 || (strncmp(at, "inf", 3) == 0 && strncmp(at, "infi", 4) != 0)) return true;
    }
    return false;
}

/* Effects are settled without a contradiction, each says why in numbers that are numbers, and a course goes forward. */
static inline void fuzz_check_effects(const fw_model *m, const fw_scene_facts *f)
{
    const fw_effect *const *e;
    const char             *key = "", *why = fw_effects_refuse(m, f, &key);
    FUZZ_LAW(why == NULL, "%s: %s", key, why);
    for (size_t i = fw_effects_list(&e); i-- > 0;) {
        char reason[FW_REASON_SIZE] = "";
        e[i]->is_needed(m, f, reason);
        FUZZ_LAW(strlen(reason) >= 5 && !fuzz_is_number_word(reason), "%s: %s", e[i]->name, reason);
    }
    for (size_t i = 0; i < m->tide.n_rows; i++) {
        const fw_course_row *r = &m->tide.rows[i];
        FUZZ_LAW(isfinite(r->time) && isfinite(r->factor) && isfinite(r->turn), "row %zu of the course", i + 1);
        FUZZ_LAW(i == 0 || r->time > r[-1].time, "row %zu of the course: %g s after %g s", i + 1, r->time, r[-1].time);
    }
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
