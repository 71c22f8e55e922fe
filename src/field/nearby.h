/* Which discs can refuse a floe whose centre lies in a square cell of a box: the question "is this place taken" looks at
 * one short list and nothing else.
 *
 * A disc is listed in every cell that holds a place nearer to it than its own radius plus the largest radius still to
 * come. Building that is dear beside one question and cheap beside dozens of them, so it is for ice that refuses most
 * places. Coordinates are copied into the lists, FW_NEARBY_SOME discs at a time with none of them skipped: no branch
 * and no look-up per disc. */
#ifndef FW_FIELD_NEARBY_H
#define FW_FIELD_NEARBY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

enum { FW_NEARBY_SOME = 4 };

typedef struct fw_nearby_some {
    double  x[FW_NEARBY_SOME], y[FW_NEARBY_SOME], r[FW_NEARBY_SOME]; /* beyond n: x = INFINITY, a disc nowhere */
    int32_t n, next; /* next: more of the cell's discs, -1 at the end */
} fw_nearby_some;

typedef struct fw_nearby {
    double          x0, y0;         /* low corner [m] */
    double          per_x, per_y;   /* cells per metre */
    double          cell_x, cell_y; /* sides [m] */
    double          height;         /* of the box when it wraps in y, else infinite */
    double          r_most;         /* largest radius to be asked for [m] */
    int32_t         nx, ny;
    fw_nearby_some *some; /* the first nx * ny are the heads of the cells */
    size_t          n_some, capacity;
} fw_nearby;

/* No discs yet; questions will be about places in [x0, x1) x [y0, y1) and radii up to r_most (gaps included). */
fw_status fw_nearby_reset(fw_nearby *b, double x0, double x1, double y0, double y1, bool wraps_y, double cell,
                          double r_most, fw_msg *m);
void      fw_nearby_free(fw_nearby *b); /* a zeroed struct is fine */
fw_status fw_nearby_add(fw_nearby *b, double x, double y, double r, fw_msg *m);

/* Does a listed disc come nearer than gap to a disc here? */
static inline bool fw_nearby_is_taken(const fw_nearby *b, double x, double y, double r, double gap)
{
    int32_t ix = (int32_t)((x - b->x0) * b->per_x), iy = (int32_t)((y - b->y0) * b->per_y);
    int32_t k = (iy < b->ny ? iy : b->ny - 1) * b->nx + (ix < b->nx ? ix : b->nx - 1);
    double  height = b->height, half = 0.5 * height;
    do {
        const fw_nearby_some *s = &b->some[k];
        int                   is_taken = 0;
        for (int i = 0; i < FW_NEARBY_SOME; i++) {
            double dx = x - s->x[i], dy = y - s->y[i], limit = r + s->r[i] + gap;
            dy = dy > half ? dy - height : dy < -half ? dy + height : dy;
            is_taken |= dx * dx + dy * dy < limit * limit;
        }
        if (is_taken) return true;
        k = s->next;
    } while (k >= 0);
    return false;
}

#endif
