/* The order of events: a step of a cluster ends, or two rims touch; whichever is first.
 *
 *   step ends    it is committed; contacts that let go are taken out, the cluster may fall apart; next step on trial
 *   rims touch   both sides are brought to that very instant (a cluster's step is cut and tried again, a free floe flies there,
 *                untouched ice wakes), become one cluster, and start anew with short steps
 *
 * Nobody is committed past anybody's next event, so a step can always be cut where somebody else comes in. Nobody waits for a
 * smaller neighbour either: each cluster has a pace of its own, and floes in no contact cost nothing between two touches. */
#include "kernel/kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/traffic.h"
#include "kernel/wake.h"

enum { MAX_LANDINGS = 8 };

/* Floes squeezed out from between others have been seen at up to twice the current's speed relative to the water; who is faster than
 * this is checked without the shortcut that it bounds. */
static const double SWIFT = 1.5;

struct fw_kernel {
    fw_traffic   traffic;
    double       horizon; /* time between two listings [s] */
    double       ice_from; /* the caller has put ice into the world up to here (kernel frame) [m] */
    fw_cluster **clusters;
    size_t       n_clusters, cluster_capacity;
    fw_cluster **spare; /* emptied ones, with their memory */
    size_t       n_spare, spare_capacity;
    int32_t     *opened, *root, *new_name;
    size_t       opened_capacity, root_capacity, name_capacity;
    size_t       n_seated; /* bodies that have a seat */
    bool        *is_gone;
    size_t       gone_capacity;
};

fw_status fw_kernel_create(fw_kernel **out, const fw_setup *setup, fw_msg *m)
{
    FW_CHECK(setup->velocity_scale > 0 && setup->horizon > 0 && setup->tolerance > 0 && setup->margin > 0, m, FW_E_ARG,
             "kernel: velocity scale, horizon, tolerance and margin must be positive");
    FW_TRY(fw_alloc(out, 1, sizeof **out, "kernel", m));
    (*out)->traffic.setup = *setup;
    (*out)->traffic.swift = SWIFT * setup->velocity_scale;
    (*out)->horizon = setup->horizon / setup->velocity_scale;
    return FW_OK;
}

void fw_kernel_destroy(fw_kernel *k)
{
    if (!k) return;
    for (size_t i = 0; i < k->n_clusters; i++) fw_cluster_free(k->clusters[i]);
    for (size_t i = 0; i < k->n_spare; i++) fw_cluster_free(k->spare[i]);
    fw_traffic_free(&k->traffic);
    free(k->clusters);
    free(k->spare);
    free(k->opened);
    free(k->root);
    free(k->new_name);
    free(k->is_gone);
    free(k);
}

/* Upstream of the awake floes: who is reached within one horizon, and once more for who those push. */
static double ice_margin(const fw_kernel *k, const fw_world *w)
{
    return w->max_radius + 2 * k->traffic.setup.horizon + k->traffic.setup.margin;
}

double fw_kernel_needs_ice_from(const fw_kernel *k, const fw_world *w)
{
    double least = -w->structure_radius;
    for (size_t i = 0; i < w->n_bodies; i++) least = fw_smaller(least, w->bodies[i].x - w->bodies[i].radius);
    return least - ice_margin(k, w) - 2 * w->max_radius;
}

/* --- clusters --------------------------------------------------------------------------------------------------------- */

static fw_status new_cluster(fw_kernel *k, double t, fw_cluster **out, fw_msg *m)
{
    FW_TRY(fw_grow(&k->clusters, &k->cluster_capacity, k->n_clusters + 1, sizeof *k->clusters, "clusters", m));
    FW_TRY(fw_grow(&k->spare, &k->spare_capacity, k->n_clusters + k->n_spare + 1, sizeof *k->spare, "clusters", m));
    fw_cluster *c;
    if (k->n_spare)
        c = k->spare[--k->n_spare];
    else
        FW_TRY(fw_alloc(&c, 1, sizeof *c, "cluster", m));
    c->n_members = c->n_pairs = 0;
    c->t0 = c->t1 = t, c->h = INFINITY, c->omega = 0, c->is_kept = false;
    k->clusters[k->n_clusters++] = c;
    *out = c;
    return FW_OK;
}

