/* The live line of a campaign on stderr: on a terminal one line that is rewritten in place, in a log one line a
 * minute. */
#ifndef FW_CLI_PROGRESS_LINE_H
#define FW_CLI_PROGRESS_LINE_H

#include <stdbool.h>
#include <stdio.h>

#include "floewear/campaign.h"

typedef struct fw_progress_line {
    FILE  *to;
    bool   is_quiet, is_terminal;
    bool   is_open;    /* a line without its end is on the terminal */
    double last_s;     /* elapsed time of the last line in a log; < 0: none yet */
    char   estimate[160]; /* "P90 2.31e-04 mm +- 12 %, point 5"; empty until there is one */
} fw_progress_line;

void fw_progress_line_start(fw_progress_line *l, FILE *to, bool is_quiet);
/* Called a few times a second. In a log: the first line as soon as there is an estimate (from 10 s on; at 50 s in any
 * case), then one a minute. */
void fw_progress_line_show(fw_progress_line *l, const fw_progress *p);
void fw_progress_line_end(fw_progress_line *l); /* before anything else is printed */

/* The line itself, for tests: at most size - 1 characters. */
void fw_progress_line_format(const fw_progress_line *l, const fw_progress *p, char *out, size_t size);

#endif
