#include "cli/life_tables.h"

static void build_points(fw_table_builder *b, const fw_service_answer *a, fw_msg *m)
{
    const fw_life_point *rows = a->points;
    fw_table_start(b, "life_points", a->n_points, m);
    FW_TABLE_COUNTS(b, rows, fw_life_point, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, mean_mm, "mm", "mean depth of a service life");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, cv, "1", "its coefficient of variation, the three below in squares");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, cv_windows, "1", "if windows were independent and years alike");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, cv_persistence, "1", "added by windows that resemble their neighbours");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, cv_years, "1", "added by years that differ");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, years_half_width, "1",
                     "relative half-width of the design percentile for not knowing the law of years; NaN: no table");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, allowance_mm, "mm", "depth that may wear off; NaN: none given");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, never, "1", "probability that the allowance outlasts the life; NaN: none given");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, with_law_never, "1", "the same with what is not known of the law");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, allowance_year_p5, "1", "year by which 5 % of lives have used up the allowance; NaN: not within the life");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, allowance_year_p50, "1", "year by which half of them have");
    FW_TABLE_NUMBERS(b, rows, fw_life_point, allowance_year_p95, "1", "year by which 95 % of them have");
}

static void build_fan(fw_table_builder *b, const fw_service_answer *a, fw_msg *m)
{
    const fw_fan_row *rows = a->fan;
    fw_table_start(b, "life_fan", a->n_fan, m);
    FW_TABLE_COUNTS(b, rows, fw_fan_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, rows, fw_fan_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, rows, fw_fan_row, year, "1", "years in service");
    FW_TABLE_NUMBERS(b, rows, fw_fan_row, percentile, "1", "percentile, 0 to 100");
    FW_TABLE_NUMBERS(b, rows, fw_fan_row, depth_mm, "mm", "abrasion depth after so many years");
    FW_TABLE_NUMBERS(b, rows, fw_fan_row, with_law_depth_mm, "mm", "the same percentile with what is not known of the law; NaN: nothing said");
}

static void build_allowance(fw_table_builder *b, const fw_service_answer *a, fw_msg *m)
{
    const fw_allowance_row *rows = a->allowance;
    fw_table_start(b, "allowance_year", a->n_allowance, m);
    FW_TABLE_COUNTS(b, rows, fw_allowance_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, year, "1", "year in service, from 1");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, probability, "1", "probability that the allowance is used up in this year");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, by_then, "1", "probability that it is used up by the end of it");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, with_law_probability, "1", "in this year, with what is not known of the law; NaN: nothing said");
    FW_TABLE_NUMBERS(b, rows, fw_allowance_row, with_law_by_then, "1", "by the end of it, with what is not known of the law");
}

static void build_map(fw_table_builder *b, const fw_service_answer *a, fw_msg *m)
{
    const fw_map_row *rows = a->map;
    fw_table_start(b, "life_map", a->n_map, m);
    FW_TABLE_COUNTS(b, rows, fw_map_row, point, "measuring point, from 1");
    FW_TABLE_NUMBERS(b, rows, fw_map_row, bearing_deg, "degree", "outward normal, clockwise from north");
    FW_TABLE_NUMBERS(b, rows, fw_map_row, height_m, "m", "height above the mean water level");
    FW_TABLE_NUMBERS(b, rows, fw_map_row, percentile, "1", "the design percentile, 0 to 100");
    FW_TABLE_NUMBERS(b, rows, fw_map_row, depth_mm, "mm", "percentile of the depth of a service life there");
}

size_t fw_life_tables_build(fw_table_builder *b, const fw_service_answer *a, fw_msg *m)
{
    size_t n = 0;
    if (a->n_points) build_points(&b[n++], a, m);
    if (a->n_fan) build_fan(&b[n++], a, m);
    if (a->n_allowance) build_allowance(&b[n++], a, m);
    if (a->n_map) build_map(&b[n++], a, m);
    return n;
}
