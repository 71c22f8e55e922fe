#include "base/keys.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_NAME = 48, MAX_QUOTE = 60 };

const fw_key *fw_keys_find(const fw_section *s, const char *name)
{
    for (size_t i = 0; i < s->n_keys; i++) {
        if (strcmp(s->keys[i].name, name) == 0) return &s->keys[i];
    }
    return NULL;
}

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c == '-' ? '_' : c; }

/* Edit distance with swaps of neighbours (optimal string alignment), case and -/_ aside; names are short. */
static size_t distance(const char *a, const char *b)
{
    size_t n = strlen(a), k = strlen(b), rows[3][MAX_NAME + 1];

    if (n > MAX_NAME || k > MAX_NAME) return MAX_NAME;
    for (size_t j = 0; j <= k; j++) rows[0][j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t *now = rows[i % 3], *before = rows[(i + 2) % 3], *older = rows[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= k; j++) {
            bool   is_same = lower(a[i - 1]) == lower(b[j - 1]);
            size_t best = before[j - 1] + !is_same;
            if (before[j] + 1 < best) best = before[j] + 1;
            if (now[j - 1] + 1 < best) best = now[j - 1] + 1;
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]) &&
                older[j - 2] + 1 < best) {
                best = older[j - 2] + 1;
            }
            now[j] = best;
        }
    }
    return rows[n % 3][k];
}

/* A third of the letters may be wrong, at least one; or one name begins with the whole other ("temp"). */
static size_t mismatch(const char *name, const char *wrong)
{
    size_t n = strlen(name), k = strlen(wrong), d = distance(name, wrong), allowed = (n > k ? n : k) / 3;

    if (d <= (allowed ? allowed : 1)) return d;
    if (n >= 3 && k >= 3 && strncmp(name, wrong, n < k ? n : k) == 0) return MAX_NAME - 1;
    return MAX_NAME;
}

const char *fw_keys_nearest_word(size_t n, const char *const *names, const char *wrong)
{
    const char *nearest = NULL;
    size_t      least = MAX_NAME;

    for (size_t i = 0; i < n; i++) {
        size_t d = mismatch(names[i], wrong);
        if (d < least) {
            least = d;
            nearest = names[i];
        }
    }
    return nearest;
}

const char *fw_keys_nearest(const fw_section *s, const char *wrong)
{
    const char *nearest = NULL;
    size_t      least = MAX_NAME;

    for (size_t i = 0; i < s->n_keys; i++) {
        size_t d = mismatch(s->keys[i].name, wrong);
        if (d < least) {
            least = d;
            nearest = s->keys[i].name;
        }
    }
    return nearest;
}

/* "1" is the unit of plain numbers and is not written behind them. */
static const char *shown_unit(const fw_key *k) { return k->unit && strcmp(k->unit, "1") != 0 ? k->unit : ""; }

void fw_keys_range(const fw_key *k, char *out, size_t size)
{
    const char *unit = shown_unit(k), *gap = *unit ? " " : "";
    bool        has_least = k->least > -INFINITY, has_most = k->most < INFINITY;
    char        least[96] = "", most[96] = "";

    out[0] = '\0';
    if (k->kind == FW_KEY_CHOICE || k->kind == FW_KEY_FLAG || k->kind == FW_KEY_TEXT || k->kind == FW_KEY_SHAPED)
        return;
    if (has_least)
        snprintf(least, sizeof least, "%s %.15g%s%s", k->is_open ? "more than" : "at least", k->least, gap, unit);
    if (has_most) snprintf(most, sizeof most, "at most %.15g%s%s", k->most, gap, unit);
    snprintf(out, size, "%s%s%s", least, has_least && has_most ? " and " : "", most);
}

static fw_status check_range(const fw_key *k, const char *text, double x, fw_msg *m)
{
    char range[200];
    bool is_low = k->is_open ? !(x > k->least) : !(x >= k->least);

    if (!is_low && x <= k->most) return FW_OK;
    fw_keys_range(k, range, sizeof range);
    return fw_fail(m, FW_E_INPUT, "\"%.*s\" is out of range, wanted %s", MAX_QUOTE, text, range);
}

static fw_status read_count(const fw_key *k, const char *text, uint64_t *value, fw_msg *m)
{
    uint64_t x = 0;

    FW_CHECK(*text && strspn(text, "0123456789") == strlen(text), m, FW_E_INPUT, "\"%.*s\" is not a whole number",
             MAX_QUOTE, text);
    for (const char *p = text; *p; p++) {
        uint64_t digit = (uint64_t)(*p - '0');
        FW_CHECK(x <= (UINT64_MAX - digit) / 10, m, FW_E_INPUT, "\"%.*s\" is beyond the range of whole numbers",
                 MAX_QUOTE, text);
        x = 10 * x + digit;
    }
    FW_TRY(check_range(k, text, (double)x, m));
    *value = x;
    return FW_OK;
}

