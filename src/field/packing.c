#include "field/packing.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "field/abreast.h"

/* Tuned on the five-class mix (0.5 to 1.3 m) and on {0.3 m: 2, 0.5 m: 1}; ms per tile at 60 / 65 %:
 * tries 20: 0.32 / 0.63, 50: 0.26 / 0.65, 100: 0.22 / 0.63, 200: 0.22 / 0.48, 500: 0.22-0.29 / 0.55-0.7 (before a try
 * became three times as cheap; changing the number would change the floes of every dense field). At 200 tries
 * 0.6 % of the floes are put down crowded at 60 %, 7 % at 65 %. Looking at 80 places for a crowded floe instead of 20
 * halves the pushes and still costs more. With these numbers the mixes pack to 80 %, one class of equal floes (h = 8.04
 * m) to 75 %. */
enum {
    PLAIN_TRIES = 192,     /* of a call, each against every disc: about what lists of the nearby ones cost to build */
    MAX_TRIES = 200,       /* refusals before a floe is put down crowded */
    CROWDED_PLACES = 20,   /* places looked at then */
    MAX_OVERLAPS = 64,     /* overlaps of one floe handled at once; more are seen when it is looked at again */
    PUSHES_PER_FLOE = 200, /* of a bout, before a floe is moved elsewhere (a tenth of it after the first) */
    MAX_MOVES = 200        /* floes moved elsewhere before the packing gives up */
};
static const double GAP = 1e-6;      /* [m] least distance between rims: far above rounding at 1e8 m from the origin */
static const double PUSH_GAP = 1e-3; /* of the smaller radius: distance between rims after a push; without it the last
                                      * micrometres of a chain of pushes never end */

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
    p->reach = max_radius + GAP;
    p->rim = max_radius;
    p->cell = cell;
    p->x_last = nextafter(box->x1, -INFINITY);
    p->y_last = nextafter(box->y1, -INFINITY);
    p->height = box->wraps_y ? box->y1 - box->y0 : INFINITY;
    p->n_own = p->n_before = 0;
    p->n_most = p->n_discs = whole_rows(n_most);
    p->has_cover = false;
    FW_TRY(grow_discs(p, p->n_most, m));
    FW_TRY(fw_grow(&p->queue, &p->queue_capacity, p->n_most, sizeof *p->queue, "floes of an ice tile", m));
    FW_TRY(fw_grow(&p->is_queued, &p->queued_capacity, p->n_most, sizeof *p->is_queued, "floes of an ice tile", m));
    for (size_t i = 0; i < p->n_most; i++) p->x[i] = INFINITY;
    return FW_OK;
}

/* The exact grid over all discs, listed in the order in which they came. */
static fw_status build_cover(fw_packing *p, fw_msg *m)
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

static fw_status add_own(fw_packing *p, double x, double y, double r, fw_msg *m)
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
    for (size_t i = 0; i < n; i++) FW_TRY(add_own(p, x[i], y[i], r[i], m));
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

/* y distance, to the nearest image when the box wraps */
static double across(const fw_packing_box *b, double dy)
{
    if (!b->wraps_y) return dy;
    double height = b->y1 - b->y0;
    return dy > 0.5 * height ? dy - height : dy < -0.5 * height ? dy + height : dy;
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
    FW_TRY(fw_nearby_reset(&p->nearby, b->x0, b->x1, b->y0, b->y1, b->wraps_y, p->cell, largest + GAP, m));
    for (size_t i = 0; i < p->n_own; i++) FW_TRY(fw_nearby_add(&p->nearby, p->x[i], p->y[i], p->r[i], m));
    for (size_t i = p->n_most; i < p->n_discs; i++) FW_TRY(fw_nearby_add(&p->nearby, p->x[i], p->y[i], p->r[i], m));
    return FW_OK;
}

/* Does a disc here come nearer than GAP to another one (disc `self` left out)? Needs the cover. */
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

static void random_place(const fw_packing *p, fw_uniforms *random, double *x, double *y)
{
    const fw_packing_box *b = &p->box;
    double                tx = b->x0 + (b->x1 - b->x0) * fw_uniforms_next(random);
    double                ty = b->y0 + (b->y1 - b->y0) * fw_uniforms_next(random);
    *x = tx < p->x_last ? tx : p->x_last;
    *y = ty < p->y_last ? ty : p->y_last;
}

/* Of a few dozen random places the one with the least sum of overlap depths. */
static void least_crowded_place(const fw_packing *p, double r, int32_t self, fw_uniforms *random, double *x, double *y)
{
    double least = INFINITY;
    for (int t = 0; t < CROWDED_PLACES; t++) {
        int32_t list[MAX_OVERLAPS];
        double  tx, ty, sum = 0.0;
        random_place(p, random, &tx, &ty);
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
    x = fmax(b->x0, fmin(x, p->x_last));
    y = fmax(b->y0, fmin(y, p->y_last));
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
static fw_status relax(fw_packing *p, ring *q, fw_uniforms *random, size_t *n_left, fw_msg *m)
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

fw_status fw_packing_place(fw_packing *p, size_t n, const double *r, uint64_t n_expected, fw_uniforms *random,
                           size_t *n_left, fw_msg *m)
{
    ring q = {.capacity = p->n_most};
    /* the lists at once where they are going to pay */
    int  n_plain = n < PLAIN_TRIES && n_expected < PLAIN_TRIES ? 0 : PLAIN_TRIES;
    bool has_nearby = false;
    *n_left = 0;
    for (size_t k = 0; k < n; k++) {
        double x = 0.0, y = 0.0;
        int    tries = 0;
        bool   is_refused = true;
        while (is_refused && tries < MAX_TRIES) {
            random_place(p, random, &x, &y);
            fw_place at = {.x = x, .y = y, .r = r[k], .gap = GAP, .height = p->height};
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
            FW_TRY(build_cover(p, m));
            least_crowded_place(p, r[k], -1, random, &x, &y);
        }
        FW_TRY(add_own(p, x, y, r[k], m));
        if (has_nearby) FW_TRY(fw_nearby_add(&p->nearby, x, y, r[k], m));
        if (is_refused) {
            p->cost.n_crowded++;
            enqueue(p, &q, (int32_t)p->n_own - 1);
        }
    }
    return relax(p, &q, random, n_left, m);
}

fw_status fw_packing_free_share(fw_packing *p, double *share, fw_msg *m)
{
    double sum = 0.0;
    FW_TRY(build_cover(p, m));
    for (size_t i = 0; i < p->n_own; i++) {
        if (!is_taken(p, p->x[i], p->y[i], p->r[i], (int32_t)i)) sum += M_PI * p->r[i] * p->r[i];
    }
    *share = sum / ((p->box.x1 - p->box.x0) * (p->box.y1 - p->box.y0));
    return FW_OK;
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
