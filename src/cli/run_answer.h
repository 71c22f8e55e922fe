/* What ends `run` and `merge`: answers from the records of a journal, NAME.h5 made of both, table or JSON on stdout. */
#ifndef FW_CLI_RUN_ANSWER_H
#define FW_CLI_RUN_ANSWER_H

#include "cli/run_files.h"
#include "study/answer.h"

/* Of the first n records (fw_run_files_records). measured and effects are what the ledger takes its rows from. */
fw_status fw_run_answer(fw_run_files *files, uint64_t n, const fw_measured *measured, const fw_effects_ledger *effects, bool is_json, fw_msg *m);

#endif
