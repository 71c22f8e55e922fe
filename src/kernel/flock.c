/* Clusters come and go: made at a touch, merged, fallen apart when contacts let go. */
#include "kernel/inside.h"

#include "base/memory.h"
#include "kernel/forces.h"

fw_status fw_flock_new(fw_kernel *k, double t, fw_cluster **out, fw_msg *m)
{
    FW_TRY(fw_grow(&k->clusters, &k->cluster_capacity, k->n_clusters + 1, sizeof *k->clusters, "clusters", m));
    FW_TRY(fw_grow(&k->spare, &k->spare_capacity, k->n_clusters + k->n_spare + 1, sizeof *k->spare, "clusters", m));
    fw_cluster *c;
    if (k->n_spare)
        c = k->spare[--k->n_spare];
    else
        FW_TRY(fw_alloc(&c, 1, sizeof *c, "cluster", m));
    c->n_members = c->n_pairs = 0;
    c->t0 = c->t1 = t, c->h = INFINITY, c->dissipated = 0, c->is_kept = c->is_weighed = false;
    c->omega = c->pace = fw_has_flight(&k->traffic.setup) ? 0 : k->traffic.setup.velocity_scale; /* over 1 m */
    c->lone.t1 = NAN; /* nobody's step */
    k->clusters[k->n_clusters++] = c;
    *out = c;
    return FW_OK;
}

fw_status fw_flock_alone(fw_kernel *k, int32_t body, fw_msg *m)
{
    fw_traffic *t = &k->traffic;
    fw_cluster *c;
    int32_t     member;
    FW_TRY(fw_flock_new(k, t->now, &c, m));
    FW_TRY(fw_cluster_join(c, &t->books, body, &member, m));
    fw_flock_seat(k, c);
    fw_cluster_restart(c, &t->books);
    return FW_OK;
}

void fw_flock_retire(fw_kernel *k, fw_cluster *c)
{
    size_t kept = 0;
    for (size_t i = 0; i < k->n_clusters; i++)
        if (k->clusters[i] != c) k->clusters[kept++] = k->clusters[i];
    k->n_clusters = kept;
    k->spare[k->n_spare++] = c;
}

void fw_flock_seat(fw_kernel *k, fw_cluster *c)
{
    for (size_t i = 0; i < c->n_members; i++) {
        fw_seat *s = &k->traffic.seats[c->members[i].index];
        s->cluster = c, s->member = (int32_t)i;
    }
}

static int32_t find_root(int32_t *root, int32_t i)
{
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
}

/* Members that nothing holds fly on alone; parts that nothing joins become clusters of their own. The new ones stand at the end
 * of k->clusters, from *first on. */
fw_status fw_flock_fall_apart(fw_kernel *k, fw_cluster *c, size_t *first, fw_msg *m)
{
    *first = k->n_clusters;
    FW_TRY(fw_grow(&k->root, &k->root_capacity, c->n_members + 1, sizeof *k->root, "clusters", m));
    for (size_t i = 0; i < c->n_members; i++) k->root[i] = (int32_t)i;
    for (size_t q = 0; q < c->n_pairs; q++) {
        const fw_pair *p = &c->pairs[q];
        if (p->b == FW_WALL) continue;
        int32_t a = find_root(k->root, p->a), b = find_root(k->root, p->b);
        k->root[a < b ? b : a] = a < b ? a : b;
    }
    bool is_whole = true, may_be_alone = !fw_has_flight(&k->traffic.setup);
    for (size_t i = 0; i < c->n_members; i++)
        is_whole &= find_root(k->root, (int32_t)i) == 0 && (c->members[i].n_pairs > 0 || (may_be_alone && c->n_members == 1));
    if (is_whole) {
        /* The closed forms of a lone contact leave no accelerations to go on with. */
        if (c->n_pairs == 0) fw_cluster_restart(c, &k->traffic.books);
        return FW_OK;
    }
    for (size_t r = 0; r < c->n_members; r++) {
        if (k->root[r] != (int32_t)r) continue;
        if (c->members[r].n_pairs == 0 && !may_be_alone) {
            k->traffic.seats[c->members[r].index].cluster = NULL;
            continue;
        }
        fw_cluster *part;
        FW_TRY(fw_flock_new(k, c->t0, &part, m));
        part->h = c->h, part->is_kept = c->is_kept;
        for (size_t i = 0; i < c->n_members; i++) {
            if (find_root(k->root, (int32_t)i) != (int32_t)r) continue;
            FW_TRY(fw_grow(&part->members, &part->member_capacity, part->n_members + 1, sizeof *part->members,
                           "clusters", m));
            part->members[part->n_members] = c->members[i];
            k->traffic.seats[c->members[i].index].member = (int32_t)part->n_members++;
        }
        part->dissipated = c->dissipated * (double)part->n_members / (double)c->n_members;
        for (size_t q = 0; q < c->n_pairs; q++) {
            fw_pair p = c->pairs[q];
            if (find_root(k->root, p.a) != (int32_t)r) continue;
            FW_TRY(fw_grow(&part->pairs, &part->pair_capacity, part->n_pairs + 1, sizeof *part->pairs, "clusters", m));
            p.a = k->traffic.seats[c->members[p.a].index].member;
            if (p.b != FW_WALL) p.b = k->traffic.seats[c->members[p.b].index].member;
            part->pairs[part->n_pairs++] = p;
            part->omega = fw_larger(part->omega, p.law.omega);
        }
    }
    for (size_t i = *first; i < k->n_clusters; i++) fw_flock_seat(k, k->clusters[i]);
    c->n_members = c->n_pairs = 0;
    fw_flock_retire(k, c);
    --*first;
    return FW_OK;
}

/* How far a cluster's next step may go. One that has come to the end tries on beyond it: it is not committed in this call. */
