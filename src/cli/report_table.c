#include "cli/report_summary.h"
#include "cli/report_table.h"

#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "cli/effects_print.h"
#include "floewear/status.h"

static size_t percentiles_per_point(const fw_answer *a) { return a->n_points ? a->n_percentiles / a->n_points : 0; }

/* Power of ten taken out of a table whose largest entry is this: 5.1e-4 prints as 5.10 under "1e-4 mm". */
typedef struct scaling {
    int    exponent;
    double divisor;
} scaling;

static scaling scaling_for(double largest)
{
    int exponent = largest > 0 && isfinite(largest) ? (int)floor(log10(largest)) : 0;
    if (exponent >= -1 && exponent <= 3) exponent = 0; /* ordinary numbers stay as they are */
    return (scaling){exponent, pow(10, exponent)};
}

static const char *unit_of(scaling s, char *text, size_t size)
{
    if (s.exponent == 0) {
        snprintf(text, size, "mm");
    } else {
        snprintf(text, size, "1e%d mm", s.exponent);
    }
    return text;
}

/* Few characters, three digits where there are that many: 0, <.001, 0.012, 5.10, 42.1, 310; "none" for what does not
 * exist. */
static const char *format_number(char *text, size_t size, double x)
{
    if (!isfinite(x)) {
        snprintf(text, size, "none");
    } else if (x == 0) {
        snprintf(text, size, "0");
    } else if (x > 0 && x < 0.0005) {
        snprintf(text, size, "<.001"); /* not the 0 of a point that is not touched */
    } else {
        snprintf(text, size, "%.*f", x < 1 ? 3 : x < 10 ? 2 : x < 100 ? 1 : 0, x);
    }
    return text;
}

/* "5.10 [4.42, 6.03]" */
static void format_with_interval(char *text, size_t size, scaling s, double value, double low, double high)
{
    char texts[3][32];
    snprintf(text, size, "%s [%s, %s]", format_number(texts[0], sizeof texts[0], value / s.divisor),
             format_number(texts[1], sizeof texts[1], low / s.divisor),
             format_number(texts[2], sizeof texts[2], high / s.divisor));
}

static void print_cell(FILE *to, const char *text, int width) { fprintf(to, "  %-*s", width, text); }

static void print_share(FILE *to, double share)
{
    if (isfinite(share)) {
        fprintf(to, "  %5.1f %%", 100 * share);
    } else {
        fprintf(to, "  %7s", "-"); /* a point that nothing touched */
    }
}

/* The ledger's largest row at the point. */
static void print_doubt(FILE *to, const fw_point_row *p)
{
    if (isnan(p->dominating_amount))
        fprintf(to, "  -\n");
    else if (isfinite(p->dominating_amount))
        fprintf(to, "  %s %.2g %%\n", p->dominated_by, 100 * p->dominating_amount);
    else
        fprintf(to, "  %s\n", p->dominated_by);
}

static void print_points(FILE *to, const fw_answer *a, bool is_together)
{
    char   text[128], unit[32];
    double largest = 0;
    size_t n = percentiles_per_point(a);
    for (size_t i = 0; i < a->n_percentiles; i++) largest = fmax(largest, a->percentiles[i].depth_mm);
    for (size_t i = 0; i < a->n_points; i++) largest = fmax(largest, a->points[i].mean_mm);
    scaling s = scaling_for(largest);
    fprintf(to, "depth of one window in %s, [%g %% interval%s] by %s\n\n", unit_of(s, unit, sizeof unit),
            100 * a->confidence, is_together ? ", all points together" : "", a->n_percentiles ? a->percentiles[0].method : "");
    fprintf(to, "point bearing  mean ");
    for (size_t k = 0; k < n; k++) {
        snprintf(text, sizeof text, "P%g", a->percentiles[k].percentile);
        fprintf(to, "  %-20s", text);
    }
    fprintf(to, "  impact   >5 MPa  path       most doubt\n");
    for (size_t i = 0; i < a->n_points; i++) {
        const fw_point_row *p = &a->points[i];
        fprintf(to, "%5zu %6.1f   %-5s", p->point, p->bearing_deg,
                format_number(text, sizeof text, p->mean_mm / s.divisor));
        for (size_t k = 0; k < n; k++) {
            const fw_percentile_row *row = &a->percentiles[i * n + k];
            format_with_interval(text, sizeof text, s, row->depth_mm, is_together ? row->band_low_mm : row->low_mm,
                                 is_together ? row->band_high_mm : row->high_mm);
            fprintf(to, "  %-20s", text);
        }
        print_share(to, p->impact_share);
        print_share(to, p->high_share);
        snprintf(text, sizeof text, "%.3g m", 1000 * p->path_km);
        fprintf(to, "  %-9s", text);
        print_doubt(to, p);
    }
}

