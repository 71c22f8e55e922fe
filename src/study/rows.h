/* The part of an answer that has a file of its own: the ledger. */
#ifndef FW_STUDY_ROWS_H
#define FW_STUDY_ROWS_H

#include "study/answer.h"
#include "study/depth.h"
#include "study/law_factor.h"

/* The ledger of the governing design number: governing is its percentile row, w that point's window law, law how well the law is known, at the
 * point's place among the answered ones. */
fw_status fw_ledger_rows(fw_answer *a, const fw_campaign *c, const fw_window *w, const fw_percentile_row *governing,
                         const fw_law_factor *law, size_t at, fw_msg *m);

/* From a ledger: what dominates at each point, and what to do about it. */
void fw_ledger_advise(fw_answer *a, size_t n_percentiles);

#endif
