#include "kernel/traffic.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "kernel/strip.h"

void fw_traffic_free(fw_traffic *t)
{
    free(t->candidates);
    free(t->seats);
    free(t->edges);
    free(t->some);
}

fw_path fw_traffic_path(const fw_traffic *t, int32_t body)
{
    const fw_seat *s = &t->seats[body];
    return s->cluster ? fw_path_of_member(&t->setup, s->cluster, &s->cluster->members[s->member])
                      : fw_path_of_flying(&t->setup, &t->world->bodies[body]);
}

fw_path fw_traffic_path_of_other(const fw_traffic *t, const fw_candidate *c)
{
    if (c->j >= 0) return fw_traffic_path(t, c->j);
    if (c->j == FW_WALL) return fw_path_of_structure(&t->setup);
    const fw_block *b = &t->world->blocks[c->block];
    return fw_path_of_drifting(&t->setup, t->world->t, b->x[c->row] + t->world->drift_x, b->y[c->row] + t->world->drift_y, b->radius[c->row]);
}

/* --- lines ---------------------------------------------------------------------------------------------------------- */

/* A free floe is given the chord of its flight; how far the flight bulges from it is known. A member of a cluster is given its
 * velocity of the moment and a margin: most are pinned or slide slowly. */
static void draw_line(fw_traffic *t, int32_t i)
{
    fw_seat *s = &t->seats[i];
    fw_path  p = fw_traffic_path(t, i);
    fw_place at = fw_path_at(&p, t->now);
    double   dt = t->until - t->now;
    s->t = t->now, s->x = at.x, s->y = at.y, s->vx = at.vx, s->vy = at.vy;
    s->margin = t->setup.margin, s->reach = p.radius + s->margin;
    if (p.kind != FW_PATH_FLIES || !(dt > 0)) return;
    fw_place end = fw_path_at(&p, t->until);
    double   r = fw_length(at.vx - p.ux, at.vy - p.uy), r_end = fw_length(end.vx - p.ux, end.vy - p.uy);
    double   mean = fw_length(end.x - at.x - p.ux * dt, end.y - at.y - p.uy * dt) / dt;
    s->vx = (end.x - at.x) / dt, s->vy = (end.y - at.y) / dt;
    /* The way against the water is concave in time: it stays below the tangents at both ends, which meet at this height above the chord. */
    s->margin = r > r_end ? fw_larger(0, (r - mean) * (mean - r_end) * dt / (r - r_end)) : 0;
    s->reach = p.radius + s->margin;
}

/* Do two points on lines, apart by (x, y) now and moving by (u, v), come nearer than limit within dt? First along either axis, without a
 * branch: most that are asked about do not, and which of them do cannot be foreseen. */
static inline bool is_in_box(double x, double y, double u, double v, double dt, double limit)
{
    return (fabs(x) < limit + fabs(u) * dt) & (fabs(y) < limit + fabs(v) * dt);
}

static inline bool is_near(double x, double y, double u, double v, double dt, double limit)
{
    double w2 = u * u + v * v, s = w2 > 0 ? -(x * u + y * v) / w2 : 0;
    s = s > 0 ? fw_smaller(s, dt) : 0;
    x += s * u, y += s * v;
    return x * x + y * y < limit * limit;
}

/* Where body i's line is now. */
typedef struct disc {
    double x, y, vx, vy, reach;
} disc;

static inline disc disc_of(const fw_traffic *t, int32_t i)
{
    const fw_seat *s = &t->seats[i];
    double         dt = t->now - s->t;
    return (disc){s->x + s->vx * dt, s->y + s->vy * dt, s->vx, s->vy, s->reach};
}

static inline bool boxes_meet(const disc *a, const disc *b, double dt)
{
    return is_in_box(a->x - b->x, a->y - b->y, a->vx - b->vx, a->vy - b->vy, dt, a->reach + b->reach);
}

static inline bool lines_meet(const disc *a, const disc *b, double dt)
{
    return is_near(a->x - b->x, a->y - b->y, a->vx - b->vx, a->vy - b->vy, dt, a->reach + b->reach);
}

/* --- candidates ------------------------------------------------------------------------------------------------------ */

