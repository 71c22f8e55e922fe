#include "kernel/watch.h"

#include <stdio.h>

/* A step is repeated when its imbalance is more than this many energy tolerances of what the cluster has dissipated. Errors of single steps cancel:
 * windows are out by a tenth to a half of a tolerance. So 0.05 % (10 % ice) to 1 % (60 %) of the steps are repeated; at 1 windows at 40 % ice take 2 % more
 * evaluations and are no better. */
static const double SHARE = 2;
/* Share of the kinetic energy of the cluster's mass at the velocity scale below which no balance is asked for: what a raft at rest exchanges
 * is as small as the errors of its velocities. */
static const double AT_REST = 1e-3;
/* In 1/w: shorter steps are halved for no balance, it would not be their length that is at fault. */
static const double SHORTEST_WATCHED = 1e-3;
/* A rim found this far inside another, over the smaller radius, is no rounding of a landing: the largest of 400 windows of the Raahe campaign is
 * 2.3e-3, of 160 000 touches. */
static const double MISSED = 0.01;

static bool is_energy_out(const fw_cluster *c, const fw_setup *set)
{
    const fw_step_books *s = &c->tried;
    double gone = s->dashpot + s->friction + s->dropped + (s->crushed + s->rolling), mass = 0;
    double imbalance = s->drag_work - gone - s->kinetic_change - s->stored - s->turned;
    /* Beside a contact that crushes, long steps that are pressed may book a little less than nothing: against a sum below 0 every step is out, short or not. */
    double since = fw_is_crush(set) ? fw_larger(0, c->dissipated) : c->dissipated;
    double bound = SHARE * set->energy_tolerance, exchanged = since + fabs(gone) + s->into_springs;
    if (!(fabs(imbalance) > bound * exchanged)) return false;
    for (size_t i = 0; i < c->n_members; i++) mass += c->members[i].mass;
    double at_rest = AT_REST * 0.5 * mass * set->velocity_scale * set->velocity_scale;
    /* Two floes that the wind presses on each other for minutes exchange next to nothing, and what errors leave of that may be less than nothing: no step
     * is short enough then (8 million in 4 minutes). */
    if (!(exchanged + at_rest > 0)) exchanged = 0;
    return fabs(imbalance) > bound * (exchanged + at_rest);
}

int fw_watch_jump(const fw_contact_constants *law, double share, double slip0, double normal0, double slip1, double normal1)
{
    if (!(slip0 * slip1 < 0) || !(normal0 > 0) || !(normal1 > 0) || !(law->mu > 0)) return 0;
    double force0 = law->ct * fabs(slip0), force1 = law->ct * fabs(slip1);
    if (force0 < share * law->mu * normal0 || force1 < share * law->mu * normal1) return 0;
    return slip1 > 0 ? 1 : -1;
}

/* Between floes beside a contact that crushes, slip from cap to cap within a tenth of what sweeps may leave is theirs: in a current of 1 mm/s 1e-8 m/s is beyond
 * the cap of what presses there, and 0.1 % of the steps of a window jumped. */
static const double OF_SWEEPS = 0.1;

static int jump_of(const fw_pair *p, const fw_setup *set, size_t last)
{
    double least = fw_is_crush(set) && p->b != FW_WALL ? OF_SWEEPS * set->solver_share * set->tolerance * set->velocity_scale : 0;
    if (fabs(p->slip[0]) < least && fabs(p->slip[last]) < least) return 0;
    /* 1: error control lets slip end anywhere near 0, which is not far from the cap where little presses */
    return fw_watch_jump(&p->law, 1, p->slip[0], p->normal[0], p->slip[last], p->normal[last]);
}

bool fw_watch_step(const fw_cluster *c, const fw_setup *set, double h)
{
    if (h * c->omega < SHORTEST_WATCHED || c->n_pairs == 0) return false;
    if (is_energy_out(c, set)) return true;
    for (size_t k = 0; k < c->n_pairs; k++)
        if (c->pairs[k].jumped && jump_of(&c->pairs[k], set, set->method->n_stages - 1) == -c->pairs[k].jumped) return true;
    return false;
}

void fw_watch_slip(fw_cluster *c, const fw_setup *set, fw_ledger *l)
{
    l->contact_steps += (double)c->n_pairs;
    for (size_t k = 0; k < c->n_pairs; k++) {
        fw_pair *p = &c->pairs[k];
        int8_t   was = p->jumped;
        p->jumped = (int8_t)jump_of(p, set, set->method->n_stages - 1);
        if (p->jumped && p->jumped == -was) l->chatter++;
    }
}

fw_status fw_watch_body(const fw_setup *set, const fw_body *b, fw_msg *m)
{
    double r = fw_length(b->x, b->y);
    FW_CHECK(isfinite(r + b->vx + b->vy + b->spin), m, FW_E_NUMERIC, "the state of floe %llu (D %.3g m, h %.2g m) is not finite at t = %.6g s",
             (unsigned long long)b->name, 2 * b->radius, b->thickness, b->t);
    FW_CHECK(r > set->structure_radius, m, FW_E_NUMERIC, "floe %llu (D %.3g m, h %.2g m) has its centre inside the structure at t = %.6g s",
             (unsigned long long)b->name, 2 * b->radius, b->thickness, b->t);
    return FW_OK;
}

fw_status fw_watch_overlap(const fw_setup *set, const fw_body *b, const fw_body *other, double depth, double t, fw_msg *m)
{
    char with[64] = "the structure";
    if (depth < fw_smaller(b->radius, other ? other->radius : set->structure_radius)) return FW_OK;
    if (other) snprintf(with, sizeof with, "floe %llu (D %.3g m)", (unsigned long long)other->name, 2 * other->radius);
    return fw_fail(m, FW_E_NUMERIC, "floe %llu (D %.3g m, h %.2g m) and %s overlap by %.3g m, a whole radius, at t = %.6g s: the contact is too soft",
                   (unsigned long long)b->name, 2 * b->radius, b->thickness, with, depth, t);
}

fw_status fw_watch_unlawful(const fw_body *b, double t, fw_msg *m)
{
    return fw_fail(m, FW_E_NUMERIC, "floe %llu (D %.3g m, h %.2g m) feels tension, or friction beyond its cap, at t = %.6g s",
                   (unsigned long long)b->name, 2 * b->radius, b->thickness, t);
}

fw_status fw_watch_late(const fw_setup *set, fw_ledger *l, const fw_body *b, double other_radius, double depth, double t, fw_msg *m)
{
    double share = depth / fw_smaller(b->radius, other_radius > 0 ? other_radius : set->structure_radius);
    l->late_touches++;
    l->late_overlap = fw_larger(l->late_overlap, share);
    return share < MISSED ? FW_OK
                          : fw_fail(m, FW_E_NUMERIC, "floe %llu (D %.3g m, h %.2g m) was found %.3g m inside another before they touched, at t = %.6g s",
                                    (unsigned long long)b->name, 2 * b->radius, b->thickness, depth, t);
}
