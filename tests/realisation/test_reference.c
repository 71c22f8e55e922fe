/* All reference solutions (tests/reference/README.md; independent of this code) at every accuracy a user may ask for: depth
 * within the accuracy, impulse, peak and final positions within the levels below, the energy balance within the accuracy. */
#include "realisation/reference_table.h"

static double ring_sum(const fw_scene *s, const fw_scene_result *r)
{
    double sum = 0, arc = 2 * 3.14159265358979323846 * s->model.structure_radius / (double)r->record.n_arcs;
    for (size_t k = 0; k < r->record.n_arcs; k++) sum += fw_record_load(&r->record, 0, FW_RING_LOAD)[k];
    return sum * arc * fw_abrasion_rate(&s->model.laws[0], s->temperature);
}

/* What a scene asked for at `accuracy` may be off by. Depth: along the moving contact and over the wall (W). Energy and the
 * ring are held to accuracy and rounding at every level. */
typedef struct level {
    double accuracy; /* asked for, and allowed in depth */
    double impulse;
    double position; /* [m], [m/s] and [rad/s], at the end of a scene and where a single floe leaves */
    /* Not promised, but they have to follow: path is half made while a floe rolls and lets go, where it wears nothing. */
    double path, contact_time; /* relative; [s] */
} level;
static const level TEN_PERCENT = {1e-1, 5e-2, 7e-2, 0.25, 0.2}, ONE_PERCENT = {1e-2, 2e-3, 3e-2, 0.05, 0.06},
                   TENTH_PERCENT = {1e-3, 2e-4, 2e-3, 5e-3, 0.02}, HUNDREDTH_PERCENT = {1e-4, 2e-5, 2e-4, 1e-3, 2e-3};

static void run(const fw_scene *s, fw_scene_result *r, const char *name)
{
    fw_msg m = {""};
    if (fw_scene_run(s, NULL, NULL, r, &m) != FW_OK) fail_msg("%s: %s", name, m.text);
    assert_true(r->record.energy_truncation <= s->model.accuracy);
    assert_true(r->record.energy_relative <= 1e-10 && r->record.momentum_relative <= 1e-10);
    assert_true(r->record.wear_conservation <= 1e-10);
}

/* Stopped when the contact ends by the reference: there the floe has to be, on the rim and at the angle. */
static void check_exit(fw_floe f, double t_exit, double exit_angle, const level *to, const char *name)
{
    double          reach = 3.7 + f.diameter / 2;
    fw_scene        s = scene_of(&f, 1, t_exit, to->accuracy);
    fw_scene_result r;
    run(&s, &r, name);
    CHECK_NEAR(r.floes[0].x, -reach * cos(exit_angle), to->position);
    CHECK_NEAR(r.floes[0].y, reach * sin(exit_angle), to->position);
    fw_scene_result_free(&r);
}

