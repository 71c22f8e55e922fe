#include "cli/yaml.h"

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "base/memory.h"

enum { MAX_QUOTE = 60, MAX_NODES = 200000 };

/* ---- messages --------------------------------------------------------------------------------------------------- */

static void put_place(const fw_node *at, fw_msg *m)
{
    if (at->line) {
        fw_msg_prefix(m, "%.200s:%zu:%zu: ", at->origin, at->line, at->column);
    } else {
        fw_msg_prefix(m, "%.200s: ", at->origin);
    }
}

fw_status fw_yaml_fail(const fw_node *at, fw_msg *m, const char *fmt, ...)
{
    char    text[800];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    fw_fail(m, FW_E_INPUT, "%s", text);
    put_place(at, m);
    return FW_E_INPUT;
}

fw_status fw_yaml_blame(const fw_node *at, const char *path, fw_status status, fw_msg *m)
{
    fw_msg_prefix(m, "%.200s: ", path);
    put_place(at, m);
    return status;
}

static fw_status fail_at(const char *name, yaml_mark_t mark, fw_msg *m, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));

static fw_status fail_at(const char *name, yaml_mark_t mark, fw_msg *m, const char *fmt, ...)
{
    char    text[400];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    return fw_fail(m, FW_E_INPUT, "%.200s:%zu:%zu: %s", name, mark.line + 1, mark.column + 1, text);
}

static fw_status fail_parser(const char *name, const yaml_parser_t *p, fw_msg *m)
{
    if (p->error == YAML_MEMORY_ERROR) return fw_fail(m, FW_E_NOMEM, "out of memory: reading %.200s", name);
    return fail_at(name, p->problem_mark, m, "%s%s%s", p->context ? p->context : "", p->context ? ": " : "",
                   p->problem ? p->problem : "this is no YAML");
}

/* ---- the file --------------------------------------------------------------------------------------------------- */

static fw_status read_all(FILE *f, const char *path, size_t max_bytes, char **text, size_t *n, fw_msg *m)
{
    char  *buffer = NULL;
    size_t capacity = 0, used = 0;

    for (;;) {
        fw_status status = fw_grow(&buffer, &capacity, used + 65536, 1, "file", m);
        if (status != FW_OK) {
            free(buffer);
            return status;
        }
        size_t got = fread(buffer + used, 1, capacity - used - 1, f);
        used += got;
        if (got == 0 || used > max_bytes) break;
    }
    if (ferror(f) || used > max_bytes) {
        int cause = errno;
        free(buffer);
        FW_CHECK(!ferror(f), m, FW_E_IO, "%.200s: cannot be read: %s", path, strerror(cause));
        return fw_fail(m, FW_E_INPUT, "%.200s:1:1: longer than %zu KiB, wanted less", path, max_bytes / 1024);
    }
    buffer[used] = '\0';
    *text = buffer;
    *n = used;
    return FW_OK;
}

fw_status fw_yaml_load_file(const char *path, size_t max_bytes, char **text, size_t *n, fw_msg *m)
{
    FILE *f = fopen(path, "rb");

    *text = NULL;
    *n = 0;
    FW_CHECK(f, m, FW_E_IO, "%.200s: cannot be opened: %s", path, strerror(errno));
    fw_status status = read_all(f, path, max_bytes, text, n, m);
    fclose(f);
    return status;
}

/* ---- checks before the document loader -------------------------------------------------------------------------- */

