/* `effects:` of a campaign or scene file: auto, a list of names, or {name: on | off}. */
#ifndef FW_CLI_EFFECTS_FILE_H
#define FW_CLI_EFFECTS_FILE_H

#include "cli/reader.h"
#include "effects/effects.h"

/* Settles model->effects: what the scenes need, what the file says, and then whether a choice contradicts the rest of the file or means nothing
 * (FW_E_INPUT, at the key that is in the way). Comes last, because rules look at everything else. */
fw_status fw_file_read_effects(const fw_reader *r, const fw_scene_facts *f, fw_model *model);

#endif
