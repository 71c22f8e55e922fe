/* One implicit stage: V = vr + h gamma A(xr + h gamma V, V) for all floes of a cluster at once.
 *
 * The geometry (normals, overlaps) is taken once at the predicted position; along the normal the overlap follows the
 * unknown velocity linearly. What is left is piecewise linear (no tension, Coulomb cap) and is solved contact by contact,
 * each exactly, in sweeps until nothing moves: one contact needs one sweep, a raft a handful. Impulses act on velocities
 * at once, so momentum is exact at every sweep. */
#include <math.h>

#include "kernel/cluster.h"
#include "kernel/crush.h"
#include "kernel/forces.h"

enum { MAX_SWEEPS = 400 };

/* Normal and overlap of two discs whose centres are (dx, dy) apart. */
static inline void geometry(double dx, double dy, double reach, double *nx, double *ny, double *depth)
{
    double r2 = dx * dx + dy * dy, r = sqrt(r2), sum = reach + r, both = 1 / (r * sum), inv = sum * both; /* one division for two */
    *depth = (reach * reach - r2) * (r * both); /* reach - r without cancellation */
    if (!(r > 0)) dx = -1, dy = 0, inv = 1, *depth = reach; /* one centre on the other: any direction will do */
    *nx = dx * inv, *ny = dy * inv;
}

/* Closing rate and slip of a pair for velocities va and vb, (x, y, spin). */
static inline double closing(const fw_pair *p, const double *va, const double *vb)
{
    return -(p->nx * (va[0] - vb[0]) + p->ny * (va[1] - vb[1]));
}
static inline double slipping(const fw_pair *p, const double *va, const double *vb)
{
    /* t = (-ny, nx) */
    return p->nx * (va[1] - vb[1]) - p->ny * (va[0] - vb[0]) - (p->ma->radius * va[2] + p->mb->radius * vb[2]);
}

/* Add impulse (push along n, rub along t) to member a and take it from b. */
static inline void shove(const fw_pair *p, double push, double rub)
{
    fw_member *a = p->ma, *b = p->mb;
    double     jx = push * p->nx - rub * p->ny, jy = push * p->ny + rub * p->nx;
    a->V[0] += jx * a->inv_mass, a->V[1] += jy * a->inv_mass, a->V[2] -= rub * a->turn;
    b->V[0] -= jx * b->inv_mass, b->V[1] -= jy * b->inv_mass, b->V[2] -= rub * b->turn;
}

/* Members may have moved in memory since the last time. */
static void point_to_members(fw_cluster *c, const fw_setup *set)
{
    c->wall.radius = set->structure_radius;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        p->ma = &c->members[p->a];
        p->mb = p->b == FW_WALL ? &c->wall : &c->members[p->b];
    }
}

void fw_stage_start(fw_cluster *c, const fw_books *books)
{
    const fw_setup *set = books->setup;
    point_to_members(c, set);
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member    *m = &c->members[i];
        const double *v = m->y0 + FW_VX;
        m->ux = set->flow.ux, m->uy = set->flow.uy;
        double rate = m->drag_per_mass * fw_relative_speed(m, v[0], v[1]);
        m->drag[0][0] = rate * (m->ux - v[0]), m->drag[0][1] = rate * (m->uy - v[1]);
        for (int q = 0; q < 4; q++) m->k[0][q] = v[q];
        m->k[0][FW_VX] = m->drag[0][0], m->k[0][FW_VY] = m->drag[0][1], m->k[0][FW_SPIN] = 0;
    }
    if (fw_has_body_forces(set)) fw_forces_start(c, set);
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair      *p = &c->pairs[k];
        fw_member    *a = p->ma, *b = p->mb;
        const double *va = a->y0 + FW_VX, *vb = b->y0 + FW_VX;
        geometry(a->y0[FW_X] - b->y0[FW_X], a->y0[FW_Y] - b->y0[FW_Y], a->radius + b->radius, &p->nx, &p->ny,
                 &p->depth[0]);
        p->rate[0] = closing(p, va, vb), p->slip[0] = slipping(p, va, vb);
        p->dir[0][0] = p->nx, p->dir[0][1] = p->ny;
        if (fw_rim_of(p)) {
            fw_crush_start(p);
            continue;
        }
        p->normal[0] = fw_contact_normal(&p->law, p->depth[0], p->rate[0]);
        p->friction[0] = fw_contact_friction(&p->law, p->normal[0], p->slip[0]);
        double fx = p->normal[0] * p->nx - p->friction[0] * p->ny, fy = p->normal[0] * p->ny + p->friction[0] * p->nx;
        a->k[0][FW_VX] += fx * a->own_inv_mass, a->k[0][FW_VY] += fy * a->own_inv_mass;
        b->k[0][FW_VX] -= fx * b->own_inv_mass, b->k[0][FW_VY] -= fy * b->own_inv_mass;
        a->k[0][FW_SPIN] -= p->friction[0] * a->turn, b->k[0][FW_SPIN] -= p->friction[0] * b->turn;
    }
    books->world->ledger.force_evaluations += (double)c->n_pairs;
}

