/* The head of a report in plain words: what was computed, for which exposure, the governing point, its design percentile and interval, and what would
 * shrink the doubt in it most. */
#ifndef FW_CLI_REPORT_SUMMARY_H
#define FW_CLI_REPORT_SUMMARY_H

#include <stdio.h>

#include "study/answer.h"

/* What precision is about: "mean", or "P90". Returns text. */
const char *fw_report_quantity(const fw_campaign *c, char *text, size_t size);

void fw_report_print_summary(FILE *to, const fw_campaign *c, const fw_answer *a);

#endif
