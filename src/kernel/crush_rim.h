/* Inside crush.c and crush_step.c only: what they share about a rim. */
#ifndef FW_KERNEL_CRUSH_RIM_H
#define FW_KERNEL_CRUSH_RIM_H

#include <math.h>

#include "kernel/crush.h"
#include "physics/crush.h"

#define TWO_PI 6.283185307179586476925286766559

double fw_rim_between(double from, double to); /* change of place on the shorter way [rad] */
double fw_rim_place(const double *y);          /* under the wall, in the frame of a floe with this state [rad] */

/* One imprint's depth and dD/ds there; D and dD/ds. */
double fw_rim_imprint(const fw_rim *r, const fw_imprint *i, double place, double *slope);
double fw_rim_deepest(const fw_rim *r, double place, double *slope);
/* The imprint of the wall's disc pressed in: to one node past either edge, so that the edge lies between two. */
void fw_rim_press(fw_rim *r, fw_imprint own);
/* F(d), and the chord. */
double fw_rim_force(const fw_rim *r, double depth, double *chord);
/* Slope S of the line of D, F = F(D); elastic part of N on it, and the damper beside it. */
static inline double fw_rim_stiffness(const fw_rim *r, double D, double F) { return fw_crush_kappa(r->kappa, D) * F / D; }
static inline double fw_rim_line(const fw_rim *r, double depth, double D, double F)
{
    return D > FW_CRUSH_ELASTIC ? F * (1 - fw_crush_kappa(r->kappa, D) * (D - depth) / D) : F * depth / D;
}
static inline double fw_rim_damping(const fw_rim *r, double D, double F) { return 2 * sqrt(fw_rim_stiffness(r, D, F) * r->mass); }
/* What is stored at an overlap, deepest: before it [J]. */
double fw_rim_stored(const fw_rim *r, double depth, double deepest);

#endif