static inline __attribute__((always_inline)) void predict_stage(fw_cluster *c, const fw_setup *set, size_t s, double h)
{
    const fw_method *me = set->method;
    double           hg = h * me->gamma, ahead = (me->c[s] - me->c[s - 1]) * h, ha[FW_MAX_STAGES];
    for (size_t j = 0; j < s; j++) ha[j] = h * me->a[s][j];
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     r[8];
        for (int q = 0; q < 8; q++) r[q] = m->y0[q];
        for (size_t j = 0; j < s; j++)
            for (int q = 0; q < 8; q++) r[q] += ha[j] * m->k[j][q];
        for (int q = 0; q < 8; q++) m->r[q] = r[q];
        for (int q = 0; q < 4; q++) m->U[q] = m->k[s - 1][q] + ahead * m->k[s - 1][4 + q];
        m->X = r[FW_X] + hg * m->U[0], m->Y = r[FW_Y] + hg * m->U[1];
        fw_free_velocity(set, m, hg, fw_relative_speed(m, m->U[0], m->U[1]), false);
        m->V[2] = r[FW_SPIN];
    }
}

/* Loops of two and three that are known beforehand. */
static void predict(fw_cluster *c, const fw_setup *set, size_t s, double h)
{
    switch (s) {
    case 1: predict_stage(c, set, 1, h); break;
    case 2: predict_stage(c, set, 2, h); break;
    case 3: predict_stage(c, set, 3, h); break;
    default: predict_stage(c, set, s, h);
    }
}

/* What a sweep would divide by, each time and in its chain of dependences. */
static inline void prepare(fw_pair *p, double hg)
{
    double n = 1 + p->beta * hg * p->w_normal, t = 1 + p->law.ct * hg * p->w_slip,
           inv = hg / (n * t); /* one division */
    p->to_push = t * inv;
    p->to_rub = -p->law.ct * n * inv;
}

static inline __attribute__((always_inline)) void linearise(fw_cluster *c, size_t s, double hg)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair   *p = &c->pairs[k];
        fw_member *a = p->ma, *b = p->mb;
        geometry(a->X - b->X, a->Y - b->Y, a->radius + b->radius, &p->nx, &p->ny, &p->depth_star);
        p->rate_star = closing(p, a->U, b->U);
        p->alpha = p->law.k * (p->depth_star - hg * p->rate_star);
        p->beta = p->law.c + p->law.k * hg;
        double is_on = (p->depth_star < 0) & !(p->normal[0] > 0) ? 0 : 1; /* 0: parted, and not touched again yet */
        p->alpha *= is_on, p->beta *= is_on;
        p->w_normal = a->inv_mass + b->inv_mass;
        p->w_slip = p->w_normal + a->radius * a->turn + b->radius * b->turn;
        prepare(p, hg);
        /* Start from the force of the stage before (a polynomial through all of them saves no sweep). */
        p->push = hg * p->normal[s - 1], p->rub = hg * p->friction[s - 1];
        shove(p, p->push, p->rub);
    }
}

/* One contact solved as if there were no other; returns the change of its velocities. */
static inline double solve_contact(fw_pair *p)
{
    double free = closing(p, p->ma->V, p->mb->V) + p->push * p->w_normal;
    double slip = slipping(p, p->ma->V, p->mb->V) - p->rub * p->w_slip;
    double push = fw_larger(0, (p->alpha + p->beta * free) * p->to_push), cap = p->mu * push;
    double rub = fw_larger(-cap, fw_smaller(cap, slip * p->to_rub)); /* no branches: which side binds changes from pair to pair */
    double dp = push - p->push, dr = rub - p->rub;
    shove(p, dp, dr);
    p->push = push, p->rub = rub;
    return fw_larger(fabs(dp) * p->w_normal, fabs(dr) * p->w_slip);
}

/* Returns the largest change of a velocity. */
static inline __attribute__((always_inline)) double sweep(fw_cluster *c)
{
    double largest = 0;
    for (size_t k = 0; k < c->n_pairs; k++) largest = fw_larger(largest, solve_contact(&c->pairs[k]));
    return largest;
}

/* The same where ice crushes on the structure: a loop of its own, so that springs alone ask nothing. */
static __attribute__((noinline)) double sweep_crushing(fw_cluster *c, size_t s)
{
    double largest = 0;
    for (size_t k = 0; k < c->n_pairs; k++)
        largest = fw_larger(largest, fw_rim_of(&c->pairs[k]) ? fw_crush_solve(&c->pairs[k], s) : solve_contact(&c->pairs[k]));
    return largest;
}

