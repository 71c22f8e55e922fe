/* The rim's memory, and the law in a stage. (Kinks, books and imprints of whole steps: crush_step.c.) */
#include "kernel/crush.h"

#include <math.h>

#include "base/memory.h"
#include "geometry/lens.h"
#include "kernel/crush_rim.h"

static double clamp(double x, double most) { return x > most ? most : x > 0 ? x : 0; }

enum { MIN_NODES = 64, MAX_NODES = 4096, MAX_NEWTON = 40 };

static const double PER_CHORD = 10; /* nodes */

static double reduced(double Ra, double Rb) { return Ra * Rb / (Ra + Rb); }

double fw_crush_spring(const fw_setup *s, double m_eff, double Ra, double Rb, double h)
{
    return fw_crush_stiffness(&s->crush.law, m_eff, s->crush_speed, reduced(Ra, Rb), h);
}

static fw_status make_rim(fw_rim **out, const fw_setup *s, const fw_body *a, const fw_contact_constants *law, fw_msg *m)
{
    double R = a->radius, h = a->thickness, star = reduced(R, s->structure_radius);
    double depth = fw_crush_depth(&s->crush.law, 1 / a->inv_mass, s->crush_speed, star, h);
    double n = ceil(TWO_PI * R / (fw_crush_chord(star, depth) / PER_CHORD));
    size_t n_nodes = (size_t)fw_smaller(MAX_NODES, fw_larger(MIN_NODES, n));
    FW_TRY(fw_alloc(out, 1, sizeof **out + n_nodes * sizeof *(*out)->node, "rim that crushes", m));
    fw_rim *r = *out;
    r->radius = R, r->thickness = h, r->structure_radius = s->structure_radius, r->reduced = star, r->mass = 1 / a->inv_mass;
    r->law = s->crush.law, r->kappa = s->crush.unloading;
    r->spin_damping = s->crush.has_flat && s->has_rotation ? law->ct * R * R : 0;
    r->n = n_nodes, r->width = TWO_PI * R / (double)n_nodes, r->own.depth = -INFINITY;
    for (size_t i = 0; i < n_nodes; i++) r->node[i].depth = -INFINITY;
    return FW_OK;
}

fw_status fw_crush_close(fw_pair *p, const fw_setup *s, fw_body *a, const fw_body *b, fw_msg *m)
{
    bool crushes = s->is_crush && !b;
    if (!crushes && !s->is_from_pressure) return FW_OK;
    double         m_eff = 1 / (a->inv_mass + (b ? b->inv_mass : 0)), h = b ? fw_smaller(a->thickness, b->thickness) : a->thickness;
    fw_contact_law law = b ? s->floe_contact : s->contact;
    law.stiffness = fw_crush_spring(s, m_eff, a->radius, b ? b->radius : s->structure_radius, h);
    p->law = fw_contact_law_apply(&law, m_eff);
    if (!crushes) return FW_OK;
    if (!a->rim) FW_TRY(make_rim(&a->rim, s, a, &p->law, m));
    p->rim = a->rim;
    p->load = a->rim->load;
    p->law.k = p->law.c = 0;
    return FW_OK;
}

/* --- memory ----------------------------------------------------------------------------------------------------------- */

double fw_rim_between(double from, double to)
{
    double turn = to - from;
    return fabs(turn) > 0.5 * TWO_PI ? turn - TWO_PI * round(turn / TWO_PI) : turn;
}

double fw_rim_imprint(const fw_rim *r, const fw_imprint *i, double place, double *slope)
{
    double s = r->radius * fw_rim_between(i->at, place);
    *slope = -s / r->reduced;
    return i->depth - 0.5 * s * s / r->reduced;
}

double fw_rim_deepest(const fw_rim *r, double place, double *slope)
{
    long   n = (long)r->n, k = (long)floor(place * ((double)n / TWO_PI)) % n;
    size_t i = (size_t)(k < 0 ? k + n : k), j = i + 1 < r->n ? i + 1 : 0;
    const fw_imprint *known[] = {&r->node[i], &r->node[j], &r->own};
    double            D = FW_CRUSH_ELASTIC, turn;
    *slope = 0;
    for (int q = 0; q < 3; q++) {
        double at = fw_rim_imprint(r, known[q], place, &turn);
        if (at > D) D = at, *slope = turn;
    }
    return D;
}