static void retire(fw_kernel *k, fw_cluster *c)
{
    size_t kept = 0;
    for (size_t i = 0; i < k->n_clusters; i++)
        if (k->clusters[i] != c) k->clusters[kept++] = k->clusters[i];
    k->n_clusters = kept;
    k->spare[k->n_spare++] = c;
}

static void seat_members(fw_kernel *k, fw_cluster *c)
{
    for (size_t i = 0; i < c->n_members; i++) {
        fw_seat *s = &k->traffic.seats[c->members[i].index];
        s->cluster = c, s->member = (int32_t)i;
    }
}

static int32_t find_root(int32_t *root, int32_t i)
{
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
}

/* Members that nothing holds fly on alone; parts that nothing joins become clusters of their own. The new ones stand at the end
 * of k->clusters, from *first on. */
static fw_status fall_apart(fw_kernel *k, fw_cluster *c, size_t *first, fw_msg *m)
{
    *first = k->n_clusters;
    FW_TRY(fw_grow(&k->root, &k->root_capacity, c->n_members + 1, sizeof *k->root, "clusters", m));
    for (size_t i = 0; i < c->n_members; i++) k->root[i] = (int32_t)i;
    for (size_t q = 0; q < c->n_pairs; q++) {
        const fw_pair *p = &c->pairs[q];
        if (p->b == FW_WALL) continue;
        int32_t a = find_root(k->root, p->a), b = find_root(k->root, p->b);
        k->root[a < b ? b : a] = a < b ? a : b;
    }
    bool is_whole = true;
    for (size_t i = 0; i < c->n_members; i++) is_whole &= find_root(k->root, (int32_t)i) == 0 && c->members[i].n_pairs > 0;
    if (is_whole) return FW_OK;
    for (size_t r = 0; r < c->n_members; r++) {
        if (k->root[r] != (int32_t)r) continue;
        if (c->members[r].n_pairs == 0) {
            k->traffic.seats[c->members[r].index].cluster = NULL;
            continue;
        }
        fw_cluster *part;
        FW_TRY(new_cluster(k, c->t0, &part, m));
        part->h = c->h, part->is_kept = c->is_kept;
        for (size_t i = 0; i < c->n_members; i++) {
            if (find_root(k->root, (int32_t)i) != (int32_t)r) continue;
            FW_TRY(fw_grow(&part->members, &part->member_capacity, part->n_members + 1, sizeof *part->members, "clusters", m));
            part->members[part->n_members] = c->members[i];
            k->traffic.seats[c->members[i].index].member = (int32_t)part->n_members++;
        }
        for (size_t q = 0; q < c->n_pairs; q++) {
            fw_pair p = c->pairs[q];
            if (find_root(k->root, p.a) != (int32_t)r) continue;
            FW_TRY(fw_grow(&part->pairs, &part->pair_capacity, part->n_pairs + 1, sizeof *part->pairs, "clusters", m));
            p.a = k->traffic.seats[c->members[p.a].index].member;
            if (p.b != FW_WALL) p.b = k->traffic.seats[c->members[p.b].index].member;
            part->pairs[part->n_pairs++] = p;
            part->omega = fw_larger(part->omega, p.law.omega);
        }
    }
    for (size_t i = *first; i < k->n_clusters; i++) seat_members(k, k->clusters[i]);
    c->n_members = c->n_pairs = 0;
    retire(k, c);
    --*first;
    return FW_OK;
}

/* How far a cluster's next step may go. One that has come to the end tries on beyond it: it is not committed in this call. */
static double step_limit(const fw_kernel *k, const fw_cluster *c, double t_end)
{
    double limit = c->is_kept && c->t0 < k->traffic.until ? fw_smaller(t_end, k->traffic.until) : t_end;
    return c->t0 < limit ? limit : INFINITY;
}

