/* What a committed step leaves behind: energy, momentum, counts, and wear on the ring.
 *
 * Energy is entered where the force acts, by the method's own quadrature; what the checks compare is reached on another
 * way (change of kinetic energy, stored energy at the ends). */
#include "geometry/ring.h"
#include "kernel/cluster.h"

bool fw_books_overlap(fw_ledger *l, double small, double depth)
{
    l->max_overlap = fw_larger(l->max_overlap, depth);
    l->max_overlap_share = fw_larger(l->max_overlap_share, depth / small);
    return depth > 0.1 * small;
}

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
    if (fw_books_overlap(l, fw_smaller(a->radius, b ? b->radius : books->setup->structure_radius), p->depth[last])) *is_beyond = true;
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
            work += hb * (m->drag[s][0] * m->k[s][0] + m->drag[s][1] * m->k[s][1]);
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
            double in = q < 2 ? mass : inertia, from = m->y0[FW_VX + q], to = m->y1[FW_VX + q], dv = to - from,
                   mean = 0.5 * (to + from);
            change += in * dv * mean;
            work += in * m->gained[q] * mean;
            if (q < 2) err += fabs(dv - m->gained[q]);
        }
        l->kinetic_change += change, l->impulse_work += work;
        l->impulse_size += mass * m->shoved * 0.5 *
                           (fw_length(m->y0[FW_VX], m->y0[FW_VY]) + fw_length(m->y1[FW_VX], m->y1[FW_VY]));
        l->momentum_error += mass * err, l->momentum_size += mass * m->shoved;
    }
}

/* The floe lets go within the step. Stages beyond the release are no force that ever was, and a polynomial through them bulges (up to
 * a tenth of a hit's depth); so the interval ends where the force is gone, and it falls straight until then. */
static void end_where_it_lets_go(const fw_cluster *c, const fw_pair *p, const fw_method *me, fw_wear_interval *iv)
{
    double h = iv->length, gone = fw_cluster_lets_go(c, p, me);
    double u = gone / h, d1 = iv->depth[1] - iv->depth[0], r0 = -iv->rate[0], r1 = -iv->rate[1];
    double c2 = 3 * d1 + h * (2 * r0 + r1),
           c3 = -h * (r0 + r1) - 2 * d1; /* depth as a cubic, its slope is the closing rate */
    size_t s = 1;
    while (s + 1 < iv->n_stages && iv->at[s] < u) s++; /* any stage after the release tells where slip goes */
    double slip = iv->slip[0] + (iv->slip[s] - iv->slip[0]) * u / iv->at[s];
    double depth = iv->depth[0] + u * (-h * r0 + u * (c2 + u * c3)), rate = -r0 + u * (2 * c2 + 3 * u * c3) / h;
    iv->length = gone, iv->n_stages = 2;
    iv->at[1] = 1, iv->normal[1] = 0, iv->slip[1] = slip;
    iv->depth[1] = depth, iv->rate[1] = rate, iv->angle[1] = iv->angle[0] + u * (iv->angle[1] - iv->angle[0]);
}

void fw_books_wear(const fw_cluster *c, const fw_books *books)
{
    const fw_method *me = books->setup->method;
    if (!books->wear->is_open) return;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
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
        /* the angle of the touch, and from there on one small turn after the other */
        double from = p->wear_until == c->t0 && p->since_touch > 0 ? p->wear_angle : fw_ring_angle(a->y0[FW_X], a->y0[FW_Y]);
        double to = from + fw_ring_turn(a->y0[FW_X], a->y0[FW_Y], a->y1[FW_X], a->y1[FW_Y]);
        iv.angle[0] = from, iv.angle[1] = to;
        p->wear_until = c->t1, p->wear_angle = to;
        iv.n_stages = me->n_stages;
        for (size_t s = 0; s < me->n_stages; s++)
            iv.at[s] = me->c[s], iv.normal[s] = fw_pair_signed_normal(p, s), iv.slip[s] = p->slip[s];
        if (iv.normal[0] > 0 && iv.normal[last] <= 0) end_where_it_lets_go(c, p, me, &iv);
        iv.radius = a->radius, iv.thickness = body->thickness;
        fw_wear_collect(books->wear, &iv);
    }
}
