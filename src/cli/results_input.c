#include "cli/results_input.h"

#include <string.h>

#include "cli/accuracy_file.h"
#include "cli/config.h"
#include "cli/effects_tables.h"
#include "store/tables.h"
#include "study/effects_measured.h"

fw_status fw_results_input_campaign(const fw_results *r, const char *path, fw_campaign *c, fw_msg *m)
{
    const char *const *sets = NULL;
    const char        *text = fw_results_campaign_text(r);
    size_t             n_sets = fw_results_sets(r, &sets);
    return fw_config_campaign_text(c, path, text, strlen(text), n_sets, sets, fw_results_seed(r), m);
}

/* Files of earlier versions have no such table: what this version knows stands in for it. */
fw_status fw_results_input_measured(const fw_results *r, const fw_campaign *c, fw_measured *out, fw_effects_ledger *effects, fw_msg *m)
{
    const fw_tables *t = fw_results_tables(r);
    fw_measured_default(out, &c->model);
    if (fw_tables_has(t, "accuracy")) FW_TRY(fw_accuracy_file_read_measured(t, out, m));
    FW_TRY(fw_effects_tables_read(t, effects, m));
    if (effects->n_rows == 0) fw_effects_measured_default(effects, &c->model);
    return FW_OK;
}
