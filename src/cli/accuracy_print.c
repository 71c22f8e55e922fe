#include "cli/accuracy_print.h"

#include <math.h>
#include <string.h>

#include "cli/accuracy_file.h"
#include "cli/json.h"

/* ---- text ------------------------------------------------------------------------------------------------------- */

/* "+1.2 +- 0.3 %", "0", "-": what a table cell of an error says. */
static const char *cell(char *text, size_t size, const fw_pairs *p)
{
    if (p->n == 0 || isnan(p->mean))
        snprintf(text, size, "-");
    else if (fabs(p->mean) < 1e-12 && !(p->error > 1e-12))
        snprintf(text, size, "0"); /* or what rounding leaves of it */
    else if (p->mean == 0)
        snprintf(text, size, "0 +- %.1g %%", 100 * p->error);
    else if (isnan(p->error))
        snprintf(text, size, "%+.2g %%", 100 * p->mean);
    else
        snprintf(text, size, "%+.2g +- %.1g %%", 100 * p->mean, 100 * p->error);
    return text;
}

static const char *share(char *text, size_t size, double x, const char *format)
{
    if (isnan(x))
        snprintf(text, size, "-");
    else if (x == 0)
        snprintf(text, size, "0");
    else
        snprintf(text, size, format, 100 * x);
    return text;
}

static const char *mark(const fw_accuracy_row *row)
{
    return row->is_chosen && row->is_default ? " <- chosen, the default"
           : row->is_chosen                  ? " <- chosen"
           : row->is_default                 ? " <- default"
                                             : "";
}

static void print_heading(FILE *to, const fw_campaign *c, const fw_accuracy *a)
{
    fprintf(to, "%s: error against cost, for a wanted accuracy of %g %% of a window's depth\n", c->name,
            100 * c->model.accuracy);
    fprintf(to,
            "%zu windows of %.3g m of ice after %.3g m (%.3g s at the mean %.2g m/s), the faster half of the first %zu "
            "ids, every "
            "setting on the same ice\n",
            a->sizes.n_windows, a->sizes.way, a->sizes.warm_up_way, a->sizes.way / a->mean_speed, a->mean_speed,
            2 * a->sizes.n_windows);
    fprintf(to,
            "reference: events at accuracy 0.01 %%; itself off by at most %.2g %% on nine single hits of an "
            "independent code (%s)\n",
            100 * a->reference_hit_error, a->reference_hit);
    if (a->n_coupled == a->sizes.n_windows)
        fprintf(to, "all windows stay coupled at fine steps: a step error is seen window by window\n");
    else
        fprintf(to,
                "%zu of %zu windows stay coupled at fine steps; in the others, jams, one touch a little earlier "
                "changes all that follow: "
                "there the promise holds in the mean only\n",
                a->n_coupled, a->sizes.n_windows);
}

static void print_steps(FILE *to, const fw_accuracy *a)
{
    char x[6][48];
    fprintf(to, "\nwork and precision: depth over coupled windows; order: of its r.m.s. in tolerance or step; hits: "
                "worst single hit\n");
    bool has_jams = a->n_coupled < a->sizes.n_windows;
    fprintf(to, "  %-28s %-16s %-17s %-8s ", "method", "setting", "depth error", "r.m.s.");
    if (has_jams) fprintf(to, "%-17s ", "all windows");
    fprintf(to, "%-17s %-19s %5s %11s %8s %9s\n", "path", "impulse", "order", "evaluations", "CPU s", "hits");
    for (size_t i = 0; i < a->n_rows && a->rows[i].group == FW_ACCURACY_STEP; i++) {
        const fw_accuracy_row *r = &a->rows[i];
        bool                   is_first = i == 0 || strcmp(a->rows[i - 1].method, r->method) != 0;
        fprintf(to, "  %-28s %-16s %-17s %-8s ", is_first ? r->method : "", r->setting,
                cell(x[0], sizeof x[0], &r->coupled), share(x[1], sizeof x[1], r->coupled.rms, "%.2g %%"));
        if (has_jams) fprintf(to, "%-17s ", cell(x[2], sizeof x[2], &r->depth));
        fprintf(to, "%-17s %-19s ", cell(x[3], sizeof x[3], &r->path), cell(x[4], sizeof x[4], &r->impulse));
        if (isnan(r->order))
            fprintf(to, "%5s ", "-");
        else
            fprintf(to, "%5.2f ", r->order);
        fprintf(to, "%11.3g %8.2g %9s%s", r->evaluations, r->cpu_s, share(x[5], sizeof x[5], r->hit_error, "%.2g %%"),
                mark(r));
        fprintf(to, "%s%s\n", r->words[0] ? "  " : "", r->words);
    }
}

