/* The plain method, for comparison only: every floe between an inlet and the outlet stepped at one fixed step, explicit
 * forces, wear summed as rate at the step's end times dt. This is what a straightforward DEM does; benchmarks measure the
 * kernel against it in the same run, on the same ice. Prototypes were 11-31 % wrong on single hits at 1 ms; in
 * windows at 10 and 40 % most wear is rubbing and the sum is within 0.4 % (tests/bench/RESULTS.md), at ten times the cost. */
#ifndef FW_KERNEL_PLAIN_H
#define FW_KERNEL_PLAIN_H

#include "kernel/kernel.h"

typedef struct fw_plain fw_plain;

/* inlet: ice further upstream than this x [m] stays untouched. */
fw_status fw_plain_create(fw_plain **out, const fw_setup *setup, double dt, double inlet, fw_msg *m);
void      fw_plain_destroy(fw_plain *p);
/* Some steps of dt (about 0.1 s), at most to t_end, whose last step may be shorter. */
fw_status fw_plain_step(fw_plain *p, fw_world *w, fw_wear *wear, double t_end, fw_msg *m);
double    fw_plain_needs_ice_from(const fw_plain *p, const fw_world *w);

#endif
