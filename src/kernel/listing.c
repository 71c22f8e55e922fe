/* From time to time: forget who is far downstream, wake whom the structure meets next, list anew who may touch whom. */
#include "kernel/inside.h"

#include "base/memory.h"
#include "kernel/crush.h"
#include "kernel/forces.h"
#include "kernel/strip.h"
#include "kernel/wake.h"
#include "kernel/watch.h"

/* Floes that the structure reaches before the next listing are awake: a candidate needs a body. */
static fw_status wake_before_structure(fw_kernel *k, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    double      dt = t->until - t->now, X = -w->drift_x, Y = -w->drift_y;
    fw_strip    strip = fw_strip_of(&t->setup, w);
    double      u = strip.cx * t->setup.flow.ice_x + strip.cy * t->setup.flow.ice_y, way = u * dt;
    for (size_t q = 0; q < w->n_blocks; q++) {
        fw_block *b = &w->blocks[q];
        double    reach = t->setup.structure_radius + b->max_radius + 0.5 * way;
        double    cx = X - 0.5 * way * strip.cx, cy = Y - 0.5 * way * strip.cy;
        if (b->n_left == 0 || cx + reach < b->x_min || cx - reach > b->x_max) continue;
        size_t ix0, ix1, iy0, iy1;
        fw_cells_range(&b->cells, cx, cy, reach, &ix0, &ix1, &iy0, &iy1);
        for (size_t iy = iy0; iy < iy1 && ix0 < ix1; iy++)
            for (size_t i = b->cells.start[iy * b->cells.nx + ix0]; i < b->cells.start[iy * b->cells.nx + ix1]; i++) {
                size_t r = b->cells.item[i];
                double px = b->x[r] - X, py = b->y[r] - Y, limit = t->setup.structure_radius + b->radius[r];
                double along = strip.cx * px + strip.cy * py;
                if (b->is_taken[r] || fabs(strip.cx * py - strip.cy * px) > limit || along > limit || along < -limit - way ||
                    !fw_strip_has(&strip, b->x[r], b->y[r]))
                    continue;
                FW_TRY(fw_wake(&t->setup, w, q, r, m));
            }
    }
    return FW_OK;
}

/* Where ice that nothing has touched does not just drift along (floes drift apart in the wind, the water gives way before the structure) it is
 * awake, as far as that matters. */
static fw_status wake_around(fw_kernel *k, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    fw_strip    strip = fw_strip_of(&t->setup, w);
    double      u = strip.cx * t->setup.flow.ice_x + strip.cy * t->setup.flow.ice_y, way = u * (t->until - t->now);
    double      radius = t->setup.wake_radius > 0 ? t->setup.wake_radius + way : 0;
    double      upstream = t->setup.wake_upstream > 0 ? t->setup.wake_upstream + way : 0;
    for (size_t q = 0; q < w->n_blocks; q++)
        for (size_t r = 0; r < w->blocks[q].n && w->blocks[q].n_left; r++) {
            const fw_block *b = &w->blocks[q];
            if (b->is_taken[r] || !fw_strip_has(&strip, b->x[r], b->y[r])) continue;
            double px = b->x[r] + w->drift_x, py = b->y[r] + w->drift_y, along = strip.cx * px + strip.cy * py;
            bool   is_near = px * px + py * py < radius * radius || (along > -upstream && upstream > 0);
            if (!is_near || along > t->setup.downstream) continue;
            FW_TRY(fw_wake(&t->setup, w, q, r, m));
        }
    return FW_OK;
}

fw_status fw_listing_contacts(fw_kernel *k, fw_msg *m)
{
    fw_world *w = k->traffic.world;
    w->n_contacts = 0;
    for (size_t i = 0; i < k->n_clusters; i++) {
        const fw_cluster *c = k->clusters[i];
        FW_TRY(fw_grow(&w->contacts, &w->contact_capacity, w->n_contacts + c->n_pairs + 1, sizeof *w->contacts,
                       "contacts", m));
        for (size_t q = 0; q < c->n_pairs; q++) {
            const fw_pair *p = &c->pairs[q];
            w->contacts[w->n_contacts++] = (fw_contact){.i = c->members[p->a].index,
                                                        .j = p->b == FW_WALL ? FW_WALL : c->members[p->b].index,
                                                        .stiffness = p->law.k,
                                                        .energy = fw_rim_of(p) ? fw_rim_of(p)->stored : 0};
        }
    }
    return FW_OK;
}

static bool is_past(const fw_kernel *k, int32_t i)
{
    const fw_body *b = &k->traffic.world->bodies[i];
    fw_place       at = {.x = b->x, .y = b->y};
    if ((size_t)i < k->n_seated && !k->traffic.seats[i].cluster) {
        fw_path p = fw_path_of_flying(&k->traffic.setup, b);
        at = fw_path_at(&p, k->traffic.now);
    }
    fw_strip strip = fw_strip_of(&k->traffic.setup, k->traffic.world);
    return strip.cx * at.x + strip.cy * at.y > k->traffic.setup.downstream && fw_length(at.x, at.y) > k->traffic.setup.structure_radius + b->radius;
}