static fw_status add(fw_traffic *t, int32_t i, int32_t j, int32_t block, int32_t row, fw_msg *m)
{
    FW_TRY(
        fw_grow(&t->candidates, &t->candidate_capacity, t->n_candidates + 1, sizeof *t->candidates, "candidates", m));
    int32_t name = (int32_t)t->n_candidates++;
    t->candidates[name] = (fw_candidate){.i = i,
                                         .j = j,
                                         .next_i = t->seats[i].first,
                                         .next_j = j >= 0 ? t->seats[j].first : -1,
                                         .block = block,
                                         .row = row,
                                         .touch = INFINITY,
                                         .clear = t->now};
    t->seats[i].first = name;
    if (j >= 0) t->seats[j].first = name;
    return FW_OK;
}

int32_t fw_traffic_find(const fw_traffic *t, int32_t i, int32_t j)
{
    for (int32_t c = t->seats[i].first; c >= 0; c = fw_traffic_next(&t->candidates[c], i)) {
        const fw_candidate *e = &t->candidates[c];
        if ((e->i == i && e->j == j) || (e->j == i && e->i == j)) return c;
    }
    return -1;
}

fw_status fw_traffic_add(fw_traffic *t, int32_t i, int32_t j, int32_t *name, fw_msg *m)
{
    *name = (int32_t)t->n_candidates;
    return add(t, i, j, -1, -1, m);
}

static bool has_ice(const fw_traffic *t, int32_t i, int32_t block, int32_t row)
{
    for (int32_t c = t->seats[i].first; c >= 0; c = fw_traffic_next(&t->candidates[c], i)) {
        const fw_candidate *e = &t->candidates[c];
        if (e->j == FW_ICE && e->i == i && e->block == block && e->row == row) return true;
    }
    return false;
}

/* Untouched floes that come within reach of body i on its line; found in the frame of the ice, where they stand still. */
static fw_status add_ice(fw_traffic *t, int32_t i, const disc *a, bool is_new, fw_msg *m)
{
    const fw_world *w = t->world;
    const fw_flow  *flow = &t->setup.flow;
    double dt = t->until - t->now, u = a->vx - flow->ice_x, v = a->vy - flow->ice_y, gone = t->now - w->t;
    double X = a->x - (w->drift_x + flow->ice_x * gone), Y = a->y - (w->drift_y + flow->ice_y * gone);
    double cx = X + 0.5 * u * dt, cy = Y + 0.5 * v * dt, half = 0.5 * dt * fw_larger(fabs(u), fabs(v));
    fw_strip strip = fw_strip_of(&t->setup, w);
    for (size_t k = 0; k < w->n_blocks; k++) {
        const fw_block *b = &w->blocks[k];
        double          reach = half + a->reach + b->max_radius;
        if (b->n_left == 0 || cx + reach < b->x_min || cx - reach > b->x_max) continue;
        size_t ix0, ix1, iy0, iy1;
        fw_cells_range(&b->cells, cx, cy, reach, &ix0, &ix1, &iy0, &iy1);
        FW_TRY(fw_grow(&t->some, &t->some_capacity, b->n + 1, sizeof *t->some, "candidates", m));
        int32_t *some = t->some;
        size_t   n = 0;
        for (size_t iy = iy0; iy < iy1 && ix0 < ix1; iy++)
            for (size_t q = b->cells.start[iy * b->cells.nx + ix0]; q < b->cells.start[iy * b->cells.nx + ix1]; q++) {
                size_t r = b->cells.item[q];
                some[n] = (int32_t)r;
                n += !b->is_taken[r] & fw_strip_has(&strip, b->x[r], b->y[r]) &
                     is_in_box(X - b->x[r], Y - b->y[r], u, v, dt, a->reach + b->radius[r]);
            }
        for (size_t q = 0; q < n; q++) {
            int32_t r = some[q];
            if (is_near(X - b->x[r], Y - b->y[r], u, v, dt, a->reach + b->radius[r]) &&
                (is_new || !has_ice(t, i, (int32_t)k, r)))
                FW_TRY(add(t, i, FW_ICE, (int32_t)k, r, m));
        }
    }
    return FW_OK;
}

