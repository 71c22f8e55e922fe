#include "cli/plan_levels.h"

#include <math.h>
#include <stdio.h>

#include "campaign/signals.h"
#include "cli/json.h"
#include "cli/output.h"
#include "cli/study_run.h"
#include "study/levels.h"

static const double USUAL_S = 180;

/* "1/2.85", or that it costs nothing. */
static const char *share(char *to, size_t size, double ratio)
{
    snprintf(to, size, isfinite(ratio) ? "1/%.3g" : "nothing", ratio);
    return to;
}

static void print_row(const fw_levels_row *r)
{
    const fw_coupled *p = &r->pairs;
    char              cpu[24], evaluations[24];
    if (r->note[0]) {
        printf("  %-16s not measured: %s\n", r->name, r->note);
        return;
    }
    printf("  %-16s %8s %12s %8.3f %8.3f %8.3f   x%-6.2f %8.1f %12.2f  %s\n", r->name, share(cpu, sizeof cpu, p->cost_ratio),
           share(evaluations, sizeof evaluations, r->evaluations_ratio), r->correlation_before, p->correlation, r->correlation_mean, p->multilevel.gain,
           p->kurtosis, p->consistency, r->verdict);
}

static void print_text(const fw_campaign *c, const fw_levels *l)
{
    char   what[40] = "mean";
    size_t n_promising = 0;
    if (!isnan(l->percentile)) snprintf(what, sizeof what, "P%g", l->percentile);
    printf("%s: what cheaper models of the same windows would be worth beside the campaign's own\n", c->name);
    printf("%zu windows in all ways on the same ice, %.3g CPU s each the campaign's own way", l->n_windows, l->cpu_s_window);
    if (l->n_failed) printf("; %zu more failed one way or the other", l->n_failed);
    printf("\n%s of window depth at point %zu (%g deg), %.3g mm; ", what, l->point, c->points.bearing[l->point - 1], l->depth_mm);
    printf(l->n_functions ? "%zu control variates\n\n" : "no control variates\n\n", l->n_functions);
    printf("  %-16s %8s %12s %26s   %-7s %8s %12s  %s\n", "", "CPU", "evaluations", "correlation", "multi-", "kurtosis", "consistency", "multifidelity:");
    printf("  %-16s %8s %12s %8s %8s %8s   %-7s %8s %12s  variance at equal CPU time, [%g %% interval]\n", "", "", "", "before", "behind", "of mean", "level", "", "",
           100 * l->confidence);
    for (size_t i = 0; i < l->n_rows; i++) print_row(&l->rows[i]), n_promising += l->rows[i].is_promising;
    printf("\n  correlation of P(depth <= that) before and behind the control variates, which a run uses anyway, and of the mean depth behind them\n");
    printf(n_promising ? "  more than x%g is promised, but no run makes use of it: on the campaigns that it was tried on nothing came near\n"
                       : "  none promises more than x%g: windows of the campaign's own kind are the best use of its CPU time\n",
           FW_LEVELS_WANTED);
}

static void json_row(fw_json *j, const fw_levels_row *r)
{
    const fw_coupled *p = &r->pairs;
    bool              is_measured = !r->note[0];
    fw_json_begin_object(j);
    fw_json_put_string(j, "name", r->name);
    fw_json_put_string(j, "what", r->what);
    fw_json_put_string(j, "not_measured", is_measured ? NULL : r->note);
    fw_json_put_number(j, "cost_ratio", is_measured ? p->cost_ratio : NAN);
    fw_json_put_number(j, "evaluations_ratio", is_measured ? r->evaluations_ratio : NAN);
    fw_json_put_number(j, "correlation", is_measured ? p->correlation : NAN);
    fw_json_put_number(j, "correlation_before_control", is_measured ? r->correlation_before : NAN);
    fw_json_put_number(j, "correlation_of_means", is_measured ? r->correlation_mean : NAN);
    fw_json_put_number(j, "gain", is_measured ? p->multifidelity.gain : NAN);
    fw_json_put_number(j, "gain_low", is_measured ? p->multifidelity.low : NAN);
    fw_json_put_number(j, "gain_high", is_measured ? p->multifidelity.high : NAN);
    fw_json_put_number(j, "gain_multilevel", is_measured ? p->multilevel.gain : NAN);
    fw_json_put_number(j, "gain_multilevel_low", is_measured ? p->multilevel.low : NAN);
    fw_json_put_number(j, "gain_multilevel_high", is_measured ? p->multilevel.high : NAN);
    fw_json_put_number(j, "kurtosis", is_measured ? p->kurtosis : NAN);
    fw_json_put_number(j, "consistency", is_measured ? p->consistency : NAN);
    fw_json_put_bool(j, "is_promising", r->is_promising);
    fw_json_put_string(j, "verdict", is_measured ? r->verdict : NULL);
    fw_json_end(j);
}

static void print_json(const fw_campaign *c, const fw_levels *l)
{
    fw_json j = fw_json_onto(stdout);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_put_integer(&j, "n_windows", (int64_t)l->n_windows);
    fw_json_put_integer(&j, "n_failed", (int64_t)l->n_failed);
    fw_json_put_integer(&j, "n_control_variates", (int64_t)l->n_functions);
    fw_json_put_integer(&j, "point", (int64_t)l->point);
    fw_json_put_number(&j, "percentile", l->percentile);
    fw_json_put_number(&j, "depth_mm", l->depth_mm);
    fw_json_put_number(&j, "confidence", l->confidence);
    fw_json_put_number(&j, "wanted", FW_LEVELS_WANTED);
    fw_json_put_number(&j, "cpu_s_window", l->cpu_s_window);
    fw_json_put_number(&j, "cpu_s_study", l->cpu_s);
    fw_json_key(&j, "levels");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < l->n_rows; i++) json_row(&j, &l->rows[i]);
    fw_json_end(&j);
    fw_json_end(&j);
}

fw_status fw_plan_levels(const fw_plan_levels_wanted *w, fw_msg *m)
{
    fw_campaign    c;
    fw_choice      choice;
    fw_levels      l;
    fw_study_watch watch = fw_study_watch_start(0, w->is_quiet);
    fw_tick        tick = fw_study_watch_tick(&watch);
    FW_TRY(fw_study_check_alone(m));
    fw_signals_catch();
    FW_TRY(fw_choice_campaign(&c, &w->choice, &choice, m));
    fw_levels_options o = {.scenario = fw_campaign_plain_scenario,
                           .law = fw_campaign_law(&c),
                           .cpu_budget_s = w->cpu_budget_s > 0 ? w->cpu_budget_s : USUAL_S,
                           .tick = &tick,
                           .say = fw_study_watch_say,
                           .say_self = &watch};
    fw_status s = fw_study_watch_end(&watch, fw_levels_measure(&l, &c, &o, m), m);
    if (s == FW_OK) {
        if (w->is_json)
            print_json(&c, &l);
        else
            print_text(&c, &l);
        s = fw_output_finish(m);
    }
    fw_campaign_free(&c);
    return s;
}
