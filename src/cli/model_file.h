/* The parts of a model that campaign and scene files share: contact, water, ring, abrasion laws; and the
 * thickness mixes of a campaign. */
#ifndef FW_CLI_MODEL_FILE_H
#define FW_CLI_MODEL_FILE_H

#include "cli/reader.h"
#include "cli/tables.h"
#include "floewear/scenario.h"

/* Read contact, water, abrasion and ring of root into v and, with what v holds of structure, ice and accuracy, all into the
 * model. Its effects are settled later (effects_file.h), because `auto` looks at all of it. */
fw_status fw_file_read_model(const fw_reader *r, fw_values *v, fw_model *model);

/* ice.thickness_mixes; list NULL: the model keeps the mixes it has. */
fw_status fw_file_read_mixes(const fw_reader *r, const fw_node *list, fw_model *model);

/* FW_E_INPUT when 4h <= sqrt(130h - 11) leaves no floe of this thickness; the sentence says so. */
fw_status fw_file_check_thickness(const fw_node *at, const char *path, double thickness, fw_msg *m);

#endif
