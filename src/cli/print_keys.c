/* The reference of every key, from the tables that parse. */
#include <math.h>
#include <string.h>

#include "cli/config.h"
#include "cli/distribution_file.h"
#include "cli/json.h"
#include "cli/tables.h"

static const char *kind_of(const fw_key *k, char text[64])
{
    switch (k->kind) {
    case FW_KEY_NUMBER: return "quantity";
    case FW_KEY_AUTO:
        snprintf(text, 64, "quantity or %s", k->words ? k->words : "auto");
        return text;
    case FW_KEY_COUNT: return "whole number";
    case FW_KEY_FLAG: return "on or off";
    case FW_KEY_TEXT: return "text";
    case FW_KEY_CHOICE:
    case FW_KEY_SHAPED: break;
    }
    return k->words;
}

static const char *unit_of(const fw_key *k)
{
    return !k->unit ? "" : strcmp(k->unit, "1") == 0 ? "plain or %" : k->unit;
}

static void print_text(FILE *to)
{
    const char *law, *shape;

    for (size_t i = 0; i < fw_n_tables; i++) {
        const fw_section *s = fw_tables[i].section;
        fprintf(to, "%s%s (%s%s)\n", i ? "\n" : "", *s->name ? s->name : s->meaning,
                *s->name ? s->meaning : "top level",
                strcmp(fw_tables[i].file, "scene") == 0  ? "; scene files"
                : strcmp(fw_tables[i].file, "both") == 0 ? "; campaign and scene files"
                                                         : "");
        for (size_t k = 0; k < s->n_keys; k++) {
            const fw_key *key = &s->keys[k];
            char          range[200], kind[64];
            fw_keys_range(key, range, sizeof range);
            fprintf(to, "  %-20s %s\n", key->name, key->meaning);
            fprintf(to, "  %-20s   %s%s%s%s%s; ", "", kind_of(key, kind), key->unit ? ", in " : "", unit_of(key),
                    *range ? ", " : "", range);
            if (!key->fallback) {
                fprintf(to, "must be given\n");
            } else if (!*key->fallback) {
                fprintf(to, "may be left out\n");
            } else {
                fprintf(to, "default %s\n", key->fallback);
            }
        }
    }
    fprintf(
        to,
        "\nwherever a distribution may stand: one value, or one of these in braces, like {uniform: [1 m/s, 2 m/s]}\n");
    for (size_t i = 0; (law = fw_distribution_file_law(i, &shape)); i++) fprintf(to, "  %-20s %s\n", law, shape);
}

static void print_key(fw_json *j, const fw_key *key)
{
    char kind[64];
    fw_json_begin_object(j);
    fw_json_put_string(j, "key", key->name);
    fw_json_put_string(j, "kind", kind_of(key, kind));
    fw_json_put_string(j, "unit", key->unit);
    fw_json_key(j, "default"); /* null: none */
    fw_json_string(j, key->fallback && *key->fallback ? key->fallback : NULL);
    fw_json_put_bool(j, "is_required", !key->fallback);
    if (key->kind == FW_KEY_NUMBER || key->kind == FW_KEY_AUTO || key->kind == FW_KEY_COUNT) {
        fw_json_put_number(j, "least", key->least); /* null: none */
        fw_json_put_bool(j, "is_least_refused", key->is_open);
        fw_json_put_number(j, "most", key->most);
    }
    fw_json_put_string(j, "meaning", key->meaning);
    fw_json_end(j);
}

static void print_json(FILE *to)
{
    fw_json     j = fw_json_onto(to);
    const char *law, *shape;

    fw_json_begin_object(&j);
    fw_json_key(&j, "sections");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < fw_n_tables; i++) {
        const fw_section *s = fw_tables[i].section;
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "file", fw_tables[i].file);
        fw_json_put_string(&j, "section", s->name);
        fw_json_put_string(&j, "meaning", s->meaning);
        fw_json_key(&j, "keys");
        fw_json_begin_array(&j);
        for (size_t k = 0; k < s->n_keys; k++) print_key(&j, &s->keys[k]);
        fw_json_end(&j);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_key(&j, "distributions");
    fw_json_begin_array(&j);
    for (size_t i = 0; (law = fw_distribution_file_law(i, &shape)); i++) {
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "name", law);
        fw_json_put_string(&j, "shape", shape);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_end(&j);
}

void fw_config_print_keys(FILE *to, bool as_json)
{
    if (as_json) {
        print_json(to);
    } else {
        print_text(to);
    }
}
