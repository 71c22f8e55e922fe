/* An answer for people (text), for scripts (CSV, JSON) and for NAME.h5: the same numbers four times.
 * Depths are in mm everywhere; the text table takes out a power of ten and says so. An end of an interval that does not
 * exist is "none" in text, empty in CSV, null in JSON and NaN in HDF5. */
#ifndef FW_CLI_REPORT_TABLE_H
#define FW_CLI_REPORT_TABLE_H

#include <stdio.h>

#include "cli/report_tables_h5.h"
#include "floewear/campaign.h"
#include "study/answer.h"

/* Table of points, governing point, service life, ledger, and what is not modelled. */
void fw_report_print_table(FILE *to, const fw_campaign *c, const fw_answer *a);
/* The same with the intervals that cover at all points together in the table of points. */
void fw_report_print_simultaneous(FILE *to, const fw_campaign *c, const fw_answer *a);
/* One line per point and percentile, with the point's and the life's numbers repeated on it; %.17g. */
void fw_report_print_csv(FILE *to, const fw_campaign *c, const fw_answer *a);
/* One object; its names are the interface that scripts rely on. */
void fw_report_print_json(FILE *to, const fw_campaign *c, const fw_answer *a);

#endif
