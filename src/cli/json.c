#include "cli/json.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Containers this deep or deeper stay on one line: a table's row is one line, the table itself is not. */
enum { DEPTH_ON_ONE_LINE = 2 };

static void new_line(fw_json *j)
{
    if (j->depth > DEPTH_ON_ONE_LINE) return;
    fputc('\n', j->to);
    for (unsigned i = 0; i < j->depth; i++) fputs("  ", j->to);
}

/* Whatever stands before a key or a value in the open container: comma, line, indentation. */
static void separate(fw_json *j)
{
    if (j->depth == 0) return;
    if (j->has_items[j->depth - 1]) fputs(j->depth > DEPTH_ON_ONE_LINE ? ", " : ",", j->to);
    j->has_items[j->depth - 1] = 1;
    new_line(j);
}

static void before_value(fw_json *j)
{
    if (j->is_after_key) {
        j->is_after_key = false;
        return;
    }
    assert(j->depth == 0 || !j->is_object[j->depth - 1]);
    separate(j);
}

static void after_value(fw_json *j)
{
    if (j->depth == 0) fputc('\n', j->to);
}

/* Length of the valid UTF-8 sequence at s, 0 when there is none (overlong forms, surrogates and > U+10FFFF are
 * none). */
static size_t utf8_length(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    size_t   n = (s[0] & 0xe0) == 0xc0 ? 2 : (s[0] & 0xf0) == 0xe0 ? 3 : (s[0] & 0xf8) == 0xf0 ? 4 : 0;
    unsigned code = n == 2 ? s[0] & 0x1fu : n == 3 ? s[0] & 0x0fu : s[0] & 0x07u;
    for (size_t i = 1; i < n; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0; /* the NUL at the end stops here too */
        code = code << 6 | (s[i] & 0x3fu);
    }
    if (n == 2 && code < 0x80) return 0;
    if (n == 3 && (code < 0x800 || (code >= 0xd800 && code <= 0xdfff))) return 0;
    if (n == 4 && (code < 0x10000 || code > 0x10ffff)) return 0;
    return n;
}

static void write_string(FILE *to, const char *text)
{
    fputc('"', to);
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        size_t n = utf8_length(s);
        if (n == 0) {
            fputs("\\ufffd", to);
            s++;
            continue;
        }
        if (*s == '"' || *s == '\\') {
            fputc('\\', to);
            fputc(*s, to);
        } else if (*s == '\n') {
            fputs("\\n", to);
        } else if (*s == '\t') {
            fputs("\\t", to);
        } else if (*s < 0x20 || *s == 0x7f) {
            fprintf(to, "\\u%04x", *s);
        } else {
            fwrite(s, 1, n, to);
        }
        s += n;
    }
    fputc('"', to);
}

static void begin(fw_json *j, char bracket, unsigned char is_object)
{
    before_value(j);
    assert(j->depth < FW_JSON_DEPTH);
    fputc(bracket, j->to);
    j->is_object[j->depth] = is_object;
    j->has_items[j->depth] = 0;
    j->depth++;
}

fw_json fw_json_onto(FILE *to)
{
    fw_json j;
    memset(&j, 0, sizeof j);
    j.to = to;
    return j;
}

void fw_json_begin_object(fw_json *j) { begin(j, '{', 1); }
void fw_json_begin_array(fw_json *j) { begin(j, '[', 0); }

void fw_json_end(fw_json *j)
{
    assert(j->depth > 0 && !j->is_after_key);
    unsigned inner = j->depth - 1;
    bool     breaks = j->has_items[inner] && j->depth <= DEPTH_ON_ONE_LINE;
    j->depth = inner;
    if (breaks) new_line(j);
    fputc(j->is_object[inner] ? '}' : ']', j->to);
    after_value(j);
}

void fw_json_key(fw_json *j, const char *key)
{
    assert(j->depth > 0 && j->is_object[j->depth - 1] && !j->is_after_key);
    separate(j);
    write_string(j->to, key);
    fputs(": ", j->to);
    j->is_after_key = true;
}

void fw_json_number(fw_json *j, double x)
{
    if (!isfinite(x)) {
        fw_json_null(j);
        return;
    }
    before_value(j);
    fprintf(j->to, "%.17g", x);
    after_value(j);
}

void fw_json_integer(fw_json *j, int64_t x)
{
    before_value(j);
    fprintf(j->to, "%lld", (long long)x);
    after_value(j);
}

void fw_json_string(fw_json *j, const char *s)
{
    if (!s) {
        fw_json_null(j);
        return;
    }
    before_value(j);
    write_string(j->to, s);
    after_value(j);
}

void fw_json_bool(fw_json *j, bool x)
{
    before_value(j);
    fputs(x ? "true" : "false", j->to);
    after_value(j);
}

void fw_json_null(fw_json *j)
{
    before_value(j);
    fputs("null", j->to);
    after_value(j);
}

void fw_json_put_number(fw_json *j, const char *key, double x) { fw_json_key(j, key), fw_json_number(j, x); }
void fw_json_put_integer(fw_json *j, const char *key, int64_t x) { fw_json_key(j, key), fw_json_integer(j, x); }
void fw_json_put_string(fw_json *j, const char *key, const char *s) { fw_json_key(j, key), fw_json_string(j, s); }
void fw_json_put_bool(fw_json *j, const char *key, bool x) { fw_json_key(j, key), fw_json_bool(j, x); }
