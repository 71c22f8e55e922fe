/* Whose journal is this? The sentence that names what differs between a campaign on disk and the one in hand. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "store/journal_format.h"

enum { MAX_NAMED = 5, N_VALUE = 56 };

typedef struct line {
    const char *text;
    size_t      length, n_key; /* of the whole line, of the key before " = " */
} line;

/* The line that starts at text; an empty one at the end of the settings. */
static line line_at(const char *text)
{
    line l = {.text = text, .length = strcspn(text, "\n")};
    l.n_key = l.length;
    for (size_t i = 0; i + 2 < l.length; i++) {
        if (memcmp(text + i, " = ", 3) == 0) {
            l.n_key = i;
            break;
        }
    }
    return l;
}

static const char *after(line l) { return l.text + l.length + (l.text[l.length] == '\n'); }

static bool is_same(line a, line b) { return a.length == b.length && memcmp(a.text, b.text, a.length) == 0; }

static bool has_same_key(line a, line b) { return a.n_key == b.n_key && memcmp(a.text, b.text, a.n_key) == 0; }

/* The line of `key` in text, starting the search at hint: two texts of one program have their keys in one order, so
 * that the search is over at once, even in a site table of thousands of cells. */
static bool find_key(line *found, const char *text, const char *hint, line key)
{
    for (int part = 0; part < 2; part++) {
        const char *end = part == 0 ? NULL : hint;
        for (const char *at = part == 0 ? hint : text; *at != '\0' && at != end;) {
            line l = line_at(at);
            if (has_same_key(l, key)) {
                *found = l;
                return true;
            }
            at = after(l);
        }
    }
    return false;
}

typedef struct list {
    char   text[900];
    size_t n;       /* differing keys seen */
    size_t n_bytes; /* of text in use */
} list;

static void value_text(char to[N_VALUE + 4], const line *l)
{
    if (l == NULL || l->n_key == l->length) {
        strcpy(to, l == NULL ? "nothing" : "?");
        return;
    }
    const char *value = l->text + l->n_key + 3;
    size_t      n = l->length - l->n_key - 3;
    snprintf(to, N_VALUE + 4, "%.*s%s", (int)(n < N_VALUE ? n : N_VALUE), value, n > N_VALUE ? "..." : "");
}

static void add(list *out, line key, const line *there, const line *wanted)
{
    out->n++;
    if (out->n > MAX_NAMED) return;
    char a[N_VALUE + 4], b[N_VALUE + 4];
    value_text(a, there);
    value_text(b, wanted);
    int n = snprintf(out->text + out->n_bytes, sizeof out->text - out->n_bytes, "%s%.*s (journal: %s, campaign: %s)",
                     out->n > 1 ? "; " : "", (int)(key.n_key < 48 ? key.n_key : 48), key.text, a, b);
    if (n > 0) {
        size_t room = sizeof out->text - out->n_bytes - 1;
        out->n_bytes += (size_t)n < room ? (size_t)n : room;
    }
}

static void list_differences(list *out, const char *there, const char *wanted)
{
    const char *hint = wanted;
    for (const char *at = there; *at != '\0';) {
        line a = line_at(at), b;
        if (a.length > 0) {
            bool is_found = find_key(&b, wanted, hint, a);
            if (is_found) hint = after(b);
            if (!is_found || !is_same(a, b)) add(out, a, &a, is_found ? &b : NULL);
        }
        at = after(a);
    }
    hint = there;
    for (const char *at = wanted; *at != '\0';) {
        line b = line_at(at), a;
        if (b.length > 0) {
            bool is_found = find_key(&a, there, hint, b);
            if (is_found)
                hint = after(a);
            else
                add(out, b, NULL, &b);
        }
        at = after(b);
    }
}

fw_status fw_journal_header_match(const fw_journal_header *there, const fw_journal_header *wanted, const char *path,
                                  fw_msg *m)
{
    if (there->hash == wanted->hash && there->seed == wanted->seed && there->n_arcs == wanted->n_arcs &&
        there->n_laws == wanted->n_laws && strcmp(there->settings, wanted->settings) == 0) {
        return FW_OK;
    }
    list l = {.n = 0};
    list_differences(&l, there->settings, wanted->settings);
    if (l.n == 0) {
        /* equal texts under another hash or seed: name what is left */
        return fw_fail(m, FW_E_MISMATCH,
                       "%s belongs to another campaign (journal: hash %016" PRIx64 ", seed %" PRIu64
                       "; campaign: hash %016" PRIx64 ", seed %" PRIu64 "); use another output name or --fresh",
                       path, there->hash, there->seed, wanted->hash, wanted->seed);
    }
    char more[32] = "";
    if (l.n > MAX_NAMED) snprintf(more, sizeof more, "; and %zu more", l.n - MAX_NAMED);
    return fw_fail(m, FW_E_MISMATCH,
                   "%s belongs to another campaign; use another output name or --fresh. What differs: %s%s", path,
                   l.text, more);
}
