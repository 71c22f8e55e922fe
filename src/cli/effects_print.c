#include "cli/effects_print.h"

#include <math.h>
#include <string.h>

/* ---- text ------------------------------------------------------------------------------------------------------- */

/* "+1.2", "-23", "+130" */
static const char *percent(char *text, size_t size, double x)
{
    snprintf(text, size, fabs(x) >= 1 ? "%+.0f" : "%+.2g", 100 * x);
    return text;
}

/* Twice and more, or less than half, is easier read as a factor. */
const char *fw_effects_say_change(char *text, size_t size, const fw_change *c)
{
    char x[3][24];
    bool is_factor = c->change >= 1 || c->change <= -0.5, has_interval = isfinite(c->low) && isfinite(c->high);
    if (isnan(c->change))
        snprintf(text, size, "-");
    else if (c->change == 0 && c->low == 0 && c->high == 0)
        snprintf(text, size, "0");
    else if (is_factor && has_interval)
        snprintf(text, size, "x%.3g [%.3g, %.3g]", 1 + c->change, 1 + c->low, 1 + c->high);
    else if (is_factor)
        snprintf(text, size, "x%.3g", 1 + c->change);
    else if (has_interval)
        snprintf(text, size, "%s [%s, %s] %%", percent(x[0], sizeof x[0], c->change), percent(x[1], sizeof x[1], c->low), percent(x[2], sizeof x[2], c->high));
    else
        snprintf(text, size, "%s %%", percent(x[0], sizeof x[0], c->change));
    return text;
}

static const char *say_share(char *text, size_t size, double share)
{
    if (isnan(share))
        snprintf(text, size, "-");
    else
        snprintf(text, size, share == 0 ? "0" : "%.1f %%", fabs(share) < 0.0005 ? 0 : 100 * share); /* never -0.0 */
    return text;
}

void fw_effects_print_rows(FILE *to, const fw_effects_ledger *l)
{
    char x[6][48], head[24];
    if (l->n_rows == 0) return;
    snprintf(head, sizeof head, "P%g", l->percentile);
    fprintf(to, "  %-27s %-16s %-26s %-26s %10s %10s\n", "", "", "mean", head, "CPU saved", "CPU share");
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *r = &l->rows[i];
        fprintf(to, "  %-27s %-16s ", r->name, r->change);
        if (r->note[0])
            fprintf(to, "%s\n", r->note);
        else
            fprintf(to, "%-26s %-26s %10s %10s  %s\n", fw_effects_say_change(x[0], sizeof x[0], &r->mean),
                    fw_effects_say_change(x[1], sizeof x[1], &r->percentile), say_share(x[2], sizeof x[2], r->cpu_saved),
                    say_share(x[3], sizeof x[3], r->cpu_share), r->why);
    }
}

static void print_costs(FILE *to, const fw_effects_ledger *l)
{
    double cpu = l->cpu_bare, evaluations = l->evaluations_bare;
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->rows[i].is_effect && isfinite(l->rows[i].cpu_share)) cpu += l->rows[i].cpu_share, evaluations += l->rows[i].evaluations_share;
    fprintf(to, "\ncost shares, effects switched off one after another (a share below 0: what stays costs more without it)\n");
    fprintf(to, "  %-27s %10s %18s\n", "", "CPU", "force evaluations");
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *r = &l->rows[i];
        if (r->is_effect && isfinite(r->cpu_share)) fprintf(to, "  %-27s %8.1f %% %16.1f %%\n", r->name, 100 * r->cpu_share, 100 * r->evaluations_share);
    }
    fprintf(to, "  %-27s %8.1f %% %16.1f %%\n", "drift and touch", 100 * l->cpu_bare, 100 * l->evaluations_bare);
    fprintf(to, "  %-27s %8.1f %% %16.1f %%  of %.3g CPU s and %.4g evaluations; a difference of two ways is known to %.1g %% of processor time\n", "sum",
            100 * cpu, 100 * evaluations, l->cpu_s, l->evaluations, 100 * l->cpu_noise);
}

