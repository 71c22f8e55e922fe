/* The order of events: a step of a cluster ends, or two rims touch; whichever is first.
 *
 *   step ends    it is committed; contacts that let go are taken out, the cluster may fall apart; next step on trial
 *   rims touch   both sides are brought to that very instant (a cluster's step is cut and tried again, a free floe flies there,
 *                untouched ice wakes), become one cluster, and start anew with short steps
 *
 * Nobody is committed past anybody's next event, so a step can always be cut where somebody else comes in. Nobody waits for a
 * smaller neighbour either: each cluster has a pace of its own, and floes in no contact cost nothing between two touches. */
#include "kernel/kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "kernel/inside.h"
#include "kernel/strip.h"

/* Floes squeezed out from between others have been seen at up to twice the current's speed relative to the water; who is faster than
 * this is checked without the shortcut that it bounds. */
static const double SWIFT = 1.5;

/* Less than a millisecond of work, so that messages of other ranks get on. */
enum { QUIET_EVENTS = 256 };
static const double QUIET_EVALUATIONS = 5e3;

fw_status fw_kernel_create(fw_kernel **out, const fw_setup *setup, fw_msg *m)
{
    FW_CHECK(setup->velocity_scale > 0 && setup->horizon > 0 && setup->tolerance > 0 && setup->margin > 0, m, FW_E_ARG,
             "kernel: velocity scale, horizon, tolerance and margin must be positive");
    FW_TRY(fw_alloc(out, 1, sizeof **out, "kernel", m));
    (*out)->traffic.setup = *setup;
    (*out)->traffic.swift = SWIFT * setup->velocity_scale;
    (*out)->horizon = setup->horizon / setup->velocity_scale;
    return FW_OK;
}

void fw_kernel_destroy(fw_kernel *k)
{
    if (!k) return;
    for (size_t i = 0; i < k->n_clusters; i++) fw_cluster_free(k->clusters[i]);
    for (size_t i = 0; i < k->n_spare; i++) fw_cluster_free(k->spare[i]);
    fw_traffic_free(&k->traffic);
    free(k->clusters);
    free(k->spare);
    free(k->opened);
    free(k->root);
    free(k->new_name);
    free(k->is_gone);
    free(k);
}

/* Beyond an awake floe's rim: whom it may reach until the next listing. Whom those push in turn is looked at when they wake (events.c). */
double fw_kernel_ice_margin(const fw_kernel *k) { return k->traffic.setup.horizon + k->traffic.setup.margin; }

static void include(fw_box *box, double x, double y, double r)
{
    box->x0 = fw_smaller(box->x0, x - r), box->x1 = fw_larger(box->x1, x + r);
    box->y0 = fw_smaller(box->y0, y - r), box->y1 = fw_larger(box->y1, y + r);
}

fw_box fw_kernel_needs_ice(const fw_kernel *k, const fw_world *w)
{
    /* Floes that the structure reaches before the next listing wake with it (listing.c): their far rims count. So do those that are awake
     * wherever they are, on the structure's line upstream across the whole strip. */
    const fw_setup *s = &k->traffic.setup;
    fw_strip        strip = fw_strip_of(s, w);
    double          margin = fw_kernel_ice_margin(k), r = fw_larger(w->structure_radius + 2 * w->max_radius, s->wake_radius);
    fw_box          box = {0, 0, 0, 0};
    include(&box, 0, 0, r);
    include(&box, -s->horizon * strip.cx, -s->horizon * strip.cy, r);
    if (s->wake_upstream > 0)
        for (int corner = 0; corner < 4; corner++) {
            double along = corner < 2 ? -s->wake_upstream - s->horizon : 0, across = corner % 2 ? s->half_width : -s->half_width;
            include(&box, strip.cx * along - strip.cy * across, strip.cy * along + strip.cx * across, 0);
        }
    for (size_t i = 0; i < w->n_bodies; i++) include(&box, w->bodies[i].x, w->bodies[i].y, w->bodies[i].radius);
    include(&box, box.x0, box.y0, margin);
    include(&box, box.x1, box.y1, margin);
    return box;
}