/* The cluster has a new path: who leaves its line, who touches whom? */
static fw_status look_ahead(fw_kernel *k, fw_cluster *c, fw_msg *m)
{
    for (size_t i = 0; i < c->n_members; i++) FW_TRY(fw_traffic_follow(&k->traffic, c->members[i].index, m));
    for (size_t i = 0; i < c->n_members; i++) fw_traffic_check_body(&k->traffic, c->members[i].index);
    return FW_OK;
}

/* After a change of cluster c at its t0: the parts try their next steps, then everybody looks ahead. freed: members of old. */
static fw_status go_on(fw_kernel *k, fw_cluster *c, double t_end, bool may_fall_apart, fw_msg *m)
{
    if (!may_fall_apart) {
        FW_TRY(fw_cluster_try(c, &k->traffic.books, step_limit(k, c, t_end), m));
        return look_ahead(k, c, m);
    }
    size_t first, n = c->n_members;
    FW_TRY(fw_grow(&k->new_name, &k->name_capacity, n + 1, sizeof *k->new_name, "clusters", m));
    for (size_t i = 0; i < n; i++) k->new_name[i] = c->members[i].index;
    FW_TRY(fall_apart(k, c, &first, m));
    if (c->n_members) return go_on(k, c, t_end, false, m);
    for (size_t i = first; i < k->n_clusters; i++)
        FW_TRY(fw_cluster_try(k->clusters[i], &k->traffic.books, step_limit(k, k->clusters[i], t_end), m));
    for (size_t i = 0; i < n; i++) FW_TRY(fw_traffic_follow(&k->traffic, k->new_name[i], m));
    for (size_t i = 0; i < n; i++) fw_traffic_check_body(&k->traffic, k->new_name[i]);
    return FW_OK;
}

/* --- events ----------------------------------------------------------------------------------------------------------- */

static fw_status commit(fw_kernel *k, fw_cluster *c, bool *has_opened, fw_msg *m)
{
    size_t n_opened = 0;
    FW_TRY(fw_grow(&k->opened, &k->opened_capacity, c->n_pairs + 1, sizeof *k->opened, "clusters", m));
    FW_TRY(fw_cluster_commit(c, &k->traffic.books, k->opened, &n_opened, m));
    for (size_t i = 0; i < n_opened; i++) {
        if (k->opened[i] < 0) continue;
        fw_candidate *e = &k->traffic.candidates[k->opened[i]];
        e->is_closed = false, e->clear = c->t0;
    }
    *has_opened |= n_opened > 0;
    return FW_OK;
}

static fw_status end_step(fw_kernel *k, fw_cluster *c, double t_end, fw_msg *m)
{
    bool has_opened = false;
    k->traffic.now = c->t1;
    FW_TRY(commit(k, c, &has_opened, m));
    return go_on(k, c, t_end, has_opened, m);
}

static void fly_to(fw_kernel *k, int32_t i, double t)
{
    fw_body *b = &k->traffic.world->bodies[i];
    if (b->t == t) return;
    fw_path  p = fw_path_of_flying(&k->traffic.setup, b);
    fw_place at = fw_path_at(&p, t);
    k->traffic.world->ledger.drag_work +=
        0.5 * (at.vx * at.vx + at.vy * at.vy - b->vx * b->vx - b->vy * b->vy) / b->inv_mass;
    b->x = at.x, b->y = at.y, b->vx = at.vx, b->vy = at.vy, b->t = t;
}

/* Untouched floe of candidate c -> awake body, where it is now. */
static fw_status wake(fw_kernel *k, int32_t c, fw_msg *m)
{
    fw_traffic  *t = &k->traffic;
    fw_world    *w = t->world;
    fw_candidate e = t->candidates[c];
    FW_TRY(fw_wake(&t->setup, w, (size_t)e.block, (size_t)e.row, m));
    int32_t j = (int32_t)w->n_bodies - 1;
    FW_TRY(fw_grow(&t->seats, &t->seat_capacity, w->n_bodies + 1, sizeof *t->seats, "candidates", m));
    fw_body *b = &w->bodies[j];
    b->x += t->setup.speed * (t->now - b->t);
    b->t = t->now;
    /* no margin: it leaves this line at once and is listed then */
    t->seats[j] = (fw_seat){.first = -1, .t = b->t, .x = b->x, .y = b->y, .vx = b->vx, .margin = -1};
    k->n_seated = w->n_bodies;
    fw_traffic_woken(t, c, j);
    /* What it may push lies where no ice has been made yet: list anew before going on. */
    if (b->x - b->radius - ice_margin(k, w) < k->ice_from) t->until = t->now;
    return FW_OK;
}

