#include "cli/drift_file.h"

#include <math.h>

#include "base/memory.h"
#include "cli/csv.h"
#include "cli/distribution_file.h"

static const double DEGREE = 3.14159265358979323846 / 180;

/* ---- the current in the course of a window ---------------------------------------------------------------------- */

enum { TIME, FACTOR, TURN, N_COLUMNS };

static const fw_csv_column COLUMNS[N_COLUMNS] = {{"time", "s", false}, {"factor", "1", false}, {"turn", "deg", false}};

/* A current turns or changes by its whole speed in this time at the quickest [s]: as the shortest tide does, 60 s over 2 pi. A window is cut in
 * pieces that follow the quickest change. */
static const double QUICKEST = 60 / (2 * 3.14159265358979323846);

static double time_to_change(const double *before, const double *row)
{
    double larger = fmax(fabs(before[FACTOR]), fabs(row[FACTOR]));
    return QUICKEST * hypot(row[FACTOR] - before[FACTOR], larger * (row[TURN] - before[TURN]) * DEGREE);
}

static fw_status check_row(const fw_csv *t, size_t i, fw_msg *m)
{
    const double *row = t->cells + i * N_COLUMNS, *before = i ? row - N_COLUMNS : NULL;

#define CHECK_ROW(condition, which, unit, wanted)                                                                      \
    FW_CHECK(condition, m, FW_E_INPUT, "%.200s:%zu: %s = %g%s, wanted %s", t->path, t->line[i], COLUMNS[which].name,   \
             row[which], unit, wanted)
    CHECK_ROW(row[TIME] >= 0 && row[TIME] <= 1e9, TIME, " s", "0 s to 1e9 s, since the window's start");
    CHECK_ROW(!before || row[TIME] > before[TIME], TIME, " s", "more than in the row before");
    CHECK_ROW(fabs(row[FACTOR]) <= 100, FACTOR, "", "-100 to 100 times the current's speed");
    CHECK_ROW(fabs(row[TURN]) <= 7200, TURN, " deg", "-7200 deg to 7200 deg");
#undef CHECK_ROW
    if (!before) return FW_OK;
    double least = time_to_change(before, row) * (1 - 1e-9);
    FW_CHECK(row[TIME] - before[TIME] >= least, m, FW_E_INPUT,
             "%.200s:%zu: time = %g s, wanted at least %.4g s after the row before: for factor %g to %g and turn %g deg to %g deg, no quicker than a tide of 60 s",
             t->path, t->line[i], row[TIME], least, before[FACTOR], row[FACTOR], before[TURN], row[TURN]);
    return FW_OK;
}

static fw_status read_course(const fw_reader *r, const fw_node *at, fw_tide *tide)
{
    const char *file = NULL;
    fw_csv      t;

    FW_TRY(fw_read_text(r, at, "current.course", &file));
    FW_TRY(fw_csv_read(r, at, "current.course", file, N_COLUMNS, COLUMNS, &t));
    fw_status status = FW_OK;
    if (t.n_rows < 2 || t.n_rows > FW_MAX_COURSE)
        status = fw_fail(r->m, FW_E_INPUT, "%.200s:%zu: the table has %zu row%s, wanted 2 to %d", t.path, t.line[t.n_rows - 1], t.n_rows,
                         t.n_rows == 1 ? "" : "s", FW_MAX_COURSE);
    for (size_t i = 0; i < t.n_rows && status == FW_OK; i++) status = check_row(&t, i, r->m);
    if (status == FW_OK) status = fw_alloc(&tide->rows, t.n_rows, sizeof *tide->rows, "course of the current", r->m);
    for (size_t i = 0; i < t.n_rows && status == FW_OK; i++) {
        const double *row = t.cells + i * N_COLUMNS;
        tide->rows[tide->n_rows++] = (fw_course_row){row[TIME], row[FACTOR], -row[TURN] * DEGREE}; /* clockwise to anticlockwise */
    }
    fw_csv_free(&t);
    return status;
}

