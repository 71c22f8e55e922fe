/* One cluster: its step control, and how it grows and shrinks. (One floe alone on the structure: lone.c.)
 *
 * Steps start short after a touch (the force jumps there by c d') and grow as the error allows; a floe that rolls along the
 * structure goes on in steps of half a second. A step ends where a floe lets go of the structure: slip is fast and pressure
 * small there, and path and contact time need the kink. */
#include "kernel/cluster.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/crush.h"
#include "kernel/watch.h"

static const double TURN_AT_END = 0.98; /* share of a step past which a turn of force counts as its end */
static const double SHORT = 0.01;       /* step in 1/w that no turn of force is looked for in */
/* First step after a touch of two floes, over the one after a touch at that speed of the structure, where it is wear as well: there no step
 * was refused and nearly all grew by as much as they may; four times as long a one puts the energy of two floes 1.3 % out. */
static const double BETWEEN_FLOES = 2.5;

void fw_cluster_free(fw_cluster *c)
{
    if (!c) return;
    free(c->members);
    free(c->pairs);
    free(c);
}

void fw_cluster_find_stiffest(fw_cluster *c)
{
    c->omega = c->pace;
    for (size_t k = 0; k < c->n_pairs; k++) c->omega = fw_larger(c->omega, c->pairs[k].law.omega);
}

fw_status fw_cluster_join(fw_cluster *c, const fw_books *books, int32_t body, int32_t *member, fw_msg *m)
{
    FW_TRY(fw_grow(&c->members, &c->member_capacity, c->n_members + 1, sizeof *c->members, "clusters", m));
    const fw_body *b = &books->world->bodies[body];
    fw_member     *e = &c->members[c->n_members];
    *e = (fw_member){.index = body,
                     .radius = b->radius,
                     .turn = b->radius * b->inv_inertia,
                     .drag_per_mass = b->drag * b->inv_mass,
                     .air_per_mass = b->air * b->inv_mass,
                     .spin_per_inertia = b->spin_drag * b->inv_inertia,
                     .own_inv_mass = b->inv_mass,
                     .mass = 1 / b->inv_mass,
                     .inertia = b->inv_inertia > 0 ? 1 / b->inv_inertia : 0,
                     .y0 = {b->x, b->y, b->angle, 0, b->vx, b->vy, b->spin, 0}};
    *member = (int32_t)c->n_members++;
    return FW_OK;
}

fw_status fw_cluster_merge(fw_cluster *into, fw_cluster *from, fw_msg *m)
{
    size_t n = into->n_members + from->n_members, n_pairs = into->n_pairs + from->n_pairs;
    FW_TRY(fw_grow(&into->members, &into->member_capacity, n, sizeof *into->members, "clusters", m));
    FW_TRY(fw_grow(&into->pairs, &into->pair_capacity, n_pairs + 1, sizeof *into->pairs, "clusters", m));
    memcpy(into->members + into->n_members, from->members, from->n_members * sizeof *into->members);
    for (size_t k = 0; k < from->n_pairs; k++) {
        fw_pair *p = &into->pairs[into->n_pairs + k];
        *p = from->pairs[k];
        p->a += (int32_t)into->n_members;
        if (p->b != FW_WALL) p->b += (int32_t)into->n_members;
    }
    into->h = fw_smaller(into->h, from->h);
    into->omega = fw_larger(into->omega, from->omega);
    into->n_members = n, into->n_pairs = n_pairs;
    into->dissipated += from->dissipated;
    from->n_members = from->n_pairs = 0;
    return FW_OK;
}

static void mark_touched(const fw_books *books, fw_member *e)
{
    fw_body *b = &books->world->bodies[e->index];
    e->n_pairs++;
    books->world->n_touched += !b->is_touched;
    b->is_touched = true;
}