void fw_rim_press(fw_rim *r, fw_imprint own)
{
    double x = own.at * ((double)r->n / TWO_PI), half = fw_smaller(sqrt(2 * r->reduced * own.depth) / r->width + 1, 0.5 * (double)r->n - 1), slope;
    long   n = (long)r->n, last = (long)floor(x + half);
    for (long k = (long)ceil(x - half); k <= last; k++) {
        double      place = own.at + ((double)k - x) * (TWO_PI / (double)n);
        fw_imprint *node = &r->node[((k % n) + n) % n];
        if (fw_rim_imprint(r, &own, place, &slope) > fw_rim_imprint(r, node, place, &slope)) *node = own;
    }
}

double fw_rim_force(const fw_rim *r, double depth, double *chord)
{
    *chord = fw_lens_chord(depth, r->radius, r->structure_radius);
    return fw_crush_force(&r->law, *chord * r->thickness);
}

double fw_rim_stored(const fw_rim *r, double depth, double deepest)
{
    double b, D = fw_larger(depth, deepest), F = fw_rim_force(r, D, &b), N = fw_rim_line(r, depth, D, F);
    return N > 0 ? 0.5 * N * N / fw_rim_stiffness(r, D, F) : 0;
}

static double place_of(double nx, double ny, double angle) { return atan2(ny, nx) - angle; }

double fw_rim_place(const double *y) { return place_of(y[FW_X], y[FW_Y], y[FW_TURN]); }

double fw_crush_find(fw_rim *r, const double *y0, double depth)
{
    double slope, at = fw_rim_place(y0), D = fw_rim_deepest(r, at, &slope);
    if (depth > D) r->own = (fw_imprint){depth, at};
    return r->stored = fw_rim_stored(r, depth, D);
}

/* --- a stage ---------------------------------------------------------------------------------------------------------- */

/* The place under the wall at stage s, and what is remembered there. */
static void look(fw_pair *p, size_t s, double place)
{
    fw_rim *r = p->rim;
    r->deepest[s] = fw_rim_deepest(r, place, &r->slope[s]);
    r->yield[s] = r->fresh_yield = fw_rim_force(r, r->deepest[s], &r->fresh_chord);
    r->chord[s] = r->fresh_chord;
}

/* N with its sign at overlap d that changes by w; chord and yield follow. */
static double signed_force(fw_rim *r, size_t s, double d, double w)
{
    double D = r->deepest[s];
    r->chord[s] = r->fresh_chord, r->yield[s] = r->fresh_yield;
    if (d < D) return fw_smaller(r->yield[s], fw_rim_line(r, d, D, r->yield[s]) + fw_rim_damping(r, D, r->yield[s]) * w);
    r->yield[s] = fw_rim_force(r, d, &r->chord[s]);
    return r->yield[s] + fw_rim_damping(r, d, r->yield[s]) * fw_smaller(0, w);
}

static double cap_of_moment(const fw_rim *r, size_t s, double normal)
{
    double share = r->yield[s] > 0 ? 1 - normal / r->yield[s] : 0;
    return share > 0 ? 0.5 * r->chord[s] * normal * share : 0;
}

