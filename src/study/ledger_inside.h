/* What the ledger's files share: rows that are filled in, and who fills which. */
#ifndef FW_STUDY_LEDGER_INSIDE_H
#define FW_STUDY_LEDGER_INSIDE_H

#include "study/rows.h"

/* Cuts what does not fit. */
void fw_ledger_write(char *to, size_t size, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
#define SAY(field, ...) fw_ledger_write((field), sizeof(field), __VA_ARGS__)

void fw_ledger_unmeasured(fw_ledger_row *row, const char *name, const char *shrinks_with);

/* ledger_effects.c: the sum of switched-off effects and each of them that was measured (returns the number of rows), and the contact law. */
size_t fw_ledger_effects(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w);
void   fw_ledger_contact_law(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w);

/* ledger_law.c: a factor on every depth, no part of a window's percentiles, which are those of the law as it stands; years and windows of a life. i: place of
 * the point among those answered. */
fw_status fw_ledger_law(fw_ledger_row *row, const fw_campaign *c, const fw_law_factor *law, size_t i, fw_law_scatter *out, const fw_percentile_row *g,
                        fw_msg *m);
void      fw_ledger_persistence(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p);
void      fw_ledger_years(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p);

#endif