fw_status fw_cluster_close(fw_cluster *c, const fw_books *books, int32_t a, int32_t other, int32_t candidate,
                           double rate, fw_msg *m)
{
    const fw_setup *set = books->setup;
    FW_TRY(fw_grow(&c->pairs, &c->pair_capacity, c->n_pairs + 1, sizeof *c->pairs, "clusters", m));
    fw_member *ea = &c->members[a], *eb = other == FW_WALL ? NULL : &c->members[other];
    fw_pair   *p = &c->pairs[c->n_pairs++];
    *p = (fw_pair){.a = a, .b = other, .t_touch = c->t0, .candidate = candidate};
    p->law = fw_contact_law_apply(eb ? &set->floe_contact : &set->contact, 1 / (ea->own_inv_mass + (eb ? eb->own_inv_mass : 0)));
    if (fw_is_crush(set) || fw_is_from_pressure(set))
        FW_TRY(fw_crush_close(p, set, &books->world->bodies[ea->index], eb ? &books->world->bodies[eb->index] : NULL, m));
    p->mu = p->law.mu;
    c->omega = fw_larger(c->omega, p->law.omega);
    mark_touched(books, ea);
    if (eb) mark_touched(books, eb);
    books->world->ledger.touches++;
    /* Rims that overlap when they are found to touch (at the start of a scene, or late) bring the energy of their spring along. */
    double depth = fw_larger(0, fw_world_overlap(books->world, ea->index, eb ? eb->index : FW_WALL));
    books->world->ledger.inflow += 0.5 * p->law.k * depth * depth;
    if (fw_rim_of(p)) books->world->ledger.inflow += fw_crush_find(fw_rim_of(p), ea->y0, depth);
    /* A gentle touch is a small jump: the local error of a step h grows with the jump times h^2, so its first step may be
     * longer. On the structure the pressure's start is wear, whatever the speed. */
    double share = eb ? BETWEEN_FLOES * cbrt(set->velocity_scale / fw_larger(rate, 1e-3 * set->velocity_scale)) : 1;
    c->h = fw_smaller(c->h, set->first_step / p->law.omega * share);
    if (!eb) {
        fw_body *b = &books->world->bodies[ea->index];
        if (c->t0 - b->t_wall > 1) {
            b->t_hit = c->t0;
            if (books->wear->is_open) books->world->ledger.hits++;
        }
        b->t_wall = c->t0;
    }
    return FW_OK;
}

void fw_cluster_restart(fw_cluster *c, const fw_books *books)
{
    fw_stage_start(c, books);
    c->t1 = c->t0;
}

/* Slip over the velocity scale that is none: where symmetry holds a floe in its place slip is rounding, and so is its wear; asked to be right to a
 * share of itself it took 30 times the steps. */
static const double NO_SLIP = 1e-5;

/* What the velocity's error does to the wear of a floe on the structure, as a share of the wear of its touch so far. A step that is
 * harmless for the motion can spoil it: slip that has nearly died, force that has nearly gone, with errors as large as they are.
 * Load ~ N / sqrt(d) |vt|: the law with exponent 1, near enough for a weight. Trapezoid over the step's ends. */
static double wear_error(const fw_cluster *c, fw_pair *p, const fw_setup *set, double h)
{
    const fw_method *me = set->method;
    const fw_member *a = &c->members[p->a];
    size_t           last = me->n_stages - 1;
    double           e[3], en, et, load = 0, wrong = 0;
    fw_pair_errors(p, a, me, h, e, &en, &et);
    for (size_t s = 0; s <= last; s += last) {
        size_t at = s == 0 && p->since_touch == 0 ? 1 : s; /* at the touch itself d = 0 */
        double n = p->normal[at], d = p->depth[at], slip = fabs(p->slip[s]) + NO_SLIP * set->velocity_scale;
        if (!(n > 0) || !(d > 0)) continue;
        double weight = 0.5 * h / sqrt(d);
        load += weight * n * slip;
        wrong += weight * (p->law.c * en * slip + n * et);
    }
    p->load_tried = load;
    return p->load + load > 0 ? wrong / (p->load + load) : 0;
}

/* A stage without force between two ends with one: its place in the polynomial is no force that ever was. */
static bool has_hole(const fw_pair *p, size_t last)
{
    if (!(p->normal[0] > 0) || !(p->normal[last] > 0)) return false;
    for (size_t s = 1; s < last; s++)
        if (!(p->normal[s] > 0)) return true;
    return false;
}

double fw_member_fastest(const fw_member *m, const fw_flow *flow, double inv_h)
{
    const double *v0 = m->y0 + FW_VX, *v1 = m->y1 + FW_VX, ux = flow->ux, uy = flow->uy;
    double        mx = 3 * (m->y1[FW_X] - m->y0[FW_X]) * inv_h - v0[0] - v1[0],
           my = 3 * (m->y1[FW_Y] - m->y0[FW_Y]) * inv_h - v0[1] - v1[1];
    double r0 = (v0[0] - ux) * (v0[0] - ux) + (v0[1] - uy) * (v0[1] - uy), r1 = (v1[0] - ux) * (v1[0] - ux) + (v1[1] - uy) * (v1[1] - uy);
    return sqrt(fw_larger(fw_larger(r0, r1), (mx - ux) * (mx - ux) + (my - uy) * (my - uy)));
}