void fw_crush_start(fw_pair *p)
{
    fw_rim    *r = p->rim;
    fw_member *a = p->ma;
    r->place = place_of(p->nx, p->ny, a->y0[FW_TURN]);
    look(p, 0, r->place);
    r->line[0] = signed_force(r, 0, p->depth[0], p->rate[0]);
    p->normal[0] = fw_larger(0, r->line[0]);
    p->friction[0] = fw_contact_friction(&p->law, p->normal[0], p->slip[0]);
    double arm = r->lever[0] = 1 / (a->radius + r->structure_radius - p->depth[0]), v = p->nx * a->y0[FW_VY] - p->ny * a->y0[FW_VX];
    double cap = r->hold[0] = cap_of_moment(r, 0, p->normal[0]);
    r->turning[0] = a->y0[FW_SPIN] - v * arm;
    r->moment[0] = fw_larger(-cap, fw_smaller(cap, -r->spin_damping * r->turning[0]));
    double along = p->friction[0] - r->moment[0] * arm;
    a->k[0][FW_VX] += (p->normal[0] * p->nx - along * p->ny) * a->own_inv_mass;
    a->k[0][FW_VY] += (p->normal[0] * p->ny + along * p->nx) * a->own_inv_mass;
    a->k[0][FW_SPIN] -= (p->friction[0] - r->moment[0] / a->radius) * a->turn;
}

/* Impulse of M on the floe: on its spin, and along the wall the other way. */
static void twist(const fw_pair *p, double roll)
{
    fw_member *a = p->ma;
    double     along = -roll * p->rim->arm * a->inv_mass;
    a->V[0] -= along * p->ny, a->V[1] += along * p->nx, a->V[2] += roll * a->turn / a->radius;
}

void fw_crush_linearise(fw_cluster *c, size_t s, double hg)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair         *p = &c->pairs[k];
        fw_rim          *r = p->rim;
        const fw_member *a = p->ma;
        if (!r) continue;
        look(p, s, place_of(p->nx, p->ny, a->r[FW_TURN] + hg * a->U[2]));
        r->hg = hg, r->arm = r->lever[s] = 1 / (a->radius + r->structure_radius - p->depth_star);
        r->roll = hg * r->moment[s - 1];
        twist(p, r->roll);
    }
}

/* d > D that crushes on: d = A - B F(d), in x = sqrt d next to a quadratic, x^2 + B F(x^2) - A = 0. */
static double push_to(const fw_rim *r, double D, double A, double B)
{
    double low = sqrt(D), high = sqrt(A), x = high, b;
    for (int n = 0; n < MAX_NEWTON; n++) {
        double F = fw_rim_force(r, x * x, &b), g = x * x + B * F - A, power = b * r->thickness > FW_CRUSH_LEAST_AREA ? 1 - r->law.exponent : 1;
        double next = x - g / (2 * x + B * power * F / x);
        if (g > 0)
            high = x;
        else
            low = x;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        bool is_done = fabs(next - x) <= 1e-8 * x; /* the one that follows is exact */
        x = next;
        if (is_done) break;
    }
    return x * x;
}

/* d > D that falls, between low and high: false position, Illinois variant. */
static double recede_to(fw_rim *r, size_t s, double A, double B, double low, double high, double rate0, double per_depth)
{
    double f_low = low + B * signed_force(r, s, low, rate0 + low * per_depth) - A, f_high = high + B * signed_force(r, s, high, rate0 + high * per_depth) - A;
    for (int n = 0; n < MAX_NEWTON && fabs(high - low) > 1e-13 * high && f_high != 0; n++) {
        double x = high - f_high * (high - low) / (f_high - f_low), f = x + B * signed_force(r, s, x, rate0 + x * per_depth) - A;
        if ((f > 0) == (f_high > 0))
            f_low *= 0.5;
        else
            low = high, f_low = f_high;
        high = x, f_high = f;
    }
    return high;
}

/* N where d = A - B N and d' = rate0 + d per_depth, d the stage's overlap: N does not fall with d, so there is one. */
static double solve_normal(fw_rim *r, size_t s, double A, double B, double rate0, double per_depth)
{
    double D = r->deepest[s], F = r->yield[s] = r->fresh_yield;
    r->chord[s] = r->fresh_chord;
    double c = fw_rim_damping(r, D, F), K = fw_rim_stiffness(r, D, F) + c * per_depth;
    double N = clamp((fw_rim_line(r, A, D, F) + c * (rate0 + A * per_depth)) / (1 + B * K), F); /* on the line, of slope K in d */
    if (A - B * N <= D && (N > 0 || A <= D)) return N;
    double d = push_to(r, D, A, B);
    if (rate0 + d * per_depth < 0) d = recede_to(r, s, A, B, D, fw_smaller(A, -rate0 / per_depth), rate0, per_depth);
    return clamp(signed_force(r, s, d, rate0 + d * per_depth), INFINITY);
}

