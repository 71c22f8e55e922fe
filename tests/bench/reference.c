#include "bench/reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 32, MAX_ROWS = 40 };

typedef struct table {
    char        line[MAX_ROWS][1024];
    const char *field[MAX_ROWS][MAX_COLUMNS];
    size_t      n_rows, n_columns; /* row 0: names */
} table;

static table *read_table(const char *name)
{
    char   path[4096];
    table *t = calloc(1, sizeof *t);
    snprintf(path, sizeof path, "%s/tests/reference/%s", FW_SOURCE_DIR, name);
    FILE *f = fopen(path, "r");
    if (!f || !t) {
        perror(path);
        exit(1);
    }
    while (t->n_rows < MAX_ROWS && fgets(t->line[t->n_rows], sizeof t->line[0], f)) {
        char  *p = t->line[t->n_rows];
        size_t c = 0;
        p[strcspn(p, "\r\n")] = 0;
        while (p && c < MAX_COLUMNS) {
            char *comma = strchr(p, ',');
            if (comma) *comma++ = 0;
            t->field[t->n_rows][c++] = p;
            p                        = comma;
        }
        if (t->n_rows++ == 0) t->n_columns = c;
    }
    fclose(f);
    return t;
}

static const char *text(const table *t, size_t row, const char *column)
{
    for (size_t c = 0; c < t->n_columns; c++)
        if (strcmp(t->field[0][c], column) == 0) return t->field[row][c] ? t->field[row][c] : "";
    fprintf(stderr, "no column %s in the reference\n", column);
    exit(1);
}

static double number(const table *t, size_t row, const char *column) { return strtod(text(t, row, column), NULL); }

/* One floe that comes with the current at offset y0; the file counts time from the touch, the scene starts 0.3 m before it. */
static size_t read_single(reference_scene *scenes)
{
    table *t = read_table("single_floe.csv");
    size_t n = 0;
    for (size_t row = 1; row < t->n_rows && n < REFERENCE_SCENES; row++) {
        if (strcmp(text(t, row, "outcome"), "leaves") != 0) continue;
        double D = number(t, row, "D"), y0 = number(t, row, "y0"), reach = 3.7 + D / 2, gap = 0.3;
        reference_scene *s = &scenes[n++];
        *s = (reference_scene){.duration = number(t, row, "t_release") + gap / 2 + 1, .depth = number(t, row, "depth_total_mm"), .n_floes = 1};
        snprintf(s->name, sizeof s->name, "case %s, offset %g m", text(t, row, "case"), y0);
        s->start[0] = (fw_floe){.x = -(sqrt(reach * reach - y0 * y0) + gap), .y = y0, .diameter = D, .thickness = number(t, row, "h"), .vx = 2};
    }
    free(t);
    return n;
}

static size_t read_multi(reference_scene *scenes, size_t room)
{
    table *t = read_table("multi_floe.csv");
    size_t n = 0, k;
    for (size_t row = 1; row < t->n_rows && n < room; row += k) {
        reference_scene *s = &scenes[n++];
        *s = (reference_scene){.duration = number(t, row, "t_end"), .depth = number(t, row, "depth_mm"), .has_end = true};
        snprintf(s->name, sizeof s->name, "%.40s", text(t, row, "scene"));
        for (k = 0; row + k < t->n_rows && k < REFERENCE_FLOES && strcmp(text(t, row + k, "scene"), text(t, row, "scene")) == 0; k++) {
            size_t r    = row + k;
            s->start[k] = (fw_floe){.x = number(t, r, "x0"), .y = number(t, r, "y0"), .diameter = number(t, r, "D"), .thickness = number(t, r, "h"),
                                    .vx = number(t, r, "vx0"), .vy = number(t, r, "vy0"), .spin = number(t, r, "spin0")};
            s->end[k]   = (fw_floe){.x = number(t, r, "x"), .y = number(t, r, "y")};
        }
        s->n_floes = k;
    }
    free(t);
    return n;
}

size_t reference_read(reference_scene *scenes)
{
    size_t n = read_single(scenes);
    return n + read_multi(scenes + n, REFERENCE_SCENES - n);
}
