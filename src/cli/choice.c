#include "cli/choice.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/config.h"
#include "cli/effects_print.h"
#include "cli/effects_tables.h"
#include "cli/plan_design.h"
#include "effects/effects.h"
#include "study/effects_measured.h"

fw_status fw_choice_path(char *path, size_t size, const char *out, fw_choice_file kind, fw_msg *m)
{
    static const char *const ENDS[] = {[FW_CHOICE_ACCURACY] = ".accuracy.h5", [FW_CHOICE_EFFECTS] = ".effects.h5", [FW_CHOICE_PLAN] = ".plan.h5",
                                       [FW_CHOICE_JOURNAL] = ".journal", [FW_CHOICE_RESULTS] = ".h5"};
    size_t                   n = strlen(out);
    for (size_t i = 0; i < sizeof ENDS / sizeof ENDS[0]; i++) {
        size_t k = strlen(ENDS[i]);
        if (n <= k || strcmp(out + n - k, ENDS[i]) != 0) continue;
        n -= k;
        break;
    }
    FW_CHECK(n > 0 && out[n - 1] != '/', m, FW_E_INPUT, "-o %s: a file name is wanted, not a folder", out);
    FW_CHECK(n + sizeof ".accuracy.h5" <= size, m, FW_E_INPUT, "-o: the output name is longer than %zu characters",
             size - sizeof ".accuracy.h5");
    snprintf(path, size, "%.*s%s", (int)n, out, ENDS[kind]);
    return FW_OK;
}

void fw_choice_first_difference(const char *a, const char *b, char *key, size_t size)
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

/* FW_E_MISMATCH: the file belongs to another campaign. */
static fw_status check_owner(const fw_tables *t, const char *path, const fw_campaign *bare, fw_msg *m)
{
    char        key[64];
    const char *theirs = fw_tables_settings(t);
    if (strcmp(theirs, bare->settings) == 0) return FW_OK;
    fw_choice_first_difference(theirs, bare->settings, key, sizeof key);
    return fw_fail(m, FW_E_MISMATCH, "%s belongs to another campaign (%s differs)", path, key);
}

static fw_status read_choice(const char *path, const fw_campaign *bare, found *out, fw_msg *m)
{
    fw_tables *t;
    FW_TRY(fw_tables_open(&t, path, FW_ACCURACY_FILETYPE, m));
    fw_status s = check_owner(t, path, bare, m);
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

/* What is put on top of the user's own sets. */
typedef struct extra {
    fw_choice_sets numerics;
    char           effects[400]; /* "effects={added_mass: off}"; empty: none */
    char          *design;       /* "sampling={design: ...}"; NULL: none; owned */
} extra;

/* The campaign again, with the choices' sets after the user's. */
static fw_status apply(fw_campaign *c, const fw_choice_wanted *w, const extra *x, fw_msg *m)
{
    const char **all;
    size_t       n = w->n_sets;
    fw_campaign  chosen;
    if (x->numerics.n == 0 && !x->effects[0] && !x->design) return FW_OK;
    FW_TRY(fw_alloc(&all, n + x->numerics.n + 2, sizeof *all, "--set", m));
    for (size_t i = 0; i < n; i++) all[i] = w->sets[i];
    for (size_t i = 0; i < x->numerics.n; i++) all[n++] = x->numerics.text[i];
    if (x->effects[0]) all[n++] = x->effects;
    if (x->design) all[n++] = x->design;
    fw_status s = fw_config_campaign(&chosen, w->campaign, n, all, w->seed, m);
    free(all);
    FW_TRY(s);
    fw_campaign_free(c);
    *c = chosen;
    return FW_OK;
}

/* ---- numerics --------------------------------------------------------------------------------------------------- */

static fw_status choose_numerics(const fw_campaign *c, const fw_choice_wanted *w, const char *path, fw_choice *out, fw_choice_sets *sets, fw_msg *m)
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
    out->is_taken = true;
    *sets = f.sets;
    size_t n = (size_t)snprintf(out->line, sizeof out->line, "numerics: chosen by %.300s:", path);
    for (size_t i = 0; i < f.sets.n && n < sizeof out->line; i++)
        n += (size_t)snprintf(out->line + n, sizeof out->line - n, " %s", f.sets.text[i]);
    return FW_OK;
}

static fw_status find_numerics(const fw_campaign *c, const fw_choice_wanted *w, fw_choice *out, fw_choice_sets *sets, fw_msg *m)
{
    char path[4096];
    fw_measured_default(&out->measured, &c->model);
    if (has_numerics(&c->model)) {
        snprintf(out->line, sizeof out->line, "numerics: as the campaign says");
        FW_CHECK(!w->from, m, FW_E_INPUT, "--accuracy-from %s: the campaign names its own numerics; leave one of them out", w->from);
        return FW_OK;
    }
    if (!w->from) FW_TRY(fw_choice_path(path, sizeof path, w->out ? w->out : c->name, FW_CHOICE_ACCURACY, m));
    return choose_numerics(c, w, w->from ? w->from : path, out, sets, m);
}

/* ---- effects ---------------------------------------------------------------------------------------------------- */

#define SAY_EFFECTS(...) snprintf(out->effects_line, sizeof out->effects_line, __VA_ARGS__)

/* Whoever says what is on has decided. */
static bool has_effects(const fw_campaign *c) { return (c->model.given & (uint32_t)FW_GIVEN_EFFECTS) != 0; }