static fw_status read_flag(const char *text, bool *value, fw_msg *m)
{
    static const char *const words[] = {"off", "on", "false", "true", "no", "yes"};

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(text, words[i]) == 0) {
            *value = i % 2;
            return FW_OK;
        }
    }
    return fw_fail(m, FW_E_INPUT, "\"%.*s\": wanted on or off", MAX_QUOTE, text);
}

/* The i-th word of "number|area", its length in *n; NULL behind the last. */
static const char *word_at(const char *words, int i, size_t *n)
{
    for (; i > 0; i--) {
        words = strchr(words, '|');
        if (!words) return NULL;
        words++;
    }
    *n = strcspn(words, "|");
    return words;
}

static fw_status read_choice(const fw_key *k, const char *text, int *value, fw_msg *m)
{
    const char *word;
    size_t      n;

    for (int i = 0; (word = word_at(k->words, i, &n)); i++) {
        if (strlen(text) == n && memcmp(word, text, n) == 0) {
            *value = i;
            return FW_OK;
        }
    }
    return fw_fail(m, FW_E_INPUT, "\"%.*s\": wanted one of %s", MAX_QUOTE, text, k->words);
}

static const char *auto_word(const fw_key *k) { return k->words ? k->words : "auto"; }

static fw_status read_number(const fw_key *k, const fw_units *u, const char *text, double *value, fw_msg *m)
{
    double x;

    if (k->kind == FW_KEY_AUTO && strcmp(text, auto_word(k)) == 0) {
        *value = -1;
        return FW_OK;
    }
    FW_TRY(fw_units_read(u, text, k->unit, &x, m));
    FW_TRY(check_range(k, text, x, m));
    *value = x;
    return FW_OK;
}

fw_status fw_keys_read(const fw_key *k, const fw_units *u, const char *text, void *base, fw_msg *m)
{
    void *member = (char *)base + k->offset;

    switch (k->kind) {
    case FW_KEY_NUMBER:
    case FW_KEY_AUTO: return read_number(k, u, text, member, m);
    case FW_KEY_COUNT: return read_count(k, text, member, m);
    case FW_KEY_FLAG: return read_flag(text, member, m);
    case FW_KEY_CHOICE: return read_choice(k, text, member, m);
    case FW_KEY_TEXT:
        FW_CHECK(strlen(text) < FW_KEY_TEXT_SIZE, m, FW_E_INPUT, "\"%.*s...\" is longer than %d bytes", MAX_QUOTE, text,
                 FW_KEY_TEXT_SIZE - 1);
        memcpy(member, text, strlen(text) + 1);
        return FW_OK;
    case FW_KEY_SHAPED: break;
    }
    return fw_fail(m, FW_E_INTERNAL, "key %s has a reader of its own", k->name);
}

fw_status fw_keys_defaults(const fw_section *s, const fw_units *u, void *base, fw_msg *m)
{
    for (size_t i = 0; i < s->n_keys; i++) {
        const fw_key *k = &s->keys[i];
        if (k->kind == FW_KEY_SHAPED || !k->fallback || !*k->fallback) continue;
        fw_status status = fw_keys_read(k, u, k->fallback, base, m);
        if (status != FW_OK) {
            fw_msg_prefix(m, "default of %s.%s: ", s->name, k->name);
            return status;
        }
    }
    return FW_OK;
}

int fw_keys_print(const fw_section *s, const fw_key *k, const void *base, char *out, size_t size)
{
    const char *member = (const char *)base + k->offset, *dot = *s->name ? "." : "", *word = "";
    const char *unit = shown_unit(k), *gap = *unit ? " " : "";
    double      x;
    uint64_t    n;
    bool        flag;
    int         choice;
    size_t      length = 0;

    switch (k->kind) {
    case FW_KEY_NUMBER:
    case FW_KEY_AUTO:
        memcpy(&x, member, sizeof x);
        if (k->kind == FW_KEY_AUTO && x < 0) return snprintf(out, size, "%s%s%s = %s\n", s->name, dot, k->name, auto_word(k));
        return snprintf(out, size, "%s%s%s = %.17g%s%s\n", s->name, dot, k->name, x, gap, unit);
    case FW_KEY_COUNT:
        memcpy(&n, member, sizeof n);
        return snprintf(out, size, "%s%s%s = %" PRIu64 "\n", s->name, dot, k->name, n);
    case FW_KEY_FLAG:
        memcpy(&flag, member, sizeof flag);
        return snprintf(out, size, "%s%s%s = %s\n", s->name, dot, k->name, flag ? "on" : "off");
    case FW_KEY_CHOICE:
        memcpy(&choice, member, sizeof choice);
        word = word_at(k->words, choice, &length);
        return snprintf(out, size, "%s%s%s = %.*s\n", s->name, dot, k->name, (int)length, word ? word : "");
    case FW_KEY_TEXT: return snprintf(out, size, "%s%s%s = %s\n", s->name, dot, k->name, member);
    case FW_KEY_SHAPED: break;
    }
    if (size) out[0] = '\0';
    return 0;
}
