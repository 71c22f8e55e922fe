#include "cli/choice.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/config.h"

fw_status fw_choice_path(char *path, size_t size, const char *out, fw_msg *m)
{
    static const char *const ENDS[] = {".accuracy.h5", ".h5"};
    size_t                   n = strlen(out);
    for (size_t i = 0; i < 2; i++) {
        size_t k = strlen(ENDS[i]);
        if (n <= k || strcmp(out + n - k, ENDS[i]) != 0) continue;
        n -= k;
        break;
    }
    FW_CHECK(n > 0 && out[n - 1] != '/', m, FW_E_INPUT, "-o %s: a file name is wanted, not a folder", out);
    FW_CHECK(n + sizeof ".accuracy.h5" <= size, m, FW_E_INPUT, "-o: the output name is longer than %zu characters",
             size - sizeof ".accuracy.h5");
    snprintf(path, size, "%.*s.accuracy.h5", (int)n, out);
    return FW_OK;
}

/* The first line in which two settings differ, by its key; both are lists of "key = value\n" in one order. */
static void first_difference(const char *a, const char *b, char *key, size_t size)
{
    for (;;) {
        size_t n = strcspn(a, "\n"), k = strcspn(b, "\n");
        if (n != k || strncmp(a, b, n) != 0 || a[n] != b[n] || a[n] == '\0') break;
        a += n + 1, b += n + 1;
    }
    const char *line = *a ? a : b;
    snprintf(key, size, "%.*s", (int)strcspn(line, " \n"), line);
}

typedef struct found {
    fw_choice_sets sets;
    fw_measured    measured;
} found;

static fw_status read_choice(const char *path, const fw_campaign *bare, found *out, fw_msg *m)
{
    fw_tables *t;
    FW_TRY(fw_tables_open(&t, path, FW_ACCURACY_FILETYPE, m));
    fw_status   s = FW_OK;
    const char *theirs = fw_tables_settings(t);
    if (strcmp(theirs, bare->settings) != 0) {
        char key[64];
        first_difference(theirs, bare->settings, key, sizeof key);
        s = fw_fail(m, FW_E_MISMATCH, "%s belongs to another campaign (%s differs)", path, key);
    }
    if (s == FW_OK) s = fw_accuracy_file_read_sets(t, &out->sets, m);
    if (s == FW_OK) s = fw_accuracy_file_read_measured(t, &out->measured, m);
    fw_tables_close(t);
    return s;
}

static bool has_numerics(const fw_model *m)
{
    const fw_numerics *n = &m->numerics;
    return n->order != 0 || n->tolerance > 0 || n->wear_tolerance > 0 || n->first_step > 0 || n->growth > 0;
}

/* The campaign again, with the choice's sets after the user's. */
static fw_status apply(fw_campaign *c, const fw_choice_wanted *w, const fw_choice_sets *sets, fw_msg *m)
{
    const char **all;
    fw_campaign  chosen;
    FW_TRY(fw_alloc(&all, w->n_sets + sets->n, sizeof *all, "--set", m));
    for (size_t i = 0; i < w->n_sets; i++) all[i] = w->sets[i];
    for (size_t i = 0; i < sets->n; i++) all[w->n_sets + i] = sets->text[i];
    fw_status s = fw_config_campaign(&chosen, w->campaign, w->n_sets + sets->n, all, w->seed, m);
    free(all);
    FW_TRY(s);
    fw_campaign_free(c);
    *c = chosen;
    return FW_OK;
}

static fw_status choose(fw_campaign *c, const fw_choice_wanted *w, const char *path, fw_choice *out, fw_msg *m)
{
    found       f;
    fw_msg      why = {""};
    struct stat st;
    if (!w->from && stat(path, &st) != 0) {
        snprintf(out->line, sizeof out->line,
                 "numerics: built in for accuracy %g %% (no %.300s; floewear accuracy writes it)",
                 100 * c->model.accuracy, path);
        return FW_OK;
    }
    fw_status s = read_choice(path, c, &f, &why);
    if (s == FW_E_NOMEM || (s != FW_OK && w->from)) { /* no memory: not to go on with other numerics for that */
        *m = why;
        return s;
    }
    if (s != FW_OK) {
        snprintf(out->line, sizeof out->line, "numerics: built in for accuracy %g %%; not used: %.300s",
                 100 * c->model.accuracy, why.text);
        return FW_OK;
    }
    out->measured = f.measured;
    FW_TRY(apply(c, w, &f.sets, m));
    out->is_taken = true;
    size_t n = (size_t)snprintf(out->line, sizeof out->line, "numerics: chosen by %.300s:", path);
    for (size_t i = 0; i < f.sets.n && n < sizeof out->line; i++)
        n += (size_t)snprintf(out->line + n, sizeof out->line - n, " %s", f.sets.text[i]);
    return FW_OK;
}

fw_status fw_choice_campaign(fw_campaign *c, const fw_choice_wanted *w, fw_choice *out, fw_msg *m)
{
    char path[4096];
    memset(out, 0, sizeof *out);
    FW_TRY(fw_config_campaign(c, w->campaign, w->n_sets, w->sets, w->seed, m));
    fw_measured_default(&out->measured, &c->model);
    fw_status s = FW_OK;
    if (has_numerics(&c->model)) {
        snprintf(out->line, sizeof out->line, "numerics: as the campaign says");
        if (w->from)
            s = fw_fail(m, FW_E_INPUT, "--accuracy-from %s: the campaign names its own numerics; leave one of them out",
                        w->from);
    } else {
        s = w->from ? FW_OK : fw_choice_path(path, sizeof path, w->out ? w->out : c->name, m);
        if (s == FW_OK) s = choose(c, w, w->from ? w->from : path, out, m);
    }
    if (s != FW_OK) fw_campaign_free(c);
    return s;
}
