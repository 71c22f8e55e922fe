#include "cli/accuracy_file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { MOST_ROWS = 1000 };

/* ---- the choice as settings ------------------------------------------------------------------------------------- */

static void add_set(fw_choice_sets *s, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
static void add_set(fw_choice_sets *s, const char *fmt, ...)
{
    va_list ap;
    if (s->n == FW_CHOICE_SETS) return;
    va_start(ap, fmt);
    vsnprintf(s->text[s->n++], FW_CHOICE_SET_SIZE, fmt, ap);
    va_end(ap);
}

void fw_choice_sets_make(fw_choice_sets *out, const fw_accuracy_choice *choice)
{
    const fw_numerics *n = &choice->numerics;
    *out = (fw_choice_sets){.n = 0};
    if (n->order) add_set(out, "numerics.order=%d", n->order);
    add_set(out, "numerics.tolerance=%.6g", n->tolerance);
    add_set(out, "numerics.wear_tolerance=%.6g", n->wear_tolerance);
    add_set(out, "numerics.first_step=%.6g", n->first_step);
    add_set(out, "numerics.growth=%.6g", n->growth);
    if (choice->n_arcs > 0) add_set(out, "ring.arcs=%zu", choice->n_arcs);
    if (choice->strip_width >= 0) add_set(out, "field.strip_width=%.6g m", choice->strip_width);
    if (choice->downstream >= 0) add_set(out, "field.downstream=%.6g m", choice->downstream);
    if (choice->warm_up >= 0) add_set(out, "exposure.warm_up=%.6g s", choice->warm_up);
}

/* ---- tables ----------------------------------------------------------------------------------------------------- */

/* One pair of numbers per quantity; offset of an fw_pairs in the row. */
static void add_pairs(fw_table_builder *b, const fw_accuracy_row *rows, size_t offset, const char *const names[3],
                      const char *const long_names[3])
{
    const size_t parts[3] = {offsetof(fw_pairs, mean), offsetof(fw_pairs, error), offsetof(fw_pairs, rms)};
    for (size_t k = 0; k < 3; k++)
        fw_table_numbers(b, names[k], "1", long_names[k], rows, sizeof *rows, offset + parts[k]);
}

static void build_rows(fw_table_builder *b, const char *name, bool is_step, size_t n, const fw_accuracy_row *rows,
                       fw_msg *m)
{
    static const char *const COUPLED[2][3] = {{"coupled_error", "coupled_standard_error", "coupled_rms"},
                                              {"mean relative error of depth over coupled windows; NaN: none",
                                               "standard error of that mean",
                                               "r.m.s. error of single coupled windows"}};
    static const char *const DEPTH[2][3] = {{"depth_error", "depth_standard_error", "depth_rms"},
                                            {"mean relative error of depth over all windows",
                                             "standard error of that mean",
                                             "r.m.s. error of single windows; of the group window: their scatter"}};
    static const char *const PATH[2][3] = {
        {"path_error", "path_standard_error", "path_rms"},
        {"mean relative error of path", "standard error of that mean", "r.m.s. error of single windows"}};
    static const char *const IMPULSE[2][3] = {
        {"impulse_error", "impulse_standard_error", "impulse_rms"},
        {"mean relative error of normal impulse", "standard error of that mean", "r.m.s. error of single windows"}};
    fw_table_start(b, name, n, m);
    const char **group = fw_table_texts(b, "group", "what is varied");
    const char **method = fw_table_texts(b, "method", "scheme, order and wear rule, or the group");
    const char **setting = fw_table_texts(b, "setting", "its level");
    const char **words = fw_table_texts(b, "words", "what has to be said beside the numbers");
    FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, level, "1", "tolerance, step [s], arcs, width or way [m]");
    add_pairs(b, rows, offsetof(fw_accuracy_row, depth), DEPTH[0], DEPTH[1]);
    add_pairs(b, rows, offsetof(fw_accuracy_row, path), PATH[0], PATH[1]);
    add_pairs(b, rows, offsetof(fw_accuracy_row, impulse), IMPULSE[0], IMPULSE[1]);
    if (is_step) {
        add_pairs(b, rows, offsetof(fw_accuracy_row, coupled), COUPLED[0], COUPLED[1]);
        FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, order, "1", "observed order of coupled_rms in level; NaN: none");
        FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, hit_error, "1",
                         "worst error on the embedded single hits; NaN: not run");
        FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, truncation, "1", "mean energy truncation");
    }
    FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, evaluations, "1",
                     "force evaluations of one window, its warm-up included");
    FW_TABLE_NUMBERS(b, rows, fw_accuracy_row, cpu_s, "s", "processor time of one window, its warm-up included");
    double *reference = fw_table_number_column(b, "is_reference", "1", "1: the others are compared with it");
    double *usual = fw_table_number_column(b, "is_default", "1", "1: what a run without this file takes");
    double *chosen = fw_table_number_column(b, "is_chosen", "1", "1: what a run with this file takes");
    for (size_t i = 0; b->status == FW_OK && i < n; i++) {
        group[i] = fw_accuracy_group_name(rows[i].group), method[i] = rows[i].method;
        setting[i] = rows[i].setting, words[i] = rows[i].words;
        reference[i] = rows[i].is_reference, usual[i] = rows[i].is_default, chosen[i] = rows[i].is_chosen;
    }
}