/* One step h on trial: local error over what is tolerated, of velocity and of wear. */
static double attempt(fw_cluster *c, const fw_books *books, double h)
{
    const fw_setup  *set = books->setup;
    const fw_method *me = set->method;
    size_t           last = me->n_stages - 1;
    bool is_solved = true;
    for (size_t s = 1; s <= last; s++) is_solved &= fw_stage_solve(c, books, s, h);
    double hg = h * me->gamma, worst = 0, inv = 1 / h;
    bool   is_finite = true;
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        double     e[4] = {0, 0, 0, 0};
        m->y1[FW_X] = m->r[FW_X] + hg * m->k[last][FW_X], m->y1[FW_Y] = m->r[FW_Y] + hg * m->k[last][FW_Y];
        for (int q = 0; q < 4; q++) m->y1[FW_VX + q] = m->k[last][q];
        for (size_t s = 0; s <= last; s++)
            for (int q = 0; q < 4; q++) e[q] += me->e[s] * m->k[s][FW_VX + q];
        double err = h * fw_larger(fw_length(e[0], e[1]), m->radius * fabs(e[2]));
        worst = fw_larger(worst, err);
        is_finite &= err < INFINITY;
        m->fastest = fw_member_fastest(m, &set->flow, inv);
    }
    if (fw_is_crush(set))
        for (size_t i = 0; i < c->n_members; i++) c->members[i].y1[FW_TURN] = c->members[i].r[FW_TURN] + hg * c->members[i].k[last][FW_TURN];
    worst /= set->tolerance * set->velocity_scale;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        if (p->b != FW_WALL) continue;
        worst = fw_larger(worst, fw_rim_of(p) ? fw_crush_error(c, p, set, h, NO_SLIP) : wear_error(c, p, set, h) / set->wear_tolerance);
        if (has_hole(p, last)) worst = fw_larger(worst, 6); /* halves the step */
    }
    if (!is_solved) worst = fw_larger(worst, 2); /* shorter steps are solved sooner */
    return is_finite ? worst : NAN;
}

double fw_cluster_lets_go(const fw_cluster *c, const fw_pair *p, const fw_method *me)
{
    const fw_member *a = &c->members[p->a];
    double           nx = p->dir[0][0], ny = p->dir[0][1], r = fw_length(a->y0[FW_X], a->y0[FW_Y]);
    double           along = nx * a->y0[FW_VY] - ny * a->y0[FW_VX]; /* along the wall: it turns the normal */
    double           rate_slope = -(nx * a->k[0][FW_VX] + ny * a->k[0][FW_VY]) - along * along / r;
    double           force = fw_pair_signed_normal(p, 0), slope = p->law.k * p->rate[0] + p->law.c * rate_slope;
    size_t           free = me->n_stages - 1;
    for (size_t s = 1; s + 1 < me->n_stages; s++)
        if (fw_pair_signed_normal(p, s) <= 0 && me->c[s] < me->c[free]) free = s;
    double t = me->c[free] * (c->t1 - c->t0), end = fw_pair_signed_normal(p, free), chord = t * force / (force - end);
    double q = (end - force - slope * t) / (t * t), d = slope * slope - 4 * q * force;
    /* smallest positive root of force + slope t + q t^2, without cancellation */
    double root = d >= 0 ? 2 * force / (sqrt(d) - slope) : chord;
    return root > 0 && root <= t ? root : chord;
}

/* When in the tried step does the structure's force come back on a floe that overlaps and moves off [s after t0]? The step's end: it does
 * not. Between its last stage without and its first one with force. */
static double comes_back(const fw_cluster *c, const fw_pair *p, const fw_method *me)
{
    double h = c->t1 - c->t0, without = 0, with = 2, f0 = fw_pair_signed_normal(p, 0), f1 = 0;
    for (size_t s = 1; s < me->n_stages; s++)
        if (p->depth[s] > 0 && fw_pair_signed_normal(p, s) > 0 && me->c[s] < with)
            with = me->c[s], f1 = fw_pair_signed_normal(p, s);
    for (size_t s = 1; s < me->n_stages; s++)
        if (me->c[s] < with && me->c[s] > without) without = me->c[s], f0 = fw_pair_signed_normal(p, s);
    return with > 1 ? h : h * (without + (with - without) * f0 / (f0 - f1));
}

/* When in the tried step does the structure let go of a floe, or press it again, after t0? The step's end: nowhere, or not worth a cut.
 * Unnoticed, a floe that bounces and is pressed again by the current loses all of that second load (9 % of a grazing hit). */
