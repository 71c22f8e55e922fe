/* One implicit stage: V = vr + h gamma A(xr + h gamma V, V) for all floes of a cluster at once.
 *
 * The geometry (normals, overlaps) is taken once at the predicted position; along the normal the overlap follows the
 * unknown velocity linearly. What is left is piecewise linear (no tension, Coulomb cap) and is solved contact by contact,
 * each exactly, in sweeps until nothing moves: one contact needs one sweep, a raft a handful. Impulses act on velocities
 * at once, so momentum is exact at every sweep. */
#include <math.h>

#include "kernel/cluster.h"

enum { MAX_SWEEPS = 400 };

static double relative_speed(const fw_setup *s, const double v[3])
{
    double rx = s->speed - v[0];
    return sqrt(rx * rx + v[1] * v[1]);
}

/* Normal and overlap of two discs whose centres are (dx, dy) apart. */
static inline void geometry(double dx, double dy, double reach, double *nx, double *ny, double *depth)
{
    double r2 = dx * dx + dy * dy, r = sqrt(r2), inv = r > 0 ? 1 / r : 0;
    *nx = r > 0 ? dx * inv : -1, *ny = dy * inv;
    *depth = (reach * reach - r2) / (reach + r); /* reach - r without cancellation */
}

/* Closing rate and slip of a pair for velocities va (member a) and vb (member b or NULL for the structure). */
static inline double closing(const fw_pair *p, const double *va, const double *vb)
{
    double ux = va[0], uy = va[1];
    if (vb) ux -= vb[0], uy -= vb[1];
    return -(p->nx * ux + p->ny * uy);
}
static inline double slipping(const fw_pair *p, const double *va, const double *vb, double ra, double rb)
{
    double ux = va[0], uy = va[1], turn = ra * va[2];
    if (vb) ux -= vb[0], uy -= vb[1], turn += rb * vb[2];
    return p->nx * uy - p->ny * ux - turn; /* t = (-ny, nx) */
}

/* Add impulse (push along n, rub along t) to member a and take it from b. */
static inline void shove(const fw_pair *p, fw_member *a, fw_member *b, double push, double rub)
{
    double jx = push * p->nx - rub * p->ny, jy = push * p->ny + rub * p->nx;
    a->V[0] += jx * a->inv_mass, a->V[1] += jy * a->inv_mass;
    a->V[2] -= rub * a->turn;
    if (!b) return;
    b->V[0] -= jx * b->inv_mass, b->V[1] -= jy * b->inv_mass;
    b->V[2] -= rub * b->turn;
}

static inline fw_member *partner(fw_cluster *c, const fw_pair *p) { return p->b == FW_WALL ? NULL : &c->members[p->b]; }

static void forces_now(fw_cluster *c, const fw_setup *set, fw_pair *p)
{
    const fw_member *a = &c->members[p->a], *b = partner(c, p);
    geometry(b ? a->x0 - b->x0 : a->x0, b ? a->y0 - b->y0 : a->y0, a->radius + (b ? b->radius : set->structure_radius),
             &p->nx, &p->ny, &p->depth[0]);
    p->rate[0] = closing(p, a->v0, b ? b->v0 : NULL);
    p->slip[0] = slipping(p, a->v0, b ? b->v0 : NULL, a->radius, b ? b->radius : 0);
    p->normal[0] = fw_contact_normal(&p->law, p->depth[0], p->rate[0]);
    p->friction[0] = fw_contact_friction(&p->law, p->normal[0], p->slip[0]);
    p->dir[0][0] = p->nx, p->dir[0][1] = p->ny;
}

