/* One island through one macro-step.
 *
 *          no contact closed ---- closed-form flight to the first touch --+
 *   t ---->                                                               +--> touch: close the pair, new accelerations
 *          some closed -------- ESDIRK sub-step, cut at the first touch --+
 *
 * Touches are located because the force jumps there by c d': a step across the jump is first order whatever its method. */
#include <float.h>
#include <math.h>

#include "geometry/ring.h"
#include "kernel/island.h"

enum { MAX_LANDINGS = 12 };

static fw_member *other(fw_island *is, const fw_pair *p) { return p->b == FW_WALL ? NULL : &is->members[p->b]; }

static double stiffest(const fw_island *is)
{
    double w = 0;
    for (size_t k = 0; k < is->n_closed; k++) w = fw_larger(w, is->pairs[is->closed[k]].law.omega);
    return w;
}

/* Most pairs of an island are open and many members touch nobody: who takes part in the steps is listed. */
static void list_closed(fw_island *is)
{
    size_t n = 0, n_held = 0;
    for (size_t k = 0; k < is->n_pairs; k++)
        if (is->pairs[k].is_closed) is->closed[n++] = (int32_t)k;
    for (size_t i = 0; i < is->n_members; i++)
        if (is->members[i].n_closed) is->held[n_held++] = (int32_t)i;
    is->n_held = n_held;
}

static void close_pair(fw_island *is, fw_pair *p)
{
    fw_member *a = &is->members[p->a], *b = other(is, p);
    p->is_closed = true;
    p->t_touch = is->t;
    p->since_touch = 0;
    a->n_closed++;
    is->n_touched += !a->body->is_touched;
    a->body->is_touched = true;
    if (b) {
        b->n_closed++;
        is->n_touched += !b->body->is_touched;
        b->body->is_touched = true;
    }
    is->n_closed++;
    is->ledger->touches++;
    if (p->b == FW_WALL) {
        if (is->t - a->body->t_wall > 1) {
            a->body->t_hit = is->t;
            if (is->wear->is_open) is->ledger->hits++;
        }
        a->body->t_wall = is->t;
    }
}

static void open_pair(fw_island *is, fw_pair *p)
{
    p->is_closed = false;
    is->members[p->a].n_closed--;
    if (p->b != FW_WALL) is->members[p->b].n_closed--;
    is->n_closed--;
}

/* After a touch: accelerations anew and a short first step. */
static void restart(fw_island *is, double *h)
{
    list_closed(is);
    fw_stage_start(is);
    is->ledger->force_evaluations += (double)is->n_closed;
    double w = 0;
    for (size_t k = 0; k < is->n_closed; k++) {
        const fw_pair *p = &is->pairs[is->closed[k]];
        if (p->since_touch == 0) w = fw_larger(w, p->law.omega);
    }
    if (w > 0) *h = fmin(*h, is->setup->first_step / w);
}

/* Everybody from x0 to x1 by closed form who has no contact. */
static void fly_others(fw_island *is, double h)
{
    for (size_t i = 0; i < is->n_members; i++) {
        fw_member *m = &is->members[i];
        if (!m->n_closed) fw_touch_fly(is->setup, m, h, &m->x1, &m->y1, m->v1);
    }
}

static double attempt(fw_island *is, double h)
{
    const fw_method *me = is->setup->method;
    size_t           last = me->n_stages - 1;
    for (size_t s = 1; s <= last; s++) fw_stage_solve(is, s, h);
    double hg = h * me->gamma, worst = 0;
    for (size_t i = 0; i < is->n_held; i++) {
        fw_member *m = &is->members[is->held[i]];
        m->x1 = m->xr + hg * m->v[last][0], m->y1 = m->yr + hg * m->v[last][1];
        double e[3] = {0, 0, 0};
        for (int q = 0; q < 3; q++) {
            m->v1[q] = m->v[last][q];
            for (size_t s = 0; s <= last; s++) e[q] += me->e[s] * m->a[s][q];
        }
        double err = h * fw_larger(fw_length(e[0], e[1]), m->body->radius * fabs(e[2]));
        if (!(err <= worst)) worst = err; /* keeps NaN */
    }
    fly_others(is, h);
    return worst / (is->setup->tolerance * is->setup->velocity_scale);
}

