/* Packs a tile anew when pushing its floes apart did not do it: small floes at random that grow to their sizes.
 *
 * All own floes are shrunk by one factor, put down at new places and pushed apart. Then they grow together in small
 * steps (Lubachevsky and Stillinger 1990), are pushed apart after each, and are stirred before the next: every floe
 * takes short random steps that keep it clear of the others and changes places with floes of nearly its size. A step of
 * growth that pushing does not free is taken back and halved. Stirring finds the room that is spread over many small
 * gaps, and the changes of places let small floes slip in along rims of neighbours, which do not give way. The sizes
 * stay what was drawn. */
#ifndef FW_FIELD_GROWING_H
#define FW_FIELD_GROWING_H

#include "field/packing.h"

/* Needs the packing as a fw_packing_place that left floes overlapping left it: largest first. patience: 1, or more to
 * grow that many times slower. *size: the largest share of their radii at which the floes were free of overlap; 1:
 * success. The radii are the full ones in any case. */
fw_status fw_growing_pack(fw_packing *p, int patience, fw_uniforms *random, double *size, fw_msg *m);

#endif
