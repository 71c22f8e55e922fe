#include "check.h"
#include "effects/effects.h"

static void table_is_sound(void **state)
{
    (void)state;
    const fw_effect *e;
    size_t           n = fw_effects_list(&e);
    uint32_t         seen = 0;
    for (size_t i = 0; i < n; i++) {
        assert_true((seen & e[i].bit) == 0);
        seen |= e[i].bit;
        assert_ptr_equal(fw_effects_find(e[i].name), &e[i]);
    }
    assert_int_equal(seen, FW_EFFECTS_CORE);
    assert_null(fw_effects_find("wind"));
}

static void auto_follows_the_scene(void **state)
{
    (void)state;
    fw_model m = {.friction = 0.1, .slip_damping_ratio = 1, .damping_ratio = 1, .form_drag = 10, .water_density = 1025};
    assert_int_equal(fw_effects_auto(&m), FW_EFFECTS_CORE);
    m.friction = 0;
    assert_int_equal(fw_effects_auto(&m), FW_EFFECT_FLOE_CONTACT | FW_EFFECT_FORM_DRAG);
    m.friction = 0.1, m.form_drag = 0;
    assert_int_equal(fw_effects_auto(&m), FW_EFFECTS_CORE & ~(uint32_t)FW_EFFECT_FORM_DRAG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(table_is_sound), cmocka_unit_test(auto_follows_the_scene)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
