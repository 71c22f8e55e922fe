/* A tried step becomes truth: books, wear, bodies; contacts that let go are taken out; watch-dogs look at what has come of it. */
#include "kernel/cluster.h"
#include "kernel/crush.h"
#include "kernel/watch.h"

static const double SLIVER = 1e-6; /* step in 1/w */

/* A contact that is taken out while the dashpot still says a force: the members' accelerations go on without it. */
static void take_force_back(fw_cluster *c, const fw_pair *p, size_t last)
{
    fw_member *a = &c->members[p->a], *b = p->b == FW_WALL ? &c->wall : &c->members[p->b];
    double     n = p->normal[last], f = p->friction[last];
    double     fx = n * p->dir[last][0] - f * p->dir[last][1], fy = n * p->dir[last][1] + f * p->dir[last][0];
    a->k[0][FW_VX] -= fx * a->own_inv_mass, a->k[0][FW_VY] -= fy * a->own_inv_mass, a->k[0][FW_SPIN] += f * a->turn;
    b->k[0][FW_VX] += fx * b->own_inv_mass, b->k[0][FW_VY] += fy * b->own_inv_mass, b->k[0][FW_SPIN] += f * b->turn;
    const fw_rim *r = fw_rim_of(p);
    if (!r) return;
    double along = r->moment[last] * r->lever[last]; /* of the flat's moment */
    a->k[0][FW_VX] -= along * p->dir[last][1] * a->own_inv_mass, a->k[0][FW_VY] += along * p->dir[last][0] * a->own_inv_mass;
    a->k[0][FW_SPIN] -= r->moment[last] / a->radius * a->turn;
}

static fw_status watch_contact(const fw_cluster *c, const fw_books *books, const fw_pair *p, size_t last, bool is_lone, fw_msg *msg)
{
    const fw_body *bodies = books->world->bodies, *a = &bodies[c->members[p->a].index];
    if (!is_lone && !p->is_lawful) return fw_watch_unlawful(a, c->t0, msg);
    return fw_watch_overlap(books->setup, a, p->b == FW_WALL ? NULL : &bodies[c->members[p->b].index], p->depth[last], c->t0, msg);
}

static fw_status let_go(fw_cluster *c, const fw_books *books, bool is_lone, int32_t *opened, size_t *n_opened, fw_msg *msg)
{
    size_t kept = 0, last = books->setup->method->n_stages - 1;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        if (p->b == FW_WALL) {
            const fw_member *a = &c->members[p->a];
            fw_body         *body = &books->world->bodies[a->index];
            body->t_wall = c->t0;
            FW_TRY(fw_watch_body(books->setup, body, msg));
        }
        FW_TRY(watch_contact(c, books, p, last, is_lone, msg));
        /* Apart, and no force; or none when the step began: then what the dashpot says of rims that come back is no force yet. */
        if (p->depth[last] < 0 && (p->normal[last] <= 0 || p->normal[0] <= 0)) {
            opened[(*n_opened)++] = p->candidate;
            take_force_back(c, p, last);
            c->members[p->a].n_pairs--;
            if (p->b != FW_WALL) c->members[p->b].n_pairs--;
            continue;
        }
        if (kept != k) c->pairs[kept] = *p;
        p = &c->pairs[kept++];
        p->normal[0] = p->normal[last], p->friction[0] = p->friction[last], p->slip[0] = p->slip[last];
        p->rate[0] = p->rate[last], p->depth[0] = p->depth[last];
        p->dir[0][0] = p->dir[last][0], p->dir[0][1] = p->dir[last][1];
    }
    if (kept == c->n_pairs) return FW_OK;
    c->n_pairs = kept;
    fw_cluster_find_stiffest(c);
    return FW_OK;
}

fw_status fw_cluster_commit(fw_cluster *c, const fw_books *books, int32_t *opened, size_t *n_opened, fw_msg *msg)
{
    size_t last = books->setup->method->n_stages - 1;
    double h = c->t1 - c->t0;
    bool   is_lone = fw_lone_is(c, books);
    if (is_lone) {
        fw_lone_keep(c, books);
        c->pairs[0].jumped = 0; /* its closed forms end where slip turns */
    } else {
        fw_books_keep(c, books);
        fw_books_wear(c, books);
        fw_watch_slip(c, books->setup, &books->world->ledger);
    }
    books->world->ledger.steps++;
    c->t0 = c->t1;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        p->since_touch += h;
        p->load += p->load_tried;
    }
    for (size_t i = 0; i < c->n_members; i++) {
        fw_member *m = &c->members[i];
        fw_body   *b = &books->world->bodies[m->index];
        b->t = c->t0;
        for (int q = 0; q < 8; q++) m->y0[q] = m->y1[q], m->k[0][q] = m->k[last][q];
        b->x = m->y0[FW_X], b->y = m->y0[FW_Y], b->vx = m->y0[FW_VX], b->vy = m->y0[FW_VY], b->spin = m->y0[FW_SPIN];
        for (int q = 0; q < 3; q++) m->drag[0][q] = m->drag[last][q];
    }
    if (fw_is_crush(books->setup)) fw_crush_commit(c, books->world, last, h);
    FW_TRY(let_go(c, books, is_lone, opened, n_opened, msg));
    /* Accelerations are velocity differences over the step: after a sliver of one they are rounding noise. */
    if (h * c->omega < SLIVER) fw_stage_start(c, books);
    return FW_OK;
}
