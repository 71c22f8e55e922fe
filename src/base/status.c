#include "floewear/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int         exit_code;
    const char *sentence;
} rows[FW_N_STATUS] = {
#define X(name, exit_code, sentence) {#name, exit_code, sentence},
    FW_STATUS_LIST(X)
#undef X
};

static bool is_known(fw_status s)
{
    return (int)s >= 0 && (int)s < FW_N_STATUS; /* a status read from a damaged file may be anything */
}

const char *fw_status_name(fw_status s) { return is_known(s) ? rows[s].name : "FW_E_UNKNOWN"; }

const char *fw_status_sentence(fw_status s) { return is_known(s) ? rows[s].sentence : "an unknown status"; }

int fw_status_exit_code(fw_status s) { return is_known(s) ? rows[s].exit_code : rows[FW_E_INTERNAL].exit_code; }

/* n is what snprintf returned for a buffer of size bytes: mark a cut, so that nobody takes a half sentence for a
 * whole one. Step back over UTF-8 continuation bytes to cut between characters. */
static void mark_cut(char *text, size_t size, int n)
{
    static const char dots[] = "...";

    if (n < 0) {
        text[0] = '\0';
        return;
    }
    if ((size_t)n < size) return;
    size_t end = size - sizeof dots;
    while (end > 0 && ((unsigned char)text[end] & 0xc0) == 0x80) end--;
    memcpy(text + end, dots, sizeof dots);
}

fw_status fw_fail(fw_msg *m, fw_status code, const char *fmt, ...)
{
    if (m) {
        va_list ap;
        va_start(ap, fmt);
        mark_cut(m->text, sizeof m->text, vsnprintf(m->text, sizeof m->text, fmt, ap));
        va_end(ap);
    }
    return code;
}

void fw_msg_prefix(fw_msg *m, const char *fmt, ...)
{
    if (!m) return;

    fw_msg  said = *m;
    va_list ap;
    va_start(ap, fmt);
    int n = vsnprintf(m->text, sizeof m->text, fmt, ap);
    va_end(ap);
    if (n < 0) {
        *m = said;
        return;
    }
    if ((size_t)n >= sizeof m->text) {
        mark_cut(m->text, sizeof m->text, n);
        return;
    }
    size_t left = sizeof m->text - (size_t)n, length = strlen(said.text);
    memcpy(m->text + n, said.text, length < left ? length + 1 : left);
    if (length >= left) {
        m->text[sizeof m->text - 1] = '\0';
        mark_cut(m->text, sizeof m->text, (int)(sizeof m->text));
    }
}
