/* The reference solutions (tests/reference/README.md): depth within 1 % at accuracy 1 %, 0.1 % at 0.1 %, final positions
 * within 5 mm at 0.1 %, and the energy balance within the accuracy. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"

enum { MAX_COLUMNS = 32, MAX_ROWS = 32 };

typedef struct table {
    char   line[MAX_ROWS][1024];
    char  *field[MAX_ROWS][MAX_COLUMNS];
    size_t n_rows, n_columns;
} table;

static void read_table(table *t, const char *name)
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

static const char *text(const table *t, size_t row, const char *column)
{
    for (size_t c = 0; c < t->n_columns; c++)
        if (strcmp(t->field[0][c], column) == 0) return t->field[row][c] ? t->field[row][c] : "";
    fail_msg("no column %s", column);
    return "";
}

static double value(const table *t, size_t row, const char *column) { return strtod(text(t, row, column), NULL); }

static fw_scene scene_of(fw_floe *floes, size_t n, double duration, double accuracy)
{
    fw_scene s = {.speed = 2, .temperature = -10, .duration = duration, .n_floes = n, .floes = floes};
    fw_model_defaults(&s.model);
    s.model.accuracy = accuracy;
    return s;
}

static double ring_sum(const fw_scene *s, const fw_scene_result *r)
{
    double sum = 0, arc = 2 * 3.14159265358979323846 * s->model.structure_radius / (double)r->record.n_arcs;
    for (size_t k = 0; k < r->record.n_arcs; k++) sum += fw_record_load(&r->record, 0, FW_RING_LOAD)[k];
    return sum * arc * fw_abrasion_rate(&s->model.laws[0], s->temperature);
}

static void single_floes_at(double accuracy, double depth_tolerance)
{
    table *t = malloc(sizeof *t);
    read_table(t, "single_floe.csv");
    for (size_t row = 1; row < t->n_rows; row++) {
        const char *outcome = text(t, row, "outcome");
        double      D = value(t, row, "D"), y0 = value(t, row, "y0"), reach = 3.7 + D / 2, gap = 0.3;
        bool        is_miss = strcmp(outcome, "miss") == 0;
        double      x0 = is_miss ? -8 : -(sqrt(reach * reach - y0 * y0) + gap); /* touches gap / u after the start */
        fw_floe     f = {.x = x0, .y = y0, .diameter = D, .thickness = value(t, row, "h"), .vx = 2};
        bool        is_pinned = strncmp(outcome, "pinned", 6) == 0;
        double      stay = is_pinned ? 60 : is_miss ? 10 : value(t, row, "t_release") + 1;
        fw_scene    s = scene_of(&f, 1, stay + gap / 2, accuracy);
        fw_scene_result r;
        fw_msg          m = {""};
        if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK)
            fail_msg("case %s offset %g: %s", text(t, row, "case"), y0, m.text);
        print_message("case %s offset %g: %.0f force evaluations\n", text(t, row, "case"), y0,
                      r.record.force_evaluations);
        if (is_miss) {
            assert_true(r.record.hits == 0 && r.path == 0 && r.record.normal_impulse == 0);
        } else {
            CHECK_RELATIVE(r.record.normal_impulse, value(t, row, "J_N"), accuracy / 5);
            CHECK_RELATIVE(r.record.peak_force, value(t, row, "N_peak"), accuracy / 5);
            assert_true(r.record.hits == 1);
            if (is_pinned) {
                CHECK_NEAR(r.path, 0, 1e-12);
            } else {
                CHECK_RELATIVE(r.depth_along_contact, value(t, row, "depth_total_mm"), depth_tolerance);
                CHECK_RELATIVE(r.depth_x_wall, value(t, row, "W_mm_m"), depth_tolerance);
                CHECK_RELATIVE(r.depth_impact, value(t, row, "depth_impact_mm"), 2 * depth_tolerance);
                CHECK_RELATIVE(r.path, value(t, row, "path_total"), 2 * depth_tolerance);
                CHECK_NEAR(r.record.contact_time, value(t, row, "t_force"), 0.005 + accuracy);
                CHECK_RELATIVE(ring_sum(&s, &r), r.depth_x_wall, 1e-10);
                CHECK_RELATIVE(fabs(r.floes[0].spin), value(t, row, "spin_exit"), 2e-3); /* the file has sizes */
            }
            assert_true(r.record.energy_truncation <= accuracy);
            assert_true(r.record.energy_relative <= 1e-10 && r.record.momentum_relative <= 1e-10);
            assert_true(r.record.wear_conservation <= 1e-10);
        }
        fw_scene_result_free(&r);
    }
    free(t);
}

