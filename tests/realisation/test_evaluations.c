/* What one contact costs: force evaluations of table case 1 (D 2.5 m, h 0.5 m) at offset 2 m, a count and no time, so that it is
 * the same on every machine. The depth has to be right at that price (tests/reference, independent of this code). */
#include "realisation/reference_table.h"

static void costs_at_most(double accuracy, double evaluations)
{
    table *t = malloc(sizeof *t);
    read_table(t, "single_floe.csv");
    size_t row = 1;
    while (row < t->n_rows && !(strcmp(text(t, row, "case"), "1") == 0 && value(t, row, "y0") == 2)) row++;
    assert_true(row < t->n_rows);
    fw_floe         f = single_floe_of(t, row);
    fw_scene        s = scene_of(&f, 1, REFERENCE_GAP / f.vx + value(t, row, "t_release") + 1, accuracy);
    fw_scene_result r;
    fw_msg          m = {""};
    if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK) fail_msg("%s", m.text);
    print_message("accuracy %g: %.0f force evaluations, %.0f steps, depth off by %.1e\n", accuracy,
                  r.record.force_evaluations, r.record.steps,
                  r.depth_along_contact / value(t, row, "depth_total_mm") - 1);
    CHECK_RELATIVE(r.depth_along_contact, value(t, row, "depth_total_mm"), accuracy);
    CHECK_RELATIVE(r.depth_x_wall, value(t, row, "W_mm_m"), accuracy);
    assert_true(r.record.force_evaluations <= evaluations);
    fw_scene_result_free(&r);
    free(t);
}

static void one_percent(void **state)
{
    (void)state;
    costs_at_most(0.01, 90);
}
static void tenth_percent(void **state)
{
    (void)state;
    costs_at_most(0.001, 400);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_percent), cmocka_unit_test(tenth_percent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