/* Members that are gone leave the cluster, with their contacts. */
static void leave(fw_kernel *k, fw_cluster *c)
{
    size_t kept = 0, kept_pairs = 0;
    for (size_t q = 0; q < c->n_pairs; q++) {
        fw_pair *p = &c->pairs[q];
        bool is_lost = k->is_gone[c->members[p->a].index] || (p->b != FW_WALL && k->is_gone[c->members[p->b].index]);
        if (!is_lost) {
            c->pairs[kept_pairs++] = *p;
            continue;
        }
        c->members[p->a].n_pairs--;
        if (p->b != FW_WALL) c->members[p->b].n_pairs--;
    }
    c->n_pairs = kept_pairs;
    for (size_t i = 0; i < c->n_members; i++) {
        k->root[i] = (int32_t)kept;
        if (!k->is_gone[c->members[i].index]) c->members[kept++] = c->members[i];
    }
    c->n_members = kept;
    for (size_t q = 0; q < c->n_pairs; q++) {
        fw_pair *p = &c->pairs[q];
        p->a = k->root[p->a];
        if (p->b != FW_WALL) p->b = k->root[p->b];
    }
}

/* Floes far downstream are forgotten: free ones, whole clusters, and single members of a cluster that stands at this very
 * instant (others keep their steps short until the next listing, so that they do then). */
static fw_status forget(fw_kernel *k, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    bool        any = false;
    FW_TRY(fw_grow(&k->is_gone, &k->gone_capacity, w->n_bodies + 1, sizeof *k->is_gone, "clusters", m));
    FW_TRY(fw_grow(&k->new_name, &k->name_capacity, w->n_bodies + 1, sizeof *k->new_name, "clusters", m));
    FW_TRY(fw_grow(&k->root, &k->root_capacity, w->n_bodies + 1, sizeof *k->root, "clusters", m));
    for (size_t i = 0; i < w->n_bodies; i++) {
        k->is_gone[i] = is_past(k, (int32_t)i);
        any |= k->is_gone[i];
    }
    if (!any) return FW_OK;
    any = false;
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        size_t      n_gone = 0;
        for (size_t i = 0; i < c->n_members; i++) n_gone += k->is_gone[c->members[i].index];
        bool is_all = n_gone == c->n_members, is_now = c->t0 == t->now;
        c->is_kept = n_gone > 0 && !is_all && !is_now;
        if (!is_all && !is_now)
            for (size_t i = 0; i < c->n_members; i++) k->is_gone[c->members[i].index] = false;
    }
    for (size_t i = 0; i < w->n_bodies; i++) any |= k->is_gone[i];
    if (!any) return FW_OK;

    FW_TRY(fw_listing_contacts(k, m));
    for (size_t q = k->n_clusters; q-- > 0;) {
        fw_cluster *c = k->clusters[q];
        size_t      n = c->n_members;
        leave(k, c);
        if (c->n_members == n) continue;
        if (c->n_members == 0) {
            fw_flock_retire(k, c);
            continue;
        }
        fw_flock_seat(k, c);
        fw_cluster_restart(c, &t->books); /* forces are gone, so the accelerations that were kept are stale */
        c->h = INFINITY;
    }
    int32_t next = 0;
    for (size_t i = 0; i < w->n_bodies; i++) {
        k->new_name[i] = next;
        if (!k->is_gone[i] && i < k->n_seated) t->seats[next++] = t->seats[i];
    }
    fw_world_forget(w, k->is_gone);
    k->n_seated = (size_t)next;
    for (size_t q = 0; q < k->n_clusters; q++)
        for (size_t i = 0; i < k->clusters[q]->n_members; i++) {
            fw_member *e = &k->clusters[q]->members[i];
            e->index = k->new_name[e->index];
        }
    /* Those that lost a member may have fallen apart; their parts try their steps when all is listed. */
    for (size_t q = k->n_clusters; q-- > 0;) {
        size_t first;
        if (k->clusters[q]->t1 == k->clusters[q]->t0) FW_TRY(fw_flock_fall_apart(k, k->clusters[q], &first, m));
    }
    return FW_OK;
}

fw_status fw_listing_make(fw_kernel *k, double t_end, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_world   *w = t->world;
    t->now = w->t, t->until = w->t + k->horizon;
    for (size_t i = 0; i < w->n_bodies; i++) FW_TRY(fw_watch_body(&t->setup, &w->bodies[i], m));
    FW_TRY(forget(k, m));
    FW_TRY(wake_before_structure(k, m));
    if (t->setup.wake_radius > 0 || t->setup.wake_upstream > 0) FW_TRY(wake_around(k, m));
    FW_TRY(fw_grow(&t->seats, &t->seat_capacity, w->n_bodies + 1, sizeof *t->seats, "candidates", m));
    for (; k->n_seated < w->n_bodies; k->n_seated++) {
        t->seats[k->n_seated] = (fw_seat){.first = -1};
        if (!fw_has_flight(&t->setup)) FW_TRY(fw_flock_alone(k, (int32_t)k->n_seated, m));
    }
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        if (c->t1 == c->t0) FW_TRY(fw_cluster_try(c, &t->books, fw_event_step_limit(k, c, t_end), m));
    }
    FW_TRY(fw_traffic_list(t, m));
    for (size_t q = 0; q < k->n_clusters; q++) {
        fw_cluster *c = k->clusters[q];
        for (size_t i = 0; i < c->n_pairs; i++) {
            fw_pair *p = &c->pairs[i];
            int32_t  a = c->members[p->a].index, b = p->b == FW_WALL ? FW_WALL : c->members[p->b].index;
            /* Rims that part within the step that is on trial may be out of each other's reach already. */
            p->candidate = fw_traffic_find(t, a, b);
            if (p->candidate < 0) FW_TRY(fw_traffic_add(t, a, b, &p->candidate, m));
            t->candidates[p->candidate].is_closed = true;
        }
    }
    for (size_t c = 0; c < t->n_candidates; c++) fw_traffic_check(t, (int32_t)c);
    return FW_OK;
}
