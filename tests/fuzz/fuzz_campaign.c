/* Campaign files, their --set and their tables: whatever the bytes, a refusal that says why, or a campaign that can be
 * run, printed, stored and read again. */
#include <math.h>

#include "base/hash.h"
#include "cli/config.h"
#include "fuzz/config_input.h"
#include "fuzz/fuzz.h"
#include "realisation/facts.h"

static const char *const files[] = {"table.csv", NULL};

/* The settings are compared line by line, key by key (store/journal_match.c). */
static void check_settings(const fw_campaign *c)
{
    FUZZ_LAW(c->settings != NULL && c->hash == fw_fnv1a64(c->settings, strlen(c->settings)), "%016llx",
             (unsigned long long)c->hash);
    FUZZ_LAW(strlen(c->settings) < 65536, "%zu bytes; a journal takes no more than a MiB", strlen(c->settings));
    for (const char *line = c->settings; *line != '\0';) {
        const char *end = strchr(line, '\n'), *equals = strstr(line, " =");
        FUZZ_LAW(end != NULL && equals != NULL && equals < end, "%.100s", line);
        line = end + 1;
    }
}

/* What a results file keeps (text and sets) gives the same campaign again. */
static void check_again(const fw_campaign *c, const fuzz_config *in, const char *name)
{
    fw_campaign again;
    fw_msg      m = {""};

    FUZZ_LAW(strlen(c->text) == in->n_text && memcmp(c->text, in->text, in->n_text) == 0, "another text was kept");
    FUZZ_LAW(c->n_sets == in->n_sets && c->seed <= INT64_MAX, "%zu sets, seed %llu", c->n_sets,
             (unsigned long long)c->seed);
    fw_status status = fw_config_campaign_text(&again, name, c->text, strlen(c->text), c->n_sets,
                                               (const char *const *)c->sets, (int64_t)c->seed, &m);
    FUZZ_LAW(status == FW_OK, "read again: %s", m.text);
    FUZZ_LAW(again.hash == c->hash && again.seed == c->seed && strcmp(again.settings, c->settings) == 0,
             "first\n%s\nthen\n%s", c->settings, again.settings);
    fw_campaign_free(&again);
}

static void check_points(const fw_campaign *c)
{
    FUZZ_LAW(c->points.n >= 1, "no measuring points");
    for (size_t i = 0; i < c->points.n; i++) {
        double b = c->points.bearing[i];
        FUZZ_LAW(b >= 0 && b < 360, "bearing %g", b);
    }
}

/* Every realisation has ice that can be packed and a current. */
static void check_scenarios(const fw_campaign *c)
{
    for (uint64_t id = 0; id < 8; id++) {
        fw_scenario s;
        fw_campaign_scenario(c, id, &s);
        FUZZ_LAW(s.concentration >= 0 && s.concentration <= FW_MAX_CONCENTRATION, "concentration %g", s.concentration);
        FUZZ_LAW(s.speed >= 0 && isfinite(s.speed), "speed %g", s.speed);
        FUZZ_LAW(s.mix < c->model.n_mixes && (c->site.n_cells == 0 || s.cell < c->site.n_cells), "mix %u cell %u",
                 s.mix, s.cell);
        FUZZ_LAW(s.wind_speed >= 0 && isfinite(s.wind_speed) && isfinite(s.wind_angle) && isfinite(s.tide_phase), "wind %g m/s at %g, phase %g",
                 s.wind_speed, s.wind_angle, s.tide_phase);
        FUZZ_LAW(fw_distribution_check(fw_site_direction(&c->site, &s), NULL) == FW_OK, "directions of cell %u",
                 s.cell);
        FUZZ_LAW(s.weight > 0 && isfinite(s.weight) && s.randomisation >= -1, "weight %g of randomisation %d", s.weight, (int)s.randomisation);
        FUZZ_LAW(fw_campaign_stratum(c, &s) < fw_campaign_n_strata(c), "a stratum that is none of %zu", fw_campaign_n_strata(c));
    }
}

static void check_accepted(const fw_campaign *c, const fuzz_config *in, const char *name)
{
    fw_msg m = {""};
    FUZZ_LAW(fw_model_check(&c->model, &m) == FW_OK, "%s", m.text);
    FUZZ_LAW(c->name[0] != '\0' && memchr(c->name, 0, sizeof c->name) != NULL && strchr(c->name, '/') == NULL,
             "name %.64s", c->name);
    fw_scene_facts facts;
    FUZZ_LAW(fw_facts_campaign(&c->model, &c->site, &facts, &m) == FW_OK, "%s", m.text);
    fuzz_check_effects(&c->model, &facts);
    check_settings(c);
    check_points(c);
    check_scenarios(c);
    check_again(c, in, name);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_config in;
    fw_campaign c;
    fw_msg      m = {""};
    char        name[FUZZ_PATH];

    fuzz_enter_folder(files);
    fuzz_path(name, "made.yaml"); /* no such file: its folder is where the table lies */
    fuzz_config_take(&in, data, size);
    fuzz_save_table(&in);

    double    started = fw_cpu_seconds();
    fw_status status = fw_config_campaign_text(&c, name, in.text, in.n_text, in.n_sets, in.set_list, -1, &m);
    if (status == FW_OK) {
        check_accepted(&c, &in, name);
        fw_campaign_free(&c);
    } else {
        fuzz_check_config_refusal(&in, status, &m, "made.yaml", started);
    }
    fuzz_config_free(&in);
    return 0;
}