static fw_status add_structure_and_ice(fw_traffic *t, int32_t i, bool is_new, fw_msg *m)
{
    disc a = disc_of(t, i);
    if (is_near(a.x, a.y, a.vx, a.vy, t->until - t->now, a.reach + t->setup.structure_radius) &&
        (is_new || fw_traffic_find(t, i, FW_WALL) < 0))
        FW_TRY(add(t, i, FW_WALL, -1, -1, m));
    return t->setup.has_floe_contact ? add_ice(t, i, &a, is_new, m) : FW_OK;
}

static int by_left_edge(const void *x, const void *y)
{
    const struct fw_edge *a = x, *b = y;
    if (a->left != b->left) return a->left < b->left ? -1 : 1;
    return (a->body > b->body) - (a->body < b->body);
}

/* A few dozen in ordinary ice, which a library sort would spend most of its time on being called for. */
static void sort_edges(struct fw_edge *e, size_t n)
{
    if (n > 64) {
        qsort(e, n, sizeof *e, by_left_edge);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        struct fw_edge one = e[i];
        size_t         k = i;
        for (; k > 0 && by_left_edge(&one, &e[k - 1]) < 0; k--) e[k] = e[k - 1];
        e[k] = one;
    }
}

fw_status fw_traffic_list(fw_traffic *t, fw_msg *m)
{
    fw_world *w = t->world;
    double    dt = t->until - t->now;
    size_t    n = w->n_bodies;
    w->ledger.rebuilds++;
    t->n_candidates = 0;
    t->soonest = -1, t->is_soonest_known = true;
    t->is_listed = true, t->blocks_listed = w->block_changes;
    FW_TRY(fw_grow(&t->edges, &t->edge_capacity, n + 1, sizeof *t->edges, "candidates", m));
    for (size_t i = 0; i < n; i++) {
        draw_line(t, (int32_t)i);
        fw_seat *s = &t->seats[i];
        double   r = s->reach;
        s->first = -1;
        t->edges[i] = (struct fw_edge){fw_smaller(s->x, s->x + s->vx * dt) - r, fw_larger(s->x, s->x + s->vx * dt) + r,
                                       (int32_t)i};
    }
    sort_edges(t->edges, n);
    for (size_t a = 0; t->setup.has_floe_contact && a < n; a++)
        for (size_t b = a + 1; b < n && t->edges[b].left < t->edges[a].right; b++) {
            int32_t i = t->edges[a].body, j = t->edges[b].body;
            disc    p = disc_of(t, i), q = disc_of(t, j);
            if (boxes_meet(&p, &q, dt) && lines_meet(&p, &q, dt)) FW_TRY(add(t, i < j ? i : j, i < j ? j : i, -1, -1, m));
        }
    for (size_t i = 0; i < n; i++) FW_TRY(add_structure_and_ice(t, (int32_t)i, true, m));
    return FW_OK;
}

fw_status fw_traffic_list_body(fw_traffic *t, int32_t i, fw_msg *m)
{
    draw_line(t, i);
    disc   a = disc_of(t, i);
    double dt = t->until - t->now;
    size_t n = 0, n_bodies = t->setup.has_floe_contact ? t->world->n_bodies : 0;
    FW_TRY(fw_grow(&t->some, &t->some_capacity, n_bodies + 1, sizeof *t->some, "candidates", m));
    int32_t *some = t->some;
    for (int32_t j = 0; j < (int32_t)n_bodies; j++) {
        disc b = disc_of(t, j);
        some[n] = j;
        n += (j != i) & boxes_meet(&a, &b, dt);
    }
    for (size_t q = 0; q < n; q++) {
        disc b = disc_of(t, some[q]);
        if (lines_meet(&a, &b, dt) && fw_traffic_find(t, i, some[q]) < 0) FW_TRY(add(t, i, some[q], -1, -1, m));
    }
    return add_structure_and_ice(t, i, false, m);
}

fw_status fw_traffic_follow(fw_traffic *t, int32_t i, fw_msg *m)
{
    const fw_seat    *s = &t->seats[i];
    const fw_cluster *c = s->cluster;
    /* A free floe stays within its line's margin only when that was drawn for this very flight: it is drawn anew. */
    if (!c) return fw_traffic_list_body(t, i, m);
    const fw_member *e = &c->members[s->member];
    double           at = c->t1, x = e->y1[FW_X], y = e->y1[FW_Y];
    if (at > t->until) {
        fw_path  p = fw_traffic_path(t, i);
        fw_place q = fw_path_at(&p, t->until);
        at = t->until, x = q.x, y = q.y;
    }
    x -= s->x + s->vx * (at - s->t), y -= s->y + s->vy * (at - s->t);
    return s->margin > 0 && x * x + y * y <= s->margin * s->margin ? FW_OK : fw_traffic_list_body(t, i, m);
}

