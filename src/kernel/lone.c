/* One floe on the structure, by closed forms. Such floes are nearly all the work of a thin field.
 *
 * In polar coordinates about the structure (d overlap, u = d', v along the wall, r distance of the centres, s = v - R w slip; forces as
 * in cluster.c) what is stiff is linear, with constant coefficients between two events, and what is left is slow:
 *
 *     d'' + (c/m) d' + (k/m) d = g(t)              g = -v^2/r - Fn/m       while pressed, else  d'' = g
 *     s' = Ft/m_s + f(t)                           f = Fw/m + u v/r        1/m_s = 1/m + R^2/I
 *     p' = (1 - a) f(t),  p = v - a s              a = m_s/m: friction cannot change p
 *     (water that slows spin by w' = -q/R takes q from f and gives it to p' once more)
 *     angle' = v/r
 *
 * Fn, Fw: drag outward and along the wall; N = k d + c u. Friction, one of three:
 *     viscous   Ft = -ct s                         s' = -q s + f,  q = ct/m_s
 *     sliding   Ft = -sign(s) mu N                 s' = -sign(s) (mu/a) (g - u') + f: N/m = g - u', so s follows from u
 *     none      no force, mu = 0 or ct = 0
 *
 * g and f are parabolas over a step through its ends and its middle, where they are found in sweeps (Picard): each sweep solves all
 * of the above exactly for the forcing of the sweep before. A step so follows a whole impact at any stiffness and any damping ratio; its
 * length is set by how drag changes, some 1/w after a touch and ten times that while the floe rolls. It ends where another form begins to
 * hold: N falls to zero or comes back, the rims part, slip leaves or reaches Coulomb's cap. Those instants are roots of the closed forms.
 *
 * Good for one contact only: a second one couples two normals that turn against each other, and that is the method of stage.c. */
#include "kernel/lone.h"

#include <float.h>
#include <math.h>

#include "kernel/cluster.h"
#include "kernel/lone_forms.h"

enum { TERMS = FW_LONE_TERMS, MAX_SWEEPS = 3 };

/* Below this rate x span a power series is exact to rounding, and the closed form would cancel. */
static const double SHORT = 0.3;
/* Forces below this share of m w x velocity scale are zero: their slope says what comes. */
static const double TINY = 1e-10;

/* Step control, as multiples of the tolerances that the method of stage.c is given: there they leave more error behind. Measured on
 * 20000 random hits, 99 % within, worst (ARK3 with the same tolerances in brackets):
 *              depth                                depth x wall       energy, worst     evaluations
 *      1 %     1.0e-3, 4e-3  (1.0e-2, 7e-2)         9e-4   (5.8e-3)    6.8e-3 (4.5e-2)    74  (77)
 *    0.1 %     2.7e-4, 9e-3  (7.8e-4, 2e-2)         1.7e-4 (7.8e-4)    6.1e-4 (1.6e-3)   144 (156)
 * What grows with the hits is how well a glance's second press is met: it binds velocity at the first levels. */
static const double OF_VELOCITY = 5, OF_WEAR = 16;
/* Relative error of v over wear tolerance: near the stagnation point a floe doubles v every second, and its wear to come with it. Without: 7 %
 * in one of 3000; at four times as much the energy balance of a hit is three times as far off, for 3 % fewer evaluations. */
static const double OF_WAY = 4.5;
static const double SWEPT = 0.12;  /* sweeps end when they change less than this share of the tolerance */
static const double LEFT = 0.6;    /* of the last sweep's change: what further sweeps might do */
static const double BULGE = 0.016; /* largest integral of the second Legendre polynomial on [0, x] */
/* All of the following in 1/w. */
static const double FIRST_STEP = 0.5; /* after a touch: nothing is known of the forcing yet */
static const double LONGEST_DECAY = 8,
                    LONGEST_RINGING = 1; /* steps meanwhile; the latter where the floe goes to and fro */
bool fw_lone_is(const fw_cluster *c, const fw_books *b)
{
    return b->setup->is_lone_exact && c->n_pairs == 1 && c->n_members == 1 && c->pairs[0].b == FW_WALL;
}

/* --- forcing ---------------------------------------------------------------------------------------------------------- */

