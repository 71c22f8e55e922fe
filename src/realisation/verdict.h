/* Inside realisation: the laws that a whole run has to keep, judged when it has ended. Steps, floes and touches have watch-dogs of their own
 * (kernel/watch.h). */
#ifndef FW_REALISATION_VERDICT_H
#define FW_REALISATION_VERDICT_H

#include "floewear/record.h"
#include "world/world.h"

/* energy_tolerance: of the trajectory's balance; INFINITY: not asked for (schemes that are there to be measured against). Reads the filled
 * record and the world. FW_E_NUMERIC names the law, its value and what is wanted. */
fw_status fw_verdict(const fw_record *r, const fw_world *w, double energy_tolerance, fw_msg *m);

#endif
