#include "realisation/outcome.h"

#include <math.h>

void fw_outcome_fill(fw_record *r, const fw_world *w, const fw_wear *wear, double window)
{
    const fw_ledger *l = &w->ledger;
    r->window = window;
    r->hits = l->hits;
    r->contact_time = l->contact_time;
    r->normal_impulse = l->normal_impulse;
    r->peak_force = l->peak_force;
    r->max_overlap_share = l->max_overlap_share;
    r->overlap_time_share = l->overlap_time / window;
    r->overlap_wear_share = wear->sums[0].along > 0 ? wear->sums[0].beyond / wear->sums[0].along : 0;
    r->energy_relative = fw_ledger_energy_relative(l);
    r->energy_truncation = fw_ledger_energy_truncation(l, w->energy_start, fw_world_energy(w));
    r->momentum_relative = fw_ledger_momentum_relative(l);
    r->wear_conservation = fw_wear_conservation(wear);
    r->force_evaluations = l->force_evaluations;
    r->steps = l->steps;
    r->late_touches = l->late_touches;
    r->floes_touched = (double)w->n_touched;
    r->awake_floes = l->awake_floes;
    r->reach = l->reach;
    for (size_t k = 0; k < wear->n_arcs; k++) r->rings[k] = wear->path[k] * 1e-3; /* m -> km */
    for (size_t i = 0; i < wear->n_laws; i++) {
        double to_edge = pow(1e-6, wear->exponent[i]) * 1e-3; /* Pa^m m -> MPa^m km */
        for (size_t q = 0; q < FW_RINGS_PER_LAW; q++) {
            double *to = r->rings + r->n_arcs * (1 + FW_RINGS_PER_LAW * i + q);
            for (size_t k = 0; k < wear->n_arcs; k++) to[k] = wear->load[i][q][k] * to_edge;
        }
    }
}