/* First touch of an open pair inside the step just tried; sets gap1 and rate1 of all open pairs. */
static double first_touch(fw_island *is, double h)
{
    double first = INFINITY;
    for (size_t k = 0; k < is->n_pairs; k++) {
        fw_pair *p = &is->pairs[k];
        if (p->is_closed) continue;
        fw_touch_gap(is, p, true, &p->gap1, &p->rate1);
        double g0 = p->gap0;
        if (g0 <= 0 && p->rate0 <= 0) {
            /* just opened: it parts; only a later return counts */
            if (p->gap1 > 0 || p->rate1 <= 0) continue;
            g0 = DBL_MIN;
        }
        first = fw_smaller(first, fw_touch_root(g0, p->rate0, p->gap1, p->rate1, h));
    }
    return first;
}

static double signed_normal(const fw_pair *p, size_t s) { return p->law.k * p->depth[s] + p->law.c * p->rate[s]; }

/* Where in the step just tried does a floe let go of the structure, as a share of it? 1: nowhere, or not worth a cut. Slip is
 * fast and pressure small at the end of a visit: path and contact time need the kink, depth hardly does. */
static double release(const fw_island *is)
{
    const fw_method *me = is->setup->method;
    size_t           last = me->n_stages - 1;
    double           first = 1;
    for (size_t k = 0; k < is->n_closed; k++) {
        const fw_pair *p = &is->pairs[is->closed[k]];
        if (p->b != FW_WALL) continue;
        double from = signed_normal(p, 0), to = signed_normal(p, last);
        if (to >= -0.2 * from || from <= is->setup->tolerance * p->law.c * is->setup->velocity_scale) continue;
        /* the stages in between tell on which side of the chord the zero lies */
        double u0 = 0, u1 = 1, f0 = from, f1 = to;
        for (size_t s = 1; s < last; s++) {
            double f = signed_normal(p, s);
            if (f > 0 && me->c[s] > u0) u0 = me->c[s], f0 = f;
        }
        for (size_t s = 1; s < last; s++) {
            double f = signed_normal(p, s);
            if (f <= 0 && me->c[s] < u1 && me->c[s] > u0) u1 = me->c[s], f1 = f;
        }
        first = fmin(first, u0 + (u1 - u0) * f0 / (f0 - f1));
    }
    return first;
}

