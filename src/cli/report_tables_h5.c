#include "cli/report_tables_h5.h"

#include "cli/accuracy_file.h"
#include "cli/effects_tables.h"
#include "cli/life_tables.h"
#include "cli/table_builder.h"

enum { N_TABLES = 5, MOST_TABLES = N_TABLES + FW_EFFECTS_TABLES + 2 + FW_LIFE_TABLES };

static void build_percentiles(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    fw_table_start(b, "percentiles", a->n_percentiles, m);
    FW_TABLE_COUNTS(b, a->percentiles, fw_percentile_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, bearing_deg, "degree",
                     "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, percentile, "1", "percentile, 0 to 100");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, depth_mm, "mm", "abrasion depth of one window");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, low_mm, "mm", "lower end of its interval");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, high_mm, "mm",
                     "upper end of its interval; NaN: does not exist");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, band_low_mm, "mm", "lower end of the interval that covers at all points together");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, band_high_mm, "mm", "upper end of that one; NaN: does not exist");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, n_effective, "1",
                     "effective sample size: of a plain sample that would know the percentile as well; NaN: nothing scatters");
    FW_TABLE_NUMBERS(b, a->percentiles, fw_percentile_row, coverage, "1", "coverage of the interval");
    const char **method = fw_table_texts(b, "method", "method of the interval");
    for (size_t i = 0; method && i < a->n_percentiles; i++) method[i] = a->percentiles[i].method;
}

static void build_points(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    fw_table_start(b, "points", a->n_points, m);
    FW_TABLE_COUNTS(b, a->points, fw_point_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, mean_mm, "mm", "mean abrasion depth of one window");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, mean_low_mm, "mm", "lower end of its interval");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, mean_high_mm, "mm", "upper end of its interval; NaN: does not exist");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, path_km, "km", "mean sliding path in one window");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, impact_share, "1", "share of the wear from impact");
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, high_share, "1", "share of the wear at pressures above 5 MPa");
    const char **dominated_by = fw_table_texts(b, "dominated_by", "largest row of the ledger in the point's design percentile");
    for (size_t i = 0; dominated_by && i < a->n_points; i++) dominated_by[i] = a->points[i].dominated_by;
    FW_TABLE_NUMBERS(b, a->points, fw_point_row, dominating_amount, "1", "its relative amount; NaN: the percentile is 0");
}

static void build_life(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    fw_table_start(b, "service_life", a->n_life, m);
    FW_TABLE_COUNTS(b, a->life, fw_life_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, percentile, "1", "percentile, 0 to 100");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, depth_mm, "mm", "abrasion depth of the service life");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, low_mm, "mm", "lower end of its interval");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, high_mm, "mm", "upper end of its interval; NaN: does not exist");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, windows, "1", "windows in the life");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, allowance_year, "1",
                     "year in which the allowance is used up; NaN: not within the life");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, with_law_depth_mm, "mm", "the same percentile with what is not known of the law; NaN: nothing said");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, with_law_low_mm, "mm", "depth_mm under the lower end of the law's factor");
    FW_TABLE_NUMBERS(b, a->life, fw_life_row, with_law_high_mm, "mm", "depth_mm under the upper end of the law's factor");
    const char **assumption = fw_table_texts(b, "assumption", "how windows and years depend on one another");
    for (size_t i = 0; assumption && i < a->n_life; i++) assumption[i] = a->service.assumption;
}

static void build_ledger(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    fw_table_start(b, "ledger", a->n_ledger, m);
    const char **row = fw_table_texts(b, "row", "source of error");
    FW_TABLE_NUMBERS(b, a->ledger, fw_ledger_row, amount, "1",
                     "relative amount in the governing design number; NaN: not measured");
    double *is_sum = fw_table_number_column(b, "is_sum", "1", "1: the sum of the rows behind it");
    for (size_t i = 0; is_sum && i < a->n_ledger; i++) is_sum[i] = a->ledger[i].is_sum;
    const char **shrinks = fw_table_texts(b, "shrinks_with", "what shrinks it");
    const char **cost = fw_table_texts(b, "cost_to_halve", "what shrinking it by half would cost");
    FW_TABLE_NUMBERS(b, a->ledger, fw_ledger_row, cost_to_halve_cpu_s, "s",
                     "processor time of that on the machines of this run");
    for (size_t i = 0; cost && i < a->n_ledger; i++) {
        row[i] = a->ledger[i].row;
        shrinks[i] = a->ledger[i].shrinks_with;
        cost[i] = a->ledger[i].cost_to_halve;
    }
}

static void build_swept(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    fw_table_start(b, "swept_strip", a->n_swept, m);
    FW_TABLE_COUNTS(b, a->swept, fw_sanity_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, a->swept, fw_sanity_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, a->swept, fw_sanity_row, strip_mm, "mm",
                     "mean abrasion depth of one window by the swept strip (floes that hit one by one), over the records' scenarios");
    FW_TABLE_NUMBERS(b, a->swept, fw_sanity_row, law_mm, "mm", "the same over the site's law of scenarios");
    FW_TABLE_NUMBERS(b, a->swept, fw_sanity_row, ratio, "1", "mean depth of the campaign over strip_mm; NaN: the strip has none");
    double *ring = fw_table_number_column(b, "ring_ratio", "1", "mean load of the campaign over the strip's, over the whole ring");
    double *usual = fw_table_number_column(b, "usual_ratio", "1", "what that is on the default ice at these concentrations");
    for (size_t i = 0; ring && usual && i < a->n_swept; i++) ring[i] = a->swept_ring.ratio, usual[i] = a->swept_ring.usual;
}

static void build_water_level(fw_table_builder *b, const fw_answer *a, fw_msg *m)
{
    const fw_water_level *w = &a->water_level;
    fw_table_start(b, "water_level", w->n, m);
    double *height = fw_table_number_column(b, "height", "m", "height above the mean water level");
    double *share = fw_table_number_column(b, "share", "1", "share of a window's depth at that height, at the governing point");
    for (size_t i = 0; height && share && i < w->n; i++) height[i] = w->height[i], share[i] = w->share[i];
}

fw_status fw_report_write(const char *path, const fw_campaign *c, const fw_record_source *records, const fw_answer *a,
                          fw_msg *m)
{
    fw_table_builder builders[MOST_TABLES];
    fw_table         tables[MOST_TABLES];
    size_t           n = N_TABLES;
    fw_status        s = FW_OK;
    build_percentiles(&builders[0], a, m);
    build_points(&builders[1], a, m);
    build_life(&builders[2], a, m);
    build_ledger(&builders[3], a, m);
    fw_accuracy_file_build_measured(&builders[4], &a->measured, m);
    if (a->n_swept) build_swept(&builders[n++], a, m);
    if (a->effects.n_rows) fw_effects_tables_build(&builders[n], &a->effects, m), n += FW_EFFECTS_TABLES;
    if (c->after.has_water_level) build_water_level(&builders[n++], a, m);
    n += fw_life_tables_build(&builders[n], &a->service, m);
    for (size_t i = 0; i < n; i++) {
        tables[i] = builders[i].table;
        if (s == FW_OK) s = builders[i].status;
    }
    if (s == FW_OK) s = fw_results_write(path, c, records, n, tables, m);
    for (size_t i = 0; i < n; i++) fw_table_free(&builders[i]);
    return s;
}
