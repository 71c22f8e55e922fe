#include "realisation/ice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The disturbance reaches 30-110 m upstream in ordinary fields. A pile that grows past this is no longer a
 * structure in a drifting field, and the realisation says so. */
static const double MAX_REACH = 5000;

/* The window begins on the same ice however long the warm-up: runs that differ in it, or in accuracy, can be compared. After this way of
 * the current [m] from where the origin lies in the middle of column 0. */
static const double USUAL_WARM_UP = 120;

fw_status fw_ice_add_tile(fw_ice *ice, fw_world *w, int64_t column, int64_t row, fw_msg *m)
{
    const fw_tile *t;
    FW_TRY(fw_field_tile(ice->field, column, row, &t, m));
    FW_TRY(fw_world_add_block(w, t->n_floes, t->x, t->y, t->radius, t->thickness, ice->n_named, m));
    ice->n_named += t->n_floes ? t->n_floes : 1; /* names of blocks are their own, empty ones' too */
    return FW_OK;
}

static bool lies_on_somebody(const fw_world *w, double x, double y, double radius)
{
    if (hypot(x, y) <= w->structure_radius + radius) return true;
    for (size_t k = 0; k < w->n_bodies; k++)
        if (hypot(x - w->bodies[k].x, y - w->bodies[k].y) <= w->bodies[k].radius + radius) return true;
    return false;
}

void fw_ice_clear(fw_world *w)
{
    fw_block *b = &w->blocks[w->n_blocks - 1];
    for (size_t i = 0; i < b->n; i++)
        if (lies_on_somebody(w, b->x[i] + w->drift_x, b->y[i] + w->drift_y, b->radius[i])) {
            b->is_taken[i] = true;
            b->n_left--;
        }
}

static fw_status add_column(fw_ice *ice, fw_world *w, bool is_start, fw_msg *m)
{
    FW_TRY(fw_grow(&ice->columns, &ice->capacity, ice->n_columns + 1, sizeof *ice->columns, "columns of ice", m));
    FW_TRY(fw_ice_add_tile(ice, w, ice->next_column, 0, m));
    if (is_start) fw_ice_clear(w);
    ice->columns[ice->n_columns++] = (struct fw_ice_column){.name = ice->next_column};
    ice->next_column--;
    return FW_OK;
}

/* Row 0 holds the structure's line; others where floes are disturbed, or may be before the next call. */
static fw_status add_rows(fw_ice *ice, fw_world *w, struct fw_ice_column *c, int64_t low, int64_t high, fw_msg *m)
{
    while (c->low > low) FW_TRY(fw_ice_add_tile(ice, w, c->name, --c->low, m));
    while (c->high < high) FW_TRY(fw_ice_add_tile(ice, w, c->name, ++c->high, m));
    return FW_OK;
}

static void drop_columns(fw_ice *ice, fw_world *w)
{
    size_t kept = 0;
    for (size_t i = 0; i < ice->n_columns; i++)
        if ((double)ice->columns[i].name * ice->length + w->drift_x <= ice->past) ice->columns[kept++] = ice->columns[i];
    if (kept == ice->n_columns) return;
    ice->n_columns = kept;
    fw_world_drop_blocks_beyond(w, ice->past);
    fw_field_forget(ice->field, ice->next_column + 3);
}

static int64_t row_of(const fw_ice *ice, double y)
{
    double row = floor(y / ice->length + 0.5);
    return row < (double)ice->row0 ? ice->row0 : row > (double)ice->row1 ? ice->row1 : (int64_t)row;
}

static fw_status supply(fw_ice *ice, fw_world *w, const fw_box *need, bool is_start, fw_msg *m)
{
    /* A floe of the next tile may stick out over the border by its radius. */
    double  r = w->max_radius, from = need->x0 - r;
    int64_t low = row_of(ice, need->y0 - r), high = row_of(ice, need->y1 + r);
    if (low > 0) low = 0;
    if (high < 0) high = 0;
    while ((double)(ice->next_column + 1) * ice->length + w->drift_x > from) FW_TRY(add_column(ice, w, is_start, m));
    int64_t all_low = ice->row0, all_high = ice->row1;
    for (size_t i = 0; i < ice->n_columns; i++) {
        struct fw_ice_column *c = &ice->columns[i];
        FW_TRY(add_rows(ice, w, c, low, high, m));
        if (c->low > all_low) all_low = c->low;
        if (c->high < all_high) all_high = c->high;
    }
    w->ice_from = (double)(ice->next_column + 1) * ice->length + r;
    w->ice_low = all_low == ice->row0 ? -INFINITY : ((double)all_low - 0.5) * ice->length + r;
    w->ice_high = all_high == ice->row1 ? INFINITY : ((double)all_high + 0.5) * ice->length - r;
    return FW_OK;
}

fw_status fw_ice_lay(fw_ice *ice, const fw_field_settings *s, fw_world *w, double half_width, double past,
                     double warm_up_way, fw_ice_way way, fw_msg *m)
{
    memset(ice, 0, sizeof *ice);
    FW_TRY(fw_field_create(&ice->field, s, m));
    ice->length = fw_field_tile_length(ice->field);
    ice->row1 = (int64_t)fmax(0, ceil(half_width / ice->length - 0.5 - 1e-9));
    ice->row0 = -ice->row1;
    w->max_radius = fw_field_max_radius(ice->field);
    ice->past = past + w->max_radius;
    w->drift_x = -0.5 * ice->length + (USUAL_WARM_UP - warm_up_way);
    ice->next_column = (int64_t)floor((ice->past - w->drift_x) / ice->length);
    ice->way = way;
    fw_box need = {-w->structure_radius, w->structure_radius, 0, 0};
    return way == FW_ICE_ALONG ? supply(ice, w, &need, true, m) : fw_ice_around(ice, w, &need, m);
}

fw_status fw_ice_feed(fw_ice *ice, fw_world *w, const fw_box *need, fw_msg *m)
{
    FW_CHECK(need->x0 > -MAX_REACH, m, FW_E_NUMERIC,
             "the pile of disturbed floes reaches %.0f m upstream at t = %.6g s: more than %.0f m", -need->x0, w->t,
             MAX_REACH);
    if (ice->way != FW_ICE_ALONG) return fw_ice_around(ice, w, need, m);
    FW_TRY(supply(ice, w, need, false, m));
    drop_columns(ice, w);
    return FW_OK;
}

void fw_ice_free(fw_ice *ice)
{
    fw_field_destroy(ice->field);
    free(ice->columns);
    free(ice->placed);
    memset(ice, 0, sizeof *ice);
}
