/* NAME.effects.h5: what `floewear plan --effects` measured, as tables for people and scripts, and what `run`, `plan` and `report` read back from it.
 *
 *   /effects            one row per effect and open choice: changes with intervals, cost saved, cost share
 *   /effects_summary    one row: windows, governing point, costs of the whole and of the bare rest
 * NAME.h5 of a run of this campaign has the same two. */
#ifndef FW_CLI_EFFECTS_TABLES_H
#define FW_CLI_EFFECTS_TABLES_H

#include "cli/table_builder.h"
#include "store/tables.h"
#include "study/effects_ledger.h"

fw_status fw_effects_tables_write(const char *path, const fw_campaign *c, const fw_effects_ledger *l, fw_msg *m);

enum { FW_EFFECTS_TABLES = 2 };
/* Into b[0] and b[1]; n_rows = 0 gives empty tables. */
void      fw_effects_tables_build(fw_table_builder *b, const fw_effects_ledger *l, fw_msg *m);
/* A file without these tables gives a ledger without rows. */
fw_status fw_effects_tables_read(const fw_tables *t, fw_effects_ledger *out, fw_msg *m);

#endif