static void keep_books(fw_island *is, double h)
{
    const fw_method *me = is->setup->method;
    fw_ledger       *l = is->ledger;
    for (size_t i = 0; i < is->n_members; i++) {
        fw_member *m = &is->members[i];
        if (!m->n_closed) {
            /* drag alone, exact flow: its work is the change itself */
            double de = 0.5 * (m->v1[0] * m->v1[0] + m->v1[1] * m->v1[1] - m->v0[0] * m->v0[0] - m->v0[1] * m->v0[1]);
            l->drag_work += de / m->body->inv_mass;
            continue;
        }
        double j[3] = {0, 0, 0}, work = 0;
        for (size_t s = 0; s < me->n_stages; s++) {
            double hb = h * me->b[s];
            j[0] += hb * m->drag[s][0], j[1] += hb * m->drag[s][1];
            work += hb * (m->drag[s][0] * m->v[s][0] + m->drag[s][1] * m->v[s][1]);
        }
        l->drag_work += work / m->body->inv_mass;
        /* xr, vr are free again: collect the impulses there [m/s] */
        m->vr[0] = j[0], m->vr[1] = j[1], m->vr[2] = 0;
        m->U[0] = fw_length(j[0], j[1]);
    }
    bool is_beyond = false;
    for (size_t k = 0; k < is->n_closed; k++) {
        fw_pair   *p = &is->pairs[is->closed[k]];
        fw_member *a = &is->members[p->a], *b = other(is, p);
        double     jx = 0, jy = 0, rub = 0, push = 0, dashpot = 0, dropped = 0;
        for (size_t s = 0; s < me->n_stages; s++) {
            double hb = h * me->b[s], n = p->normal[s], f = p->friction[s], d = p->depth[s], w = p->rate[s];
            jx += hb * (n * p->dir[s][0] - f * p->dir[s][1]), jy += hb * (n * p->dir[s][1] + f * p->dir[s][0]);
            rub += hb * f, push += hb * n;
            double spring = d > 0 ? p->law.k * d * w : 0;
            if (n > 0)
                dashpot += hb * (n * w - spring);
            else
                dropped -= hb * spring;
            l->friction -= hb * f * p->slip[s];
            if (p->b == FW_WALL && n > l->peak_force) l->peak_force = n;
        }
        size_t last = me->n_stages - 1;
        if (!(push > 0)) {
            /* No force at all: what the spring loses is dropped, exactly, also where the rims part inside the step. */
            double d0 = fw_larger(0, p->depth[0]), d1 = fw_larger(0, p->depth[last]);
            dashpot = 0, dropped = 0.5 * p->law.k * (d0 * d0 - d1 * d1);
        }
        l->dashpot += dashpot, l->dropped += dropped;
        double size = fw_length(jx, jy);
        a->vr[0] += jx * a->body->inv_mass, a->vr[1] += jy * a->body->inv_mass;
        a->vr[2] -= rub * a->body->radius * a->body->inv_inertia;
        a->U[0] += size * a->body->inv_mass;
        if (b) {
            b->vr[0] -= jx * b->body->inv_mass, b->vr[1] -= jy * b->body->inv_mass;
            b->vr[2] -= rub * b->body->radius * b->body->inv_inertia;
            b->U[0] += size * b->body->inv_mass;
        }
        if (p->b == FW_WALL) {
            l->normal_impulse += push;
            double from = signed_normal(p, 0), to = signed_normal(p, last);
            l->contact_time += from > 0 && to > 0 ? h
                               : from > 0         ? h * from / (from - to)
                               : to > 0           ? h * to / (to - from)
                                                  : 0;
        }
        double small = fw_smaller(a->body->radius, b ? b->body->radius : is->structure_radius), d = p->depth[last];
        l->max_overlap = fw_larger(l->max_overlap, d),
        l->max_overlap_share = fw_larger(l->max_overlap_share, d / small);
        if (d > 0.1 * small) is_beyond = true;
    }
    if (is_beyond) l->overlap_time += h;
    for (size_t i = 0; i < is->n_held; i++) {
        fw_member *m = &is->members[is->held[i]];
        double     mass = 1 / m->body->inv_mass, inertia = m->body->inv_inertia > 0 ? 1 / m->body->inv_inertia : 0;
        double     change = 0, work = 0, err = 0;
        for (int q = 0; q < 3; q++) {
            double in = q < 2 ? mass : inertia, dv = m->v1[q] - m->v0[q], mean = 0.5 * (m->v1[q] + m->v0[q]);
            change += in * dv * mean;
            work += in * m->vr[q] * mean;
            if (q < 2) err += fabs(dv - m->vr[q]);
        }
        l->kinetic_change += change, l->impulse_work += work;
        l->impulse_size += mass * m->U[0] * 0.5 * (fw_length(m->v0[0], m->v0[1]) + fw_length(m->v1[0], m->v1[1]));
        l->momentum_error += mass * err, l->momentum_size += mass * m->U[0];
    }
}

