#include "cli/report_tables_h5.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { MOST_COLUMNS = 12, N_TABLES = 4 };

/* Rows become columns: each column is an array of its own, owned here until the file is written. */
typedef struct builder {
    fw_table  table;
    fw_column columns[MOST_COLUMNS];
    void     *arrays[MOST_COLUMNS];
    fw_status status;
    fw_msg   *m;
} builder;

static void start(builder *b, const char *name, size_t n_rows, fw_msg *m)
{
    memset(b, 0, sizeof *b);
    b->table = (fw_table){.name = name, .n_rows = n_rows, .columns = b->columns};
    b->m = m;
}

/* Space for one column; NULL after any failure, which the builder remembers. */
static void *add(builder *b, const char *name, const char *unit, const char *long_name, size_t size)
{
    void *array = NULL;
    if (b->status == FW_OK && b->table.n_columns == MOST_COLUMNS)
        b->status = fw_fail(b->m, FW_E_INTERNAL, "table %s has more than %d columns", b->table.name, MOST_COLUMNS);
    if (b->status == FW_OK) b->status = fw_alloc(&array, b->table.n_rows, size, name, b->m);
    if (b->status != FW_OK) return NULL;
    b->arrays[b->table.n_columns] = array;
    b->columns[b->table.n_columns++] = (fw_column){.name = name, .unit = unit, .long_name = long_name};
    return array;
}

/* One double, count or text member of every row; offset and stride say where it lies. */
static void add_numbers(builder *b, const char *name, const char *unit, const char *long_name, const void *rows,
                        size_t stride, size_t offset)
{
    double *to = add(b, name, unit, long_name, sizeof *to);
    for (size_t i = 0; to && i < b->table.n_rows; i++)
        memcpy(&to[i], (const char *)rows + i * stride + offset, sizeof *to);
    if (to) b->columns[b->table.n_columns - 1].number = to;
}

static void add_counts(builder *b, const char *name, const char *long_name, const void *rows, size_t stride,
                       size_t offset)
{
    int64_t *to = add(b, name, "1", long_name, sizeof *to);
    for (size_t i = 0; to && i < b->table.n_rows; i++) {
        size_t count;
        memcpy(&count, (const char *)rows + i * stride + offset, sizeof count);
        to[i] = (int64_t)count;
    }
    if (to) b->columns[b->table.n_columns - 1].integer = to;
}

static const char **add_texts(builder *b, const char *name, const char *long_name)
{
    const char **to = add(b, name, "1", long_name, sizeof *to);
    if (to) b->columns[b->table.n_columns - 1].text = to;
    return to;
}

