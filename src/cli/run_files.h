/* The files of one `floewear run`: NAME.journal, the truth, and NAME.h5, made from it. Rank 0 only. */
#ifndef FW_CLI_RUN_FILES_H
#define FW_CLI_RUN_FILES_H

#include <stdbool.h>

#include "floewear/campaign.h"
#include "store/journal.h"
#include "store/results.h"
#include "study/answer.h"

typedef struct fw_run_files {
    const fw_campaign *campaign;
    char               journal_path[4096], results_path[4096];
    fw_journal        *journal;
    uint64_t          *have;        /* (n_have) ids that the journal held when it was opened, ascending */
    size_t             n_have;
    uint64_t          *have_failed; /* (n_have_failed) those that failed */
    size_t             n_have_failed, failed_capacity;
    size_t             n_before; /* ids of the journal below the first that answers are made from: 0 but for a part */
} fw_run_files;

/* out: the stem or the .h5 file; NULL: the campaign's name in the current folder. Opens the journal and reads what
 * it has. Refused, with nothing touched: a folder that is missing (FW_E_IO), a results file that is no results file
 * of ours (FW_E_FORMAT) or belongs to another campaign (FW_E_MISMATCH, unless is_fresh), whatever fw_journal_open
 * refuses. runs_failed_again: those that failed are not among those that it has. first_id: of a part, else 0. */
fw_status fw_run_files_open(fw_run_files *f, const fw_campaign *c, const char *out, bool is_fresh,
                            bool runs_failed_again, uint64_t first_id, fw_msg *m);
fw_status fw_run_files_close(fw_run_files *f, fw_msg *m); /* a zeroed or half-opened struct is fine */

fw_sink          fw_run_files_sink(fw_run_files *f);
fw_record_source fw_run_files_records(fw_run_files *f, uint64_t n); /* the first n of the journal, a part: from its first id on */
fw_answer_source fw_run_files_answer(fw_run_files *f, uint64_t n);  /* of these, and of the law that the campaign's scenarios come from */

#endif
