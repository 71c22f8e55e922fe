/* The step group: how exactly a window is computed, against what that costs. Every combination that was ever measured for the
 * kernel's design stands in the two tables below and nowhere else. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "realisation/accuracy.h"
#include "study/accuracy_inside.h"

/* Levels further apart from the reference than this have decoupled: at accuracy 0.1 % and at the campaign's own. Their step errors are
 * a tenth of it and less (RESULTS.md). */
static const double COUPLED_WITHIN = 0.01, COUPLED_WITHIN_USUAL = 0.05;

static const char *const RULES[] = {"hermite", "singular", "naive"}; /* by fw_wear_rule */

/* The event-driven kernel. What a line does not name is the built-in choice's. Growth is not varied: 2 costs a tenth more
 * evaluations than 3, and 5 lets the error control reject more. */
static const struct events_line {
    int          order;      /* 0: what a campaign gets, ARK3 and the closed forms of lone floes; else every contact by that order */
    double       first_step; /* over the built-in one */
    fw_wear_rule rule;
    double       tolerances[10]; /* from the coarsest; 0 ends */
} EVENTS[] = {
    {0, 1, FW_WEAR_HERMITE, {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6}},
    {2, 1, FW_WEAR_HERMITE, {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6}},
    {3, 1, FW_WEAR_HERMITE, {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6}},
    {4, 1, FW_WEAR_HERMITE, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}},
    {0, 4, FW_WEAR_HERMITE, {1e-2, 1e-3, 3e-4, 1e-4, 1e-5}},
    {3, 1, FW_WEAR_SINGULAR, {1e-2, 1e-3, 1e-4, 1e-5}},
    {3, 1, FW_WEAR_NAIVE, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}},
};
/* A rung has to be coarser than the reference by this much to say anything. */
static const double FINER_REFERENCE = 3;

/* Every floe at one step; is_core: also in a small study. */
static const struct plain_line {
    const char  *name;
    fw_scheme    scheme;
    fw_wear_rule rule;
    bool         is_core;
} PLAIN[] = {
    {"euler", FW_SCHEME_EULER, FW_WEAR_NAIVE, true},       {"euler", FW_SCHEME_EULER, FW_WEAR_SINGULAR, false},
    {"euler", FW_SCHEME_EULER, FW_WEAR_HERMITE, true},     {"verlet", FW_SCHEME_VERLET, FW_WEAR_NAIVE, false},
    {"verlet", FW_SCHEME_VERLET, FW_WEAR_SINGULAR, false}, {"verlet", FW_SCHEME_VERLET, FW_WEAR_HERMITE, true},
    {"rk4", FW_SCHEME_RK4, FW_WEAR_NAIVE, false},          {"rk4", FW_SCHEME_RK4, FW_WEAR_HERMITE, true},
};
static const double STEPS[] = {4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4}; /* [s] */

static double order_between(const fw_accuracy_row *coarse, const fw_accuracy_row *fine)
{
    if (strcmp(coarse->method, fine->method) != 0 || !(coarse->coupled.rms > 0) || !(fine->coupled.rms > 0)) return NAN;
    return log(coarse->coupled.rms / fine->coupled.rms) / log(coarse->level / fine->level);
}

static void say_in_words(const fw_accuracy_run *r, fw_accuracy_row *row)
{
    size_t n_failed = 0;
    for (size_t i = 0; i < r->n; i++) n_failed += !r->sample[i].is_ok;
    if (n_failed)
        snprintf(row->words, sizeof row->words, "%zu of %zu windows failed", n_failed, r->n);
    else if (row->coupled.n == 0)
        snprintf(row->words, sizeof row->words, "decoupled: the promise holds in the mean only");
    else if (row->numerics.scheme != FW_SCHEME_EVENTS && row->coupled.rms > 0.2)
        snprintf(row->words, sizeof row->words, "beyond its step limit: friction chatters, or windows decoupled");
}

