/* The thickness of what wore: the mean over floes, weighted by what each leaves on the wall. */
#include "realisation/reference_table.h"

static const double H[2] = {0.5, 1.1};

static fw_scene_result run(size_t n, fw_floe *f, uint32_t off)
{
    fw_scene        s = scene_of(f, n, 20, 1e-2);
    fw_scene_result r;
    fw_msg          m = {""};
    s.model.effects &= ~off;
    if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK) fail_msg("%s", m.text);
    return r;
}

/* Two floes on either side, which do not meet: each alone, then both. */
static void weighted_by_load(void **state)
{
    (void)state;
    fw_floe         f[2] = {single_floe_at(5, H[0], 3), single_floe_at(8, H[1], -4)};
    fw_scene_result one[2] = {run(1, f, FW_EFFECT_FLOE_CONTACT), run(1, f + 1, FW_EFFECT_FLOE_CONTACT)}, both = run(2, f, FW_EFFECT_FLOE_CONTACT);
    double          w0 = one[0].depth_x_wall, w1 = one[1].depth_x_wall;
    for (int i = 0; i < 2; i++) CHECK_RELATIVE(one[i].record.wear_thickness, H[i], 1e-12);
    CHECK_RELATIVE(both.record.wear_thickness, (w0 * H[0] + w1 * H[1]) / (w0 + w1), 1e-6);
    assert_true(both.record.wear_thickness > H[0] + 0.05 && both.record.wear_thickness < H[1] - 0.05);
    fw_scene_result_free(&one[0]);
    fw_scene_result_free(&one[1]);
    fw_scene_result_free(&both);
}

static void nobody_wore(void **state)
{
    (void)state;
    fw_floe         f = {.x = -20, .y = 10, .diameter = 5, .thickness = 0.5, .vx = 2};
    fw_scene_result r = run(1, &f, 0);
    assert_true(r.record.wear_thickness == 0);
    fw_scene_result_free(&r);
}

/* What wears is not what drifts, but has to lie between the classes. */
static void windows(void **state)
{
    (void)state;
    for (int n = 1; n <= 2; n++) {
        fw_model m;
        fw_model_defaults(&m);
        m.window = 300, m.mixes[0].n_classes = (size_t)n;
        m.mixes[0].classes[0] = (fw_thickness_class){H[0], n == 1 ? 1 : 0.5}, m.mixes[0].classes[1] = (fw_thickness_class){H[1], 0.5};
        fw_scenario s = {.seed = 3, .concentration = 0.3, .speed = 2};
        fw_record   r;
        assert_int_equal(fw_realise(&m, &s, NULL, &r, NULL), FW_OK);
        if (n == 1)
            CHECK_RELATIVE(r.wear_thickness, H[0], 1e-12);
        else
            assert_true(r.wear_thickness > H[0] && r.wear_thickness < H[1]);
        fw_record_free(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(weighted_by_load), cmocka_unit_test(nobody_wore), cmocka_unit_test(windows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
