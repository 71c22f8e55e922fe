/* The list of effects: its rows, the rules that say when scenes need them, and the choices that are refused. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "effects/effects.h"
#include "effects/floe_contact.h"

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

/* ---- rules: both sides of each, and the numbers in their reasons -------------------------------------------------- */

static char REASON[FW_REASON_SIZE]; /* of the last call */

static bool needed(const char *name, const fw_model *m, const fw_scene_facts *f)
{
    memset(REASON, 0, sizeof REASON);
    bool it_is = fw_effects_find(name)->is_needed(m, f, REASON);
    assert_true(strlen(REASON) > 4 && strlen(REASON) < FW_REASON_SIZE);
    return it_is;
}

static void floe_contact_wants_company(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    assert_true(needed("floe_contact", &m, &f));
    /* 0.4 / 39 m2 x 2 x 7 m x (7.4 + 7) m, and in proportion to the ice */
    CHECK_RELATIVE(fw_floe_contact_encounters(0.4, 3.7, 7, 39), 0.4 / 39 * 14 * 14.4, 1e-14);
    CHECK_RELATIVE(fw_floe_contact_encounters(0.1, 3.7, 7, 39), 0.25 * fw_floe_contact_encounters(0.4, 3.7, 7, 39), 1e-14);
    f.encounters = 0.019;
    assert_false(needed("floe_contact", &m, &f));
    assert_non_null(strstr(REASON, "0.019"));
    f.encounters = 0.021;
    assert_true(needed("floe_contact", &m, &f));
    f.n_floes = 1;
    assert_false(needed("floe_contact", &m, &f));
    f.n_floes = 2, f.encounters = 0;
    assert_true(needed("floe_contact", &m, &f));
}

/* Way on which a floe takes up half the current's speed, by small steps of dv/dt = -K v^2. */
static double half_way(double K)
{
    double v = 1, x = 0, dt = 1e-5 / K;
    while (v > 0.5) {
        double middle = v - 0.5 * dt * K * v * v;
        x += middle * dt, v -= dt * K * middle * middle;
    }
    return x;
}

static void form_drag_says_how_soon(void **state)
{
    (void)state;
    fw_model m = model();
    double   low, high, d0, d1, K = 1025 * 10 * 2 / (2 * 900 * acos(-1) * 1); /* D h / (pi R^2 h) at D = 2 m */
    assert_true(needed("form_drag", &m, &FIELD));
    assert_int_equal(sscanf(REASON, "coefficient 10: floes of %lf to %lf m take up half the current's speed in %lf to %lf m", &d0, &d1, &low, &high), 4);
    CHECK_RELATIVE(low, half_way(K), 0.03); /* two digits are printed */
    CHECK_RELATIVE(high, half_way(K / 6.3), 0.03);
    m.form_drag = 0;
    assert_false(needed("form_drag", &m, &FIELD));
}

static void a_flat_turns_floes(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    m.friction = 0;
    assert_false(needed("rotation", &m, &f));
    f.given = FW_GIVEN_LAW_CRUSH;
    assert_true(needed("rotation", &m, &f));
    m.crush.has_flat = false;
    assert_false(needed("rotation", &m, &f));
    m.crush.has_flat = true, m.slip_damping_ratio = 0;
    assert_false(needed("rotation", &m, &f));
}

static void wind_needs_a_speed(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    double         w0, w1, low, high;
    assert_false(needed("wind", &m, &f));
    f.given = FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED;
    assert_false(needed("wind", &m, &f)); /* a calm */
    f.wind_speed = (fw_range){3, 15}, f.aspect = (fw_range){0.2, 0.2}; /* 5 x 0.5 m */
    assert_true(needed("wind", &m, &f));
    assert_int_equal(sscanf(REASON, "wind of %lf to %lf m/s: floes drift through the water by %lf to %lf %%", &w0, &w1, &low, &high), 4);
    assert_true(w0 == 3 && w1 == 15);
    CHECK_NEAR(low, 0.43, 0.006);
    CHECK_NEAR(high, 0.43, 0.006);
    f.wind_speed.low = 15;
    assert_true(needed("wind", &m, &f));
    assert_non_null(strstr(REASON, "wind of 15 m/s: "));
    f.wind_speed = (fw_range){3, INFINITY}; /* a law without an upper end */
    assert_true(needed("wind", &m, &f));
    assert_non_null(strstr(REASON, "wind of 3 m/s and more: "));
    m.form_drag = 0, m.wind.form_drag = 0; /* skin alone, of both */
    assert_true(needed("wind", &m, &f));
    assert_int_equal(sscanf(strstr(REASON, "by"), "by %lf to %lf %%", &low, &high), 2);
    CHECK_NEAR(low, 2.0, 0.06);
    m.wind.skin_drag = 0;
    assert_false(needed("wind", &m, &f));
    m.wind.form_drag = 1.1;
    assert_true(needed("wind", &m, &f));
    m.ice_density = m.water_density; /* no freeboard that it could act on */
    assert_false(needed("wind", &m, &f));
}