/* Run one setting and append its row. */
static fw_status run_setting(fw_accuracy_run *r, fw_accuracy_row *row, fw_msg *m)
{
    fw_model model = r->model;
    model.numerics = row->numerics;
    FW_ACCURACY_SAY(r, "step: %s, %s", row->method, row->setting);
    FW_TRY(fw_trial_run(r->c, &model, r->n, r->windows, r->o->tick, r->sample, NULL, m));
    row->depth = fw_pairs_compare(r->n, r->sample, r->reference, fw_trial_depth, NULL);
    row->path = fw_pairs_compare(r->n, r->sample, r->reference, fw_trial_path, NULL);
    row->impulse = fw_pairs_compare(r->n, r->sample, r->reference, fw_trial_impulse, NULL);
    row->coupled = fw_pairs_compare(r->n, r->sample, r->reference, fw_trial_depth, r->is_coupled);
    fw_accuracy_cost(row, r->n, r->sample);
    row->hit_error = row->order = NAN;
    if (row->numerics.scheme == FW_SCHEME_EVENTS)
        FW_TRY(fw_accuracy_hits(r->c->model.accuracy, &row->numerics, &row->hit_error, NULL, 0, m));
    if (r->out->n_rows) row->order = order_between(&r->out->rows[r->out->n_rows - 1], row);
    say_in_words(r, row);
    return fw_accuracy_append(r, row, m);
}

/* The line's tolerances, and the built-in one where it belongs to this line and lies on none of its rungs. */
static size_t rungs_of(const fw_accuracy_run *r, const struct events_line *line, double *rungs, double *usual)
{
    fw_model    reference = r->model;
    fw_numerics built_in = fw_accuracy_built_in(&r->c->model);
    size_t      n = 0, most = sizeof line->tolerances / sizeof line->tolerances[0];
    bool is_own = line->rule == FW_WEAR_HERMITE && line->order == 0 && line->first_step == 1;
    reference.accuracy = FW_ACCURACY_REFERENCE;
    double least = FINER_REFERENCE * fw_accuracy_built_in(&reference).tolerance;
    *usual = 0;
    for (size_t k = 0; k < most && line->tolerances[k] > 0; k++) {
        double rung = line->tolerances[k];
        if (is_own && *usual == 0 && fabs(built_in.tolerance / rung - 1) < 1e-6) *usual = rung;
        if (is_own && *usual == 0 && built_in.tolerance > rung) rungs[n++] = *usual = built_in.tolerance;
        if (rung >= least || rung == *usual) rungs[n++] = rung;
    }
    if (is_own && *usual == 0) rungs[n++] = *usual = built_in.tolerance;
    return n;
}

static fw_status run_events(fw_accuracy_run *r, const struct events_line *line, fw_msg *m)
{
    fw_numerics built_in = fw_accuracy_built_in(&r->c->model);
    double      rungs[16], usual;
    size_t      n = rungs_of(r, line, rungs, &usual);
    for (size_t k = 0; k < n; k++) {
        fw_accuracy_row row = {.group = FW_ACCURACY_STEP, .numerics = built_in, .level = rungs[k]};
        row.numerics.order = line->order;
        row.numerics.wear_rule = line->rule;
        row.numerics.first_step *= line->first_step;
        fw_accuracy_set_tolerance(&row.numerics, rungs[k]);
        char order[8] = "";
        if (line->order) snprintf(order, sizeof order, " %d", line->order);
        snprintf(row.method, sizeof row.method, "events%s, %s%s", order, RULES[line->rule],
                 line->first_step > 1 ? ", long first step" : "");
        snprintf(row.setting, sizeof row.setting, "tolerance %.3g", row.level);
        row.is_default = row.level == usual;
        FW_TRY(run_setting(r, &row, m));
    }
    return FW_OK;
}

