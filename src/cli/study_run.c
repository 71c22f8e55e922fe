#include "cli/study_run.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/clock.h"
#include "campaign/signals.h"
#include "store/tables.h"

fw_status fw_study_check_place(const char *path, const char *filetype, fw_msg *m)
{
    char        folder[4096];
    const char *slash = strrchr(path, '/');
    struct stat s;
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash == path ? 1 : slash - path) : 1, slash ? path : ".");
    FW_CHECK(stat(folder, &s) == 0, m, FW_E_IO, "-o: the folder %s cannot be used: %s", folder, strerror(errno));
    FW_CHECK(S_ISDIR(s.st_mode), m, FW_E_IO, "-o: %s is not a folder", folder);
    FW_CHECK(access(folder, W_OK) == 0, m, FW_E_IO, "-o: the folder %s cannot be written: %s", folder, strerror(errno));
    return fw_tables_check_kind(path, filetype, m);
}

/* The launcher says so in the environment, whoever's it is. */
fw_status fw_study_check_alone(fw_msg *m)
{
    static const char *const NAMES[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++) {
        const char *n = getenv(NAMES[i]);
        FW_CHECK(!n || strtol(n, NULL, 10) <= 1, m, FW_E_INPUT, "it runs on one core: start it without mpirun (it measures CPU time)");
    }
    return FW_OK;
}

fw_study_watch fw_study_watch_start(double budget_s, bool is_quiet)
{
    double now = fw_seconds();
    return (fw_study_watch){.start = now, .said = now, .budget_s = budget_s, .is_quiet = is_quiet, .is_terminal = isatty(STDERR_FILENO)};
}

static fw_status look(void *self, double done)
{
    const fw_study_watch *w = self;
    (void)done;
    if (fw_signals_received()) return FW_E_STOPPED;
    return w->budget_s > 0 && fw_seconds() - w->start > w->budget_s ? FW_E_STOPPED : FW_OK;
}

fw_tick fw_study_watch_tick(fw_study_watch *w) { return (fw_tick){.call = look, .self = w}; }

void fw_study_watch_say(void *self, const char *what)
{
    fw_study_watch *w = self;
    double          now = fw_seconds();
    if (w->is_quiet || (!w->is_terminal && now - w->said < 60)) return;
    w->said = now;
    w->is_line_open = w->is_terminal;
    fprintf(stderr, w->is_terminal ? "\r\033[K%5.0f s  %s" : "%.0f s: %s\n", now - w->start, what);
    fflush(stderr);
}

fw_status fw_study_watch_end(fw_study_watch *w, fw_status s, fw_msg *m)
{
    if (w->is_line_open) fprintf(stderr, "\r\033[K");
    if (s != FW_E_STOPPED) return s;
    return fw_signals_received() ? fw_fail(m, s, "stopped by signal %d; nothing is written", fw_signals_received())
                                 : fw_fail(m, s, "the time budget of %g s is used up; nothing is written", w->budget_s);
}