static void several_floes_at(double accuracy, double depth_tolerance, double position_tolerance)
{
    table *t = malloc(sizeof *t);
    read_table(t, "multi_floe.csv");
    for (size_t row = 1, n; row < t->n_rows; row += n) {
        fw_floe f[8];
        for (n = 0; row + n < t->n_rows && strcmp(text(t, row + n, "scene"), text(t, row, "scene")) == 0; n++) {
            size_t k = row + n;
            f[n] = (fw_floe){.x = value(t, k, "x0"),
                             .y = value(t, k, "y0"),
                             .diameter = value(t, k, "D"),
                             .thickness = value(t, k, "h"),
                             .vx = value(t, k, "vx0"),
                             .vy = value(t, k, "vy0"),
                             .spin = value(t, k, "spin0")};
        }
        fw_scene        s = scene_of(f, n, value(t, row, "t_end"), accuracy);
        fw_scene_result r;
        fw_msg          m = {""};
        if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK) fail_msg("%s: %s", text(t, row, "scene"), m.text);
        print_message("%s: %.0f force evaluations\n", text(t, row, "scene"), r.record.force_evaluations);
        for (size_t i = 0; i < n; i++) {
            CHECK_NEAR(r.floes[i].x, value(t, row + i, "x"), position_tolerance);
            CHECK_NEAR(r.floes[i].y, value(t, row + i, "y"), position_tolerance);
            CHECK_NEAR(r.floes[i].vx, value(t, row + i, "vx"), position_tolerance);
            CHECK_NEAR(r.floes[i].vy, value(t, row + i, "vy"), position_tolerance);
            CHECK_NEAR(r.floes[i].spin, value(t, row + i, "spin"), position_tolerance);
        }
        if (value(t, row, "depth_mm") > 0) {
            CHECK_RELATIVE(r.record.normal_impulse, value(t, row, "J_N"), accuracy / 5);
            CHECK_RELATIVE(r.depth_along_contact, value(t, row, "depth_mm"), depth_tolerance);
            CHECK_RELATIVE(r.depth_x_wall, value(t, row, "W_mm_m"), depth_tolerance);
            CHECK_RELATIVE(ring_sum(&s, &r), r.depth_x_wall, 1e-10);
        }
        assert_true(r.record.energy_truncation <= accuracy);
        assert_true(r.record.energy_relative <= 1e-10 && r.record.momentum_relative <= 1e-10);
        fw_scene_result_free(&r);
    }
    free(t);
}

static void single_10(void **state)
{
    (void)state;
    single_floes_at(0.1, 0.1);
}
static void single_1(void **state)
{
    (void)state;
    single_floes_at(0.01, 0.01);
}
static void single_01(void **state)
{
    (void)state;
    single_floes_at(0.001, 0.001);
}
static void several_10(void **state)
{
    (void)state;
    several_floes_at(0.1, 0.1, 0.05);
}
static void several_1(void **state)
{
    (void)state;
    several_floes_at(0.01, 0.01, 0.02);
}
static void several_01(void **state)
{
    (void)state;
    several_floes_at(0.001, 0.001, 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(single_10), cmocka_unit_test(single_1),
                                       cmocka_unit_test(single_01), cmocka_unit_test(several_10),
                                       cmocka_unit_test(several_1), cmocka_unit_test(several_01)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