/* Overlap under a forcing: a parabola, or a series in t / span from (d, u). */
static void solve_swing(const fw_lone *L, const double *push, double d, double u, double *P)
{
    double h2 = L->span * L->span, z2 = L->omega2 * h2, damping = 2 * L->half_damping * L->span;
    if (!L->is_short) {
        double inv = 1 / z2;
        P[2] = h2 * push[2] * inv;
        P[1] = (h2 * push[1] - 2 * damping * P[2]) * inv;
        P[0] = (h2 * push[0] - damping * P[1] - 2 * P[2]) * inv;
        return;
    }
    P[0] = d, P[1] = u * L->span;
    for (int n = 0; n + 2 < TERMS; n++)
        P[n + 2] = ((n < 3 ? h2 * push[n] : 0) - damping * (n + 1) * P[n + 1] - z2 * P[n]) / ((n + 1) * (n + 2));
}

/* Likewise viscous slip. */
static void solve_creep(const fw_lone *L, const double *drive, double s, double *P)
{
    double h = L->span, z = L->relaxation * h;
    if (!L->is_short_slip) {
        double inv = 1 / z;
        P[2] = h * drive[2] * inv;
        P[1] = (h * drive[1] - 2 * P[2]) * inv;
        P[0] = (h * drive[0] - P[1]) * inv;
        return;
    }
    P[0] = s;
    for (int n = 0; n + 1 < TERMS; n++) P[n + 1] = ((n < 3 ? h * drive[n] : 0) - z * P[n]) / (n + 1);
}

static void solve(fw_lone *L)
{
    if (L->presses) solve_swing(L, L->by.push, L->from.depth, L->from.rate, L->swing);
    if (L->rubs && L->slides == 0) solve_creep(L, L->by.drive, L->from.slip, L->creep);
}

/* Angle' = p/r + a s/r, and s may have decayed within a tenth of the step: with S its integral a s/r = (a S/r)' - a S u/r^2, so
 * orbit = p/r - a S u/r^2 is slow again. */
static inline __attribute__((always_inline)) void force(const fw_lone *L, const fw_setup *set, const fw_member *m, const fw_lone_state *y, double *push,
                         double *drive, double *orbit, double *twist)
{
    double nx, ny, out, along, inv = y->per_reach, w = y->along * inv;
    normal_at(L, y->turn, &nx, &ny);
    drag_at(set, m, nx, ny, y, &out, &along);
    *push = -y->along * w - out, *drive = along + y->rate * w;
    *orbit = inv * (y->along - L->share * (y->slip + y->rate * y->slid * inv));
    if (!FW_OPTIONAL_EFFECTS || !L->has_twist) return;
    *twist = spin_drag_at(set, m, nx, ny, y);
    *drive -= *twist;
}

/* The parabola through values at the start, the middle and the end. */
static inline void through(const double *v, double *c)
{
    c[0] = v[0], c[1] = 4 * v[1] - 3 * v[0] - v[2], c[2] = 2 * (v[0] + v[2]) - 4 * v[1];
}

/* The parabola of the step before, seen from its end: what is expected of this one. */
static void expect(const fw_lone *L, const double *was, double *c)
{
    double x = L->before_end, ratio = L->before_span > 0 ? L->span / L->before_span : 0;
    c[1] = (was[1] + 2 * x * was[2]) * ratio, c[2] = was[2] * ratio * ratio;
}

/* --- one step --------------------------------------------------------------------------------------------------------- */

