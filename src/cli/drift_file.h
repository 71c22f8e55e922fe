/* What moves floes besides a steady current: wind, and a current that changes within a window. */
#ifndef FW_CLI_DRIFT_FILE_H
#define FW_CLI_DRIFT_FILE_H

#include "cli/reader.h"
#include "cli/tables.h"
#include "floewear/realisation.h"
#include "floewear/scenario.h"

/* Sections wind and current.tide, current.course of root, into the model and the site or the scene; v takes the plain keys. */
fw_status fw_file_read_drift(const fw_reader *r, fw_values *v, fw_model *model, fw_site *site);
fw_status fw_file_read_scene_drift(const fw_reader *r, fw_values *v, fw_scene *scene);

#endif
