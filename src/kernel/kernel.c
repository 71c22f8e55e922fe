#include "kernel/kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/island.h"
#include "kernel/neighbours.h"
#include "kernel/wake.h"

/* How fast a pair may close within a macro-step. In free flight speeds relative to the water only fall. From the moment on that
 * a floe is in contact or can be hit, it may stop dead or be pushed to the velocity scale: pairs with such a stirred floe get that
 * on top. Hits pass on through a raft within one macro-step, so the moments are worked out along chains: without that, 19 floes
 * 1 mm apart ran 0.1 m into each other and gained a third of their energy. What still slips through (a light floe squeezed out faster
 * than the velocity scale) is found late and counted in the ledger. */

struct fw_kernel {
    fw_setup      setup;
    fw_neighbours neighbours;
    double        macro_time;
    /* work, grown between steps */
    int32_t      *root;
    size_t        root_capacity; /* union-find over awake floes */
    int32_t      *member_of;
    size_t        member_capacity; /* awake floe -> member of the island being built */
    double       *way;
    size_t        way_capacity; /* speeds of awake floes relative to the water [m/s] */
    double       *stirred_at;
    size_t        stirred_capacity; /* from when on a contact may change its velocity, after the macro-step's
                                                      * start [s]; INFINITY: not within it */
    bool         *is_gone;
    size_t        gone_capacity;
    fw_member    *members;
    size_t        members_capacity;
    fw_pair      *pairs;
    size_t        pairs_capacity;
    int32_t      *closed;
    size_t        closed_capacity;
    int32_t      *held;
    size_t        held_capacity;
    struct link {
        int32_t root, i, j, contact;
    }          *links;
    size_t      link_capacity; /* near or closed pairs by island */
    fw_contact *contacts;
    size_t      contacts_capacity; /* closed at the macro-step's end */
};

fw_status fw_kernel_create(fw_kernel **out, const fw_setup *setup, fw_msg *m)
{
    FW_CHECK(setup->velocity_scale > 0 && setup->macro_length > 0 && setup->tolerance > 0 && setup->skin > 0, m,
             FW_E_ARG, "kernel: velocity scale, macro length, tolerance and skin must be positive");
    FW_TRY(fw_alloc(out, 1, sizeof **out, "kernel", m));
    (*out)->setup = *setup;
    (*out)->macro_time = setup->macro_length / setup->velocity_scale;
    return FW_OK;
}

void fw_kernel_destroy(fw_kernel *k)
{
    if (!k) return;
    fw_neighbours_free(&k->neighbours);
    free(k->root);
    free(k->member_of);
    free(k->way);
    free(k->stirred_at);
    free(k->is_gone);
    free(k->members);
    free(k->pairs);
    free(k->closed);
    free(k->held);
    free(k->links);
    free(k->contacts);
    free(k);
}

double fw_kernel_needs_ice_from(const fw_kernel *k, const fw_world *w)
{
    double least = -w->structure_radius;
    for (size_t i = 0; i < w->n_bodies; i++) least = fw_smaller(least, w->bodies[i].x - w->bodies[i].radius);
    return least - w->max_radius - 2 * k->setup.skin;
}

static double undisturbed_gap(const fw_world *w, double x, double y, double radius, const fw_block *b, size_t row)
{
    double dx = x - b->x[row] - w->drift, dy = y - b->y[row];
    return sqrt(dx * dx + dy * dy) - radius - b->radius[row];
}

fw_status fw_wake(const fw_setup *s, fw_world *w, size_t block, size_t row, fw_msg *m)
{
    fw_block *b = &w->blocks[block];
    double    r = b->radius[row], h = b->thickness[row], mass = s->ice_density * 3.14159265358979323846 * r * r * h;
    fw_body   body = {.x = b->x[row] + w->drift,
                      .y = b->y[row],
                      .vx = s->speed,
                      .radius = r,
                      .thickness = h,
                      .inv_mass = 1 / mass,
                      .inv_inertia = s->has_rotation ? 2 / (mass * r * r) : 0,
                      .drag = s->drag_per_area * 2 * r * h,
                      .name = b->first_name + row};
    b->is_taken[row] = true;
    b->n_left--;
    return fw_world_add_body(w, &body, m);
}

static double way_relative_to_water(const fw_setup *s, const fw_body *b) { return fw_length(b->vx - s->speed, b->vy); }

