#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/ledger_inside.h"

void fw_ledger_write(char *to, size_t size, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    vsnprintf(to, size, fmt, args);
    va_end(args);
}

void fw_ledger_unmeasured(fw_ledger_row *row, const char *name, const char *shrinks_with)
{
    SAY(row->row, "%s", name);
    row->amount = NAN;
    SAY(row->shrinks_with, "not measured; %s", shrinks_with);
    SAY(row->cost_to_halve, "not measured");
}

static void sampling(fw_ledger_row *row, const fw_window *w, const fw_percentile_row *g)
{
    size_t n = w->depth->n_good + w->depth->n_failed;
    SAY(row->row, "sampling");
    row->amount = g->depth_mm > 0 ? (g->high_mm - g->low_mm) / (2 * g->depth_mm) : NAN;
    if (isfinite(row->amount)) {
        SAY(row->shrinks_with, "realisations, as 1/sqrt(n)");
    } else {
        SAY(row->shrinks_with, "realisations: %zu are too few for both ends of P%g", n, g->percentile);
    }
    SAY(row->cost_to_halve, "%zu realisations more (%.3g force evaluations)", 3 * n, 3 * w->depth->evaluations);
    row->cost_to_halve_cpu_s = 3 * w->depth->cpu_s;
}

/* A numerical error, paired on the same ice: it stays in every realisation, so that halving it means to run them all again. */
static void numerical(fw_ledger_row *row, const char *name, const fw_measured *all, const fw_measured_row *measured,
                      const fw_window *w)
{
    SAY(row->row, "%s", name);
    row->amount = measured->amount;
    if (isnan(measured->amount)) {
        SAY(row->shrinks_with, "not measured; %s", measured->shrinks_with);
        SAY(row->cost_to_halve, "not measured");
        return;
    }
    if (measured->error > 0)
        SAY(row->shrinks_with, "%s; measured %s, +- %.1g %%", measured->shrinks_with, all->origin,
            100 * measured->error);
    else
        SAY(row->shrinks_with, "%s; measured %s", measured->shrinks_with, all->origin);
    if (isnan(measured->cost_factor)) {
        SAY(row->cost_to_halve, "not known: %s", measured->halved_by);
        return;
    }
    SAY(row->cost_to_halve, "all again with %s, %.3g times the work (%.3g force evaluations)", measured->halved_by,
        measured->cost_factor, measured->cost_factor * w->depth->evaluations);
    row->cost_to_halve_cpu_s = measured->cost_factor * w->depth->cpu_s;
}

static void discretisation(fw_ledger_row *row, const fw_campaign *c, const fw_measured *all, const fw_window *w)
{
    for (size_t i = 0; i < all->n_rows; i++)
        if (strcmp(all->rows[i].row, "discretisation") == 0) {
            numerical(row, "discretisation", all, &all->rows[i], w);
            return;
        }
    SAY(row->row, "discretisation");
    row->amount = c->model.accuracy;
    SAY(row->shrinks_with, "accuracy: (the promise; measured energy truncation %.2g on average)",
        w->depth->truncation / (double)w->depth->n_good);
    SAY(row->cost_to_halve, "not measured");
}

/* The sum of ring, strip, reach and warm-up, and each of them: they have different remedies. Returns the number of rows. */
static size_t domain(fw_ledger_row *row, const fw_measured *all, const fw_window *w)
{
    fw_ledger_row *sum = row++;
    double         amount = 0;
    for (size_t i = 0; i < all->n_rows; i++) {
        if (strcmp(all->rows[i].row, "discretisation") == 0) continue;
        numerical(row++, all->rows[i].row, all, &all->rows[i], w);
        if (all->rows[i].amount > 0) amount += all->rows[i].amount;
    }
    SAY(sum->row, "window, domain and warm-up");
    sum->is_sum = row > sum + 1;
    sum->amount = row > sum + 1 ? amount : NAN;
    SAY(sum->shrinks_with, "%s",
        row > sum + 1 ? "the rows below, summed as if they all went one way"
                      : "not measured; exposure and strip settings");
    SAY(sum->cost_to_halve, "%s", row > sum + 1 ? "see there" : "not measured");
    return (size_t)(row - sum);
}

static void failed_runs(fw_ledger_row *row, const fw_window *w, const fw_percentile_row *g)
{
    SAY(row->row, "failed runs");
    row->amount = 0;
    if (w->depth->n_failed == 0) {
        if (w->depth->n_second)
            SAY(row->shrinks_with, "none failed; %zu of %zu at a first try, and not with finer steps", w->depth->n_second, w->depth->n_good);
        else
            SAY(row->shrinks_with, "none failed");
        SAY(row->cost_to_halve, "none");
        return;
    }
    double low, high;
    fw_window_failure_ends(w, g->percentile / 100, &low, &high);
    row->amount = isfinite(high) && g->depth_mm > 0 ? (high - low) / (2 * g->depth_mm) : NAN;
    SAY(row->shrinks_with, "%zu of %zu failed; counted as 0 and as infinity they give P%g %.3g .. %.3g mm",
        w->depth->n_failed, w->depth->n_good + w->depth->n_failed, g->percentile, low, high);
    SAY(row->cost_to_halve, "find the cause: run them again with --only-id");
}

