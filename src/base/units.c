#include "base/units.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

#include "base/memory.h"

enum { MAX_UNIT = 64, MAX_QUOTE = 60 };

struct fw_units {
    ut_system *system;
};

fw_status fw_units_open(fw_units **out, fw_msg *m)
{
    *out = NULL;
    ut_set_error_message_handler(ut_ignore);
    FW_TRY(fw_alloc(out, 1, sizeof **out, "unit system", m));
    (*out)->system = ut_read_xml(NULL);
    if (!(*out)->system) {
        free(*out);
        *out = NULL;
        return fw_fail(m, FW_E_IO,
                       "the unit database of UDUNITS-2 cannot be read: install its data or set UDUNITS2_XML_PATH");
    }
    return FW_OK;
}

void fw_units_close(fw_units *u)
{
    if (!u) return;
    ut_free_system(u->system);
    free(u);
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
static bool is_blank(char c) { return c == ' ' || c == '\t'; }

/* The end of a decimal number at s, or s when there is none. By hand, because strtod takes "nan", "inf" and "0x1p3"
 * too. */
static const char *number_end(const char *s)
{
    const char *p = s, *digits;

    if (*p == '+' || *p == '-') p++;
    digits = p;
    while (is_digit(*p)) p++;
    size_t n = (size_t)(p - digits);
    if (*p == '.') {
        const char *fraction = ++p;
        while (is_digit(*p)) p++;
        n += (size_t)(p - fraction);
    }
    if (n == 0) return s;
    if (*p == 'e' || *p == 'E') { /* an exponent only with digits: in "5 eV" and "5e" the e belongs to the unit */
        const char *e = p + 1;
        if (*e == '+' || *e == '-') e++;
        if (is_digit(*e)) {
            while (is_digit(*e)) e++;
            p = e;
        }
    }
    return p;
}

static fw_status read_number(const char *text, double *value, const char **rest, fw_msg *m)
{
    const char *start = text, *end;
    char       *stop;

    while (is_blank(*start)) start++;
    end = number_end(start);
    FW_CHECK(end != start, m, FW_E_INPUT, "\"%.*s\" is not a number", MAX_QUOTE, text);
    errno = 0;
    double x = strtod(start, &stop);
    FW_CHECK(stop == end, m, FW_E_INPUT, "\"%.*s\" is not a decimal number", MAX_QUOTE, text);
    FW_CHECK(errno != ERANGE && isfinite(x), m, FW_E_INPUT, "\"%.*s\" is beyond the range of numbers", MAX_QUOTE, text);
    *value = x;
    *rest = end;
    return FW_OK;
}

fw_status fw_units_number(const char *text, double *value, fw_msg *m)
{
    const char *rest;
    double      x;

    FW_TRY(read_number(text, &x, &rest, m));
    while (is_blank(*rest)) rest++;
    FW_CHECK(!*rest, m, FW_E_INPUT, "\"%.*s\": \"%.*s\" follows the number, wanted a bare number", MAX_QUOTE, text,
             MAX_QUOTE, rest);
    *value = x;
    return FW_OK;
}

/* Words that UDUNITS does not know or means differently. */
static const char *rename_word(const char *word, size_t n)
{
    static const char *const rows[][2] = {
        {"deg", "degree"},      {"degs", "degree"},    {"year", "(365.25 day)"}, {"years", "(365.25 day)"},
        {"yr", "(365.25 day)"}, {"a", "(365.25 day)"}, {"Ns", "(N.s)"},          {"kNs", "(kN.s)"},
        {"MNs", "(MN.s)"},      {"Nm", "(N.m)"},       {"kNm", "(kN.m)"},        {"MNm", "(MN.m)"},
        {"Pas", "(Pa.s)"},
    };

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strlen(rows[i][0]) == n && memcmp(rows[i][0], word, n) == 0) return rows[i][1];
    }
    return NULL;
}

/* Copy a unit for UDUNITS, words renamed. false: a character or a number where a unit has none. */
static bool rewrite_unit(const char *unit, size_t length, char *out, size_t size)
{
    size_t n = 0, i = 0;

    while (i < length) {
        if (is_letter(unit[i]) || unit[i] == '%') {
            size_t word = 1;
            while (unit[i] != '%' && i + word < length && (is_letter(unit[i + word]) || unit[i + word] == '_')) word++;
            const char *new = rename_word(unit + i, word);
            int written = new ? snprintf(out + n, size - n, "%s", new)
                              : snprintf(out + n, size - n, "%.*s", (int)word, unit + i);
            if (written < 0 || (size_t)written >= size - n) return false;
            n += (size_t)written;
            i += word;
            continue;
        }
        char c = unit[i], before = i ? unit[i - 1] : '\0';
        bool is_allowed;
        if (is_digit(c)) { /* an exponent, or the 1 of "1/s" */
            is_allowed = is_letter(before) || before == '^' || before == '-' || before == '+' ||
                         (is_digit(before) && i > 1) || (i == 0 && c == '1' && (length == 1 || !is_digit(unit[1])));
        } else if (c == '-' || c == '+') {
            is_allowed = (is_letter(before) || before == '^') && i + 1 < length && is_digit(unit[i + 1]);
        } else {
            is_allowed = i > 0 && strchr(" /*.^", c);
        }
        if (!is_allowed || n + 2 > size) return false;
        out[n++] = c;
        i++;
    }
    out[n] = '\0';
    return n > 0;
}

