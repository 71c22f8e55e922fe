/* Campaign files: every key of the manual's sketch ends where the engine reads it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "cli/config_check.h"

static void read_good(fw_campaign *c, const char *path, size_t n_sets, const char *const *sets, int64_t seed)
{
    fw_msg m = {""};

    if (fw_config_campaign(c, path, n_sets, sets, seed, &m) != FW_OK) fail_msg("%s", m.text);
}

static void set_one(fw_campaign *c, const char *set) { read_good(c, GOOD "sketch.yaml", set ? 1 : 0, &set, -1); }

static void sketch(void **state)
{
    fw_campaign c;
    (void)state;

    read_good(&c, GOOD "sketch.yaml", 0, NULL, -1);
    const fw_model *m = &c.model;
    assert_string_equal(c.name, "raahe");
    assert_true(c.seed == 20260101);
    assert_true(m->structure_radius == 3.7 && m->ice_density == 900 && m->water_density == 1025 && m->form_drag == 10);
    assert_true(m->stiffness == 2e6 && m->damping_ratio == 1 && m->friction == 0.1 && m->slip_damping_ratio == 1);
    assert_int_equal(m->effects, FW_EFFECTS_CORE);
    assert_int_equal(m->n_laws, 1);
    assert_string_equal(m->laws[0].name, "bekker2011");
    assert_true(m->laws[0].coefficient == 0.116 && m->laws[0].exponent == 1.121 && m->laws[0].uses_temperature);
    assert_true(m->window == 10800 && m->warm_up < 0 && m->accuracy == 0.01 && m->n_arcs == 360);
    assert_true(m->strip_width <= 0 && m->downstream <= 0);
    assert_int_equal(m->size_law, FW_SIZE_UNIFORM);

    assert_int_equal(m->n_mixes, 2);
    assert_true(m->mixes[0].probability == 0.6 && m->mixes[1].probability == 0.4 && !m->mixes[0].by_area);
    assert_int_equal(m->mixes[0].n_classes, 5);
    for (size_t i = 0; i < 5; i++) {
        assert_true(m->mixes[0].classes[i].share == 0.2 &&
                    fabs(m->mixes[0].classes[i].thickness - 0.5 - 0.2 * (double)i) < 1e-15);
    }
    assert_true(m->mixes[1].classes[0].thickness == 0.3 && fabs(m->mixes[1].classes[0].share - 2.0 / 3) < 1e-15);

    const fw_site *s = &c.site;
    assert_int_equal(s->temperature.kind, FW_DIST_UNIFORM);
    assert_true(s->temperature.a == -12 && s->temperature.b == -2 && s->temperature_floor == 1.8);
    assert_int_equal(s->concentration.n, 3);
    assert_true(s->concentration.values[0] == 0.2 && s->concentration.weights[1] == 0.5);
    assert_int_equal(s->speed.kind, FW_DIST_WEIBULL);
    assert_true(s->speed.a == 0.4 && s->speed.b == 1.6 && s->speed.high == 2);
    assert_int_equal(s->direction.n, 4);
    assert_true(s->direction.values[3] == 270 && s->direction.weights[3] == 0.5);
    assert_int_equal(s->n_cells, 0);

    assert_int_equal(c.points.n, 24);
    for (size_t i = 0; i < 24; i++) assert_true(c.points.bearing[i] == 15.0 * (double)i);
    assert_int_equal(c.precision.quantity, FW_QUANTITY_PERCENTILE);
    assert_true(c.precision.percentile == 90 && c.precision.half_width == 0.1 && c.precision.confidence == 0.95);
    assert_true(c.precision.max_realisations == 4000 && c.precision.max_failed == 40 && c.precision.budget_s == 0);
    assert_true(c.service.is_asked && c.service.life_years == 50 && c.service.ice_hours_per_year == 1200);
    assert_true(c.service.year_to_year_cv == 0.3 && c.service.persistence == 0.9 && c.service.allowance == 20);
    assert_int_equal(c.n_not_applied, 0);
    assert_memory_equal(c.text, "# every key of the manual's sketch\n", 35);
    assert_true(c.hash == fw_fnv1a64(c.settings, strlen(c.settings)));
    fw_campaign_free(&c);
}

/* What a short file leaves out is the engine's own default model, and the defaults that the key tables document. */
static void minimal(void **state)
{
    fw_campaign c;
    fw_model    defaults;
    (void)state;

    read_good(&c, GOOD "minimal.yaml", 0, NULL, -1);
    fw_model_defaults(&defaults);
    assert_memory_equal(c.model.mixes, defaults.mixes, sizeof defaults.mixes);
    assert_memory_equal(c.model.laws, defaults.laws, sizeof defaults.laws);
    assert_true(c.model.structure_radius == defaults.structure_radius && c.model.stiffness == defaults.stiffness);
    assert_true(c.model.friction == defaults.friction && c.model.form_drag == defaults.form_drag);
    assert_true(c.model.window == defaults.window && c.model.accuracy == defaults.accuracy);
    assert_true(c.model.effects == defaults.effects && c.model.n_arcs == defaults.n_arcs);
    assert_true(c.model.ice_density == defaults.ice_density && c.model.water_density == defaults.water_density);
    assert_true(c.model.damping_ratio == defaults.damping_ratio &&
                c.model.slip_damping_ratio == defaults.slip_damping_ratio);
    assert_true(c.model.size_law == defaults.size_law && c.model.warm_up < 0 && defaults.warm_up < 0);
    assert_string_equal(c.name, "minimal"); /* of the file */
    assert_true(c.site.speed.kind == FW_DIST_CONSTANT && c.site.speed.a == 2);
    assert_true(c.site.direction.kind == FW_DIST_CONSTANT && c.site.direction.a == 0);
    assert_true(c.site.temperature.a == -10 && c.site.concentration.a == 0.4);
    assert_true(!c.service.is_asked && c.precision.half_width == 0 && c.precision.max_realisations == 1000);
    assert_true(c.precision.max_failed == 10 && c.seed == 1 && c.n_not_applied == 0);
    fw_campaign_free(&c);
}

