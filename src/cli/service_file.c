#include "cli/service_file.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "cli/csv.h"
#include "statistics/lives.h"

enum { YEAR, ICE_HOURS, FACTOR, N_COLUMNS };

static const fw_csv_column COLUMNS[N_COLUMNS] = {{"year", "1", true}, {"ice_hours", "h", false}, {"factor", "1", true}};

static fw_status check_rows(const fw_csv *t, double window, fw_msg *m)
{
    double longest = 0, factors = 0;
    FW_CHECK(t->n_rows <= FW_LIVES_KINDS, m, FW_E_INPUT, "%.200s: %zu years, wanted at most %d", t->path, t->n_rows, FW_LIVES_KINDS);
    for (size_t i = 0; i < t->n_rows; i++) {
        const double *row = t->cells + i * N_COLUMNS;
        double        factor = t->has[FACTOR] ? row[FACTOR] : 1;
        FW_CHECK(row[ICE_HOURS] >= 0 && row[ICE_HOURS] <= 8784, m, FW_E_INPUT, "%.200s:%zu: ice_hours = %g h, wanted 0 h to 8784 h", t->path,
                 t->line[i], row[ICE_HOURS]);
        FW_CHECK(factor >= 0 && factor <= 1000, m, FW_E_INPUT, "%.200s:%zu: factor = %g, wanted 0 to 1000", t->path, t->line[i], factor);
        for (size_t k = 0; k < i && t->has[YEAR]; k++)
            FW_CHECK(t->cells[k * N_COLUMNS + YEAR] != row[YEAR], m, FW_E_INPUT, "%.200s:%zu: the year %g stands in line %zu already", t->path,
                     t->line[i], row[YEAR], t->line[k]);
        longest = fmax(longest, row[ICE_HOURS]), factors += factor;
    }
    FW_CHECK(round(longest * 3600 / window) >= 1 && factors > 0, m, FW_E_INPUT, "%.200s:%zu: no year of the table has ice for a window of %g h",
             t->path, t->line[t->n_rows - 1], window / 3600);
    return FW_OK;
}

static fw_status take_rows(const fw_csv *t, fw_service *out, fw_msg *m)
{
    FW_TRY(fw_alloc(&out->table, t->n_rows, sizeof *out->table, "table of years", m));
    out->n_table = t->n_rows;
    out->ice_hours_per_year = 0;
    for (size_t i = 0; i < t->n_rows; i++) {
        const double *row = t->cells + i * N_COLUMNS;
        out->table[i] = (fw_service_year){row[ICE_HOURS], t->has[FACTOR] ? row[FACTOR] : 1};
        out->ice_hours_per_year += row[ICE_HOURS] / (double)t->n_rows;
    }
    return FW_OK;
}

static fw_status read_years(const fw_reader *r, const fw_node *at, double window, fw_service *out)
{
    const char *file = NULL;
    fw_csv      t;
    FW_TRY(fw_read_text(r, at, "service.years", &file));
    if (out->life_years != floor(out->life_years))
        return fw_yaml_fail(at, r->m, "service.years: whole years are drawn, and service.life = %g year; wanted a whole number", out->life_years);
    FW_TRY(fw_csv_read(r, at, "service.years", file, N_COLUMNS, COLUMNS, &t));
    fw_status s = check_rows(&t, window, r->m);
    if (s == FW_OK) s = take_rows(&t, out, r->m);
    fw_csv_free(&t);
    return s;
}

fw_status fw_file_read_service(const fw_reader *r, fw_values *v, double window, fw_service *out)
{
    const fw_node *map = fw_yaml_get(r->root, "service"), *years = fw_yaml_get(map, "years");
    uint64_t       given = 0;

    *out = (fw_service){.is_asked = map != NULL};
    if (!map) return FW_OK;
    FW_TRY(fw_read_section(r, &fw_table_service, "service", map, v, &given));
    bool has_hours = fw_read_is_given(&fw_table_service, given, "ice_hours_per_year");
    out->life_years = v->life;
    out->persistence = v->persistence;
    out->allowance = v->allowance;
    if (!years) {
        if (!has_hours)
            return fw_yaml_fail(map, r->m, "service.ice_hours_per_year is missing: hours a year with ice at the structure, in h, or service.years");
        out->ice_hours_per_year = v->ice_hours_per_year;
        out->year_to_year_cv = v->year_to_year_cv;
        return FW_OK;
    }
    const char *other = has_hours ? "ice_hours_per_year" : fw_read_is_given(&fw_table_service, given, "year_to_year_cv") ? "year_to_year_cv" : NULL;
    if (other)
        return fw_yaml_fail(fw_yaml_get(map, other), r->m, "service.%s: the table of service.years says this already, wanted one of them", other);
    return read_years(r, years, window, out);
}
