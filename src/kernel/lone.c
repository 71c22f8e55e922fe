#include "kernel/lone.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <stdio.h>

#include "geometry/ring.h"
#include "kernel/cluster.h"

enum { N = FW_LONE_NODES, TERMS = FW_LONE_TERMS, PIECE = 5, MAX_SWEEPS = 6 };

#define A1 0.27639320225002106
#define A2 0.7236067977499789
static const double NODE[N] = {0, A1, A2, 1}, WEIGHT[N] = {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};
static const double TO_POWER[N][N] = {{1, 0, 0, 0},
                                      {-6, 8.0901699437494745, -3.0901699437494745, 1},
                                      {10, -19.270509831248422, 14.270509831248424, -5},
                                      {-5, 11.180339887498949, -11.180339887498949, 5}};
static const double LEGENDRE[N] = {-0.05, 0.6, -1.5, 1};
static const double NODE5[PIECE] = {0, 0.17267316464601146, 0.5, 0.8273268353539885, 1};
static const double WEIGHT5[PIECE] = {0.05, 49.0 / 180, 16.0 / 45, 49.0 / 180, 0.05};
static const double SHORT = 0.3;

static double K(const char *n, double d) { const char *s = getenv(n); return s ? atof(s) : d; }

bool fw_lone_is(const fw_cluster *c, const fw_books *b)
{
    return b->setup->is_lone_exact && c->n_pairs == 1 && c->n_members == 1 && c->pairs[0].b == FW_WALL;
}

static inline double integral(const double *c, double x)
{
    return x * (c[0] + x * (c[1] * 0.5 + x * (c[2] * (1.0 / 3) + x * c[3] * 0.25)));
}
static inline double integral2(const double *c, double x)
{
    return x * x * (c[0] * 0.5 + x * (c[1] * (1.0 / 6) + x * (c[2] * (1.0 / 12) + x * c[3] * 0.05)));
}

/* e^{-at} cosh, e^{-at} sinh / beta */
typedef struct wave {
    double c, s, q;
} wave;

static wave wave_at(const fw_lone *L, double t)
{
    wave w = {0, 0, 0};
    if (L->presses && !L->is_short) {
        double x = L->split * t * t;
        if (fabs(x) < 0.01) {
            double e = exp(-L->decay * t);
            w.c = e * (1 + x * (0.5 + x * (1.0 / 24 + x * (1.0 / 720 + x / 40320))));
            w.s = e * t * (1 + x * (1.0 / 6 + x * (1.0 / 120 + x * (1.0 / 5040 + x / 362880))));
        } else if (x < 0) {
            double b = sqrt(-L->split), e = exp(-L->decay * t);
            w.c = e * cos(b * t), w.s = e * sin(b * t) / b;
        } else {
            double b = sqrt(L->split), slow = exp(-L->omega2 / (L->decay + b) * t), fast = exp(-(L->decay + b) * t);
            w.c = 0.5 * (slow + fast), w.s = 0.5 * (slow - fast) / b;
        }
    }
    if (L->rubs && L->slides == 0 && !L->is_short_slip) w.q = exp(-L->relax * t);
    return w;
}

static void particular_depth(const fw_lone *L, const double *g, double *P)
{
    double h = L->span, inv = 1 / (L->omega2 * h * h), ah = 2 * L->decay * h;
    P[3] = h * h * g[3] * inv;
    P[2] = (h * h * g[2] - 3 * ah * P[3]) * inv;
    P[1] = (h * h * g[1] - 2 * ah * P[2] - 6 * P[3]) * inv;
    P[0] = (h * h * g[0] - ah * P[1] - 2 * P[2]) * inv;
}
static void particular_slip(const fw_lone *L, const double *f, double *P)
{
    double h = L->span, inv = 1 / (L->relax * h);
    P[3] = h * f[3] * inv;
    P[2] = (h * f[2] - 3 * P[3]) * inv;
    P[1] = (h * f[1] - 2 * P[2]) * inv;
    P[0] = (h * f[0] - P[1]) * inv;
}
static void series_depth(const fw_lone *L, const double *g, double d, double u, double *D)
{
    double h = L->span, z2 = L->omega2 * h * h, ah = 2 * L->decay * h;
    D[0] = d, D[1] = u * h;
    for (int n = 0; n + 2 < TERMS; n++)
        D[n + 2] = ((n < N ? h * h * g[n] : 0) - ah * (n + 1) * D[n + 1] - z2 * D[n]) / ((n + 1) * (n + 2));
}
static void series_slip(const fw_lone *L, const double *f, double s, double *D)
{
    double h = L->span, qh = L->relax * h;
    D[0] = s;
    for (int n = 0; n + 1 < TERMS; n++) D[n + 1] = ((n < N ? h * f[n] : 0) - qh * D[n]) / (n + 1);
}

