/* From a campaign or scene file (YAML) to checked plain data.
 *
 * Refusals come within a second and name file:line:column, key, value, wanted range and unit, and the nearest key. */
#ifndef FW_CLI_CONFIG_H
#define FW_CLI_CONFIG_H

#include <stdio.h>

#include "floewear/campaign.h"
#include "floewear/realisation.h"
#include "floewear/status.h"

/* sets: (n_sets) "dotted.path=value" from --set, applied over the file; seed >= 0 overrides the file's. */
fw_status fw_config_campaign(fw_campaign *out, const char *path, size_t n_sets, const char *const *sets, int64_t seed,
                             fw_msg *m);
/* The same from text already in memory (a results file carries its campaign): name is what messages call it, and table
 * files that the text names are looked for in name's folder. */
fw_status fw_config_campaign_text(fw_campaign *out, const char *name, const char *text, size_t n_bytes, size_t n_sets,
                                  const char *const *sets, int64_t seed, fw_msg *m);
fw_status fw_config_scene(fw_scene *out, const char *path, size_t n_sets, const char *const *sets, fw_msg *m);

/* The reference of every key, printed from the tables that parse: section, key, unit, default, range, meaning. */
void fw_config_print_keys(FILE *to, bool as_json);

/* "2h", "90 min" -> seconds (--time-budget). */
fw_status fw_config_duration(const char *text, double *seconds, fw_msg *m);

#endif
