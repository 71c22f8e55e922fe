#include "cli/effects_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_EFFECTS = 32 };

static fw_status find_effect(const fw_reader *r, const fw_node *at, const char *name, const fw_effect **out)
{
    const fw_effect *const *effects;
    size_t                  n = fw_effects_list(&effects), used = 0;
    const char             *names[MAX_EFFECTS];
    char                    list[400] = "";

    *out = fw_effects_find(name);
    if (*out) return FW_OK;
    if (n > MAX_EFFECTS) n = MAX_EFFECTS;
    for (size_t i = 0; i < n && used < sizeof list; i++) {
        int k = snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", effects[i]->name);
        names[i] = effects[i]->name;
        used += k > 0 ? (size_t)k : 0;
    }
    const char *nearest = fw_keys_nearest_word(n, names, name);
    return fw_yaml_fail(at, r->m, "effects: unknown effect \"%.60s\", %s%s%swanted of %s", name, nearest ? "did you mean \"" : "",
                        nearest ? nearest : "", nearest ? "\"? " : "", list);
}

static fw_status read_switch(const fw_reader *r, const fw_node *key, const fw_node *value, uint32_t *set)
{
    static const fw_key FLAG = {"on", FW_KEY_FLAG, 0, NULL, NULL, -INFINITY, INFINITY, false, NULL, "switch"};
    const char         *text = NULL;
    const fw_effect    *effect;
    bool                is_on;
    char                path[96];

    snprintf(path, sizeof path, "effects.%.60s", key->text);
    FW_TRY(fw_read_text(r, value, path, &text));
    fw_status status = fw_keys_read(&FLAG, r->units, text, &is_on, r->m);
    if (status != FW_OK) return fw_yaml_blame(value, path, status, r->m);
    FW_TRY(find_effect(r, key, key->text, &effect));
    *set = is_on ? *set | (uint32_t)effect->bit : *set & ~(uint32_t)effect->bit;
    return FW_OK;
}

/* What the file says, over what auto has put there. */
static fw_status override(const fw_reader *r, const fw_node *n, uint32_t *set)
{
    const fw_effect *effect;
    const char      *text = NULL;

    switch (n->kind) {
    case FW_NODE_MAP:
        for (size_t i = 0; i < n->n; i++) FW_TRY(read_switch(r, n->keys[i], n->values[i], set));
        return FW_OK;
    case FW_NODE_LIST:
        *set = 0;
        for (size_t i = 0; i < n->n; i++) {
            FW_TRY(fw_read_text(r, n->values[i], "effects", &text));
            FW_TRY(find_effect(r, n->values[i], text, &effect));
            if (*set & (uint32_t)effect->bit) return fw_yaml_fail(n->values[i], r->m, "effects: %s stands twice", text);
            *set |= (uint32_t)effect->bit;
        }
        return FW_OK;
    case FW_NODE_SCALAR: break;
    }
    FW_TRY(fw_read_text(r, n, "effects", &text));
    if (strcmp(text, "auto") == 0) return FW_OK;
    return fw_yaml_fail(n, r->m, "effects = \"%.60s\": wanted auto, a list of names, or {name: on/off}", text);
}

/* The node of a dotted path, or the last one on the way to it that the file has. */
static const fw_node *node_at(const fw_node *root, const char *path)
{
    const fw_node *at = root;

    while (*path) {
        char   key[64];
        size_t n = strcspn(path, ".");
        snprintf(key, sizeof key, "%.*s", (int)n, path);
        const fw_node *next = fw_yaml_get(at, key);
        if (!next) break;
        at = next;
        path += n + (path[n] == '.');
    }
    return at;
}

fw_status fw_file_read_effects(const fw_reader *r, const fw_scene_facts *f, fw_model *model)
{
    const fw_node *n = fw_yaml_get(r->root, "effects");
    const char    *key = "effects";

    model->effects = fw_effects_auto(model, f);
    if (n) FW_TRY(override(r, n, &model->effects));
    if (n && n->kind != FW_NODE_SCALAR) model->given |= (uint32_t)FW_GIVEN_EFFECTS;
    const char *why = fw_effects_refuse(model, f, &key);
    return why ? fw_yaml_fail(node_at(r->root, key), r->m, "%s: %s", key, why) : FW_OK;
}
