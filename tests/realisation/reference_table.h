/* The tables of tests/reference as the tests of this folder read them, and the scenes they describe. */
#ifndef FW_TESTS_REALISATION_REFERENCE_TABLE_H
#define FW_TESTS_REALISATION_REFERENCE_TABLE_H

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"

enum { MAX_COLUMNS = 48, MAX_ROWS = 64 };

typedef struct table {
    char   line[MAX_ROWS][1024];
    char  *field[MAX_ROWS][MAX_COLUMNS];
    size_t n_rows, n_columns;
} table;

static inline void read_table(table *t, const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/tests/reference/%s", FW_SOURCE_DIR, name);
    FILE *f = fopen(path, "r");
    if (!f) fail_msg("cannot read %s", path);
    memset(t, 0, sizeof *t);
    while (t->n_rows < MAX_ROWS && fgets(t->line[t->n_rows], sizeof t->line[0], f)) {
        char *p = t->line[t->n_rows];
        p[strcspn(p, "\r\n")] = 0;
        size_t c = 0;
        for (char *q = p; c < MAX_COLUMNS; q = NULL) {
            t->field[t->n_rows][c++] = p;
            q = strchr(p, ',');
            if (!q) break;
            *q = 0, p = q + 1;
        }
        if (t->n_rows == 0) t->n_columns = c;
        t->n_rows++;
    }
    fclose(f);
    assert_true(t->n_rows > 2);
}

static inline const char *text(const table *t, size_t row, const char *column)
{
    for (size_t c = 0; c < t->n_columns; c++)
        if (strcmp(t->field[0][c], column) == 0) return t->field[row][c] ? t->field[row][c] : "";
    fail_msg("no column %s", column);
    return "";
}

static inline double value(const table *t, size_t row, const char *column)
{
    return strtod(text(t, row, column), NULL);
}

static inline fw_scene scene_of(fw_floe *floes, size_t n, double duration, double accuracy)
{
    fw_scene s = {.speed = 2, .temperature = -10, .duration = duration, .n_floes = n, .floes = floes};
    fw_model_defaults(&s.model);
    s.model.accuracy = accuracy;
    return s;
}

static const double REFERENCE_GAP =
    0.3; /* [m] between rim and structure where a single floe starts: it touches gap / u later */

static inline fw_floe single_floe_at(double D, double h, double y0)
{
    double reach = 3.7 + D / 2;
    return (fw_floe){.x = -(sqrt(reach * reach - y0 * y0) + REFERENCE_GAP), .y = y0, .diameter = D, .thickness = h, .vx = 2};
}

/* The floe of a row of single floes; a miss starts upstream of everything. */
static inline fw_floe single_floe_of(const table *t, size_t row)
{
    fw_floe f = single_floe_at(value(t, row, "D"), value(t, row, "h"), value(t, row, "y0"));
    if (strcmp(text(t, row, "outcome"), "miss") == 0) f.x = -8;
    return f;
}

/* The floes of the scene that starts at a row of several floes; returns how many rows it has. */
static inline size_t floes_of(const table *t, size_t row, fw_floe f[8])
{
    size_t n = 0;
    for (; n < 8 && row + n < t->n_rows && strcmp(text(t, row + n, "scene"), text(t, row, "scene")) == 0; n++) {
        size_t k = row + n;
        f[n] = (fw_floe){.x = value(t, k, "x0"),
                         .y = value(t, k, "y0"),
                         .diameter = value(t, k, "D"),
                         .thickness = value(t, k, "h"),
                         .vx = value(t, k, "vx0"),
                         .vy = value(t, k, "vy0"),
                         .spin = value(t, k, "spin0")};
    }
    return n;
}

#endif