static void single_floes(const char *file, const level *to)
{
    table *t = malloc(sizeof *t);
    read_table(t, file);
    double evaluations = 0;
    for (size_t row = 1; row < t->n_rows; row++) {
        const char *outcome = text(t, row, "outcome");
        bool        is_miss = strcmp(outcome, "miss") == 0, is_pinned = strncmp(outcome, "pinned", 6) == 0;
        fw_floe     f = single_floe_of(t, row);
        double      t_touch = REFERENCE_GAP / f.vx; /* the file counts from there */
        double      stay = is_pinned ? 60 : is_miss ? 10 : value(t, row, "t_release") + 1;
        fw_scene    s = scene_of(&f, 1, t_touch + stay, to->accuracy);
        char        name[64];
        snprintf(name, sizeof name, "%s: case %s, offset %g m", file, text(t, row, "case"), f.y);
        fw_scene_result r;
        run(&s, &r, name);
        evaluations += r.record.force_evaluations;
        if (is_miss) {
            assert_true(r.record.hits == 0 && r.path == 0 && r.record.normal_impulse == 0);
        } else {
            print_message("%s\n", name);
            CHECK_RELATIVE(r.record.normal_impulse, value(t, row, "J_N"), to->impulse);
            CHECK_RELATIVE(r.record.peak_force, value(t, row, "N_peak"), to->impulse);
            assert_true(r.record.hits == 1);
            if (is_pinned) {
                CHECK_NEAR(r.path, 0, 1e-12);
            } else {
                CHECK_RELATIVE(r.depth_along_contact, value(t, row, "depth_total_mm"), to->accuracy);
                CHECK_RELATIVE(r.depth_x_wall, value(t, row, "W_mm_m"), to->accuracy);
                CHECK_RELATIVE(r.depth_impact, value(t, row, "depth_impact_mm"), 2 * to->accuracy + 5e-4);
                CHECK_RELATIVE(r.path, value(t, row, "path_total"), to->path);
                CHECK_NEAR(r.record.contact_time, value(t, row, "t_force"), to->contact_time);
                CHECK_RELATIVE(ring_sum(&s, &r), r.depth_x_wall, 1e-10);
                CHECK_NEAR(fabs(r.floes[0].spin), value(t, row, "spin_exit"), to->position); /* the file has sizes */
                double exit_angle = value(t, row, "exit_deg") * 3.14159265358979323846 / 180;
                check_exit(f, t_touch + value(t, row, "t_release"), exit_angle, to, name);
            }
        }
        fw_scene_result_free(&r);
    }
    print_message("%s at %g: %.0f force evaluations\n", file, to->accuracy, evaluations);
    free(t);
}

static void several_floes(const char *file, const level *to)
{
    table *t = malloc(sizeof *t);
    read_table(t, file);
    double evaluations = 0;
    for (size_t row = 1, n; row < t->n_rows; row += n) {
        const char *name = text(t, row, "scene");
        fw_floe     f[8];
        n = floes_of(t, row, f);
        fw_scene        s = scene_of(f, n, value(t, row, "t_end"), to->accuracy);
        fw_scene_result r;
        run(&s, &r, name);
        evaluations += r.record.force_evaluations;
        print_message("%s\n", name);
        for (size_t i = 0; i < n; i++) {
            CHECK_NEAR(r.floes[i].x, value(t, row + i, "x"), to->position);
            CHECK_NEAR(r.floes[i].y, value(t, row + i, "y"), to->position);
            CHECK_NEAR(r.floes[i].vx, value(t, row + i, "vx"), to->position);
            CHECK_NEAR(r.floes[i].vy, value(t, row + i, "vy"), to->position);
            CHECK_NEAR(r.floes[i].spin, value(t, row + i, "spin"), to->position);
        }
        if (value(t, row, "depth_mm") > 0) {
            CHECK_RELATIVE(r.record.normal_impulse, value(t, row, "J_N"), to->impulse);
            CHECK_RELATIVE(r.record.peak_force, value(t, row, "N_peak"), to->impulse);
            CHECK_RELATIVE(r.depth_along_contact, value(t, row, "depth_mm"), to->accuracy);
            CHECK_RELATIVE(r.depth_x_wall, value(t, row, "W_mm_m"), to->accuracy);
            CHECK_RELATIVE(r.path, value(t, row, "path"), to->path);
            CHECK_RELATIVE(ring_sum(&s, &r), r.depth_x_wall, 1e-10);
        }
        fw_scene_result_free(&r);
    }
    print_message("%s at %g: %.0f force evaluations\n", file, to->accuracy, evaluations);
    free(t);
}

static void all_at(const level *to)
{
    single_floes("single_floe.csv", to);
    single_floes("extreme_floes.csv", to);
    several_floes("multi_floe.csv", to);
    several_floes("extreme_multi.csv", to);
}

static void ten_percent(void **state)
{
    (void)state;
    all_at(&TEN_PERCENT);
}
static void one_percent(void **state)
{
    (void)state;
    all_at(&ONE_PERCENT);
}
static void tenth_percent(void **state)
{
    (void)state;
    all_at(&TENTH_PERCENT);
}
static void hundredth_percent(void **state)
{
    (void)state;
    all_at(&HUNDREDTH_PERCENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ten_percent), cmocka_unit_test(one_percent),
                                       cmocka_unit_test(tenth_percent), cmocka_unit_test(hundredth_percent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
