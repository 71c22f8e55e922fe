#include "abrasion/wear.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "abrasion/wear_inside.h"
#include "base/memory.h"

fw_status fw_wear_init(fw_wear *w, double structure_radius, size_t n_arcs, size_t n_laws, const fw_abrasion_law *laws,
                       fw_msg *m)
{
    memset(w, 0, sizeof *w);
    w->structure_radius = structure_radius;
    w->n_arcs = n_arcs;
    w->n_laws = n_laws;
    w->high_pressure = 5e6;
    size_t  n_rings = 1 + 3 * n_laws;
    double *block;
    FW_TRY(fw_alloc(&block, n_arcs * (n_rings + QUAD * n_laws) + QUAD, sizeof *block, "wear ring", m));
    w->path = block;
    w->cells = block + n_arcs * n_rings;
    while ((uintptr_t)w->cells % (QUAD * sizeof *w->cells)) w->cells++; /* no quad across two cache lines */
    for (size_t l = 0; l < n_laws; l++) {
        w->exponent[l] = laws[l].exponent;
        fw_power_init(&w->power[l], laws[l].exponent);
        for (size_t q = 0; q < 3; q++) w->load[l][q] = block + n_arcs * (1 + 3 * l + q);
    }
    fw_rule_init(&w->quadrature, n_laws, w->exponent);
    return FW_OK;
}

void fw_wear_limit_pressure(fw_wear *w, const fw_pressure_law *limit)
{
    fw_rule_limit(&w->quadrature, limit, w->structure_radius);
    w->empty = INFINITY;
}

void fw_wear_free(fw_wear *w)
{
    free(w->path);
    memset(w, 0, sizeof *w);
}

static void collect_smooth(fw_wear *w, const fw_wear_interval *iv, const fw_rule_smooth *at, double turn)
{
    double chord[4], p[4];
    fw_lens_chords(at->depth, iv->radius, w->structure_radius, chord);
    for (size_t q = 0; q < 4; q++) p[q] = pressure(w, iv, at->normal[q], chord[q]);
    lay_smooth(w, iv, at, chord, p, turn);
}

void fw_wear_collect(fw_wear *w, const fw_wear_interval *iv)
{
    if (!w->is_open || !(iv->length > w->empty)) {
        if (w->is_open && iv->length > 0) fw_wear_collect_limited(w, iv);
        return;
    }
    double turn = iv->angle[1] - iv->angle[0];
    if (fabs(turn) > 0.5 * TWO_PI) turn -= TWO_PI * round(turn / TWO_PI);
    fw_rule_smooth smooth;
    if (fw_rule_is_smooth(&w->quadrature, w->rule, iv, &smooth)) {
        collect_smooth(w, iv, &smooth, turn);
        return;
    }
    fw_rule_nodes at;
    fw_rule_apply(&w->quadrature, w->rule, iv, &at);
    if (at.n > 0) collect_nodes(w, iv, &at, turn);
}

void fw_wear_finish(fw_wear *w)
{
    double per_arc = (double)w->n_arcs / (TWO_PI * w->structure_radius);
    for (size_t k = 0; k < w->n_arcs; k++) {
        const double *cell = w->cells + k * QUAD * w->n_laws;
        w->path[k] = cell[PATH] * per_arc;
        for (size_t l = 0; l < w->n_laws; l++)
            for (size_t q = ALL; q <= HIGH; q++) w->load[l][q][k] = cell[QUAD * l + q] * per_arc;
    }
}

double fw_wear_conservation(const fw_wear *w)
{
    double arc = TWO_PI * w->structure_radius / (double)w->n_arcs, worst = 0;
    for (size_t l = 0; l < w->n_laws; l++) {
        double sum = 0;
        for (size_t k = 0; k < w->n_arcs; k++) sum += w->load[l][0][k];
        if (w->sums[l].x_wall > 0) worst = fmax(worst, fabs(sum * arc - w->sums[l].x_wall) / w->sums[l].x_wall);
    }
    return worst;
}