/* The earliest time at which the pair can meet, by its own flight or after one of them was hit; INFINITY: not within H. */
static double meets_at(const fw_kernel *k, const fw_world *w, int32_t i, int32_t j, double H)
{
    const fw_setup *s = &k->setup;
    const fw_body  *a = &w->bodies[i], *b = j == FW_WALL ? NULL : &w->bodies[j];
    double speed = k->way[i] + (b ? k->way[j] : s->speed), reach = a->radius + (b ? b->radius : w->structure_radius);
    double dx = b ? a->x - b->x : a->x, dy = b ? a->y - b->y : a->y, d2 = dx * dx + dy * dy;
    double limit = reach + (speed + s->velocity_scale) * H * (1 + 1e-9);
    if (d2 > limit * limit) return INFINITY; /* most pairs within the skin end here */
    double stirred = j == FW_WALL ? k->stirred_at[i] : fw_smaller(k->stirred_at[i], k->stirred_at[j]);
    double gap = sqrt(d2) - reach;
    if (!(gap > 0)) return 0;
    double alone = speed > 0 ? gap / speed : INFINITY;
    return alone <= stirred ? alone : (gap + s->velocity_scale * stirred) / (speed + s->velocity_scale);
}

/* Who is in contact or may be hit within H, and when at the earliest. Times only fall, the least one is final at once. */
static void stir(fw_kernel *k, const fw_world *w, double H)
{
    double *at = k->stirred_at;
    bool    is_final = false;
    for (size_t i = 0; i < w->n_bodies; i++) {
        at[i] = w->bodies[i].n_closed > 0 ? 0 : INFINITY;
        k->way[i] = way_relative_to_water(&k->setup, &w->bodies[i]);
    }
    while (!is_final) {
        is_final = true;
        for (size_t q = 0; q < k->neighbours.n_near; q++) {
            fw_near e = k->neighbours.near[q];
            double  first = e.j < 0 ? at[e.i] : fw_smaller(at[e.i], at[e.j]),
                   last = e.j < 0 ? at[e.i] : fw_larger(at[e.i], at[e.j]);
            if (e.j >= 0 && !w->bodies[e.i].is_touched && !w->bodies[e.j].is_touched && first == INFINITY) continue;
            if (last == 0) continue;
            double t = meets_at(k, w, e.i, e.j, H);
            if (!(t <= H) || !(t < last)) continue;
            if (t < at[e.i]) at[e.i] = t;
            if (e.j >= 0 && t < at[e.j]) at[e.j] = t;
            is_final = false;
        }
    }
}

/* Untouched floes that something may reach within the macro-step become awake. */
static fw_status wake_near(fw_kernel *k, fw_world *w, double H, bool *is_changed, fw_msg *m)
{
    const fw_setup *s = &k->setup;
    *is_changed = false;
    for (size_t q = 0; q < k->neighbours.n_sleepers; q++) {
        fw_sleeper_near n = k->neighbours.sleepers[q];
        fw_block       *b = &w->blocks[n.block];
        if (b->is_taken[n.row]) continue;
        double gap, way = s->speed * H;
        if (n.i == FW_WALL) {
            gap = undisturbed_gap(w, 0, 0, w->structure_radius, b, n.row);
        } else {
            const fw_body *a = &w->bodies[n.i];
            if (!a->is_touched && !(k->stirred_at[n.i] < H)) continue;
            gap = undisturbed_gap(w, a->x, a->y, a->radius, b, n.row);
            way = k->way[n.i] * H + s->velocity_scale * fw_larger(0, H - k->stirred_at[n.i]);
        }
        if (gap > way) continue;
        FW_TRY(fw_wake(s, w, n.block, n.row, m));
        *is_changed = true;
    }
    return FW_OK;
}

static int32_t find_root(int32_t *root, int32_t i)
{
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
}

/* The lowest floe of an island is its root: islands are worked in a fixed order. */
static void join(int32_t *root, int32_t i, int32_t j)
{
    i = find_root(root, i), j = find_root(root, j);
    if (i < j)
        root[j] = i;
    else
        root[i] = j;
}

static int link_order(const void *x, const void *y)
{
    const struct link *a = x, *b = y;
    if (a->root != b->root) return a->root < b->root ? -1 : 1;
    if (a->i != b->i) return a->i < b->i ? -1 : 1;
    /* the structure's contact of a floe comes last */
    uint32_t p = (uint32_t)a->j, q = (uint32_t)b->j;
    return p < q ? -1 : p > q;
}