void fw_effects_print_text(FILE *to, const fw_campaign *c, const fw_effects_ledger *l)
{
    size_t failed = 0;
    fprintf(to, "%s: what each effect and open choice moves, one at a time, on the same ice\n", c->name);
    if (l->seconds < c->model.window)
        fprintf(to, "%zu windows of %.3g s (%.3g m of ice in the mean), scaled to %g s", l->n_windows, l->seconds, l->way, c->model.window);
    else
        fprintf(to, "%zu windows of %g s", l->n_windows, c->model.window);
    fprintf(to, "; window depth at point %zu (%g deg): mean %.3g mm, P%g %.3g mm; [%g %% interval]\n\n", l->point, c->points.bearing[l->point - 1],
            l->mean_mm, l->percentile, l->percentile_mm, 100 * l->confidence);
    fw_effects_print_rows(to, l);
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->rows[i].n_failed > failed) failed = l->rows[i].n_failed;
    if (failed) fprintf(to, "  of the windows up to %zu failed one way or the other and are left out of that row\n", failed);
    print_costs(to, l);
}

/* ---- JSON ------------------------------------------------------------------------------------------------------- */

static void json_change(fw_json *j, const char *key, const fw_change *c)
{
    fw_json_key(j, key);
    fw_json_begin_object(j);
    fw_json_put_number(j, "change", c->change);
    fw_json_put_number(j, "low", c->low);
    fw_json_put_number(j, "high", c->high);
    fw_json_end(j);
}

void fw_effects_json_rows(fw_json *j, const fw_effects_ledger *l)
{
    if (l->n_rows == 0) {
        fw_json_null(j);
        return;
    }
    fw_json_begin_array(j);
    for (size_t i = 0; i < l->n_rows; i++) {
        const fw_effects_row *r = &l->rows[i];
        fw_json_begin_object(j);
        fw_json_put_string(j, "name", r->name);
        fw_json_put_string(j, "change", r->change);
        fw_json_put_string(j, "why", r->why);
        fw_json_put_string(j, "not_measured", r->note[0] ? r->note : NULL);
        fw_json_put_bool(j, "is_effect", r->is_effect);
        fw_json_put_bool(j, "was_on", r->was_on);
        json_change(j, "mean", &r->mean);
        json_change(j, "percentile", &r->percentile);
        fw_json_put_number(j, "evaluations_saved", r->evaluations_saved);
        fw_json_put_number(j, "cpu_saved", r->cpu_saved);
        fw_json_put_number(j, "evaluations_share", r->evaluations_share);
        fw_json_put_number(j, "cpu_share", r->cpu_share);
        fw_json_put_integer(j, "n_pairs", (int64_t)r->n_pairs);
        fw_json_put_integer(j, "n_failed", (int64_t)r->n_failed);
        fw_json_end(j);
    }
    fw_json_end(j);
}

void fw_effects_print_json(FILE *to, const fw_campaign *c, const fw_effects_ledger *l)
{
    fw_json j = fw_json_onto(to);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_put_integer(&j, "n_windows", (int64_t)l->n_windows);
    fw_json_put_number(&j, "way_m", l->way);
    fw_json_put_number(&j, "window_s", l->seconds);
    fw_json_put_integer(&j, "point", (int64_t)l->point);
    fw_json_put_number(&j, "bearing_deg", c->points.bearing[l->point - 1]);
    fw_json_put_number(&j, "percentile", l->percentile);
    fw_json_put_number(&j, "confidence", l->confidence);
    fw_json_put_number(&j, "mean_mm", l->mean_mm);
    fw_json_put_number(&j, "percentile_mm", l->percentile_mm);
    fw_json_key(&j, "effects_ledger");
    fw_effects_json_rows(&j, l);
    fw_json_key(&j, "cost");
    fw_json_begin_object(&j);
    fw_json_put_number(&j, "force_evaluations", l->evaluations);
    fw_json_put_number(&j, "evaluations_bare", l->evaluations_bare);
    fw_json_put_number(&j, "cpu_s", l->cpu_s);
    fw_json_put_number(&j, "cpu_s_first", l->cpu_s_first);
    fw_json_put_number(&j, "cpu_bare", l->cpu_bare);
    fw_json_put_number(&j, "cpu_noise", l->cpu_noise);
    fw_json_put_number(&j, "cpu_s_study", l->cpu_s_study);
    fw_json_end(&j);
    fw_json_end(&j);
}

const fw_effects_row *fw_effects_find_row(const fw_effects_ledger *l, const char *name)
{
    for (size_t i = 0; i < l->n_rows; i++)
        if (l->rows[i].is_effect && strcmp(l->rows[i].name, name) == 0) return &l->rows[i];
    return NULL;
}
