#include "field/packing.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "field/abreast.h"
#include "field/pushing.h"

/* Tuned on the five-class mix (0.5 to 1.3 m) and on {0.3 m: 2, 0.5 m: 1}; ms per tile at 60 / 65 %:
 * tries 20: 0.32 / 0.63, 50: 0.26 / 0.65, 100: 0.22 / 0.63, 200: 0.22 / 0.48, 500: 0.22-0.29 / 0.55-0.7 (before a try
 * became three times as cheap; changing the number would change the floes of every dense field). At 200 tries
 * 0.6 % of the floes are put down crowded at 60 %, 7 % at 65 %. Looking at 80 places for a crowded floe instead of 20
 * halves the pushes and still costs more. With these numbers the mixes pack to 80 %, one class of equal floes (h = 8.04
 * m) to 75 %; what does not is grown (growing.h). */
enum {
    PLAIN_TRIES = 192, /* of a call, each against every disc: about what lists of the nearby ones cost to build */
    MAX_TRIES = 200    /* refusals before a floe is put down crowded */
};

static size_t whole_rows(size_t n) { return (n + FW_ABREAST - 1) / FW_ABREAST * FW_ABREAST; }

static fw_status grow_discs(fw_packing *p, size_t n, fw_msg *m)
{
    if (n <= p->r_capacity) return FW_OK; /* the last to grow */
    FW_TRY(fw_grow(&p->x, &p->x_capacity, n, sizeof *p->x, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->y, &p->y_capacity, n, sizeof *p->y, "floes of an ice tile", m));
    return fw_grow(&p->r, &p->r_capacity, n, sizeof *p->r, "floes of an ice tile", m);
}

fw_status fw_packing_begin(fw_packing *p, const fw_packing_box *box, size_t n_most, double max_radius, double cell,
                           fw_msg *m)
{
    p->box = *box;
    p->reach = max_radius + FW_PACKING_GAP;
    p->rim = max_radius;
    p->cell = cell;
    p->x_last = nextafter(box->x1, -INFINITY);
    p->y_last = nextafter(box->y1, -INFINITY);
    p->height = box->wraps_y ? box->y1 - box->y0 : INFINITY;
    p->n_own = p->n_before = 0;
    p->n_most = p->n_discs = whole_rows(n_most);
    p->has_cover = false;
    p->queue_head = p->n_queued = 0;
    FW_TRY(grow_discs(p, p->n_most, m));
    FW_TRY(fw_grow(&p->queue, &p->queue_capacity, p->n_most, sizeof *p->queue, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->is_queued, &p->queued_capacity, p->n_most, sizeof *p->is_queued, "floes of an ice tile", m));
    for (size_t i = 0; i < p->n_most; i++) p->x[i] = INFINITY;
    return FW_OK;
}

fw_status fw_packing_cover(fw_packing *p, fw_msg *m)
{
    const fw_packing_box *b = &p->box;
    double                rim_y = b->wraps_y ? 0.0 : p->rim;
    if (p->has_cover) return FW_OK;
    FW_TRY(fw_cover_reset(&p->cover, b->x0 - p->rim, b->x1 + p->rim, b->y0 - rim_y, b->y1 + rim_y, b->wraps_y, p->cell,
                          m));
    for (size_t i = 0; i < p->n_before; i++) FW_TRY(fw_cover_add(&p->cover, (int32_t)i, p->x[i], p->y[i], p->r[i], m));
    for (size_t i = p->n_most; i < p->n_discs; i++)
        FW_TRY(fw_cover_add(&p->cover, (int32_t)i, p->x[i], p->y[i], p->r[i], m));
    for (size_t i = p->n_before; i < p->n_own; i++)
        FW_TRY(fw_cover_add(&p->cover, (int32_t)i, p->x[i], p->y[i], p->r[i], m));
    p->has_cover = true;
    return FW_OK;
}

fw_status fw_packing_add(fw_packing *p, double x, double y, double r, fw_msg *m)
{
    size_t i = p->n_own++;
    p->x[i] = x;
    p->y[i] = y;
    p->r[i] = r;
    p->is_queued[i] = 0;
    return p->has_cover ? fw_cover_add(&p->cover, (int32_t)i, x, y, r, m) : FW_OK;
}

fw_status fw_packing_own(fw_packing *p, size_t n, const double *x, const double *y, const double *r, fw_msg *m)
{
    for (size_t i = 0; i < n; i++) FW_TRY(fw_packing_add(p, x[i], y[i], r[i], m));
    if (p->n_discs == p->n_most) p->n_before = p->n_own;
    return FW_OK;
}