static void fit(fw_lone *L)
{
    if (L->presses) {
        if (L->is_short)
            series_depth(L, L->g, L->from.depth, L->from.rate, L->depth);
        else
            particular_depth(L, L->g, L->depth);
    }
    if (L->rubs && L->slides == 0) {
        if (L->is_short_slip)
            series_slip(L, L->f, L->from.slip, L->slip);
        else
            particular_slip(L, L->f, L->slip);
    }
}

/* Depth and rate from coefficients P, for a start d, u. */
static inline void swing(const fw_lone *L, const double *P, double d, double u, double x, wave w, double *depth, double *rate)
{
    double inv = 1 / L->span;
    if (L->is_short) {
        double y = P[TERMS - 1], s = 0;
        for (int n = TERMS - 2; n >= 0; n--) s = s * x + y, y = y * x + P[n];
        *depth = y, *rate = s * inv;
        return;
    }
    double y = P[0] + x * (P[1] + x * (P[2] + x * P[3])), s = (P[1] + x * (2 * P[2] + 3 * x * P[3])) * inv;
    double A = d - P[0], B = u - P[1] * inv;
    *depth = y + A * w.c + (B + L->decay * A) * w.s;
    *rate = s + B * w.c - (L->decay * B + L->omega2 * A) * w.s;
}

static void state_at(const fw_lone *L, const fw_contact_constants *law, double t, fw_lone_state *y)
{
    const fw_lone_state *o = &L->from;
    double h = L->span, x = t / h;
    double ig = h * integral(L->g, x), iff = h * integral(L->f, x), iig = h * h * integral2(L->g, x),
           iif = h * h * integral2(L->f, x);
    wave w = wave_at(L, t);
    if (L->presses)
        swing(L, L->depth, o->depth, o->rate, x, w, &y->depth, &y->rate);
    else
        y->depth = o->depth + o->rate * t + iig, y->rate = o->rate + ig;
    if (!L->rubs) {
        y->slip = o->slip + iff, y->slid = o->slip * t + iif;
    } else if (L->slides != 0) {
        double k = L->slides * L->kick;
        y->slip = o->slip - k * (ig - (y->rate - o->rate)) + iff;
        y->slid = o->slip * t - k * (iig - (y->depth - o->depth - o->rate * t)) + iif;
    } else if (L->is_short_slip) {
        double s = L->slip[TERMS - 1], S = s / TERMS;
        for (int n = TERMS - 2; n >= 0; n--) s = s * x + L->slip[n], S = S * x + L->slip[n] / (n + 1);
        y->slip = s, y->slid = S * t;
    } else {
        const double *P = L->slip;
        y->slip = P[0] + x * (P[1] + x * (P[2] + x * P[3])) + (o->slip - P[0]) * w.q;
        y->slid = (iff - (y->slip - o->slip)) / L->relax;
    }
    y->carried = o->carried + (1 - L->share) * iff;
    y->along = y->carried + L->share * y->slip;
    y->reach = o->reach - (y->depth - o->depth);
    y->turn = h * integral(L->round, x) + L->share * y->slid / y->reach;
    y->normal = law->k * y->depth + law->c * y->rate;
}

/* Drag per mass along the normal (outward) and along the wall. */
static inline void drag_at(const fw_lone *L, double speed, double per_mass, const fw_lone_state *y, double *fn, double *ft)
{
    double c = cos(y->turn), s = sin(y->turn), nx = L->nx * c - L->ny * s, ny = L->nx * s + L->ny * c;
    double wn = speed * nx + y->rate, wt = -speed * ny - y->along, rate = per_mass * sqrt(wn * wn + wt * wt);
    *fn = rate * wn, *ft = rate * wt;
}

