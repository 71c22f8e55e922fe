/* NAME.accuracy.h5: what `floewear accuracy` measured, as tables for people and scripts, and what `run`, `plan` and `report` read
 * back from it.
 *
 *   /work_precision     step level x scheme x wear rule: errors, order, cost
 *   /domain             ring, strip width, downstream, warm-up, window length
 *   /percentile_error   the percentile's error against the number of realisations
 *   /budget_cpu         a CPU budget split between finer steps and more windows (counts there follow from a clock)
 *   /choice             one row per setting that a run takes: key, value, unit, and the --set that says it
 *   /summary            one row: sizes, the reference's own check, the choice's error and reason
 *   /accuracy           the ledger's rows; the same table stands in NAME.h5 */
#ifndef FW_CLI_ACCURACY_FILE_H
#define FW_CLI_ACCURACY_FILE_H

#include "cli/table_builder.h"
#include "store/tables.h"
#include "study/accuracy.h"

enum { FW_CHOICE_SETS = 9, FW_CHOICE_SET_SIZE = 64 };

/* The settings of a choice as they would be given with --set, for key tables and journals alike. */
typedef struct fw_choice_sets {
    size_t n;
    char   text[FW_CHOICE_SETS][FW_CHOICE_SET_SIZE]; /* "numerics.tolerance=0.0003" */
} fw_choice_sets;
void fw_choice_sets_make(fw_choice_sets *out, const fw_accuracy_choice *choice);

fw_status fw_accuracy_file_write(const char *path, const fw_campaign *c, const fw_accuracy *a, fw_msg *m);

/* The ledger's rows as a table (NAME.h5 has it too), and back. */
void      fw_accuracy_file_build_measured(fw_table_builder *b, const fw_measured *measured, fw_msg *m);
fw_status fw_accuracy_file_read_measured(const fw_tables *t, fw_measured *out, fw_msg *m);
/* The choice of a file that is open; what says no key = value is FW_E_FORMAT. */
fw_status fw_accuracy_file_read_sets(const fw_tables *t, fw_choice_sets *out, fw_msg *m);

#endif