fw_status fw_packing_obstacles(fw_packing *p, size_t n, const double *x, const double *y, const double *r, fw_msg *m)
{
    const fw_packing_box *b = &p->box;
    double                y_low = b->wraps_y ? -INFINITY : b->y0, y_high = b->wraps_y ? INFINITY : b->y1;
    size_t                begin = p->n_discs, end = begin;
    FW_TRY(grow_discs(p, whole_rows(begin + n), m));
    /* Every floe is written down and the next one overwrites it when it was out of reach: one in eight is not, and a
     * processor that guesses which pays more than the copies. */
    for (size_t i = 0; i < n; i++) {
        double far = r[i] + p->reach;
        bool   is_left = x[i] < b->x0 - far, is_right = x[i] > b->x1 + far;
        bool   is_below = y[i] < y_low - far, is_above = y[i] > y_high + far;
        p->x[end] = x[i];
        p->y[end] = y[i];
        p->r[end] = r[i];
        end += !(is_left | is_right | is_below | is_above);
    }
    p->n_discs = end;
    for (size_t i = end; i < whole_rows(end); i++) p->x[i] = INFINITY;
    if (!p->has_cover) return FW_OK;
    for (size_t i = begin; i < end; i++) FW_TRY(fw_cover_add(&p->cover, (int32_t)i, p->x[i], p->y[i], p->r[i], m));
    return FW_OK;
}

/* Is the place taken by one of discs [begin, end)? What follows them up to a whole row lies nowhere. */
static bool is_taken_by(const fw_packing *p, size_t begin, size_t end, fw_place at)
{
    return fw_abreast_is_taken(p->x + begin, p->y + begin, p->r + begin, whole_rows(end - begin), at);
}

/* Lists for the floes r[0..n) that are still to be placed. */
static fw_status build_nearby(fw_packing *p, size_t n, const double *r, fw_msg *m)
{
    const fw_packing_box *b = &p->box;
    double                largest = 0.0;
    for (size_t k = 0; k < n; k++) largest = r[k] > largest ? r[k] : largest;
    FW_TRY(fw_nearby_reset(&p->nearby, b->x0, b->x1, b->y0, b->y1, b->wraps_y, p->cell, largest + FW_PACKING_GAP, m));
    for (size_t i = 0; i < p->n_own; i++) FW_TRY(fw_nearby_add(&p->nearby, p->x[i], p->y[i], p->r[i], m));
    for (size_t i = p->n_most; i < p->n_discs; i++) FW_TRY(fw_nearby_add(&p->nearby, p->x[i], p->y[i], p->r[i], m));
    return FW_OK;
}

fw_status fw_packing_place(fw_packing *p, size_t n, const double *r, uint64_t n_expected, fw_uniforms *random,
                           size_t *n_left, fw_msg *m)
{
    /* the lists at once where they are going to pay */
    int  n_plain = n < PLAIN_TRIES && n_expected < PLAIN_TRIES ? 0 : PLAIN_TRIES;
    bool has_nearby = false;
    *n_left = 0;
    for (size_t k = 0; k < n; k++) {
        double x = 0.0, y = 0.0;
        int    tries = 0;
        bool   is_refused = true;
        while (is_refused && tries < MAX_TRIES) {
            fw_packing_random_place(p, random, &x, &y);
            fw_place at = {.x = x, .y = y, .r = r[k], .gap = FW_PACKING_GAP, .height = p->height};
            if (!has_nearby && n_plain++ == PLAIN_TRIES) {
                FW_TRY(build_nearby(p, n - k, r + k, m));
                has_nearby = true;
            }
            is_refused = has_nearby ? fw_nearby_is_taken(&p->nearby, at)
                                    : is_taken_by(p, 0, p->n_own, at) || is_taken_by(p, p->n_most, p->n_discs, at);
            tries += is_refused;
        }
        p->cost.n_tries += (uint64_t)tries + 1;
        if (is_refused) {
            FW_TRY(fw_packing_cover(p, m));
            fw_pushing_least_crowded(p, r[k], -1, random, &x, &y);
        }
        FW_TRY(fw_packing_add(p, x, y, r[k], m));
        if (has_nearby) FW_TRY(fw_nearby_add(&p->nearby, x, y, r[k], m));
        if (is_refused) {
            p->cost.n_crowded++;
            fw_pushing_enqueue(p, (int32_t)p->n_own - 1);
        }
    }
    return fw_pushing_free_all(p, random, n_left, m);
}

void fw_packing_free(fw_packing *p)
{
    free(p->x);
    free(p->y);
    free(p->r);
    free(p->queue);
    free(p->is_queued);
    fw_cover_free(&p->cover);
    fw_nearby_free(&p->nearby);
    *p = (fw_packing){0};
}
