/* What effects and open choices move, for campaigns that nobody has measured it for. */
#ifndef FW_STUDY_EFFECTS_MEASURED_H
#define FW_STUDY_EFFECTS_MEASURED_H

#include "study/effects_ledger.h"

/* The ledger of the Raahe campaign, which says so, for a model that has its effects: the core ones. Others: no rows. It is for the ledger of a report alone:
 * no effect is left out for what another campaign says. */
void fw_effects_measured_default(fw_effects_ledger *out, const fw_model *model);

#endif
