/* A campaign file to an fw_campaign. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/after_file.h"
#include "cli/config.h"
#include "cli/distribution_file.h"
#include "cli/drift_file.h"
#include "cli/effects_file.h"
#include "cli/model_file.h"
#include "cli/sampling_file.h"
#include "cli/service_file.h"
#include "cli/settings.h"
#include "cli/site_table.h"
#include "field/sizes.h"
#include "realisation/facts.h"

/* ---- names ------------------------------------------------------------------------------------------------------ */

static bool is_name_byte(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
}

/* The file's own name without folder and ending, letters that no file name should have replaced. */
static void name_from_path(const char *path, char name[64])
{
    const char *slash = strrchr(path, '/'), *start = slash ? slash + 1 : path;
    const char *dot = strrchr(start, '.');
    size_t      n = dot && dot > start ? (size_t)(dot - start) : strlen(start);

    if (n > 63) n = 63;
    for (size_t i = 0; i < n; i++) name[i] = is_name_byte(start[i]) ? start[i] : '_';
    name[n] = '\0';
    if (n == 0 || name[0] == '.') snprintf(name, 64, "campaign");
}

static fw_status read_name(const fw_reader *r, const fw_values *v, const char *file, char name[64])
{
    const fw_node *n = fw_yaml_get(r->root, "name");

    if (!n) {
        name_from_path(file, name);
        return FW_OK;
    }
    for (const char *p = v->name; *p; p++) {
        if (!is_name_byte(*p) || v->name[0] == '.') {
            return fw_yaml_fail(n, r->m, "name = \"%.63s\": it names files, wanted letters, digits, - and _ only",
                                v->name);
        }
    }
    snprintf(name, 64, "%s", v->name);
    return FW_OK;
}

/* ---- structure -------------------------------------------------------------------------------------------------- */

static fw_status read_points(const fw_reader *r, const fw_node *n, double first, fw_points *out)
{
    fw_points_values v = {24, 15};
    bool             all_round = true;

    if (n && n->kind == FW_NODE_MAP) {
        FW_TRY(fw_read_section(r, &fw_table_points, "structure.measuring_points", n, &v, NULL));
        if (!((double)(v.count - 1) * v.spacing < 360)) {
            return fw_yaml_fail(n, r->m, "structure.measuring_points: %d points every %g deg go round more than once",
                                (int)v.count, v.spacing);
        }
        all_round = false;
    } else if (n) {
        const char *text = NULL;
        FW_TRY(fw_read_text(r, n, "structure.measuring_points", &text));
        fw_status status = fw_keys_read(fw_keys_find(&fw_table_points, "count"), r->units, text, &v, r->m);
        if (status != FW_OK) return fw_yaml_blame(n, "structure.measuring_points", status, r->m);
    }
    out->n = (size_t)v.count;
    FW_TRY(fw_alloc(&out->bearing, out->n, sizeof *out->bearing, "measuring points", r->m));
    for (size_t i = 0; i < out->n; i++) {
        double turn = all_round ? 360.0 * (double)i / (double)out->n : v.spacing * (double)i;
        double b = fmod(first + turn, 360);
        b = b < 0 ? b + 360 : b;
        out->bearing[i] = b >= 360 ? 0 : b;
    }
    return FW_OK;
}

/* ---- ice and current: laws and their ranges --------------------------------------------------------------------- */

static fw_status read_concentration(const fw_reader *r, const fw_node *n, fw_distribution *out)
{
    FW_TRY(fw_read_distribution(r, n, "ice.concentration", "1", out));
    double low = fw_distribution_min(out), high = fw_distribution_max(out);
    if (!(low >= 0) || (low == 0 && fw_distribution_cdf(out, 0) > 0)) {
        return fw_yaml_fail(n, r->m, "ice.concentration reaches down to %g %%, wanted more than 0 %%", 100 * low);
    }
    if (!(high <= FW_MAX_CONCENTRATION)) {
        return fw_yaml_fail(
            n, r->m, "ice.concentration reaches up to %g %%, wanted at most %g %%: whole floes pack no denser%s",
            100 * high, 100 * FW_MAX_CONCENTRATION, isinf(high) ? " (give max)" : "");
    }
    return FW_OK;
}