static inline void force(const fw_lone *L, double speed, double per_mass, const fw_lone_state *y, double *g, double *f,
                         double *round)
{
    double fn, ft, inv = 1 / y->reach, w = y->along * inv;
    drag_at(L, speed, per_mass, y, &fn, &ft);
    *g = -y->along * w - fn, *f = ft + y->rate * w;
    *round = inv * (y->carried - L->share * y->rate * y->slid * inv);
}

static void to_powers(const double *v, double *c)
{
    for (int k = 0; k < N; k++) {
        c[k] = 0;
        for (int j = 0; j < N; j++) c[k] += TO_POWER[k][j] * v[j];
    }
}

static void start(fw_lone *L, const fw_cluster *c, const fw_books *b)
{
    const fw_member *m = &c->members[0];
    const fw_pair   *p = &c->pairs[0];
    const fw_setup  *set = b->setup;
    const double    *v = m->y0 + FW_VX, w_slip = m->own_inv_mass + m->radius * m->turn;
    double           x = m->y0[FW_X], y = m->y0[FW_Y], r2 = x * x + y * y, r = sqrt(r2), reach = m->radius + set->structure_radius;
    *L = (fw_lone){.nx = x / r, .ny = y / r};
    fw_lone_state *o = &L->from;
    o->reach = r, o->depth = (reach * reach - r2) / (reach + r);
    o->rate = -(L->nx * v[0] + L->ny * v[1]);
    o->along = L->nx * v[1] - L->ny * v[0];
    o->slip = o->along - m->radius * v[2];
    L->share = m->own_inv_mass / w_slip;
    o->carried = o->along - L->share * o->slip;
    o->normal = p->law.k * o->depth + p->law.c * o->rate;
    L->decay = 0.5 * p->law.c * m->own_inv_mass, L->omega2 = p->law.k * m->own_inv_mass;
    L->split = L->decay * L->decay - L->omega2;
    L->relax = p->law.ct * w_slip, L->kick = p->mu / L->share;
}

/* Which of the forms holds from the start on? Where a force is on the edge, its slope decides. */
static void choose(fw_lone *L, const fw_pair *p, double inv_mass, double scale, double g, double f)
{
    const fw_lone_state *o = &L->from;
    const fw_contact_constants *law = &p->law;
    double tiny = 1e-10 * law->k / law->omega * scale;
    L->presses = o->normal > tiny || (o->normal > -tiny && law->k * o->rate + law->c * g > 0);
    L->rubs = L->presses && p->mu > 0 && law->ct > 0;
    L->slides = 0;
    if (!L->rubs) return;
    double n = fw_larger(o->normal, 0), over = law->ct * fabs(o->slip) - p->mu * n;
    double sign = o->slip > 0 ? 1 : o->slip < 0 ? -1 : f > 0 ? 1 : -1;
    if (fabs(over) <= tiny)
        over = law->ct * sign * (f - L->relax * o->slip) - p->mu * (law->k * o->rate + law->c * (g - n * inv_mass));
    if (over > 0) L->slides = sign;
}

/* How far inside its regime the state is; negative: past the edge [N]. i = 0, 1. */
static double margin(const fw_lone *L, const fw_pair *p, const fw_lone_state *y, int i)
{
    if (!L->presses) {
        if (i == 0) return -y->normal;
        return y->rate < 0 ? p->law.k * y->depth : 1;
    }
    if (i == 0) return y->normal;
    if (!L->rubs) return 1;
    return L->slides != 0 ? L->slides * p->law.ct * y->slip - p->mu * y->normal : p->mu * y->normal - p->law.ct * fabs(y->slip);
}

