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
    double nx = floor((x1 - x0) / cell), ny = floor((y1 - y0) / cell);
    b->x0 = x0;
    b->y0 = y0;
    b->nx = nx < 1.0 ? 1 : (int32_t)nx;
    b->ny = ny < 1.0 ? 1 : (int32_t)ny;
    b->per_x = b->nx / (x1 - x0);
    b->per_y = b->ny / (y1 - y0);
    b->cell_x = (x1 - x0) / b->nx;
    b->cell_y = (y1 - y0) / b->ny;
    b->height = wraps_y ? y1 - y0 : INFINITY;
    b->r_most = r_most;
    b->n_some = (size_t)b->nx * (size_t)b->ny;
    FW_TRY(fw_grow(&b->some, &b->capacity, b->n_some, sizeof *b->some, "cells of an ice tile", m));
    for (size_t k = 0; k < b->n_some; k++) clear(&b->some[k]);
    return FW_OK;
}

void fw_nearby_free(fw_nearby *b)
{
    free(b->some);
    *b = (fw_nearby){0};
}

static int32_t floor_of(double t)
{
    int32_t i = (int32_t)t;
    return i - (t < (double)i);
}

static fw_status add_to(fw_nearby *b, int32_t cell, double x, double y, double r, fw_msg *m)
{
    fw_nearby_some *s = &b->some[cell];
    if (s->n == FW_NEARBY_SOME) { /* the full ones move back, so that the head has room */
        FW_TRY(fw_grow(&b->some, &b->capacity, b->n_some + 1, sizeof *b->some, "cell lists of an ice tile", m));
        s = &b->some[cell];
        b->some[b->n_some] = *s;
        clear(s);
        s->next = (int32_t)b->n_some++;
    }
    s->x[s->n] = x;
    s->y[s->n] = y;
    s->r[s->n] = r;
    s->n++;
    return FW_OK;
}

fw_status fw_nearby_add(fw_nearby *b, double x, double y, double r, fw_msg *m)
{
    /* A little further than needed: rounding must not let a place fall between two cells. */
    double  reach = (r + b->r_most) * (1.0 + 1e-9) + 2e-6, at_x = x - b->x0, at_y = y - b->y0;
    double  low = (at_y - reach) * b->per_y, high = (at_y + reach) * b->per_y;
    bool    wraps = b->height < INFINITY;
    int32_t begin = floor_of(wraps ? low : larger(low, 0.0)), end = floor_of(wraps || high < b->ny ? high : b->ny - 1.0) + 1;
    bool    is_all_round = wraps && end - begin > b->ny; /* as tall as the box: every row, and each of them once */
    if (is_all_round) begin = 0, end = b->ny;
    for (int32_t iy = begin; iy < end; iy++) {
        double  away = larger(0.0, larger(iy * b->cell_y - at_y, at_y - (iy + 1) * b->cell_y));
        double  half = is_all_round ? reach : sqrt(larger(0.0, reach * reach - away * away));
        double  left = (at_x - half) * b->per_x, right = (at_x + half) * b->per_x;
        int32_t row = (iy < 0 ? iy + b->ny : iy >= b->ny ? iy - b->ny : iy) * b->nx;
        if (right < 0.0 || left >= b->nx) continue;
        int32_t ix_end = right < b->nx ? (int32_t)right + 1 : b->nx;
        for (int32_t ix = left > 0.0 ? (int32_t)left : 0; ix < ix_end; ix++) FW_TRY(add_to(b, row + ix, x, y, r, m));
    }
    return FW_OK;
}
