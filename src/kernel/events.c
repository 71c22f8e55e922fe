/* What happens at an event: a step ends, or two rims touch. */
#include "kernel/inside.h"

#include <math.h>

#include "base/memory.h"
#include "kernel/crush.h"
#include "kernel/forces.h"
#include "kernel/wake.h"
#include "kernel/watch.h"

enum { MAX_LANDINGS = 8 };
/* Events that only cut steps, one after the other: 400 floes about to touch at once are some hundreds. */
enum { MAX_IDLE = 100000 };

double fw_event_step_limit(const fw_kernel *k, const fw_cluster *c, double t_end)
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

/* Clusters a and b, either may be NULL, have new paths. */
static fw_status both_look_ahead(fw_kernel *k, fw_cluster *a, fw_cluster *b, fw_msg *m)
{
    if (a) FW_TRY(look_ahead(k, a, m));
    return b && b != a ? look_ahead(k, b, m) : FW_OK;
}

/* After a change of cluster c at its t0: the parts try their next steps, then everybody looks ahead, freed floes too. */
static fw_status go_on(fw_kernel *k, fw_cluster *c, double t_end, bool may_fall_apart, fw_msg *m)
{
    if (!may_fall_apart) {
        FW_TRY(fw_cluster_try(c, &k->traffic.books, fw_event_step_limit(k, c, t_end), m));
        return look_ahead(k, c, m);
    }
    size_t first, n = c->n_members;
    FW_TRY(fw_grow(&k->new_name, &k->name_capacity, n + 1, sizeof *k->new_name, "clusters", m));
    for (size_t i = 0; i < n; i++) k->new_name[i] = c->members[i].index;
    FW_TRY(fw_flock_fall_apart(k, c, &first, m));
    if (c->n_members) return go_on(k, c, t_end, false, m);
    for (size_t i = first; i < k->n_clusters; i++)
        FW_TRY(fw_cluster_try(k->clusters[i], &k->traffic.books, fw_event_step_limit(k, k->clusters[i], t_end), m));
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
    k->n_idle = 0;
    for (size_t i = 0; i < n_opened; i++) {
        if (k->opened[i] < 0) continue;
        fw_candidate *e = &k->traffic.candidates[k->opened[i]];
        e->is_closed = false, e->clear = c->t0;
    }
    *has_opened |= n_opened > 0;
    return FW_OK;
}

fw_status fw_event_step_ends(fw_kernel *k, fw_cluster *c, double t_end, fw_msg *m)
{
    bool has_opened = false;
    k->traffic.now = c->t1;
    FW_TRY(commit(k, c, &has_opened, m));
    return go_on(k, c, t_end, has_opened, m);
}

void fw_event_fly(fw_kernel *k, int32_t i, double t)
{
    fw_body *b = &k->traffic.world->bodies[i];
    if (b->t == t) return;
    fw_path  p = fw_path_of_flying(&k->traffic.setup, b);
    fw_place at = fw_path_at(&p, t);
    fw_ledger *l = &k->traffic.world->ledger;
    l->drag_work += 0.5 * (at.vx * at.vx + at.vy * at.vy - b->vx * b->vx - b->vy * b->vy) / b->inv_mass;
    double turned = b->spin * (t - b->t);
    if (b->spin_drag > 0 && b->inv_inertia > 0) {
        double spin = fw_flight_spin(b, p.r, p.K, t - b->t, &turned);
        l->drag_work += 0.5 * (spin * spin - b->spin * b->spin) / b->inv_inertia;
        b->spin = spin;
    }
    if (fw_is_crush(&k->traffic.setup)) b->angle += turned;
    b->x = at.x, b->y = at.y, b->vx = at.vx, b->vy = at.vy, b->t = t;
}

/* --- a touch ---------------------------------------------------------------------------------------------------- */

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
    b->x += t->setup.flow.ice_x * (t->now - b->t), b->y += t->setup.flow.ice_y * (t->now - b->t);
    b->t = t->now;
    /* no margin: it leaves this line at once and is listed then */
    t->seats[j] = (fw_seat){.first = -1, .t = b->t, .x = b->x, .y = b->y, .vx = b->vx, .vy = b->vy, .margin = -1, .reach = b->radius - 1};
    k->n_seated = w->n_bodies;
    fw_traffic_woken(t, c, j);
    /* What it may push lies where no ice has been made yet: list anew before going on. */
    double margin = b->radius + fw_kernel_ice_margin(k), gone = t->now - w->t;
    double X = b->x - (w->drift_x + t->setup.flow.ice_x * gone), Y = b->y - (w->drift_y + t->setup.flow.ice_y * gone);
    if (X - margin < w->ice_from || X + margin > w->ice_to || Y - margin < w->ice_low || Y + margin > w->ice_high) t->until = t->now;
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
    const fw_setup *s = &k->traffic.setup;
    const fw_body  *a = &w->bodies[e->i];
    double          inv = a->inv_mass, R = s->structure_radius, h = a->thickness;
    if (e->j >= 0) {
        inv += w->bodies[e->j].inv_mass, R = w->bodies[e->j].radius, h = fw_smaller(h, w->bodies[e->j].thickness);
    } else if (e->j == FW_ICE) {
        const fw_block *b = &w->blocks[e->block];
        R = b->radius[e->row], h = fw_smaller(h, b->thickness[e->row]);
        inv += 1 / fw_kernel_floe_mass(s, R, b->thickness[e->row]);
    }
    bool is_pressure = fw_is_from_pressure(s) || (fw_is_crush(s) && e->j == FW_WALL);
    return sqrt((is_pressure ? fw_crush_spring(s, 1 / inv, a->radius, R, h) : (e->j == FW_WALL ? s->contact : s->floe_contact).stiffness) * inv);
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
    return 30 * fw_larger(small, s->tolerance * s->velocity_scale * longest) + 1e-9;
}

