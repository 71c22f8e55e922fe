#include "cli/reader.h"

#include <stdio.h>
#include <string.h>

void fw_reader_directory(const char *path, char *out, size_t size)
{
    const char *slash = strrchr(path, '/');
    size_t      n = slash ? (size_t)(slash - path) : 0;

    if (slash == path) n = 1;
    if (n >= size) n = 0;
    memcpy(out, path, n);
    out[n] = '\0';
}

void fw_read_path(char *out, size_t size, const char *section, const char *key)
{
    snprintf(out, size, "%.120s%s%.60s", section, *section && *key ? "." : "", key);
}

fw_status fw_read_text(const fw_reader *r, const fw_node *n, const char *path, const char **text)
{
    if (n->kind != FW_NODE_SCALAR) {
        return fw_yaml_fail(n, r->m, "%s: a %s stands here, wanted one value", path,
                            n->kind == FW_NODE_LIST ? "list" : "map");
    }
    if (!*n->text) return fw_yaml_fail(n, r->m, "%s: has no value", path);
    *text = n->text;
    return FW_OK;
}

fw_status fw_read_quantity(const fw_reader *r, const fw_node *n, const char *path, const char *unit, double *value)
{
    const char *text = NULL;

    FW_TRY(fw_read_text(r, n, path, &text));
    fw_status status = fw_units_read(r->units, text, unit, value, r->m);
    return status == FW_OK ? FW_OK : fw_yaml_blame(n, path, status, r->m);
}

/* Keys that the plan of the program names and that this version does not have: say so instead of guessing at a
 * spelling. */
static bool is_later(const fw_section *s, const char *key)
{
    static const char *const rows[][2] = {
        {"field", "upstream"},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strcmp(s->name, rows[i][0]) == 0 && strcmp(key, rows[i][1]) == 0) return true;
    }
    return false;
}

static fw_status refuse_key(const fw_reader *r, const fw_section *s, const char *path, const fw_node *key)
{
    const char *nearest = fw_keys_nearest(s, key->text);
    char        list[400] = "";
    size_t      used = 0;

    if (is_later(s, key->text)) {
        fw_yaml_fail(key, r->m, "%s.%s is not in this version", path, key->text);
        return FW_E_UNSUPPORTED;
    }
    if (nearest) {
        return fw_yaml_fail(key, r->m, "unknown key \"%.60s\"%s%s, did you mean \"%s\"?", key->text,
                            *path ? " in " : "", path, nearest);
    }
    for (size_t i = 0; i < s->n_keys && used < sizeof list - 1; i++) {
        int n = snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", s->keys[i].name);
        used += n > 0 ? (size_t)n : 0;
    }
    return fw_yaml_fail(key, r->m, "unknown key \"%.60s\"%s%s, wanted one of %s", key->text, *path ? " in " : "", path,
                        list);
}

fw_status fw_read_section(const fw_reader *r, const fw_section *s, const char *path, const fw_node *map, void *base,
                          uint64_t *given)
{
    uint64_t found = 0;
    char     full[200];

    FW_TRY(fw_keys_defaults(s, r->units, base, r->m));
    if (map && map->kind != FW_NODE_MAP) {
        return fw_yaml_fail(map, r->m, "%s: wanted a map of keys, like {%s: ...}", path, s->keys[0].name);
    }
    for (size_t i = 0; map && i < map->n; i++) {
        const fw_key *k = fw_keys_find(s, map->keys[i]->text);
        const char   *text = NULL;
        if (!k) return refuse_key(r, s, path, map->keys[i]);
        found |= UINT64_C(1) << (k - s->keys);
        if (k->kind == FW_KEY_SHAPED) continue;
        fw_read_path(full, sizeof full, path, k->name);
        FW_TRY(fw_read_text(r, map->values[i], full, &text));
        fw_status status = fw_keys_read(k, r->units, text, base, r->m);
        if (status != FW_OK) return fw_yaml_blame(map->values[i], full, status, r->m);
    }
    for (size_t i = 0; i < s->n_keys; i++) {
        const fw_key *k = &s->keys[i];
        if (k->fallback || (found >> i & 1)) continue;
        fw_read_path(full, sizeof full, path, k->name);
        return fw_yaml_fail(map ? map : r->root, r->m, "%s is missing: %s%s%s", full, k->meaning,
                            k->unit ? ", in " : "",
                            k->unit ? (strcmp(k->unit, "1") == 0 ? "plain numbers or %" : k->unit) : "");
    }
    if (given) *given = found;
    return FW_OK;
}

bool fw_read_is_given(const fw_section *s, uint64_t given, const char *key)
{
    for (size_t i = 0; i < s->n_keys; i++) {
        if (strcmp(s->keys[i].name, key) == 0) return given >> i & 1;
    }
    return false;
}