static fw_status read_temperature(const fw_reader *r, const fw_node *n, double floor, fw_distribution *out)
{
    FW_TRY(fw_read_distribution(r, n, "ice.temperature", "degC", out));
    double high = fw_distribution_max(out), low = fw_distribution_min(out);
    if (!(high <= 0)) {
        return fw_yaml_fail(n, r->m, "ice.temperature reaches up to %g degC, wanted at most 0 degC%s", high,
                            isinf(high) ? " (give max)" : "");
    }
    if (!(high <= -floor)) {
        return fw_yaml_fail(
            n, r->m,
            "ice.temperature reaches up to %g degC, inside ice.temperature_floor = %g K: wanted at most %g degC, "
            "because the abrasion law is singular at 0 degC",
            high, floor, -floor);
    }
    if (isfinite(low) && low < -100)
        return fw_yaml_fail(n, r->m, "ice.temperature reaches down to %g degC, wanted at least -100", low);
    return FW_OK;
}

static fw_status check_slow(const fw_node *n, double share, fw_msg *m)
{
    if (share <= 0.1) return FW_OK;
    return fw_yaml_fail(n, m, "current.speed is below %g m/s for %.3g %% of the time, wanted for at most 10 %%: a current that slow is simulated as %g m/s",
                        FW_SLOWEST, 100 * share, FW_SLOWEST);
}

static fw_status read_speed(const fw_reader *r, const fw_node *n, fw_distribution *out)
{
    FW_TRY(fw_read_distribution(r, n, "current.speed", "m/s", out));
    double low = fw_distribution_min(out), high = fw_distribution_max(out);
    if (!(low >= 0) || (low == 0 && fw_distribution_cdf(out, 0) > 0)) {
        return fw_yaml_fail(n, r->m, "current.speed reaches down to %g m/s, wanted more than 0 m/s", low);
    }
    if (isfinite(high) && high > 20)
        return fw_yaml_fail(n, r->m, "current.speed reaches up to %g m/s, wanted at most 20 m/s", high);
    return check_slow(n, fw_distribution_cdf_left(out, FW_SLOWEST), r->m);
}

static fw_status read_floe_diameter(const fw_reader *r, const fw_node *n, fw_values *v, fw_model *model)
{
    FW_TRY(fw_read_section(r, &fw_table_floe_diameter, "ice.floe_diameter", n, v, NULL));
    model->size_law = (fw_size_law)v->floe_distribution;
    model->size_a = model->size_law == FW_SIZE_POWER_LAW   ? v->floe_exponent
                    : model->size_law == FW_SIZE_LOGNORMAL ? log(v->floe_median)
                                                           : 0;
    model->size_b = model->size_law == FW_SIZE_LOGNORMAL ? v->floe_sigma : 0;
    return FW_OK;
}

/* The sizes that a mix and the law of diameters give together. */
static fw_status check_sizes(const fw_reader *r, const fw_node *at, const fw_model *model)
{
    for (size_t i = 0; i < model->n_mixes; i++) {
        fw_sizes  sizes;
        fw_status status = fw_sizes_init(&sizes, &model->mixes[i], model->size_law, model->size_a, model->size_b, r->m);
        if (status != FW_OK) return fw_yaml_blame(at, "ice.floe_diameter", FW_E_INPUT, r->m);
    }
    return FW_OK;
}

static fw_status refuse_beside_joint(const fw_reader *r, const fw_node *n, const char *path)
{
    return n ? fw_yaml_fail(n, r->m, "%s: the joint table of current.joint says this already, wanted one of them", path)
             : FW_OK;
}