/* Is the tried step of a cluster so short that it stands at t already? */
static bool stands_at(const fw_cluster *c, double t) { return (t - c->t0) * c->omega < 1e-9; }

/* Bring clusters a and b (either may be NULL) to t. */
static fw_status land(fw_kernel *k, fw_cluster *a, fw_cluster *b, double t, fw_msg *m)
{
    fw_cluster *both[2] = {a, b == a ? NULL : b};
    for (int i = 0; i < 2; i++) {
        fw_cluster *c = both[i];
        if (c && !stands_at(c, t) && c->t1 != t) FW_TRY(fw_cluster_land(c, &k->traffic.books, t, m));
    }
    return FW_OK;
}

static double pair_omega(const fw_kernel *k, const fw_candidate *e)
{
    const fw_world *w = k->traffic.world;
    double          inv = w->bodies[e->i].inv_mass;
    if (e->j >= 0) {
        inv += w->bodies[e->j].inv_mass;
    } else if (e->j == FW_ICE) {
        const fw_block *b = &w->blocks[e->block];
        double          r = b->radius[e->row];
        inv += 1 / (k->traffic.setup.ice_density * 3.14159265358979323846 * r * r * b->thickness[e->row]);
    }
    return sqrt(k->traffic.setup.contact.stiffness * inv);
}

/* A gap g left at the touch is a force k g that is not there (or too early): w g in velocity within 1/w. It is compared with the
 * closing speed, and with what a step may be wrong anyway: rims that come together at less than that cannot be landed any better. */
static double acceptable_gap(const fw_kernel *k, const fw_candidate *e, double closing)
{
    const fw_setup *s = &k->traffic.setup;
    double          v = fw_larger(s->landing * closing, 0.3 * s->tolerance * s->velocity_scale);
    return fw_larger(v / pair_omega(k, e), 1e-12 * k->traffic.world->bodies[e->i].radius);
}

/* An overlap that the tolerance does not explain. A step that is cut is tried again, and the new one differs by its error times its length;
 * others may have gone by already. */
static double too_late(const fw_kernel *k, const fw_cluster *a, const fw_cluster *b, double t, double small)
{
    const fw_setup *s = &k->traffic.setup;
    double          longest = fw_larger(a ? t - a->t0 : 0, b ? t - b->t0 : 0);
    return fw_larger(1e3 * small, 10 * s->tolerance * s->velocity_scale * longest) + 1e-9;
}

/* Where the clusters of a candidate's floes stand at the touch. A step that was cut is another step than the one its cubic came from, so
 * the touch moves a little: Newton, each time with both steps tried again. */
static fw_status locate(fw_kernel *k, int32_t c, fw_cluster *a, fw_cluster *b, double *t, double *closing, bool *is_touch,
                        fw_msg *m)
{
    double last = *t, latest = fw_smaller(a ? a->t1 : INFINITY, b ? b->t1 : INFINITY);
    *is_touch = false;
    for (int n = 0; n < MAX_LANDINGS; n++) {
        const fw_candidate *e = &k->traffic.candidates[c];
        double              gap;
        FW_TRY(land(k, a, b, *t, m));
        fw_path p = fw_traffic_path(&k->traffic, e->i), q = fw_traffic_path_of_other(&k->traffic, e);
        fw_path_gap(&p, &q, *t, &gap, closing);
        double small = acceptable_gap(k, e, *closing), earliest = k->traffic.now;
        if (gap > small && !(*closing > 0)) return FW_OK;
        if (fabs(gap) <= small || (gap <= 0 && (*t <= earliest || !(*closing > 0)))) {
            if (-gap > too_late(k, a, b, *t, small)) k->traffic.world->ledger.late_touches++;
            *is_touch = true;
            return FW_OK;
        }
        double next = fw_larger(earliest, *t + gap / *closing);
        if (next > latest) return FW_OK; /* the step as cut now does not lead there: it ends here, and all look again */
        if (next == last && gap <= 0) {
            *is_touch = true;
            return FW_OK;
        }
        last = *t, *t = next;
    }
    *t = last; /* to and fro: where both stand now */
    *is_touch = true;
    return FW_OK;
}