static void print_domain(FILE *to, const fw_accuracy *a)
{
    char x[4][48];
    fprintf(to,
            "\nring, domain, warm-up and window at the chosen step, %.3g m of ice a window with the campaign's own "
            "warm-up\n",
            a->sizes.domain_way);
    fprintf(to, "  %-12s %-22s %-18s %-9s %-18s %11s %9s\n", "", "setting", "depth error", "r.m.s.", "path",
            "evaluations", "CPU s");
    for (size_t i = 0; i < a->n_rows; i++) {
        const fw_accuracy_row *r = &a->rows[i];
        if (r->group == FW_ACCURACY_STEP) continue;
        bool is_first = a->rows[i - 1].group != r->group;
        fprintf(to, "  %-12s %-22s %-18s %-9s %-18s %11.3g %9.3g%s%s%s\n", is_first ? r->method : "", r->setting,
                cell(x[0], sizeof x[0], &r->depth), share(x[1], sizeof x[1], r->depth.rms, "%.2g %%"),
                cell(x[2], sizeof x[2], &r->path), r->evaluations, r->cpu_s, mark(r), r->words[0] ? "  " : "",
                r->words);
    }
}

static void print_percentile(FILE *to, const fw_campaign *c, const fw_accuracy *a)
{
    double p = c->precision.quantity == FW_QUANTITY_PERCENTILE ? c->precision.percentile : 90;
    fprintf(to, "\nerror of P%g against realisations, %zu windows of %.3g s (all scenarios)\n ", p,
            a->sizes.n_percentile, a->percentile_window_s);
    for (size_t i = 0; i < a->n_percentile; i++)
        if (a->percentile[i].error > 0)
            fprintf(to, "  n = %zu: %.2g %%", a->percentile[i].n, 100 * a->percentile[i].error);
    if (isnan(a->error_one)) {
        fprintf(to, "  none: P%g of these windows is 0\n", p);
        return;
    }
    fprintf(
        to,
        "\n  fit: %.3g %% / sqrt(n); slope seen %.2f (1/sqrt(n): -0.5); a window of the campaign costs %.3g CPU s\n",
        100 * a->error_one, a->percentile_slope, a->cpu_s_window);
}

static void print_budget(FILE *to, const fw_accuracy *a)
{
    char x[3][32];
    if (a->n_budget == 0) return;
    fprintf(to, "\na CPU budget split between step and sampling: total error at each step level\n  %-12s", "budget");
    for (size_t i = 0; i < a->n_budget && a->budget[i].budget_cpu_s == a->budget[0].budget_cpu_s; i++)
        fprintf(to, " %8.3g%s", a->budget[i].tolerance, a->budget[i].is_chosen ? "*" : " ");
    for (size_t i = 0; i < a->n_budget; i++) {
        const fw_accuracy_budget_row *b = &a->budget[i];
        if (i == 0 || b->budget_cpu_s != a->budget[i - 1].budget_cpu_s) {
            snprintf(x[1], sizeof x[1], "%.3g CPU s", b->budget_cpu_s);
            fprintf(to, "\n  %-12s", x[1]);
        }
        fprintf(to, " %9s", share(x[0], sizeof x[0], b->total_error, "%.3g %%"));
    }
    fprintf(to, "\n");
}

static void print_choice(FILE *to, const fw_accuracy *a)
{
    fw_choice_sets sets;
    fw_choice_sets_make(&sets, &a->choice);
    fprintf(to, "\nchoice: %s\n ", a->choice.why);
    for (size_t i = 0; i < sets.n; i++) fprintf(to, "  %s", sets.text[i]);
    fprintf(to, "\n");
}

void fw_accuracy_print_text(FILE *to, const fw_campaign *c, const fw_accuracy *a)
{
    print_heading(to, c, a);
    print_steps(to, a);
    print_domain(to, a);
    print_percentile(to, c, a);
    print_budget(to, a);
    print_choice(to, a);
}

/* ---- JSON ------------------------------------------------------------------------------------------------------- */

static void json_pairs(fw_json *j, const char *name, const fw_pairs *p)
{
    fw_json_key(j, name);
    fw_json_begin_object(j);
    fw_json_put_integer(j, "n", (int64_t)p->n);
    fw_json_put_number(j, "error", p->mean);
    fw_json_put_number(j, "standard_error", p->error);
    fw_json_put_number(j, "rms", p->rms);
    fw_json_end(j);
}

