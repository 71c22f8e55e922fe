#include "field/pushing.h"

#include <math.h>

enum {
    CROWDED_PLACES = 20,   /* places looked at for a floe that fits nowhere */
    MAX_OVERLAPS = 64,     /* overlaps of one floe handled at once; more are seen when it is looked at again */
    PUSHES_PER_FLOE = 200, /* of a bout, before a floe is moved elsewhere (a tenth of it after the first) */
    MAX_MOVES = 200        /* floes moved elsewhere before the packing gives up */
};
static const double PUSH_GAP = 1e-3; /* of the smaller radius: distance between rims after a push; without it the last
                                      * micrometres of a chain of pushes never end */

/* y distance, to the nearest image when the box wraps */
static double across(const fw_packing_box *b, double dy)
{
    if (!b->wraps_y) return dy;
    double height = b->y1 - b->y0;
    return dy > 0.5 * height ? dy - height : dy < -0.5 * height ? dy + height : dy;
}

bool fw_pushing_is_taken(const fw_packing *p, double x, double y, double r, int32_t self)
{
    fw_cover_box b = fw_cover_under(&p->cover, x, y, r + FW_PACKING_GAP);
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        for (int32_t ix = b.x_begin; ix < b.x_end; ix++) {
            for (int32_t k = fw_cover_head(&p->cover, ix, iy); k >= 0; k = p->cover.nodes[k].next) {
                int32_t j = p->cover.nodes[k].disc;
                double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), s = r + p->r[j] + FW_PACKING_GAP;
                if (dx * dx + dy * dy < s * s && j != self) return true;
            }
        }
    }
    return false;
}

/* Discs that disc-to-be `self` at (x, y) comes nearer to than FW_PACKING_GAP, each once; at most MAX_OVERLAPS. */
static int list_overlaps(const fw_packing *p, double x, double y, double r, int32_t self, int32_t list[MAX_OVERLAPS])
{
    fw_cover_box b = fw_cover_under(&p->cover, x, y, r + FW_PACKING_GAP);
    int          n = 0;
    for (int32_t iy = b.y_begin; iy < b.y_end; iy++) {
        for (int32_t ix = b.x_begin; ix < b.x_end; ix++) {
            for (int32_t k = fw_cover_head(&p->cover, ix, iy); k >= 0; k = p->cover.nodes[k].next) {
                int32_t j = p->cover.nodes[k].disc;
                double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), s = r + p->r[j] + FW_PACKING_GAP;
                if (dx * dx + dy * dy >= s * s || j == self) continue;
                int seen = 0;
                while (seen < n && list[seen] != j) seen++;
                if (seen == n && n < MAX_OVERLAPS) list[n++] = j;
            }
        }
    }
    return n;
}

void fw_pushing_least_crowded(const fw_packing *p, double r, int32_t self, fw_uniforms *random, double *x, double *y)
{
    double least = INFINITY;
    for (int t = 0; t < CROWDED_PLACES; t++) {
        int32_t list[MAX_OVERLAPS];
        double  tx, ty, sum = 0.0;
        fw_packing_random_place(p, random, &tx, &ty);
        int n = list_overlaps(p, tx, ty, r, self, list);
        for (int k = 0; k < n; k++) {
            int32_t j = list[k];
            sum += r + p->r[j] + FW_PACKING_GAP - hypot(tx - p->x[j], across(&p->box, ty - p->y[j]));
        }
        if (sum < least) {
            least = sum;
            *x = tx;
            *y = ty;
        }
    }
}

static size_t queue_place(const fw_packing *p, size_t k)
{
    size_t at = p->queue_head + k;
    return at < p->n_most ? at : at - p->n_most;
}

void fw_pushing_enqueue(fw_packing *p, int32_t i)
{
    if (p->is_queued[i]) return;
    p->queue[queue_place(p, p->n_queued++)] = i;
    p->is_queued[i] = 1;
}

static int32_t dequeue(fw_packing *p)
{
    int32_t i = p->queue[p->queue_head];
    p->queue_head = queue_place(p, 1);
    p->n_queued--;
    p->is_queued[i] = 0;
    return i;
}

void fw_pushing_forget(fw_packing *p)
{
    while (p->n_queued > 0) (void)dequeue(p);
    p->queue_head = 0;
}

fw_status fw_pushing_move(fw_packing *p, int32_t i, double x, double y, fw_msg *m)
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
static fw_status push_apart(fw_packing *p, int32_t i, fw_msg *m)
{
    int32_t list[MAX_OVERLAPS];
    int     n = list_overlaps(p, p->x[i], p->y[i], p->r[i], i, list);
    double  x = p->x[i], y = p->y[i], r = p->r[i];
    if (n == 0) return FW_OK;
    for (int k = 0; k < n; k++) {
        int32_t j = list[k];
        double  dx = x - p->x[j], dy = across(&p->box, y - p->y[j]), d = hypot(dx, dy);
        double  wanted = r + p->r[j] + FW_PACKING_GAP + PUSH_GAP * fmin(r, p->r[j]);
        if (d >= wanted) continue; /* the pushes before this one did it */
        double nx = d > 0.0 ? dx / d : 1.0, ny = d > 0.0 ? dy / d : 0.0;
        double push = wanted - d, mine = 1.0;
        if ((size_t)j < p->n_own) {
            mine = p->r[j] / (r + p->r[j]);
            FW_TRY(fw_pushing_move(p, j, p->x[j] - (1.0 - mine) * push * nx, p->y[j] - (1.0 - mine) * push * ny, m));
            fw_pushing_enqueue(p, j);
        }
        x += mine * push * nx;
        y += mine * push * ny;
    }
    FW_TRY(fw_pushing_move(p, i, x, y, m));
    fw_pushing_enqueue(p, i);
    return FW_OK;
}

fw_status fw_pushing_bout(fw_packing *p, size_t n_pushes, fw_msg *m)
{
    for (; p->n_queued > 0 && n_pushes > 0; n_pushes--) {
        p->cost.n_pushes++;
        FW_TRY(push_apart(p, dequeue(p), m));
    }
    return FW_OK;
}

fw_status fw_pushing_free_all(fw_packing *p, fw_uniforms *random, size_t *n_left, fw_msg *m)
{
    for (int n_moves = 0; p->n_queued > 0; n_moves++) {
        FW_TRY(fw_pushing_bout(p, PUSHES_PER_FLOE * p->n_own / (n_moves ? 10 : 1) + 1000, m));
        if (p->n_queued == 0) break;
        int32_t smallest = -1;
        *n_left = 0;
        for (size_t k = 0; k < p->n_queued; k++) {
            int32_t i = p->queue[queue_place(p, k)];
            if (!fw_pushing_is_taken(p, p->x[i], p->y[i], p->r[i], i)) continue;
            ++*n_left;
            if (smallest < 0 || p->r[i] < p->r[smallest]) smallest = i;
        }
        if (n_moves == MAX_MOVES && *n_left > 0) return FW_OK;
        if (smallest < 0) continue;
        double x = 0.0, y = 0.0;
        fw_pushing_least_crowded(p, p->r[smallest], smallest, random, &x, &y);
        FW_TRY(fw_pushing_move(p, smallest, x, y, m));
        fw_pushing_enqueue(p, smallest);
        p->cost.n_moved++;
    }
    *n_left = 0;
    return FW_OK;
}