static fw_status seat_of(fw_kernel *k, fw_cluster *c, int32_t body, int32_t *member, fw_msg *m)
{
    fw_seat *s = &k->traffic.seats[body];
    if (s->cluster != c) {
        fly_to(k, body, c->t0);
        FW_TRY(fw_cluster_join(c, &k->traffic.books, body, member, m));
        s->cluster = c, s->member = *member;
    }
    *member = s->member;
    return FW_OK;
}

static fw_status close_candidate(fw_kernel *k, fw_cluster *c, int32_t name, double closing, fw_msg *m)
{
    fw_candidate e = k->traffic.candidates[name];
    int32_t      a, b = FW_WALL;
    FW_TRY(seat_of(k, c, e.i, &a, m));
    if (e.j >= 0) FW_TRY(seat_of(k, c, e.j, &b, m));
    FW_TRY(fw_cluster_close(c, &k->traffic.books, a, b, name, closing, m));
    k->traffic.candidates[name].is_closed = true;
    k->traffic.candidates[name].touch = INFINITY;
    k->traffic.is_soonest_known = false;
    return FW_OK;
}

/* Mirror images touch at the same instant, and rims laid against each other without closing speed touch as of now: waiting for the
 * speed to grow takes slivers of steps without end. */
static fw_status close_others(fw_kernel *k, fw_cluster *c, fw_msg *m)
{
    const fw_setup *set = &k->traffic.setup;
    for (size_t i = 0; i < c->n_members; i++) {
        int32_t body = c->members[i].index, next;
        for (int32_t q = k->traffic.seats[body].first; q >= 0; q = next) {
            const fw_candidate *e = &k->traffic.candidates[q];
            next = fw_traffic_next(e, body);
            if (e->is_closed || e->j == FW_ICE || (e->j >= 0 && (e->i != body || k->traffic.seats[e->j].cluster != c)))
                continue;
            const fw_member *a = &c->members[i], *b = e->j >= 0 ? &c->members[k->traffic.seats[e->j].member] : NULL;
            double dx = a->y0[FW_X], dy = a->y0[FW_Y], ux = a->y0[FW_VX], uy = a->y0[FW_VY];
            if (b) dx -= b->y0[FW_X], dy -= b->y0[FW_Y], ux -= b->y0[FW_VX], uy -= b->y0[FW_VY];
            double r = fw_length(dx, dy);
            double gap = r - a->radius - (b ? b->radius : set->structure_radius), closing = -(dx * ux + dy * uy) / r;
            bool   is_laid = fabs(gap) <= 1e-11 * a->radius && closing > -1e-9 * set->velocity_scale;
            if (!is_laid && !(closing > 0 && fabs(gap) <= acceptable_gap(k, e, closing))) continue;
            FW_TRY(close_candidate(k, c, q, closing, m));
        }
    }
    return FW_OK;
}

/* Is somebody else's event before t? */
static bool is_first(const fw_kernel *k, int32_t c, const fw_cluster *a, const fw_cluster *b, double t)
{
    for (size_t i = 0; i < k->n_clusters; i++)
        if (k->clusters[i] != a && k->clusters[i] != b && k->clusters[i]->t1 < t) return false;
    for (size_t i = 0; i < k->traffic.n_candidates; i++)
        if ((int32_t)i != c && k->traffic.candidates[i].touch < t) return false;
    return true;
}