static int contact_order(const void *x, const void *y)
{
    const fw_contact *a = x, *b = y;
    if (a->i != b->i) return a->i < b->i ? -1 : 1;
    uint32_t p = (uint32_t)a->j, q = (uint32_t)b->j;
    return p < q ? -1 : p > q;
}

static fw_status find_links(fw_kernel *k, const fw_world *w, double H, size_t *n_links, fw_msg *m)
{
    size_t n = 0, at = 0;
    FW_TRY(fw_grow(&k->links, &k->link_capacity, k->neighbours.n_near + w->n_contacts, sizeof *k->links, "islands", m));
    for (size_t i = 0; i < w->n_bodies; i++) k->root[i] = (int32_t)i;
    /* Both lists are ordered by (i, j): walk them side by side. A closed contact is always a link. */
    for (size_t q = 0; q < w->n_contacts; q++) {
        const fw_contact *c = &w->contacts[q];
        k->links[n++] = (struct link){0, c->i, c->j, (int32_t)q};
        if (c->j >= 0) join(k->root, c->i, c->j);
    }
    for (size_t q = 0; q < k->neighbours.n_near; q++) {
        fw_near e = k->neighbours.near[q];
        while (at < w->n_contacts &&
               (w->contacts[at].i < e.i || (w->contacts[at].i == e.i && (uint32_t)w->contacts[at].j < (uint32_t)e.j)))
            at++;
        if (at < w->n_contacts && w->contacts[at].i == e.i && w->contacts[at].j == e.j) continue;
        if (!(meets_at(k, w, e.i, e.j, H) <= H)) continue;
        k->links[n++] = (struct link){0, e.i, e.j, -1};
        if (e.j >= 0) join(k->root, e.i, e.j);
    }
    for (size_t q = 0; q < n; q++) k->links[q].root = find_root(k->root, k->links[q].i);
    if (n > 1) qsort(k->links, n, sizeof *k->links, link_order);
    *n_links = n;
    return FW_OK;
}

static int32_t enrol(fw_kernel *k, fw_world *w, int32_t i, size_t *n_members)
{
    if (k->member_of[i] >= 0) return k->member_of[i];
    fw_member *m = &k->members[*n_members];
    fw_body   *b = &w->bodies[i];
    m->body = b, m->index = i, m->n_closed = b->n_closed;
    m->x0 = b->x, m->y0 = b->y;
    m->v0[0] = b->vx, m->v0[1] = b->vy, m->v0[2] = b->spin;
    m->a[0][0] = b->ax, m->a[0][1] = b->ay, m->a[0][2] = b->as;
    for (int q = 0; q < 3; q++) m->v[0][q] = m->v0[q];
    return k->member_of[i] = (int32_t)(*n_members)++;
}

static void load_pair(fw_kernel *k, fw_world *w, const struct link *l, fw_pair *p, size_t *n_members)
{
    const fw_setup *s = &k->setup;
    p->a = enrol(k, w, l->i, n_members);
    p->b = l->j == FW_WALL ? FW_WALL : enrol(k, w, l->j, n_members);
    p->is_closed = l->contact >= 0;
    if (p->is_closed) {
        const fw_contact *c = &w->contacts[l->contact];
        p->law = c->law, p->t_touch = c->t_touch, p->since_touch = w->t - c->t_touch;
        if (p->since_touch <= 0) p->since_touch = 1e-12;
        p->depth[0] = c->depth, p->rate[0] = c->rate, p->slip[0] = c->slip, p->normal[0] = c->normal,
        p->friction[0] = c->friction;
        p->dir[0][0] = c->nx, p->dir[0][1] = c->ny;
    } else {
        double inv = w->bodies[l->i].inv_mass + (l->j == FW_WALL ? 0 : w->bodies[l->j].inv_mass);
        p->law = fw_contact_law_apply(&s->contact, 1 / inv);
    }
}

