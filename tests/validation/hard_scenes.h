/* The hard cases: scenes and windows that are the hardest on a discrete-element engine, each with the laws it must obey.
 *
 * A scene is data: floes by name or a layout with its numbers, what differs from the paper's model, and a set of laws (hard_laws.h).
 * Nothing here is a reference value of another program. */
#ifndef TESTS_HARD_SCENES_H
#define TESTS_HARD_SCENES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/realisation.h"

/* What differs from fw_model_defaults. 0: nothing; NONE: the value is zero. */
enum { NONE = -1 };
typedef struct hard_changes {
    double   stiffness, damping, friction, slip_damping, radius;
    uint32_t off; /* effects switched off */
} hard_changes;

/* Writes floes from its numbers p; returns how many. */
typedef size_t hard_layout(fw_floe *to, size_t capacity, const double *p);

typedef struct hard_scene {
    const char   *name;
    uint64_t      laws;    /* set of hard_law bits, besides those of every scene */
    uint64_t      without; /* of those: laws that mean nothing here */
    hard_changes  change;
    double        speed, duration; /* [m/s], [s] */
    size_t        n;
    const fw_floe *floes; /* (n) or */
    hard_layout  *layout;
    double        p[7];
    double        concentration; /* > 0: a window of ice by fw_realise instead of given floes */
    bool          is_long;       /* only with --all */
    bool          is_once;       /* too long to be run again at a tenth of the accuracy */
} hard_scene;

extern const hard_scene hard_scenes[];
extern const size_t     hard_n_scenes;

/* Layouts (hard_layouts.c). Floes touch, or nearly, at the start; all have the velocity (speed, 0) unless named otherwise. */
hard_layout hard_hexagon; /* rings round one floe, D, h, x of the right rim, gap, speed, y of the middle */
hard_layout hard_square;  /* columns, rows, D, h, gap, speed: right rim one gap from the paper's structure */
hard_layout hard_line;    /* n, D, h, x of the right rim, gap, speed */
hard_layout hard_row_of;  /* n side by side before the structure of radius R: n, D, h, R, gap, speed */
hard_layout hard_ring;    /* n round the structure of radius R, D, h, inward speed, R */
hard_layout hard_crowd;   /* n in a square pattern at random velocities far from the structure: n, D, h, gap, fastest, seed */
hard_layout hard_mixed;   /* columns, rows, largest D, gap, speed, seed: diameters and thicknesses drawn over masses 1 : 100 */
hard_layout hard_flower;  /* six round one: D middle, D others, h, gap, inward speed, x of the middle */

#endif
