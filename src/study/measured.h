/* What is known of a campaign's numerical errors, as the ledger prints them: measured by `floewear accuracy` on the campaign
 * itself, or else by the same command on the Raahe campaign. */
#ifndef FW_STUDY_MEASURED_H
#define FW_STUDY_MEASURED_H

#include <stdbool.h>
#include <stddef.h>

#include "floewear/scenario.h"

enum { FW_MEASURED_ROWS = 5 };

typedef struct fw_measured_row {
    char   row[32];       /* "discretisation", "ring", "strip width", "downstream", "warm-up" */
    double amount, error; /* relative, with its standard error (NAN: none) */
    double
        cost_factor; /* CPU time of a run with half of it, over that of this run; NAN: no level that was tried has half */
    char shrinks_with[96], halved_by[96]; /* the key, and what to set it to */
} fw_measured_row;

typedef struct fw_measured {
    char            origin[96]; /* "on this campaign, 12 windows of ..." */
    bool            is_own;     /* of this campaign */
    size_t          n_rows;
    fw_measured_row rows[FW_MEASURED_ROWS];
} fw_measured;

/* The Raahe campaign's, for a model whose settings are the defaults; discretisation by the model's accuracy. */
void fw_measured_default(fw_measured *out, const fw_model *model);

#endif
