#include "field/cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

fw_status fw_cover_reset(fw_cover *c, double x0, double x1, double y0, double y1, bool wraps_y, double cell, fw_msg *m)
{
    c->at = fw_squares_of(x0, x1, y0, y1, cell);
    c->wraps_y = wraps_y;
    c->n_nodes = 0;
    c->free_node = -1;
    size_t n_cells = (size_t)c->at.nx * (size_t)c->at.ny;
    FW_TRY(fw_grow(&c->first, &c->cells_capacity, n_cells, sizeof *c->first, "cells of an ice tile", m));
    memset(c->first, 0xff, n_cells * sizeof *c->first); /* all -1 */
    return FW_OK;
}

void fw_cover_free(fw_cover *c)
{
    free(c->first);
    free(c->nodes);
    *c = (fw_cover){0};
}

/* Columns of row iy (not wrapped) that the disc touches: the widest chord of the disc inside the row's band. The radius
 * is taken a little larger, so that a question asked with a gap of micrometres cannot fall between two cells by
 * rounding. */
static void row_span(const fw_cover *c, int32_t iy, double x, double y, double r, int32_t *begin, int32_t *end)
{
    double reach = r * (1.0 + 1e-9) + 2e-6;
    double low = c->at.y0 + iy / c->at.per_y, high = c->at.y0 + (iy + 1) / c->at.per_y;
    double away = y < low ? low - y : y > high ? y - high : 0.0;
    /* Outermost rows also stand for all that lies beyond them. */
    if (!c->wraps_y && ((iy == 0 && y < low) || (iy == c->at.ny - 1 && y > high))) away = 0.0;
    double half = away < reach ? sqrt(reach * reach - away * away) : 0.0;
    *begin = fw_cover_clip((x - half - c->at.x0) * c->at.per_x, c->at.nx);
    *end = fw_cover_clip((x + half - c->at.x0) * c->at.per_x, c->at.nx) + 1;
}

static int32_t *head_of(fw_cover *c, int32_t ix, int32_t iy)
{
    if (iy < 0) iy += c->at.ny;
    if (iy >= c->at.ny) iy -= c->at.ny;
    return &c->first[iy * c->at.nx + ix];
}

static fw_status new_node(fw_cover *c, int32_t *node, fw_msg *m)
{
    if (c->free_node >= 0) {
        *node = c->free_node;
        c->free_node = c->nodes[*node].next;
        return FW_OK;
    }
    FW_TRY(fw_grow(&c->nodes, &c->nodes_capacity, c->n_nodes + 1, sizeof *c->nodes, "cell lists of an ice tile", m));
    *node = (int32_t)c->n_nodes++;
    return FW_OK;
}

fw_status fw_cover_add(fw_cover *c, int32_t disc, double x, double y, double r, fw_msg *m)
{
    fw_cover_box b = fw_cover_under(c, x, y, r + 2e-6);
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        int32_t begin, end;
        row_span(c, iy, x, y, r, &begin, &end);
        for (int32_t ix = begin; ix < end; ix++) {
            int32_t  node;
            int32_t *head;
            FW_TRY(new_node(c, &node, m));
            head = head_of(c, ix, iy);
            c->nodes[node] = (fw_cover_node){.disc = disc, .next = *head};
            *head = node;
        }
    }
    return FW_OK;
}

void fw_cover_remove(fw_cover *c, int32_t disc, double x, double y, double r)
{
    fw_cover_box b = fw_cover_under(c, x, y, r + 2e-6);
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        int32_t begin, end;
        row_span(c, iy, x, y, r, &begin, &end);
        for (int32_t ix = begin; ix < end; ix++) {
            int32_t *link = head_of(c, ix, iy);
            while (*link >= 0 && c->nodes[*link].disc != disc) link = &c->nodes[*link].next;
            if (*link < 0) continue;
            int32_t node = *link;
            *link = c->nodes[node].next;
            c->nodes[node].next = c->free_node;
            c->free_node = node;
        }
    }
}
