/* What the ledger says to do: which row is largest, at every point, and which one shrinks the number's error most for its CPU time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/rows.h"

/* Sums are their rows, scatter is no doubt; what ice alone leaves is in sampling. */
static bool counts(const fw_ledger_row *r)
{
    return r->amount > 0 && isfinite(r->amount) && !r->is_sum && !r->is_scatter && strcmp(r->row, "ice field against scenario") != 0;
}

static double total_of(const fw_answer *a, size_t halved)
{
    double squares = 0;
    for (size_t i = 0; i < a->n_ledger; i++)
        if (counts(&a->ledger[i])) squares += pow(a->ledger[i].amount * (i == halved ? 0.5 : 1), 2);
    return sqrt(squares);
}

static void advise(fw_answer *a)
{
    fw_advice *v = &a->advice;
    double     best = 0;
    *v = (fw_advice){a->n_ledger, a->n_ledger, total_of(a, a->n_ledger), NAN};
    for (size_t i = 0; i < a->n_ledger; i++) {
        const fw_ledger_row *r = &a->ledger[i];
        if (!counts(r)) continue;
        if (v->largest == a->n_ledger || r->amount > a->ledger[v->largest].amount) v->largest = i;
        if (!(r->cost_to_halve_cpu_s > 0)) continue;
        double paid = (v->total - total_of(a, i)) / r->cost_to_halve_cpu_s;
        if (paid > best) best = paid, v->best_paid = i;
    }
    if (v->best_paid < a->n_ledger) v->total_after = total_of(a, v->best_paid);
}

/* The design percentile's row of each point. */
static void dominate(fw_answer *a, size_t n_percentiles)
{
    for (size_t i = 0; i < a->n_points; i++) {
        fw_point_row            *p = &a->points[i];
        const fw_percentile_row *own = NULL;
        for (size_t k = 0; k < n_percentiles; k++)
            if (a->percentiles[i * n_percentiles + k].percentile == a->design_percentile) own = &a->percentiles[i * n_percentiles + k];
        p->dominating_amount = NAN;
        if (!own || !(own->depth_mm > 0)) continue;
        double sampling = (own->high_mm - own->low_mm) / (2 * own->depth_mm);
        snprintf(p->dominated_by, sizeof p->dominated_by, "sampling");
        p->dominating_amount = isnan(sampling) ? INFINITY : sampling; /* no interval: nothing is larger */
        for (size_t r = 0; r < a->n_ledger; r++) {
            const fw_ledger_row *row = &a->ledger[r];
            if (!counts(row) || strcmp(row->row, "sampling") == 0 || !(row->amount > p->dominating_amount)) continue;
            snprintf(p->dominated_by, sizeof p->dominated_by, "%s", row->row);
            p->dominating_amount = row->amount;
        }
    }
}

void fw_ledger_advise(fw_answer *a, size_t n_percentiles)
{
    advise(a);
    dominate(a, n_percentiles);
}
