/* The parts of an answer that have files of their own: the ledger, and how precise it is. */
#ifndef FW_STUDY_ROWS_H
#define FW_STUDY_ROWS_H

#include "study/answer.h"
#include "study/depth.h"
#include "study/law_factor.h"

/* The ledger of the governing design number: governing is its percentile row, w that point's window law, law how well the law is known, at the
 * point's place among the answered ones. */
fw_status fw_ledger_rows(fw_answer *a, const fw_campaign *c, const fw_window *w, const fw_percentile_row *governing,
                         const fw_law_factor *law, size_t at, fw_msg *m);

/* Streams the records and settles their weights; sanity gets them too. */
fw_status fw_answer_collect(fw_depth *d, fw_sanity *sanity, const fw_answer_source *source, fw_msg *m);
/* a->half_width from its rows of percentiles or points. */
fw_status fw_answer_take_width(fw_answer *a, const fw_campaign *c, size_t n_percentiles, fw_msg *m);

/* From a ledger: what dominates at each point, and what to do about it. */
void fw_ledger_advise(fw_answer *a, size_t n_percentiles);

#endif