/* What floes that hit one by one would do: whether the result is of the right order. */
static void print_swept(FILE *to, const fw_answer *a)
{
    const fw_sanity_ring *r = &a->swept_ring;
    if (a->n_swept == 0) {
        fprintf(to, "sanity check: no swept strip: %s\n", a->swept_why);
        return;
    }
    if (!isfinite(r->ratio)) {
        fprintf(to, "sanity check: by the swept strip, floes that hit one by one in the same conditions, nothing wears\n");
        return;
    }
    fprintf(to, "sanity check: the mean window wears the wall %.3g times as much as the swept strip, floes that hit one by one in the same conditions (floes that "
                "press one another: usually %.3g times); by the strip, the site's law wears %.3g times the mean of these conditions\n",
            r->ratio, r->usual, r->law_over_sample);
}

static void print_water_level(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    const fw_water_level *w = &a->water_level;
    if (!c->after.has_water_level) return;
    if (w->n == 0) {
        fprintf(to, "over height: nothing wore\n");
        return;
    }
    fprintf(to, "over height, there: most at %+.2f m about the mean level, %.3g %% of a window's depth; 90 %% of the wear between %+.2f and %+.2f m "
                "(ice that wore is %.2f m thick)\n",
            w->most_height, 100 * w->most_share, w->band_low, w->band_high, w->thickness);
}

static void print_life(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    char   text[128], unit[32];
    double largest = 0;
    size_t n = percentiles_per_point(a);
    bool   has_allowance = c->service.allowance > 0;
    if (a->n_life == 0) return;
    for (size_t i = 0; i < a->n_life; i++) largest = fmax(largest, a->life[i].depth_mm);
    scaling s = scaling_for(largest);
    fprintf(to,
            "\nservice life: %g years of %g h of ice%s, %.0f %s; depth in %s, [%g %% interval]\n",
            c->service.life_years, c->service.ice_hours_per_year, c->service.n_table ? " in the mean" : "", a->life[0].windows, a->service.assumption,
            unit_of(s, unit, sizeof unit), 100 * a->confidence);
    if (has_allowance)
        fprintf(to, "(year): the year in which the allowance of %g mm is used up, - if it is not\n",
                c->service.allowance);
    fprintf(to, "\npoint bearing");
    for (size_t k = 0; k < n; k++) {
        snprintf(text, sizeof text, "P%g", a->life[k].percentile);
        print_cell(to, text, k + 1 < n ? (has_allowance ? 26 : 20) : 0);
    }
    fputc('\n', to);
    for (size_t i = 0; i < a->n_points; i++) {
        fprintf(to, "%5zu %6.1f ", a->points[i].point, a->points[i].bearing_deg);
        for (size_t k = 0; k < n; k++) {
            const fw_life_row *row = &a->life[i * n + k];
            char               year[16] = "-";
            format_with_interval(text, sizeof text, s, row->depth_mm, row->low_mm, row->high_mm);
            if (isfinite(row->allowance_year)) snprintf(year, sizeof year, "%.0f", row->allowance_year);
            if (has_allowance) {
                size_t used = strlen(text);
                snprintf(text + used, sizeof text - used, "%*s(%s)", used < 20 ? (int)(20 - used) + 1 : 1, "", year);
            }
            print_cell(to, text, k + 1 < n ? (has_allowance ? 26 : 20) : 0);
        }
        fputc('\n', to);
    }
}

/* A year; "later" when it is not within the life. */
static const char *format_year(char *text, size_t size, double year)
{
    if (isfinite(year))
        snprintf(text, size, "%.0f", year);
    else
        snprintf(text, size, "later");
    return text;
}

static void print_allowance(FILE *to, const fw_life_point *p)
{
    char years[3][16];
    if (isnan(p->never)) return;
    fprintf(to, "the allowance of %g mm, there: ", p->allowance_mm);
    if (p->never > 1 - 5e-5) {
        fprintf(to, "outlasts the life\n");
        return;
    }
    fprintf(to, "used up within the life by a probability of %.3g %%, half of all lives by year %s, 5 %% by %s, 95 %% by %s\n",
            100 * (1 - p->never), format_year(years[0], sizeof years[0], p->allowance_year_p50), format_year(years[1], sizeof years[1], p->allowance_year_p5),
            format_year(years[2], sizeof years[2], p->allowance_year_p95));
}

static void print_with_law(FILE *to, const fw_answer *a, const fw_life_point *p, const fw_life_row *row)
{
    if (isnan(row->with_law_depth_mm)) return;
    fprintf(to, "what is not known of the law, there: P%g = %.3g mm with it; %g %% of all laws put P%g at %.3g .. %.3g mm", row->percentile,
            row->with_law_depth_mm, 100 * a->confidence, row->percentile, row->with_law_low_mm, row->with_law_high_mm);
    if (isfinite(p->with_law_never)) fprintf(to, ", the allowance used up within the life by %.3g %%", 100 * (1 - p->with_law_never));
    fputc('\n', to);
}

