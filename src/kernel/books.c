/* What a step leaves behind: energy, momentum, counts, and wear on the ring.
 *
 * Energy is entered where the force acts, by the method's own quadrature; what the checks compare is reached on another
 * way (change of kinetic energy, stored energy at the ends). A step is weighed when it is tried, for its watch-dogs (watch.c), and entered
 * when it is committed. */
#include "geometry/ring.h"
#include "kernel/cluster.h"
#include "kernel/crush.h"
#include "kernel/forces.h"

bool fw_books_overlap(fw_ledger *l, double small, double depth)
{
    l->max_overlap = fw_larger(l->max_overlap, depth);
    l->max_overlap_share = fw_larger(l->max_overlap_share, depth / small);
    return depth > 0.1 * small;
}

static const double ROUNDING = 1e-9; /* of the cap of friction, which is solved for exactly */
static const double QUASI_STATIC = 3; /* step in 1/w */

double fw_books_deepest(double depth0, double rate0, double depth1, double rate1, double h)
{
    double ends = fw_larger(depth0, depth1);
    if (!(rate0 > 0) || !(rate1 < 0)) return ends;
    double s0 = rate0 * h, s1 = rate1 * h, D = depth1 - depth0, c2 = 3 * D - 2 * s0 - s1, c3 = s0 + s1 - 2 * D;
    /* the root of s0 + 2 c2 u + 3 c3 u^2 in (0, 1), without cancellation */
    double q = sqrt(fw_larger(0, c2 * c2 - 3 * c3 * s0)), u = s0 / (q - c2);
    return u > 0 && u < 1 ? fw_larger(ends, depth0 + u * (s0 + u * (c2 + u * c3))) : ends;
}

static void shove(fw_member *m, double jx, double jy, double rub)
{
    m->gained[0] += jx * m->own_inv_mass, m->gained[1] += jy * m->own_inv_mass;
    m->gained[2] -= rub * m->turn;
    m->shoved += fw_length(jx, jy) * m->own_inv_mass, m->twisted += fabs(rub * m->turn);
}

static inline __attribute__((always_inline)) void weigh_pair(fw_cluster *c, const fw_method *me, fw_pair *p, double h, fw_step_books *to)
{
    fw_member *a = &c->members[p->a], *b = p->b == FW_WALL ? NULL : &c->members[p->b];
    size_t     last = me->n_stages - 1;
    double     jx = 0, jy = 0, rub = 0, push = 0, dashpot = 0, dropped = 0, friction = 0, beyond = 0;
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
        beyond = fw_larger(beyond, fw_larger(-n, fabs(f) - p->law.mu * n * (1 + ROUNDING)));
        if (p->b == FW_WALL) to->peak_force = fw_larger(to->peak_force, n);
    }
    p->is_lawful = beyond <= 0;
    double d0 = fw_larger(0, p->depth[0]), d1 = fw_larger(0, p->depth[last]), stored = 0.5 * p->law.k * (d1 * d1 - d0 * d0);
    /* A step much longer than 1/w follows a contact that is pressed quasi-statically. Its dashpot takes next to nothing, and the closing rates of
     * single stages are what tolerance leaves of 0: squared, with weights of both signs, they made 43 % of a balance. The mean rate is right. */
    bool is_pressed = p->normal[0] > 0 && p->normal[last] > 0 && push > 0 && dropped == 0;
    if (h * p->law.omega > QUASI_STATIC && is_pressed) dashpot = p->law.c * (d1 - d0) * (d1 - d0) / h;
    /* No force at all: what the spring loses is dropped, exactly, also where the rims part inside the step. */
    if (!(push > 0)) dashpot = 0, dropped = -stored;
    to->dashpot += dashpot, to->dropped += dropped, to->friction += friction;
    to->stored += stored, to->into_springs += fw_larger(0, stored);
    shove(a, jx, jy, rub);
    to->drag_work += fw_member_held(a, rub) + (b ? fw_member_held(b, rub) : 0);
    if (b) {
        shove(b, -jx, -jy, rub);
        return;
    }
    double from = fw_pair_signed_normal(p, 0), until = fw_pair_signed_normal(p, last);
    to->normal_impulse += push;
    to->contact_time += from > 0 && until > 0 ? h
                        : from > 0            ? h * from / (from - until)
                        : until > 0           ? h * until / (until - from)
                                              : 0;
}

/* Where some contacts crush: a loop of its own, so that springs alone ask nothing. */
static __attribute__((noinline)) void weigh_crushing(fw_cluster *c, const fw_method *me, double h, fw_step_books *to)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        if (fw_rim_of(&c->pairs[k]))
            fw_crush_weigh(c, me, &c->pairs[k], h, to);
        else
            weigh_pair(c, me, &c->pairs[k], h, to);
    }
}

/* A floe in no contact is entered as one that flies by the closed form: the drag's work is the change of its kinetic energy. By quadrature, what long
 * steps leave of it was 11 % of what a few gentle contacts exchanged, against which it is measured; and water and air that hold each other's balance
 * are impulses of nothing, with rounding 38 times as large. */
