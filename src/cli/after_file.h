/* Keys of what acts on a campaign's answers after the run: water.level, abrasion.scatter, abrasion.uncertainty. */
#ifndef FW_CLI_AFTER_FILE_H
#define FW_CLI_AFTER_FILE_H

#include "cli/reader.h"
#include "floewear/campaign.h"

/* *out owns memory only when FW_OK and, of a campaign, is freed with it. */
fw_status fw_file_read_after(const fw_reader *r, const fw_model *model, fw_after *out);

/* A scene has no answers that they could act on. */
fw_status fw_file_refuse_after(const fw_reader *r);

#endif
