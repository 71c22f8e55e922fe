/* Which discs reach into which square cell: the question "does a disc at this place meet another" looks at the few
 * cells under the disc alone, however unlike the sizes are.
 *
 * A disc is listed in every cell it touches, not in its centre's cell only. Two discs that overlap share a point, the
 * point lies in a cell, and both are listed there; so no search radius with the largest radius in it is needed. With
 * floes of 0.4 m beside floes of 12 m a grid of centres would have to look at hundreds of cells per question.
 *
 * The grid may wrap round in y (a strip that is its own neighbour above and below). */
#ifndef FW_FIELD_COVER_H
#define FW_FIELD_COVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "field/squares.h"
#include "floewear/status.h"

typedef struct fw_cover_node {
    int32_t disc, next; /* next: index of a node, -1 at the end */
} fw_cover_node;

typedef struct fw_cover {
    fw_squares     at;
    bool           wraps_y; /* row -1 is row ny - 1 */
    int32_t       *first;   /* head node of each cell, -1 when empty  (nx * ny) */
    fw_cover_node *nodes;   /* (n_nodes), freed ones chained from free_node */
    int32_t        free_node;
    size_t         n_nodes, nodes_capacity, cells_capacity;
} fw_cover;

/* Empty grid over [x0, x1) x [y0, y1) with cells of about `cell` metres. Keeps memory from earlier use. Places outside
 * in x (and in y unless it wraps) count as the outermost cells, so discs may stick out. */
fw_status fw_cover_reset(fw_cover *c, double x0, double x1, double y0, double y1, bool wraps_y, double cell, fw_msg *m);
void      fw_cover_free(fw_cover *c); /* frees what it owns; a zeroed struct is fine */

/* List disc `disc` of radius r [m] at (x, y); remove needs the very numbers that add was given. The diameter must be
 * below the grid's height when it wraps. */
fw_status fw_cover_add(fw_cover *c, int32_t disc, double x, double y, double r, fw_msg *m);
void      fw_cover_remove(fw_cover *c, int32_t disc, double x, double y, double r);

/* Rows and columns under the square of half side r round (x, y): rows are not yet wrapped, see fw_cover_head. */
typedef struct fw_cover_box {
    int32_t x_begin, x_end, y_begin, y_end; /* half-open */
} fw_cover_box;

static inline int32_t fw_cover_clip(double t, int32_t n) { return t <= 0.0 ? 0 : t >= (double)n ? n - 1 : (int32_t)t; }

static inline fw_cover_box fw_cover_under(const fw_cover *c, double x, double y, double r)
{
    fw_cover_box b;
    double       low = (y - r - c->at.y0) * c->at.per_y, high = (y + r - c->at.y0) * c->at.per_y;
    b.x_begin = fw_cover_clip((x - r - c->at.x0) * c->at.per_x, c->at.nx);
    b.x_end = fw_cover_clip((x + r - c->at.x0) * c->at.per_x, c->at.nx) + 1;
    b.y_begin = c->wraps_y ? fw_squares_floor(low) : fw_cover_clip(low, c->at.ny);
    b.y_end = (c->wraps_y ? fw_squares_floor(high) : fw_cover_clip(high, c->at.ny)) + 1;
    return b;
}

/* First node of a cell of a box, -1 when empty. */
static inline int32_t fw_cover_head(const fw_cover *c, int32_t ix, int32_t iy)
{
    if (iy < 0) iy += c->at.ny;
    if (iy >= c->at.ny) iy -= c->at.ny;
    return c->first[iy * c->at.nx + ix];
}

#endif