static fw_status read_site(const fw_reader *r, const fw_node *ice, const fw_node *current, fw_campaign *c)
{
    const fw_node *joint = fw_yaml_get(current, "joint"), *speed = fw_yaml_get(current, "speed");
    const fw_node *direction = fw_yaml_get(current, "direction"), *concentration = fw_yaml_get(ice, "concentration");
    bool           has_thickness;

    if (joint) {
        FW_TRY(refuse_beside_joint(r, speed, "current.speed"));
        FW_TRY(refuse_beside_joint(r, direction, "current.direction"));
        FW_TRY(refuse_beside_joint(r, concentration, "ice.concentration"));
        FW_TRY(fw_site_table_read(r, joint, "current.joint", &c->site, &c->model, &has_thickness));
        double slow = 0;
        for (size_t i = 0; i < c->site.n_cells; i++) slow += c->site.cells[i].speed < FW_SLOWEST ? c->site.cells[i].probability : 0;
        FW_TRY(check_slow(joint, slow, r->m));
        return has_thickness ? refuse_beside_joint(r, fw_yaml_get(ice, "thickness_mixes"), "ice.thickness_mixes")
                             : FW_OK;
    }
    if (!speed) return fw_yaml_fail(current, r->m, "current.speed is missing: a distribution in m/s, or current.joint");
    if (!concentration)
        return fw_yaml_fail(ice, r->m, "ice.concentration is missing: a distribution, or current.joint");
    FW_TRY(read_speed(r, speed, &c->site.speed));
    FW_TRY(read_concentration(r, concentration, &c->site.concentration));
    if (direction) return fw_read_distribution(r, direction, "current.direction", "deg", &c->site.direction);
    fw_distribution_constant(&c->site.direction, 0); /* the default that the key table documents */
    return FW_OK;
}


/* ---- numerics --------------------------------------------------------------------------------------------------- */