static void build_percentile(fw_table_builder *b, const fw_accuracy *a, fw_msg *m)
{
    fw_table_start(b, "percentile_error", a->n_percentile, m);
    FW_TABLE_COUNTS(b, a->percentile, fw_accuracy_percentile_row, n, "realisations");
    FW_TABLE_NUMBERS(b, a->percentile, fw_accuracy_percentile_row, error, "1", "relative r.m.s. error, from sub-sets");
    FW_TABLE_NUMBERS(b, a->percentile, fw_accuracy_percentile_row, fit, "1", "error of one window over sqrt(n)");
}

static void build_budget(fw_table_builder *b, const fw_accuracy *a, fw_msg *m)
{
    fw_table_start(b, "budget_cpu", a->n_budget, m);
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, budget_cpu_s, "s", "processor time to spend");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, tolerance, "1", "step level");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, cpu_s_window, "s",
                     "processor time of one window of the campaign");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, n, "1", "windows that the budget buys");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, step_error, "1", "relative error of the step");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, sampling_error, "1", "relative error of so many windows");
    FW_TABLE_NUMBERS(b, a->budget, fw_accuracy_budget_row, total_error, "1", "root of the sum of both squares");
    double *chosen = fw_table_number_column(b, "is_chosen", "1", "1: what a run with this file takes");
    for (size_t i = 0; chosen && i < a->n_budget; i++) chosen[i] = a->budget[i].is_chosen;
}

typedef struct choice_row {
    char key[FW_CHOICE_SET_SIZE], unit[16];
} choice_row;

static void build_choice(fw_table_builder *b, const fw_choice_sets *sets, choice_row *rows, fw_msg *m)
{
    fw_table_start(b, "choice", sets->n, m);
    const char **key = fw_table_texts(b, "key", "of a campaign file");
    double      *value = fw_table_number_column(b, "value", "1", "in the unit beside it");
    const char **unit = fw_table_texts(b, "unit", "of value; 1: none");
    const char **set = fw_table_texts(b, "set", "what --set would say");
    for (size_t i = 0; b->status == FW_OK && i < sets->n; i++) {
        char  *end;
        size_t n = strcspn(sets->text[i], "=");
        snprintf(rows[i].key, sizeof rows[i].key, "%.*s", (int)n, sets->text[i]);
        value[i] = strtod(sets->text[i] + n + 1, &end);
        snprintf(rows[i].unit, sizeof rows[i].unit, "%s", *end == ' ' ? end + 1 : "1");
        key[i] = rows[i].key, unit[i] = rows[i].unit, set[i] = sets->text[i];
    }
}

static void add_one(fw_table_builder *b, const char *name, const char *unit, const char *long_name, double value)
{
    double *to = fw_table_number_column(b, name, unit, long_name);
    if (to) *to = value;
}