static fw_status touch(fw_kernel *k, int32_t c, double t_end, fw_msg *m)
{
    fw_traffic         *t = &k->traffic;
    const fw_candidate *e = &t->candidates[c];
    fw_cluster         *a = t->seats[e->i].cluster, *b = e->j >= 0 ? t->seats[e->j].cluster : NULL;
    double              at = e->touch, closing;
    bool                is_touch, has_opened = false;
    FW_TRY(locate(k, c, a, b, &at, &closing, &is_touch, m));
    if (!is_touch) {
        /* Steps were cut and paths have changed with them. */
        if (a) FW_TRY(look_ahead(k, a, m));
        if (b && b != a) FW_TRY(look_ahead(k, b, m));
        if (a || b) return FW_OK;
        t->now = at; /* two free floes graze each other: look again from here on */
        fw_traffic_check(t, c);
        return FW_OK;
    }
    if (at > t->candidates[c].touch && !(is_first(k, c, a, b, at) && at <= fw_smaller(t_end, t->until))) {
        /* Landing moved the touch past another event: that one comes first. The steps are cut where the touch is now. */
        if (a) FW_TRY(look_ahead(k, a, m));
        if (b && b != a) FW_TRY(look_ahead(k, b, m));
        fw_traffic_touches_at(t, c, at);
        return FW_OK;
    }
    t->now = at;
    fw_cluster *both[2] = {a, b == a ? NULL : b};
    for (int i = 0; i < 2; i++) {
        if (!both[i]) continue;
        if (stands_at(both[i], at))
            both[i]->t0 = both[i]->t1 = at;
        else
            FW_TRY(commit(k, both[i], &has_opened, m));
    }
    if (t->candidates[c].j == FW_ICE) FW_TRY(wake(k, c, m));
    if (!a && !b) FW_TRY(new_cluster(k, at, &a, m));
    if (!a) a = b;
    if (b && b != a) {
        FW_TRY(fw_cluster_merge(a, b, m));
        a->is_kept |= b->is_kept;
        retire(k, b);
        seat_members(k, a);
    }
    FW_TRY(close_candidate(k, a, c, closing, m));
    FW_TRY(close_others(k, a, m));
    fw_cluster_restart(a, &t->books);
    return go_on(k, a, t_end, has_opened, m);
}

/* --- listing ---------------------------------------------------------------------------------------------------------- */

/* Floes that the structure reaches before the next listing are awake: a candidate needs a body. */
static fw_status wake_before_structure(fw_kernel *k, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    double      dt = t->until - t->now, X = -w->drift, u = t->setup.speed;
    for (size_t q = 0; q < w->n_blocks; q++) {
        fw_block *b = &w->blocks[q];
        double    reach = t->setup.structure_radius + b->max_radius + 0.5 * u * dt, cx = X - 0.5 * u * dt;
        if (b->n_left == 0 || cx + reach < b->x_min || cx - reach > b->x_max) continue;
        for (size_t r = 0; r < b->n; r++) {
            double dx = b->x[r] - X, limit = t->setup.structure_radius + b->radius[r];
            if (b->is_taken[r] || fabs(b->y[r]) > limit || dx > limit || dx < -limit - u * dt ||
                fabs(b->y[r]) > t->setup.half_width)
                continue;
            FW_TRY(fw_wake(&t->setup, w, q, r, m));
        }
    }
    return FW_OK;
}

static fw_status export_contacts(fw_kernel *k, fw_msg *m)
{
    fw_world *w = k->traffic.world;
    w->n_contacts = 0;
    for (size_t i = 0; i < k->n_clusters; i++) {
        const fw_cluster *c = k->clusters[i];
        FW_TRY(fw_grow(&w->contacts, &w->contact_capacity, w->n_contacts + c->n_pairs + 1, sizeof *w->contacts, "contacts", m));
        for (size_t q = 0; q < c->n_pairs; q++) {
            const fw_pair *p = &c->pairs[q];
            w->contacts[w->n_contacts++] =
                (fw_contact){.i = c->members[p->a].index,
                             .j = p->b == FW_WALL ? FW_WALL : c->members[p->b].index,
                             .stiffness = p->law.k};
        }
    }
    return FW_OK;
}

