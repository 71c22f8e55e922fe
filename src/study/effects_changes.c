/* What the arms say: the governing point, and per row the change of its mean and percentile from the windows that succeeded both ways. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/effects_inside.h"

/* A continuous law of the temperature factor stands as the middles of equal parts of probability: 64 are 0.1 % of a percentile of one window, and the
 * errors of many windows cancel. Fewer where windows and directions are many, so that an arm has some 10^5 atoms. */
enum { MOST_PARTS = 64, FEWEST_PARTS = 8, MOST_ATOMS = 1 << 17 };

/* One point's law of window depth in one arm, over chosen windows. */
typedef struct law {
    size_t          n, n_atoms;
    double         *means; /* (n) of each window */
    fw_paired_atom *atoms; /* (n_atoms) sorted */
} law;

static void free_law(law *x)
{
    free(x->means);
    free(x->atoms);
    memset(x, 0, sizeof *x);
}

static size_t count_atoms(const fw_effects_arm *arm, size_t point, size_t n, const size_t *windows)
{
    size_t sum = 0, one = 0;
    for (size_t i = 0; i < n; i++) {
        fw_directions_row(&arm->depth.directions, arm->depth.row[arm->row[windows[i]]].scenario.cell, point, &one);
        sum += one;
    }
    return sum;
}

/* windows: (n) numbers of those that count. */
static fw_status make_law(law *x, const fw_effects_arm *arm, size_t point, size_t n, const size_t *windows, fw_msg *m)
{
    const fw_depth *d = &arm->depth;
    const fw_scale *y = &d->scale;
    size_t          n_entries = count_atoms(arm, point, n, windows), parts = y->n, at = 0, n_row = 0;
    double          factor[MOST_PARTS];
    memset(x, 0, sizeof *x);
    if (!y->is_discrete) {
        parts = n_entries ? MOST_ATOMS / n_entries : 1;
        parts = parts > MOST_PARTS ? MOST_PARTS : parts < FEWEST_PARTS ? FEWEST_PARTS : parts;
        for (size_t k = 0; k < parts; k++) factor[k] = fw_scale_quantile(y, ((double)k + 0.5) / (double)parts);
    }
    x->n = n, x->n_atoms = n_entries * parts;
    FW_TRY(fw_alloc(&x->means, n, sizeof *x->means, "mean depths of windows", m));
    FW_TRY(fw_alloc(&x->atoms, x->n_atoms, sizeof *x->atoms, "depths of windows", m));
    for (size_t i = 0; i < n; i++) {
        size_t                     r = arm->row[windows[i]];
        const double              *load = d->load + r * d->directions.n_used;
        const fw_direction_weight *row = fw_directions_row(&d->directions, d->row[r].scenario.cell, point, &n_row);
        for (size_t k = 0; k < n_row; k++) {
            double one = load[row[k].column];
            x->means[i] += row[k].weight * one * y->moment[1];
            for (size_t t = 0; t < parts; t++)
                x->atoms[at++] = (fw_paired_atom){.value = one * (y->is_discrete ? y->values[t] : factor[t]),
                                                  .weight = row[k].weight * (y->is_discrete ? y->weights[t] : 1 / (double)parts),
                                                  .window = (uint32_t)i};
        }
    }
    fw_paired_sort(x->n_atoms, x->atoms);
    return FW_OK;
}

static double mean_of(const law *x)
{
    double sum = 0;
    for (size_t i = 0; i < x->n; i++) sum += x->means[i];
    return sum / (double)x->n;
}

/* The point with the largest percentile, or mean where no percentile is above 0. */
static fw_status find_governing(fw_effects_ledger *l, const fw_effects_arm *own, const fw_campaign *c, size_t n, const size_t *windows, fw_msg *m)
{
    l->point = 0;
    for (size_t k = 0; k < c->points.n; k++) {
        law       x;
        fw_status s = make_law(&x, own, k, n, windows, m);
        if (s == FW_OK) {
            double q = fw_paired_quantile(n, x.n_atoms, x.atoms, l->percentile / 100), mean = mean_of(&x);
            if (l->point == 0 || q > l->percentile_mm || (q == l->percentile_mm && mean > l->mean_mm))
                l->point = k + 1, l->percentile_mm = q, l->mean_mm = mean;
        }
        free_law(&x);
        FW_TRY(s);
    }
    return FW_OK;
}

/* Windows that succeeded both ways. */
static size_t common(const fw_effects_ledger *l, const fw_effects_arm *a, const fw_effects_arm *b, size_t *windows)
{
    size_t n = 0;
    for (size_t i = 0; i < l->n_windows; i++)
        if (a->row[i] != FW_EFFECTS_FAILED && b->row[i] != FW_EFFECTS_FAILED) windows[n++] = i;
    return n;
}

typedef struct comparison {
    size_t         *windows; /* (n windows) */
    fw_paired_draws draws;   /* of as many pairs as the last row had */
    law             a, b;
} comparison;

static fw_status compare_row(fw_effects_ledger *l, fw_effects_row *row, const fw_effects_plan *p, const fw_effects_arm *arm, const fw_campaign *c,
                             comparison *q, fw_msg *m)
{
    const fw_effects_arm *own = &p->arms[0];
    size_t                n = common(l, arm, own, q->windows), point = l->point - 1;
    row->n_pairs = n, row->n_failed = l->n_windows - n;
    row->evaluations_saved = 1 - arm->evaluations / own->evaluations;
    row->cpu_saved = 1 - arm->cpu_s / l->cpu_s_first;
    if (arm->is_read) row->evaluations_saved = row->cpu_saved = 0;
    if (n == 0) return FW_OK;
    if (q->draws.n != n) {
        fw_paired_draws_free(&q->draws);
        FW_TRY(fw_paired_draws_make(&q->draws, n, c->seed, m));
    }
    FW_TRY(make_law(&q->a, arm, point, n, q->windows, m));
    FW_TRY(make_law(&q->b, own, point, n, q->windows, m));
    FW_TRY(fw_paired_mean(&q->draws, q->a.means, q->b.means, l->confidence, &row->mean, m));
    return fw_paired_percentile(&q->draws, q->a.n_atoms, q->a.atoms, q->b.n_atoms, q->b.atoms, l->percentile / 100, l->confidence, &row->percentile, m);
}

static fw_status compare(fw_effects_ledger *l, const fw_effects_plan *p, const fw_campaign *c, comparison *q, fw_msg *m)
{
    const fw_effects_arm *own = &p->arms[0];
    FW_TRY(fw_alloc(&q->windows, l->n_windows, sizeof *q->windows, "windows of the effects ledger", m));
    size_t n = common(l, own, own, q->windows);
    FW_CHECK(n > 0, m, FW_E_FAILURES, "none of %zu windows of the effects ledger succeeded: there is nothing to compare with", l->n_windows);
    FW_TRY(find_governing(l, own, c, n, q->windows, m));
    for (size_t i = 0; i < l->n_rows; i++) {
        if (p->arm[i] == 0) continue;
        FW_TRY(compare_row(l, &l->rows[i], p, &p->arms[p->arm[i]], c, q, m));
        free_law(&q->a);
        free_law(&q->b);
    }
    return FW_OK;
}

fw_status fw_effects_compare(fw_effects_ledger *l, const fw_effects_plan *p, const fw_campaign *c, fw_msg *m)
{
    comparison q;
    memset(&q, 0, sizeof q);
    fw_status s = compare(l, p, c, &q, m);
    free(q.windows);
    fw_paired_draws_free(&q.draws);
    free_law(&q.a);
    free_law(&q.b);
    return s;
}