/* Which effects go, as a set, and the line that says why. */
static void leave_out(const fw_campaign *c, const char *path, fw_choice *out, char *set, size_t size)
{
    const fw_effects_row *rows[FW_EFFECTS_ROWS];
    double                tolerance = c->model.effects_tolerance;
    size_t                n = fw_effects_ledger_drops(&out->effects, tolerance, rows), used = 0, said = 0;
    if (!(tolerance > 0)) return;
    if (has_effects(c)) return;
    said = (size_t)SAY_EFFECTS("effects: by %.200s %s moves less than effects_tolerance %g %% and costs more than 1 %%", path,
                               n ? "this" : "none", 100 * tolerance);
    for (size_t i = 0; i < n; i++) {
        char             mean[48], percentile[48];
        const fw_effect *e = fw_effects_find(rows[i]->name);
        if (!e || used + 48 > size) continue;
        used += (size_t)snprintf(set + used, size - used, "%s%s: off", used ? ", " : "effects={", e->name);
        out->dropped |= (uint32_t)e->bit;
        if (said < sizeof out->effects_line)
            said += (size_t)snprintf(out->effects_line + said, sizeof out->effects_line - said, "%s %s (mean %s, P%g %s)", i ? "," : ", and is left out:", e->name,
                                     fw_effects_say_change(mean, sizeof mean, &rows[i]->mean), out->effects.percentile,
                                     fw_effects_say_change(percentile, sizeof percentile, &rows[i]->percentile));
    }
    if (used) snprintf(set + used, size - used, "}");
}

static fw_status find_effects(const fw_campaign *c, const fw_choice_wanted *w, fw_choice *out, char *set, size_t size, fw_msg *m)
{
    char        path[4096];
    fw_msg      why = {""};
    fw_tables  *t = NULL;
    struct stat st;
    FW_TRY(fw_choice_path(path, sizeof path, w->out ? w->out : c->name, FW_CHOICE_EFFECTS, m));
    fw_effects_measured_default(&out->effects, &c->model);
    if (c->model.effects_tolerance > 0 && has_effects(c)) SAY_EFFECTS("effects: as the campaign says; effects_tolerance acts under effects: auto alone");
    if (stat(path, &st) != 0) {
        if (c->model.effects_tolerance > 0 && !has_effects(c)) SAY_EFFECTS("effects: none is left out: no %.300s (floewear plan --effects writes it)", path);
        return FW_OK;
    }
    fw_status s = fw_tables_open(&t, path, FW_EFFECTS_FILETYPE, &why);
    if (s == FW_OK) s = check_owner(t, path, c, &why);
    if (s == FW_OK) s = fw_effects_tables_read(t, &out->effects, &why);
    fw_tables_close(t);
    FW_CHECK(s != FW_E_NOMEM, m, s, "%s", why.text); /* not to go on with other effects for that */
    if (s != FW_OK) {
        fw_effects_measured_default(&out->effects, &c->model);
        SAY_EFFECTS("effects: not used: %.400s", why.text);
        return FW_OK;
    }
    leave_out(c, path, out, set, size);
    return FW_OK;
}

/* ---- design ------------------------------------------------------------------------------------------------------ */

#define SAY_DESIGN(...) snprintf(out->design_line, sizeof out->design_line, __VA_ARGS__)

static fw_status find_design(const fw_campaign *c, const fw_choice_wanted *w, fw_choice *out, char **set, fw_msg *m)
{
    char        path[4096], words[400];
    fw_msg      why = {""};
    fw_tables  *t = NULL;
    struct stat st;
    if (w->is_planning || !c->sampling.is_auto) return FW_OK;
    FW_TRY(fw_choice_path(path, sizeof path, w->out ? w->out : c->name, FW_CHOICE_PLAN, m));
    if (stat(path, &st) != 0) {
        SAY_DESIGN("design: plain (no %.300s; floewear plan writes it, by a pilot)", path);
        return FW_OK;
    }
    fw_status s = fw_tables_open(&t, path, FW_PLAN_FILETYPE, &why);
    if (s == FW_OK) s = check_owner(t, path, c, &why);
    if (s == FW_OK) s = fw_plan_file_read(t, set, words, sizeof words, &why);
    fw_tables_close(t);
    FW_CHECK(s != FW_E_NOMEM, m, s, "%s", why.text); /* not to go on with another design for that */
    if (s == FW_OK)
        SAY_DESIGN("design: by %.100s, %.380s", path, words);
    else
        SAY_DESIGN("design: plain; not used: %.400s", why.text);
    return FW_OK;
}

/* ---- all of them ------------------------------------------------------------------------------------------------- */

/* A set that the rules refuse (something else needs what was to be left out) is not taken. */
static fw_status apply_all(fw_campaign *c, const fw_choice_wanted *w, extra *x, fw_choice *out, fw_msg *m)
{
    fw_msg    why = {""};
    fw_status s = apply(c, w, x, &why);
    if (s == FW_E_INPUT && x->effects[0]) {
        x->effects[0] = '\0', out->dropped = 0;
        SAY_EFFECTS("effects: none is left out, as %.400s", why.text);
        return apply(c, w, x, m);
    }
    if (s != FW_OK && m) *m = why;
    return s;
}

fw_status fw_choice_campaign(fw_campaign *c, const fw_choice_wanted *w, fw_choice *out, fw_msg *m)
{
    extra x;
    memset(out, 0, sizeof *out);
    memset(&x, 0, sizeof x);
    FW_TRY(fw_config_campaign(c, w->campaign, w->n_sets, w->sets, w->seed, m));
    fw_status s = find_numerics(c, w, out, &x.numerics, m);
    if (s == FW_OK) s = find_effects(c, w, out, x.effects, sizeof x.effects, m);
    if (s == FW_OK) s = find_design(c, w, out, &x.design, m);
    if (s == FW_OK) s = apply_all(c, w, &x, out, m);
    free(x.design);
    if (s != FW_OK) fw_campaign_free(c);
    return s;
}
