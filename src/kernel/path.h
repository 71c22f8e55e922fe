/* Inside the kernel only: where something is at any instant, and when two of them touch.
 *
 * Everything has a known path until somebody hits it: the structure stands, untouched ice drifts, a floe in no contact flies by
 * the closed form of its drag, a floe in a cluster follows the cubic of the step that was tried. */
#ifndef FW_KERNEL_PATH_H
#define FW_KERNEL_PATH_H

#include "kernel/cluster.h"

typedef struct fw_place {
    double x, y, vx, vy;
} fw_place;

typedef struct fw_path {
    enum { FW_PATH_STANDS, FW_PATH_DRIFTS, FW_PATH_FLIES, FW_PATH_CUBIC } kind;
    double radius;
    double t0, x, y, vx, vy;    /* at t0 */
    double ux, uy;              /* of the water */
    double K;                   /* flies: drag per mass [1/m] */
    double r;                   /* flies: |v - u| at t0 */
    double h, x1, y1, vx1, vy1; /* cubic: at t0 + h */
    double bound;               /* |v - u| is never more from t0 on (cubic: within the step) */
} fw_path;

fw_path fw_path_of_structure(const fw_setup *s);
fw_path fw_path_of_drifting(const fw_setup *s, double t0, double x, double y, double radius);
fw_path fw_path_of_flying(const fw_setup *s, const fw_body *b);
fw_path fw_path_of_member(const fw_setup *s, const fw_cluster *c, const fw_member *m);

fw_place fw_path_at(const fw_path *p, double t);

/* Spin after a flight of t seconds that began at |v - u| = r [rad/s]: the water on the face slows it, the faster the floe goes through it. */
double fw_flight_spin(const fw_body *b, double r, double K, double t, double *turned); /* by how much it has turned meanwhile [rad] */

/* Gap between the rims (positive: apart) and how fast it closes. */
void fw_path_gap(const fw_path *a, const fw_path *b, double t, double *gap, double *closing);

/* First instant in [from, until] at which the rims touch while they close; INFINITY: none. gap, closing: at from. Rims that overlap and part at `from` touch
 * only when they have parted and come back. */
double fw_path_touch(const fw_path *a, const fw_path *b, double from, double until, double gap, double closing);

/* First root in (0, h] of the cubic through (gap0, rate0) and (gap1, rate1), rate: closing is positive; INFINITY: none. */
double fw_path_root(double gap0, double rate0, double gap1, double rate1, double h);

#endif
