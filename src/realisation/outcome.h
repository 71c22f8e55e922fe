/* Inside realisation: from world and wear to a record. */
#ifndef FW_REALISATION_OUTCOME_H
#define FW_REALISATION_OUTCOME_H

#include <stdbool.h>

#include "abrasion/wear.h"
#include "floewear/record.h"
#include "world/world.h"

/* Fills everything but id, status, scenario and field columns. window [s] > 0. */
void fw_outcome_fill(fw_record *r, const fw_world *w, const fw_wear *wear, double window);

/* Is it a failure that finer steps may cure? A limit is none: they cost more. */
bool fw_outcome_may_be_cured(const fw_record *r, const fw_model *m);
/* Before a second try: keeps cost and the sentence of the failure, empties the rest. */
void fw_outcome_begin_again(fw_record *r, fw_msg *m);
/* After the last try: the cause of a failure, from m, which is emptied. */
void fw_outcome_say(fw_record *r, fw_msg *m);

#endif