static void collect_wear(fw_island *is, double h)
{
    const fw_method *me = is->setup->method;
    if (!is->wear->is_open) return;
    for (size_t k = 0; k < is->n_closed; k++) {
        fw_pair *p = &is->pairs[is->closed[k]];
        if (p->b != FW_WALL) continue;
        const fw_member *a = &is->members[p->a];
        size_t           last = me->n_stages - 1;
        if (!(p->normal[0] > 0) && !(p->normal[last] > 0)) continue;
        fw_wear_interval iv = {.length = h, .since_touch = p->since_touch};
        iv.impact_left = a->body->t_hit + 2 / p->law.omega - is->t;
        iv.depth[0] = p->since_touch > 0 ? p->depth[0] : 0; /* landed on the touch to rounding */
        iv.depth[1] = p->depth[last];
        iv.rate[0] = p->rate[0], iv.rate[1] = p->rate[last];
        iv.angle[0] = fw_ring_angle(a->x0, a->y0), iv.angle[1] = fw_ring_angle(a->x1, a->y1);
        iv.n_stages = me->n_stages;
        for (size_t s = 0; s < me->n_stages; s++)
            iv.at[s] = me->c[s], iv.normal[s] = signed_normal(p, s), iv.slip[s] = p->slip[s];
        iv.radius = a->body->radius, iv.thickness = a->body->thickness;
        fw_wear_collect(is->wear, &iv);
    }
}

/* The step's end becomes the next step's start. */
static fw_status move_on(fw_island *is, double h, fw_msg *msg)
{
    const fw_method *me = is->setup->method;
    size_t           last = me->n_stages - 1;
    bool             any_open = false;
    is->t += h;
    for (size_t i = 0; i < is->n_members; i++) {
        fw_member *m = &is->members[i];
        m->x0 = m->x1, m->y0 = m->y1;
        for (int q = 0; q < 3; q++) m->v0[q] = m->v1[q];
        if (!m->n_closed) continue;
        for (int q = 0; q < 3; q++) m->a[0][q] = m->a[last][q], m->v[0][q] = m->v[last][q];
        m->drag[0][0] = m->drag[last][0], m->drag[0][1] = m->drag[last][1];
    }
    for (size_t k = 0; k < is->n_pairs; k++) {
        fw_pair *p = &is->pairs[k];
        if (!p->is_closed) {
            p->gap0 = p->gap1, p->rate0 = p->rate1;
            continue;
        }
        fw_member *a = &is->members[p->a];
        p->since_touch += h;
        p->normal[0] = p->normal[last], p->friction[0] = p->friction[last], p->slip[0] = p->slip[last];
        p->rate[0] = p->rate[last], p->depth[0] = p->depth[last];
        p->dir[0][0] = p->dir[last][0], p->dir[0][1] = p->dir[last][1];
        if (p->b == FW_WALL) {
            a->body->t_wall = is->t;
            FW_CHECK(fw_length(a->x0, a->y0) > is->structure_radius, msg, FW_E_NUMERIC,
                     "floe %llu (D %.3g m, h %.2g m) has its centre inside the structure at t = %.6g s",
                     (unsigned long long)a->body->name, 2 * a->body->radius, a->body->thickness, is->t);
        }
        if (p->depth[0] < 0 && p->normal[0] <= 0) {
            open_pair(is, p);
            any_open = true;
            fw_touch_gap(is, p, false, &p->gap0, &p->rate0);
        }
    }
    if (any_open) list_closed(is);
    return FW_OK;
}

/* Fly to the first touch (or the end) when nobody is in contact. */
static fw_status fly(fw_island *is, double t_end, double *h, fw_msg *m)
{
    double first = INFINITY, dt = t_end - is->t;
    size_t who = 0;
    for (size_t k = 0; k < is->n_pairs; k++) {
        double t = fw_touch_free(is, &is->pairs[k], dt);
        if (t < first) first = t, who = k;
    }
    double go = fmin(first, dt);
    fly_others(is, go);
    keep_books(is, go);
    first_touch(is, go);
    FW_TRY(move_on(is, go, m));
    if (!(first <= dt)) {
        is->t = t_end;
        return FW_OK;
    }
    /* Others may touch at the same instant (mirror images do): within rounding they are closed together. */
    for (size_t k = 0; k < is->n_pairs; k++) {
        fw_pair *p = &is->pairs[k];
        double   reach = is->members[p->a].body->radius;
        if (k == who || (p->rate0 > 0 && p->gap0 <= 1e-11 * reach)) close_pair(is, p);
    }
    *h = INFINITY;
    restart(is, h);
    return FW_OK;
}

