/* `floewear plan --levels`: whether cheap models beside the campaign's own would pay, measured and printed. */
#ifndef FW_CLI_PLAN_LEVELS_H
#define FW_CLI_PLAN_LEVELS_H

#include "cli/choice.h"

typedef struct fw_plan_levels_wanted {
    fw_choice_wanted choice;       /* the campaign, with the numerics that a run takes */
    double           cpu_budget_s; /* 0: the usual one */
    bool             is_json, is_quiet;
} fw_plan_levels_wanted;

fw_status fw_plan_levels(const fw_plan_levels_wanted *w, fw_msg *m);

#endif
