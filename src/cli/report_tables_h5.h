/* NAME.h5 of an answer: /percentiles, /points, /service_life and /ledger are what the report prints, /accuracy what its
 * numerical rows were made from, /effects and /effects_summary its rows of effects, where they were measured; /water_level the shares
 * over height, of a campaign with that key. */
#ifndef FW_CLI_REPORT_TABLES_H5_H
#define FW_CLI_REPORT_TABLES_H5_H

#include "floewear/campaign.h"
#include "store/results.h"
#include "study/answer.h"

/* Write path (see fw_results_write: temporary file, fsync, rename) with the records and the answer's tables. What a
 * clock puts in is a column with cpu in its name; all else is the same for every run of the campaign. */
fw_status fw_report_write(const char *path, const fw_campaign *c, const fw_record_source *records, const fw_answer *a,
                          fw_msg *m);

#endif