fw_status fw_island_advance(fw_island *is, double t_end, fw_msg *msg)
{
    const fw_setup *set = is->setup;
    double          h = INFINITY;
    bool            is_stale = false;
    for (size_t i = 0; i < is->n_members; i++) {
        if (!is->members[i].n_closed) continue;
        if (is->members[i].body->step > 0)
            h = fmin(h, is->members[i].body->step);
        else
            is_stale = true;
    }
    /* A pair listed late overlaps already: it is closed now, and counted. */
    for (size_t k = 0; k < is->n_pairs; k++) {
        fw_pair *p = &is->pairs[k];
        if (p->is_closed) continue;
        fw_touch_gap(is, p, false, &p->gap0, &p->rate0);
        if (p->gap0 <= 0 && p->rate0 > 0) {
            if (p->gap0 < -1e-9) is->ledger->late_touches++;
            close_pair(is, p);
            is_stale = true;
        }
    }
    list_closed(is);
    if (is_stale) restart(is, &h);

    while (is->t < t_end) {
        if (!is->n_closed) {
            FW_TRY(fly(is, t_end, &h, msg));
            continue;
        }
        double left = t_end - is->t, w = stiffest(is);
        if (h == INFINITY) h = set->first_step / w;
        h = fmin(h, set->max_step / w);
        double want = h, dt = want >= left ? left : want > 0.5 * left ? 0.5 * left : want, err = 0;
        bool   is_cut = false;
        for (int landings = 0, releases = 0;;) {
            err = attempt(is, dt);
            if (!(err <= 1) && dt * w > 1e-9) {
                double f = isfinite(err) ? fmax(0.2, 0.9 * pow(err, -1.0 / set->method->error_order)) : 0.1;
                dt *= fmin(f, 0.9);
                want = dt;
                is_cut = false;
                is->ledger->rejected++;
                continue;
            }
            FW_CHECK(isfinite(err), msg, FW_E_NUMERIC, "the state of floe %llu is not finite at t = %.6g s",
                     (unsigned long long)is->members[0].body->name, is->t);
            /* Land on the first touch; each landing is a step of its own length, so the cubic it comes from gets better. */
            double touch = first_touch(is, dt);
            if (touch < dt * (1 - 1e-9) && landings++ < MAX_LANDINGS) {
                dt = fmax(touch, 1e-12 / w);
                is_cut = true;
                continue;
            }
            double let_go = touch <= dt ? 1 : release(is);
            if (let_go < 1 && releases++ < 2 && dt * w > 0.01) {
                dt *= fmax(let_go, 0.01);
                is_cut = true;
                continue;
            }
            break;
        }
        keep_books(is, dt);
        collect_wear(is, dt);
        is->ledger->steps++;
        FW_TRY(move_on(is, dt, msg));
        /* Close whoever stands at its touch now: the gap is what is left of locating it. Rims that lie at each other without
         * closing speed (a raft laid rim to rim) touch as of now: waiting for the speed to grow takes slivers without end. */
        bool is_touch = false, is_sliver = dt * w <= 2e-12;
        for (size_t k = 0; k < is->n_pairs; k++) {
            fw_pair *p = &is->pairs[k];
            if (p->is_closed || !(p->rate0 > 0 || (is_sliver && p->rate0 > -1e-9 * set->velocity_scale))) continue;
            if (p->gap0 <= fmax(1e-7 * p->rate0 / w, 1e-12 * is->members[p->a].body->radius)) {
                close_pair(is, p);
                is_touch = true;
            }
        }
        double f = err > 0 ? 0.9 * pow(err, -1.0 / set->method->error_order) : set->growth;
        f = fmin(set->growth, f);
        h = is_cut || dt < want ? fmax(want, dt * f) : dt * f;
        /* Accelerations are velocity differences over the step: after a sliver of one they are rounding noise. */
        if (is_touch || dt * w < 1e-6) restart(is, &h);
        if (t_end - is->t < 1e-12 * (1 + fabs(t_end))) is->t = t_end;
    }
    for (size_t i = 0; i < is->n_members; i++)
        if (is->members[i].n_closed) is->members[i].body->step = h;
    return FW_OK;
}