void fw_stage_start(fw_cluster *c, const fw_books *books)
{
    const fw_setup *set = books->setup;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     k = m->drag_per_mass * relative_speed(set, m->v0);
        m->drag[0][0] = k * (set->speed - m->v0[0]), m->drag[0][1] = -k * m->v0[1];
        m->a[0][0] = m->drag[0][0], m->a[0][1] = m->drag[0][1], m->a[0][2] = 0;
        for (int q = 0; q < 3; q++) m->v[0][q] = m->v0[q];
    }
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        forces_now(c, set, p);
        fw_member *a = &c->members[p->a], *b = partner(c, p);
        double fx = p->normal[0] * p->nx - p->friction[0] * p->ny, fy = p->normal[0] * p->ny + p->friction[0] * p->nx;
        a->a[0][0] += fx * a->own_inv_mass, a->a[0][1] += fy * a->own_inv_mass, a->a[0][2] -= p->friction[0] * a->turn;
        if (b)
            b->a[0][0] -= fx * b->own_inv_mass, b->a[0][1] -= fy * b->own_inv_mass,
                b->a[0][2] -= p->friction[0] * b->turn;
    }
    books->world->ledger.force_evaluations += (double)c->n_pairs;
}

/* Velocity without contact impulses, drag implicit with a given |u - v|: V = (vr + hg K u) / (1 + hg K). */
static inline void free_velocity(const fw_setup *set, fw_member *m, double hg, double speed)
{
    m->drag_rate = m->drag_per_mass * speed;
    m->resistance = 1 + hg * m->drag_rate;
    double f = 1 / m->resistance;
    m->V[0] = (m->vr[0] + hg * m->drag_rate * set->speed) * f;
    m->V[1] = m->vr[1] * f;
    m->V[2] = m->vr[2];
    m->ease = f;
    m->inv_mass = m->own_inv_mass * f;
}

static void predict(fw_cluster *c, const fw_setup *set, size_t s, double h)
{
    const fw_method *me = set->method;
    double           hg = h * me->gamma, ahead = (me->c[s] - me->c[s - 1]) * h;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     x = m->x0, y = m->y0, v[3] = {m->v0[0], m->v0[1], m->v0[2]};
        for (size_t j = 0; j < s; j++) {
            double ha = h * me->a[s][j];
            x += ha * m->v[j][0], y += ha * m->v[j][1];
            for (int q = 0; q < 3; q++) v[q] += ha * m->a[j][q];
        }
        m->xr = x, m->yr = y;
        for (int q = 0; q < 3; q++) {
            m->vr[q] = v[q];
            m->U[q] = m->v[s - 1][q] + ahead * m->a[s - 1][q];
        }
        m->X = x + hg * m->U[0], m->Y = y + hg * m->U[1];
        free_velocity(set, m, hg, relative_speed(set, m->U));
    }
}

/* What a sweep would divide by, each time and in its chain of dependences. */
static inline void prepare(fw_pair *p, double hg)
{
    p->to_push = hg / (1 + p->beta * hg * p->w_normal);
    p->to_rub = -hg * p->law.ct / (1 + p->law.ct * hg * p->w_slip);
}

static void linearise(fw_cluster *c, const fw_setup *set, size_t s, double hg)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair   *p = &c->pairs[k];
        fw_member *a = &c->members[p->a], *b = partner(c, p);
        geometry(b ? a->X - b->X : a->X, b ? a->Y - b->Y : a->Y, a->radius + (b ? b->radius : set->structure_radius),
                 &p->nx, &p->ny, &p->depth_star);
        p->rate_star = closing(p, a->U, b ? b->U : NULL);
        p->alpha = p->law.k * (p->depth_star - hg * p->rate_star);
        p->beta = p->law.c + p->law.k * hg;
        p->w_normal = a->inv_mass + (b ? b->inv_mass : 0);
        p->w_slip = p->w_normal + a->radius * a->turn + (b ? b->radius * b->turn : 0);
        prepare(p, hg);
        /* Start from the force of the stage before. */
        p->push = hg * p->normal[s - 1], p->rub = hg * p->friction[s - 1];
        shove(p, a, b, p->push, p->rub);
    }
}

