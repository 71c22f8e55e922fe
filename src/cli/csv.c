#include "cli/csv.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { MAX_FIELDS = 64, MAX_UNIT = 40, MAX_CELL = 64 };

typedef struct header {
    size_t n_fields;
    int    column[MAX_FIELDS];                 /* which wanted column a field is */
    char   unit[FW_CSV_MAX_COLUMNS][MAX_UNIT]; /* of bare numbers; "" : the column's own */
} header;

/* Cut the line at its commas in place; blanks and one pair of double quotes round a field go. Number of fields,
 * MAX_FIELDS + 1 when there are more. */
static size_t split(char *line, char *fields[MAX_FIELDS])
{
    size_t n = 0;

    for (char *p = line; p; n++) {
        char *comma = strchr(p, ',');
        if (n == MAX_FIELDS) return MAX_FIELDS + 1;
        if (comma) *comma = '\0';
        p += strspn(p, " \t");
        size_t length = strlen(p);
        while (length > 0 && strchr(" \t", p[length - 1])) p[--length] = '\0';
        if (length >= 2 && p[0] == '"' && p[length - 1] == '"') {
            p[length - 1] = '\0';
            p++;
        }
        fields[n] = p;
        p = comma ? comma + 1 : NULL;
    }
    return n;
}

static fw_status fail_line(const fw_csv *t, size_t line, fw_msg *m)
{
    fw_msg_prefix(m, "%.200s:%zu: ", t->path, line);
    return FW_E_INPUT;
}

static fw_status read_name(const char *field, size_t n_columns, const fw_csv_column *columns, int *column,
                           char unit[MAX_UNIT], fw_msg *m)
{
    const char *bracket = strchr(field, '['), *names[FW_CSV_MAX_COLUMNS];
    char        name[MAX_CELL] = "";
    size_t      length = bracket ? (size_t)(bracket - field) : strlen(field);

    unit[0] = '\0';
    if (bracket) {
        const char *close = strchr(bracket, ']');
        FW_CHECK(close && !close[1] && close - bracket - 1 < MAX_UNIT, m, FW_E_INPUT,
                 "column \"%.60s\": wanted a name and a unit, like speed [m/s]", field);
        memcpy(unit, bracket + 1, (size_t)(close - bracket - 1));
        unit[close - bracket - 1] = '\0';
    }
    while (length > 0 && strchr(" \t", field[length - 1])) length--;
    if (length < sizeof name) memcpy(name, field, length);
    for (size_t i = 0; i < n_columns; i++) {
        names[i] = columns[i].name;
        if (strcmp(names[i], name) == 0) {
            *column = (int)i;
            return FW_OK;
        }
    }
    const char *nearest = fw_keys_nearest_word(n_columns, names, name);
    return fw_fail(m, FW_E_INPUT, "unknown column \"%.60s\"%s%s%s", field, nearest ? ", did you mean \"" : "",
                   nearest ? nearest : "", nearest ? "\"?" : "");
}

static fw_status read_header(const fw_reader *r, fw_csv *t, char *line, const fw_csv_column *columns, header *h)
{
    char *fields[MAX_FIELDS];

    h->n_fields = split(line, fields);
    FW_CHECK(h->n_fields <= MAX_FIELDS, r->m, FW_E_INPUT, "more than %d columns", MAX_FIELDS);
    for (size_t i = 0; i < h->n_fields; i++) {
        char   unit[MAX_UNIT], one[MAX_UNIT + 4];
        double x;
        FW_TRY(read_name(fields[i], t->n_columns, columns, &h->column[i], unit, r->m));
        size_t c = (size_t)h->column[i];
        FW_CHECK(!t->has[c], r->m, FW_E_INPUT, "column %s stands twice", columns[c].name);
        t->has[c] = true;
        memcpy(h->unit[c], unit, sizeof unit);
        if (!*unit) continue;
        snprintf(one, sizeof one, "1 %s", unit);
        fw_status status = fw_units_read(r->units, one, columns[c].unit, &x, r->m);
        if (status != FW_OK) {
            fw_msg_prefix(r->m, "column %s: ", columns[c].name);
            return status;
        }
    }
    for (size_t c = 0; c < t->n_columns; c++) {
        FW_CHECK(t->has[c] || columns[c].is_optional, r->m, FW_E_INPUT, "column %s is missing", columns[c].name);
    }
    return FW_OK;
}

