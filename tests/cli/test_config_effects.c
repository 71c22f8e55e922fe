/* Keys of the further effects, `effects:` itself, and what both leave in the settings. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/config_check.h"

#define PI 3.14159265358979323846

static void read_good(fw_campaign *c, const char *path, const char *set)
{
    fw_msg m = {""};

    if (fw_config_campaign(c, path, set ? 1 : 0, &set, -1, &m) != FW_OK) fail_msg("%s: %s", set ? set : path, m.text);
}

static bool is_near(double a, double b) { return fabs(a - b) <= 1e-12 * fabs(b); }

static void every_key_lands(void **state)
{
    fw_campaign c;
    (void)state;

    read_good(&c, GOOD "effects.yaml", NULL);
    const fw_model *m = &c.model;
    assert_int_equal(m->effects, (FW_EFFECTS_CORE | FW_EFFECT_SKIN_DRAG | FW_EFFECT_WIND | FW_EFFECT_ADDED_MASS | FW_EFFECT_TIDE |
                                  FW_EFFECT_DEFLECTED_FLOW | FW_EFFECT_CRUSHING_LIMIT | FW_EFFECT_ICE_ON_ICE | FW_EFFECT_CRUSH_CONTACT));
    assert_true(m->skin_drag == 0.004 && m->form_drag == 0.9);
    assert_true(m->wind.density == 1.35 && m->wind.skin_drag == 0.002 && m->wind.form_drag == 0.9);
    assert_true(c.site.wind_speed.kind == FW_DIST_WEIBULL && c.site.wind_speed.a == 6 && c.site.wind_speed.high == 20);
    assert_true(c.site.wind_angle.kind == FW_DIST_UNIFORM && c.site.wind_angle.a == 30 && c.site.wind_angle.b == 90);
    assert_true(m->tide.period == 43200 && m->tide.minor_ratio == -0.3 && is_near(m->tide.phase, PI / 2) && m->tide.n_rows == 0);
    assert_true(m->crushing_limit.pressure == 4e6 && m->crushing_limit.exponent == 0.5);
    assert_true(m->crush.law.pressure == 0.8e6 && m->crush.law.exponent == 0.2 && m->crush.unloading == 30 && !m->crush.has_flat);
    assert_true(m->stiffness_from_pressure && m->floe_friction == 0.3 && m->friction == 0.1);
    assert_true(m->effects_tolerance == 0.01);
    fw_campaign_free(&c);
}

/* What is left out is the engine's own default model. */
static void nothing_given_nothing_on(void **state)
{
    fw_campaign c;
    fw_model    d;
    (void)state;

    read_good(&c, GOOD "minimal.yaml", NULL);
    fw_model_defaults(&d);
    const fw_model *m = &c.model;
    assert_int_equal(m->effects, FW_EFFECTS_CORE);
    assert_int_equal(m->given, 0);
    assert_true(m->skin_drag == d.skin_drag && m->floe_stiffness == d.floe_stiffness && m->floe_friction == d.floe_friction);
    assert_true(m->wind.density == d.wind.density && m->wind.skin_drag == d.wind.skin_drag && m->wind.form_drag == d.wind.form_drag);
    assert_true(m->tide.period == d.tide.period && m->tide.minor_ratio == d.tide.minor_ratio && isnan(m->tide.phase) && isnan(d.tide.phase));
    assert_true(m->crushing_limit.pressure == d.crushing_limit.pressure && m->crushing_limit.exponent == d.crushing_limit.exponent);
    assert_true(m->crush.law.pressure == d.crush.law.pressure && m->crush.law.exponent == d.crush.law.exponent);
    assert_true(m->crush.has_flat == d.crush.has_flat && m->crush.unloading <= 0 && d.crush.unloading <= 0);
    assert_true(!m->stiffness_from_pressure && m->effects_tolerance == 0 && d.effects_tolerance == 0);
    fw_campaign_free(&c);
}

