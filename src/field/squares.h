/* Inside the field only: the square cells that an ice tile's box is divided into, by whoever lists discs in them. */
#ifndef FW_FIELD_SQUARES_H
#define FW_FIELD_SQUARES_H

#include <math.h>
#include <stdint.h>

typedef struct fw_squares {
    double  x0, y0;       /* low corner [m] */
    double  per_x, per_y; /* cells per metre */
    int32_t nx, ny;
} fw_squares;

/* [x0, x1) x [y0, y1) in whole cells of about `cell` metres, at least one each way. */
static inline fw_squares fw_squares_of(double x0, double x1, double y0, double y1, double cell)
{
    double     nx = floor((x1 - x0) / cell), ny = floor((y1 - y0) / cell);
    fw_squares s = {.x0 = x0, .y0 = y0, .nx = nx < 1.0 ? 1 : (int32_t)nx, .ny = ny < 1.0 ? 1 : (int32_t)ny};
    s.per_x = s.nx / (x1 - x0);
    s.per_y = s.ny / (y1 - y0);
    return s;
}

static inline int32_t fw_squares_floor(double t)
{
    int32_t i = (int32_t)t;
    return i - (t < (double)i);
}

#endif