#define NUMBERS(b, rows, type, member, unit, long_name)                                                                \
    add_numbers((b), #member, (unit), (long_name), (rows), sizeof(type), offsetof(type, member))
#define COUNTS(b, rows, type, member, long_name)                                                                       \
    add_counts((b), #member, (long_name), (rows), sizeof(type), offsetof(type, member))

static void build_percentiles(builder *b, const fw_answer *a, fw_msg *m)
{
    start(b, "percentiles", a->n_percentiles, m);
    COUNTS(b, a->percentiles, fw_percentile_row, point, "measuring point, from 1");
    NUMBERS(b, a->percentiles, fw_percentile_row, bearing_deg, "degree", "outward normal, clockwise from north");
    NUMBERS(b, a->percentiles, fw_percentile_row, percentile, "1", "percentile, 0 to 100");
    NUMBERS(b, a->percentiles, fw_percentile_row, depth_mm, "mm", "abrasion depth of one window");
    NUMBERS(b, a->percentiles, fw_percentile_row, low_mm, "mm", "lower end of its interval");
    NUMBERS(b, a->percentiles, fw_percentile_row, high_mm, "mm", "upper end of its interval; NaN: does not exist");
    NUMBERS(b, a->percentiles, fw_percentile_row, coverage, "1", "coverage of the interval");
    const char **method = add_texts(b, "method", "method of the interval");
    for (size_t i = 0; method && i < a->n_percentiles; i++) method[i] = a->percentiles[i].method;
}

static void build_points(builder *b, const fw_answer *a, fw_msg *m)
{
    start(b, "points", a->n_points, m);
    COUNTS(b, a->points, fw_point_row, point, "measuring point, from 1");
    NUMBERS(b, a->points, fw_point_row, bearing_deg, "degree", "outward normal, clockwise from north");
    NUMBERS(b, a->points, fw_point_row, mean_mm, "mm", "mean abrasion depth of one window");
    NUMBERS(b, a->points, fw_point_row, mean_low_mm, "mm", "lower end of its interval");
    NUMBERS(b, a->points, fw_point_row, mean_high_mm, "mm", "upper end of its interval; NaN: does not exist");
    NUMBERS(b, a->points, fw_point_row, path_km, "km", "mean sliding path in one window");
    NUMBERS(b, a->points, fw_point_row, impact_share, "1", "share of the wear from impact");
    NUMBERS(b, a->points, fw_point_row, high_share, "1", "share of the wear at pressures above 5 MPa");
}

static void build_life(builder *b, const fw_answer *a, fw_msg *m)
{
    start(b, "service_life", a->n_life, m);
    COUNTS(b, a->life, fw_life_row, point, "measuring point, from 1");
    NUMBERS(b, a->life, fw_life_row, bearing_deg, "degree", "outward normal, clockwise from north");
    NUMBERS(b, a->life, fw_life_row, percentile, "1", "percentile, 0 to 100");
    NUMBERS(b, a->life, fw_life_row, depth_mm, "mm", "abrasion depth of the service life");
    NUMBERS(b, a->life, fw_life_row, low_mm, "mm", "lower end of its interval");
    NUMBERS(b, a->life, fw_life_row, high_mm, "mm", "upper end of its interval; NaN: does not exist");
    NUMBERS(b, a->life, fw_life_row, windows, "1", "windows in the life");
    NUMBERS(b, a->life, fw_life_row, allowance_year, "1",
            "year in which the allowance is used up; NaN: not within the life");
    const char **assumption = add_texts(b, "assumption", "how windows depend on one another");
    for (size_t i = 0; assumption && i < a->n_life; i++) assumption[i] = "independent windows";
}

static void build_ledger(builder *b, const fw_answer *a, fw_msg *m)
{
    start(b, "ledger", a->n_ledger, m);
    const char **row = add_texts(b, "row", "source of error");
    NUMBERS(b, a->ledger, fw_ledger_row, amount, "1",
            "relative amount in the governing design number; NaN: not measured");
    const char **shrinks = add_texts(b, "shrinks_with", "what shrinks it");
    const char **cost = add_texts(b, "cost_to_halve", "what shrinking it by half would cost");
    NUMBERS(b, a->ledger, fw_ledger_row, cost_to_halve_cpu_s, "s",
            "processor time of that on the machines of this run");
    for (size_t i = 0; cost && i < a->n_ledger; i++) {
        row[i] = a->ledger[i].row;
        shrinks[i] = a->ledger[i].shrinks_with;
        cost[i] = a->ledger[i].cost_to_halve;
    }
}

fw_status fw_report_write(const char *path, const fw_campaign *c, const fw_record_source *records, const fw_answer *a,
                          fw_msg *m)
{
    builder   builders[N_TABLES];
    fw_table  tables[N_TABLES];
    fw_status s = FW_OK;
    build_percentiles(&builders[0], a, m);
    build_points(&builders[1], a, m);
    build_life(&builders[2], a, m);
    build_ledger(&builders[3], a, m);
    for (int i = 0; i < N_TABLES; i++) {
        tables[i] = builders[i].table;
        if (s == FW_OK) s = builders[i].status;
    }
    if (s == FW_OK) s = fw_results_write(path, c, records, N_TABLES, tables, m);
    for (int i = 0; i < N_TABLES; i++)
        for (size_t k = 0; k < builders[i].table.n_columns; k++) free(builders[i].arrays[k]);
    return s;
}