/* What the sweeps leave goes to contacts between floes, none to those with the structure: the slip of a floe that rolls is a few mm/s, wear goes with
 * its size, and what is left in it adds up whatever its sign (+1.0 % of depth in 1000 windows at 30 % ice, 0.5 m/s, accuracy 1 %; so 0.0 %). */
static inline __attribute__((always_inline)) void settle_structure(fw_cluster *c)
{
    for (size_t k = 0; k < c->n_pairs; k++)
        if (c->pairs[k].b == FW_WALL) solve_contact(&c->pairs[k]);
}

/* Drag follows the solved velocity; impulses stay. Returns the largest change of a velocity that was worth it. */
static inline __attribute__((always_inline)) double renew_drag_in(fw_cluster *c, const fw_setup *set, double hg, double enough, bool is_blown)
{
    double largest = 0;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     rx = m->ux - m->V[0], ry = m->uy - m->V[1], r2 = rx * rx + ry * ry, was = m->drag_speed;
        /* what the new drag would change, to first order: most floes need no renewal. |r^2 - s^2| / 2 = |r - s| r or so. */
        double change = 0.5 * hg * m->drag_per_mass * fabs(r2 - was * was) * m->ease;
        if (!(change > enough)) continue;
        double x, y;
        fw_known_part(set, m, hg, is_blown, &x, &y);
        double jx = m->V[0] * m->resistance - x, jy = m->V[1] * m->resistance - y; /* what the impulses gave */
        fw_free_velocity(set, m, hg, sqrt(r2), is_blown);
        m->V[0] += jx * m->ease, m->V[1] += jy * m->ease;
        largest = fw_larger(largest, change);
    }
    if (largest > 0)
        for (size_t k = 0; k < c->n_pairs; k++) {
            fw_pair *p = &c->pairs[k];
            double   was = p->w_normal;
            p->w_normal = p->ma->inv_mass + p->mb->inv_mass;
            p->w_slip += p->w_normal - was;
            prepare(p, hg);
        }
    return largest;
}

/* is_plain: no water or wind but the current's drag, and springs alone; that is asked once. */
static inline __attribute__((always_inline)) bool solve_stage(fw_cluster *c, const fw_books *books, size_t s, double h, bool is_plain)
{
    const fw_setup *set = books->setup;
    double          hg = h * set->method->gamma, inv = 1 / hg;
    bool            is_lone = c->n_pairs == 1, is_crush = !is_plain && fw_is_crush(set), has_forces = !is_plain && fw_has_body_forces(set);
    /* A lone contact is solved by one sweep, so it may as well be solved well: what it leaves, error control pays for. */
    double          enough = (is_lone ? 0.02 : 1) * set->solver_share * set->tolerance * set->velocity_scale;
    if (s == 1) point_to_members(c, set);
    predict(c, set, s, h);
    if (has_forces) fw_forces_predict(c, set, hg);
    linearise(c, s, hg);
    if (is_crush) fw_crush_linearise(c, s, hg);
    books->world->ledger.force_evaluations += (double)c->n_pairs;
    bool is_solved = false;
    for (int n = 0; n < MAX_SWEEPS && !is_solved; n++) {
        double change = is_crush ? sweep_crushing(c, s) : sweep(c);
        if (!is_lone && !(change < enough) && n % 4 != 3) continue;
        double drag = !set->has_drag ? 0 : !is_plain && fw_has_wind(set) ? renew_drag_in(c, set, hg, enough, true) : renew_drag_in(c, set, hg, enough, false);
        is_solved = !(drag > 0) && (change < enough || is_lone);
    }
    if (is_crush)
        fw_crush_end(c, s, inv, !is_lone);
    else if (!is_lone)
        settle_structure(c);
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        for (int q = 0; q < 4; q++) m->k[s][q] = m->V[q], m->k[s][4 + q] = (m->V[q] - m->r[4 + q]) * inv;
        m->drag[s][0] = m->drag_rate * (m->ux - m->V[0]), m->drag[s][1] = m->drag_rate * (m->uy - m->V[1]);
    }
    if (has_forces) fw_forces_end(c, set, s);
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        p->normal[s] = p->push * inv;
        p->friction[s] = p->rub * inv;
        p->rate[s] = closing(p, p->ma->V, p->mb->V);
        p->slip[s] = slipping(p, p->ma->V, p->mb->V);
        p->depth[s] = p->depth_star + hg * (p->rate[s] - p->rate_star);
        p->dir[s][0] = p->nx, p->dir[s][1] = p->ny;
    }
    return is_solved;
}

static __attribute__((noinline)) bool solve_more(fw_cluster *c, const fw_books *books, size_t s, double h) { return solve_stage(c, books, s, h, false); }

bool fw_stage_solve(fw_cluster *c, const fw_books *books, size_t s, double h)
{
    const fw_setup *set = books->setup;
    return fw_has_body_forces(set) || fw_is_crush(set) ? solve_more(c, books, s, h) : solve_stage(c, books, s, h, true);
}
