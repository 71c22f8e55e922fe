/* The ice field: an endless sheet of floes that drifts with the water, made tile by tile on demand.
 *
 * A pure function of (seed, id) and the settings: tile (column, row) has the same floes however far the field has been
 * made and in whatever order. Frame: drifts with the ice, +x along the window's mean current; tile (c, r) holds the
 * floes whose centres lie in [c L, (c+1) L) x [(r - 1/2) L, (r + 1/2) L), so row 0 is centred on the structure's line
 * and a straight current needs row 0 alone (it is packed before the rows beside it and never looks at them). A floe
 * belongs to the tile of its centre and may reach into the next. L is 100 m (200 m above 65 % ice), or 7.5 times the largest diameter where
 * that is more (h > 1.45 m).
 *
 * Each tile draws the multiset of its floes first: n = C L^2 / E[floe area], rounded at random, as n stratified
 * quantiles of the joint law of class and diameter (sizes.h). So area is nearly the same in every tile, and sizes are
 * unbiased; redrawing a size when a place is refused would cut the mean diameter by a fifth at 40 % and two fifths at
 * 60 %. Then floes are placed largest first (packing.h) in batches that alternate between neighbouring tiles (field.c).
 *
 * Measured, Release with AVX-512, one core of a 2-core machine shared with other work, ms per tile at 10 / 40 / 60 /
 * 65 %: five classes 0.5-1.3 m 0.002 / 0.013 / 0.065 / 0.17 (24 / 96 / 144 / 156 floes), {0.3 m: 2, 0.5 m: 1} 0.006 /
 * 0.06 / 0.19 / 0.44 (79 / 318 / 477 / 516 floes). Without AVX-512 40 % and more take 1.4 times as long, without AVX
 * 1.6 times. The extreme, h = 0.0855 m alone at 65 %, has 72,000 floes a tile and takes 0.6 s. */
#ifndef FW_FIELD_FIELD_H
#define FW_FIELD_FIELD_H

#include <stddef.h>
#include <stdint.h>

#include "floewear/scenario.h"
#include "floewear/status.h"

typedef struct fw_field_settings {
    uint64_t                seed, id;
    double                  concentration; /* [-] */
    const fw_thickness_mix *mix;           /* borrowed */
    fw_size_law             size_law;
    double                  size_a, size_b;
} fw_field_settings;

typedef struct fw_tile {
    int64_t column, row;
    size_t  n_floes;
    double *x, *y;      /* centres in the ice frame [m]  (n_floes) */
    double *radius;     /* [m]  (n_floes) */
    double *thickness;  /* [m]  (n_floes) */
} fw_tile;

typedef struct fw_field fw_field;

/* Copies what it needs of the mix. FW_E_ARG: concentration outside (0, FW_MAX_CONCENTRATION], mix or size law that sizes.h refuses. */
fw_status fw_field_create(fw_field **out, const fw_field_settings *s, fw_msg *m);
void      fw_field_destroy(fw_field *f);
double    fw_field_tile_length(const fw_field *f); /* L [m] */
double    fw_field_max_radius(const fw_field *f);
/* The tile, made now if need be (with what its packing draws on: up to 8 columns on either side, in part); floes
 * largest first; valid until the tile is forgotten or the field destroyed. FW_E_ARG: a column or row beyond +-2^20.
 * FW_E_NUMERIC: no packing without overlap was found; the message names tile, wanted and reached concentration. */
fw_status fw_field_tile(fw_field *f, int64_t column, int64_t row, const fw_tile **out, fw_msg *m);
/* The caller will not ask for tiles of column >= first_forgotten again (the current carries ice to +x and new ice comes
 * from smaller columns). What packing still needs is kept. Asking nevertheless gives the same floes again, at the cost
 * of making them again; the census then leaves them out. */
void fw_field_forget(fw_field *f, int64_t first_forgotten);

typedef struct fw_field_census {
    size_t n_tiles, n_floes;   /* of finished tiles, also of those finished because a neighbour needed them */
    double ice_area, tile_area; /* [m2]; achieved concentration = ice_area / tile_area */
    double sum_diameter;        /* [m] */
    double mean_diameter_wanted; /* of the law of sizes [m] */
} fw_field_census;
fw_field_census fw_field_count(const fw_field *f);

#endif
