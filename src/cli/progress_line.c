#include "cli/progress_line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static const double line_first_s = 10.0, line_latest_s = 50.0, line_every_s = 60.0; /* in a log [s] */

void fw_progress_line_start(fw_progress_line *l, FILE *to, bool is_quiet)
{
    const char *kind = getenv("TERM");

    memset(l, 0, sizeof *l);
    l->to          = to;
    l->is_quiet    = is_quiet;
    l->is_terminal = isatty(fileno(to)) && kind && strcmp(kind, "dumb") != 0;
    l->last_s      = -1.0;
}

/* "45 s", "12 min", "3.5 h", "2.1 d": two digits are all that an estimate is worth. */
static void line_time(double s, char *out, size_t size)
{
    if (!isfinite(s)) {
        snprintf(out, size, "?");
    } else if (s < 100.0) {
        snprintf(out, size, "%.0f s", s);
    } else if (s < 100.0 * 60.0) {
        snprintf(out, size, "%.0f min", s / 60.0);
    } else if (s < 48.0 * 3600.0) {
        snprintf(out, size, "%.1f h", s / 3600.0);
    } else {
        snprintf(out, size, "%.1f d", s / 86400.0);
    }
}

static void line_rate(double per_s, char *out, size_t size)
{
    if (per_s >= 1.0) {
        snprintf(out, size, "%.3g/s", per_s);
    } else if (per_s * 60.0 >= 1.0) {
        snprintf(out, size, "%.3g/min", per_s * 60.0);
    } else {
        snprintf(out, size, "%.3g/h", per_s * 3600.0);
    }
}

void fw_progress_line_format(const fw_progress_line *l, const fw_progress *p, char *out, size_t size)
{
    char pace[96] = "", gone[48] = "", rate[32], eta[32], elapsed[32];

    line_rate(p->rate_per_s, rate, sizeof rate);
    line_time(p->eta_s, eta, sizeof eta);
    line_time(p->elapsed_s, elapsed, sizeof elapsed);
    if (p->rate_per_s > 0.0) snprintf(pace, sizeof pace, ", %s, %s to go", rate, eta);
    if (!l->is_terminal) snprintf(gone, sizeof gone, "%s: ", elapsed); /* in a log there is no clock beside it */
    snprintf(out, size, "%s%llu/%llu done, %llu failed%s%s%s", gone, (unsigned long long)p->done,
             (unsigned long long)p->total, (unsigned long long)p->failed, pace, l->estimate[0] ? "; " : "",
             l->estimate);
}

static size_t line_columns(const fw_progress_line *l)
{
    struct winsize w = {0};

    return ioctl(fileno(l->to), TIOCGWINSZ, &w) == 0 && w.ws_col > 1 ? w.ws_col : 80;
}

void fw_progress_line_show(fw_progress_line *l, const fw_progress *p)
{
    char   text[400];
    size_t columns;

    if (l->is_quiet) return;
    if (l->is_terminal) {
        columns = line_columns(l);
        /* one short of the width: a terminal that wraps would leave the old line behind */
        fw_progress_line_format(l, p, text, columns < sizeof text ? columns : sizeof text);
        fprintf(l->to, "\r%s\033[K", text);
        fflush(l->to);
        l->is_open = true;
        return;
    }
    if (l->last_s < 0.0) {
        if (p->elapsed_s < line_first_s || (!l->estimate[0] && p->elapsed_s < line_latest_s)) return;
    } else if (p->elapsed_s - l->last_s < line_every_s) {
        return;
    }
    l->last_s = p->elapsed_s;
    fw_progress_line_format(l, p, text, sizeof text);
    fprintf(l->to, "%s\n", text);
    fflush(l->to);
}

void fw_progress_line_end(fw_progress_line *l)
{
    if (l->is_open) fputc('\n', l->to);
    if (l->is_open) fflush(l->to);
    l->is_open = false;
}