static fw_status save_island(fw_kernel *k, const fw_island *is, size_t *n_contacts, fw_msg *m)
{
    for (size_t i = 0; i < is->n_members; i++) {
        const fw_member *e = &is->members[i];
        fw_body         *b = e->body;
        b->x = e->x0, b->y = e->y0, b->vx = e->v0[0], b->vy = e->v0[1], b->spin = e->v0[2];
        b->ax = e->a[0][0], b->ay = e->a[0][1], b->as = e->a[0][2];
        b->n_closed = e->n_closed;
        k->member_of[e->index] = -1;
        FW_CHECK(isfinite(b->x) && isfinite(b->y) && isfinite(b->spin), m, FW_E_NUMERIC,
                 "the state of floe %llu is not finite at t = %.6g s", (unsigned long long)b->name, is->t);
    }
    for (size_t q = 0; q < is->n_pairs; q++) {
        const fw_pair *p = &is->pairs[q];
        if (!p->is_closed) continue;
        FW_TRY(fw_grow(&k->contacts, &k->contacts_capacity, *n_contacts + 1, sizeof *k->contacts, "contacts", m));
        k->contacts[(*n_contacts)++] = (fw_contact){.i = is->members[p->a].index,
                                                    .j = p->b == FW_WALL ? FW_WALL : is->members[p->b].index,
                                                    .law = p->law,
                                                    .t_touch = p->t_touch,
                                                    .depth = p->depth[0],
                                                    .rate = p->rate[0],
                                                    .slip = p->slip[0],
                                                    .normal = p->normal[0],
                                                    .friction = p->friction[0],
                                                    .nx = p->dir[0][0],
                                                    .ny = p->dir[0][1]};
    }
    return FW_OK;
}

/* The acceleration that was kept is that of the last stage; drag is what the contacts leave of it. Evaluating it anew would
 * differ by the solver's tolerance, and the momentum books would show it. */
static void split_accelerations(fw_island *is)
{
    for (size_t i = 0; i < is->n_members; i++) {
        fw_member *e = &is->members[i];
        e->drag[0][0] = e->a[0][0], e->drag[0][1] = e->a[0][1];
    }
    for (size_t q = 0; q < is->n_pairs; q++) {
        const fw_pair *p = &is->pairs[q];
        if (!p->is_closed) continue;
        double     fx = p->normal[0] * p->dir[0][0] - p->friction[0] * p->dir[0][1];
        double     fy = p->normal[0] * p->dir[0][1] + p->friction[0] * p->dir[0][0];
        fw_member *a = &is->members[p->a];
        a->drag[0][0] -= fx * a->body->inv_mass, a->drag[0][1] -= fy * a->body->inv_mass;
        if (p->b == FW_WALL) continue;
        fw_member *b = &is->members[p->b];
        b->drag[0][0] += fx * b->body->inv_mass, b->drag[0][1] += fy * b->body->inv_mass;
    }
}

static fw_status run_islands(fw_kernel *k, fw_world *w, fw_wear *wear, size_t n_links, double t_end, size_t *n_contacts,
                             fw_msg *m)
{
    const fw_setup *s = &k->setup;
    for (size_t from = 0, to; from < n_links; from = to) {
        size_t n_members = 0;
        for (to = from; to < n_links && k->links[to].root == k->links[from].root; to++)
            load_pair(k, w, &k->links[to], &k->pairs[to - from], &n_members);
        fw_island is = {.setup = s,
                        .t = w->t,
                        .n_members = n_members,
                        .n_pairs = to - from,
                        .members = k->members,
                        .pairs = k->pairs,
                        .closed = k->closed,
                        .held = k->held,
                        .ledger = &w->ledger,
                        .wear = wear,
                        .structure_radius = s->structure_radius};
        for (size_t q = 0; q < is.n_pairs; q++) is.n_closed += is.pairs[q].is_closed;
        split_accelerations(&is);
        FW_TRY(fw_island_advance(&is, t_end, m));
        w->n_touched += is.n_touched;
        FW_TRY(save_island(k, &is, n_contacts, m));
    }
    return FW_OK;
}

/* Floes that nobody can reach: closed form. An undisturbed one drifts with the water exactly. */
static void fly_alone(fw_kernel *k, fw_world *w, size_t n_links, double dt)
{
    bool *is_linked = k->is_gone; /* free until forget() */
    memset(is_linked, 0, w->n_bodies * sizeof *is_linked);
    for (size_t q = 0; q < n_links; q++) {
        is_linked[k->links[q].i] = true;
        if (k->links[q].j >= 0) is_linked[k->links[q].j] = true;
    }
    for (size_t i = 0; i < w->n_bodies; i++) {
        if (is_linked[i]) continue;
        fw_body  *b = &w->bodies[i];
        fw_member e = {.body = b, .x0 = b->x, .y0 = b->y, .v0 = {b->vx, b->vy, b->spin}};
        fw_touch_fly(&k->setup, &e, dt, &b->x, &b->y, e.v1);
        double gained = 0.5 * (e.v1[0] * e.v1[0] + e.v1[1] * e.v1[1] - b->vx * b->vx - b->vy * b->vy) / b->inv_mass;
        w->ledger.drag_work += gained;
        b->vx = e.v1[0], b->vy = e.v1[1];
    }
}

