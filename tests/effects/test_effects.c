/* The list of effects: its rows, and the rules that say when scenes need them. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "effects/effects.h"

enum { ALL = 0xfff };

/* The default campaign's ice: D 2 to 12.6 m, h 0.5 to 1.3 m, 40 %. */
static const fw_scene_facts FIELD = {.concentration = {0.4, 0.4},
                                     .speed = {0.1, 2},
                                     .thickness = {0.5, 1.3},
                                     .diameter = {2, 12.6},
                                     .aspect = {0.2, 0.5},
                                     .encounters = 2};

static fw_model model(void)
{
    return (fw_model){.structure_radius = 3.7,
                      .ice_density = 900,
                      .water_density = 1025,
                      .form_drag = 10,
                      .stiffness = 2e6,
                      .damping_ratio = 1,
                      .friction = 0.1,
                      .slip_damping_ratio = 1,
                      .skin_drag = 0.0055,
                      .floe_stiffness = 2e6,
                      .floe_friction = 0.1,
                      .wind = {1.3, 0.0018, 1.1},
                      .tide = {.period = 44712},
                      .crushing_limit = {5e6, 0},
                      .crush = {.law = {1.1e6, 0}, .has_flat = true},
                      .n_laws = 1,
                      .laws = {{.exponent = 1.121}},
                      .window = 10800};
}

static void table_is_sound(void **state)
{
    (void)state;
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    uint32_t                seen = 0;
    for (size_t i = 0; i < n; i++) {
        assert_int_equal(e[i]->bit, 1u << i);
        seen |= (uint32_t)e[i]->bit;
        assert_ptr_equal(fw_effects_find(e[i]->name), e[i]);
        const char *const words[] = {e[i]->does, e[i]->equation, e[i]->source, e[i]->range, e[i]->limit, e[i]->needed, e[i]->off};
        for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) assert_true(words[k] && strlen(words[k]) > 8);
        assert_memory_equal(e[i]->needed, "needed ", 7);
    }
    assert_int_equal(seen, ALL);
    assert_null(fw_effects_find("ice"));
}

static void auto_follows_the_scene(void **state)
{
    (void)state;
    fw_model m = model();
    assert_int_equal(fw_effects_auto(&m, &FIELD), FW_EFFECTS_CORE);
    m.friction = 0;
    assert_int_equal(fw_effects_auto(&m, &FIELD), FW_EFFECT_FLOE_CONTACT | FW_EFFECT_FORM_DRAG);
    m.friction = 0.1, m.form_drag = 0; /* then the skin carries floes on */
    assert_int_equal(fw_effects_auto(&m, &FIELD), (FW_EFFECTS_CORE & ~FW_EFFECT_FORM_DRAG) | FW_EFFECT_SKIN_DRAG);
    m.skin_drag = 0;
    assert_int_equal(fw_effects_auto(&m, &FIELD), FW_EFFECTS_CORE & ~FW_EFFECT_FORM_DRAG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(table_is_sound), cmocka_unit_test(auto_follows_the_scene)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
