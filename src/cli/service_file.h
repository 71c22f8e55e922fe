/* The service section of a campaign file, and the table of whole years that it may name. */
#ifndef FW_CLI_SERVICE_FILE_H
#define FW_CLI_SERVICE_FILE_H

#include "cli/reader.h"
#include "cli/tables.h"
#include "floewear/campaign.h"

/* window [s]: a table without a year that long is refused. *out owns its table only when FW_OK; of a campaign it is freed with it. */
fw_status fw_file_read_service(const fw_reader *r, fw_values *v, double window, fw_service *out);

#endif