static void start(fw_lone *L, const fw_cluster *c, const fw_setup *set)
{
    const fw_member *m = &c->members[0];
    const fw_pair   *p = &c->pairs[0];
    const double    *v = m->y0 + FW_VX, w_slip = m->own_inv_mass + m->radius * m->turn;
    double           x = m->y0[FW_X], y = m->y0[FW_Y], r2 = x * x + y * y, r = sqrt(r2), inv = 1 / r,
           reach = m->radius + set->structure_radius;
    fw_lone_state *o = &L->from;
    L->nx = x * inv, L->ny = y * inv;
    o->reach = r, o->per_reach = inv,
    o->depth = (reach * reach - r2) / (reach + r); /* reach - r without cancellation */
    o->rate = -(L->nx * v[0] + L->ny * v[1]);
    o->along = L->nx * v[1] - L->ny * v[0];
    o->slip = o->along - m->radius * v[2];
    o->slid = o->turn = 0;
    o->normal = p->law.k * o->depth + p->law.c * o->rate;
    L->share = m->own_inv_mass / w_slip;
    L->carried = o->along - L->share * o->slip;
    L->half_damping = 0.5 * p->law.c * m->own_inv_mass, L->omega2 = p->law.k * m->own_inv_mass;
    L->split = L->half_damping * L->half_damping - L->omega2;
    L->has_twist = fw_has_spin_drag(set) && m->inertia > 0;
    L->relaxation = p->law.ct * w_slip, L->per_relaxation = 1 / L->relaxation, L->kick = p->mu / L->share;
}

/* Which forms hold from the start on? On the edge between two, where forces are continuous, the slope decides. */
static void choose(fw_lone *L, const fw_pair *p, double inv_mass, double scale)
{
    const fw_lone_state        *o = &L->from;
    const fw_contact_constants *law = &p->law;
    double                      tiny = TINY * law->k / law->omega * scale, g = L->by.push[0], f = L->by.drive[0];
    L->presses = o->normal > tiny || (o->normal > -tiny && law->k * o->rate + law->c * g > 0);
    L->rubs = L->presses && p->mu > 0 && law->ct > 0;
    L->slides = 0;
    if (!L->rubs) return;
    double n = fw_larger(o->normal, 0), over = law->ct * fabs(o->slip) - p->mu * n;
    double sign = o->slip > 0 ? 1 : o->slip < 0 ? -1 : f > 0 ? 1 : -1;
    if (fabs(over) <= tiny)
        over = law->ct * sign * (f - L->relaxation * o->slip) -
               p->mu * (law->k * o->rate + law->c * (g - n * inv_mass));
    if (over > 0) L->slides = sign;
}

/* What the forcing's curvature does to rate and slip by the end: as much as a straight forcing would be wrong. The part of a parabola that no
 * straight line has is the second Legendre polynomial. */
static void curvature(const fw_lone *L, decay end, double *rate, double *slip)
{
    double push[3], drive[3], P[TERMS], depth, slid;
    for (int k = 0; k < 3; k++) {
        double legendre = k == 0 ? 1.0 / 6 : k == 1 ? -1 : 1;
        push[k] = legendre * L->by.push[2], drive[k] = legendre * L->by.drive[2];
    }
    *rate = *slip = 0;
    if (!L->presses) return;
    solve_swing(L, push, 0, 0, P);
    swing_at(L, P, 0, 0, 1, end, &depth, rate);
    if (!L->rubs) return;
    if (L->slides != 0) {
        *slip = L->kick * *rate;
        return;
    }
    solve_creep(L, drive, 0, P);
    creep_at(L, P, 0, 1, end, 0, slip, &slid);
}

/* Local error over what is tolerated, of velocity and of the touch's wear (wear_error in cluster.c has the reasons). last: the end as the
 * sweep before had it. */
static double error_of(const fw_lone *L, const fw_pair *p, const fw_setup *set, const fw_lone_state *at,
                       const fw_lone_state *last, decay end)
{
    double h = L->span, en, et, ev = LEFT * fabs(at[2].along - last->along) + BULGE * h * fabs(L->by.drive[2]);
    curvature(L, end, &en, &et);
    en = fabs(en) + LEFT * fabs(at[2].rate - last->rate), et = fabs(et) + LEFT * fabs(at[2].slip - last->slip);
    double err = fw_larger(en, fw_larger(et, ev)) / (OF_VELOCITY * set->tolerance * set->velocity_scale);
    if (!L->presses) return err;
    double load = 0, wrong = 0;
    for (int j = 0; j < 3; j++) {
        const fw_lone_state *y = &at[j == 0 && p->since_touch == 0 ? 1 : j]; /* at the touch itself d = 0 */
        if (!(y->normal > 0) || !(y->depth > 0)) continue;
        double weight = (j == 1 ? 4.0 / 6 : 1.0 / 6) * h / sqrt(y->depth), slip = fabs(at[j].slip);
        load += weight * y->normal * slip;
        wrong += weight * (p->law.c * en * slip + y->normal * et);
    }
    if (p->load + load > 0) err = fw_larger(err, wrong / (p->load + load) / (OF_WEAR * set->wear_tolerance));
    double along = fw_larger(fabs(at[0].along), fabs(at[2].along)) + 1e-6 * set->velocity_scale;
    return fw_larger(err, ev / along / (OF_WAY * set->wear_tolerance));
}