static void json_rows(fw_json *j, const char *name, const fw_accuracy *a, bool is_step)
{
    fw_json_key(j, name);
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_rows; i++) {
        const fw_accuracy_row *r = &a->rows[i];
        if ((r->group == FW_ACCURACY_STEP) != is_step) continue;
        fw_json_begin_object(j);
        fw_json_put_string(j, "group", fw_accuracy_group_name(r->group));
        fw_json_put_string(j, "method", r->method);
        fw_json_put_string(j, "setting", r->setting);
        fw_json_put_number(j, "level", r->level);
        json_pairs(j, "depth", &r->depth);
        json_pairs(j, "path", &r->path);
        json_pairs(j, "impulse", &r->impulse);
        if (is_step) {
            json_pairs(j, "coupled", &r->coupled);
            fw_json_put_number(j, "order", r->order);
            fw_json_put_number(j, "hit_error", r->hit_error);
            fw_json_put_number(j, "energy_truncation", r->truncation);
        }
        fw_json_put_number(j, "force_evaluations", r->evaluations);
        fw_json_put_number(j, "cpu_s", r->cpu_s);
        fw_json_put_bool(j, "is_reference", r->is_reference);
        fw_json_put_bool(j, "is_default", r->is_default);
        fw_json_put_bool(j, "is_chosen", r->is_chosen);
        fw_json_put_string(j, "words", r->words);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_percentile(fw_json *j, const fw_accuracy *a)
{
    fw_json_key(j, "percentile_error");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_percentile; i++) {
        fw_json_begin_object(j);
        fw_json_put_integer(j, "n", (int64_t)a->percentile[i].n);
        fw_json_put_number(j, "error", a->percentile[i].error);
        fw_json_put_number(j, "fit", a->percentile[i].fit);
        fw_json_end(j);
    }
    fw_json_end(j);
    fw_json_put_number(j, "percentile_error_one", a->error_one);
    fw_json_put_number(j, "percentile_slope", a->percentile_slope);
}

static void json_budget(fw_json *j, const fw_accuracy *a)
{
    fw_json_key(j, "budget");
    fw_json_begin_array(j);
    for (size_t i = 0; i < a->n_budget; i++) {
        const fw_accuracy_budget_row *b = &a->budget[i];
        fw_json_begin_object(j);
        fw_json_put_number(j, "budget_cpu_s", b->budget_cpu_s);
        fw_json_put_number(j, "tolerance", b->tolerance);
        fw_json_put_number(j, "n", b->n);
        fw_json_put_number(j, "step_error", b->step_error);
        fw_json_put_number(j, "sampling_error", b->sampling_error);
        fw_json_put_number(j, "total_error", b->total_error);
        fw_json_put_bool(j, "is_chosen", b->is_chosen);
        fw_json_end(j);
    }
    fw_json_end(j);
}

static void json_choice(fw_json *j, const fw_accuracy *a)
{
    fw_choice_sets sets;
    fw_choice_sets_make(&sets, &a->choice);
    fw_json_key(j, "choice");
    fw_json_begin_object(j);
    fw_json_put_number(j, "error", a->choice.error);
    fw_json_put_bool(j, "is_within", a->choice.is_within);
    fw_json_put_string(j, "why", a->choice.why);
    fw_json_key(j, "sets");
    fw_json_begin_array(j);
    for (size_t i = 0; i < sets.n; i++) fw_json_string(j, sets.text[i]);
    fw_json_end(j);
    fw_json_end(j);
}

void fw_accuracy_print_json(FILE *to, const fw_campaign *c, const fw_accuracy *a)
{
    fw_json j = fw_json_onto(to);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_put_number(&j, "accuracy", c->model.accuracy);
    fw_json_put_integer(&j, "n_windows", (int64_t)a->sizes.n_windows);
    fw_json_put_integer(&j, "n_coupled", (int64_t)a->n_coupled);
    fw_json_put_number(&j, "way_m", a->sizes.way);
    fw_json_put_number(&j, "warm_up_way_m", a->sizes.warm_up_way);
    fw_json_put_number(&j, "domain_way_m", a->sizes.domain_way);
    fw_json_put_number(&j, "mean_speed_m_s", a->mean_speed);
    fw_json_key(&j, "reference");
    fw_json_begin_object(&j);
    fw_json_put_number(&j, "hit_error", a->reference_hit_error);
    fw_json_put_string(&j, "hit", a->reference_hit);
    fw_json_end(&j);
    json_rows(&j, "work_precision", a, true);
    json_rows(&j, "domain", a, false);
    json_percentile(&j, a);
    json_budget(&j, a);
    json_choice(&j, a);
    fw_json_put_number(&j, "cpu_s", a->cpu_s);
    fw_json_end(&j);
}