/* Hours to seconds, clockwise degrees to anticlockwise radians. */
static void course(void **state)
{
    static const double wanted[3][3] = {{0, 1, 0}, {5400, 0.5, -PI / 2}, {10800, 0, -PI}};
    fw_scene            s;
    fw_msg              m = {""};
    (void)state;

    if (fw_config_scene(&s, GOOD "scene-effects.yaml", 0, NULL, &m) != FW_OK) fail_msg("%s", m.text);
    assert_int_equal(s.model.tide.n_rows, 2 + 1);
    for (size_t i = 0; i < 3; i++) {
        const fw_course_row *r = &s.model.tide.rows[i];
        assert_true(r->time == wanted[i][0] && r->factor == wanted[i][1] && fabs(r->turn - wanted[i][2]) < 1e-12);
    }
    assert_true(s.wind_speed == 10 && is_near(s.wind_angle, -PI / 2)); /* clockwise of +x: towards -y */
    assert_true(s.model.floe_stiffness == 5e5 && s.model.stiffness == 2e6);
    assert_int_equal(s.model.effects, (FW_EFFECTS_CORE | FW_EFFECT_WIND | FW_EFFECT_TIDE | FW_EFFECT_ICE_ON_ICE));
    fw_scene_free(&s);
    fw_scene_free(&s);
}

static void switches(void **state)
{
    static const struct {
        const char *contact, *water, *more;
        uint32_t    wanted;
    } rows[] = {
        {"{}", "{}", "effects: auto", FW_EFFECTS_CORE},
        {"{}", "{form_drag: 0}", "effects: auto", FW_EFFECT_FLOE_CONTACT | FW_EFFECT_FRICTION | FW_EFFECT_ROTATION | FW_EFFECT_SKIN_DRAG},
        {"{}", "{form_drag: 0, skin_drag: 0}", "effects: auto", FW_EFFECT_FLOE_CONTACT | FW_EFFECT_FRICTION | FW_EFFECT_ROTATION},
        {"{}", "{}", "effects: [form_drag, skin_drag, added_mass]", FW_EFFECT_FORM_DRAG | FW_EFFECT_SKIN_DRAG | FW_EFFECT_ADDED_MASS},
        {"{}", "{added_mass: off}", "effects: auto", FW_EFFECTS_CORE},
        {"{}", "{added_mass: on}", "effects: {added_mass: off}", FW_EFFECTS_CORE},
        {"{}", "{}", "effects: {added_mass: on, deflected_flow: on}", FW_EFFECTS_CORE | FW_EFFECT_ADDED_MASS | FW_EFFECT_DEFLECTED_FLOW},
        {"{}", "{}", "effects: {crushing_limit: on}", FW_EFFECTS_CORE | FW_EFFECT_CRUSHING_LIMIT},
        {"{}", "{}", "effects: {crush_contact: on}", FW_EFFECTS_CORE | FW_EFFECT_CRUSH_CONTACT},
        {"{law: crush}", "{}", "effects: auto", FW_EFFECTS_CORE | FW_EFFECT_CRUSH_CONTACT},
        {"{law: crush}", "{}", "effects: {crush_contact: on, friction: off}", (FW_EFFECTS_CORE & ~FW_EFFECT_FRICTION) | FW_EFFECT_CRUSH_CONTACT},
        {"{law: spring, flat: off}", "{}", "effects: auto", FW_EFFECTS_CORE},
        {"{stiffness: from_pressure, pressure: 1 MPa}", "{}", "effects: auto", FW_EFFECTS_CORE},
        {"{floe_friction: 0.1}", "{}", "effects: auto", FW_EFFECTS_CORE},
        {"{friction: 0, floe_friction: 0.1}", "{}", "effects: auto", FW_EFFECTS_CORE | FW_EFFECT_ICE_ON_ICE},
        {"{floe_stiffness: 1 MN/m}", "{}", "effects: {ice_on_ice: off}", FW_EFFECTS_CORE},
        {"{floe_stiffness: 1 MN/m}", "{}", "effects: [floe_contact, ice_on_ice]", FW_EFFECT_FLOE_CONTACT | FW_EFFECT_ICE_ON_ICE},
        {"{}", "{}", "wind: {speed: 10 m/s}", FW_EFFECTS_CORE | FW_EFFECT_WIND},
        {"{}", "{}", "wind: {speed: 0 m/s}", FW_EFFECTS_CORE},
        {"{}", "{}", "wind: {speed: 10 m/s}\neffects: {wind: off}", FW_EFFECTS_CORE},
    };
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char        text[512];
        fw_campaign c;
        fw_msg      m;
        snprintf(text, sizeof text, "ice: {temperature: -10 degC, concentration: 40 %%}\ncurrent: {speed: 1 m/s}\ncontact: %s\nwater: %s\n%s\n",
                 rows[i].contact, rows[i].water, rows[i].more);
        if (read_campaign_text(&c, text, &m) != FW_OK) fail_msg("%s\n%s", text, m.text);
        if (c.model.effects != rows[i].wanted) fail_msg("%s: %x, wanted %x", text, c.model.effects, rows[i].wanted);
        fw_campaign_free(&c);
    }
}

