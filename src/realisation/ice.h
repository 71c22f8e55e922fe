/* Inside realisation: untouched ice comes into the world as the run needs it.
 *
 *   ice frame          X ---- column c-1 ---- column c ---- column c+1 ----   rows beside row 0, where something reaches them
 *   kernel frame       x = X + drift, drift = speed x time: columns come in from the left and are dropped when they have passed.
 *
 * Nothing upstream is an inlet: ice is made as far as the disturbance reaches, however far that is. Nor is the strip's width paid for:
 * a row of tiles is made when a disturbed floe comes near it. */
#ifndef FW_REALISATION_ICE_H
#define FW_REALISATION_ICE_H

#include "field/field.h"
#include "world/world.h"

typedef struct fw_ice_need {
    double from, low, high; /* ice has to be there from x on, for y from low to high; kernel frame [m] */
} fw_ice_need;

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
} fw_ice;

/* Lays the first columns round the structure: what would lie on it is not there. half_width: of the strip; warm_up_way: way of the current
 * before the window, which begins on the same ice whatever that is [m]. */
fw_status fw_ice_lay(fw_ice *ice, const fw_field_settings *s, fw_world *w, double half_width, double past,
                     double warm_up_way, fw_msg *m);
/* To be called before every step with what that needs. */
fw_status fw_ice_feed(fw_ice *ice, fw_world *w, const fw_ice_need *need, fw_msg *m);
void      fw_ice_free(fw_ice *ice);

#endif