/* The start of the next step: state, forcing and forms. */
static void begin(fw_cluster *c, const fw_books *b)
{
    const fw_member *m = &c->members[0];
    fw_lone         *L = &c->lone;
    start(L, c, b->setup);
    force(L, b->setup, m, &L->from, &L->by.push[0], &L->by.drive[0], &L->by.orbit[0], &L->by.twist[0]);
    b->world->ledger.force_evaluations++;
    choose(L, &c->pairs[0], m->own_inv_mass, b->setup->velocity_scale);
}

/* One step h on trial; event: when its forms cease to hold, INFINITY: not in it. */
static double attempt(fw_cluster *c, const fw_books *b, double h, double *event)
{
    const fw_setup  *set = b->setup;
    const fw_member *m = &c->members[0];
    const fw_pair   *p = &c->pairs[0];
    fw_lone         *L = &c->lone;
    fw_lone_state    at[3], last;
    double           enough = SWEPT * OF_VELOCITY * set->tolerance * set->velocity_scale;
    double           g[3] = {L->by.push[0]}, f[3] = {L->by.drive[0]}, o[3] = {L->by.orbit[0]}, q[3] = {L->by.twist[0]};
    L->span = h, L->per_span = 1 / h;
    expect(L, L->before.push, L->by.push);
    expect(L, L->before.drive, L->by.drive);
    expect(L, L->before.orbit, L->by.orbit);
    if (FW_OPTIONAL_EFFECTS && L->has_twist) expect(L, L->before.twist, L->by.twist);
    L->is_short = fw_larger(p->law.omega, 2 * L->half_damping) * h < SHORT;
    L->is_short_slip = L->relaxation * h < SHORT;
    decay middle = decay_at(L, 0.5 * h), end = later(L, middle, middle);
    at[0] = L->from;
    solve(L);
    state_at(L, &p->law, h, end, &at[2]);
    for (int n = 0; n < MAX_SWEEPS; n++) {
        state_at(L, &p->law, 0.5 * h, middle, &at[1]);
        for (int j = 1; j < 3; j++) force(L, set, m, &at[j], &g[j], &f[j], &o[j], &q[j]);
        b->world->ledger.force_evaluations += 2;
        through(g, L->by.push);
        through(f, L->by.drive);
        through(o, L->by.orbit);
        if (FW_OPTIONAL_EFFECTS && L->has_twist) through(q, L->by.twist);
        solve(L);
        last = at[2];
        state_at(L, &p->law, h, end, &at[2]);
        double change = fw_larger(fabs(at[2].rate - last.rate), fabs(at[2].slip - last.slip));
        if (fw_larger(change, fabs(at[2].along - last.along)) <= enough) break;
    }
    L->end = at[2];
    /* nobody gets here but by a step much too long, and behind the centre the forms would go on */
    if (!(at[2].reach > 0.5 * set->structure_radius && isfinite(at[2].rate + at[2].slip + at[2].turn))) return NAN;
    *event = fw_lone_first_edge(L, p, at);
    double err = error_of(L, p, set, at, &last, end);
    /* three looks at a period see no curvature */
    double longest = L->half_damping < 0.5 * p->law.omega ? LONGEST_RINGING : LONGEST_DECAY;
    return fw_lone_rings(L, p) && h * p->law.omega > 1.01 * longest ? fw_larger(err, 2) : err;
}