/* Length of the UTF-8 character at p, 0 when it is none (RFC 3629; overlong forms, surrogates and C0 controls too). */
static size_t character(const unsigned char *p, size_t left)
{
    if (p[0] < 0x80) return p[0] >= 0x20 ? (p[0] != 0x7f) : (p[0] == '\t' || p[0] == '\n' || p[0] == '\r');
    size_t        n = p[0] >= 0xf0 ? 4 : p[0] >= 0xe0 ? 3 : 2;
    unsigned char low = p[0] == 0xe0 ? 0xa0 : p[0] == 0xf0 ? 0x90 : 0x80;
    unsigned char high = p[0] == 0xed ? 0x9f : p[0] == 0xf4 ? 0x8f : 0xbf;
    if (p[0] < 0xc2 || p[0] > 0xf4 || left < n || p[1] < low || p[1] > high) return 0;
    for (size_t i = 2; i < n; i++) {
        if ((p[i] & 0xc0) != 0x80) return 0;
    }
    if (p[0] == 0xc2 && p[1] < 0xa0 && p[1] != 0x85) return 0;  /* C1 controls, which libyaml refuses without a place */
    if (p[0] == 0xef && p[1] == 0xbf && p[2] >= 0xbe) return 0; /* U+FFFE, U+FFFF */
    return n;
}

static fw_status check_text(const char *name, const char *text, size_t n_bytes, fw_msg *m)
{
    yaml_mark_t mark = {0, 0, 0};
    bool        blank = true;

    for (size_t i = 0; i < n_bytes;) {
        size_t n = character((const unsigned char *)text + i, n_bytes - i);
        if (n == 0) {
            return fail_at(name, mark, m, "byte 0x%02x is no text, wanted a file in UTF-8",
                           (unsigned)(unsigned char)text[i]);
        }
        blank = blank && strchr(" \t\r\n", text[i]);
        mark.column++;
        if (text[i] == '\n') {
            mark.line++;
            mark.column = 0;
        }
        i += n;
    }
    FW_CHECK(!blank, m, FW_E_INPUT, "%.200s:1:1: the file is empty", name);
    return FW_OK;
}

typedef struct census {
    size_t n_documents, n_nodes;
    int    level;
} census;

static fw_status check_node(const char *name, const yaml_event_t *e, const yaml_char_t *anchor, const yaml_char_t *tag,
                            census *c, fw_msg *m)
{
    if (anchor)
        return fail_at(name, e->start_mark, m, "anchor &%.40s: anchors and aliases are not read", (const char *)anchor);
    if (tag) return fail_at(name, e->start_mark, m, "tag %.40s: tags are not read", (const char *)tag);
    if (++c->n_nodes > MAX_NODES) return fail_at(name, e->start_mark, m, "more than %d values in one file", MAX_NODES);
    return FW_OK;
}

static fw_status check_event(const char *name, const yaml_event_t *e, census *c, fw_msg *m)
{
    switch (e->type) {
    case YAML_DOCUMENT_START_EVENT:
        if (c->n_documents++) return fail_at(name, e->start_mark, m, "a second document begins here, wanted one only");
        return FW_OK;
    case YAML_ALIAS_EVENT:
        return fail_at(name, e->start_mark, m, "alias *%.40s: anchors and aliases are not read",
                       (const char *)e->data.alias.anchor);
    case YAML_SCALAR_EVENT: return check_node(name, e, e->data.scalar.anchor, e->data.scalar.tag, c, m);
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        if (++c->level > FW_YAML_MAX_LEVELS) {
            return fail_at(name, e->start_mark, m, "nested deeper than %d levels", FW_YAML_MAX_LEVELS);
        }
        if (e->type == YAML_SEQUENCE_START_EVENT) {
            return check_node(name, e, e->data.sequence_start.anchor, e->data.sequence_start.tag, c, m);
        }
        return check_node(name, e, e->data.mapping_start.anchor, e->data.mapping_start.tag, c, m);
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT: c->level--; return FW_OK;
    default: return FW_OK;
    }
}

