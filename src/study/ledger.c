#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/rows.h"

static void write_text(char *to, size_t size, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
static void write_text(char *to, size_t size, const char *fmt, ...)
{
    va_list args;
    va_start(args, fmt);
    vsnprintf(to, size, fmt, args);
    va_end(args);
}

#define SAY(field, ...) write_text((field), sizeof(field), __VA_ARGS__)

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

static void unmeasured(fw_ledger_row *row, const char *name, const char *shrinks_with)
{
    SAY(row->row, "%s", name);
    row->amount = NAN;
    SAY(row->shrinks_with, "not measured; %s", shrinks_with);
    SAY(row->cost_to_halve, "not measured");
}

/* ---- effects that are off --------------------------------------------------------------------------------------- */

/* Of the design number of this run, in which the effect is off: it may have been on where it was measured, and was left out since. */
static double amount_of(const fw_effects_row *e)
{
    const fw_change *c = isnan(e->percentile.change) ? &e->mean : &e->percentile;
    double           amount = fabs(e->was_on ? -c->change / (1 + c->change) : c->change), error = 0.25 * (c->high - c->low);
    return error > amount ? error : amount; /* what scatter hides may be as large as the scatter */
}

static void say_change(char *to, size_t size, const fw_change *c)
{
    if (isnan(c->change))
        write_text(to, size, "-");
    else if (isnan(c->low) || isnan(c->high))
        write_text(to, size, "%+.2g %%", 100 * c->change);
    else
        write_text(to, size, "%+.3g [%+.3g, %+.3g] %%", 100 * c->change, 100 * c->low, 100 * c->high);
}

static void switched_off(fw_ledger_row *row, const fw_effects_ledger *l, const fw_effects_row *e, const fw_window *w)
{
    char   mean[64], percentile[64];
    double factor = e->was_on ? 1 / (1 - e->evaluations_saved) : 1 - e->evaluations_saved, cpu = e->was_on ? 1 / (1 - e->cpu_saved) : 1 - e->cpu_saved;
    say_change(mean, sizeof mean, &e->mean);
    say_change(percentile, sizeof percentile, &e->percentile);
    SAY(row->row, "%s", e->name);
    row->amount = amount_of(e);
    SAY(row->shrinks_with, "effects: {%s: on}; %s gave mean %s, P%g %s, measured %.90s", e->name, e->change, mean, l->percentile, percentile, l->origin);
    SAY(row->cost_to_halve, "all again with it, %.3g times the work (%.3g force evaluations)", factor, factor * w->depth->evaluations);
    row->cost_to_halve_cpu_s = cpu * w->depth->cpu_s;
}

/* Their sum, and each of them that was measured. Returns the number of rows. */
static size_t switched_off_effects(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w)
{
    fw_ledger_row *sum = row++;
    double         amount = 0;
    if (l->n_rows == 0) {
        unmeasured(sum, "switched-off effects", "floewear plan --effects measures what they move");
        return 1;
    }
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *e = &l->rows[i];
        if (!e->bit || (c->model.effects & e->bit) || e->note[0] || e->bit == FW_EFFECT_CRUSH_CONTACT) continue;
        switched_off(row, l, e, w);
        if (row->amount > 0) amount += row->amount;
        row++;
    }
    SAY(sum->row, "switched-off effects");
    sum->amount = amount;
    SAY(sum->shrinks_with, "%s", row > sum + 1 ? "the rows below, summed as if they all went one way" : "none is off that could be on here");
    SAY(sum->cost_to_halve, "%s", row > sum + 1 ? "see there" : "none");
    return (size_t)(row - sum);
}

/* Spring or ice that crushes: two models of one contact, of which neither is left out. */
static void contact_law(fw_ledger_row *row, const fw_campaign *c, const fw_effects_ledger *l, const fw_window *w)
{
    const fw_effects_row *e = NULL;
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->rows[i].bit == FW_EFFECT_CRUSH_CONTACT && !l->rows[i].note[0]) e = &l->rows[i];
    if (!e) {
        unmeasured(row, "contact law", "floewear plan --effects sets spring and crushing side by side");
        return;
    }
    bool is_crush = (c->model.effects & FW_EFFECT_CRUSH_CONTACT) != 0;
    char mean[64], percentile[64];
    say_change(mean, sizeof mean, &e->mean);
    say_change(percentile, sizeof percentile, &e->percentile);
    SAY(row->row, "contact law");
    row->amount = amount_of(e);
    SAY(row->shrinks_with, "ice that is known: here %s; %s gave mean %s, P%g %s, measured %.80s", is_crush ? "it crushes" : "a spring",
        is_crush ? "the spring" : "crushing", mean, l->percentile, percentile, l->origin);
    double factor = e->was_on ? 1 / (1 - e->evaluations_saved) : 1 - e->evaluations_saved, cpu = e->was_on ? 1 / (1 - e->cpu_saved) : 1 - e->cpu_saved;
    SAY(row->cost_to_halve, "all again with the other one, %.3g times the work (%.3g force evaluations)", factor, factor * w->depth->evaluations);
    row->cost_to_halve_cpu_s = cpu * w->depth->cpu_s;
}

