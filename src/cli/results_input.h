/* A results file as a command reads it: its campaign, and what its ledger was made from. */
#ifndef FW_CLI_RESULTS_INPUT_H
#define FW_CLI_RESULTS_INPUT_H

#include "floewear/campaign.h"
#include "store/results.h"
#include "study/effects_ledger.h"
#include "study/measured.h"

/* The caller frees c. Errors name path. */
fw_status fw_results_input_campaign(const fw_results *r, const char *path, fw_campaign *c, fw_msg *m);
fw_status fw_results_input_measured(const fw_results *r, const fw_campaign *c, fw_measured *out, fw_effects_ledger *effects, fw_msg *m);

#endif
