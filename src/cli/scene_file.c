/* A scene file to an fw_scene; and the odd quantity of the command line. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/after_file.h"
#include "cli/config.h"
#include "cli/drift_file.h"
#include "cli/effects_file.h"
#include "cli/model_file.h"
#include "physics/unbreakable.h"
#include "realisation/facts.h"

/* Floes may touch; what rounding of written decimals makes of a touch is no overlap. */
#define OVERLAP_ALLOWED 1e-9 /* [m] */

static fw_status read_floe(const fw_reader *r, const fw_node *n, size_t number, fw_floe *floe)
{
    char path[48], full[80];

    snprintf(path, sizeof path, "floes[%zu]", number);
    FW_TRY(fw_read_section(r, &fw_table_scene_floe, path, n, floe, NULL));
    snprintf(full, sizeof full, "%s.thickness", path);
    FW_TRY(fw_file_check_thickness(fw_yaml_get(n, "thickness"), full, floe->thickness, r->m));
    double limit = fw_unbreakable_max_diameter(floe->thickness);
    if (!(floe->diameter <= limit + OVERLAP_ALLOWED)) {
        return fw_yaml_fail(
            fw_yaml_get(n, "diameter"), r->m,
            "%s.diameter = %g m: above sqrt(130h - 11) = %.6g m, the largest floe of thickness class h = %g m that "
            "does not break",
            path, floe->diameter, limit, floe->thickness);
    }
    return FW_OK;
}

static fw_status check_distances(const fw_reader *r, const fw_node *list, const fw_scene *s)
{
    for (size_t i = 0; i < s->n_floes; i++) {
        const fw_floe *a = &s->floes[i];
        double         distance = hypot(a->x, a->y), overlap = s->model.structure_radius + a->diameter / 2 - distance;
        if (overlap > OVERLAP_ALLOWED) {
            return fw_yaml_fail(
                list->values[i], r->m,
                "floes[%zu] %s the structure by %g m: its centre is %g m from the origin, wanted at least %g m", i + 1,
                distance < s->model.structure_radius ? "is inside" : "overlaps", overlap, distance,
                s->model.structure_radius + a->diameter / 2);
        }
        for (size_t k = 0; k < i; k++) {
            const fw_floe *b = &s->floes[k];
            double         dx = a->x - b->x, dy = a->y - b->y, touch = (a->diameter + b->diameter) / 2;
            if (fabs(dx) >= touch || fabs(dy) >= touch) continue; /* nearly all of 20000 floes' pairs, in no time */
            double gap = hypot(dx, dy) - touch;
            if (-gap > OVERLAP_ALLOWED) {
                return fw_yaml_fail(list->values[i], r->m,
                                    "floes[%zu] and floes[%zu] overlap by %g m, wanted at most a touch", k + 1, i + 1,
                                    -gap);
            }
        }
    }
    return FW_OK;
}

static fw_status read_scene(const fw_reader *r, const char *file, fw_scene *s)
{
    const fw_node *ice = fw_yaml_get(r->root, "ice"), *floes = fw_yaml_get(r->root, "floes");
    fw_values      v;

    memset(&v, 0, sizeof v);
    fw_model_defaults(&s->model);
    FW_TRY(fw_read_section(r, &fw_table_scene, "", r->root, &v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_scene_structure, "structure", fw_yaml_get(r->root, "structure"), &v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_scene_ice, "ice", ice, &v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_scene_current, "current", fw_yaml_get(r->root, "current"), &v, NULL));
    FW_TRY(fw_file_refuse_after(r));
    FW_TRY(fw_file_read_model(r, &v, &s->model));
    if (!(v.temperature <= -v.temperature_floor)) {
        const fw_node *n = fw_yaml_get(ice, "temperature");
        return fw_yaml_fail(
            n ? n : r->root, r->m,
            "ice.temperature = %g degC is inside ice.temperature_floor = %g K: wanted at most %g degC, because the "
            "abrasion law is singular at 0 degC",
            v.temperature, v.temperature_floor, -v.temperature_floor);
    }
    s->speed = v.speed;
    s->temperature = v.temperature;
    s->duration = v.duration;
    s->model.window = v.duration;
    if (floes->kind != FW_NODE_LIST)
        return fw_yaml_fail(floes, r->m, "floes: wanted a list of {x, y, diameter, thickness, ...}");
    FW_TRY(fw_alloc(&s->floes, floes->n, sizeof *s->floes, "floes", r->m));
    s->n_floes = floes->n;
    for (size_t i = 0; i < floes->n; i++) FW_TRY(read_floe(r, floes->values[i], i + 1, &s->floes[i]));
    FW_TRY(check_distances(r, floes, s));
    FW_TRY(fw_file_read_scene_drift(r, &v, s));
    fw_scene_facts facts;
    fw_facts_scene(s, &facts);
    FW_TRY(fw_file_read_effects(r, &facts, &s->model));
    fw_status status = fw_model_check(&s->model, r->m);
    if (status == FW_OK) return FW_OK;
    fw_msg_prefix(r->m, "%.200s: ", file);
    return status == FW_E_ARG ? FW_E_INPUT : status;
}

fw_status fw_config_scene(fw_scene *out, const char *path, size_t n_sets, const char *const *sets, fw_msg *m)
{
    char      directory[512];
    fw_yaml   yaml = {0};
    fw_units *units = NULL;
    char     *text;
    size_t    n;

    memset(out, 0, sizeof *out);
    fw_reader_directory(path, directory, sizeof directory);
    FW_TRY(fw_yaml_load_file(path, FW_YAML_MAX_BYTES, &text, &n, m));
    fw_status status = fw_units_open(&units, m);
    if (status == FW_OK) status = fw_yaml_parse(&yaml, path, text, n, m);
    for (size_t i = 0; i < n_sets && status == FW_OK; i++) status = fw_yaml_set(&yaml, sets[i], m);
    if (status == FW_OK) {
        const fw_reader r = {units, yaml.root, directory, m};
        status = read_scene(&r, path, out);
    }
    fw_yaml_free(&yaml);
    fw_units_close(units);
    free(text);
    if (status != FW_OK) fw_scene_free(out);
    return status;
}

fw_status fw_config_duration(const char *text, double *seconds, fw_msg *m)
{
    fw_units *units;
    double    s = 0;

    FW_TRY(fw_units_open(&units, m));
    fw_status status = fw_units_read(units, text, "s", &s, m);
    fw_units_close(units);
    FW_TRY(status);
    FW_CHECK(s > 0, m, FW_E_INPUT, "\"%.60s\": wanted a time of more than 0, like 2h or \"90 min\"", text);
    *seconds = s;
    return FW_OK;
}
