#include "cli/model_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "physics/abrasion.h"
#include "physics/unbreakable.h"
#include "realisation/accuracy.h"

/* ---- abrasion laws ---------------------------------------------------------------------------------------------- */

static fw_status refuse_law(const fw_reader *r, const fw_node *at, const char *path, const char *name)
{
    const fw_abrasion_entry *entries;
    size_t                   n = fw_abrasion_list(&entries), used = 0;
    char                     list[200] = "";

    for (size_t i = 0; i < n && used < sizeof list; i++) {
        int k = snprintf(list + used, sizeof list - used, "%s, ", entries[i].law.name);
        used += k > 0 ? (size_t)k : 0;
    }
    return fw_yaml_fail(at, r->m,
                        "%s: unknown abrasion law \"%.60s\", wanted one of %sor {power: {coefficient, exponent}}", path,
                        name, list);
}

/* at: the exponent's node. From 2 on the load of a first touch diverges: sigma^m ~ t^(-m/2), under a limit ~ t^(-q m/2). */
static fw_status check_exponent(const fw_reader *r, const fw_node *at, const char *path, double m, const fw_pressure_law *limit)
{
    if (!(m > 0 && m < (limit ? 4 : 2))) {
        return fw_yaml_fail(at, r->m,
                            limit ? "%s.exponent = %g: wanted more than 0 and less than 4"
                                  : "%s.exponent = %g: wanted more than 0 and less than 2: at 2 and above the wear of a first touch is "
                                    "infinite without a crushing limit (abrasion.crushing_limit)",
                            path, m);
    }
    if (!limit || m * limit->exponent < 2) return FW_OK;
    return fw_yaml_fail(at, r->m,
                        "%s.exponent = %g: wanted less than %g under abrasion.crushing_limit.exponent = %g: from there on the wear of a first touch is "
                        "infinite under that limit too",
                        path, m, 2 / limit->exponent, limit->exponent);
}

/* {archard: {...}} or {power: {...}}; limit: NULL without one. */
static fw_status read_own_law(const fw_reader *r, const fw_node *map, const char *path, const fw_pressure_law *limit, fw_abrasion_law *law)
{
    if (map->n != 1)
        return fw_yaml_fail(map, r->m, "%s: wanted one law, like {power: {coefficient: 0.1 mm/km, exponent: 1}}", path);

    const char       *name = map->keys[0]->text;
    bool              is_power = strcmp(name, "power") == 0;
    const fw_section *section = is_power ? &fw_table_power : strcmp(name, "archard") == 0 ? &fw_table_archard : NULL;
    fw_law_values     v = {0, 1, false};
    char              full[200];

    if (!section && fw_abrasion_find(name)) {
        return fw_yaml_fail(map, r->m, "%s: the law %s takes no numbers of one's own, wanted its name alone", path,
                            name);
    }
    if (!section) return refuse_law(r, map->keys[0], path, name);
    fw_read_path(full, sizeof full, path, name);
    FW_TRY(fw_read_section(r, section, full, map->values[0], &v, NULL));
    if (is_power) FW_TRY(check_exponent(r, fw_yaml_get(map->values[0], "exponent"), full, v.exponent, limit));
    memset(law, 0, sizeof *law);
    snprintf(law->name, sizeof law->name, "%s", name);
    law->coefficient = v.coefficient;
    law->exponent = v.exponent;
    law->uses_temperature = v.uses_temperature;
    return FW_OK;
}

static fw_status read_law(const fw_reader *r, const fw_node *n, const char *path, const fw_pressure_law *limit, fw_abrasion_law *law)
{
    const char *name = NULL;

    if (n->kind == FW_NODE_MAP) return read_own_law(r, n, path, limit, law);
    FW_TRY(fw_read_text(r, n, path, &name));
    const fw_abrasion_law *known = fw_abrasion_find(name);
    if (!known) return refuse_law(r, n, path, name);
    *law = *known;
    return FW_OK;
}

static fw_status read_laws(const fw_reader *r, const fw_node *n, fw_model *model)
{
    size_t                 count = n->kind == FW_NODE_LIST ? n->n : 1;
    const fw_pressure_law *limit = model->given & (uint32_t)FW_GIVEN_CRUSHING_LIMIT ? &model->crushing_limit : NULL;

    if (count < 1 || count > FW_MAX_LAWS) {
        return fw_yaml_fail(n, r->m, "abrasion.laws: %zu laws, wanted 1 to %d", count, FW_MAX_LAWS);
    }
    for (size_t i = 0; i < count; i++) {
        const fw_node *at = n->kind == FW_NODE_LIST ? n->values[i] : n;
        char           path[64];
        snprintf(path, sizeof path, "abrasion.laws[%zu]", i + 1);
        FW_TRY(read_law(r, at, path, limit, &model->laws[i]));
        for (size_t k = 0; k < i; k++) {
            const fw_abrasion_law *a = &model->laws[k], *b = &model->laws[i];
            if (strcmp(a->name, b->name) == 0 && a->coefficient == b->coefficient && a->exponent == b->exponent &&
                a->uses_temperature == b->uses_temperature) {
                return fw_yaml_fail(at, r->m, "%s: the same law as abrasion.laws[%zu]", path, k + 1);
            }
        }
    }
    model->n_laws = count;
    return FW_OK;
}