static void weigh_flight(const fw_cluster *c, fw_step_books *to)
{
    for (size_t i = 0; i < c->n_members; i++) {
        const fw_member *m = &c->members[i];
        for (int q = FW_VX; q <= FW_SPIN; q++) to->drag_work += 0.5 * (q < FW_SPIN ? m->mass : m->inertia) * (m->y1[q] - m->y0[q]) * (m->y1[q] + m->y0[q]);
    }
}

void fw_books_weigh(fw_cluster *c, const fw_setup *set, double h)
{
    const fw_method *me = set->method;
    fw_step_books   *to = &c->tried;
    *to = (fw_step_books){0};
    if (c->n_pairs == 0) {
        weigh_flight(c, to);
        c->is_weighed = true;
        return;
    }
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     j[2] = {0, 0}, work = 0;
        for (size_t s = 0; s < me->n_stages; s++) {
            double hb = h * me->b[s];
            j[0] += hb * m->drag[s][0], j[1] += hb * m->drag[s][1];
            work += hb * (m->drag[s][0] * m->k[s][0] + m->drag[s][1] * m->k[s][1]);
        }
        to->drag_work += work * m->mass;
        m->gained[0] = j[0], m->gained[1] = j[1], m->gained[2] = 0;
        m->shoved = fw_length(j[0], j[1]), m->twisted = 0;
    }
    if (fw_has_spin_drag(set)) fw_forces_weigh(c, set, h);
    c->is_weighed = true;
    if (fw_is_crush(set))
        weigh_crushing(c, me, h, to);
    else
        for (size_t k = 0; k < c->n_pairs; k++) weigh_pair(c, me, &c->pairs[k], h, to);
    for (size_t i = 0; i < c->n_members; i++) {
        const fw_member *m = &c->members[i];
        double           mass = m->mass, err = 0;
        for (int q = 0; q < 3; q++) {
            double in = q < 2 ? mass : m->inertia, from = m->y0[FW_VX + q], until = m->y1[FW_VX + q], dv = until - from,
                   mean = 0.5 * (until + from);
            to->kinetic_change += in * dv * mean;
            to->impulse_work += in * m->gained[q] * mean;
            if (q < 2) err += fabs(dv - m->gained[q]);
        }
        to->impulse_size += mass * m->shoved * 0.5 *
                            (fw_length(m->y0[FW_VX], m->y0[FW_VY]) + fw_length(m->y1[FW_VX], m->y1[FW_VY])) +
                            m->inertia * m->twisted * 0.5 * (fabs(m->y0[FW_SPIN]) + fabs(m->y1[FW_SPIN]));
        to->momentum_error += mass * err, to->momentum_size += mass * m->shoved;
    }
}

void fw_books_keep(fw_cluster *c, const fw_books *books)
{
    const fw_step_books *s = &c->tried;
    fw_ledger           *l = &books->world->ledger;
    size_t               last = books->setup->method->n_stages - 1;
    double               h = c->t1 - c->t0;
    bool                 is_beyond = false;
    if (!c->is_weighed) fw_books_weigh(c, books->setup, h);
    c->is_weighed = false;
    l->kinetic_change += s->kinetic_change, l->impulse_work += s->impulse_work, l->impulse_size += s->impulse_size;
    l->drag_size += c->n_pairs ? fabs(s->drag_work) : 0;
    l->drag_work += s->drag_work, l->dashpot += s->dashpot, l->friction += s->friction, l->dropped += s->dropped;
    l->crushed += s->crushed, l->rolling += s->rolling, l->turned += s->turned;
    l->into_springs += s->into_springs;
    l->momentum_error += s->momentum_error, l->momentum_size += s->momentum_size;
    l->normal_impulse += s->normal_impulse, l->contact_time += s->contact_time;
    l->peak_force = fw_larger(l->peak_force, s->peak_force);
    for (size_t k = 0; k < c->n_pairs; k++) {
        const fw_pair *p = &c->pairs[k];
        double         other = p->b == FW_WALL ? books->setup->structure_radius : c->members[p->b].radius;
        double         deepest = fw_books_deepest(p->depth[0], p->rate[0], p->depth[last], p->rate[last], h);
        is_beyond |= fw_books_overlap(l, fw_smaller(c->members[p->a].radius, other), deepest) && !fw_rim_of(p);
    }
    if (is_beyond) l->overlap_time += h;
    c->dissipated += s->dashpot + s->friction + s->dropped + (s->crushed + s->rolling);
}

/* The floe lets go within the step. Stages beyond the release are no force that ever was, and a polynomial through them bulges (up to
 * a tenth of a hit's depth); so the interval ends where the force is gone, and it falls straight until then. */
static void end_where_it_lets_go(fw_wear_interval *iv, double gone)
{
    double h = iv->length;
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
        if (!fw_rim_of(p) && !(p->normal[0] > 0) && !(p->normal[last] > 0)) continue;
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
        double gone = INFINITY;
        if (fw_rim_of(p))
            iv.is_crushed = true, gone = fw_crush_interval(p, me->n_stages, &iv);
        else if (iv.normal[0] > 0 && iv.normal[last] <= 0)
            gone = fw_cluster_lets_go(c, p, me);
        if (gone < INFINITY) end_where_it_lets_go(&iv, gone);
        iv.radius = a->radius, iv.thickness = body->thickness;
        fw_wear_collect(books->wear, &iv);
    }
}
