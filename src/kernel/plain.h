/* The plain methods, for comparison only: every floe between an inlet and the outlet stepped at one fixed step with explicit
 * forces, touches not located. This is what a straightforward DEM does; benchmarks and the accuracy study measure the
 * kernel against it in the same run, on the same ice.
 *
 *   EULER    semi-implicit Euler, one force evaluation a step; with the naive wear rule it is the plain DEM of the benchmarks
 *   VERLET   velocity Verlet, one evaluation a step at the predicted end velocity (the forces depend on velocity)
 *   RK4      the classical fourth-order method, four evaluations a step
 *
 * All three are of first order in a hit, because the normal force jumps by c v inside the step of the touch; between touches
 * they have orders 1, 2 and 4 (tests/kernel/test_plain.c). */
#ifndef FW_KERNEL_PLAIN_H
#define FW_KERNEL_PLAIN_H

#include "floewear/scenario.h"
#include "kernel/kernel.h"

typedef struct fw_plain fw_plain;

/* numerics: scheme (not FW_SCHEME_EVENTS), step and wear_rule. inlet: ice that comes from further upstream than this [m, < 0] stays untouched. */
fw_status fw_plain_create(fw_plain **out, const fw_setup *setup, const fw_numerics *numerics, double inlet, fw_msg *m);
void      fw_plain_destroy(fw_plain *p);
/* Some steps (about 0.1 s), at most to t_end, whose last step may be shorter. */
fw_status fw_plain_step(fw_plain *p, fw_world *w, fw_wear *wear, double t_end, fw_msg *m);
fw_box    fw_plain_needs_ice(const fw_plain *p, const fw_world *w); /* as fw_kernel_needs_ice */

#endif
