#include "world/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

fw_status fw_world_create(fw_world **out, double structure_radius, fw_msg *m)
{
    FW_TRY(fw_alloc(out, 1, sizeof **out, "world", m));
    (*out)->structure_radius = structure_radius;
    (*out)->ice_from = (*out)->ice_low = -INFINITY, (*out)->ice_to = (*out)->ice_high = INFINITY;
    return FW_OK;
}

static void block_free(fw_block *b)
{
    free(b->x);
    free(b->is_taken);
    fw_cells_free(&b->cells);
}

void fw_world_destroy(fw_world *w)
{
    if (!w) return;
    for (size_t i = 0; i < w->block_capacity; i++) block_free(&w->blocks[i]);
    free(w->blocks);
    for (size_t i = 0; i < w->n_bodies; i++) free(w->bodies[i].rim);
    free(w->bodies);
    free(w->contacts);
    free(w);
}

static double kinetic(const fw_body *b)
{
    double e = 0.5 * (b->vx * b->vx + b->vy * b->vy) / b->inv_mass;
    return b->inv_inertia > 0 ? e + 0.5 * b->spin * b->spin / b->inv_inertia : e;
}

fw_status fw_world_add_body(fw_world *w, const fw_body *proto, fw_msg *m)
{
    FW_TRY(fw_grow(&w->bodies, &w->body_capacity, w->n_bodies + 1, sizeof *w->bodies, "awake floes", m));
    fw_body *b = &w->bodies[w->n_bodies++];
    *b = *proto;
    b->t = w->t;
    b->t_wall = b->t_hit = -INFINITY;
    b->is_touched = false;
    b->angle = 0, b->rim = NULL;
    b->x_listed = b->x - w->drift_x, b->y_listed = b->y - w->drift_y;
    w->max_radius = fmax(w->max_radius, b->radius);
    w->ledger.inflow += kinetic(b);
    w->ledger.floes_in++;
    return FW_OK;
}

fw_status fw_world_add_block(fw_world *w, size_t n, const double *x, const double *y, const double *radius,
                             const double *thickness, uint64_t first_name, fw_msg *m)
{
    FW_TRY(fw_grow(&w->blocks, &w->block_capacity, w->n_blocks + 1, sizeof *w->blocks, "blocks of ice", m));
    fw_block *b = &w->blocks[w->n_blocks]; /* zeroed, or with the memory of a dropped one */
    FW_TRY(fw_grow(&b->x, &b->x_capacity, 4 * n + 1, sizeof *b->x, "block of ice", m));
    FW_TRY(fw_grow(&b->is_taken, &b->taken_capacity, n + 1, sizeof *b->is_taken, "block of ice", m));
    b->y = b->x + n, b->radius = b->x + 2 * n, b->thickness = b->x + 3 * n;
    b->n = b->n_left = n;
    b->first_name = first_name;
    double x_min = INFINITY, x_max = -INFINITY, max_radius = 0;
    for (size_t i = 0; i < n; i++) {
        b->x[i] = x[i], b->y[i] = y[i], b->radius[i] = radius[i], b->thickness[i] = thickness[i];
        b->is_taken[i] = false;
        x_min = x[i] < x_min ? x[i] : x_min, x_max = x[i] > x_max ? x[i] : x_max;
        max_radius = radius[i] > max_radius ? radius[i] : max_radius;
    }
    b->x_min = x_min, b->x_max = x_max, b->max_radius = max_radius;
    FW_TRY(fw_cells_build(&b->cells, n, b->x, b->y, 1, fmax(8.0, b->max_radius), m));
    w->max_radius = fmax(w->max_radius, b->max_radius);
    w->n_blocks++;
    w->block_changes++;
    return FW_OK;
}

void fw_world_drop_blocks_beyond(fw_world *w, double x)
{
    size_t kept = 0;
    for (size_t i = 0; i < w->n_blocks; i++) {
        fw_block b = w->blocks[i];
        if (b.n_left == 0 || b.x_min + w->drift_x > x) continue;
        w->blocks[i] = w->blocks[kept];
        w->blocks[kept++] = b;
    }
    if (kept != w->n_blocks) w->block_changes++;
    w->n_blocks = kept;
}

void fw_world_drop_block(fw_world *w, uint64_t first_name)
{
    for (size_t i = 0; i < w->n_blocks; i++) {
        if (w->blocks[i].first_name != first_name) continue;
        fw_block b = w->blocks[i];
        for (size_t k = i; k + 1 < w->n_blocks; k++) w->blocks[k] = w->blocks[k + 1];
        w->blocks[--w->n_blocks] = b;
        w->block_changes++;
        return;
    }
}

static double stored(const fw_world *w, const fw_contact *c)
{
    double d = fw_world_overlap(w, c->i, c->j);
    return (d > 0 ? 0.5 * c->stiffness * d * d : 0) + c->energy;
}

void fw_world_forget(fw_world *w, const bool *is_gone)
{
    /* Where a forgotten floe still presses on something its spring energy leaves with it. */
    size_t kept = 0;
    for (size_t k = 0; k < w->n_contacts; k++) {
        fw_contact c = w->contacts[k];
        if (is_gone[c.i] || (c.j >= 0 && is_gone[c.j])) {
            w->ledger.outflow += stored(w, &c);
        } else {
            w->contacts[kept++] = c;
        }
    }
    w->n_contacts = kept;
    /* New place of each floe, floes only move down, so contacts can follow one by one. */
    size_t next = 0;
    for (size_t i = 0; i < w->n_bodies; i++) {
        if (is_gone[i]) {
            w->ledger.outflow += kinetic(&w->bodies[i]);
            w->ledger.floes_out++;
            free(w->bodies[i].rim);
            continue;
        }
        if (next != i) {
            w->bodies[next] = w->bodies[i];
            for (size_t k = 0; k < w->n_contacts; k++) {
                if (w->contacts[k].i == (int32_t)i) w->contacts[k].i = (int32_t)next;
                if (w->contacts[k].j == (int32_t)i) w->contacts[k].j = (int32_t)next;
            }
        }
        next++;
    }
    w->n_bodies = next;
}

double fw_world_overlap(const fw_world *w, int32_t i, int32_t j)
{
    const fw_body *a = &w->bodies[i];
    if (j == FW_WALL) return w->structure_radius + a->radius - sqrt(a->x * a->x + a->y * a->y);
    const fw_body *b = &w->bodies[j];
    double         dx = a->x - b->x, dy = a->y - b->y;
    return a->radius + b->radius - sqrt(dx * dx + dy * dy);
}

double fw_world_energy(const fw_world *w)
{
    double e = 0;
    for (size_t i = 0; i < w->n_bodies; i++) e += kinetic(&w->bodies[i]);
    for (size_t k = 0; k < w->n_contacts; k++) e += stored(w, &w->contacts[k]);
    return e;
}

void fw_world_open_ledger(fw_world *w)
{
    memset(&w->ledger, 0, sizeof w->ledger);
    w->energy_start = fw_world_energy(w);
    w->ledger.floes_start = (double)w->n_bodies;
}