static void forget(fw_kernel *k, fw_world *w)
{
    const fw_setup *s = &k->setup;
    bool            any = false;
    for (size_t i = 0; i < w->n_bodies; i++) {
        const fw_body *b = &w->bodies[i];
        k->is_gone[i] = b->x > s->downstream && fw_length(b->x, b->y) > s->structure_radius + b->radius;
        any |= k->is_gone[i];
    }
    if (!any) return;
    fw_world_forget(w, k->is_gone);
    k->neighbours.is_valid = false;
}

fw_status fw_kernel_step(fw_kernel *k, fw_world *w, fw_wear *wear, double t_end, fw_msg *m)
{
    const fw_setup *s = &k->setup;
    /* No sliver of a step at the end: an acceleration from a velocity difference over 1e-13 s is rounding noise. */
    bool            is_last = t_end - w->t <= k->macro_time * (1 + 1e-6);
    double          dt = is_last ? t_end - w->t : k->macro_time, t1 = is_last ? t_end : w->t + dt;
    bool            is_changed = fw_neighbours_is_stale(&k->neighbours, s, w, k->macro_time);
    do {
        if (is_changed) FW_TRY(fw_neighbours_list(&k->neighbours, s, w, m));
        FW_TRY(fw_grow(&k->stirred_at, &k->stirred_capacity, w->n_bodies + 1, sizeof *k->stirred_at, "islands", m));
        FW_TRY(fw_grow(&k->way, &k->way_capacity, w->n_bodies + 1, sizeof *k->way, "islands", m));
        stir(k, w, dt);
        FW_TRY(wake_near(k, w, dt, &is_changed, m));
    } while (is_changed);

    FW_TRY(fw_grow(&k->root, &k->root_capacity, w->n_bodies + 1, sizeof *k->root, "islands", m));
    FW_TRY(fw_grow(&k->is_gone, &k->gone_capacity, w->n_bodies + 1, sizeof *k->is_gone, "islands", m));
    FW_TRY(fw_grow(&k->member_of, &k->member_capacity, w->n_bodies + 1, sizeof *k->member_of, "islands", m));
    FW_TRY(fw_grow(&k->members, &k->members_capacity, w->n_bodies + 1, sizeof *k->members, "islands", m));
    for (size_t i = 0; i < w->n_bodies; i++) k->member_of[i] = -1;
    size_t n_links, n_contacts = 0;
    FW_TRY(find_links(k, w, dt, &n_links, m));
    FW_TRY(fw_grow(&k->pairs, &k->pairs_capacity, n_links + 1, sizeof *k->pairs, "islands", m));
    FW_TRY(fw_grow(&k->closed, &k->closed_capacity, n_links + 1, sizeof *k->closed, "islands", m));
    FW_TRY(fw_grow(&k->held, &k->held_capacity, w->n_bodies + 1, sizeof *k->held, "islands", m));
    fly_alone(k, w, n_links, dt);
    FW_TRY(run_islands(k, w, wear, n_links, t1, &n_contacts, m));
    FW_TRY(fw_grow(&w->contacts, &w->contact_capacity, n_contacts + 1, sizeof *w->contacts, "contacts", m));
    if (n_contacts > 1) qsort(k->contacts, n_contacts, sizeof *k->contacts, contact_order);
    if (n_contacts) memcpy(w->contacts, k->contacts, n_contacts * sizeof *w->contacts);
    w->n_contacts = n_contacts;
    w->t = t1;
    w->drift += s->speed * dt;
    w->ledger.macro_steps++;
    forget(k, w);
    FW_CHECK(w->ledger.force_evaluations <= s->max_evaluations, m, FW_E_LIMIT,
             "more than %.3g force evaluations at t = %.6g s", s->max_evaluations, w->t);
    return FW_OK;
}
