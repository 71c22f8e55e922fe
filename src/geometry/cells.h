/* A uniform grid over points, to find neighbours: built by counting sort, walked in a fixed order. */
#ifndef FW_GEOMETRY_CELLS_H
#define FW_GEOMETRY_CELLS_H

#include <stddef.h>

#include "floewear/status.h"

typedef struct fw_cells {
    double  x0, y0, size; /* lower corner [m], side of a cell [m] */
    size_t  nx, ny;
    size_t *start; /* (nx * ny + 1) */
    size_t *item;  /* (n_items) points sorted by cell, ascending inside a cell */
    size_t *cell;  /* (n_items) of each point, while building */
    size_t  n_items, item_capacity, start_capacity, cell_capacity;
} fw_cells;

/* Points x[i * stride], y[i * stride]; at most 16384 cells: the side grows over size where the points lie wide. */
fw_status fw_cells_build(fw_cells *c, size_t n, const double *x, const double *y, size_t stride, double size,
                         fw_msg *m);
void      fw_cells_free(fw_cells *c);

/* Half-open index ranges of the cells within reach of a point, clamped to the grid; empty when it lies outside. */
void fw_cells_range(const fw_cells *c, double x, double y, double reach, size_t *ix0, size_t *ix1, size_t *iy0,
                    size_t *iy1);

#endif