/* Water level and scatter are read, and are no part of what names the campaign's records. */
static void after_the_run(void **state)
{
    fw_campaign c, plain;
    (void)state;

    read_good(&c, GOOD "after.yaml", 0, NULL, -1);
    read_good(&plain, GOOD "minimal.yaml", 0, NULL, -1);
    assert_true(!plain.after.has_water_level && !plain.after.has_law_scatter);
    const fw_distribution *level = &c.after.water_level, *scatter = &c.after.law_scatter;
    assert_true(c.after.has_water_level && level->kind == FW_DIST_NORMAL && level->a == 0.1 && level->b == 0.4);
    assert_true(c.after.has_law_scatter && scatter->kind == FW_DIST_WEIBULL);
    assert_true(scatter->a == 1 && scatter->b == 1.5 && scatter->c == 0.2);
    assert_true(c.hash == plain.hash);
    fw_campaign_free(&c);
    fw_campaign_free(&plain);
}

/* A table of whole years beside the file, in its own units, and how well the first law is known. */
static void years_and_laws(void **state)
{
    fw_campaign c, plain;
    (void)state;

    read_good(&c, GOOD "years.yaml", 0, NULL, -1);
    const double hours[] = {960, 1500, 0, 1320}, factors[] = {1, 1.1, 1, 0.8};
    assert_int_equal(c.service.n_table, 4);
    for (size_t i = 0; i < 4; i++) assert_true(fabs(c.service.table[i].ice_hours - hours[i]) < 1e-9 && c.service.table[i].factor == factors[i]);
    assert_true(fabs(c.service.ice_hours_per_year - 945) < 1e-9 && c.service.year_to_year_cv == 0 && c.service.persistence == 0.9);
    assert_true(c.after.has_law_coefficient && c.after.law_coefficient.kind == FW_DIST_LOGNORMAL);
    assert_true(c.after.has_law_exponent && c.after.law_exponent.a == 1.121 && c.after.law_exponent.high == 1.3);
    const char *const other[] = {"service.years=winters.csv", "service.life=10 year", "abrasion.uncertainty={coefficient: 2}"};
    read_good(&plain, GOOD "years.yaml", 3, other, -1);
    assert_true(plain.hash == c.hash && !plain.after.has_law_exponent); /* they act after the run */
    fw_campaign_free(&c);
    fw_campaign_free(&plain);
}

