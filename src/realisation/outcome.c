#include "realisation/outcome.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    r->wear_thickness = wear->sums[0].x_wall > 0 ? wear->x_thickness / wear->sums[0].x_wall : 0;
    r->force_evaluations = l->force_evaluations;
    r->steps = l->steps;
    r->refined_steps = l->refined;
    r->slip_chatter = fw_ledger_chatter(l);
    r->late_touches = l->late_touches, r->late_overlap = l->late_overlap;
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

void fw_outcome_begin_again(fw_record *r, fw_msg *m)
{
    double evaluations = r->force_evaluations, steps = r->steps;
    for (size_t i = 0; i < fw_n_record_columns; i++) memset((char *)r + fw_record_columns[i].offset, 0, sizeof(double));
    memset(r->rings, 0, fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof *r->rings);
    r->force_evaluations = evaluations, r->steps = steps, r->tries = 2;
    r->status = FW_OK;
    snprintf(r->cause, sizeof r->cause, "first try: %.*s", (int)sizeof r->cause - 12, m->text);
    m->text[0] = 0;
}

void fw_outcome_say(fw_record *r, fw_msg *m)
{
    if (r->status == FW_OK) return;
    memset(r->rings, 0, fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof *r->rings);
    if (r->tries < 2) {
        snprintf(r->cause, sizeof r->cause, "%.*s", (int)sizeof r->cause - 1, m->text);
    } else if (r->status == FW_E_NUMERIC) {
        snprintf(r->cause, sizeof r->cause, "finer steps too: %.*s", (int)sizeof r->cause - 18, m->text);
    } else { /* "first try: ..." stands there */
        size_t n = strnlen(r->cause, sizeof r->cause - 70);
        snprintf(r->cause + n, sizeof r->cause - n, "; finer steps: %.50s", m->text);
        r->status = FW_E_NUMERIC;
    }
    m->text[0] = 0;
}