static void add_text(fw_table_builder *b, const char *name, const char *long_name, const char *value)
{
    const char **to = fw_table_texts(b, name, long_name);
    if (to) *to = value;
}

static void build_summary(fw_table_builder *b, const fw_campaign *c, const fw_accuracy *a, fw_msg *m)
{
    fw_table_start(b, "summary", 1, m);
    add_one(b, "accuracy", "1", "wanted relative error of a window's depth", c->model.accuracy);
    add_one(b, "choice_error", "1", "measured: mean + 2 standard errors, single hits, energy balance", a->choice.error);
    add_one(b, "is_within", "1", "1: choice_error is within accuracy", a->choice.is_within);
    add_text(b, "choice_why", "how the choice was made", a->choice.why);
    add_one(b, "n_windows", "1", "windows of a paired group", (double)a->sizes.n_windows);
    add_one(b, "n_coupled", "1", "windows in which two fine levels stay together", (double)a->n_coupled);
    add_one(b, "way", "m", "ice in a window of the step group", a->sizes.way);
    add_one(b, "warm_up_way", "m", "ice before it", a->sizes.warm_up_way);
    add_one(b, "domain_way", "m", "ice in a window of the other groups", a->sizes.domain_way);
    add_one(b, "mean_speed", "m s-1", "current of the paired windows", a->mean_speed);
    add_one(b, "reference_hit_error", "1", "of the reference on the embedded single hits, worst",
            a->reference_hit_error);
    add_text(b, "reference_hit", "which of them", a->reference_hit);
    add_one(b, "n_percentile", "1", "windows of the percentile group", (double)a->sizes.n_percentile);
    add_one(b, "percentile_window", "s", "their length", a->percentile_window_s);
    add_one(b, "percentile_mm", "mm", "the campaign's percentile of them at the governing point", a->percentile_value);
    add_one(b, "percentile_error_one", "1", "its error from n windows is this over sqrt(n)", a->error_one);
    add_one(b, "percentile_slope", "1", "of ln(error) against ln(n); -0.5 is 1/sqrt(n)", a->percentile_slope);
    add_one(b, "cpu_s_window", "s", "processor time of one window of the campaign at the chosen step", a->cpu_s_window);
    add_one(b, "cpu_s", "s", "processor time of the study", a->cpu_s);
}

void fw_accuracy_file_build_measured(fw_table_builder *b, const fw_measured *measured, fw_msg *m)
{
    const fw_measured_row *rows = measured->rows;
    fw_table_start(b, "accuracy", measured->n_rows, m);
    const char **row = fw_table_texts(b, "row", "source of error");
    FW_TABLE_NUMBERS(b, rows, fw_measured_row, amount, "1", "relative amount; NaN: not measured");
    fw_table_numbers(b, "standard_error", "1", "of the amount; NaN: none", rows, sizeof *rows,
                     offsetof(fw_measured_row, error));
    fw_table_numbers(b, "cpu_factor", "1", "work of a run with half of it over that of this run; NaN: unknown", rows,
                     sizeof *rows, offsetof(fw_measured_row, cost_factor));
    const char **shrinks = fw_table_texts(b, "shrinks_with", "what shrinks it");
    const char **halved = fw_table_texts(b, "halved_by", "the level that has half of it");
    const char **origin = fw_table_texts(b, "origin", "where it was measured");
    double      *own = fw_table_number_column(b, "is_own", "1", "1: on this campaign");
    for (size_t i = 0; b->status == FW_OK && i < measured->n_rows; i++) {
        row[i] = rows[i].row, shrinks[i] = rows[i].shrinks_with, halved[i] = rows[i].halved_by;
        origin[i] = measured->origin, own[i] = measured->is_own;
    }
}

