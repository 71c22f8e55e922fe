/* Ice that comes from any side: tiles are put where they are needed and taken away when they are half a tile past that. */
#include <math.h>

#include "base/memory.h"
#include "realisation/ice.h"

/* A quarter of a million square metres of tiles round one structure is more than a jam that turns with the tide has been seen to fill. */
static const double MAX_SIDE = 10000;

/* Tiles low .. high hold all floes whose centres lie between from and to. */
typedef struct span {
    int64_t low, high;
} span;

static span span_of(double from, double to, double length, double offset)
{
    return (span){(int64_t)floor(from / length + offset), (int64_t)floor(to / length + offset)};
}

static bool is_placed(const fw_ice *ice, int64_t column, int64_t row)
{
    for (size_t i = 0; i < ice->n_placed; i++)
        if (ice->placed[i].column == column && ice->placed[i].row == row) return true;
    return false;
}

static fw_status place(fw_ice *ice, fw_world *w, int64_t column, int64_t row, fw_msg *m)
{
    FW_TRY(fw_grow(&ice->placed, &ice->placed_capacity, ice->n_placed + 1, sizeof *ice->placed, "tiles of ice", m));
    ice->placed[ice->n_placed++] = (struct fw_ice_placed){column, row, ice->n_named};
    FW_TRY(fw_ice_add_tile(ice, w, column, row, m));
    fw_ice_clear(w); /* ice that comes back finds who stayed */
    return FW_OK;
}

static bool is_beyond(int64_t i, span s) { return i < s.low || i > s.high; }

static void drop(fw_ice *ice, fw_world *w, span columns, span rows)
{
    size_t kept = 0;
    for (size_t i = 0; i < ice->n_placed; i++) {
        struct fw_ice_placed p = ice->placed[i];
        if (is_beyond(p.column, columns) || is_beyond(p.row, rows))
            fw_world_drop_block(w, p.first_name);
        else
            ice->placed[kept++] = p;
    }
    ice->n_placed = kept;
}

fw_status fw_ice_around(fw_ice *ice, fw_world *w, const fw_box *need, fw_msg *m)
{
    /* A floe of the next tile may stick out over the border by its radius. */
    double L = ice->length, r = w->max_radius, half = 0.5 * L;
    double x0 = need->x0 - w->drift_x - r, x1 = need->x1 - w->drift_x + r, y0 = need->y0 - w->drift_y - r, y1 = need->y1 - w->drift_y + r;
    FW_CHECK(x1 - x0 < MAX_SIDE && y1 - y0 < MAX_SIDE, m, FW_E_NUMERIC,
             "disturbed floes are spread over %.0f m by %.0f m at t = %.6g s: more than %.0f m", x1 - x0, y1 - y0, w->t, MAX_SIDE);
    drop(ice, w, span_of(x0 - half, x1 + half, L, 0), span_of(y0 - half, y1 + half, L, 0.5));
    span columns = span_of(x0, x1, L, 0), rows = span_of(y0, y1, L, 0.5);
    for (int64_t c = columns.high; c >= columns.low; c--)
        for (int64_t k = rows.low; k <= rows.high; k++)
            if (!is_placed(ice, c, k)) FW_TRY(place(ice, w, c, k, m));
    if (ice->way == FW_ICE_ACROSS) fw_field_forget(ice->field, columns.high + 2);
    w->ice_from = (double)columns.low * L + r, w->ice_to = (double)(columns.high + 1) * L - r;
    w->ice_low = ((double)rows.low - 0.5) * L + r, w->ice_high = ((double)rows.high + 0.5) * L - r;
    return FW_OK;
}