static void those_that_must_be_asked_for(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    double         low, high, d0, d1;
    f.aspect = (fw_range){0.2, 0.5}; /* D 5 m, h 0.5 m; D = 4h */
    assert_false(needed("added_mass", &m, &f));
    assert_int_equal(sscanf(REASON, "no water.added_mass: on; it adds %lf to %lf %%", &low, &high), 2);
    CHECK_NEAR(low, 12.7, 0.5);
    CHECK_NEAR(high, 28.0, 0.5);
    f.given = FW_GIVEN_ADDED_MASS_ON;
    assert_true(needed("added_mass", &m, &f));
    f.diameter = (fw_range){2.5, 10};
    assert_false(needed("deflected_flow", &m, &f));
    assert_int_equal(sscanf(REASON, "no water.deflected_flow: on; touching floes of %lf to %lf m would meet %lf to %lf of the flow", &d0, &d1, &low, &high), 4);
    CHECK_NEAR(low, 0.441, 0.0051);
    CHECK_NEAR(high, 0.819, 0.0051);
    f.given = FW_GIVEN_DEFLECTED_ON;
    assert_true(needed("deflected_flow", &m, &f));
    assert_false(needed("crush_contact", &m, &f));
    f.given = FW_GIVEN_LAW_CRUSH;
    assert_true(needed("crush_contact", &m, &f));
    assert_false(needed("crushing_limit", &m, &f));
    f.given = FW_GIVEN_CRUSHING_LIMIT;
    assert_true(needed("crushing_limit", &m, &f));
}

static void tide_wants_a_tide(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    fw_course_row  rows[] = {{0, 1, 0}, {3600, 0.25, -acos(-1) / 3}};
    assert_false(needed("tide", &m, &f));
    f.given = FW_GIVEN_TIDE;
    assert_true(needed("tide", &m, &f));
    assert_non_null(strstr(REASON, "3 h is 87 deg")); /* 360 x 3 / 12.42 */
    m.tide.minor_ratio = -0.0;
    assert_true(needed("tide", &m, &f));
    assert_null(strchr(REASON, '-'));
    f.given = FW_GIVEN_COURSE, m.tide.n_rows = 2, m.tide.rows = rows;
    assert_true(needed("tide", &m, &f));
    assert_non_null(strstr(REASON, "2 rows, 0 to 1 h of a window of 3 h: 0.25 to 1 times the speed, turning through 60 deg"));
}

static void ice_on_ice_must_differ_and_meet(void **state)
{
    (void)state;
    fw_model       m = model();
    fw_scene_facts f = FIELD;
    m.floe_stiffness = 1e6;
    assert_false(needed("ice_on_ice", &m, &f)); /* nobody wrote it */
    f.given = FW_GIVEN_FLOE_STIFFNESS;
    assert_true(needed("ice_on_ice", &m, &f));
    f.encounters = 0.001;
    assert_false(needed("ice_on_ice", &m, &f));
    f.encounters = 1, f.given = FW_GIVEN_FLOE_FRICTION;
    assert_false(needed("ice_on_ice", &m, &f)); /* the same */
    m.floe_friction = 0.2;
    assert_true(needed("ice_on_ice", &m, &f));
    m.friction = 0; /* friction between floes alone is friction */
    assert_true(needed("friction", &m, &f) && needed("rotation", &m, &f));
    f.given = 0;
    assert_false(needed("friction", &m, &f) || needed("rotation", &m, &f));
}

/* ---- refusals: the choice, and the key that is in the way ---------------------------------------------------------- */

static void check_refused(const fw_model *m, const fw_scene_facts *f, const char *wanted)
{
    const char *key = NULL, *why = fw_effects_refuse(m, f, &key);
    if (!wanted) {
        if (why) fail_msg("%s: %s", key, why);
        return;
    }
    if (!why) fail_msg("nobody refused at %s", wanted);
    assert_string_equal(key, wanted);
    assert_true(strlen(why) > 20);
}