/* The tried step ends after `length`: what the rest of the kernel needs to know of it. */
static void finish(fw_cluster *c, const fw_books *b, double length)
{
    fw_lone      *L = &c->lone;
    fw_member    *m = &c->members[0];
    fw_pair      *p = &c->pairs[0];
    size_t        last = b->setup->method->n_stages - 1;
    double        nx, ny;
    fw_lone_state y;
    L->length = length;
    if (length == L->span)
        y = L->end;
    else
        state_at(L, &p->law, length, decay_at(L, length), &y);
    normal_at(L, y.turn, &nx, &ny);
    m->y1[FW_X] = y.reach * nx, m->y1[FW_Y] = y.reach * ny, m->y1[2] = m->y1[3] = 0;
    m->y1[FW_VX] = -y.rate * nx - y.along * ny, m->y1[FW_VY] = -y.rate * ny + y.along * nx;
    m->y1[FW_SPIN] = m->inertia > 0 ? (y.along - y.slip) / m->radius : m->y0[FW_SPIN], m->y1[7] = 0;
    m->fastest = fw_member_fastest(m, &b->setup->flow, 1 / length);
    p->depth[0] = L->from.depth, p->rate[0] = L->from.rate, p->slip[0] = L->from.slip;
    p->depth[last] = y.depth, p->rate[last] = y.rate, p->slip[last] = y.slip;
    p->normal[0] = L->presses ? fw_larger(0, L->from.normal) : 0;
    p->normal[last] = L->presses ? fw_larger(0, y.normal) : 0;
    p->dir[last][0] = nx, p->dir[last][1] = ny;
    if (!L->presses && y.rate < 0 &&
        y.depth <= 1e-12 * m->radius) /* the rims part: let_go() asks for less than nothing */
        p->depth[last] = fw_smaller(y.depth, -DBL_MIN);
}

/* The error falls like h^3 or h^4 (stiff or not): the fourth root is the careful one for growing, and cheap. */
static double step_factor(double err) { return 0.9 / sqrt(sqrt(err)); }

fw_status fw_lone_try(fw_cluster *c, const fw_books *b, double limit, fw_msg *msg)
{
    const fw_setup *set = b->setup;
    fw_lone        *L = &c->lone;
    fw_pair        *p = &c->pairs[0];
    double          left = limit - c->t0, omega = p->law.omega, event = INFINITY, err;
    bool            follows = L->t1 == c->t0 && p->since_touch > 0; /* else nothing is known of the forcing */
    if (follows)
        L->before = L->by, L->before_span = L->span, L->before_end = L->length * L->per_span;
    else
        L->before = (fw_lone_forcing){{0}, {0}, {0}, {0}}, L->before_span = L->before_end = 0;
    begin(c, b);
    if (!(c->h < INFINITY) || p->since_touch == 0) c->h = FIRST_STEP / omega;
    c->h = fw_smaller(c->h, set->max_step / set->velocity_scale);
    double h = fw_step_without_sliver(c->h, left), wanted = c->h, tried = h;
    for (;;) {
        err = attempt(c, b, h, &event);
        if (err <= 1 || h * omega <= FW_SHORTEST) break;
        double f = isfinite(err) ? fw_smaller(0.9, fw_larger(0.2, step_factor(err))) : 0.1;
        if (event * 1.05 < f * h && event * omega > FW_SHORTEST) f = event * 1.05 / h;
        h *= f;
        b->world->ledger.rejected++;
    }
    if (!isfinite(err)) return fw_cluster_not_finite(c, b, msg);
    if (h < tried) wanted = h;
    double f = err > 0 ? fw_smaller(set->growth, step_factor(err)) : set->growth;
    c->h = h < wanted ? fw_larger(wanted, h * f) : h * f;
    double length = event < h ? fw_larger(event, fw_smaller(h, FW_SHORTEST / omega)) : h;
    finish(c, b, length);
    c->t1 = length == left ? limit : c->t0 + length;
    L->t1 = c->t1;
    return FW_OK;
}

fw_status fw_lone_land(fw_cluster *c, const fw_books *b, double t, fw_msg *msg)
{
    double h = t - c->t0, event;
    /* An earlier end needs no new step: the forms hold at any time within the span. */
    if (!(h <= c->lone.span * (1 + 1e-9)) && !isfinite(attempt(c, b, h, &event))) return fw_cluster_not_finite(c, b, msg);
    finish(c, b, h);
    c->t1 = c->lone.t1 = t;
    return FW_OK;
}
