#include "kernel/neighbours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/strip.h"

void fw_neighbours_free(fw_neighbours *n)
{
    free(n->near);
    free(n->sleepers);
    fw_cells_free(&n->cells);
    memset(n, 0, sizeof *n);
}

bool fw_neighbours_is_stale(const fw_neighbours *n, const fw_setup *s, const fw_world *w, double macro_time)
{
    /* sleepers name floes by block and row: ice that came or went since has moved the numbers */
    if (!n->is_valid || n->blocks_listed != w->block_changes) return true;
    /* Ways are measured in the ice frame, where untouched floes stand still and the structure moves upstream. Two floes
     * close the skin only when the sum of their ways does. */
    double first = hypot(w->drift_x - n->drift_listed[0], w->drift_y - n->drift_listed[1]), second = 0; /* the structure's own way */
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        double         dx = b->x - w->drift_x - b->x_listed, dy = b->y - w->drift_y - b->y_listed, d2 = dx * dx + dy * dy;
        if (d2 > second * second) {
            double d = sqrt(d2);
            if (d > first)
                second = first, first = d;
            else
                second = d;
        }
    }
    /* What may be added within the coming macro-step. */
    return first + second + 2 * s->velocity_scale * macro_time > s->skin;
}

static fw_status add_near(fw_neighbours *n, int32_t i, int32_t j, fw_msg *m)
{
    FW_TRY(fw_grow(&n->near, &n->near_capacity, n->n_near + 1, sizeof *n->near, "neighbours", m));
    n->near[n->n_near++] = (fw_near){i, j};
    return FW_OK;
}

/* Untouched floes within skin of a point's rim; the point is awake floe i or the structure. */
static fw_status add_sleepers(fw_neighbours *n, const fw_setup *s, fw_world *w, int32_t i, double x, double y,
                              double radius, fw_msg *m)
{
    fw_strip strip = fw_strip_of(s, w);
    for (size_t k = 0; k < w->n_blocks; k++) {
        const fw_block *b = &w->blocks[k];
        double          X = x - w->drift_x, Y = y - w->drift_y, reach = radius + b->max_radius + s->skin;
        if (b->n_left == 0 || X < b->x_min - reach || X > b->x_max + reach) continue;
        size_t ix0, ix1, iy0, iy1;
        fw_cells_range(&b->cells, X, Y, reach, &ix0, &ix1, &iy0, &iy1);
        for (size_t iy = iy0; iy < iy1; iy++)
            for (size_t ix = ix0; ix < ix1; ix++)
                for (size_t q = b->cells.start[iy * b->cells.nx + ix]; q < b->cells.start[iy * b->cells.nx + ix + 1];
                     q++) {
                    size_t r = b->cells.item[q];
                    if (b->is_taken[r] || !fw_strip_has(&strip, b->x[r], b->y[r])) continue;
                    double dx = b->x[r] - X, dy = b->y[r] - Y, limit = radius + b->radius[r] + s->skin;
                    if (dx * dx + dy * dy > limit * limit) continue;
                    FW_TRY(fw_grow(&n->sleepers, &n->sleeper_capacity, n->n_sleepers + 1, sizeof *n->sleepers,
                                   "neighbours", m));
                    n->sleepers[n->n_sleepers++] = (fw_sleeper_near){i, k, r};
                }
    }
    return FW_OK;
}

fw_status fw_neighbours_list(fw_neighbours *n, const fw_setup *s, fw_world *w, fw_msg *m)
{
    n->n_near = n->n_sleepers = 0;
    n->drift_listed[0] = w->drift_x, n->drift_listed[1] = w->drift_y;
    n->blocks_listed = w->block_changes;
    w->ledger.rebuilds++;
    double big = 0;
    for (size_t i = 0; i < w->n_bodies; i++) big = fmax(big, w->bodies[i].radius);
    const size_t stride = sizeof(fw_body) / sizeof(double);
    if (s->has_floe_contact)
        FW_TRY(fw_cells_build(&n->cells, w->n_bodies, w->n_bodies ? &w->bodies[0].x : NULL,
                              w->n_bodies ? &w->bodies[0].y : NULL, stride, 2 * big + s->skin + 1e-6, m));
    for (size_t i = 0; i < w->n_bodies; i++) {
        fw_body *b = &w->bodies[i];
        b->x_listed = b->x - w->drift_x, b->y_listed = b->y - w->drift_y;
        if (s->has_floe_contact) {
            size_t from = n->n_near, ix0, ix1, iy0, iy1;
            fw_cells_range(&n->cells, b->x, b->y, b->radius + big + s->skin, &ix0, &ix1, &iy0, &iy1);
            for (size_t iy = iy0; iy < iy1; iy++)
                for (size_t ix = ix0; ix < ix1; ix++)
                    for (size_t q = n->cells.start[iy * n->cells.nx + ix];
                         q < n->cells.start[iy * n->cells.nx + ix + 1]; q++) {
                        size_t j = n->cells.item[q];
                        if (j <= i) continue;
                        const fw_body *c = &w->bodies[j];
                        double         dx = b->x - c->x, dy = b->y - c->y, limit = b->radius + c->radius + s->skin;
                        if (dx * dx + dy * dy < limit * limit) FW_TRY(add_near(n, (int32_t)i, (int32_t)j, m));
                    }
            /* ascending j, whatever the cells' order was (a handful of entries) */
            for (size_t a = from + 1; a < n->n_near; a++)
                for (size_t c = a; c > from && n->near[c].j < n->near[c - 1].j; c--) {
                    fw_near t = n->near[c];
                    n->near[c] = n->near[c - 1];
                    n->near[c - 1] = t;
                }
            FW_TRY(add_sleepers(n, s, w, (int32_t)i, b->x, b->y, b->radius, m));
        }
        double limit = s->structure_radius + b->radius + s->skin;
        if (b->x * b->x + b->y * b->y < limit * limit) FW_TRY(add_near(n, (int32_t)i, FW_WALL, m));
    }
    FW_TRY(add_sleepers(n, s, w, FW_WALL, 0, 0, s->structure_radius, m));
    n->is_valid = true;
    return FW_OK;
}