void fw_traffic_woken(fw_traffic *t, int32_t c, int32_t j)
{
    int32_t block = t->candidates[c].block, row = t->candidates[c].row;
    for (size_t k = 0; k < t->n_candidates; k++) {
        fw_candidate *e = &t->candidates[k];
        if (e->j != FW_ICE || e->block != block || e->row != row) continue;
        e->j = j;
        e->next_j = t->seats[j].first;
        t->seats[j].first = (int32_t)k;
    }
}

/* --- touches --------------------------------------------------------------------------------------------------------- */

void fw_traffic_touches_at(fw_traffic *t, int32_t c, double touch)
{
    fw_candidate *e = &t->candidates[c];
    e->touch = touch;
    if (!t->is_soonest_known) return;
    if (t->soonest == c)
        t->is_soonest_known = false;
    else if (touch < (t->soonest < 0 ? INFINITY : t->candidates[t->soonest].touch))
        t->soonest = c;
}

int32_t fw_traffic_soonest(fw_traffic *t)
{
    if (t->is_soonest_known) return t->soonest;
    double first = INFINITY;
    t->soonest = -1;
    for (size_t c = 0; c < t->n_candidates; c++)
        if (t->candidates[c].touch < first) first = t->candidates[c].touch, t->soonest = (int32_t)c;
    t->is_soonest_known = true;
    return t->soonest;
}

static double known_until(const fw_traffic *t, int32_t body)
{
    const fw_cluster *c = t->seats[body].cluster;
    return c ? c->t1 : INFINITY;
}

static double fastest(const fw_traffic *t, int32_t body)
{
    const fw_seat *s = &t->seats[body];
    if (s->cluster) return s->cluster->members[s->member].fastest;
    const fw_body *b = &t->world->bodies[body];
    return fw_length(b->vx - t->setup.flow.ux, b->vy - t->setup.flow.uy);
}

void fw_traffic_check(fw_traffic *t, int32_t c)
{
    fw_candidate *e = &t->candidates[c];
    if (e->is_closed) return;
    double until = fw_smaller(t->until, known_until(t, e->i)), speed = fastest(t, e->i), bound = t->swift;
    bool   is_swift = speed > t->swift;
    if (e->j >= 0) {
        double other = fastest(t, e->j);
        until = fw_smaller(until, known_until(t, e->j));
        is_swift |= other > t->swift;
        speed += other, bound += t->swift;
    } else if (e->j == FW_WALL) {
        double current = fw_length(t->setup.flow.ux, t->setup.flow.uy);
        speed += current, bound += current;
    } else {
        double drift = fw_length(t->setup.flow.ice_x - t->setup.flow.ux, t->setup.flow.ice_y - t->setup.flow.uy);
        speed += drift, bound += drift;
    }
    double touch = INFINITY;
    if (until > t->now && (is_swift || until > e->clear)) {
        fw_path a = fw_traffic_path(t, e->i), b = fw_traffic_path_of_other(t, e);
        double  gap, closing;
        fw_path_gap(&a, &b, t->now, &gap, &closing);
        e->clear = t->now + (gap > 0 ? gap / bound : 0);
        if (!(gap > speed * (until - t->now))) touch = fw_path_touch(&a, &b, t->now, until, gap, closing);
    }
    if (touch != e->touch) fw_traffic_touches_at(t, c, touch);
}

void fw_traffic_check_body(fw_traffic *t, int32_t i)
{
    const fw_cluster *own = t->seats[i].cluster;
    for (int32_t c = t->seats[i].first; c >= 0;) {
        const fw_candidate *e = &t->candidates[c];
        int32_t             next = fw_traffic_next(e, i);
        bool                is_twice = own && e->j == i && t->seats[e->i].cluster == own; /* its partner checks it */
        if (!is_twice) fw_traffic_check(t, c);
        c = next;
    }
}
