#include "field/nearby.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

static double larger(double a, double b) { return a > b ? a : b; }

static void clear(fw_nearby_some *s)
{
    for (int i = 0; i < FW_NEARBY_SOME; i++) s->x[i] = INFINITY;
    s->n = 0;
    s->next = -1;
}

fw_status fw_nearby_reset(fw_nearby *b, double x0, double x1, double y0, double y1, bool wraps_y, double cell,
                          double r_most, fw_msg *m)
{
    b->at = fw_squares_of(x0, x1, y0, y1, cell);
    b->cell_y = (y1 - y0) / b->at.ny;
    b->height = wraps_y ? y1 - y0 : INFINITY;
    b->r_most = r_most;
    b->n_some = (size_t)b->at.nx * (size_t)b->at.ny;
    FW_TRY(fw_grow(&b->some, &b->capacity, b->n_some, sizeof *b->some, "cells of an ice tile", m));
    for (size_t k = 0; k < b->n_some; k++) clear(&b->some[k]);
    return FW_OK;
}

void fw_nearby_free(fw_nearby *b)
{
    free(b->some);
    *b = (fw_nearby){0};
}

/* Room for one more disc in a cell: the full ones move back, so that the head has it. */
static fw_status make_room(fw_nearby *b, int32_t cell, fw_msg *m)
{
    FW_TRY(fw_grow(&b->some, &b->capacity, b->n_some + 1, sizeof *b->some, "cell lists of an ice tile", m));
    fw_nearby_some *s = &b->some[cell];
    b->some[b->n_some] = *s;
    clear(s);
    s->next = (int32_t)b->n_some++;
    return FW_OK;
}

fw_status fw_nearby_add(fw_nearby *b, double x, double y, double r, fw_msg *m)
{
    const fw_squares at = b->at; /* a copy: what is written to the lists could be the grid's own numbers, for all C knows */
    const double     r_most = b->r_most, height = b->height, cell_y = b->cell_y;
    /* A little further than needed: rounding must not let a place fall between two cells. */
    double          reach = (r + r_most) * (1.0 + 1e-9) + 2e-6, at_x = x - at.x0, at_y = y - at.y0;
    double          low = (at_y - reach) * at.per_y, high = (at_y + reach) * at.per_y;
    bool            wraps = height < INFINITY;
    int32_t         begin = fw_squares_floor(wraps || low > 0.0 ? low : 0.0);
    int32_t         end = fw_squares_floor(wraps || high < at.ny ? high : at.ny - 1.0) + 1;
    bool is_all_round = wraps && end - begin > at.ny; /* as tall as the box: every row, and each of them once */
    if (is_all_round) begin = 0, end = at.ny;
    for (int32_t iy = begin; iy < end; iy++) {
        double  away = larger(0.0, larger(iy * cell_y - at_y, at_y - (iy + 1) * cell_y));
        double  half = is_all_round ? reach : sqrt(larger(0.0, reach * reach - away * away));
        double  left = (at_x - half) * at.per_x, right = (at_x + half) * at.per_x;
        int32_t row = (iy < 0 ? iy + at.ny : iy >= at.ny ? iy - at.ny : iy) * at.nx;
        if (right < 0.0 || left >= at.nx) continue;
        int32_t ix_begin = left > 0.0 ? (int32_t)left : 0, ix_end = right < at.nx ? (int32_t)right + 1 : at.nx;
        for (int32_t ix = ix_begin; ix < ix_end; ix++) {
            fw_nearby_some *s = &b->some[row + ix];
            if (s->n == FW_NEARBY_SOME) {
                FW_TRY(make_room(b, row + ix, m));
                s = &b->some[row + ix];
            }
            int32_t n = s->n++;
            s->x[n] = x;
            s->y[n] = y;
            s->r[n] = r;
        }
    }
    return FW_OK;
}