/* Who overlaps at the very start has been put there so. */
static fw_status watch_touch(fw_kernel *k, const fw_candidate *e, const fw_cluster *a, const fw_cluster *b, const fw_path *other, double t, double gap,
                             double small, fw_msg *m)
{
    fw_world *w = k->traffic.world;
    if (!(-gap > too_late(k, a, b, t, small)) || !(t > 0)) return FW_OK;
    return fw_watch_late(&k->traffic.setup, &w->ledger, &w->bodies[e->i], e->j == FW_WALL ? 0 : other->radius, -gap, t, m);
}

/* Where the clusters of a candidate's floes stand at the touch. A step that was cut is another step than the one its cubic came from, so
 * the touch moves a little: Newton, each time with both steps tried again. */
static fw_status locate(fw_kernel *k, int32_t c, fw_cluster *a, fw_cluster *b, double *t, double *closing,
                        bool *is_touch, fw_msg *m)
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
            *is_touch = true;
            return watch_touch(k, e, a, b, &q, *t, gap, small, m);
        }
        double next = fw_larger(earliest, *t + gap / *closing);
        if (next > latest) return FW_OK; /* the step as cut now does not lead there: it ends here, and all look again */
        if (next == last && gap <= 0) {
            *is_touch = true;
            return watch_touch(k, e, a, b, &q, *t, gap, small, m);
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
        fw_event_fly(k, body, c->t0);
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
            double           dx = a->y0[FW_X], dy = a->y0[FW_Y], ux = a->y0[FW_VX], uy = a->y0[FW_VY];
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

fw_status fw_event_touch(fw_kernel *k, int32_t c, double t_end, fw_msg *m)
{
    fw_traffic         *t = &k->traffic;
    const fw_candidate *e = &t->candidates[c];
    fw_cluster         *a = t->seats[e->i].cluster, *b = e->j >= 0 ? t->seats[e->j].cluster : NULL;
    double              at = e->touch, closing;
    bool                is_touch, has_opened = false;
    FW_CHECK(k->n_idle++ < MAX_IDLE, m, FW_E_NUMERIC, "floe %llu and another are looked at again and again without a touch at t = %.6g s",
             (unsigned long long)t->world->bodies[e->i].name, t->now);
    FW_TRY(locate(k, c, a, b, &at, &closing, &is_touch, m));
    if (!is_touch) {
        /* Steps were cut and paths have changed with them. They stay cut where the touch was looked for first: let out again to where its search
         * came to, they would lead to the same dip of the same path, for ever. */
        if (at > t->candidates[c].touch) FW_TRY(land(k, a, b, t->candidates[c].touch, m));
        FW_TRY(both_look_ahead(k, a, b, m));
        if (a || b) return FW_OK;
        t->now = at; /* two free floes graze each other: look again from here on */
        fw_traffic_check(t, c);
        return FW_OK;
    }
    if (at > t->candidates[c].touch && !(is_first(k, c, a, b, at) && at <= fw_smaller(t_end, t->until))) {
        /* Landing moved the touch past another event: that one comes first. The steps are cut where the touch is now. */
        FW_TRY(both_look_ahead(k, a, b, m));
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
    if (!a && !b) FW_TRY(fw_flock_new(k, at, &a, m));
    if (!a) a = b;
    if (b && b != a) {
        FW_TRY(fw_cluster_merge(a, b, m));
        a->is_kept |= b->is_kept;
        fw_flock_retire(k, b);
        fw_flock_seat(k, a);
    }
    FW_TRY(close_candidate(k, a, c, closing, m));
    FW_TRY(close_others(k, a, m));
    k->n_idle = 0;
    fw_cluster_restart(a, &t->books);
    return go_on(k, a, t_end, has_opened, m);
}