/* ---- the law and the years --------------------------------------------------------------------------------------- */

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The scatter alone is exact; coefficient and exponent come in draws. */
static fw_status take_law(const fw_campaign *c, const fw_law_factor *law, size_t i, fw_law_scatter *out, fw_msg *m)
{
    const fw_distribution *f = &c->after.law_scatter;
    double                *factor = NULL;
    if (law->n == 0 || !(c->after.has_law_coefficient || c->after.has_law_exponent)) {
        *out = (fw_law_scatter){true, fw_distribution_mean(f), fw_distribution_quantile(f, 0.5), fw_distribution_quantile(f, 0.025),
                                fw_distribution_quantile(f, 0.975)};
        return FW_OK;
    }
    FW_TRY(fw_alloc(&factor, law->n, sizeof *factor, "draws of a law", m));
    fw_law_factor_of_point(law, i, factor);
    *out = (fw_law_scatter){.is_given = true};
    for (size_t k = 0; k < law->n; k++) out->mean += factor[k] / (double)law->n;
    qsort(factor, law->n, sizeof *factor, compare_doubles);
    out->median = fw_order_percentile(law->n, factor, 0.5);
    out->low = fw_order_percentile(law->n, factor, 0.025);
    out->high = fw_order_percentile(law->n, factor, 0.975);
    free(factor);
    return FW_OK;
}

/* A factor on every depth: no part of a window's percentiles, which are those of the law as it stands. */
static fw_status law_scatter(fw_ledger_row *row, const fw_campaign *c, const fw_law_factor *law, size_t i, fw_law_scatter *out,
                             const fw_percentile_row *g, fw_msg *m)
{
    if (!c->after.has_law_scatter && law->n == 0) {
        unmeasured(row, "law and its scatter", "laboratory and field data (a published fit has R2 66 %)");
        return FW_OK;
    }
    FW_TRY(take_law(c, law, i, out, m));
    SAY(row->row, "law and its scatter");
    row->amount = (out->high - out->low) / (2 * out->median);
    SAY(row->shrinks_with, "laboratory and field data: factor of mean %.3g, 95 %% of it in %.3g .. %.3g, which makes P%g %.3g .. %.3g mm", out->mean,
        out->low, out->high, g->percentile, out->low * g->depth_mm, out->high * g->depth_mm);
    SAY(row->cost_to_halve, "not known: no computation shrinks it");
    return FW_OK;
}

/* Half of what 95 % of a normal law with this coefficient of variation spans. */
static double half_of(double cv) { return 1.96 * cv; }

static void resemblance(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p)
{
    if (!(c->service.persistence > 0)) {
        unmeasured(row, "life: independent windows", "windows that resemble their neighbours scatter a life more (service.persistence)");
        return;
    }
    SAY(row->row, "life: persistence");
    row->amount = half_of(p->cv_persistence);
    SAY(row->shrinks_with, "nothing: persistence %g spreads lives this much and is in their percentiles, beside %.2g %% of independent windows",
        c->service.persistence, 100 * half_of(p->cv_windows));
    SAY(row->cost_to_halve, "none: it is scatter, no error");
}

static void between_years(fw_ledger_row *row, const fw_campaign *c, const fw_life_point *p)
{
    const fw_service *q = &c->service;
    SAY(row->row, "between years");
    if (q->n_table) {
        row->amount = p->years_half_width;
        SAY(row->shrinks_with, "more years than the %zu of the table: half-width for not knowing the law of years, in the interval of the life; years that "
            "differ spread lives by %.2g %%", q->n_table, 100 * half_of(p->cv_years));
        SAY(row->cost_to_halve, "%zu years more of the site's record", 3 * q->n_table);
        return;
    }
    if (!(q->year_to_year_cv > 0)) {
        unmeasured(row, "between years", "no year_to_year_cv and no table of years is given");
        return;
    }
    row->amount = half_of(p->cv_years);
    SAY(row->shrinks_with, "nothing: year_to_year_cv %g spreads lives this much and is in their percentiles; a record of whole years (service.years) "
        "says whether it is true", q->year_to_year_cv);
    SAY(row->cost_to_halve, "none: it is scatter, no error");
}

fw_status fw_ledger_rows(fw_answer *a, const fw_campaign *c, const fw_window *w, const fw_percentile_row *governing,
                         const fw_law_factor *law, size_t at, fw_msg *m)
{
    enum { MOST = 12 + FW_MEASURED_ROWS + FW_EFFECTS_ROWS };
    FW_TRY(fw_alloc(&a->ledger, MOST, sizeof *a->ledger, "rows of the ledger", m));
    for (size_t i = 0; i < MOST; i++) a->ledger[i].cost_to_halve_cpu_s = NAN;
    fw_ledger_row *row = a->ledger;
    sampling(row++, w, governing);
    discretisation(row++, c, &a->measured, w);
    row += domain(row, &a->measured, w);
    failed_runs(row++, w, governing);
    overlaps(row++, w);
    packed_ice(row++, w);
    unmeasured(row++, "ice field against scenario", "more realisations");
    FW_TRY(law_scatter(row++, c, law, at, &a->law_scatter, governing, m));
    contact_law(row++, c, &a->effects, w);
    row += switched_off_effects(row, c, &a->effects, w);
    if (c->service.is_asked) {
        between_years(row++, c, &a->service.points[at]);
        resemblance(row++, c, &a->service.points[at]);
    }
    a->n_ledger = (size_t)(row - a->ledger);
    return FW_OK;
}