static fw_status read_cell(const fw_reader *r, const char *field, const char *header_unit, const fw_csv_column *column,
                           double *value)
{
    const char *unit = *header_unit ? header_unit : column->unit;
    char        text[MAX_CELL + MAX_UNIT + 2];
    double      bare;

    FW_CHECK(*field, r->m, FW_E_INPUT, "the field is empty");
    FW_CHECK(strlen(field) < MAX_CELL, r->m, FW_E_INPUT, "\"%.40s...\" is too long for a number", field);
    if (fw_units_number(field, &bare, NULL) != FW_OK) return fw_units_read(r->units, field, column->unit, value, r->m);
    if (strcmp(unit, column->unit) == 0) {
        *value = bare; /* the common case needs no unit at all */
        return FW_OK;
    }
    snprintf(text, sizeof text, "%s %s", field, unit);
    return fw_units_read(r->units, text, column->unit, value, r->m);
}

static fw_status read_row(const fw_reader *r, fw_csv *t, char *line, const fw_csv_column *columns, const header *h,
                          double *row)
{
    char  *fields[MAX_FIELDS];
    size_t n = split(line, fields);

    FW_CHECK(n == h->n_fields, r->m, FW_E_INPUT, "%zu fields, wanted %zu as in the first line", n, h->n_fields);
    memset(row, 0, t->n_columns * sizeof *row);
    for (size_t i = 0; i < n; i++) {
        size_t    c = (size_t)h->column[i];
        fw_status status = read_cell(r, fields[i], h->unit[c], &columns[c], &row[c]);
        if (status != FW_OK) {
            fw_msg_prefix(r->m, "%s: ", columns[c].name);
            return status;
        }
    }
    return FW_OK;
}

static fw_status read_lines(const fw_reader *r, fw_csv *t, char *text, size_t n_bytes, const fw_csv_column *columns)
{
    header h = {0};
    bool   has_header = false;
    size_t cap_cells = 0, cap_lines = 0, number = 0;
    char  *end = text + n_bytes;

    if (n_bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3; /* a byte order mark, as spreadsheets write it */
    for (char *line = text; line < end;) {
        char *stop = memchr(line, '\n', (size_t)(end - line)), *next = stop ? stop + 1 : end;
        char *last = stop ? stop : end;
        number++;
        *last = '\0';
        if (last > line && last[-1] == '\r') *--last = '\0';
        fw_status status = FW_OK;
        for (char *p = line; p < last && status == FW_OK; p++) {
            if ((unsigned char)*p < 0x20 && *p != '\t') status = fw_fail(r->m, FW_E_INPUT, "this is no text");
        }
        line += status == FW_OK ? strspn(line, " \t") : 0;
        bool is_skipped = status == FW_OK && (!*line || *line == '#');
        if (status == FW_OK && !is_skipped && !has_header) {
            status = read_header(r, t, line, columns, &h);
            has_header = true;
        } else if (status == FW_OK && !is_skipped) {
            FW_TRY(fw_grow(&t->cells, &cap_cells, (t->n_rows + 1) * t->n_columns, sizeof *t->cells, "table", r->m));
            FW_TRY(fw_grow(&t->line, &cap_lines, t->n_rows + 1, sizeof *t->line, "table", r->m));
            t->line[t->n_rows] = number;
            status = t->n_rows < FW_CSV_MAX_ROWS
                         ? read_row(r, t, line, columns, &h, t->cells + t->n_rows * t->n_columns)
                         : fw_fail(r->m, FW_E_INPUT, "more than %d rows", FW_CSV_MAX_ROWS);
            t->n_rows++;
        }
        if (status != FW_OK) return fail_line(t, number, r->m);
        line = next;
    }
    FW_CHECK(has_header, r->m, FW_E_INPUT, "%.200s:1: the table is empty", t->path);
    FW_CHECK(t->n_rows > 0, r->m, FW_E_INPUT, "%.200s:%zu: the table has no rows below its names", t->path, number);
    return FW_OK;
}

fw_status fw_csv_read(const fw_reader *r, const fw_node *at, const char *path, const char *file, size_t n_columns,
                      const fw_csv_column *columns, fw_csv *out)
{
    bool   is_absolute = file[0] == '/' || !*r->directory;
    char  *text = NULL;
    size_t n_bytes = 0;
    int    n;

    memset(out, 0, sizeof *out);
    out->n_columns = n_columns;
    n = snprintf(out->path, sizeof out->path, "%s%s%s", is_absolute ? "" : r->directory, is_absolute ? "" : "/", file);
    if (n < 0 || (size_t)n >= sizeof out->path) return fw_yaml_fail(at, r->m, "%s: the file name is too long", path);
    fw_status status = fw_yaml_load_file(out->path, FW_CSV_MAX_BYTES, &text, &n_bytes, r->m);
    if (status != FW_OK) return fw_yaml_blame(at, path, status, r->m);
    status = read_lines(r, out, text, n_bytes, columns);
    free(text);
    if (status != FW_OK) fw_csv_free(out);
    return status;
}

void fw_csv_free(fw_csv *t)
{
    free(t->cells);
    free(t->line);
    t->cells = NULL;
    t->line = NULL;
    t->n_rows = 0;
}
