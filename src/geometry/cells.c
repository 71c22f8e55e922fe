#include "geometry/cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static size_t cell_of(const fw_cells *c, double x, double y)
{
    double fx = (x - c->x0) / c->size, fy = (y - c->y0) / c->size;
    size_t ix = fx > 0 ? (size_t)fx : 0, iy = fy > 0 ? (size_t)fy : 0;
    if (ix >= c->nx) ix = c->nx - 1;
    if (iy >= c->ny) iy = c->ny - 1;
    return iy * c->nx + ix;
}

fw_status fw_cells_build(fw_cells *c, size_t n, const double *x, const double *y, size_t stride, double size, fw_msg *m)
{
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    bool   is_finite = true;
    for (size_t i = 0; i < n; i++) {
        double px = x[i * stride], py = y[i * stride];
        x0 = px < x0 ? px : x0, x1 = px > x1 ? px : x1;
        y0 = py < y0 ? py : y0, y1 = py > y1 ? py : y1;
        is_finite = is_finite && isfinite(px) && isfinite(py);
    }
    if (n == 0) x0 = x1 = y0 = y1 = 0;
    FW_CHECK(is_finite, m, FW_E_NUMERIC, "a floe's position is not finite");
    while ((x1 - x0) / size * ((y1 - y0) / size) > 8192 || (x1 - x0) / size > 4096 || (y1 - y0) / size > 4096)
        size *= 2;
    c->x0 = x0, c->y0 = y0, c->size = size;
    c->nx = (size_t)((x1 - x0) / size) + 1, c->ny = (size_t)((y1 - y0) / size) + 1;
    size_t n_cells = c->nx * c->ny;
    FW_TRY(fw_grow(&c->start, &c->start_capacity, n_cells + 1, sizeof *c->start, "cell grid", m));
    FW_TRY(fw_grow(&c->item, &c->item_capacity, n + 1, sizeof *c->item, "cell grid", m));
    FW_TRY(fw_grow(&c->cell, &c->cell_capacity, n + 1, sizeof *c->cell, "cell grid", m));
    memset(c->start, 0, n_cells * sizeof *c->start);
    c->n_items = n;
    for (size_t i = 0; i < n; i++) {
        c->cell[i] = cell_of(c, x[i * stride], y[i * stride]);
        c->start[c->cell[i]]++;
    }
    size_t end = 0;
    for (size_t k = 0; k < n_cells; k++) c->start[k] = end += c->start[k];
    c->start[n_cells] = n;
    /* Filled from the back: start[k] goes down from the end of cell k to where it begins, and items of a cell stay
     * ascending. */
    for (size_t i = n; i-- > 0;) c->item[--c->start[c->cell[i]]] = i;
    return FW_OK;
}

void fw_cells_free(fw_cells *c)
{
    free(c->start);
    free(c->item);
    free(c->cell);
    memset(c, 0, sizeof *c);
}

static void range(double at, double reach, double origin, double size, size_t n, size_t *from, size_t *to)
{
    double a = floor((at - reach - origin) / size), b = floor((at + reach - origin) / size) + 1;
    *from = a > 0 ? (a < (double)n ? (size_t)a : n) : 0;
    *to = b > 0 ? (b < (double)n ? (size_t)b : n) : 0;
}

void fw_cells_range(const fw_cells *c, double x, double y, double reach, size_t *ix0, size_t *ix1, size_t *iy0,
                    size_t *iy1)
{
    range(x, reach, c->x0, c->size, c->nx, ix0, ix1);
    range(y, reach, c->y0, c->size, c->ny, iy0, iy1);
}
