/* One record in full, for `floewear run --only-id N`: every column with unit and meaning, status and cause. */
#ifndef FW_CLI_RECORD_PRINT_H
#define FW_CLI_RECORD_PRINT_H

#include <stdio.h>

#include "floewear/campaign.h"

void fw_record_print_text(FILE *to, const fw_record *r);
/* Columns by name, and the rings: path_km, and per law wear_load [MPa^m km]. */
void fw_record_print_json(FILE *to, const fw_campaign *c, const fw_record *r);

#endif