static inline double sweep_pair(fw_pair *p, fw_member *a, fw_member *b)
{
    double free = closing(p, a->V, b ? b->V : NULL) + p->push * p->w_normal;
    double push = (p->alpha + p->beta * free) * p->to_push;
    if (!(push > 0)) push = 0;
    double slip = slipping(p, a->V, b ? b->V : NULL, a->radius, b ? b->radius : 0) - p->rub * p->w_slip;
    double cap = p->mu * push, rub = slip * p->to_rub;
    rub = rub > cap ? cap : rub < -cap ? -cap : rub;
    double dp = push - p->push, dr = rub - p->rub;
    shove(p, a, b, dp, dr);
    p->push = push, p->rub = rub;
    return fw_larger(fabs(dp) * p->w_normal, fabs(dr) * p->w_slip);
}

/* One sweep; returns the largest change of a velocity. */
static double sweep(fw_cluster *c)
{
    double largest = 0;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        double   change = p->b == FW_WALL ? sweep_pair(p, &c->members[p->a], NULL)
                                          : sweep_pair(p, &c->members[p->a], &c->members[p->b]);
        largest = fw_larger(largest, change);
    }
    return largest;
}

/* Drag follows the solved velocity; impulses stay. Returns the largest change of a velocity. */
static double renew_drag(fw_cluster *c, const fw_setup *set, double hg, double enough)
{
    double largest = 0;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     speed = relative_speed(set, m->V);
        /* what the new drag would change, to first order: most floes need no renewal */
        double change = hg * fabs(m->drag_per_mass * speed - m->drag_rate) * speed * m->ease;
        if (!(change > enough)) continue;
        double jx = m->V[0] * m->resistance - (m->vr[0] + hg * m->drag_rate * set->speed),
               jy = m->V[1] * m->resistance - m->vr[1], spin = m->V[2];
        free_velocity(set, m, hg, speed);
        m->V[0] += jx * m->ease, m->V[1] += jy * m->ease, m->V[2] = spin;
        largest = fw_larger(largest, change);
    }
    if (largest > 0)
        for (size_t k = 0; k < c->n_pairs; k++) {
            fw_pair         *p = &c->pairs[k];
            const fw_member *a = &c->members[p->a], *b = partner(c, p);
            double           was = p->w_normal;
            p->w_normal = a->inv_mass + (b ? b->inv_mass : 0);
            p->w_slip += p->w_normal - was;
            prepare(p, hg);
        }
    return largest;
}

void fw_stage_solve(fw_cluster *c, const fw_books *books, size_t s, double h)
{
    const fw_setup *set = books->setup;
    double          hg = h * set->method->gamma, enough = set->solver_share * set->tolerance * set->velocity_scale;
    predict(c, set, s, h);
    linearise(c, set, s, hg);
    books->world->ledger.force_evaluations += (double)c->n_pairs;
    for (int n = 0; n < MAX_SWEEPS; n++) {
        double change = sweep(c);
        if (c->n_pairs > 1 && !(change < enough) && n % 4 != 3) continue;
        /* A lone contact is solved by one sweep. */
        double drag = set->has_drag ? renew_drag(c, set, hg, enough) : 0;
        if (!(drag > 0) && (change < enough || c->n_pairs == 1)) break;
    }
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     inv = 1 / hg;
        for (int q = 0; q < 3; q++) {
            m->v[s][q] = m->V[q];
            m->a[s][q] = (m->V[q] - m->vr[q]) * inv;
        }
        m->drag[s][0] = m->drag_rate * (set->speed - m->V[0]), m->drag[s][1] = -m->drag_rate * m->V[1];
    }
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair         *p = &c->pairs[k];
        const fw_member *a = &c->members[p->a], *b = partner(c, p);
        p->normal[s] = p->push / hg;
        p->friction[s] = p->rub / hg;
        p->rate[s] = closing(p, a->V, b ? b->V : NULL);
        p->slip[s] = slipping(p, a->V, b ? b->V : NULL, a->radius, b ? b->radius : 0);
        p->depth[s] = p->depth_star + hg * (p->rate[s] - p->rate_star);
        p->dir[s][0] = p->nx, p->dir[s][1] = p->ny;
    }
}
