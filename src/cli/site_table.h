/* The joint table of a site: columns speed, direction, concentration, (thickness), probability.
 *
 * Rows are grouped into cells of one (speed, concentration, thickness); the directions of a group are the cell's law of
 * direction. Cells come in ascending order of the three, so that the order of rows in the file does not matter. */
#ifndef FW_CLI_SITE_TABLE_H
#define FW_CLI_SITE_TABLE_H

#include "cli/reader.h"
#include "floewear/scenario.h"

/* Fills site's cells. With a thickness column the model's mixes become one for every thickness, of one class each;
 * without it every cell is split by the mixes' probabilities. *has_thickness says which. FW_E_INPUT names file and
 * line. */
fw_status fw_site_table_read(const fw_reader *r, const fw_node *at, const char *path, fw_site *site, fw_model *model,
                             bool *has_thickness);

#endif
