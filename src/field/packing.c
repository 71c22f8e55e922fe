#include "field/packing.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* Tuned on the five-class mix (0.5 to 1.3 m) and on {0.3 m: 2, 0.5 m: 1}; ms per tile at 60 / 65 %:
 * tries 20: 0.32 / 0.63, 50: 0.26 / 0.65, 100: 0.22 / 0.63, 200: 0.22 / 0.48, 500: 0.22-0.29 / 0.55-0.7. At 200 tries
 * 0.6 % of the floes are put down crowded at 60 %, 7 % at 65 %. Looking at 80 places for a crowded floe instead of 20
 * halves the pushes and still costs more. With these numbers the mixes pack to 80 %, one class of equal floes (h = 8.04
 * m) to 75 %. */
enum {
    MAX_TRIES = 200,       /* refusals before a floe is put down crowded */
    CROWDED_PLACES = 20,   /* places looked at then */
    MAX_OVERLAPS = 64,     /* overlaps of one floe handled at once; more are seen when it is looked at again */
    PUSHES_PER_FLOE = 200, /* of a bout, before a floe is moved elsewhere (a tenth of it after the first) */
    MAX_MOVES = 200        /* floes moved elsewhere before the packing gives up */
};
static const double GAP = 1e-6;      /* [m] least distance between rims: far above rounding at 1e8 m from the origin */
static const double PUSH_GAP = 1e-3; /* of the smaller radius: distance between rims after a push; without it the last
                                      * micrometres of a chain of pushes never end */

fw_status fw_packing_begin(fw_packing *p, const fw_packing_box *box, size_t n_most, double max_radius, double cell,
                           fw_msg *m)
{
    p->box = *box;
    p->reach = max_radius + GAP;
    p->n_own = 0;
    p->n_most = p->n_discs = n_most;
    FW_TRY(fw_grow(&p->x, &p->x_capacity, n_most, sizeof *p->x, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->y, &p->y_capacity, n_most, sizeof *p->y, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->r, &p->r_capacity, n_most, sizeof *p->r, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->queue, &p->queue_capacity, n_most, sizeof *p->queue, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->is_queued, &p->queued_capacity, n_most, sizeof *p->is_queued, "floes of an ice tile", m));
    double rim = box->wraps_y ? 0.0 : max_radius;
    return fw_cover_reset(&p->cover, box->x0 - max_radius, box->x1 + max_radius, box->y0 - rim, box->y1 + rim,
                          box->wraps_y, cell, m);
}

fw_status fw_packing_own(fw_packing *p, double x, double y, double r, fw_msg *m)
{
    size_t i = p->n_own++;
    p->x[i] = x;
    p->y[i] = y;
    p->r[i] = r;
    p->is_queued[i] = 0;
    return fw_cover_add(&p->cover, (int32_t)i, x, y, r, m);
}

fw_status fw_packing_obstacle(fw_packing *p, double x, double y, double r, fw_msg *m)
{
    const fw_packing_box *b = &p->box;
    double                far = r + p->reach;
    if (x < b->x0 - far || x > b->x1 + far || (!b->wraps_y && (y < b->y0 - far || y > b->y1 + far))) return FW_OK;
    size_t i = p->n_discs, n = i + 1;
    FW_TRY(fw_grow(&p->x, &p->x_capacity, n, sizeof *p->x, "floes round an ice tile", m));
    FW_TRY(fw_grow(&p->y, &p->y_capacity, n, sizeof *p->y, "floes round an ice tile", m));
    FW_TRY(fw_grow(&p->r, &p->r_capacity, n, sizeof *p->r, "floes round an ice tile", m));
    p->x[i] = x;
    p->y[i] = y;
    p->r[i] = r;
    p->n_discs = n;
    return fw_cover_add(&p->cover, (int32_t)i, x, y, r, m);
}

/* y distance, to the nearest image when the box wraps */
static double across(const fw_packing_box *b, double dy)
{
    if (!b->wraps_y) return dy;
    double height = b->y1 - b->y0;
    return dy > 0.5 * height ? dy - height : dy < -0.5 * height ? dy + height : dy;
}