static void contradictions(void **state)
{
    static const struct {
        uint32_t    on, off, given; /* besides the core */
        const char *key;
    } rows[] = {
        {0, 0, 0, NULL},
        {FW_EFFECT_SKIN_DRAG | FW_EFFECT_ADDED_MASS | FW_EFFECT_DEFLECTED_FLOW | FW_EFFECT_CRUSHING_LIMIT | FW_EFFECT_CRUSH_CONTACT, 0, 0, NULL},
        {0, 0, FW_GIVEN_WIND, "wind"},
        {FW_EFFECT_WIND, 0, 0, "effects"},
        {FW_EFFECT_WIND, 0, FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED, NULL},
        {FW_EFFECT_WIND, FW_EFFECT_FORM_DRAG, FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED, "wind"},
        {FW_EFFECT_WIND | FW_EFFECT_SKIN_DRAG, FW_EFFECT_FORM_DRAG, FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED, NULL},
        {0, 0, FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED, NULL}, /* switched off */
        {FW_EFFECT_TIDE, 0, 0, "effects"},
        {FW_EFFECT_TIDE, 0, FW_GIVEN_TIDE, NULL},
        {0, 0, FW_GIVEN_TIDE, NULL},
        {0, 0, FW_GIVEN_TIDE | FW_GIVEN_COURSE, "current.course"},
        {FW_EFFECT_ADDED_MASS, 0, FW_GIVEN_ADDED_MASS_OFF, "water.added_mass"},
        {0, 0, FW_GIVEN_ADDED_MASS_ON, NULL},
        {FW_EFFECT_DEFLECTED_FLOW, 0, FW_GIVEN_DEFLECTED_OFF, "water.deflected_flow"},
        {FW_EFFECT_DEFLECTED_FLOW, FW_EFFECT_FORM_DRAG, 0, "water.deflected_flow"},
        {FW_EFFECT_DEFLECTED_FLOW | FW_EFFECT_SKIN_DRAG, FW_EFFECT_FORM_DRAG, 0, NULL},
        {FW_EFFECT_ICE_ON_ICE, 0, 0, "effects"},
        {FW_EFFECT_ICE_ON_ICE, 0, FW_GIVEN_FLOE_FRICTION, NULL}, /* 0.2 below */
        {FW_EFFECT_ICE_ON_ICE, FW_EFFECT_FRICTION, FW_GIVEN_FLOE_FRICTION, "contact.floe_friction"},
        {FW_EFFECT_ICE_ON_ICE, FW_EFFECT_FLOE_CONTACT, FW_GIVEN_FLOE_FRICTION, "effects"},
        {FW_EFFECT_CRUSH_CONTACT, 0, FW_GIVEN_LAW_SPRING, "contact.law"},
        {0, 0, FW_GIVEN_LAW_CRUSH, "contact.law"},
        {FW_EFFECT_CRUSH_CONTACT, 0, FW_GIVEN_LAW_CRUSH | FW_GIVEN_FLAT | FW_GIVEN_UNLOADING | FW_GIVEN_PRESSURE, NULL},
        {FW_EFFECT_CRUSH_CONTACT, FW_EFFECT_ROTATION, FW_GIVEN_FLAT, "contact.flat"},
        {FW_EFFECT_CRUSH_CONTACT, FW_EFFECT_ROTATION, 0, NULL}, /* the flat is a default */
        {0, 0, FW_GIVEN_PRESSURE, "contact.pressure"},
        {0, 0, FW_GIVEN_PRESSURE_EXPONENT, "contact.pressure_exponent"},
        {FW_EFFECT_CRUSH_CONTACT, 0, FW_GIVEN_PRESSURE_EXPONENT, NULL},
        {0, 0, FW_GIVEN_FLAT, "contact.flat"},
        {0, 0, FW_GIVEN_UNLOADING, "contact.unloading_stiffness"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        fw_model       m = model();
        fw_scene_facts f = FIELD;
        f.wind_speed = (fw_range){0, 10};
        m.floe_friction = 0.2;
        f.given = rows[i].given;
        m.effects = (FW_EFFECTS_CORE | rows[i].on) & ~rows[i].off;
        check_refused(&m, &f, rows[i].key);
    }
}

static void numbers_that_mean_nothing(void **state)
{
    (void)state;
    fw_model       m = model(), good = model();
    fw_scene_facts f = FIELD, still = FIELD;
    fw_course_row  rows[] = {{0, 1, 0}, {3600, 1, 0}};
    still.n_floes = 1, still.speed = (fw_range){0, 0};
    good.effects = m.effects = FW_EFFECTS_CORE;
#define REFUSED(change, facts, key) (m = good, change, check_refused(&m, facts, key))
    REFUSED(m.friction = 0, &f, "contact.friction");
    REFUSED(m.slip_damping_ratio = 0, &f, "contact.slip_damping_ratio");
    REFUSED(m.damping_ratio = 0, &f, "contact.damping_ratio");
    REFUSED(m.form_drag = 0, &f, "water.form_drag");
    REFUSED((m.skin_drag = 0, m.effects |= FW_EFFECT_SKIN_DRAG), &f, "water.skin_drag");
    REFUSED(m.laws[0].exponent = 2, &f, "abrasion.laws");
    REFUSED((m.laws[0].exponent = 2.5, m.effects |= FW_EFFECT_CRUSHING_LIMIT), &f, NULL);
    REFUSED(m.stiffness_from_pressure = true, &f, "contact.stiffness");
    REFUSED((m.stiffness_from_pressure = true, m.effects |= FW_EFFECT_CRUSH_CONTACT), &f, NULL);
    REFUSED((m.stiffness_from_pressure = true, m.effects |= FW_EFFECT_CRUSH_CONTACT), &still, "current.speed");
    REFUSED(m.effects |= FW_EFFECT_DEFLECTED_FLOW, &still, "current.speed");
    f.given = FW_GIVEN_PRESSURE;
    REFUSED(m.stiffness_from_pressure = true, &f, NULL);
    f.given = FW_GIVEN_PRESSURE | FW_GIVEN_FLOE_STIFFNESS;
    REFUSED(m.stiffness_from_pressure = true, &f, "contact.floe_stiffness");
    f.given = FW_GIVEN_COURSE;
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows), &f, "current.course");
    rows[1].turn = 0.1;
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows), &f, NULL);
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows, rows[0].factor = rows[1].factor = 0), &f, "current.course");
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows, rows[0].factor = -1.001 * 20 / f.speed.high), &f, "current.course");
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows, rows[0].factor = -0.999 * 20 / f.speed.high), &f, NULL);
    REFUSED((m.effects |= FW_EFFECT_TIDE, m.tide.n_rows = 2, m.tide.rows = rows, rows[0].time = m.window, rows[1].time = 2 * m.window), &f, "current.course");
    still.given = FW_GIVEN_TIDE;
    REFUSED(m.effects |= FW_EFFECT_TIDE, &still, "current.speed");
    f.given = FW_GIVEN_WIND | FW_GIVEN_WIND_SPEED;
    REFUSED(m.effects |= FW_EFFECT_WIND, &f, "wind.speed"); /* 0 */
    f.wind_speed = (fw_range){5, 5};
    REFUSED((m.effects |= FW_EFFECT_WIND, m.wind.skin_drag = m.wind.form_drag = 0), &f, "wind");
    f.given = FW_GIVEN_FLAT;
    REFUSED(m.crush.has_flat = false, &f, NULL); /* flat: off says what a spring does */
    REFUSED((m.effects = (m.effects | FW_EFFECT_CRUSH_CONTACT) & ~(uint32_t)FW_EFFECT_FRICTION, m.slip_damping_ratio = 0), &f, "contact.flat");
    REFUSED((m.effects = (m.effects | FW_EFFECT_CRUSH_CONTACT) & ~(uint32_t)FW_EFFECT_FRICTION, m.friction = 0), &f, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_is_sound),
        cmocka_unit_test(auto_follows_the_scene),
        cmocka_unit_test(floe_contact_wants_company),
        cmocka_unit_test(form_drag_says_how_soon),
        cmocka_unit_test(a_flat_turns_floes),
        cmocka_unit_test(wind_needs_a_speed),
        cmocka_unit_test(those_that_must_be_asked_for),
        cmocka_unit_test(tide_wants_a_tide),
        cmocka_unit_test(ice_on_ice_must_differ_and_meet),
        cmocka_unit_test(contradictions),
        cmocka_unit_test(numbers_that_mean_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
