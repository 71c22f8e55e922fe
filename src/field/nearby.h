/* Which discs can refuse a floe whose centre lies in a square cell of a box: the question "is this place taken" looks at
 * one short list and nothing else.
 *
 * A disc is listed in every cell that holds a place nearer to it than its own radius plus the largest radius still to
 * come. Building that is dear beside one question and cheap beside dozens of them, so it is for ice that refuses most
 * places. Coordinates are copied into the lists, so that a question reads memory in one piece (abreast.h). */
#ifndef FW_FIELD_NEARBY_H
#define FW_FIELD_NEARBY_H

#include <stddef.h>
#include <stdint.h>

#include "field/abreast.h"
#include "field/squares.h"
#include "floewear/status.h"

enum { FW_NEARBY_SOME = FW_ABREAST };

typedef struct fw_nearby_some {
    double  x[FW_NEARBY_SOME], y[FW_NEARBY_SOME], r[FW_NEARBY_SOME]; /* beyond n: x = INFINITY, a disc nowhere */
    int32_t n, next;                                                 /* next: more of the cell's discs, -1 at the end */
} fw_nearby_some;

typedef struct fw_nearby {
    fw_squares      at;
    double          cell_y; /* height of a cell [m] */
    double          height; /* of the box when it wraps in y, else infinite [m] */
    double          r_most; /* largest radius to be asked for [m] */
    fw_nearby_some *some;   /* the first at.nx * at.ny are the heads of the cells */
    size_t          n_some, capacity;
} fw_nearby;

/* No discs yet; questions will be about places in [x0, x1) x [y0, y1) and radii up to r_most (gaps included). */
fw_status fw_nearby_reset(fw_nearby *b, double x0, double x1, double y0, double y1, bool wraps_y, double cell,
                          double r_most, fw_msg *m);
void      fw_nearby_free(fw_nearby *b); /* a zeroed struct is fine */
fw_status fw_nearby_add(fw_nearby *b, double x, double y, double r, fw_msg *m);

/* Is the place taken by a listed disc? */
static inline bool fw_nearby_is_taken(const fw_nearby *b, fw_place at)
{
    int32_t ix = (int32_t)((at.x - b->at.x0) * b->at.per_x), iy = (int32_t)((at.y - b->at.y0) * b->at.per_y);
    int32_t k = (iy < b->at.ny ? iy : b->at.ny - 1) * b->at.nx + (ix < b->at.nx ? ix : b->at.nx - 1);
    do {
        const fw_nearby_some *s = &b->some[k];
        if (fw_abreast_is_taken(s->x, s->y, s->r, FW_NEARBY_SOME, at)) return true;
        k = s->next;
    } while (k >= 0);
    return false;
}

#endif