static fw_status check_events(const char *name, const char *text, size_t n_bytes, fw_msg *m)
{
    yaml_parser_t parser;
    census        c = {0, 0, 0};
    fw_status     status = FW_OK;
    bool          is_end = false;

    FW_CHECK(yaml_parser_initialize(&parser), m, FW_E_NOMEM, "out of memory: reading %.200s", name);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, n_bytes);
    while (status == FW_OK && !is_end) {
        yaml_event_t e;
        if (!yaml_parser_parse(&parser, &e)) {
            status = fail_parser(name, &parser, m);
            break;
        }
        is_end = e.type == YAML_STREAM_END_EVENT;
        status = check_event(name, &e, &c, m);
        yaml_event_delete(&e);
    }
    yaml_parser_delete(&parser);
    if (status == FW_OK && c.n_documents == 0)
        return fw_fail(m, FW_E_INPUT, "%.200s:1:1: the file holds comments only", name);
    return status;
}

/* ---- document to tree ------------------------------------------------------------------------------------------- */

static void free_node(fw_node *n)
{
    if (!n) return;
    for (size_t i = 0; i < n->n; i++) {
        if (n->keys) free_node(n->keys[i]);
        if (n->values) free_node(n->values[i]);
    }
    free(n->keys);
    free(n->values);
    free(n->text);
    free(n);
}

static fw_status build(fw_node **out, yaml_document_t *d, int index, const char *origin, bool has_place, fw_msg *m);

static fw_status fill_scalar(fw_node *n, const yaml_node_t *y, fw_msg *m)
{
    size_t length = y->data.scalar.length;

    /* "\0" in double quotes can put a NUL inside */
    if (memchr(y->data.scalar.value, 0, length)) return fw_yaml_fail(n, m, "a NUL character inside a value");
    n->is_plain = y->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    FW_TRY(fw_alloc(&n->text, length + 1, 1, "value", m));
    memcpy(n->text, y->data.scalar.value, length);
    return FW_OK;
}

static fw_status fill_list(fw_node *n, yaml_document_t *d, const yaml_node_t *y, bool has_place, fw_msg *m)
{
    size_t count = (size_t)(y->data.sequence.items.top - y->data.sequence.items.start);

    FW_TRY(fw_alloc(&n->values, count, sizeof *n->values, "list", m));
    n->n = count;
    for (size_t i = 0; i < count; i++) {
        FW_TRY(build(&n->values[i], d, y->data.sequence.items.start[i], n->origin, has_place, m));
    }
    return FW_OK;
}

static fw_status fill_map(fw_node *n, yaml_document_t *d, const yaml_node_t *y, bool has_place, fw_msg *m)
{
    size_t count = (size_t)(y->data.mapping.pairs.top - y->data.mapping.pairs.start);

    if (count > FW_YAML_MAX_KEYS)
        return fw_yaml_fail(n, m, "%zu keys in one map, wanted at most %d", count, FW_YAML_MAX_KEYS);
    FW_TRY(fw_alloc(&n->values, count, sizeof *n->values, "map", m));
    FW_TRY(fw_alloc(&n->keys, count, sizeof *n->keys, "map", m));
    n->n = count;
    for (size_t i = 0; i < count; i++) {
        const yaml_node_pair_t *pair = y->data.mapping.pairs.start + i;
        FW_TRY(build(&n->keys[i], d, pair->key, n->origin, has_place, m));
        const fw_node *key = n->keys[i];
        if (key->kind != FW_NODE_SCALAR) return fw_yaml_fail(key, m, "a key has to be one word, not a list or a map");
        for (size_t k = 0; k < i; k++) {
            if (strcmp(n->keys[k]->text, key->text) == 0) {
                return fw_yaml_fail(key, m, "%.*s: this key was given before at line %zu", MAX_QUOTE, key->text,
                                    n->keys[k]->line ? n->keys[k]->line : 1);
            }
        }
        FW_TRY(build(&n->values[i], d, pair->value, n->origin, has_place, m));
    }
    return FW_OK;
}