static bool lies_on_awake_floe(const fw_world *w, double x, double y, double radius)
{
    for (size_t i = 0; i < w->n_bodies; i++) {
        double dx = x - w->bodies[i].x, dy = y - w->bodies[i].y, reach = radius + w->bodies[i].radius;
        if (dx * dx + dy * dy < reach * reach) return true;
    }
    return false;
}

/* A strip that turns takes in ice that was not there, and awake floes may have come to lie where it would be: those stay, it does not come. */
static void make_room(fw_world *w, const fw_strip *was, const fw_strip *is)
{
    if (was->cx == is->cx && was->cy == is->cy) return;
    for (size_t q = 0; q < w->n_blocks; q++) {
        fw_block *b = &w->blocks[q];
        for (size_t r = 0; r < b->n && b->n_left; r++) {
            if (b->is_taken[r] || fw_strip_has(was, b->x[r], b->y[r]) || !fw_strip_has(is, b->x[r], b->y[r])) continue;
            if (!lies_on_awake_floe(w, b->x[r] + w->drift_x, b->y[r] + w->drift_y, b->radius[r])) continue;
            b->is_taken[r] = true;
            b->n_left--;
        }
    }
}

void fw_kernel_turn(fw_kernel *k, fw_world *w, const fw_flow *flow)
{
    fw_traffic *t = &k->traffic;
    fw_strip    was = fw_strip_of(&t->setup, w);
    t->setup.flow = *flow;
    t->world = w;
    fw_strip is = fw_strip_of(&t->setup, w);
    make_room(w, &was, &is);
    t->books.setup = &t->setup, t->books.world = w;
    for (size_t i = 0; i < k->n_clusters; i++) fw_cluster_restart(k->clusters[i], &t->books);
    t->is_listed = false;
}

double fw_kernel_now(const fw_kernel *k, const fw_world *w) { return fw_larger(w->t, k->traffic.now); }

static fw_cluster *first_to_end(const fw_kernel *k)
{
    fw_cluster *first = NULL;
    for (size_t i = 0; i < k->n_clusters; i++)
        if (!first || k->clusters[i]->t1 < first->t1) first = k->clusters[i];
    return first;
}

fw_status fw_kernel_step(fw_kernel *k, fw_world *w, fw_wear *wear, double t_end, fw_msg *m)
{
    fw_traffic     *t = &k->traffic;
    const fw_setup *s = &t->setup;
    t->world = w;
    t->books = (fw_books){s, w, wear};
    for (size_t i = 0; i < k->n_clusters; i++) /* steps tried when the end lay further away */
        if (k->clusters[i]->t1 > t_end) {
            FW_TRY(fw_cluster_land(k->clusters[i], &t->books, t_end, m));
            t->is_listed = false;
        }
    if (!t->is_listed || t->blocks_listed != w->block_changes || !(w->t < t->until))
        FW_TRY(fw_listing_make(k, t_end, m));
    for (;;) {
        double      until = fw_smaller(t_end, t->until);
        fw_cluster *c = first_to_end(k);
        int32_t     e = fw_traffic_soonest(t);
        double      touches = e < 0 ? INFINITY : t->candidates[e].touch, ends = c ? c->t1 : INFINITY;
        if (touches <= ends && touches <= until)
            FW_TRY(fw_event_touch(k, e, t_end, m));
        else if (ends <= until)
            FW_TRY(fw_event_step_ends(k, c, t_end, m));
        else
            break;
        if (s->attend && (++k->n_events % QUIET_EVENTS == 0 || w->ledger.force_evaluations - k->attended > QUIET_EVALUATIONS)) {
            k->attended = w->ledger.force_evaluations;
            FW_TRY(s->attend(s->attend_self));
        }
        FW_CHECK(w->ledger.force_evaluations <= s->max_evaluations, m, FW_E_LIMIT,
                 "more than %.3g force evaluations at t = %.6g s", s->max_evaluations, t->now);
    }
    double until = fw_smaller(t_end, t->until);
    w->drift_x += s->flow.ice_x * (until - w->t), w->drift_y += s->flow.ice_y * (until - w->t);
    w->t = t->now = until;
    w->ledger.macro_steps++;
    if (until < t_end) return FW_OK;
    for (size_t i = 0; i < w->n_bodies; i++)
        if (!t->seats[i].cluster) fw_event_fly(k, (int32_t)i, until);
    return fw_listing_contacts(k, m);
}
