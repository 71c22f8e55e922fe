/* The effects ledger as text and JSON: what `floewear plan --effects` prints, and the part of it that stands in a report. */
#ifndef FW_CLI_EFFECTS_PRINT_H
#define FW_CLI_EFFECTS_PRINT_H

#include <stdio.h>

#include "cli/json.h"
#include "floewear/campaign.h"
#include "study/effects_ledger.h"

void fw_effects_print_text(FILE *to, const fw_campaign *c, const fw_effects_ledger *l);
void fw_effects_print_json(FILE *to, const fw_campaign *c, const fw_effects_ledger *l);

/* Rows of changes, each by a line of its own; nothing when nothing was measured. */
void fw_effects_print_rows(FILE *to, const fw_effects_ledger *l);
/* The array of rows, to stand behind a key; null when nothing was measured. */
void fw_effects_json_rows(fw_json *j, const fw_effects_ledger *l);

/* "+12 [+10, +14] %", "x3.2 [2.9, 3.5]", "0", "-". */
const char *fw_effects_say_change(char *text, size_t size, const fw_change *c);
/* NULL: the ledger has no such effect. */
const fw_effects_row *fw_effects_find_row(const fw_effects_ledger *l, const char *name);

#endif
