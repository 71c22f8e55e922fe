/* Scenes with wind, skin drag, added mass, deflected flow, a current that changes and floes with contact properties of their own, against
 * tests/reference/effects.csv (independent of this code; README.md there): depth within the accuracy, impulse, final positions and spins
 * within the levels below, the energy balance within the accuracy, books to rounding. */
#include "realisation/reference_table.h"

static const double DEGREE = 3.14159265358979323846 / 180;

/* Parameters as the file has them, on the first row of a scene. */
static fw_scene effects_scene_of(const table *t, size_t row, fw_floe f[8], fw_course_row *course, double accuracy)
{
    size_t    n = floes_of(t, row, f);
    fw_scene  s = scene_of(f, n, value(t, row, "t_end"), accuracy);
    fw_model *m = &s.model;
    s.speed = value(t, row, "speed"), m->window = s.duration;
    m->form_drag = value(t, row, "form_drag"), m->skin_drag = value(t, row, "skin_drag");
    if (!(m->form_drag > 0)) m->effects &= ~(uint32_t)FW_EFFECT_FORM_DRAG;
    if (m->skin_drag > 0) m->effects |= FW_EFFECT_SKIN_DRAG;
    if (value(t, row, "added_mass") > 0) m->effects |= FW_EFFECT_ADDED_MASS;
    if (value(t, row, "deflected") > 0) m->effects |= FW_EFFECT_DEFLECTED_FLOW;
    if (!(value(t, row, "rotation") > 0)) m->effects &= ~(uint32_t)FW_EFFECT_ROTATION;
    if (value(t, row, "floe_k") > 0) {
        m->effects |= FW_EFFECT_ICE_ON_ICE;
        m->floe_stiffness = value(t, row, "floe_k"), m->floe_friction = value(t, row, "floe_mu");
    }
    if (value(t, row, "wind_speed") > 0) {
        m->effects |= FW_EFFECT_WIND;
        s.wind_speed = value(t, row, "wind_speed"), s.wind_angle = value(t, row, "wind_deg") * DEGREE;
    }
    if (value(t, row, "period") > 0) {
        m->effects |= FW_EFFECT_TIDE;
        m->tide.period = value(t, row, "period"), m->tide.minor_ratio = value(t, row, "minor_ratio");
        s.tide_phase = value(t, row, "phase");
    }
    const char *text_of = text(t, row, "course");
    if (*text_of) {
        m->effects |= FW_EFFECT_TIDE;
        m->tide.rows = course;
        for (const char *p = text_of; p; p = strchr(p, ';') ? strchr(p, ';') + 1 : NULL) {
            fw_course_row *r = &course[m->tide.n_rows++];
            assert_int_equal(sscanf(p, "%lf:%lf:%lf", &r->time, &r->factor, &r->turn), 3);
        }
    }
    return s;
}

/* Depth is promised within the accuracy; the rest has to follow. Two of the scenes make 13 times what a place was wrong by before the floes met. */
typedef struct level {
    double accuracy, impulse, position; /* position: [m], [m/s] and [rad/s], at the end */
} level;
static const level LEVELS[] = {{1e-2, 6e-3, 8e-2}, {1e-3, 6e-4, 5e-3}, {1e-4, 1e-4, 4e-4}};

/* Largest seen over allowed, for the reader. */
typedef struct worst {
    double depth, wall, impulse, position, spin, energy, evaluations;
} worst;

static double off(double is, double wanted) { return wanted > 0 ? fabs(is / wanted - 1) : fabs(is); }