/* The rigid disc's own limit: no step cures it. */
static void overlaps(fw_ledger_row *row, const fw_window *w)
{
    const fw_depth *d = w->depth;
    SAY(row->row, "overlaps beyond a tenth");
    row->amount = d->all_load > 0 ? d->overlap_wear / d->all_load : 0;
    SAY(row->cost_to_halve, "not known: stiffer contacts are another model");
    if (!(d->overlap_time > 0)) {
        SAY(row->shrinks_with, "none: the deepest contact was %.2g of the smaller radius", d->overlap_most);
        return;
    }
    SAY(row->shrinks_with,
        "contact.stiffness: wear in contacts deeper than a tenth of the smaller radius, where discs are no longer rigid; %.2g %% of the time, at "
        "most %.2g of a radius",
        100 * d->overlap_time / (double)d->n_good, d->overlap_most);
}

static void packed_ice(fw_ledger_row *row, const fw_window *w)
{
    const fw_depth *d = w->depth;
    double          ice = d->ice_ratio / (double)d->n_good - 1, size = d->size_ratio / (double)d->n_good - 1;
    SAY(row->row, "ice as packed");
    row->amount = fabs(ice);
    SAY(row->shrinks_with, "more ice per window: packed over wanted, mean over windows: concentration %+.2g %%, mean diameter %+.2g %%", 100 * ice,
        100 * size);
    SAY(row->cost_to_halve, "not known: the tiles of ice have one size");
}

/* Law of total variance: of what one window scatters, so much is its scenario's, whose law is known, and so much its ice's. The amount is what the ice alone
 * leaves to these realisations: no design and no control variate takes that off. */
static void ice_and_scenario(fw_ledger_row *row, const fw_window *w, const fw_percentile_row *g)
{
    const fw_control *x = &w->depth->control;
    double            n = (double)(w->depth->n_good + w->depth->n_failed);
    SAY(row->row, "ice field against scenario");
    if (!x->is_on) {
        row->amount = NAN;
        SAY(row->shrinks_with, "not told apart: %s", n < 60 ? "fewer than 60 realisations" : "one scenario, or scenarios that the emulator does not know");
        SAY(row->cost_to_halve, "not measured");
        return;
    }
    fw_window_scatter s = fw_window_scatter_at(w, g->depth_mm);
    double            width = (g->high_mm - g->low_mm) / (2 * g->depth_mm);
    row->amount = width;
    SAY(row->shrinks_with, "more or longer windows: of the scatter of P(D <= P%g) between windows %.2g %% is the scenario's, which its known law takes off, "
        "%.2g %% the ice's", g->percentile, 100 * fmax(0, 1 - s.controlled / s.averaged), 100 * fmin(1, s.controlled / s.averaged));
    SAY(row->cost_to_halve, "%.0f realisations more (%.3g force evaluations)", 3 * n, 3 * w->depth->evaluations);
}

/* What the control variates are made from. No depth is read off it: what it misses is in the row of sampling. */
static void emulator(fw_ledger_row *row, const fw_window *w)
{
    const fw_control  *x = &w->depth->control;
    const fw_emulator *e = &x->emulator;
    SAY(row->row, "emulator");
    row->amount = x->is_on ? 0 : NAN;
    SAY(row->cost_to_halve, "none: it costs precision, never truth");
    if (e->n_functions == 0)
        SAY(row->shrinks_with, "none: too few windows wore");
    else if (x->is_on)
        SAY(row->shrinks_with, "nothing is read off it: ln load by speed, concentration, mix and strip misses %.2g %% on windows held out, of a scatter of %.3g; "
            "weights of realisations %.2g to %.2g", 100 * e->held_out, e->scatter, x->least, x->most);
    else
        SAY(row->shrinks_with, "not used as control variate: ln load by speed, concentration, mix and strip misses %.2g %% on windows held out, of a scatter of %.3g",
            100 * e->held_out, e->scatter);
}

fw_status fw_ledger_rows(fw_answer *a, const fw_campaign *c, const fw_window *w, const fw_percentile_row *governing,
                         const fw_law_factor *law, size_t at, fw_msg *m)
{
    enum { MOST = 13 + FW_MEASURED_ROWS + FW_EFFECTS_ROWS };
    FW_TRY(fw_alloc(&a->ledger, MOST, sizeof *a->ledger, "rows of the ledger", m));
    for (size_t i = 0; i < MOST; i++) a->ledger[i].cost_to_halve_cpu_s = NAN;
    fw_ledger_row *row = a->ledger;
    sampling(row++, w, governing);
    discretisation(row++, c, &a->measured, w);
    row += domain(row, &a->measured, w);
    failed_runs(row++, w, governing);
    overlaps(row++, w);
    packed_ice(row++, w);
    ice_and_scenario(row++, w, governing);
    emulator(row++, w);
    FW_TRY(fw_ledger_law(row++, c, law, at, &a->law_scatter, governing, m));
    fw_ledger_contact_law(row++, c, &a->effects, w);
    row += fw_ledger_effects(row, c, &a->effects, w);
    if (c->service.is_asked) {
        fw_ledger_years(row++, c, &a->service.points[at]);
        fw_ledger_persistence(row++, c, &a->service.points[at]);
    }
    a->n_ledger = (size_t)(row - a->ledger);
    return FW_OK;
}