/* Does a disc here come nearer than GAP to another one (disc `self` left out, -1: none)? */
static bool is_taken(const fw_packing *p, double x, double y, double r, int32_t self)
{
    fw_cover_box b = fw_cover_under(&p->cover, x, y, r + GAP);
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        for (int32_t ix = b.x_begin; ix < b.x_end; ix++) {
            for (int32_t k = fw_cover_head(&p->cover, ix, iy); k >= 0; k = p->cover.nodes[k].next) {
                int32_t j = p->cover.nodes[k].disc;
                double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), s = r + p->r[j] + GAP;
                if (dx * dx + dy * dy < s * s && j != self) return true;
            }
        }
    }
    return false;
}

/* Discs that disc-to-be `self` at (x, y) comes nearer to than GAP, each once; at most MAX_OVERLAPS of them. */
static int list_overlaps(const fw_packing *p, double x, double y, double r, int32_t self, int32_t list[MAX_OVERLAPS])
{
    fw_cover_box b = fw_cover_under(&p->cover, x, y, r + GAP);
    int          n = 0;
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        for (int32_t ix = b.x_begin; ix < b.x_end; ix++) {
            for (int32_t k = fw_cover_head(&p->cover, ix, iy); k >= 0; k = p->cover.nodes[k].next) {
                int32_t j = p->cover.nodes[k].disc;
                double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), s = r + p->r[j] + GAP;
                if (dx * dx + dy * dy >= s * s || j == self) continue;
                int seen = 0;
                while (seen < n && list[seen] != j) seen++;
                if (seen == n && n < MAX_OVERLAPS) list[n++] = j;
            }
        }
    }
    return n;
}

static void random_place(const fw_packing_box *b, fw_random *random, double *x, double *y)
{
    *x = fmin(b->x0 + (b->x1 - b->x0) * fw_random_uniform(random), nextafter(b->x1, -INFINITY));
    *y = fmin(b->y0 + (b->y1 - b->y0) * fw_random_uniform(random), nextafter(b->y1, -INFINITY));
}

/* Of a few dozen random places the one with the least sum of overlap depths. */
static void least_crowded_place(const fw_packing *p, double r, int32_t self, fw_random *random, double *x, double *y)
{
    double least = INFINITY;
    for (int t = 0; t < CROWDED_PLACES; t++) {
        int32_t list[MAX_OVERLAPS];
        double  tx, ty, sum = 0.0;
        random_place(&p->box, random, &tx, &ty);
        int n = list_overlaps(p, tx, ty, r, self, list);
        for (int k = 0; k < n; k++) {
            int32_t j = list[k];
            sum += r + p->r[j] + GAP - hypot(tx - p->x[j], across(&p->box, ty - p->y[j]));
        }
        if (sum < least) {
            least = sum;
            *x = tx;
            *y = ty;
        }
    }
}

/* Ring of floes that may overlap something. */
typedef struct ring {
    size_t head, n, capacity;
} ring;

static void enqueue(fw_packing *p, ring *q, int32_t i)
{
    if (p->is_queued[i]) return;
    size_t at = q->head + q->n++;
    p->queue[at < q->capacity ? at : at - q->capacity] = i;
    p->is_queued[i] = 1;
}

static int32_t dequeue(fw_packing *p, ring *q)
{
    int32_t i = p->queue[q->head];
    q->head = q->head + 1 < q->capacity ? q->head + 1 : 0;
    q->n--;
    p->is_queued[i] = 0;
    return i;
}

/* Put own floe i elsewhere: kept in the box (a wrap in y, else the nearest place inside), listed there. */
static fw_status move_to(fw_packing *p, int32_t i, double x, double y, fw_msg *m)
{
    const fw_packing_box *b = &p->box;
    if (b->wraps_y) y += y < b->y0 ? b->y1 - b->y0 : y >= b->y1 ? b->y0 - b->y1 : 0.0;
    x = fmax(b->x0, fmin(x, nextafter(b->x1, -INFINITY)));
    y = fmax(b->y0, fmin(y, nextafter(b->y1, -INFINITY)));
    fw_cover_remove(&p->cover, i, p->x[i], p->y[i], p->r[i]);
    p->x[i] = x;
    p->y[i] = y;
    return fw_cover_add(&p->cover, i, x, y, p->r[i], m);
}

