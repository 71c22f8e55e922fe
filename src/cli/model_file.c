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

/* {archard: {...}} or {power: {...}} */
static fw_status read_own_law(const fw_reader *r, const fw_node *map, const char *path, fw_abrasion_law *law)
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
    if (is_power && !(v.exponent > 0 && v.exponent < 2)) {
        return fw_yaml_fail(
            fw_yaml_get(map->values[0], "exponent"), r->m,
            "%s.exponent = %g: wanted more than 0 and less than 2: at 2 and above the wear of a first touch is "
            "infinite without a crushing limit",
            full, v.exponent);
    }
    memset(law, 0, sizeof *law);
    snprintf(law->name, sizeof law->name, "%s", name);
    law->coefficient = v.coefficient;
    law->exponent = v.exponent;
    law->uses_temperature = v.uses_temperature;
    return FW_OK;
}

static fw_status read_law(const fw_reader *r, const fw_node *n, const char *path, fw_abrasion_law *law)
{
    const char *name = NULL;

    if (n->kind == FW_NODE_MAP) return read_own_law(r, n, path, law);
    FW_TRY(fw_read_text(r, n, path, &name));
    const fw_abrasion_law *known = fw_abrasion_find(name);
    if (!known) return refuse_law(r, n, path, name);
    *law = *known;
    return FW_OK;
}

static fw_status read_laws(const fw_reader *r, const fw_node *n, fw_model *model)
{
    size_t count = n->kind == FW_NODE_LIST ? n->n : 1;

    if (count < 1 || count > FW_MAX_LAWS) {
        return fw_yaml_fail(n, r->m, "abrasion.laws: %zu laws, wanted 1 to %d", count, FW_MAX_LAWS);
    }
    for (size_t i = 0; i < count; i++) {
        const fw_node *at = n->kind == FW_NODE_LIST ? n->values[i] : n;
        char           path[64];
        snprintf(path, sizeof path, "abrasion.laws[%zu]", i + 1);
        FW_TRY(read_law(r, at, path, &model->laws[i]));
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

/* Words of the crushing law that a plan of this program names: refuse them by name, not as wrong numbers. */
static fw_status refuse_crush(const fw_reader *r, const fw_node *contact)
{
    static const char *const rows[][2] = {{"law", "crush"}, {"stiffness", "from_pressure"}};

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const fw_node *n = fw_yaml_get(contact, rows[i][0]);
        if (n && n->kind == FW_NODE_SCALAR && strcmp(n->text, rows[i][1]) == 0) {
            fw_yaml_fail(n, r->m, "contact.%s: %s is not in this version, wanted %s", rows[i][0], rows[i][1],
                         i == 0 ? "spring" : "a stiffness in N/m");
            return FW_E_UNSUPPORTED;
        }
    }
    return FW_OK;
}

fw_status fw_file_read_model(const fw_reader *r, fw_values *v, fw_model *model)
{
    const fw_node *contact = fw_yaml_get(r->root, "contact"), *abrasion = fw_yaml_get(r->root, "abrasion"), *laws;

    FW_TRY(refuse_crush(r, contact));
    FW_TRY(fw_read_section(r, &fw_table_contact, "contact", contact, v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_water, "water", fw_yaml_get(r->root, "water"), v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_ring, "ring", fw_yaml_get(r->root, "ring"), v, NULL));
    FW_TRY(fw_read_section(r, &fw_table_abrasion, "abrasion", abrasion, v, NULL));
    laws = fw_yaml_get(abrasion, "laws");
    if (laws) FW_TRY(read_laws(r, laws, model));

    model->structure_radius = v->diameter / 2;
    model->ice_density = v->ice_density;
    model->water_density = v->water_density;
    model->form_drag = v->form_drag;
    model->stiffness = v->stiffness;
    model->damping_ratio = v->damping_ratio;
    model->friction = v->friction;
    model->slip_damping_ratio = v->slip_damping_ratio;
    model->accuracy = v->accuracy;
    if (v->n_arcs >= 0 && v->n_arcs != floor(v->n_arcs)) {
        return fw_yaml_fail(fw_yaml_get(fw_yaml_get(r->root, "ring"), "arcs"), r->m,
                            "ring.arcs = %g: wanted a whole number from 72 to 3600", v->n_arcs);
    }
    model->n_arcs = v->n_arcs >= 0 ? (size_t)v->n_arcs : fw_accuracy_arcs(v->accuracy);
    return FW_OK;
}