fw_status fw_accuracy_file_write(const char *path, const fw_campaign *c, const fw_accuracy *a, fw_msg *m)
{
    enum { N = 7 };
    fw_table_builder *b;
    fw_table          tables[N];
    fw_choice_sets    sets;
    choice_row        choice_rows[FW_CHOICE_SETS];
    size_t            n_step = 0;
    while (n_step < a->n_rows && a->rows[n_step].group == FW_ACCURACY_STEP) n_step++;
    fw_choice_sets_make(&sets, &a->choice);
    FW_TRY(fw_alloc(&b, N, sizeof *b, "tables of the accuracy study", m));
    build_rows(&b[0], "work_precision", true, n_step, a->rows, m);
    build_rows(&b[1], "domain", false, a->n_rows - n_step, a->rows + n_step, m);
    build_percentile(&b[2], a, m);
    build_budget(&b[3], a, m);
    build_choice(&b[4], &sets, choice_rows, m);
    build_summary(&b[5], c, a, m);
    fw_accuracy_file_build_measured(&b[6], &a->measured, m);
    fw_status s = FW_OK;
    for (int i = 0; i < N; i++) {
        tables[i] = b[i].table;
        if (s == FW_OK) s = b[i].status;
    }
    if (s == FW_OK) s = fw_tables_write(path, FW_ACCURACY_FILETYPE, c, N, tables, m);
    for (int i = 0; i < N; i++) fw_table_free(&b[i]);
    free(b);
    return s;
}

/* ---- reading ---------------------------------------------------------------------------------------------------- */

fw_status fw_accuracy_file_read_sets(const fw_tables *t, fw_choice_sets *out, fw_msg *m)
{
    char  *texts;
    size_t n, width;
    *out = (fw_choice_sets){.n = 0};
    FW_TRY(fw_tables_texts(t, "choice", "set", FW_CHOICE_SETS, &n, &width, &texts, m));
    for (size_t i = 0; i < n; i++) add_set(out, "%s", texts + i * width);
    free(texts);
    return FW_OK;
}

static fw_status read_text_column(const fw_tables *t, const char *name, fw_measured *out, size_t offset, size_t size,
                                  fw_msg *m)
{
    char  *texts;
    size_t n, width;
    FW_TRY(fw_tables_texts(t, "accuracy", name, FW_MEASURED_ROWS, &n, &width, &texts, m));
    out->n_rows = n;
    for (size_t i = 0; i < n; i++) snprintf((char *)&out->rows[i] + offset, size, "%s", texts + i * width);
    free(texts);
    return FW_OK;
}

static fw_status read_number_column(const fw_tables *t, const char *name, fw_measured *out, size_t offset, fw_msg *m)
{
    double *values;
    size_t  n;
    FW_TRY(fw_tables_numbers(t, "accuracy", name, FW_MEASURED_ROWS, &n, &values, m));
    for (size_t i = 0; i < n && i < out->n_rows; i++)
        memcpy((char *)&out->rows[i] + offset, &values[i], sizeof *values);
    free(values);
    return FW_OK;
}

fw_status fw_accuracy_file_read_measured(const fw_tables *t, fw_measured *out, fw_msg *m)
{
    char   *origin;
    double *own;
    size_t  n, width;
    *out = (fw_measured){.n_rows = 0};
    FW_TRY(read_text_column(t, "row", out, offsetof(fw_measured_row, row), sizeof out->rows[0].row, m));
    FW_TRY(read_text_column(t, "shrinks_with", out, offsetof(fw_measured_row, shrinks_with),
                            sizeof out->rows[0].shrinks_with, m));
    FW_TRY(
        read_text_column(t, "halved_by", out, offsetof(fw_measured_row, halved_by), sizeof out->rows[0].halved_by, m));
    FW_TRY(read_number_column(t, "amount", out, offsetof(fw_measured_row, amount), m));
    FW_TRY(read_number_column(t, "standard_error", out, offsetof(fw_measured_row, error), m));
    FW_TRY(read_number_column(t, "cpu_factor", out, offsetof(fw_measured_row, cost_factor), m));
    FW_TRY(fw_tables_texts(t, "accuracy", "origin", FW_MEASURED_ROWS, &n, &width, &origin, m));
    if (n > 0) snprintf(out->origin, sizeof out->origin, "%s", origin);
    free(origin);
    FW_TRY(fw_tables_numbers(t, "accuracy", "is_own", FW_MEASURED_ROWS, &n, &own, m));
    out->is_own = n > 0 && own[0] != 0;
    free(own);
    return FW_OK;
}