/* The campaigns that come with the program. */
static void ready_campaigns(void **state)
{
    static const char *const names[] = {"raahe", "paper-60s", "ci"};
    (void)state;

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char        path[512];
        fw_campaign c;
        snprintf(path, sizeof path, "%s/campaigns/%s.yaml", FW_SOURCE_DIR, names[i]);
        read_good(&c, path, 0, NULL, -1);
        assert_string_equal(c.name, names[i]);
        fw_campaign_free(&c);
    }
}

static void measuring_points(void **state)
{
    fw_campaign c;
    fw_msg      m;
    (void)state;

    assert_int_equal(
        read_campaign_text(&c,
                           "structure: {measuring_points: {count: 11, spacing: 15 deg}, first_bearing: -75 deg}\n"
                           "ice: {temperature: -10 degC, concentration: 40 %}\ncurrent: {speed: 2 m/s}\n",
                           &m),
        FW_OK);
    static const double bearings[11] = {285, 300, 315, 330, 345, 0, 15, 30, 45, 60, 75};
    assert_int_equal(c.points.n, 11);
    assert_memory_equal(c.points.bearing, bearings, sizeof bearings);
    fw_campaign_free(&c);
}

static void choices(void **state)
{
    fw_campaign c;
    (void)state;

    set_one(&c, "precision.quantity=mean");
    assert_int_equal(c.precision.quantity, FW_QUANTITY_MEAN);
    fw_campaign_free(&c);
    set_one(&c, "precision.quantity=P99.5");
    assert_true(c.precision.percentile == 99.5);
    fw_campaign_free(&c);
    set_one(&c, "precision.max_realisations=50");
    assert_true(c.precision.max_failed == 1);
    fw_campaign_free(&c);
    set_one(&c, "effects=[friction, form_drag]");
    assert_int_equal(c.model.effects, FW_EFFECT_FRICTION | FW_EFFECT_FORM_DRAG);
    fw_campaign_free(&c);
    set_one(&c, "effects={rotation: off, wind: off}");
    assert_int_equal(c.model.effects, FW_EFFECTS_CORE & ~(uint32_t)FW_EFFECT_ROTATION);
    fw_campaign_free(&c);
    set_one(&c, "abrasion.laws=[bekker2011, {archard: {coefficient: 0.02 mm/km}}, "
                "{power: {coefficient: 0.3 mm/km, exponent: 1.5, uses_temperature: on}}]");
    assert_int_equal(c.model.n_laws, 3);
    assert_true(c.model.laws[1].exponent == 1 && c.model.laws[1].coefficient == 0.02 &&
                !c.model.laws[1].uses_temperature);
    assert_true(c.model.laws[2].exponent == 1.5 && c.model.laws[2].coefficient == 0.3 &&
                c.model.laws[2].uses_temperature);
    fw_campaign_free(&c);
    set_one(&c, "ice.floe_diameter={distribution: power-law, exponent: 1.8}");
    assert_true(c.model.size_law == FW_SIZE_POWER_LAW && c.model.size_a == 1.8);
    fw_campaign_free(&c);
    set_one(&c, "ice.floe_diameter={distribution: lognormal, median: 500 cm, sigma: 0.4}");
    assert_true(c.model.size_law == FW_SIZE_LOGNORMAL && c.model.size_a == log(5) && c.model.size_b == 0.4);
    fw_campaign_free(&c);
    set_one(&c, "ice.thickness_mixes=[{probability: 1, by: area, classes: {1.3 m: 40 %, 50 cm: 60 %, 1 m: 0}}]");
    assert_true(c.model.mixes[0].by_area && c.model.mixes[0].n_classes == 2);
    assert_true(c.model.mixes[0].classes[0].thickness == 0.5 && c.model.mixes[0].classes[0].share == 0.6);
    fw_campaign_free(&c);
    set_one(&c, "field={strip_width: 60 m, downstream: 15 m}");
    assert_true(c.model.strip_width == 60 && c.model.downstream == 15);
    fw_campaign_free(&c);
    set_one(&c, "exposure.warm_up=0s");
    assert_true(c.model.warm_up == 0);
    fw_campaign_free(&c);
    set_one(&c, "ring.arcs=720");
    assert_int_equal(c.model.n_arcs, 720);
    fw_campaign_free(&c);
}

