/* What the commands that measure (accuracy, plan --effects) share: a place to write to, that they run alone, and a tick that stops them. */
#ifndef FW_CLI_STUDY_RUN_H
#define FW_CLI_STUDY_RUN_H

#include <stdbool.h>

#include "floewear/realisation.h"
#include "floewear/status.h"

/* A place that cannot be written is told now, not after minutes. FW_E_IO; FW_E_MISMATCH: another kind of file is there. */
fw_status fw_study_check_place(const char *path, const char *filetype, fw_msg *m);

/* FW_E_INPUT under a launcher that starts several of us: ranks that share a machine would blur CPU seconds. */
fw_status fw_study_check_alone(fw_msg *m);

typedef struct fw_study_watch {
    double start, budget_s, said; /* [s] of wall clock; budget_s 0: none */
    bool   is_quiet, is_terminal, is_line_open;
} fw_study_watch;

fw_study_watch fw_study_watch_start(double budget_s, bool is_quiet);
fw_tick        fw_study_watch_tick(fw_study_watch *w); /* FW_E_STOPPED after a signal or at the end of the budget */
void           fw_study_watch_say(void *self, const char *what); /* on a terminal one line that is rewritten; in a log one a minute */
/* Clears the line; what FW_E_STOPPED was about goes into m, other statuses are passed on. */
fw_status      fw_study_watch_end(fw_study_watch *w, fw_status s, fw_msg *m);

#endif
