/* Inside realisation: untouched ice comes into the world as the run needs it.
 *
 *   ice frame          X ---- column c-1 ---- column c ---- column c+1 ----   rows beside row 0, where something reaches them
 *   kernel frame       x = X + drift, drift = speed x time: columns come in from the left and are dropped when they have passed.
 *
 * Nothing upstream is an inlet: ice is made as far as the disturbance reaches, however far that is. Nor is the strip's width paid for:
 * a row of tiles is made when a disturbed floe comes near it.
 *
 * A current that turns, or wind across it, brings ice from the sides, and the former brings it back: then tiles come where they are needed and are
 * dropped half a tile past that (ice_around.c). Ice that was dropped comes back undisturbed, ice that was not as it was left; floes that were forgotten
 * downstream do not. */
#ifndef FW_REALISATION_ICE_H
#define FW_REALISATION_ICE_H

#include "field/field.h"
#include "kernel/kernel.h"
#include "world/world.h"

typedef enum fw_ice_way {
    FW_ICE_ALONG,   /* towards +x */
    FW_ICE_ACROSS,  /* towards +x and to a side: what has passed may be forgotten */
    FW_ICE_ANYWHERE /* and back */
} fw_ice_way;

typedef struct fw_ice {
    fw_field *field;       /* owned */
    double    length;      /* of a tile [m] */
    double    past;        /* what lies beyond this x is dropped [m] */
    int64_t   row0, row1;  /* rows that the strip's width allows */
    int64_t   next_column; /* the first (largest) column not in the world yet; columns go down as time goes on */
    uint64_t  n_named;
    size_t    n_columns, capacity;
    struct fw_ice_column {
        int64_t name, low, high; /* rows low .. high are in the world */
    } *columns; /* (n_columns) in the world, newest last */
    fw_ice_way way;
    /* Instead of columns, where ice comes from other sides too: */
    size_t n_placed, placed_capacity;
    struct fw_ice_placed {
        int64_t  column, row;
        uint64_t first_name;
    } *placed; /* (n_placed) tiles in the world */
} fw_ice;

/* Lays the first columns round the structure: what would lie on it is not there. half_width: of the strip; warm_up_way: way of the current
 * before the window, which begins on the same ice whatever that is [m]. */
fw_status fw_ice_lay(fw_ice *ice, const fw_field_settings *s, fw_world *w, double half_width, double past,
                     double warm_up_way, fw_ice_way way, fw_msg *m);
/* To be called before every step with what that needs (kernel frame). */
fw_status fw_ice_feed(fw_ice *ice, fw_world *w, const fw_box *need, fw_msg *m);
void      fw_ice_free(fw_ice *ice);

/* Between the two files: tile (column, row) into the world as its newest block. */
fw_status fw_ice_add_tile(fw_ice *ice, fw_world *w, int64_t column, int64_t row, fw_msg *m);
/* Floes of the newest block that would lie on the structure, or on floes that are awake, are not there. */
void      fw_ice_clear(fw_world *w);
fw_status fw_ice_around(fw_ice *ice, fw_world *w, const fw_box *need, fw_msg *m); /* all tiles that need reaches */

#endif
