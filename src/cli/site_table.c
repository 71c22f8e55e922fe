#include "cli/site_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/csv.h"
#include "physics/unbreakable.h"

enum { SPEED, DIRECTION, CONCENTRATION, THICKNESS, PROBABILITY, N_COLUMNS };

static const fw_csv_column COLUMNS[N_COLUMNS] = {
    {"speed", "m/s", false},  {"direction", "deg", false}, {"concentration", "1", false},
    {"thickness", "m", true}, {"probability", "1", false},
};

static fw_status check_row(const fw_csv *t, size_t i, fw_msg *m)
{
    const double *row = t->cells + i * N_COLUMNS;

#define CHECK_ROW(condition, which, unit, wanted)                                                                      \
    FW_CHECK(condition, m, FW_E_INPUT, "%.200s:%zu: %s = %g%s, wanted %s", t->path, t->line[i], COLUMNS[which].name,   \
             row[which], unit, wanted)
    CHECK_ROW(row[SPEED] > 0 && row[SPEED] <= 20, SPEED, " m/s", "more than 0 m/s and at most 20 m/s");
    CHECK_ROW(fabs(row[DIRECTION]) <= 720, DIRECTION, " deg", "-720 deg to 720 deg");
    CHECK_ROW(row[CONCENTRATION] > 0 && row[CONCENTRATION] <= FW_MAX_CONCENTRATION, CONCENTRATION, "",
              "more than 0 and at most 0.8: whole floes pack no denser");
    CHECK_ROW(!t->has[THICKNESS] || fw_unbreakable_class_exists(row[THICKNESS]), THICKNESS, " m", "0.0855 m to 8.04 m");
    CHECK_ROW(row[PROBABILITY] >= 0 && row[PROBABILITY] <= 1, PROBABILITY, "", "0 to 1");
#undef CHECK_ROW
    return FW_OK;
}

/* By the key of a cell, then direction; all doubles are finite. */
static int compare_rows(const void *a, const void *b)
{
    static const int order[] = {SPEED, CONCENTRATION, THICKNESS, DIRECTION, PROBABILITY};
    const double    *x = a, *y = b;

    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        if (x[order[i]] != y[order[i]]) return x[order[i]] < y[order[i]] ? -1 : 1;
    }
    return 0;
}

static bool is_same_cell(const double *x, const double *y)
{
    return x[SPEED] == y[SPEED] && x[CONCENTRATION] == y[CONCENTRATION] && x[THICKNESS] == y[THICKNESS];
}

static int compare_mixes(const void *a, const void *b)
{
    double x = ((const fw_thickness_mix *)a)->classes[0].thickness,
           y = ((const fw_thickness_mix *)b)->classes[0].thickness;

    return (x > y) - (x < y);
}

/* Turn the distinct thicknesses into mixes of one class each; their probabilities are the table's margins. */
static fw_status make_mixes(const fw_csv *t, fw_model *model, fw_msg *m)
{
    memset(model->mixes, 0, sizeof model->mixes);
    model->n_mixes = 0;
    for (size_t i = 0; i < t->n_rows; i++) {
        const double *row = t->cells + i * N_COLUMNS;
        size_t        k = 0;
        if (row[PROBABILITY] == 0) continue;
        while (k < model->n_mixes && model->mixes[k].classes[0].thickness != row[THICKNESS]) k++;
        FW_CHECK(k < FW_MAX_MIXES, m, FW_E_INPUT, "%.200s: more than %d different values of thickness", t->path,
                 FW_MAX_MIXES);
        if (k == model->n_mixes) {
            model->mixes[k].n_classes = 1;
            model->mixes[k].classes[0] = (fw_thickness_class){row[THICKNESS], 1};
            model->n_mixes++;
        }
        model->mixes[k].probability += row[PROBABILITY];
    }
    qsort(model->mixes, model->n_mixes, sizeof model->mixes[0], compare_mixes);
    return FW_OK;
}

static uint32_t mix_of(const fw_model *model, double thickness)
{
    uint32_t k = 0;

    while (model->mixes[k].classes[0].thickness != thickness) k++; /* make_mixes has seen it */
    return k;
}