/* table: of current.tide, for a campaign or a scene. */
static fw_status read_tide(const fw_reader *r, const fw_section *table, fw_values *v, fw_model *model)
{
    const fw_node *current = fw_yaml_get(r->root, "current"), *tide = fw_yaml_get(current, "tide"), *course = fw_yaml_get(current, "course");

    FW_TRY(fw_read_section(r, table, "current.tide", tide, v, NULL));
    model->tide = (fw_tide){.period = v->tide_period,
                            .minor_ratio = v->tide_minor_ratio,
                            .phase = v->tide_phase >= 0 ? v->tide_phase * DEGREE : NAN};
    if (tide) model->given |= FW_GIVEN_TIDE;
    if (!course) return FW_OK;
    model->given |= FW_GIVEN_COURSE;
    return read_course(r, course, &model->tide);
}

/* ---- wind ------------------------------------------------------------------------------------------------------- */

static fw_status read_wind(const fw_reader *r, const fw_section *table, fw_values *v, fw_model *model)
{
    const fw_node *map = fw_yaml_get(r->root, "wind");
    uint64_t       given = 0;

    FW_TRY(fw_read_section(r, table, "wind", map, v, &given));
    model->wind = (fw_wind){.density = v->air_density, .skin_drag = v->wind_skin_drag, .form_drag = v->wind_form_drag};
    if (map) model->given |= FW_GIVEN_WIND;
    if (fw_read_is_given(table, given, "speed")) model->given |= FW_GIVEN_WIND_SPEED;
    return FW_OK;
}

static fw_status read_wind_speed(const fw_reader *r, const fw_node *n, fw_distribution *out)
{
    FW_TRY(fw_read_distribution(r, n, "wind.speed", "m/s", out));
    double low = fw_distribution_min(out), high = fw_distribution_max(out);
    bool   is_open = isinf(high); /* judged by what a thousandth of its windows exceeds */
    if (is_open) high = fw_distribution_quantile(out, 1 - 1e-3);
    if (isinf(low)) return fw_yaml_fail(n, r->m, "wind.speed has no lower end, wanted at least 0 m/s (give min)");
    if (!(low >= 0)) return fw_yaml_fail(n, r->m, "wind.speed reaches down to %g m/s, wanted at least 0 m/s", low);
    if (!(high <= 100)) {
        return fw_yaml_fail(n, r->m, "wind.speed reaches up to %g m/s%s, wanted at most 100 m/s%s", high, is_open ? " once in a thousand windows" : "",
                            is_open ? " (give max)" : "");
    }
    return FW_OK;
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

fw_status fw_file_read_drift(const fw_reader *r, fw_values *v, fw_model *model, fw_site *site)
{
    const fw_node *wind = fw_yaml_get(r->root, "wind"), *speed = fw_yaml_get(wind, "speed"), *angle = fw_yaml_get(wind, "angle");

    FW_TRY(read_tide(r, &fw_table_tide, v, model));
    FW_TRY(read_wind(r, &fw_table_wind, v, model));
    fw_distribution_constant(&site->wind_speed, 0);
    fw_distribution_constant(&site->wind_angle, 0); /* the default that the key table documents */
    if (speed) FW_TRY(read_wind_speed(r, speed, &site->wind_speed));
    return angle ? fw_read_distribution(r, angle, "wind.angle", "deg", &site->wind_angle) : FW_OK;
}

fw_status fw_file_read_scene_drift(const fw_reader *r, fw_values *v, fw_scene *s)
{
    FW_TRY(read_tide(r, &fw_table_scene_tide, v, &s->model));
    FW_TRY(read_wind(r, &fw_table_scene_wind, v, &s->model));
    s->wind_speed = v->wind_speed;
    s->wind_angle = -v->wind_angle * DEGREE;
    s->tide_phase = v->tide_phase * DEGREE;
    return FW_OK;
}