/* ---- thickness mixes -------------------------------------------------------------------------------------------- */

fw_status fw_file_check_thickness(const fw_node *at, const char *path, double thickness, fw_msg *m)
{
    if (fw_unbreakable_class_exists(thickness)) return FW_OK;
    return fw_yaml_fail(at, m,
                        "%s = %g m: wanted %g m to %g m, where floes with 4h <= diameter <= sqrt(130h - 11) exist",
                        path, thickness, FW_THICKNESS_MIN, FW_THICKNESS_MAX);
}

static int compare_classes(const void *a, const void *b)
{
    const fw_thickness_class *x = a, *y = b;
    return (x->thickness > y->thickness) - (x->thickness < y->thickness);
}

static fw_status read_classes(const fw_reader *r, const fw_node *map, const char *path, fw_thickness_mix *mix)
{
    double sum = 0;

    if (map->kind != FW_NODE_MAP || map->n == 0 || map->n > FW_MAX_CLASSES) {
        return fw_yaml_fail(map, r->m, "%s: wanted a map of 1 to %d classes, like {0.5 m: 1, 0.7 m: 2}", path,
                            FW_MAX_CLASSES);
    }
    for (size_t i = 0; i < map->n; i++) {
        double h, share;
        char   full[200];
        FW_TRY(fw_read_quantity(r, map->keys[i], path, "m", &h));
        FW_TRY(fw_file_check_thickness(map->keys[i], path, h, r->m));
        snprintf(full, sizeof full, "%.120s.%.60s", path, map->keys[i]->text);
        FW_TRY(fw_read_quantity(r, map->values[i], full, "1", &share));
        if (!(share >= 0)) return fw_yaml_fail(map->values[i], r->m, "%s = %g: a share is at least 0", full, share);
        for (size_t k = 0; k < mix->n_classes; k++) {
            if (mix->classes[k].thickness == h)
                return fw_yaml_fail(map->keys[i], r->m, "%s: %g m stands twice", path, h);
        }
        mix->classes[mix->n_classes++] = (fw_thickness_class){h, share};
        sum += share;
    }
    if (!(sum > 0 && sum < INFINITY))
        return fw_yaml_fail(map, r->m, "%s: the shares sum to %g, wanted more than 0", path, sum);
    size_t kept = 0;
    for (size_t i = 0; i < mix->n_classes; i++) {
        if (mix->classes[i].share > 0) mix->classes[kept++] = mix->classes[i];
    }
    mix->n_classes = kept;
    qsort(mix->classes, kept, sizeof mix->classes[0], compare_classes);
    for (size_t i = 0; i < kept; i++) mix->classes[i].share /= sum;
    return FW_OK;
}

