/* Keys of how scenarios are drawn and when there are enough of them: sections sampling and precision. */
#ifndef FW_CLI_SAMPLING_FILE_H
#define FW_CLI_SAMPLING_FILE_H

#include "cli/reader.h"
#include "cli/tables.h"
#include "floewear/campaign.h"

/* The model and site have to be known: an allocation has a share for each of their strata (campaign/strata.h). What *out owns is freed with the
 * campaign, also after an error. */
fw_status fw_file_read_sampling(const fw_reader *r, fw_values *v, const fw_model *model, const fw_site *site, fw_sampling *out);
/* n_points: of the campaign. */
fw_status fw_file_read_precision(const fw_reader *r, fw_values *v, size_t n_points, fw_precision *out);

#endif