static void sets_and_seed(void **state)
{
    static const char *const sets[] = {"ice.concentration=60%", "exposure.window=90 min", "ice.concentration=50 %"};
    fw_campaign              c;
    fw_msg                   m;
    (void)state;

    read_good(&c, GOOD "sketch.yaml", 3, sets, 7);
    assert_true(c.site.concentration.kind == FW_DIST_CONSTANT && c.site.concentration.a == 0.5);
    assert_true(c.model.window == 5400 && c.seed == 7);
    assert_non_null(strstr(c.settings, "seed = 7\n"));
    fw_campaign_free(&c);

    static const char *const bad[][2] = {
        {"ice.concentraton=60%",
         "--set ice.concentraton=60%: unknown key \"concentraton\" in ice, did you mean \"concentration\"?"},
        {"ice.concentration=60 m", "--set ice.concentration=60 m: ice.concentration: \"60 m\": wrong unit"},
        {"ice.concentration", "wanted dotted.path=value"},
        {"=60%", "wanted dotted.path=value"},
        {"ice..concentration=60%", "wanted dotted.path=value"},
        {"ice.=60%", "wanted dotted.path=value"},
        {".ice=60%", "wanted dotted.path=value"},
        {"ice.density.more=1", "\"density\" has no keys below it"},
        {"ice.concentration=", "--set ice.concentration=: there is no value behind ="},
        {"ice.concentration= \n", "there is no value behind ="},
        {"ice.concentration=[", "--set ice.concentration=["},
        {"exposure.window=1\n2", "exposure.window"},
        {"a.b.c.d=1", "unknown key \"a\""},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        memset(&m, 0, sizeof m);
        if (fw_config_campaign(&c, GOOD "sketch.yaml", 1, &bad[i][0], -1, &m) != FW_E_INPUT ||
            !strstr(m.text, bad[i][1])) {
            fail_msg("%s: %s", bad[i][0], m.text);
        }
    }
}