/* 5 % ice is not thin enough for floes to miss each other, 0.1 % is; the densest ice of the law counts. */
static void floes_that_hardly_meet(void **state)
{
    static const struct {
        const char *concentration;
        bool        is_on;
    } rows[] = {{"5 %", true}, {"0.1 %", false}, {"{values: [0.1 %, 5 %]}", true}, {"{uniform: [0.01 %, 0.2 %]}", false}};
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char        text[256];
        fw_campaign c;
        fw_msg      m;
        snprintf(text, sizeof text, "ice: {temperature: -10 degC, concentration: %s}\ncurrent: {speed: 1 m/s}\n", rows[i].concentration);
        if (read_campaign_text(&c, text, &m) != FW_OK) fail_msg("%s", m.text);
        assert_int_equal((c.model.effects & FW_EFFECT_FLOE_CONTACT) != 0, rows[i].is_on);
        fw_campaign_free(&c);
    }
}

/* Every key that an effect acts with changes the settings while it is on. */
static void settings_tell_effects_apart(void **state)
{
    static const char *const shaping[] = {
        "water.skin_drag=0.005",
        "water.added_mass=off",
        "water.deflected_flow=off",
        "wind.speed=10 m/s",
        "wind.angle=40 deg",
        "wind.air_density=1.2 kg/m3",
        "wind.skin_drag=0.003",
        "wind.form_drag=1",
        "current.tide.period=12.5 h",
        "current.tide.minor_ratio=0.3",
        "current.tide.phase=auto",
        "contact.stiffness=2 MN/m",
        "contact.pressure=1 MPa",
        "contact.pressure_exponent=0.3",
        "contact.flat=on",
        "contact.unloading_stiffness=auto",
        "contact.floe_friction=0.2",
        "abrasion.crushing_limit.pressure=5 MPa",
        "abrasion.crushing_limit.exponent=0",
        "effects={wind: off}",
        "effects={tide: off}",
        "effects={crushing_limit: off}",
        "effects={ice_on_ice: off}",
        "effects={skin_drag: off}",
    };
    enum { N = sizeof shaping / sizeof shaping[0] };
    uint64_t    hashes[N + 1];
    fw_campaign c, still;
    (void)state;

    read_good(&c, GOOD "effects.yaml", NULL);
    hashes[0] = c.hash;
    assert_non_null(strstr(c.settings, "contact.law = crush\ncontact.stiffness = from_pressure\n"));
    fw_campaign_free(&c);
    for (size_t i = 0; i < N; i++) {
        read_good(&c, GOOD "effects.yaml", shaping[i]);
        for (size_t k = 0; k <= i; k++)
            if (hashes[k] == c.hash) fail_msg("%s changes nothing", shaping[i]);
        hashes[i + 1] = c.hash;
        fw_campaign_free(&c);
    }
    read_good(&c, GOOD "effects.yaml", "effects_tolerance=5 %");
    assert_true(c.hash == hashes[0]); /* what it drops stands in effects */
    fw_campaign_free(&c);

    /* off: what it would act with is nobody's business; a campaign without it is the campaign that it always was */
    read_good(&still, GOOD "minimal.yaml", NULL);
    assert_null(strstr(still.settings, "wind."));
    assert_null(strstr(still.settings, "tide"));
    assert_null(strstr(still.settings, "skin_drag"));
    assert_null(strstr(still.settings, "pressure"));
    static const char *const idle[] = {"wind.speed=0 m/s", "water.added_mass=off", "contact.law=spring", "contact.floe_friction=0.1"};
    for (size_t i = 0; i < sizeof idle / sizeof idle[0]; i++) {
        read_good(&c, GOOD "minimal.yaml", idle[i]);
        assert_string_equal(c.settings, still.settings);
        fw_campaign_free(&c);
    }
    fw_campaign_free(&still);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_lands),        cmocka_unit_test(nothing_given_nothing_on),
        cmocka_unit_test(course),                 cmocka_unit_test(switches),
        cmocka_unit_test(floes_that_hardly_meet), cmocka_unit_test(settings_tell_effects_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
