/* What `floewear accuracy` prints: the work-precision table and all that follows from it, as text or JSON. */
#ifndef FW_CLI_ACCURACY_PRINT_H
#define FW_CLI_ACCURACY_PRINT_H

#include <stdio.h>

#include "floewear/campaign.h"
#include "study/accuracy.h"

void fw_accuracy_print_text(FILE *to, const fw_campaign *c, const fw_accuracy *a);
void fw_accuracy_print_json(FILE *to, const fw_campaign *c, const fw_accuracy *a);

#endif