static fw_status run_plain(fw_accuracy_run *r, const struct plain_line *line, fw_msg *m)
{
    for (size_t k = 0; k < r->out->sizes.n_steps; k++) {
        fw_accuracy_row row = {.group = FW_ACCURACY_STEP, .level = STEPS[k]};
        row.numerics = (fw_numerics){.scheme = line->scheme, .wear_rule = line->rule, .step = STEPS[k]};
        snprintf(row.method, sizeof row.method, "every floe, %s, %s", line->name, RULES[line->rule]);
        snprintf(row.setting, sizeof row.setting, "step %g ms", 1e3 * row.level);
        FW_TRY(run_setting(r, &row, m));
    }
    return FW_OK;
}

static fw_status run_reference(fw_accuracy_run *r, fw_msg *m)
{
    fw_model model = r->model;
    model.accuracy = FW_ACCURACY_SECOND;
    FW_ACCURACY_SAY(r, "step: the reference, accuracy %g %%", 100 * FW_ACCURACY_REFERENCE);
    FW_TRY(fw_trial_run(r->c, &model, r->n, r->windows, r->o->tick, r->sample, NULL, m));
    model.accuracy = FW_ACCURACY_REFERENCE;
    FW_TRY(fw_trial_run(r->c, &model, r->n, r->windows, r->o->tick, r->reference, NULL, m));
    fw_pairs_find_coupled(r->n, r->sample, r->reference, COUPLED_WITHIN, r->is_coupled);
    bool is_usual_coupled[FW_ACCURACY_WINDOWS];
    model.accuracy = r->c->model.accuracy;
    FW_TRY(fw_trial_run(r->c, &model, r->n, r->windows, r->o->tick, r->sample, NULL, m));
    fw_pairs_find_coupled(r->n, r->sample, r->reference, fmax(COUPLED_WITHIN_USUAL, 2 * model.accuracy),
                          is_usual_coupled);
    model.accuracy = FW_ACCURACY_REFERENCE;
    for (size_t i = 0; i < r->n; i++) {
        r->is_coupled[i] = r->is_coupled[i] && is_usual_coupled[i];
        r->out->n_coupled += r->is_coupled[i];
    }
    fw_pairs all = fw_pairs_compare(r->n, r->reference, r->reference, fw_trial_depth, NULL);
    FW_CHECK(all.n > 0, m, FW_E_FAILURES,
             "none of the study's %zu windows of %.3g m of ice has wear: nothing to measure errors of", r->n,
             r->out->sizes.way);
    FW_TRY(fw_accuracy_hits(FW_ACCURACY_REFERENCE, NULL, &r->out->reference_hit_error, r->out->reference_hit,
                            sizeof r->out->reference_hit, m));
    fw_accuracy_row row = {.group = FW_ACCURACY_STEP,
                           .is_reference = true,
                           .depth = all,
                           .path = fw_pairs_compare(r->n, r->reference, r->reference, fw_trial_path, NULL),
                           .impulse = fw_pairs_compare(r->n, r->reference, r->reference, fw_trial_impulse, NULL),
                           .coupled = fw_pairs_compare(r->n, r->reference, r->reference, fw_trial_depth, r->is_coupled),
                           .hit_error = r->out->reference_hit_error,
                           .order = NAN};
    row.numerics = fw_accuracy_built_in(&model);
    row.level = row.numerics.tolerance;
    snprintf(row.method, sizeof row.method, "reference, events");
    snprintf(row.setting, sizeof row.setting, "tolerance %.3g", row.level);
    fw_accuracy_cost(&row, r->n, r->reference);
    return fw_accuracy_append(r, &row, m);
}

fw_status fw_accuracy_step_group(fw_accuracy_run *r, fw_msg *m)
{
    bool is_small = r->out->sizes.n_steps <= 3;
    FW_TRY(run_reference(r, m));
    for (size_t k = 0; k < sizeof EVENTS / sizeof EVENTS[0]; k++) FW_TRY(run_events(r, &EVENTS[k], m));
    if (fw_model_beyond_fixed_steps(&r->model)) return FW_OK; /* nothing to compare with */
    for (size_t k = 0; k < sizeof PLAIN / sizeof PLAIN[0]; k++)
        if (PLAIN[k].is_core || !is_small) FW_TRY(run_plain(r, &PLAIN[k], m));
    return FW_OK;
}
