/* What a committed step leaves behind: energy, momentum, counts, and wear on the ring.
 *
 * Energy is entered where the force acts, by the method's own quadrature; what the checks compare is reached on another
 * way (change of kinetic energy, stored energy at the ends). */
#include "geometry/ring.h"
#include "kernel/cluster.h"

static void shove(fw_member *m, double jx, double jy, double rub)
{
    m->gained[0] += jx * m->own_inv_mass, m->gained[1] += jy * m->own_inv_mass;
    m->gained[2] -= rub * m->turn;
    m->shoved += fw_length(jx, jy) * m->own_inv_mass;
}

static void keep_pair(const fw_cluster *c, const fw_books *books, const fw_pair *p, double h, bool *is_beyond)
{
    const fw_method *me = books->setup->method;
    fw_ledger       *l = &books->world->ledger;
    fw_member       *a = &c->members[p->a], *b = p->b == FW_WALL ? NULL : &c->members[p->b];
    size_t           last = me->n_stages - 1;
    double           jx = 0, jy = 0, rub = 0, push = 0, dashpot = 0, dropped = 0, friction = 0;
    for (size_t s = 0; s <= last; s++) {
        double hb = h * me->b[s], n = p->normal[s], f = p->friction[s], d = p->depth[s], w = p->rate[s];
        jx += hb * (n * p->dir[s][0] - f * p->dir[s][1]), jy += hb * (n * p->dir[s][1] + f * p->dir[s][0]);
        rub += hb * f, push += hb * n;
        double spring = d > 0 ? p->law.k * d * w : 0;
        if (n > 0)
            dashpot += hb * (n * w - spring);
        else
            dropped -= hb * spring;
        friction -= hb * f * p->slip[s];
        if (p->b == FW_WALL && n > l->peak_force) l->peak_force = n;
    }
    if (!(push > 0)) {
        /* No force at all: what the spring loses is dropped, exactly, also where the rims part inside the step. */
        double d0 = fw_larger(0, p->depth[0]), d1 = fw_larger(0, p->depth[last]);
        dashpot = 0, dropped = 0.5 * p->law.k * (d0 * d0 - d1 * d1);
    }
    l->dashpot += dashpot, l->dropped += dropped, l->friction += friction;
    shove(a, jx, jy, rub);
    if (b) {
        shove(b, -jx, -jy, rub);
    } else {
        double from = fw_pair_signed_normal(p, 0), to = fw_pair_signed_normal(p, last);
        l->normal_impulse += push;
        l->contact_time += from > 0 && to > 0 ? h
                           : from > 0         ? h * from / (from - to)
                           : to > 0           ? h * to / (to - from)
                                              : 0;
    }
    double small = fw_smaller(a->radius, b ? b->radius : books->setup->structure_radius), d = p->depth[last];
    l->max_overlap = fw_larger(l->max_overlap, d);
    l->max_overlap_share = fw_larger(l->max_overlap_share, d / small);
    if (d > 0.1 * small) *is_beyond = true;
}

void fw_books_keep(const fw_cluster *c, const fw_books *books)
{
    const fw_method *me = books->setup->method;
    fw_ledger       *l = &books->world->ledger;
    double           h = c->t1 - c->t0;
    bool             is_beyond = false;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     j[2] = {0, 0}, work = 0;
        for (size_t s = 0; s < me->n_stages; s++) {
            double hb = h * me->b[s];
            j[0] += hb * m->drag[s][0], j[1] += hb * m->drag[s][1];
            work += hb * (m->drag[s][0] * m->v[s][0] + m->drag[s][1] * m->v[s][1]);
        }
        l->drag_work += work / m->own_inv_mass;
        m->gained[0] = j[0], m->gained[1] = j[1], m->gained[2] = 0;
        m->shoved = fw_length(j[0], j[1]);
    }
    for (size_t k = 0; k < c->n_pairs; k++) keep_pair(c, books, &c->pairs[k], h, &is_beyond);
    if (is_beyond) l->overlap_time += h;
    for (size_t i = 0; i < c->n_members; i++) {
        const fw_member *m = &c->members[i];
        double           mass = 1 / m->own_inv_mass, inertia = m->inv_inertia > 0 ? 1 / m->inv_inertia : 0;
        double           change = 0, work = 0, err = 0;
        for (int q = 0; q < 3; q++) {
            double in = q < 2 ? mass : inertia, dv = m->v1[q] - m->v0[q], mean = 0.5 * (m->v1[q] + m->v0[q]);
            change += in * dv * mean;
            work += in * m->gained[q] * mean;
            if (q < 2) err += fabs(dv - m->gained[q]);
        }
        l->kinetic_change += change, l->impulse_work += work;
        l->impulse_size += mass * m->shoved * 0.5 * (fw_length(m->v0[0], m->v0[1]) + fw_length(m->v1[0], m->v1[1]));
        l->momentum_error += mass * err, l->momentum_size += mass * m->shoved;
    }
}

void fw_books_wear(const fw_cluster *c, const fw_books *books)
{
    const fw_method *me = books->setup->method;
    if (!books->wear->is_open) return;
    for (size_t k = 0; k < c->n_pairs; k++) {
        const fw_pair *p = &c->pairs[k];
        if (p->b != FW_WALL) continue;
        const fw_member *a = &c->members[p->a];
        const fw_body   *body = &books->world->bodies[a->index];
        size_t           last = me->n_stages - 1;
        if (!(p->normal[0] > 0) && !(p->normal[last] > 0)) continue;
        fw_wear_interval iv = {.length = c->t1 - c->t0, .since_touch = p->since_touch};
        iv.impact_left = body->t_hit + 2 / p->law.omega - c->t0;
        iv.depth[0] = p->since_touch > 0 ? p->depth[0] : 0; /* landed on the touch to rounding */
        iv.depth[1] = p->depth[last];
        iv.rate[0] = p->rate[0], iv.rate[1] = p->rate[last];
        iv.angle[0] = fw_ring_angle(a->x0, a->y0), iv.angle[1] = fw_ring_angle(a->x1, a->y1);
        iv.n_stages = me->n_stages;
        for (size_t s = 0; s < me->n_stages; s++)
            iv.at[s] = me->c[s], iv.normal[s] = fw_pair_signed_normal(p, s), iv.slip[s] = p->slip[s];
        /* A step that goes on long after the floe let go: between its stages the force's polynomial would bulge. */
        if (iv.normal[0] > 0 && iv.normal[last] < -iv.normal[0]) {
            double fades = fw_cluster_fades_in(c, p), force = iv.normal[0];
            if (fades < iv.length)
                for (size_t s = 0; s <= last; s++) iv.normal[s] = force * (1 - me->c[s] * iv.length / fades);
        }
        iv.radius = a->radius, iv.thickness = body->thickness;
        fw_wear_collect(books->wear, &iv);
    }
}