static double root(const fw_lone *L, const fw_pair *p, int i, double a, double fa, double b, double fb)
{
    fw_lone_state y;
    for (int n = 0; n < 40 && !(fa > 0); n++) { /* the start itself lies on the edge */
        double x = a + 0.25 * (b - a);
        state_at(L, &p->law, x, &y);
        double fx = margin(L, p, &y, i);
        if (fx > 0)
            a = x, fa = fx;
        else
            b = x, fb = fx;
    }
    if (!(fa > 0)) return b;
    double hi = b, fhi = fb, side = 0;
    for (int n = 0; n < 60 && hi - a > 1e-14 * hi; n++) {
        double x = hi - fhi * (hi - a) / (fhi - fa);
        if (!(x > a && x < hi)) x = 0.5 * (a + hi);
        state_at(L, &p->law, x, &y);
        double fx = margin(L, p, &y, i);
        if (fx == 0) return x;
        if (fx > 0) {
            a = x, fa = fx;
            if (side > 0) fhi *= 0.5;
            side = 1;
        } else {
            hi = x, fhi = fx;
            if (side < 0) fa *= 0.5;
            side = -1;
        }
    }
    return hi;
}

static double first_event(const fw_lone *L, const fw_pair *p, const fw_lone_state *at)
{
    double before[2] = {margin(L, p, &at[0], 0), margin(L, p, &at[0], 1)}, first = INFINITY;
    for (int j = 1; j < N; j++) {
        for (int i = 0; i < 2; i++) {
            double now = margin(L, p, &at[j], i);
            if (now < 0) first = fw_smaller(first, root(L, p, i, NODE[j - 1] * L->span, before[i], NODE[j] * L->span, now));
            before[i] = now;
        }
        if (first < INFINITY) break;
    }
    return first;
}

static double attempt(fw_cluster *c, const fw_books *b, double h, double *event)
{
    const fw_setup *set = b->setup;
    fw_lone        *L = &c->lone, old = *L;
    fw_member      *m = &c->members[0];
    fw_pair        *p = &c->pairs[0];
    fw_lone_state   at[N], end = {0};
    double          g[N], f[N], r[N], speed = set->speed, drag = m->drag_per_mass;
    start(L, c, b);
    L->span = h;
    at[0] = L->from;
    force(L, speed, drag, &at[0], &g[0], &f[0], &r[0]);
    b->world->ledger.force_evaluations++;
    choose(L, p, m->own_inv_mass, set->velocity_scale, g[0], f[0]);
    L->is_short = fw_larger(sqrt(L->omega2), 2 * L->decay) * h < SHORT;
    L->is_short_slip = L->relax * h < SHORT;
    (void)old;
    L->g[0] = g[0], L->f[0] = f[0], L->round[0] = r[0];
    double tol = set->tolerance * set->velocity_scale, change = INFINITY;
    int sweeps = (int)K("SWEEPS", 3);
    for (int n = 0; n < MAX_SWEEPS; n++) {
        fit(L);
        end = at[N - 1];
        for (int j = 1; j < N; j++) {
            state_at(L, &p->law, NODE[j] * h, &at[j]);
            force(L, speed, drag, &at[j], &g[j], &f[j], &r[j]);
        }
        b->world->ledger.force_evaluations += N - 1;
        to_powers(g, L->g), to_powers(f, L->f), to_powers(r, L->round);
        if (n) change = fw_larger(fabs(at[N - 1].rate - end.rate), fw_larger(fabs(at[N - 1].along - end.along), fabs(at[N - 1].slip - end.slip)));
        if (n + 1 >= sweeps || change < 0.05 * tol) break;
    }
    fit(L);
    state_at(L, &p->law, h, &at[N - 1]);
    /* what the highest term of the forcing does */
    double e[TERMS], x[TERMS], ed = 0, en = 0, et = 0;
    for (int k = 0; k < N; k++) e[k] = L->g[N - 1] * LEGENDRE[k], x[k] = L->f[N - 1] * LEGENDRE[k];
    wave w = wave_at(L, h);
    double P[TERMS];
    if (!L->presses) {
        en = 0; ed = 0;
    } else if (L->is_short) {
        series_depth(L, e, 0, 0, P);
        swing(L, P, 0, 0, 1, w, &ed, &en);
    } else {
        particular_depth(L, e, P);
        swing(L, P, 0, 0, 1, w, &ed, &en);
    }
    if (L->rubs && L->slides != 0)
        et = L->kick * en;
    else if (L->rubs) {
        if (L->is_short_slip) {
            series_slip(L, x, 0, P);
            for (int k = TERMS - 1; k >= 0; k--) et += P[k];
        } else {
            particular_slip(L, x, P);
            et = P[0] + P[1] + P[2] + P[3] - P[0] * w.q;
        }
    }
    en = fabs(en) * K("EF", 1) + K("CF", 0.3) * fabs(at[N - 1].rate - end.rate), et = fabs(et) * K("EF", 1) + K("CF", 0.3) * fabs(at[N - 1].slip - end.slip);
    double ev = K("CF", 0.3) * fabs(at[N - 1].along - end.along);
    double err = fw_larger(en, fw_larger(et, ev)) / tol;
    if (L->presses) {
        double load = 0, wrong = 0;
        for (int j = 0; j < N; j++) {
            const fw_lone_state *y = &at[j == 0 && p->since_touch == 0 ? 1 : j];
            if (!(y->normal > 0) || !(y->depth > 0)) continue;
            double weight = WEIGHT[j] * h / sqrt(y->depth), slip = fabs(at[j].slip);
            load += weight * y->normal * slip;
            wrong += weight * (p->law.c * en * slip + y->normal * et);
        }
        if (p->load + load > 0) err = fw_larger(err, K("WF", 1) * wrong / (p->load + load) / set->wear_tolerance);
    }
    double sum = at[N - 1].depth + at[N - 1].rate + at[N - 1].slip + at[N - 1].turn;
    if (!isfinite(sum)) return NAN;
    *event = first_event(L, p, at);
    return err;
}

