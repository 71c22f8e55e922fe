/* The strip of ice that drifts past, along its way through the structure's centre. Untouched floes outside are not
 * there. */
#ifndef FW_KERNEL_STRIP_H
#define FW_KERNEL_STRIP_H

#include <math.h>

#include "kernel/kernel.h"

typedef struct fw_strip {
    double cx, cy, offset, half_width; /* |cx Y - cy X + offset| <= half_width, in the ice frame */
} fw_strip;

static inline fw_strip fw_strip_of(const fw_setup *s, const fw_world *w)
{
    const fw_flow *f = &s->flow;
    double         u = sqrt(f->ice_x * f->ice_x + f->ice_y * f->ice_y), inv = u > 0 ? 1 / u : 0;
    fw_strip       to = {.cx = u > 0 ? f->ice_x * inv : 1, .cy = f->ice_y * inv, .half_width = s->half_width};
    to.offset = to.cx * w->drift_y - to.cy * w->drift_x;
    return to;
}

static inline bool fw_strip_has(const fw_strip *s, double X, double Y)
{
    return fabs(s->cx * Y - s->cy * X + s->offset) <= s->half_width;
}

#endif