/* One law of direction from the rows of a group; scratch has room for both arrays. */
static fw_status group_direction(const double *rows, size_t n, double total, double *scratch, fw_distribution *out,
                                 fw_msg *m)
{
    double *values = scratch, *weights = scratch + n;

    for (size_t i = 0; i < n; i++) {
        double turned = fmod(rows[i * N_COLUMNS + DIRECTION], 360);
        turned = turned < 0 ? turned + 360 : turned;
        values[i] = turned >= 360 ? 0 : turned;
        weights[i] = rows[i * N_COLUMNS + PROBABILITY] / total;
    }
    return fw_distribution_values(out, n, values, weights, m);
}

static fw_status add_cell(fw_site *site, size_t *capacity, const fw_site_cell *cell, fw_msg *m)
{
    fw_status    status = fw_grow(&site->cells, capacity, site->n_cells + 1, sizeof *site->cells,
                                  "cells of the site table", m);
    fw_site_cell copy = *cell;

    if (status == FW_OK) status = fw_distribution_copy(&copy.direction, &cell->direction, m);
    if (status == FW_OK) site->cells[site->n_cells++] = copy;
    return status;
}

/* One group of rows: one cell, or one for every mix when the table has no thickness. */
static fw_status add_group(fw_site *site, size_t *capacity, const fw_model *model, bool has_thickness,
                           const double *rows, size_t n, double *scratch, fw_msg *m)
{
    fw_site_cell cell = {0};
    double       total = 0;

    for (size_t i = 0; i < n; i++) total += rows[i * N_COLUMNS + PROBABILITY];
    if (total == 0) return FW_OK;
    FW_TRY(group_direction(rows, n, total, scratch, &cell.direction, m));
    cell.speed = rows[SPEED];
    cell.concentration = rows[CONCENTRATION];
    uint32_t  first = has_thickness ? mix_of(model, rows[THICKNESS]) : 0;
    uint32_t  last = has_thickness ? first : (uint32_t)model->n_mixes - 1;
    fw_status status = FW_OK;
    for (uint32_t k = first; k <= last && status == FW_OK; k++) {
        cell.mix = k;
        cell.probability = has_thickness ? total : total * model->mixes[k].probability;
        if (cell.probability > 0) status = add_cell(site, capacity, &cell, m);
    }
    fw_distribution_free(&cell.direction);
    return status;
}

/* Rows are sorted. */
static fw_status make_cells(const fw_csv *t, fw_site *site, fw_model *model, fw_msg *m)
{
    size_t  capacity = 0;
    double *scratch = NULL;

    if (t->has[THICKNESS]) FW_TRY(make_mixes(t, model, m));
    FW_TRY(fw_alloc(&scratch, 2 * t->n_rows, sizeof *scratch, "directions", m));
    fw_status status = FW_OK;
    for (size_t i = 0, n; i < t->n_rows && status == FW_OK; i += n) {
        const double *rows = t->cells + i * N_COLUMNS;
        for (n = 1; i + n < t->n_rows && is_same_cell(rows, rows + n * N_COLUMNS);) n++;
        status = add_group(site, &capacity, model, t->has[THICKNESS], rows, n, scratch, m);
    }
    free(scratch);
    return status;
}

fw_status fw_site_table_read(const fw_reader *r, const fw_node *at, const char *path, fw_site *site, fw_model *model,
                             bool *has_thickness)
{
    const char *file = NULL;
    fw_csv      t;
    double      sum = 0;

    FW_TRY(fw_read_text(r, at, path, &file));
    FW_TRY(fw_csv_read(r, at, path, file, N_COLUMNS, COLUMNS, &t));
    fw_status status = FW_OK;
    for (size_t i = 0; i < t.n_rows && status == FW_OK; i++) status = check_row(&t, i, r->m);
    /* sums run in the order of the cells from here on, so that the order of rows in the file does not matter */
    qsort(t.cells, t.n_rows, N_COLUMNS * sizeof *t.cells, compare_rows);
    for (size_t i = 0; i < t.n_rows; i++) sum += t.cells[i * N_COLUMNS + PROBABILITY];
    if (status == FW_OK && !(fabs(sum - 1) <= 1e-6)) {
        status = fw_fail(r->m, FW_E_INPUT, "%.200s:%zu: the column probability sums to %.9g over %zu rows, wanted 1",
                         t.path, t.line[t.n_rows - 1], sum, t.n_rows);
    }
    for (size_t i = 0; i < t.n_rows && status == FW_OK; i++) t.cells[i * N_COLUMNS + PROBABILITY] /= sum;
    *has_thickness = t.has[THICKNESS];
    if (status == FW_OK) status = make_cells(&t, site, model, r->m);
    fw_csv_free(&t);
    return status;
}