/* The tried step ends after `length`: what others need to know of it. */
static void finish(fw_cluster *c, const fw_books *b, double length)
{
    fw_lone   *L = &c->lone;
    fw_member *m = &c->members[0];
    fw_pair   *p = &c->pairs[0];
    size_t     last = b->setup->method->n_stages - 1;
    fw_lone_state y;
    L->length = length;
    state_at(L, &p->law, length, &y);
    double co = cos(y.turn), si = sin(y.turn), nx = L->nx * co - L->ny * si, ny = L->nx * si + L->ny * co;
    m->y1[FW_X] = y.reach * nx, m->y1[FW_Y] = y.reach * ny, m->y1[2] = m->y1[3] = 0;
    m->y1[FW_VX] = -y.rate * nx - y.along * ny, m->y1[FW_VY] = -y.rate * ny + y.along * nx;
    m->y1[FW_SPIN] = m->inv_inertia > 0 ? (y.along - y.slip) / m->radius : m->y0[FW_SPIN], m->y1[7] = 0;
    m->fastest = fw_member_fastest(m, b->setup->speed, 1 / length);
    p->depth[0] = L->from.depth, p->rate[0] = L->from.rate, p->slip[0] = L->from.slip;
    p->normal[0] = L->presses ? fw_larger(0, L->from.normal) : 0;
    p->depth[last] = y.depth, p->rate[last] = y.rate, p->slip[last] = y.slip;
    p->normal[last] = L->presses ? fw_larger(0, y.normal) : 0;
    /* the end at which rims part */
    if (!L->presses && y.rate < 0 && y.depth <= 1e-12 * m->radius) p->depth[last] = fw_smaller(y.depth, -DBL_MIN);
    double rub = !L->rubs ? 0 : L->slides != 0 ? -L->slides * p->mu * p->normal[last] : -p->law.ct * y.slip;
    p->friction[last] = rub;
    p->dir[last][0] = nx, p->dir[last][1] = ny;
}

static fw_status not_finite(const fw_cluster *c, const fw_books *books, fw_msg *msg)
{
    return fw_fail(msg, FW_E_NUMERIC, "floe %llu is not finite at t = %.6g s",
                   (unsigned long long)books->world->bodies[c->members[0].index].name, c->t0);
}