fw_status fw_file_read_mixes(const fw_reader *r, const fw_node *list, fw_model *model)
{
    double sum = 0;

    if (!list) return FW_OK;
    if (list->kind != FW_NODE_LIST || list->n == 0 || list->n > FW_MAX_MIXES) {
        return fw_yaml_fail(list, r->m, "ice.thickness_mixes: wanted a list of 1 to %d mixes {probability, classes}",
                            FW_MAX_MIXES);
    }
    memset(model->mixes, 0, sizeof model->mixes);
    for (size_t i = 0; i < list->n; i++) {
        fw_mix_values     v = {0, 0};
        fw_thickness_mix *mix = &model->mixes[i];
        char              path[64], full[96];
        snprintf(path, sizeof path, "ice.thickness_mixes[%zu]", i + 1);
        FW_TRY(fw_read_section(r, &fw_table_mix, path, list->values[i], &v, NULL));
        snprintf(full, sizeof full, "%s.classes", path);
        FW_TRY(read_classes(r, fw_yaml_get(list->values[i], "classes"), full, mix));
        mix->probability = v.probability;
        mix->by_area = v.by == 1;
        sum += v.probability;
    }
    if (!(fabs(sum - 1) <= 1e-6)) {
        return fw_yaml_fail(list, r->m, "ice.thickness_mixes: the probabilities sum to %.9g, wanted 1", sum);
    }
    for (size_t i = 0; i < list->n; i++) model->mixes[i].probability /= sum;
    model->n_mixes = list->n;
    return FW_OK;
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static uint32_t bit_if(bool condition, fw_given_bit bit) { return condition ? (uint32_t)bit : 0; }

/* What auto and its refusals want to know of contact: which of its keys somebody wrote. */
static uint32_t contact_given(uint64_t given, const fw_values *v)
{
    const fw_section *s = &fw_table_contact;
    bool              has_law = fw_read_is_given(s, given, "law");

    return bit_if(has_law && v->contact_law == 0, FW_GIVEN_LAW_SPRING) | bit_if(has_law && v->contact_law == 1, FW_GIVEN_LAW_CRUSH) |
           bit_if(fw_read_is_given(s, given, "pressure"), FW_GIVEN_PRESSURE) |
           bit_if(fw_read_is_given(s, given, "pressure_exponent"), FW_GIVEN_PRESSURE_EXPONENT) |
           bit_if(fw_read_is_given(s, given, "flat"), FW_GIVEN_FLAT) |
           bit_if(fw_read_is_given(s, given, "unloading_stiffness") && v->unloading >= 0, FW_GIVEN_UNLOADING) |
           bit_if(fw_read_is_given(s, given, "floe_stiffness") && v->floe_stiffness >= 0, FW_GIVEN_FLOE_STIFFNESS) |
           bit_if(fw_read_is_given(s, given, "floe_friction") && v->floe_friction >= 0, FW_GIVEN_FLOE_FRICTION);
}

static fw_status read_contact(const fw_reader *r, fw_values *v, fw_model *model)
{
    uint64_t given = 0;

    FW_TRY(fw_read_section(r, &fw_table_contact, "contact", fw_yaml_get(r->root, "contact"), v, &given));
    model->given |= contact_given(given, v);
    model->stiffness_from_pressure = v->stiffness < 0;
    if (v->stiffness >= 0) model->stiffness = v->stiffness; /* else the default stays, as a scale */
    model->damping_ratio = v->damping_ratio;
    model->friction = v->friction;
    model->slip_damping_ratio = v->slip_damping_ratio;
    model->crush = (fw_crush){.law = {v->pressure, v->pressure_exponent}, .unloading = v->unloading, .has_flat = v->has_flat};
    model->floe_stiffness = v->floe_stiffness >= 0 ? v->floe_stiffness : model->stiffness;
    model->floe_friction = v->floe_friction >= 0 ? v->floe_friction : model->friction;
    return FW_OK;
}

static fw_status read_water(const fw_reader *r, fw_values *v, fw_model *model)
{
    const fw_section *s = &fw_table_water;
    uint64_t          given = 0;

    FW_TRY(fw_read_section(r, s, "water", fw_yaml_get(r->root, "water"), v, &given));
    bool has_mass = fw_read_is_given(s, given, "added_mass"), has_flow = fw_read_is_given(s, given, "deflected_flow");
    model->given |= bit_if(fw_read_is_given(s, given, "skin_drag"), FW_GIVEN_SKIN_DRAG) |
                    bit_if(has_mass && v->has_added_mass, FW_GIVEN_ADDED_MASS_ON) |
                    bit_if(has_mass && !v->has_added_mass, FW_GIVEN_ADDED_MASS_OFF) |
                    bit_if(has_flow && v->has_deflected_flow, FW_GIVEN_DEFLECTED_ON) |
                    bit_if(has_flow && !v->has_deflected_flow, FW_GIVEN_DEFLECTED_OFF);
    model->water_density = v->water_density;
    model->form_drag = v->form_drag;
    model->skin_drag = v->skin_drag;
    return FW_OK;
}

static fw_status read_abrasion(const fw_reader *r, fw_values *v, fw_model *model)
{
    const fw_node *map = fw_yaml_get(r->root, "abrasion"), *laws, *limit;

    FW_TRY(fw_read_section(r, &fw_table_abrasion, "abrasion", map, v, NULL));
    limit = fw_yaml_get(map, "crushing_limit");
    if (limit) {
        FW_TRY(fw_read_section(r, &fw_table_crushing_limit, "abrasion.crushing_limit", limit, v, NULL));
        model->crushing_limit = (fw_pressure_law){v->limit_pressure, v->limit_exponent};
        model->given |= FW_GIVEN_CRUSHING_LIMIT;
    }
    laws = fw_yaml_get(map, "laws");
    return laws ? read_laws(r, laws, model) : FW_OK;
}

fw_status fw_file_read_model(const fw_reader *r, fw_values *v, fw_model *model)
{
    FW_TRY(read_contact(r, v, model));
    FW_TRY(read_water(r, v, model));
    FW_TRY(read_abrasion(r, v, model));
    FW_TRY(fw_read_section(r, &fw_table_ring, "ring", fw_yaml_get(r->root, "ring"), v, NULL));
    model->structure_radius = v->diameter / 2;
    model->ice_density = v->ice_density;
    model->accuracy = v->accuracy;
    if (v->n_arcs >= 0 && v->n_arcs != floor(v->n_arcs)) {
        return fw_yaml_fail(fw_yaml_get(fw_yaml_get(r->root, "ring"), "arcs"), r->m,
                            "ring.arcs = %g: wanted a whole number from 72 to 3600", v->n_arcs);
    }
    model->n_arcs = v->n_arcs >= 0 ? (size_t)v->n_arcs : fw_accuracy_arcs(v->accuracy);
    return FW_OK;
}
