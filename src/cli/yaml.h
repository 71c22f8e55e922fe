/* YAML text to a small tree whose every node knows where it stands. Strict and bounded, since the text may be
 * anybody's.
 *
 * Read is a subset that leaves no surprises: one document, maps with plain unique keys, lists, scalars as text; no
 * anchors, aliases or tags. Bounds: 1 MiB, 32 levels, 400 keys in one map. libyaml's event API checks them before
 * its document loader sees anything, because that one is quadratic on "[[[[". Every refusal comes within a second. */
#ifndef FW_CLI_YAML_H
#define FW_CLI_YAML_H

#include <stdbool.h>
#include <stddef.h>

#include "floewear/status.h"

enum { FW_YAML_MAX_BYTES = 1 << 20, FW_YAML_MAX_LEVELS = 32, FW_YAML_MAX_KEYS = 400 };

typedef enum fw_node_kind { FW_NODE_SCALAR, FW_NODE_LIST, FW_NODE_MAP } fw_node_kind;

typedef struct fw_node {
    fw_node_kind     kind;
    const char      *origin;      /* file name, or "--set path=value"; borrowed from the fw_yaml */
    size_t           line, column;/* from 1; 0: the origin says it all */
    char            *text;        /* of a scalar, NUL-terminated UTF-8; NULL otherwise */
    bool             is_plain;    /* a scalar without quotes */
    size_t           n;           /* items of a list, pairs of a map */
    struct fw_node **values;      /* (n) owned */
    struct fw_node **keys;        /* (n) owned scalars, maps only */
} fw_node;

typedef struct fw_yaml {
    fw_node *root;        /* always a map */
    size_t   n_origins, n_origins_kept;
    char   **origins;     /* (n_origins) owned */
} fw_yaml;

/* The whole file (NUL-terminated). FW_E_IO: it cannot be read; FW_E_INPUT: it is longer than max_bytes. */
fw_status fw_yaml_load_file(const char *path, size_t max_bytes, char **text, size_t *n, fw_msg *m);

/* name is what messages call the text. FW_E_INPUT with "name:line:column: ..."; *out is then empty. */
fw_status fw_yaml_parse(fw_yaml *out, const char *name, const char *text, size_t n_bytes, fw_msg *m);
/* Apply "dotted.path=value": replace or add that node; value is YAML ("60%", "{uniform: [20 %, 40 %]}"). */
fw_status fw_yaml_set(fw_yaml *y, const char *assignment, fw_msg *m);
void      fw_yaml_free(fw_yaml *y); /* a zeroed struct is fine */

const fw_node *fw_yaml_get(const fw_node *map, const char *key); /* NULL: absent */

/* Begin m with the node's place; returns FW_E_INPUT. */
fw_status fw_yaml_fail(const fw_node *at, fw_msg *m, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
/* Put the node's place and "path: " before what m says; returns status as given. */
fw_status fw_yaml_blame(const fw_node *at, const char *path, fw_status status, fw_msg *m);

#endif