/* The settings name what shapes a record: those keys change them, the others do not. */
static void settings_tell_records_apart(void **state)
{
    static const char *const shaping[] = {
        "seed=2",
        "accuracy=2 %",
        "structure.diameter=7.5 m",
        "ice.density=910 kg/m3",
        "ice.concentration=40 %",
        "current.speed=1 m/s",
        "contact.stiffness=1 MN/m",
        "contact.friction=0.2",
        "contact.damping_ratio=0.9",
        "contact.slip_damping_ratio=0.9",
        "water.density=1000 kg/m3",
        "water.form_drag=1",
        "effects=[friction]",
        "abrasion.laws=[archard]",
        "abrasion.laws=[bekker2011, archard]",
        "exposure.window=2 h",
        "exposure.warm_up=0 s",
        "field.strip_width=80 m",
        "field.downstream=30 m",
        "ring.arcs=180",
        "ice.floe_diameter.distribution=power-law",
        "ice.thickness_mixes=[{probability: 1, classes: {0.5 m: 1}}]",
        "ice.thickness_mixes=[{probability: 1, by: area, classes: {0.5 m: 1}}]",
        "current.speed={weibull: {scale: 0.4 m/s, shape: 1.6, max: 2.1 m/s}}",
        "ice.concentration={values: [20 %, 40 %, 60 %], probabilities: [0.2, 0.6, 0.2]}",
    };
    static const char *const not_shaping[] = {
        "name=other",
        "structure.measuring_points=12",
        "structure.first_bearing=5 deg",
        "ice.temperature=-10 degC",
        "ice.temperature_floor=1 K",
        "current.direction=90 deg",
        "precision.half_width=5 %",
        "precision.max_realisations=9000",
        "precision.quantity=mean",
        "precision.confidence=90 %",
        "precision.max_failed=3",
        "service.life=60 year",
        "abrasion.laws=[{power: {coefficient: 0.2 mm/km, exponent: 1.121}}]",
        "seed=20260101",
        "exposure.window=180 min",
        "contact.stiffness=2 MN/m",
        "ice.floe_diameter.sigma=0.1",
    };
    enum { N_SHAPING = sizeof shaping / sizeof shaping[0], N_NOT = sizeof not_shaping / sizeof not_shaping[0] };
    fw_campaign base, c;
    uint64_t    hashes[N_SHAPING + 1];
    (void)state;

    set_one(&base, NULL);
    hashes[0] = base.hash;
    for (size_t i = 0; i < N_SHAPING; i++) {
        set_one(&c, shaping[i]);
        for (size_t k = 0; k <= i; k++) {
            if (hashes[k] == c.hash) fail_msg("%s changes nothing", shaping[i]);
        }
        hashes[i + 1] = c.hash;
        fw_campaign_free(&c);
    }
    for (size_t i = 0; i < N_NOT; i++) {
        set_one(&c, not_shaping[i]);
        if (c.hash != base.hash) fail_msg("%s changes the settings to\n%s", not_shaping[i], c.settings);
        assert_string_equal(c.settings, base.settings);
        fw_campaign_free(&c);
    }
    /* one line each, "key = value" */
    for (const char *line = base.settings; *line; line = strchr(line, '\n') + 1) {
        assert_non_null(strchr(line, '\n'));
        assert_true(strcspn(line, "=") < strcspn(line, "\n"));
    }
    assert_non_null(strstr(base.settings, "contact.stiffness = 2000000 N/m\n"));
    assert_non_null(strstr(base.settings, "exposure.window = 10800 s\n"));
    assert_non_null(strstr(base.settings, "effects = floe_contact friction rotation form_drag\n"));
    fw_campaign_free(&base);
}

static void durations(void **state)
{
    double s = 0;
    fw_msg m;
    (void)state;

    assert_int_equal(fw_config_duration("2h", &s, &m), FW_OK);
    assert_true(s == 7200);
    assert_int_equal(fw_config_duration("90 min", &s, &m), FW_OK);
    assert_true(s == 5400);
    assert_int_equal(fw_config_duration("2", &s, &m), FW_E_INPUT);
    assert_int_equal(fw_config_duration("-2h", &s, &m), FW_E_INPUT);
    assert_int_equal(fw_config_duration("0 s", &s, &m), FW_E_INPUT);
    assert_int_equal(fw_config_duration("soon", &s, &m), FW_E_INPUT);
    assert_true(s == 5400);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sketch),
        cmocka_unit_test(after_the_run), cmocka_unit_test(years_and_laws), cmocka_unit_test(minimal),
        cmocka_unit_test(ready_campaigns),
        cmocka_unit_test(measuring_points),
        cmocka_unit_test(choices),
        cmocka_unit_test(sets_and_seed),
        cmocka_unit_test(settings_tell_records_apart),
        cmocka_unit_test(durations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
