/* Inside the field only: moves a packing's own floes until none overlaps. Everything here needs the cover. */
#ifndef FW_FIELD_PUSHING_H
#define FW_FIELD_PUSHING_H

#include "field/packing.h"

/* Does a disc here come nearer than FW_PACKING_GAP to another one (disc `self` left out)? */
bool fw_pushing_is_taken(const fw_packing *p, double x, double y, double r, int32_t self);
/* Of a few dozen random places the one with the least sum of overlap depths. */
void fw_pushing_least_crowded(const fw_packing *p, double r, int32_t self, fw_uniforms *random, double *x, double *y);
/* Put own floe i elsewhere: kept in the box (a wrap in y, else the nearest place inside), listed there. */
fw_status fw_pushing_move(fw_packing *p, int32_t i, double x, double y, fw_msg *m);

/* Own floe i may overlap something. */
void fw_pushing_enqueue(fw_packing *p, int32_t i);
/* No floe does, as far as one knows. */
void fw_pushing_forget(fw_packing *p);
/* Push queued floes, and those that a push meets, apart: until none is queued, at most n_pushes times. */
fw_status fw_pushing_bout(fw_packing *p, size_t n_pushes, fw_msg *m);
/* Free all queued floes. When a bout of pushes does not do it, the smallest floe that still overlaps goes elsewhere.
 * *n_left: floes that overlap when this was done often enough; 0: success. */
fw_status fw_pushing_free_all(fw_packing *p, fw_uniforms *random, size_t *n_left, fw_msg *m);

#endif