fw_status fw_lone_try(fw_cluster *c, const fw_books *b, double limit, fw_msg *msg)
{
    const fw_setup *set = b->setup;
    fw_pair        *p = &c->pairs[0];
    double          left = limit - c->t0, event = INFINITY, err, order = K("ORD", 4);
    if (!(c->h < INFINITY) || p->since_touch == 0) c->h = K("H0", 1.0) / p->law.omega;
    c->h = fw_smaller(c->h, set->max_step / p->law.omega);
    double h = c->h >= left ? left : c->h > 0.5 * left ? 0.5 * left : c->h, wanted = c->h, tried = h;
    for (;;) {
        err = attempt(c, b, h, &event);
        if (err <= 1 || h * p->law.omega <= 1e-9) break;
        double f = isfinite(err) ? fw_larger(0.2, 0.9 * pow(err, -1 / order)) : 0.1;
        f = fw_smaller(f, 0.9);
        if (event * 1.05 < f * h && event * p->law.omega > 1e-9) f = event * 1.05 / h;
        h *= f;
        b->world->ledger.rejected++;
    }
    if (!isfinite(err)) return not_finite(c, b, msg);
    if (h < tried) wanted = h;
    double f = err > 0 ? fw_smaller(set->growth, 0.9 * pow(err, -1 / order)) : set->growth;
    c->h = h < wanted ? fw_larger(wanted, h * f) : h * f;
    double length = event < h ? fw_larger(event, fw_smaller(h, 1e-9 / p->law.omega)) : h;
    finish(c, b, length);
    c->t1 = length == left ? limit : c->t0 + length;
    if (getenv("TRACE")) fprintf(stderr, "t %.5f wt %.3f wh %.3f len %.3f err %.2e presses %d slides %g N %.4g s %.4g d %.4g u %.4g ct|s|/muN %.3g\n", c->t0, p->since_touch * p->law.omega, h * p->law.omega, length * p->law.omega, err, c->lone.presses, c->lone.slides, c->lone.from.normal, c->lone.from.slip, c->lone.from.depth, c->lone.from.rate, p->law.ct*fabs(c->lone.from.slip)/p->mu/c->lone.from.normal);
    return FW_OK;
}

fw_status fw_lone_land(fw_cluster *c, const fw_books *b, double t, fw_msg *msg)
{
    double h = t - c->t0, event;
    if (!(h <= c->lone.span) && !isfinite(attempt(c, b, h, &event))) return not_finite(c, b, msg);
    finish(c, b, h);
    c->t1 = t;
    return FW_OK;
}

