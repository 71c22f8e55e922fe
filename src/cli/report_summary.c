#include "cli/report_summary.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char *design_words(const fw_sampling *s, char *text, size_t size)
{
    static const char *const names[] = {"", "stratified", "Latin hypercube", "Sobol"};
    if (s->design == FW_DESIGN_PLAIN) return "plain sampling";
    snprintf(text, size, "%s design in %" PRIu32 " randomisations", names[s->design], s->n_randomisations);
    return text;
}

/* "3 h", "90 s" */
static const char *window_words(const fw_campaign *c, char *text, size_t size)
{
    double window = c->model.window;
    snprintf(text, size, "%g %s", window >= 3600 ? window / 3600 : window, window >= 3600 ? "h" : "s");
    return text;
}

static void print_what(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    char window[40], design[64];
    fprintf(to, "%s: wear of concrete by drifting floes at %zu points, from %" PRIu64 " realisations of %s", c->name, a->n_points, a->n,
            window_words(c, window, sizeof window));
    if (a->n_failed) fprintf(to, ", %" PRIu64 " failed (0 in the lower, infinite in the upper ends)", a->n_failed);
    fprintf(to, ", %s, seed %" PRIu64 "\n", design_words(&c->sampling, design, sizeof design), c->seed);
    fprintf(to, "exposure: one window of %s under the site's scenarios, temperatures and directions", window_words(c, window, sizeof window));
    if (c->service.is_asked) fprintf(to, "; and a life of %g years of %s", c->service.life_years, a->service.assumption);
    fputc('\n', to);
}

/* Which realisations, where they are not the first n of the campaign. */
static void print_part(FILE *to, const fw_answer *a)
{
    const fw_id_span *s = &a->span;
    if (s->first == 0 && (s->end == 0 || s->end == a->n)) return;
    fprintf(to, "a part of the campaign: realisations %" PRIu64 " to %" PRIu64, s->first, s->end - 1);
    if (s->end - s->first > a->n) {
        fprintf(to, ", of which %" PRIu64 " are missing, the first gap from %" PRIu64 " to %" PRIu64, s->end - s->first - a->n, s->gap_first,
                s->gap_end - 1);
    }
    fputc('\n', to);
}

static const fw_percentile_row *governing_row(const fw_answer *a)
{
    for (size_t i = 0; i < a->n_percentiles; i++)
        if (a->percentiles[i].point == a->governing_point && a->percentiles[i].percentile == a->design_percentile) return &a->percentiles[i];
    return NULL;
}

/* The same with the interval that covers at every point where anything wears, not at this one alone. */
static void print_together(FILE *to, const fw_answer *a, const fw_percentile_row *governing)
{
    char   texts[2][32];
    size_t n = 0;
    for (size_t i = 0; i < a->n_percentiles; i++) n += a->percentiles[i].percentile == governing->percentile && a->percentiles[i].depth_mm > 0;
    if (n < 2 || (isnan(governing->band_low_mm) && isnan(governing->band_high_mm))) return;
    for (int i = 0; i < 2; i++) {
        double end = i == 0 ? governing->band_low_mm : governing->band_high_mm;
        snprintf(texts[i], sizeof texts[i], isnan(end) ? "none" : "%.3g", end);
    }
    fprintf(to, "all %zu points together (%g %%): P%g at the governing point [%s, %s] mm\n", n, 100 * a->confidence, governing->percentile, texts[0],
            texts[1]);
}

static void print_governing(FILE *to, const fw_answer *a)
{
    const fw_percentile_row *row = governing_row(a);
    if (!row) return;
    fprintf(to, "governing: point %zu (%g deg), P%g = %.3g mm in one window", row->point, row->bearing_deg, row->percentile, row->depth_mm);
    if (isfinite(row->low_mm) && isfinite(row->high_mm)) {
        fprintf(to, ", %g %% interval [%.3g, %.3g] mm", 100 * a->confidence, row->low_mm, row->high_mm);
    } else {
        fprintf(to, "; %" PRIu64 " realisations are too few for both ends of an interval", a->n);
    }
    if (isfinite(row->coverage)) fprintf(to, " (%s coverage %.1f %%)", row->method[0] == 'o' ? "attained" : "nominal", 100 * row->coverage);
    fputc('\n', to);
    print_together(to, a, row);
}

static void print_life(FILE *to, const fw_answer *a)
{
    for (size_t i = 0; i < a->n_life; i++) {
        const fw_life_row *row = &a->life[i];
        if (row->point != a->service.governing_point || row->percentile != a->design_percentile) continue;
        fprintf(to, "of a life: point %zu (%g deg), P%g = %.3g mm", row->point, row->bearing_deg, row->percentile, row->depth_mm);
        if (isfinite(row->low_mm) && isfinite(row->high_mm)) fprintf(to, ", %g %% interval [%.3g, %.3g] mm", 100 * a->confidence, row->low_mm, row->high_mm);
        fputc('\n', to);
        return;
    }
}

const char *fw_report_quantity(const fw_campaign *c, char *text, size_t size)
{
    if (c->precision.quantity == FW_QUANTITY_MEAN)
        snprintf(text, size, "mean");
    else
        snprintf(text, size, "P%g", c->precision.percentile);
    return text;
}

static void print_precision(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    char quantity[32];
    if (!(c->precision.half_width > 0)) return;
    if (c->precision.quantity == FW_QUANTITY_PERCENTILE && a->design_percentile != c->precision.percentile) return;
    fprintf(to, "precision: %s asked to +- %.3g %%, reached ", fw_report_quantity(c, quantity, sizeof quantity), 100 * c->precision.half_width);
    if (isfinite(a->half_width)) {
        fprintf(to, "+- %.3g %% at the worst of the points%s\n", 100 * a->half_width,
                a->half_width <= c->precision.half_width ? "" : " (not enough realisations)");
    } else {
        fprintf(to, "none yet (not enough realisations)\n");
    }
}

/* The interval is the sampling's: only more windows make it narrower. */
static void print_interval_cost(FILE *to, const fw_answer *a)
{
    for (size_t i = 0; i < a->n_ledger; i++) {
        const fw_ledger_row *r = &a->ledger[i];
        if (strcmp(r->row, "sampling") != 0 || !isfinite(r->cost_to_halve_cpu_s)) continue;
        fprintf(to, "half that interval: %s, %.3g CPU hours\n", r->cost_to_halve, r->cost_to_halve_cpu_s / 3600);
    }
}

static void print_advice(FILE *to, const fw_answer *a)
{
    const fw_advice     *v = &a->advice;
    const fw_ledger_row *largest = v->largest < a->n_ledger ? &a->ledger[v->largest] : NULL, *best = v->best_paid < a->n_ledger ? &a->ledger[v->best_paid] : NULL;
    if (largest)
        fprintf(to, "doubt: %.2g %% in all, rows of the ledger added in squares; most of it in %s (%.2g %%)\n", 100 * v->total, largest->row, 100 * largest->amount);
    if (best)
        fprintf(to, "best for a CPU hour: halve %s (%.2g %%): %s, %.3g CPU hours; all doubt then %.2g %%\n", best->row, 100 * best->amount, best->cost_to_halve,
                best->cost_to_halve_cpu_s / 3600, 100 * v->total_after);
    if (largest || best) fputc('\n', to);
}

void fw_report_print_summary(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    print_what(to, c, a);
    print_part(to, a);
    print_governing(to, a);
    print_life(to, a);
    print_precision(to, c, a);
    print_interval_cost(to, a);
    print_advice(to, a);
}
