/* Inside realisation: from world and wear to a record. */
#ifndef FW_REALISATION_OUTCOME_H
#define FW_REALISATION_OUTCOME_H

#include <stdbool.h>

#include "abrasion/wear.h"
#include "floewear/record.h"
#include "world/world.h"

/* Fills everything but id, status, scenario and field columns. window [s] > 0. */
void fw_outcome_fill(fw_record *r, const fw_world *w, const fw_wear *wear, double window);

/* Before a second try: keeps cost and the sentence of the failure, empties the rest. */
void fw_outcome_begin_again(fw_record *r, fw_msg *m);
/* After the last try: the cause of a failure, from m, which is emptied. A second try that only ran into the limit leaves the first one's failure. */
void fw_outcome_say(fw_record *r, fw_msg *m);

#endif