/* Books and wear of the tried step, in pieces. */
void fw_lone_keep(fw_cluster *c, const fw_books *b)
{
    const fw_setup *set = b->setup;
    const fw_lone  *L = &c->lone;
    fw_member      *m = &c->members[0];
    fw_pair        *p = &c->pairs[0];
    fw_body        *body = &b->world->bodies[m->index];
    fw_ledger      *l = &b->world->ledger;
    double          h = L->length, mass = 1 / m->own_inv_mass, omega = sqrt(L->omega2);
    double          drag_work = 0, dashpot = 0, friction = 0, jx = 0, jy = 0, load = 0;
    /* pieces */
    double piece = K("PIECE", 0.7) / omega, fresh = L->presses ? fw_smaller(h, K("FRESH", 4) / omega) : 0;
    if (L->presses && !L->is_short) {
        double A = fabs(L->from.depth - L->depth[0]) + fabs(L->from.rate - L->depth[1] / L->span) / omega;
        double S = 0;
        if (L->rubs && L->slides == 0 && !L->is_short_slip) S = fabs(L->from.slip - L->slip[0]) / (fabs(L->slip[0]) + 1e-12);
        double alive = fw_larger(A / fw_larger(fabs(L->depth[0]), 1e-9), S) / K("FRAC", 0.01);
        fresh = alive > 1 ? fw_smaller(fresh, log(alive) / omega + piece) : 0;
    }
    if (fresh > 0.9 * h) fresh = h;
    int n_fresh = (int)ceil(fresh / piece), n = n_fresh + (fresh < h);
    fw_lone_state y[PIECE];
    y[PIECE - 1] = L->from;
    fw_wear_interval iv = {.radius = m->radius, .thickness = body->thickness, .n_stages = PIECE};
    for (int j = 0; j < PIECE; j++) iv.at[j] = NODE5[j];
    double angle = L->presses && b->wear->is_open ? fw_ring_angle(m->y0[FW_X], m->y0[FW_Y]) : 0;
    for (int k = 0; k < n; k++) {
        double from = k < n_fresh ? fresh * k / n_fresh : fresh, to = k + 1 == n ? h : fresh * (k + 1) / n_fresh, dt = to - from;
        y[0] = y[PIECE - 1];
        for (int j = 1; j < PIECE; j++) state_at(L, &p->law, from + NODE5[j] * dt, &y[j]);
        for (int j = 0; j < PIECE; j++) {
            double w = WEIGHT5[j] * dt, fn, ft;
            if (m->drag_per_mass > 0) {
                double co = cos(y[j].turn), si = sin(y[j].turn), nx = L->nx * co - L->ny * si, ny = L->nx * si + L->ny * co;
                drag_at(L, set->speed, m->drag_per_mass, &y[j], &fn, &ft);
                drag_work += w * (-fn * y[j].rate + ft * y[j].along);
                jx += w * (fn * nx - ft * ny), jy += w * (fn * ny + ft * nx);
            }
            if (!L->presses) continue;
            double normal = fw_larger(0, y[j].normal);
            double rub = !L->rubs ? 0 : L->slides != 0 ? -L->slides * p->mu * normal : -p->law.ct * y[j].slip;
            dashpot += w * p->law.c * y[j].rate * y[j].rate, friction -= w * rub * y[j].slip;
            if (normal > l->peak_force) l->peak_force = normal;
            if (y[j].depth > 0) load += w * normal * fabs(y[j].slip) / sqrt(y[j].depth);
            iv.normal[j] = y[j].normal, iv.slip[j] = y[j].slip;
        }
        if (!L->presses || !b->wear->is_open) continue;
        iv.length = dt, iv.since_touch = p->since_touch + from, iv.impact_left = body->t_hit + 2 / p->law.omega - c->t0 - from;
        iv.depth[0] = iv.since_touch > 0 ? y[0].depth : 0, iv.depth[1] = y[PIECE - 1].depth;
        iv.rate[0] = y[0].rate, iv.rate[1] = y[PIECE - 1].rate;
        iv.angle[0] = angle - y[0].turn, iv.angle[1] = angle - y[PIECE - 1].turn;
        if (k + 1 == n && iv.normal[PIECE - 1] < 1e-9 * p->law.k / omega * set->velocity_scale) iv.normal[PIECE - 1] = 0;
        fw_wear_collect(b->wear, &iv);
    }
    fw_lone_state *e = &y[PIECE - 1];
    p->load_tried = load;
    l->drag_work += mass * drag_work, l->dashpot += dashpot, l->friction += friction;
    double d0 = fw_larger(0, L->from.depth), d1 = fw_larger(0, e->depth);
    if (!L->presses)
        l->dropped += 0.5 * p->law.k * (d0 * d0 - d1 * d1);
    else {
        l->normal_impulse += mass * (L->span * integral(L->g, h / L->span) - (e->rate - L->from.rate));
        l->contact_time += h;
    }
    double small = fw_smaller(m->radius, set->structure_radius);
    l->max_overlap = fw_larger(l->max_overlap, e->depth);
    l->max_overlap_share = fw_larger(l->max_overlap_share, e->depth / small);
    if (e->depth > 0.1 * small) l->overlap_time += h;
    /* impulses */
    double inertia = m->inv_inertia > 0 ? 1 / m->inv_inertia : 0, in[3] = {mass, mass, inertia}, work = 0, size;
    for (int q = 0; q < 3; q++) work += 0.5 * in[q] * (m->y1[FW_VX + q] - m->y0[FW_VX + q]) * (m->y1[FW_VX + q] + m->y0[FW_VX + q]);
    size = fw_length(jx, jy) + fw_length(m->y1[FW_VX] - m->y0[FW_VX] - jx, m->y1[FW_VY] - m->y0[FW_VY] - jy);
    l->kinetic_change += work, l->impulse_work += work;
    l->impulse_size += mass * size * 0.5 * (fw_length(m->y0[FW_VX], m->y0[FW_VY]) + fw_length(m->y1[FW_VX], m->y1[FW_VY]));
    l->momentum_size += mass * size;
}