static void compare(const table *t, size_t row, const level *to, worst *all)
{
    fw_floe         f[8];
    fw_course_row   course[16];
    fw_scene        s = effects_scene_of(t, row, f, course, to->accuracy);
    fw_scene_result r;
    fw_msg          m = {""};
    const char     *name = text(t, row, "scene");
    if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK) fail_msg("%s: %s", name, m.text);
    worst w = {.depth = off(r.depth_along_contact, value(t, row, "depth_mm")),
               .wall = off(r.depth_x_wall, value(t, row, "W_mm_m")),
               .impulse = off(r.record.normal_impulse, value(t, row, "J_N")),
               .energy = r.record.energy_truncation,
               .evaluations = r.record.force_evaluations};
    for (size_t i = 0; i < s.n_floes; i++) {
        const fw_floe *is = &r.floes[i];
        w.position = fmax(w.position, hypot(is->x - value(t, row + i, "x"), is->y - value(t, row + i, "y")));
        w.position = fmax(w.position, hypot(is->vx - value(t, row + i, "vx"), is->vy - value(t, row + i, "vy")));
        w.spin = fmax(w.spin, fabs(is->spin - value(t, row + i, "spin")));
    }
    print_message("%-22s depth %.1e  wall %.1e  impulse %.1e  place %.1e m  spin %.1e  energy %.1e  %6.0f evaluations\n", name, w.depth, w.wall, w.impulse,
                  w.position, w.spin, w.energy, w.evaluations);
    assert_true(w.depth <= to->accuracy && w.wall <= to->accuracy && w.energy <= to->accuracy);
    assert_true(w.impulse <= to->impulse && w.position <= to->position && w.spin <= to->position);
    assert_true(r.record.energy_relative <= 1e-10 && r.record.momentum_relative <= 1e-10 && r.record.wear_conservation <= 1e-10);
    assert_int_equal(r.record.tries, 1);
    all->depth = fmax(all->depth, w.depth), all->wall = fmax(all->wall, w.wall), all->impulse = fmax(all->impulse, w.impulse);
    all->position = fmax(all->position, w.position), all->spin = fmax(all->spin, w.spin), all->energy = fmax(all->energy, w.energy);
    all->evaluations += w.evaluations;
    fw_scene_result_free(&r);
}

static void all_scenes_at_every_level(void **state)
{
    (void)state;
    table *t = malloc(sizeof *t);
    read_table(t, "effects.csv");
    for (size_t k = 0; k < sizeof LEVELS / sizeof LEVELS[0]; k++) {
        worst all = {0};
        for (size_t row = 1; row < t->n_rows; row++)
            if (*text(t, row, "speed")) compare(t, row, &LEVELS[k], &all);
        print_message("at %g: depth %.1e  wall %.1e  impulse %.1e  place %.1e m  spin %.1e  energy %.1e  %.0f evaluations\n\n", LEVELS[k].accuracy, all.depth,
                      all.wall, all.impulse, all.position, all.spin, all.energy, all.evaluations);
    }
    free(t);
}

/* A current that changes is constant over segments that go with the accuracy. With all other tolerances far below, what is left of the error of a
 * place is theirs: second order. */
static double place_error(const table *t, size_t row, double accuracy)
{
    fw_floe         f[8];
    fw_course_row   course[16];
    fw_scene        s = effects_scene_of(t, row, f, course, accuracy);
    fw_scene_result r;
    double          largest = 0;
    s.model.numerics = (fw_numerics){.tolerance = 1e-8, .wear_tolerance = 1e-8, .first_step = 0.02, .growth = 4};
    assert_int_equal(fw_scene_run(&s, NULL, NULL, &r, NULL), FW_OK);
    for (size_t i = 0; i < s.n_floes; i++)
        largest = fmax(largest, hypot(r.floes[i].x - value(t, row + i, "x"), r.floes[i].y - value(t, row + i, "y")));
    fw_scene_result_free(&r);
    return largest;
}

static void segments_are_second_order(void **state)
{
    (void)state;
    table *t = malloc(sizeof *t);
    read_table(t, "effects.csv");
    for (size_t row = 1; row < t->n_rows; row++) {
        const char *name = text(t, row, "scene");
        if (!*text(t, row, "speed")) continue; /* another floe of the scene above */
        if (strcmp(name, "T01_to_and_fro") != 0 && strcmp(name, "T04_reversal") != 0) continue;
        double coarse = place_error(t, row, 8e-2), fine = place_error(t, row, 1e-2), order = log2(coarse / fine) / 3;
        print_message("%s: place wrong by %.1e m in segments for 8 %%, %.1e m for 1 %%: order %.2f\n", name, coarse, fine, order);
        assert_true(order > 1.8 && order < 2.2);
    }
    free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_scenes_at_every_level), cmocka_unit_test(segments_are_second_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
