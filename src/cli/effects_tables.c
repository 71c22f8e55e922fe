#include "cli/effects_tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "effects/effects.h"

/* One list of columns writes and reads. */
enum { NUMBER, COUNT, FLAG, TEXT };
typedef struct member {
    const char *name, *unit, *long_name;
    int         kind;
    size_t      offset, size; /* in the row; of a text */
} member;

#define ROW(kind, member_, unit, long_name) {#member_, unit, long_name, kind, offsetof(fw_effects_row, member_), sizeof((fw_effects_row *)0)->member_}
#define CHANGE(of, part, name, long_name) {name, "1", long_name, NUMBER, offsetof(fw_effects_row, of) + offsetof(fw_change, part), sizeof(double)}
static const member ROWS[] = {
    ROW(TEXT, name, "1", "effect, or key of an open choice"),
    ROW(TEXT, change, "1", "what is changed"),
    ROW(TEXT, why, "1", "what that is, or why one asks"),
    ROW(TEXT, note, "1", "why it was not measured; empty: it was"),
    ROW(FLAG, is_effect, "1", "1: an effect; 0: an open choice"),
    ROW(FLAG, was_on, "1", "1: an effect of the campaign's own set"),
    CHANGE(mean, change, "mean_change", "relative change of the mean window depth at the governing point; NaN: not measured"),
    CHANGE(mean, low, "mean_low", "lower end of its interval"),
    CHANGE(mean, high, "mean_high", "upper end of its interval"),
    CHANGE(percentile, change, "percentile_change", "relative change of the percentile of window depth there"),
    CHANGE(percentile, low, "percentile_low", "lower end of its interval"),
    CHANGE(percentile, high, "percentile_high", "upper end of its interval"),
    ROW(NUMBER, evaluations_saved, "1", "force evaluations saved, over those of the campaign's own set"),
    ROW(NUMBER, cpu_saved, "1", "processor time saved, likewise"),
    ROW(NUMBER, evaluations_share, "1", "its share of the force evaluations; NaN: it was off"),
    ROW(NUMBER, cpu_share, "1", "its share of the processor time; NaN: it was off"),
    ROW(COUNT, n_pairs, "1", "windows that succeeded both ways"),
    ROW(COUNT, n_failed, "1", "windows that did not"),
};
#define ALL(kind, member_, unit, long_name) \
    {#member_, unit, long_name, kind, offsetof(fw_effects_ledger, member_), sizeof((fw_effects_ledger *)0)->member_}
static const member SUMMARY[] = {
    ALL(TEXT, origin, "1", "where it was measured"),
    ALL(COUNT, n_windows, "1", "windows run every way"),
    ALL(NUMBER, way, "m", "ice in each, in the mean; infinite: the campaign's own windows"),
    ALL(NUMBER, seconds, "s", "time of each"),
    ALL(COUNT, point, "1", "governing measuring point, from 1"),
    ALL(NUMBER, percentile, "1", "percentile, 0 to 100"),
    ALL(NUMBER, confidence, "1", "of the intervals"),
    ALL(NUMBER, mean_mm, "mm", "mean depth of a window of the campaign at that point"),
    ALL(NUMBER, percentile_mm, "mm", "percentile of it, with the scatter of the short windows"),
    ALL(NUMBER, evaluations, "1", "force evaluations of the campaign's own set, all windows"),
    ALL(NUMBER, evaluations_bare, "1", "share of them without any effect"),
    ALL(NUMBER, cpu_s, "s", "processor time of the campaign's own set, which shares are of"),
    ALL(NUMBER, cpu_s_first, "s", "the same, run first"),
    ALL(NUMBER, cpu_bare, "1", "share of processor time without any effect"),
    ALL(NUMBER, cpu_noise, "1", "standard error of a difference of two ways, over cpu_s"),
    ALL(NUMBER, cpu_s_study, "s", "processor time of the whole study"),
};
enum { N_ROWS = sizeof ROWS / sizeof ROWS[0], N_SUMMARY = sizeof SUMMARY / sizeof SUMMARY[0] };

static const char TABLE[] = "effects", TABLE_SUMMARY[] = "effects_summary";

/* ---- writing ---------------------------------------------------------------------------------------------------- */

static void build(fw_table_builder *b, const char *name, size_t n_members, const member *members, size_t n, const void *rows, size_t stride, fw_msg *m)
{
    fw_table_start(b, name, n, m);
    for (size_t k = 0; k < n_members; k++) {
        const member *of = &members[k];
        const char   *at = (const char *)rows + of->offset;
        if (of->kind == NUMBER) {
            fw_table_numbers(b, of->name, of->unit, of->long_name, rows, stride, of->offset);
        } else if (of->kind == TEXT) {
            const char **to = fw_table_texts(b, of->name, of->long_name);
            for (size_t i = 0; to && i < n; i++) to[i] = at + i * stride;
        } else {
            double *to = fw_table_number_column(b, of->name, of->unit, of->long_name);
            for (size_t i = 0; to && i < n; i++) {
                const char *from = at + i * stride;
                to[i] = of->kind == FLAG ? (double)*(const bool *)from : (double)*(const size_t *)(const void *)from;
            }
        }
    }
}

void fw_effects_tables_build(fw_table_builder *b, const fw_effects_ledger *l, fw_msg *m)
{
    build(&b[0], TABLE, N_ROWS, ROWS, l->n_rows, l->rows, sizeof *l->rows, m);
    build(&b[1], TABLE_SUMMARY, N_SUMMARY, SUMMARY, l->n_rows ? 1 : 0, l, sizeof *l, m);
}

fw_status fw_effects_tables_write(const char *path, const fw_campaign *c, const fw_effects_ledger *l, fw_msg *m)
{
    fw_table_builder *b;
    FW_TRY(fw_alloc(&b, FW_EFFECTS_TABLES, sizeof *b, "tables of the effects ledger", m));
    fw_effects_tables_build(b, l, m);
    fw_table  tables[FW_EFFECTS_TABLES] = {b[0].table, b[1].table};
    fw_status s = b[0].status != FW_OK ? b[0].status : b[1].status;
    if (s == FW_OK) s = fw_tables_write(path, FW_EFFECTS_FILETYPE, c, FW_EFFECTS_TABLES, tables, m);
    for (size_t i = 0; i < FW_EFFECTS_TABLES; i++) fw_table_free(&b[i]);
    free(b);
    return s;
}

/* ---- reading ---------------------------------------------------------------------------------------------------- */

static fw_status read_texts(const fw_tables *t, const char *table, const member *of, size_t most, size_t *n, char *at, size_t stride, fw_msg *m)
{
    char  *texts;
    size_t width;
    FW_TRY(fw_tables_texts(t, table, of->name, most, n, &width, &texts, m));
    for (size_t i = 0; i < *n; i++) snprintf(at + i * stride, of->size, "%s", texts + i * width);
    free(texts);
    return FW_OK;
}

static fw_status read_numbers(const fw_tables *t, const char *table, const member *of, size_t most, size_t *n, char *at, size_t stride, fw_msg *m)
{
    double   *values;
    fw_status s = FW_OK;
    FW_TRY(fw_tables_numbers(t, table, of->name, most, n, &values, m));
    for (size_t i = 0; i < *n && s == FW_OK; i++) {
        char *to = at + i * stride;
        if (of->kind == NUMBER) {
            memcpy(to, &values[i], sizeof values[i]);
        } else if (of->kind == FLAG) {
            bool is = values[i] != 0;
            memcpy(to, &is, sizeof is);
        } else if (values[i] >= 0 && values[i] < 1e15) {
            size_t count = (size_t)values[i];
            memcpy(to, &count, sizeof count);
        } else {
            s = fw_fail(m, FW_E_FORMAT, "/%s/%s: %g is no count", table, of->name, values[i]);
        }
    }
    free(values);
    return s;
}

/* All columns of a table have as many rows. */
static fw_status read_table(const fw_tables *t, const char *table, size_t n_members, const member *members, size_t most, size_t *n, void *rows,
                            size_t stride, fw_msg *m)
{
    for (size_t k = 0; k < n_members; k++) {
        const member *of = &members[k];
        char         *at = (char *)rows + of->offset;
        size_t        own;
        FW_TRY(of->kind == TEXT ? read_texts(t, table, of, most, &own, at, stride, m) : read_numbers(t, table, of, most, &own, at, stride, m));
        FW_CHECK(k == 0 || own == *n, m, FW_E_FORMAT, "/%s/%s has %zu rows, the columns before it %zu", table, of->name, own, *n);
        *n = own;
    }
    return FW_OK;
}

fw_status fw_effects_tables_read(const fw_tables *t, fw_effects_ledger *out, fw_msg *m)
{
    size_t n = 0, one = 0;
    memset(out, 0, sizeof *out);
    if (!fw_tables_has(t, TABLE) || !fw_tables_has(t, TABLE_SUMMARY)) return FW_OK;
    fw_status s = read_table(t, TABLE_SUMMARY, N_SUMMARY, SUMMARY, 1, &one, out, sizeof *out, m);
    if (s == FW_OK) s = read_table(t, TABLE, N_ROWS, ROWS, FW_EFFECTS_ROWS, &n, out->rows, sizeof *out->rows, m);
    if (s == FW_OK && n > 0 && one == 0) s = fw_fail(m, FW_E_FORMAT, "/%s is empty and /%s is not", TABLE_SUMMARY, TABLE);
    for (size_t i = 0; i < n && s == FW_OK; i++) { /* bits are this program's, names are everybody's */
        const fw_effect *e = out->rows[i].is_effect ? fw_effects_find(out->rows[i].name) : NULL;
        out->rows[i].bit = e ? (uint32_t)e->bit : 0;
    }
    out->n_rows = n;
    if (s != FW_OK) memset(out, 0, sizeof *out);
    return s;
}