/* Push floe i and all it overlaps apart, pair by pair; own partners give way in proportion to the other's radius. */
static fw_status push_apart(fw_packing *p, ring *q, int32_t i, bool *was_free, fw_msg *m)
{
    int32_t list[MAX_OVERLAPS];
    int     n = list_overlaps(p, p->x[i], p->y[i], p->r[i], i, list);
    double  x = p->x[i], y = p->y[i], r = p->r[i];
    *was_free = n == 0;
    if (n == 0) return FW_OK;
    for (int k = 0; k < n; k++) {
        int32_t j = list[k];
        double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), d = hypot(dx, dy);
        double  wanted = r + p->r[j] + GAP + PUSH_GAP * fmin(r, p->r[j]);
        if (d >= wanted) continue; /* the pushes before this one did it */
        double nx = d > 0.0 ? dx / d : 1.0, ny = d > 0.0 ? dy / d : 0.0;
        double push = wanted - d, mine = 1.0;
        if ((size_t)j < p->n_own) {
            mine = p->r[j] / (r + p->r[j]);
            FW_TRY(move_to(p, j, p->x[j] - (1.0 - mine) * push * nx, p->y[j] - (1.0 - mine) * push * ny, m));
            enqueue(p, q, j);
        }
        x += mine * push * nx;
        y += mine * push * ny;
    }
    FW_TRY(move_to(p, i, x, y, m));
    enqueue(p, q, i);
    return FW_OK;
}

/* Free all queued floes. When a bout of pushes does not do it, the smallest floe that still overlaps goes elsewhere. */
static fw_status relax(fw_packing *p, ring *q, fw_random *random, size_t *n_left, fw_msg *m)
{
    for (int n_moves = 0; q->n > 0; n_moves++) {
        size_t budget = PUSHES_PER_FLOE * p->n_own / (n_moves ? 10 : 1) + 1000;
        bool   was_free;
        for (; q->n > 0 && budget > 0; budget--) {
            p->cost.n_pushes++;
            FW_TRY(push_apart(p, q, dequeue(p, q), &was_free, m));
        }
        if (q->n == 0) break;
        int32_t smallest = -1;
        *n_left = 0;
        for (size_t k = 0; k < q->n; k++) {
            size_t  at = q->head + k;
            int32_t i = p->queue[at < q->capacity ? at : at - q->capacity];
            if (!is_taken(p, p->x[i], p->y[i], p->r[i], i)) continue;
            ++*n_left;
            if (smallest < 0 || p->r[i] < p->r[smallest]) smallest = i;
        }
        if (n_moves == MAX_MOVES && *n_left > 0) return FW_OK;
        if (smallest < 0) continue;
        double x = 0.0, y = 0.0;
        least_crowded_place(p, p->r[smallest], smallest, random, &x, &y);
        FW_TRY(move_to(p, smallest, x, y, m));
        enqueue(p, q, smallest);
        p->cost.n_moved++;
    }
    *n_left = 0;
    return FW_OK;
}

fw_status fw_packing_place(fw_packing *p, size_t n, const double *r, fw_random *random, size_t *n_left, fw_msg *m)
{
    ring q = {.capacity = p->n_most};
    *n_left = 0;
    for (size_t k = 0; k < n; k++) {
        double x = 0.0, y = 0.0;
        int    tries = 0;
        do random_place(&p->box, random, &x, &y);
        while (is_taken(p, x, y, r[k], -1) && ++tries < MAX_TRIES);
        p->cost.n_tries += (uint64_t)tries + 1;
        if (tries == MAX_TRIES) least_crowded_place(p, r[k], -1, random, &x, &y);
        FW_TRY(fw_packing_own(p, x, y, r[k], m));
        if (tries == MAX_TRIES) {
            p->cost.n_crowded++;
            enqueue(p, &q, (int32_t)p->n_own - 1);
        }
    }
    return relax(p, &q, random, n_left, m);
}

double fw_packing_free_share(const fw_packing *p)
{
    double sum = 0.0;
    for (size_t i = 0; i < p->n_own; i++) {
        if (!is_taken(p, p->x[i], p->y[i], p->r[i], (int32_t)i)) sum += M_PI * p->r[i] * p->r[i];
    }
    return sum / ((p->box.x1 - p->box.x0) * (p->box.y1 - p->box.y0));
}

void fw_packing_free(fw_packing *p)
{
    free(p->x);
    free(p->y);
    free(p->r);
    free(p->queue);
    free(p->is_queued);
    fw_cover_free(&p->cover);
    *p = (fw_packing){0};
}
