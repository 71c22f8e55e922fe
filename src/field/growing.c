#include "field/growing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "field/pushing.h"

enum {
    PLACES = 100, /* tried for a shrunk floe before it is put down crowded */
    ROUNDS = 100, /* steps of growth, taken or taken back */
    PUSHES = 100, /* per floe after a step of growth */
    SWEEPS = 30   /* of stirring after a step of growth */
};
/* Shares of the full radius. At the first half of the room is empty; steps of 0.05 instead of LONGEST, unstirred, jam
 * at 0.97 where these end at 1. */
static const double FIRST = 0.8, STIRRED = 0.85, LONGEST = 0.01, SHORTEST = 5e-4;
static const double ALIKE = 0.2; /* of the floes, by rank: how far down the sizes one looks to change places */

typedef struct growth {
    fw_packing  *p;
    fw_uniforms *random;
    double      *full, *x, *y; /* radii, and the places where the floes were last free  (n_own) */
    double       size;         /* they were so at this share of their radii */
    double       stride;       /* of stirring, in radii: as long as about two of five steps are free */
} growth;

static fw_status resize(growth *g, double size, fw_msg *m)
{
    g->p->has_cover = false;
    for (size_t i = 0; i < g->p->n_own; i++) g->p->r[i] = size * g->full[i];
    return fw_packing_cover(g->p, m);
}

static fw_status scatter(growth *g, size_t n, fw_msg *m)
{
    fw_packing *p = g->p;
    p->has_cover = false;
    p->n_own = p->n_before = 0;
    FW_TRY(fw_packing_cover(p, m));
    for (size_t i = 0; i < n; i++) {
        double x = 0.0, y = 0.0, r = FIRST * g->full[i];
        int    tries = 0;
        do fw_packing_random_place(p, g->random, &x, &y);
        while (fw_pushing_is_taken(p, x, y, r, -1) && ++tries < PLACES);
        if (tries == PLACES) fw_pushing_least_crowded(p, r, -1, g->random, &x, &y);
        FW_TRY(fw_packing_add(p, x, y, r, m));
    }
    return FW_OK;
}

/* Push all floes apart as large as they are now; were they all freed? */
static fw_status push(fw_packing *p, bool *is_free, fw_msg *m)
{
    for (size_t i = 0; i < p->n_own; i++) fw_pushing_enqueue(p, (int32_t)i);
    FW_TRY(fw_pushing_bout(p, PUSHES * p->n_own, m));
    *is_free = p->n_queued == 0;
    fw_pushing_forget(p);
    return FW_OK;
}

static void remember(growth *g, double size)
{
    memcpy(g->x, g->p->x, g->p->n_own * sizeof *g->x);
    memcpy(g->y, g->p->y, g->p->n_own * sizeof *g->y);
    g->size = size;
}

static fw_status take_back(growth *g, fw_msg *m)
{
    memcpy(g->p->x, g->x, g->p->n_own * sizeof *g->x);
    memcpy(g->p->y, g->y, g->p->n_own * sizeof *g->y);
    return resize(g, g->size, m);
}

static fw_status step_if_free(growth *g, int32_t i, bool *is_free, fw_msg *m)
{
    fw_packing           *p = g->p;
    const fw_packing_box *b = &p->box;
    double                far = 2.0 * g->stride * p->r[i];
    double                x = p->x[i] + far * (fw_uniforms_next(g->random) - 0.5);
    double                y = p->y[i] + far * (fw_uniforms_next(g->random) - 0.5);
    if (b->wraps_y) y += y < b->y0 ? b->y1 - b->y0 : y >= b->y1 ? b->y0 - b->y1 : 0.0;
    *is_free = x >= b->x0 && x <= p->x_last && y >= b->y0 && y <= p->y_last &&
               !fw_pushing_is_taken(p, x, y, p->r[i], i);
    return *is_free ? fw_pushing_move(p, i, x, y, m) : FW_OK;
}

/* The smaller floe always fits where the larger one was. */
static fw_status change_places_if_free(fw_packing *p, int32_t larger, int32_t smaller, fw_msg *m)
{
    double x = p->x[larger], y = p->y[larger];
    if (p->r[larger] == p->r[smaller]) return FW_OK;
    if (fw_pushing_is_taken(p, p->x[smaller], p->y[smaller], p->r[larger], smaller)) return FW_OK;
    FW_TRY(fw_pushing_move(p, larger, p->x[smaller], p->y[smaller], m));
    return fw_pushing_move(p, smaller, x, y, m);
}

static fw_status stir(growth *g, int n_sweeps, fw_msg *m)
{
    fw_packing *p = g->p;
    size_t      n = p->n_own;
    for (int sweep = 0; sweep < n_sweeps; sweep++) {
        size_t n_free = 0;
        for (size_t i = 0; i < n; i++) {
            bool is_free;
            FW_TRY(step_if_free(g, (int32_t)i, &is_free, m));
            n_free += is_free;
        }
        if (10 * n_free < 3 * n) g->stride *= 0.8;
        if (2 * n_free > n) g->stride = fmin(0.5, 1.25 * g->stride);
        for (size_t i = 0; i < n; i++) { /* largest first, so that what follows is smaller */
            size_t j = i + 1 + (size_t)(fw_uniforms_next(g->random) * ALIKE * (double)n);
            if (j < n) FW_TRY(change_places_if_free(p, (int32_t)i, (int32_t)j, m));
        }
    }
    return FW_OK;
}

static fw_status grow(growth *g, int patience, fw_msg *m)
{
    double step = LONGEST / patience;
    bool   is_free;
    FW_TRY(push(g->p, &is_free, m));
    if (!is_free) return FW_OK;
    remember(g, FIRST);
    for (int k = 0; k < ROUNDS * patience && g->size < 1.0; k++) {
        double size = fmin(1.0, g->size + step);
        FW_TRY(resize(g, size, m));
        FW_TRY(push(g->p, &is_free, m));
        if (is_free) {
            remember(g, size);
            step = fmin(1.2 * step, LONGEST / patience);
        } else {
            FW_TRY(take_back(g, m));
            step = fmax(0.5 * step, SHORTEST);
        }
        if (g->size < 1.0 && g->size > STIRRED) FW_TRY(stir(g, SWEEPS * patience, m));
    }
    return FW_OK;
}

fw_status fw_growing_pack(fw_packing *p, int patience, fw_uniforms *random, double *size, fw_msg *m)
{
    size_t    n = p->n_own;
    double   *block;
    fw_status status;
    FW_TRY(fw_alloc(&block, 3 * n, sizeof *block, "floes of an ice tile", m));
    growth g = {.p = p, .random = random, .full = block, .x = block + n, .y = block + 2 * n, .stride = 0.1};
    memcpy(g.full, p->r, n * sizeof *g.full);
    fw_pushing_forget(p);
    status = scatter(&g, n, m);
    if (status == FW_OK) status = grow(&g, patience, m);
    memcpy(p->r, g.full, n * sizeof *g.full);
    p->has_cover = false;
    *size = g.size;
    free(block);
    return status;
}