static double turn_of_force(const fw_cluster *c, const fw_setup *set, bool *is_back)
{
    size_t last = set->method->n_stages - 1;
    double first = c->t1 - c->t0;
    *is_back = false;
    for (size_t k = 0; k < c->n_pairs; k++) {
        const fw_pair *p = &c->pairs[k];
        if (p->b != FW_WALL) continue;
        if (fw_rim_of(p)) {
            double kink = fw_crush_turn(c, p, set, c->t1 - c->t0);
            if (kink < first && kink * p->law.omega > SHORT) first = kink, *is_back = false;
            continue;
        }
        double from = fw_pair_signed_normal(p, 0), to = fw_pair_signed_normal(p, last), at = first;
        if (from <= 0)
            at = comes_back(c, p, set->method);
        else if (to < -0.2 * from && from > 0.1 * set->tolerance * p->law.c * set->velocity_scale)
            /* A little past it, so that the contact does open there: at 1.02 the remnant took a step of its own in half of all hits. */
            at = 1.2 * fw_cluster_lets_go(c, p, set->method);
        /* at once: it is back already */
        if (at < first && at * p->law.omega > SHORT) first = at, *is_back = from <= 0;
    }
    return first;
}

/* A floe that overlaps the structure without force may be pressed again at any moment; looking that often costs next to nothing. */
static double careful(const fw_cluster *c, double h)
{
    for (size_t k = 0; k < c->n_pairs; k++) {
        const fw_pair *p = &c->pairs[k];
        if (p->b == FW_WALL && !fw_rim_of(p) && p->depth[0] > 0 && !(p->normal[0] > 0)) h = fw_smaller(h, 1 / p->law.omega);
    }
    return h;
}

fw_status fw_cluster_not_finite(const fw_cluster *c, const fw_books *books, fw_msg *msg)
{
    size_t i = 0;
    while (i + 1 < c->n_members && isfinite(c->members[i].y1[FW_VX] + c->members[i].y1[FW_VY] + c->members[i].y1[FW_SPIN])) i++;
    const fw_body *b = &books->world->bodies[c->members[i].index];
    return fw_fail(msg, FW_E_NUMERIC, "the state of floe %llu (D %.3g m, h %.2g m) is not finite after t = %.6g s", (unsigned long long)b->name,
                   2 * b->radius, b->thickness, c->t0);
}

/* err^(-1 / order), without a power */
static double step_factor(const fw_method *me, double err)
{
    return 1 / (me->error_order == 3 ? cbrt(err) : sqrt(sqrt(err)));
}

/* Shorter and shorter until the error is within the tolerance and no watch-dog barks. */
static fw_status attempt_until_good(fw_cluster *c, const fw_books *books, double *h, double *err, fw_msg *msg)
{
    const fw_method *me = books->setup->method;
    for (;;) {
        *err = attempt(c, books, *h);
        if (*err <= 1) {
            fw_books_weigh(c, books->setup, *h);
            if (!fw_watch_step(c, books->setup, *h)) return FW_OK;
            *h *= 0.5;
            books->world->ledger.refined++;
            continue;
        }
        if (*h * c->omega <= FW_SHORTEST) break;
        double f = isfinite(*err) ? fw_larger(0.2, 0.9 * step_factor(me, *err)) : 0.1;
        *h *= fw_smaller(f, 0.9);
        books->world->ledger.rejected++;
    }
    if (!isfinite(*err)) return fw_cluster_not_finite(c, books, msg);
    fw_books_weigh(c, books->setup, *h);
    return FW_OK;
}

fw_status fw_cluster_try(fw_cluster *c, const fw_books *books, double limit, fw_msg *msg)
{
    if (fw_lone_is(c, books)) return fw_lone_try(c, books, limit, msg);
    const fw_setup *set = books->setup;
    double          left = limit - c->t0;
    if (!(c->h < INFINITY)) c->h = set->first_step / c->omega;
    c->h = fw_smaller(c->h, set->max_step / set->velocity_scale);
    c->h = careful(c, c->h);
    double h = fw_step_without_sliver(c->h, left), wanted = c->h, tried = h, err;
    FW_TRY(attempt_until_good(c, books, &h, &err, msg));
    if (h < tried) wanted = h;
    c->t1 = c->t0 + h;
    bool   is_back = false;
    double turn = h * c->omega > SHORT ? turn_of_force(c, set, &is_back) : h;
    if (turn < TURN_AT_END * h) {
        h = turn;
        FW_TRY(attempt_until_good(c, books, &h, &err, msg));
    }
    double f = err > 0 ? 0.9 * step_factor(set->method, err) : set->growth;
    f = fw_smaller(set->growth, f);
    c->h = h < wanted ? fw_larger(wanted, h * f) : h * f;
    if (is_back) c->h = set->first_step / c->omega;
    c->t1 = h == left ? limit : c->t0 + h;
    return FW_OK;
}

fw_status fw_cluster_land(fw_cluster *c, const fw_books *books, double t, fw_msg *msg)
{
    if (fw_lone_is(c, books)) return fw_lone_land(c, books, t, msg);
    double err = attempt(c, books, t - c->t0);
    if (!isfinite(err)) return fw_cluster_not_finite(c, books, msg);
    c->is_weighed = false;
    c->t1 = t;
    return FW_OK;
}
