/* What a window costs, before it is run: enough to bound one that has gone astray, and to warn of one that takes days. */
#ifndef FW_REALISATION_COST_H
#define FW_REALISATION_COST_H

#include "floewear/scenario.h"
#include "floewear/status.h"

/* Force evaluations of one window with its warm-up, within a factor of three or so for a current of 0.2 to 2 m/s. FW_E_ARG: no such sizes. */
fw_status fw_cost_expected(const fw_model *m, const fw_scenario *s, double *evaluations, fw_msg *msg);
/* How many are allowed, both tries together: the model's own limit or, where that is left to the program, 100 times the expected ones. */
fw_status fw_cost_limit(const fw_model *m, const fw_scenario *s, double *evaluations, fw_msg *msg);

#endif
