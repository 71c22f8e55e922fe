/* `floewear plan --effects`: what each effect and open choice moves in a campaign and what it costs, measured, printed, and kept in NAME.effects.h5. */
#ifndef FW_CLI_PLAN_EFFECTS_H
#define FW_CLI_PLAN_EFFECTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

typedef struct fw_plan_effects_wanted {
    const char        *campaign; /* the file */
    size_t             n_sets;
    const char *const *sets; /* (n_sets) */
    int64_t            seed; /* < 0: the file's */
    const char        *out;  /* stem of the file to write; NULL: the campaign's name */
    double             cpu_budget_s; /* 0: the usual one */
    size_t             n_windows;    /* > 0: so many of the campaign's own windows instead */
    bool               is_json, is_quiet;
} fw_plan_effects_wanted;

fw_status fw_plan_effects(const fw_plan_effects_wanted *w, fw_msg *m);

#endif
