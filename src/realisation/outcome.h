/* Inside realisation: from world and wear to a record. */
#ifndef FW_REALISATION_OUTCOME_H
#define FW_REALISATION_OUTCOME_H

#include "abrasion/wear.h"
#include "floewear/record.h"
#include "world/world.h"

/* Fills everything but id, status, scenario and field columns. window [s] > 0. */
void fw_outcome_fill(fw_record *r, const fw_world *w, const fw_wear *wear, double window);


#endif
