/* What a committed step of a lone floe leaves behind: energy, momentum, counts, and wear on the ring. The step is cut into pieces in which
 * polynomials follow its closed forms; energy is entered by their own quadrature, drag taken afresh, so that the balance checks the motion. */
#include <float.h>
#include <math.h>

#include "geometry/ring.h"
#include "kernel/lone_forms.h"

enum { PIECE = 4, MAX_CUTS = 40 };

/* Lobatto's rule: exact to the fifth power, as Boole's with a point more, and both ends of a piece are known anyway. */
static const double AT[PIECE] = {0, 0.27639320225002103, 0.72360679774997897, 1};
static const double WEIGHT[PIECE] = {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};

/* Pieces are short at first and grow with the time since the touch. In 1/w: */
static const double FIRST_PIECE = 0.28, LONGEST_FRESH = 4;
static const double PIECE_GROWTH = 0.6; /* numbers, too: */
static const double SLIDING = 2;        /* longer by this where no slip decays */
static const double FRESH =
    0.3; /* decaying part of depth or slip over the rest: below, one piece follows it to the end */

/* Instants between which the step is smooth enough for polynomials through four points. One of them is the end of the hit, so that what
 * counts as impact ends there. */
static int cut_up(const fw_lone *L, const fw_pair *p, size_t last, double wear_tolerance, double impact_left,
                  double *cut)
{
    double h = L->length, omega = fw_larger(p->law.omega, L->half_damping + sqrt(fw_larger(0, L->split))),
           finer = sqrt(sqrt(wear_tolerance / 2e-4)), fresh = 0, piece = FIRST_PIECE / omega * finer;
    if (L->slides != 0 || !L->rubs) piece *= SLIDING;
    /* viscous slip dies away at 6 ct / c w: 6 w where both dashpots are alike */
    if (L->rubs && L->slides == 0) piece = fw_smaller(piece, FIRST_PIECE * 6 * L->per_relaxation * finer);
    if (L->presses) {
        fresh = fw_smaller(h, LONGEST_FRESH / omega);
        if (!L->is_short) { /* how much of the state is still decaying */
            double d = fabs(L->from.depth - L->swing[0]) + fabs(L->from.rate - L->swing[1] / L->span) / omega, s = 0;
            if (L->rubs && L->slides == 0 && !L->is_short_slip)
                s = fabs(L->from.slip - L->creep[0]) / (fabs(L->creep[0]) + DBL_MIN);
            double alive = fw_larger(d / (fabs(L->swing[0]) + DBL_MIN), s) / (FRESH * finer * finer);
            fresh = alive > 1 ? fw_smaller(fresh, log(alive) / omega + piece) : 0;
        }
    }
    int n = 0;
    cut[0] = 0;
    while (cut[n] < h) {
        double end = cut[n] < impact_left && impact_left < h ? impact_left : h;
        double t = cut[n] + piece + PIECE_GROWTH * (cut[n] + fw_smaller(p->since_touch, 3 / omega));
        bool   is_last = !(cut[n] < fresh) || t + 0.4 * piece > end || n + 3 >= MAX_CUTS;
        cut[n + 1] = is_last ? end : t;
        n++;
    }
    /* A force that grows from nothing and fades to nothing is none at either end of one piece, and would be no wear. */
    bool is_hump = L->presses && !(p->normal[0] > 0) && !(p->normal[last] > 0);
    if (n == 1 && is_hump) cut[1] = 0.5 * h, cut[2] = h, n = 2;
    return n;
}