/* *out is linked before it is filled, so that a failure leaves a tree that free_node can free. */
static fw_status build(fw_node **out, yaml_document_t *d, int index, const char *origin, bool has_place, fw_msg *m)
{
    const yaml_node_t *y = yaml_document_get_node(d, index);
    fw_node           *n;

    FW_CHECK(y, m, FW_E_INPUT, "%.200s:1:1: the file is empty", origin);
    FW_TRY(fw_alloc(out, 1, sizeof **out, "node", m));
    n = *out;
    n->origin = origin;
    if (has_place) {
        n->line = y->start_mark.line + 1;
        n->column = y->start_mark.column + 1;
    }
    switch (y->type) {
    case YAML_SCALAR_NODE: n->kind = FW_NODE_SCALAR; return fill_scalar(n, y, m);
    case YAML_SEQUENCE_NODE: n->kind = FW_NODE_LIST; return fill_list(n, d, y, has_place, m);
    case YAML_MAPPING_NODE: n->kind = FW_NODE_MAP; return fill_map(n, d, y, has_place, m);
    default: return fw_yaml_fail(n, m, "this is neither a value, a list nor a map");
    }
}

/* name is what libyaml's own complaints are about; origin goes into the nodes. */
static fw_status parse_tree(fw_node **out, const char *origin, bool has_place, const char *text, size_t n_bytes,
                            fw_msg *m)
{
    yaml_parser_t   parser;
    yaml_document_t document;
    fw_status       status;

    *out = NULL;
    FW_CHECK(n_bytes <= FW_YAML_MAX_BYTES, m, FW_E_INPUT, "%.200s:1:1: longer than %d KiB, wanted less", origin,
             FW_YAML_MAX_BYTES / 1024);
    FW_TRY(check_text(origin, text, n_bytes, m));
    FW_TRY(check_events(origin, text, n_bytes, m));
    FW_CHECK(yaml_parser_initialize(&parser), m, FW_E_NOMEM, "out of memory: reading %.200s", origin);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, n_bytes);
    if (!yaml_parser_load(&parser, &document)) {
        status = fail_parser(origin, &parser, m);
        yaml_parser_delete(&parser);
        return status;
    }
    status = build(out, &document, 1, origin, has_place, m);
    yaml_document_delete(&document);
    yaml_parser_delete(&parser);
    if (status != FW_OK) {
        free_node(*out);
        *out = NULL;
    }
    return status;
}

static fw_status keep_origin(fw_yaml *y, const char *origin, const char **kept, fw_msg *m)
{
    FW_TRY(fw_grow(&y->origins, &y->n_origins_kept, y->n_origins + 1, sizeof *y->origins, "names", m));
    char *copy = fw_strdup(origin);
    FW_CHECK(copy, m, FW_E_NOMEM, "out of memory: name %.200s", origin);
    y->origins[y->n_origins++] = copy;
    *kept = copy;
    return FW_OK;
}

fw_status fw_yaml_parse(fw_yaml *out, const char *name, const char *text, size_t n_bytes, fw_msg *m)
{
    const char *origin = NULL;

    memset(out, 0, sizeof *out);
    fw_status status = keep_origin(out, name, &origin, m);
    if (status == FW_OK) status = parse_tree(&out->root, origin, true, text, n_bytes, m);
    if (status == FW_OK && out->root->kind != FW_NODE_MAP) {
        status = fw_yaml_fail(out->root, m, "this is no map of keys, wanted lines like \"name: raahe\"");
    }
    if (status != FW_OK) fw_yaml_free(out);
    return status;
}

void fw_yaml_free(fw_yaml *y)
{
    if (!y) return;
    free_node(y->root);
    for (size_t i = 0; i < y->n_origins; i++) free(y->origins[i]);
    free(y->origins);
    memset(y, 0, sizeof *y);
}

/* ---- use -------------------------------------------------------------------------------------------------------- */

static size_t find(const fw_node *map, const char *key)
{
    size_t i = 0;

    while (i < map->n && strcmp(map->keys[i]->text, key) != 0) i++;
    return i;
}

const fw_node *fw_yaml_get(const fw_node *map, const char *key)
{
    if (!map || map->kind != FW_NODE_MAP) return NULL;
    size_t i = find(map, key);
    return i < map->n ? map->values[i] : NULL;
}