static bool is_past(const fw_kernel *k, int32_t i)
{
    const fw_body *b = &k->traffic.world->bodies[i];
    fw_place       at = {.x = b->x, .y = b->y};
    if ((size_t)i < k->n_seated && !k->traffic.seats[i].cluster) {
        fw_path p = fw_path_of_flying(&k->traffic.setup, b);
        at = fw_path_at(&p, k->traffic.now);
    }
    return at.x > k->traffic.setup.downstream && fw_length(at.x, at.y) > k->traffic.setup.structure_radius + b->radius;
}

/* Members that are gone leave the cluster, with their contacts. */
static void leave(fw_kernel *k, fw_cluster *c)
{
    size_t kept = 0, kept_pairs = 0;
    for (size_t q = 0; q < c->n_pairs; q++) {
        fw_pair *p = &c->pairs[q];
        bool     is_lost = k->is_gone[c->members[p->a].index] || (p->b != FW_WALL && k->is_gone[c->members[p->b].index]);
        if (!is_lost) {
            c->pairs[kept_pairs++] = *p;
            continue;
        }
        c->members[p->a].n_pairs--;
        if (p->b != FW_WALL) c->members[p->b].n_pairs--;
    }
    c->n_pairs = kept_pairs;
    for (size_t i = 0; i < c->n_members; i++) {
        k->root[i] = (int32_t)kept;
        if (!k->is_gone[c->members[i].index]) c->members[kept++] = c->members[i];
    }
    c->n_members = kept;
    for (size_t q = 0; q < c->n_pairs; q++) {
        fw_pair *p = &c->pairs[q];
        p->a = k->root[p->a];
        if (p->b != FW_WALL) p->b = k->root[p->b];
    }
}

/* Floes far downstream are forgotten: free ones, whole clusters, and single members of a cluster that stands at this very
 * instant (others keep their steps short until the next listing, so that they do then). */
static fw_status forget(fw_kernel *k, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    bool        any = false;
    FW_TRY(fw_grow(&k->is_gone, &k->gone_capacity, w->n_bodies + 1, sizeof *k->is_gone, "clusters", m));
    FW_TRY(fw_grow(&k->new_name, &k->name_capacity, w->n_bodies + 1, sizeof *k->new_name, "clusters", m));
    FW_TRY(fw_grow(&k->root, &k->root_capacity, w->n_bodies + 1, sizeof *k->root, "clusters", m));
    for (size_t i = 0; i < w->n_bodies; i++) {
        k->is_gone[i] = is_past(k, (int32_t)i);
        any |= k->is_gone[i];
    }
    if (!any) return FW_OK;
    any = false;
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        size_t      n_gone = 0;
        for (size_t i = 0; i < c->n_members; i++) n_gone += k->is_gone[c->members[i].index];
        bool is_all = n_gone == c->n_members, is_now = c->t0 == t->now;
        c->is_kept = n_gone > 0 && !is_all && !is_now;
        if (!is_all && !is_now)
            for (size_t i = 0; i < c->n_members; i++) k->is_gone[c->members[i].index] = false;
    }
    for (size_t i = 0; i < w->n_bodies; i++) any |= k->is_gone[i];
    if (!any) return FW_OK;

    FW_TRY(export_contacts(k, m));
    for (size_t q = k->n_clusters; q-- > 0;) {
        fw_cluster *c = k->clusters[q];
        size_t      n = c->n_members;
        leave(k, c);
        if (c->n_members == n) continue;
        if (c->n_members == 0) {
            retire(k, c);
            continue;
        }
        seat_members(k, c);
        fw_cluster_restart(c, &t->books); /* forces are gone, so the accelerations that were kept are stale */
        c->h = INFINITY;
    }
    int32_t next = 0;
    for (size_t i = 0; i < w->n_bodies; i++) {
        k->new_name[i] = next;
        if (!k->is_gone[i] && i < k->n_seated) t->seats[next++] = t->seats[i];
    }
    fw_world_forget(w, k->is_gone);
    k->n_seated = w->n_bodies;
    for (size_t q = 0; q < k->n_clusters; q++)
        for (size_t i = 0; i < k->clusters[q]->n_members; i++) {
            fw_member *e = &k->clusters[q]->members[i];
            e->index = k->new_name[e->index];
        }
    /* Those that lost a member may have fallen apart; their parts try their steps when all is listed. */
    for (size_t q = k->n_clusters; q-- > 0;) {
        size_t first;
        if (k->clusters[q]->t1 == k->clusters[q]->t0) FW_TRY(fall_apart(k, k->clusters[q], &first, m));
    }
    return FW_OK;
}