static double clip(double x, double cap) { return x > cap ? cap : x < -cap ? -cap : x; }

/* Friction and moment, each viscous up to a cap: rub = clip(as (x roll - slip), cap), roll = clip(ar (x rub - turning), hold), slip and turning as they were
 * without both. A convex pair of equations: the one among the answers with none or one at its cap that contradicts itself least. */
static void solve_along(double as, double ar, double x, double slip, double turning, double cap, double hold, double *rub, double *roll)
{
    double det = 1 - as * ar * x * x, f = -as * (slip + x * ar * turning) / det, m = -ar * (turning + x * as * slip) / det;
    if (fabs(f) <= cap && fabs(m) <= hold) {
        *rub = f, *roll = m;
        return;
    }
    double least = INFINITY;
    *rub = *roll = 0;
    for (int k = 0; k < 4; k++) {
        double sign = k & 1 ? 1 : -1, wrong;
        if (k < 2) {
            f = sign * cap, m = clip(ar * (x * f - turning), hold);
            wrong = fabs(clip(as * (x * m - slip), cap) - f) * x * ar;
        } else {
            m = sign * hold, f = clip(as * (x * m - slip), cap);
            wrong = fabs(clip(ar * (x * f - turning), hold) - m);
        }
        if (wrong < least) least = wrong, *rub = f, *roll = m;
    }
}

double fw_crush_solve(fw_pair *p, size_t s)
{
    fw_rim    *r = p->rim;
    fw_member *a = p->ma;
    double     hg = r->hg, nx = p->nx, ny = p->ny, R = a->radius, wn = a->inv_mass;
    double     free = -(nx * a->V[0] + ny * a->V[1]) + p->push * wn;
    double     rate0 = p->rate_star - p->depth_star / hg;
    double     push = hg * solve_normal(r, s, p->depth_star + hg * (free - p->rate_star), hg * hg * wn, rate0, 1 / hg), dp = push - p->push;
    a->V[0] += dp * nx * wn, a->V[1] += dp * ny * wn;
    p->push = push;
    double v = nx * a->V[1] - ny * a->V[0], w = a->V[2], lazy = a->turn / R;
    double ws = wn + R * a->turn, wr = lazy + r->arm * r->arm * wn, x = r->arm * wn + a->turn;
    double slip = v - R * w - p->rub * ws + r->roll * x, turning = w - v * r->arm - r->roll * wr + p->rub * x;
    double as = p->law.ct * hg / (1 + p->law.ct * hg * ws), ar = r->spin_damping * hg / (1 + r->spin_damping * hg * wr);
    double rub, roll, hold = hg * (r->hold[s] = cap_of_moment(r, s, push / hg));
    if (ar > 0)
        solve_along(as, ar, x, slip, turning, p->mu * push, hold, &rub, &roll);
    else
        rub = clip(-as * slip, p->mu * push), roll = 0;
    double df = rub - p->rub, dm = roll - r->roll;
    a->V[0] -= df * ny * wn, a->V[1] += df * nx * wn, a->V[2] -= df * a->turn;
    twist(p, dm);
    p->rub = rub, r->roll = roll;
    return fw_larger(fabs(dp) * wn, fw_larger(fabs(df) * ws, fabs(dm) * wr * R));
}

void fw_crush_end(fw_cluster *c, size_t s, double inv, bool is_settled)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        fw_rim  *r = p->rim;
        if (!r) continue;
        if (is_settled) fw_crush_solve(p, s);
        const double *V = p->ma->V;
        double        rate = -(p->nx * V[0] + p->ny * V[1]), depth = p->depth_star + r->hg * (rate - p->rate_star);
        r->moment[s] = r->roll * inv;
        r->turning[s] = V[2] - (p->nx * V[1] - p->ny * V[0]) * r->arm;
        r->line[s] = p->push > 0 ? p->push * inv : fw_smaller(0, signed_force(r, s, depth, rate));
    }
}
