/* A small JSON writer onto a FILE: what `--json` prints.
 *
 * The writer keeps commas, indentation and nesting right; the caller gives keys and values in order:
 *
 *     fw_json j = fw_json_onto(stdout);
 *     fw_json_begin_object(&j);
 *         fw_json_key(&j, "campaign"); fw_json_string(&j, c->name);
 *         fw_json_key(&j, "n");        fw_json_integer(&j, n);
 *         fw_json_key(&j, "points");   fw_json_begin_array(&j); ... fw_json_end(&j);
 *     fw_json_end(&j);                 // the outermost end writes the newline
 *
 * Numbers are printed with %.17g, so that a reader gets the same double back; what is not finite becomes null, because
 * JSON has no other word for "does not exist". Strings are UTF-8; a byte that is not is written as U+FFFD.
 * Containers nest up to FW_JSON_DEPTH deep. Write errors stay in the FILE (ferror), as with printf. */
#ifndef FW_CLI_JSON_H
#define FW_CLI_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { FW_JSON_DEPTH = 32 };

typedef struct fw_json {
    FILE         *to;
    unsigned      depth;
    bool          is_after_key;
    unsigned char is_object[FW_JSON_DEPTH]; /* of the open containers, outermost first */
    unsigned char has_items[FW_JSON_DEPTH];
} fw_json;

fw_json fw_json_onto(FILE *to);

void fw_json_begin_object(fw_json *j);
void fw_json_begin_array(fw_json *j);
void fw_json_end(fw_json *j); /* of the innermost open object or array */

void fw_json_key(fw_json *j, const char *key); /* in an object, before each value */

void fw_json_number(fw_json *j, double x);
void fw_json_integer(fw_json *j, int64_t x);
void fw_json_string(fw_json *j, const char *s); /* NULL becomes null */
void fw_json_bool(fw_json *j, bool x);
void fw_json_null(fw_json *j);

/* A key and its value. */
void fw_json_put_number(fw_json *j, const char *key, double x);
void fw_json_put_integer(fw_json *j, const char *key, int64_t x);
void fw_json_put_string(fw_json *j, const char *key, const char *s);
void fw_json_put_bool(fw_json *j, const char *key, bool x);

#endif