/* Add key with an empty map as its value; the caller may replace the value. */
static fw_status add_pair(fw_node *map, const char *key, const char *origin, fw_node **value, fw_msg *m)
{
    size_t   capacity_keys = map->n, capacity_values = map->n;
    fw_node *k, *v;

    FW_CHECK(map->n < FW_YAML_MAX_KEYS, m, FW_E_INPUT, "%.200s: more than %d keys in one map", origin,
             FW_YAML_MAX_KEYS);
    FW_TRY(fw_grow(&map->keys, &capacity_keys, map->n + 1, sizeof *map->keys, "map", m));
    FW_TRY(fw_grow(&map->values, &capacity_values, map->n + 1, sizeof *map->values, "map", m));
    FW_TRY(fw_alloc(&k, 1, sizeof *k, "node", m));
    fw_status status = fw_alloc(&v, 1, sizeof *v, "node", m);
    k->text = status == FW_OK ? fw_strdup(key) : NULL;
    if (!k->text) {
        free(status == FW_OK ? v : NULL);
        free(k);
        return fw_fail(m, FW_E_NOMEM, "out of memory: key %.60s", key);
    }
    k->kind = FW_NODE_SCALAR;
    v->kind = FW_NODE_MAP;
    k->origin = v->origin = origin;
    map->keys[map->n] = k;
    map->values[map->n++] = v;
    *value = v;
    return FW_OK;
}

/* Walk path (cut at its dots in place) and put value there; takes value in any case. */
static fw_status put(fw_node *at, char *path, const char *origin, fw_node *value, fw_msg *m)
{
    for (int level = 1;; level++) {
        char    *dot = strchr(path, '.');
        size_t   i = find(at, path);
        fw_node *next = NULL;

        if (dot) {
            *dot = '\0';
            i = find(at, path);
        }
        if (!*path || level > FW_YAML_MAX_LEVELS) {
            free_node(value);
            return fw_fail(m, FW_E_INPUT, "%.200s: wanted dotted.path=value, like ice.concentration=60%%", origin);
        }
        fw_status status = FW_OK;
        if (i < at->n) {
            next = at->values[i];
        } else {
            status = add_pair(at, path, origin, &next, m);
        }
        if (status == FW_OK && dot && next->kind != FW_NODE_MAP) {
            status = fw_fail(m, FW_E_INPUT, "%.200s: \"%.60s\" has no keys below it in the file", origin, path);
        }
        if (status != FW_OK) {
            free_node(value);
            return status;
        }
        if (!dot) {
            i = find(at, path);
            at->keys[i]->origin = origin; /* complaints about this key are about --set from now on */
            at->keys[i]->line = 0;
            free_node(at->values[i]);
            at->values[i] = value;
            return FW_OK;
        }
        at = next;
        path = dot + 1;
    }
}

fw_status fw_yaml_set(fw_yaml *y, const char *assignment, fw_msg *m)
{
    const char *equals = strchr(assignment, '='), *origin = NULL;
    size_t      length = equals ? (size_t)(equals - assignment) : 0;
    char        path[256], name[300];
    fw_node    *value;

    FW_CHECK(length > 0 && length < sizeof path, m, FW_E_INPUT,
             "--set %.100s: wanted dotted.path=value, like ice.concentration=60%%", assignment);
    memcpy(path, assignment, length);
    path[length] = '\0';
    snprintf(name, sizeof name, "--set %.200s", assignment);
    FW_CHECK(equals[1 + strspn(equals + 1, " \t\n")], m, FW_E_INPUT, "%s: there is no value behind =, wanted dotted.path=value", name);
    FW_TRY(keep_origin(y, name, &origin, m));
    FW_TRY(parse_tree(&value, origin, false, equals + 1, strlen(equals + 1), m));
    return put(y->root, path, origin, value, m);
}