/* The point that governs the life: where its scatter comes from, when the allowance is used up, and what the law's uncertainty makes of it. */
static void print_governing_life(FILE *to, const fw_answer *a)
{
    for (size_t i = 0; i < a->n_life; i++) {
        const fw_life_row   *row = &a->life[i];
        const fw_life_point *p = &a->service.points[i / percentiles_per_point(a)];
        if (row->point != a->service.governing_point || row->percentile != a->design_percentile || !(p->mean_mm > 0)) continue;
        fprintf(to, "\ngoverning the life: point %zu (%g deg), P%g = %.3g mm; coefficient of variation %.2g %% (in squares: independent windows %.2g %%, "
                    "persistence %.2g %%, years %.2g %%)\n",
                row->point, row->bearing_deg, row->percentile, row->depth_mm, 100 * p->cv, 100 * p->cv_windows, 100 * p->cv_persistence,
                100 * p->cv_years);
        print_allowance(to, p);
        print_with_law(to, a, p, row);
    }
}

static void print_ledger(FILE *to, const fw_answer *a)
{
    fprintf(to, "\nledger of the governing number\n");
    for (size_t i = 0; i < a->n_ledger; i++) {
        const fw_ledger_row *row = &a->ledger[i];
        fprintf(to, "  %-26s", row->row);
        if (row->amount == 0) {
            fprintf(to, " %8d %%  %s", 0, row->shrinks_with);
        } else if (isfinite(row->amount)) {
            fprintf(to, " %8.2g %%  ", 100 * row->amount);
            fprintf(to, "shrinks with %s", row->shrinks_with);
            fprintf(to, "; half of it costs: %s", row->cost_to_halve);
            if (isfinite(row->cost_to_halve_cpu_s)) fprintf(to, ", %.3g CPU s", row->cost_to_halve_cpu_s);
        } else {
            fprintf(to, " %10s  %s", "-", row->shrinks_with);
        }
        fputc('\n', to);
    }
}

/* The design number by the spring and by ice that crushes, side by side: this run's own, and what the other law made of it where it was measured. */
static void print_both_laws(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    const fw_effects_row    *crush = fw_effects_find_row(&a->effects, "crush_contact");
    const fw_percentile_row *own = NULL;
    for (size_t i = 0; i < a->n_percentiles; i++)
        if (a->percentiles[i].point == a->governing_point && a->percentiles[i].percentile == a->effects.percentile) own = &a->percentiles[i];
    if (!crush || crush->note[0] || !own || crush->was_on != ((c->model.effects & FW_EFFECT_CRUSH_CONTACT) != 0)) return;
    const fw_change *by = &crush->percentile;
    fprintf(to, "  contact laws side by side, P%g at point %zu: %s %.3g mm (this run), %s %.3g mm", own->percentile, own->point,
            crush->was_on ? "crushing" : "spring", own->depth_mm, crush->was_on ? "spring" : "crushing", own->depth_mm * (1 + by->change));
    if (isfinite(by->low) && isfinite(by->high)) fprintf(to, " [%.3g, %.3g]", own->depth_mm * (1 + by->low), own->depth_mm * (1 + by->high));
    fputc('\n', to);
}

static void print_effects(FILE *to, const fw_campaign *c, const fw_answer *a)
{
    if (a->effects.n_rows == 0) return;
    fprintf(to, "\neffects and open choices, switched one at a time on the same ice, %s\n", a->effects.origin);
    fw_effects_print_rows(to, &a->effects);
    print_both_laws(to, c, a);
}

static void print_limits(FILE *to, const fw_campaign *c)
{
    fputc('\n', to);
    for (size_t i = 0; i < c->n_not_applied; i++) fprintf(to, "not applied in this version: %s\n", c->not_applied[i]);
    if (c->model.effects & FW_EFFECT_FORM_DRAG)
        fprintf(to, "assumed: form drag %g on the side area D h (the source gives the number, not the area)\n",
                c->model.form_drag);
    fprintf(to, "not modelled: level-ice crushing at MPa. Published field rates of 0.2-7 mm/year include it; "
                "unbreakable floes do not.\n");
}

static void print_table(FILE *to, const fw_campaign *c, const fw_answer *a, bool is_together)
{
    fw_report_print_summary(to, c, a);
    print_points(to, a, is_together);
    fputc('\n', to);
    print_swept(to, a);
    print_water_level(to, c, a);
    print_life(to, c, a);
    print_governing_life(to, a);
    print_ledger(to, a);
    print_effects(to, c, a);
    print_limits(to, c);
}

void fw_report_print_table(FILE *to, const fw_campaign *c, const fw_answer *a) { print_table(to, c, a, false); }

void fw_report_print_simultaneous(FILE *to, const fw_campaign *c, const fw_answer *a) { print_table(to, c, a, true); }
