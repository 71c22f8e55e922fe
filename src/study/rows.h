/* The parts of an answer that have a file of their own: service life and ledger. */
#ifndef FW_STUDY_ROWS_H
#define FW_STUDY_ROWS_H

#include "study/answer.h"
#include "study/depth.h"

/* Whole windows in the life, at least one. */
double fw_service_windows(const fw_campaign *c);

/* Life depth of one point at each percentile (rows n_percentiles, bearing and point already set): sums of
 * independent windows. The interval is that of the mean window depth, scaled: over tens of thousands of windows the
 * life's own scatter is a per cent or so, and not knowing the mean is what is left. */
fw_status fw_service_rows(const fw_campaign *c, const fw_window *w, size_t n_percentiles, const double *percentiles,
                          double confidence, fw_life_row *rows, fw_msg *m);

/* The ledger of the governing design number: governing is its percentile row, w that point's window law. */
fw_status fw_ledger_rows(fw_answer *a, const fw_campaign *c, const fw_window *w, const fw_percentile_row *governing,
                         fw_msg *m);

#endif