static ut_unit *parse_unit(const fw_units *u, const char *unit, size_t length)
{
    char text[4 * MAX_UNIT];

    if (length == 0 || length > MAX_UNIT || !rewrite_unit(unit, length, text, sizeof text)) return NULL;
    return ut_parse(u->system, text, UT_ASCII);
}

/* UDUNITS calls angles dimensionless; here a number of radians and a plain number are different things. */
static bool is_angular(const ut_unit *unit)
{
    char text[128];
    int  n = ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION);

    return n > 0 && (size_t)n < sizeof text && strstr(text, "rad");
}

/* x f, rounded as a reader expects: 7 % is the double nearest to 0.07, which 7 * 0.01 is not, while 7 / 100 is. */
static double scaled(double x, double f)
{
    double up = round(f), down = round(1 / f);

    if (fabs(f) >= 1) return fabs(f - up) <= 1e-13 * fabs(f) ? x * up : x * f;
    return fabs(1 / f - down) <= 1e-13 * fabs(1 / f) ? x / down : x * f;
}

static bool convert(const ut_unit *from, const ut_unit *to, bool is_affine, double x, double *value)
{
    cv_converter *c;

    if (is_angular(from) != is_angular(to) || !ut_are_convertible(from, to)) return false;
    c = ut_get_converter((ut_unit *)from, (ut_unit *)to);
    if (!c) return false;
    double offset = cv_convert_double(c, 0), factor = cv_convert_double(c, 1) - offset;
    /* The difference of two rounded numbers near 300 carries their rounding; K to degC is exactly 1. */
    if (fabs(factor - 1) < 1e-12) factor = 1;
    *value = is_affine ? (offset == 0 ? scaled(x, factor) : cv_convert_double(c, x)) : scaled(x, factor);
    cv_free(c);
    return true;
}

static fw_status convert_text(const fw_units *u, const char *text, const char *given, size_t length, const char *unit,
                              double x, double *value, fw_msg *m)
{
    bool     is_affine = strcmp(unit, "degC") == 0;
    ut_unit *to = parse_unit(u, unit, strlen(unit)), *from = parse_unit(u, given, length);
    double   y = NAN;
    bool     is_known = from != NULL, is_done = from && to && convert(from, to, is_affine, x, &y);

    if (from) ut_free(from);
    if (to) ut_free(to);
    FW_CHECK(to, m, FW_E_INTERNAL, "\"%s\" is no unit of a key", unit);
    FW_CHECK(is_known, m, FW_E_INPUT, "\"%.*s\": \"%.*s\" is no unit, wanted %s", MAX_QUOTE, text,
             (int)(length < MAX_QUOTE ? length : MAX_QUOTE), given,
             strcmp(unit, "1") == 0 ? "a plain number or %" : unit);
    if (!is_done && strcmp(unit, "1") == 0) {
        return fw_fail(m, FW_E_INPUT, "\"%.*s\": wrong unit \"%.*s\", wanted a plain number or %%", MAX_QUOTE, text,
                       (int)length, given);
    }
    FW_CHECK(is_done, m, FW_E_INPUT, "\"%.*s\": wrong unit \"%.*s\", wanted one like %s", MAX_QUOTE, text, (int)length,
             given, unit);
    FW_CHECK(isfinite(y), m, FW_E_INPUT, "\"%.*s\" is beyond the range of numbers in %s", MAX_QUOTE, text, unit);
    *value = y;
    return FW_OK;
}

fw_status fw_units_read(const fw_units *u, const char *text, const char *unit, double *value, fw_msg *m)
{
    const char *given;
    double      x;

    FW_TRY(read_number(text, &x, &given, m));
    while (is_blank(*given)) given++;
    size_t length = strlen(given);
    while (length > 0 && is_blank(given[length - 1])) length--;
    if (length == 0) {
        FW_CHECK(strcmp(unit, "1") == 0, m, FW_E_INPUT, "\"%.*s\" has no unit, wanted for example \"%.*s %s\"",
                 MAX_QUOTE, text, (int)(given - text < MAX_QUOTE ? given - text : MAX_QUOTE), text, unit);
        *value = x;
        return FW_OK;
    }
    return convert_text(u, text, given, length, unit, x, value, m);
}