/* What is auto stays 0: chosen by the accuracy. */
static fw_status read_numerics(const fw_reader *r, fw_values *v, fw_model *model)
{
    const fw_node *map = fw_yaml_get(r->root, "numerics");

    FW_TRY(fw_read_section(r, &fw_table_numerics, "numerics", map, v, NULL));
    if (v->order >= 0 && v->order != floor(v->order)) {
        return fw_yaml_fail(fw_yaml_get(map, "order"), r->m, "numerics.order = %g: wanted 2, 3 or 4", v->order);
    }
    model->numerics.order = v->order >= 0 ? (int)v->order : 0;
    model->numerics.tolerance = fmax(0, v->tolerance);
    model->numerics.wear_tolerance = fmax(0, v->wear_tolerance);
    model->numerics.first_step = fmax(0, v->first_step);
    model->numerics.growth = fmax(0, v->growth);
    return FW_OK;
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static fw_status settle_effects(const fw_reader *r, fw_campaign *c)
{
    fw_scene_facts facts;

    FW_TRY(fw_facts_campaign(&c->model, &c->site, &facts, r->m));
    return fw_file_read_effects(r, &facts, &c->model);
}

static fw_status read_campaign(const fw_reader *r, const char *file, int64_t seed, fw_campaign *c)
{
    const fw_node *structure = fw_yaml_get(r->root, "structure"), *ice = fw_yaml_get(r->root, "ice");
    const fw_node *current = fw_yaml_get(r->root, "current"), *temperature;
    const fw_node *floe_diameter = fw_yaml_get(ice, "floe_diameter");
    fw_values      v;

    memset(&v, 0, sizeof v);
    fw_model_defaults(&c->model);
    FW_TRY(fw_read_section(r, &fw_table_campaign, "", r->root, &v, NULL));
    if (seed >= 0) v.seed = (uint64_t)seed;
    c->seed = v.seed;
    FW_TRY(read_name(r, &v, file, c->name));
    FW_TRY(fw_read_section(r, &fw_table_structure, "structure", structure, &v, NULL));
    FW_TRY(read_points(r, fw_yaml_get(structure, "measuring_points"), v.first_bearing, &c->points));
    FW_TRY(fw_read_section(r, &fw_table_ice, "ice", ice, &v, NULL));
    FW_TRY(fw_file_read_mixes(r, fw_yaml_get(ice, "thickness_mixes"), &c->model));
    FW_TRY(read_floe_diameter(r, floe_diameter, &v, &c->model));
    FW_TRY(fw_read_section(r, &fw_table_current, "current", current, &v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_exposure, "exposure", fw_yaml_get(r->root, "exposure"), &v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_field, "field", fw_yaml_get(r->root, "field"), &v, NULL));
    FW_TRY(fw_file_read_model(r, &v, &c->model));
    FW_TRY(read_numerics(r, &v, &c->model));
    c->model.window = v.window;
    c->model.warm_up = v.warm_up;
    c->model.max_evaluations = v.max_evaluations;
    c->model.strip_width = v.strip_width;
    c->model.downstream = v.downstream;
    c->site.temperature_floor = v.temperature_floor;
    temperature = fw_yaml_get(ice, "temperature");
    FW_TRY(read_temperature(r, temperature, v.temperature_floor, &c->site.temperature));
    FW_TRY(read_site(r, ice, current, c));
    FW_TRY(fw_file_read_drift(r, &v, &c->model, &c->site));
    c->model.effects_tolerance = v.effects_tolerance;
    FW_TRY(check_sizes(r, floe_diameter ? floe_diameter : ice, &c->model));
    FW_TRY(settle_effects(r, c));
    FW_TRY(fw_file_read_sampling(r, &v, &c->model, &c->site, &c->sampling));
    FW_TRY(fw_file_read_precision(r, &v, c->points.n, &c->precision));
    FW_TRY(fw_file_read_service(r, &v, c->model.window, &c->service));
    FW_TRY(fw_file_read_after(r, &c->model, &c->after));
    fw_status status = fw_model_check(&c->model, r->m);
    if (status != FW_OK) {
        fw_msg_prefix(r->m, "%.200s: ", file);
        return status == FW_E_ARG ? FW_E_INPUT : status;
    }
    return fw_settings_make(c, &v, r->m);
}

/* Kept with the text, so that both together give the campaign again. */
static fw_status keep_sets(fw_campaign *c, size_t n_sets, const char *const *sets, fw_msg *m)
{
    FW_TRY(fw_alloc(&c->sets, n_sets, sizeof *c->sets, "--set", m));
    for (; c->n_sets < n_sets; c->n_sets++) {
        c->sets[c->n_sets] = fw_strdup(sets[c->n_sets]);
        FW_CHECK(c->sets[c->n_sets], m, FW_E_NOMEM, "out of memory: --set");
    }
    return FW_OK;
}

fw_status fw_config_campaign_text(fw_campaign *out, const char *name, const char *text, size_t n_bytes, size_t n_sets,
                                  const char *const *sets, int64_t seed, fw_msg *m)
{
    char      directory[512];
    fw_yaml   yaml = {0};
    fw_units *units = NULL;

    memset(out, 0, sizeof *out);
    fw_reader_directory(name, directory, sizeof directory);
    fw_status status = fw_units_open(&units, m);
    if (status == FW_OK) status = fw_yaml_parse(&yaml, name, text, n_bytes, m);
    for (size_t i = 0; i < n_sets && status == FW_OK; i++) status = fw_yaml_set(&yaml, sets[i], m);
    if (status == FW_OK) {
        const fw_reader r = {units, yaml.root, directory, m};
        status = fw_alloc(&out->text, n_bytes + 1, 1, "campaign text", m);
        if (status == FW_OK) {
            memcpy(out->text, text, n_bytes);
            status = keep_sets(out, n_sets, sets, m);
            if (status == FW_OK) status = read_campaign(&r, name, seed, out);
        }
    }
    fw_yaml_free(&yaml);
    fw_units_close(units);
    if (status != FW_OK) fw_campaign_free(out);
    return status;
}

fw_status fw_config_campaign(fw_campaign *out, const char *path, size_t n_sets, const char *const *sets, int64_t seed,
                             fw_msg *m)
{
    char  *text;
    size_t n;

    memset(out, 0, sizeof *out);
    FW_TRY(fw_yaml_load_file(path, FW_YAML_MAX_BYTES, &text, &n, m));
    fw_status status = fw_config_campaign_text(out, path, text, n, n_sets, sets, seed, m);
    free(text);
    return status;
}