void fw_lone_keep(fw_cluster *c, const fw_books *b)
{
    const fw_setup     *set = b->setup;
    const fw_lone      *L = &c->lone;
    fw_member          *m = &c->members[0];
    fw_pair            *p = &c->pairs[0];
    fw_body            *body = &b->world->bodies[m->index];
    fw_ledger          *l = &b->world->ledger;
    double              h = L->length, mass = m->mass, omega = p->law.omega, cut[MAX_CUTS];
    double              drag_work = 0, dashpot = 0, friction = 0, jx = 0, jy = 0, load = 0, deepest = 0;
    double              impact_left = body->t_hit + 2 / omega - c->t0;
    int                 n = cut_up(L, p, set->method->n_stages - 1, set->wear_tolerance, impact_left, cut);
    bool                wears = L->presses && b->wear->is_open;
    bool                goes_on = p->wear_until == c->t0 && p->since_touch > 0;
    double              angle = !wears ? 0 : goes_on ? p->wear_angle : fw_ring_angle(m->y0[FW_X], m->y0[FW_Y]);
    double              kept_up = m->inertia > 0 ? 0 : m->radius * m->y0[FW_SPIN]; /* rim of a locked floe: what keeps it up works against friction */
    fw_wear_interval    iv = {.radius = m->radius, .thickness = body->thickness, .n_stages = PIECE};
    fw_lone_state       y[PIECE];
    decay               w = {1, 0, 1};
    y[PIECE - 1] = L->from;
    for (int j = 0; j < PIECE; j++) iv.at[j] = AT[j];
    for (int k = 0; k < n; k++) {
        double from = cut[k], dt = cut[k + 1] - from;
        decay  outer = decay_at(L, AT[1] * dt), inner = decay_at(L, (AT[2] - AT[1]) * dt);
        y[0] = y[PIECE - 1];
        for (int j = 1; j < PIECE; j++)
            w = later(L, w, j == 2 ? inner : outer), state_at(L, &p->law, from + AT[j] * dt, w, &y[j]);
        for (int j = 0; j < PIECE; j++) {
            double weight = WEIGHT[j] * dt;
            if (j > 0) deepest = fw_larger(deepest, fw_books_deepest(y[j - 1].depth, y[j - 1].rate, y[j].depth, y[j].rate, (AT[j] - AT[j - 1]) * dt));
            if (m->drag_per_mass + m->air_per_mass > 0) {
                double nx, ny, out, along;
                normal_at(L, y[j].turn, &nx, &ny);
                drag_at(set, m, nx, ny, &y[j], &out, &along);
                drag_work += weight * (along * y[j].along - out * y[j].rate);
                jx += weight * (out * nx - along * ny), jy += weight * (out * ny + along * nx);
                if (L->has_twist) /* I w w' over the mass */
                    drag_work += weight * m->inertia * m->own_inv_mass / (m->radius * m->radius) * (y[j].along - y[j].slip) * spin_drag_at(set, m, nx, ny, &y[j]);
            }
            if (!L->presses) continue;
            double normal = fw_larger(0, y[j].normal);
            double rub = !L->rubs ? 0 : L->slides != 0 ? -L->slides * p->mu * normal : -p->law.ct * y[j].slip;
            dashpot += weight * p->law.c * y[j].rate * y[j].rate, friction -= weight * rub * y[j].slip;
            drag_work += weight * rub * kept_up * m->own_inv_mass;
            l->peak_force = fw_larger(l->peak_force, normal);
            if (y[j].depth > 0) load += weight * normal * fabs(y[j].slip) / sqrt(y[j].depth);
            iv.normal[j] = y[j].normal, iv.slip[j] = y[j].slip, iv.overlap[j] = y[j].depth;
        }
        if (!wears) continue;
        iv.length = dt, iv.since_touch = p->since_touch + from;
        iv.impact_left = impact_left - from;
        iv.depth[0] = iv.since_touch > 0 ? y[0].depth : 0, iv.depth[1] = y[PIECE - 1].depth;
        iv.has_overlap = true, iv.overlap[0] = iv.depth[0];
        iv.rate[0] = y[0].rate, iv.rate[1] = y[PIECE - 1].rate;
        iv.angle[0] = angle - y[0].turn, iv.angle[1] = angle - y[PIECE - 1].turn;
        fw_wear_collect(b->wear, &iv);
    }
    const fw_lone_state *e = &y[PIECE - 1];
    if (wears) p->wear_until = c->t1, p->wear_angle = angle - e->turn;
    p->load_tried = load;
    l->drag_size += fabs(mass * drag_work);
    l->drag_work += mass * drag_work, l->dashpot += dashpot, l->friction += friction;
    double d_start = fw_larger(0, L->from.depth), d_end = fw_larger(0, e->depth);
    double stored = 0.5 * p->law.k * (d_end * d_end - d_start * d_start);
    l->into_springs += fw_larger(0, stored), l->contact_steps++;
    c->dissipated += dashpot + friction + (L->presses ? 0 : -stored);
    if (L->presses) {
        l->normal_impulse += mass * (L->span * integral(L->by.push, h / L->span) - (e->rate - L->from.rate));
        l->contact_time += h;
    } else {
        l->dropped -= stored;
    }
    if (fw_books_overlap(l, fw_smaller(m->radius, set->structure_radius), deepest)) l->overlap_time += h;
    /* The contact's impulse along a turning normal has no closed form: it is what drag leaves of the change of momentum. So the two books of
     * impulses agree by construction here; the balance of work (dashpot, friction, drag, each by its own quadrature) is what checks. */
    double in[3] = {mass, mass, m->inertia}, work = 0;
    for (int q = 0; q < 3; q++) {
        double v0 = m->y0[FW_VX + q], v1 = m->y1[FW_VX + q];
        work += 0.5 * in[q] * (v1 - v0) * (v1 + v0);
    }
    double size = fw_length(jx, jy) + fw_length(m->y1[FW_VX] - m->y0[FW_VX] - jx, m->y1[FW_VY] - m->y0[FW_VY] - jy);
    l->kinetic_change += work, l->impulse_work += work;
    l->impulse_size += mass * size * 0.5 *
                       (fw_length(m->y0[FW_VX], m->y0[FW_VY]) + fw_length(m->y1[FW_VX], m->y1[FW_VY])) +
                       in[2] * fabs(m->y1[FW_SPIN] - m->y0[FW_SPIN]) * 0.5 * (fabs(m->y0[FW_SPIN]) + fabs(m->y1[FW_SPIN]));
    l->momentum_size += mass * size;
}