static fw_status list(fw_kernel *k, double t_end, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    t->now = w->t, t->until = w->t + k->horizon;
    k->ice_from = fw_kernel_needs_ice_from(k, w) + 2 * w->max_radius;
    FW_TRY(forget(k, m));
    FW_TRY(wake_before_structure(k, m));
    FW_TRY(fw_grow(&t->seats, &t->seat_capacity, w->n_bodies + 1, sizeof *t->seats, "candidates", m));
    for (; k->n_seated < w->n_bodies; k->n_seated++) t->seats[k->n_seated] = (fw_seat){.first = -1};
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        if (c->t1 == c->t0) FW_TRY(fw_cluster_try(c, &t->books, step_limit(k, c, t_end), m));
    }
    FW_TRY(fw_traffic_list(t, m));
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        for (size_t i = 0; i < c->n_pairs; i++) {
            fw_pair *p = &c->pairs[i];
            int32_t  a = c->members[p->a].index, b = p->b == FW_WALL ? FW_WALL : c->members[p->b].index;
            /* Rims that part within the step that is on trial may be out of each other's reach already. */
            p->candidate = fw_traffic_find(t, a, b);
            if (p->candidate < 0) FW_TRY(fw_traffic_add(t, a, b, &p->candidate, m));
            t->candidates[p->candidate].is_closed = true;
        }
    }
    for (size_t c = 0; c < t->n_candidates; c++) fw_traffic_check(t, (int32_t)c);
    return FW_OK;
}

/* --- time ------------------------------------------------------------------------------------------------------------- */

static fw_cluster *first_to_end(const fw_kernel *k)
{
    fw_cluster *first = NULL;
    for (size_t i = 0; i < k->n_clusters; i++)
        if (!first || k->clusters[i]->t1 < first->t1) first = k->clusters[i];
    return first;
}

fw_status fw_kernel_step(fw_kernel *k, fw_world *w, fw_wear *wear, double t_end, fw_msg *m)
{
    fw_traffic     *t = &k->traffic;
    const fw_setup *s = &t->setup;
    t->world = w;
    t->books = (fw_books){s, w, wear};
    for (size_t i = 0; i < k->n_clusters; i++) /* steps tried when the end lay further away */
        if (k->clusters[i]->t1 > t_end) {
            FW_TRY(fw_cluster_land(k->clusters[i], &t->books, t_end, m));
            t->is_listed = false;
        }
    if (!t->is_listed || t->blocks_listed != w->block_changes || !(w->t < t->until)) FW_TRY(list(k, t_end, m));
    for (;;) {
        double      until = fw_smaller(t_end, t->until);
        fw_cluster *c = first_to_end(k);
        int32_t     e = fw_traffic_soonest(t);
        double      touches = e < 0 ? INFINITY : t->candidates[e].touch, ends = c ? c->t1 : INFINITY;
        if (touches <= ends && touches <= until)
            FW_TRY(touch(k, e, t_end, m));
        else if (ends <= until)
            FW_TRY(end_step(k, c, t_end, m));
        else
            break;
        FW_CHECK(w->ledger.force_evaluations <= s->max_evaluations, m, FW_E_LIMIT,
                 "more than %.3g force evaluations at t = %.6g s", s->max_evaluations, t->now);
    }
    double until = fw_smaller(t_end, t->until);
    w->drift += s->speed * (until - w->t);
    w->t = t->now = until;
    w->ledger.macro_steps++;
    if (until < t_end) return FW_OK;
    for (size_t i = 0; i < w->n_bodies; i++)
        if (!t->seats[i].cluster) fly_to(k, (int32_t)i, until);
    return export_contacts(k, m);
}
