/* `floewear plan CAMPAIGN.yaml`: what a run would do and cost, measured on a pilot of its first realisations; no results. */
#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/config.h"
#include "cli/campaign_arguments.h"
#include "cli/effects_print.h"
#include "cli/json.h"
#include "cli/output.h"
#include "cli/plan_design.h"
#include "cli/plan_effects.h"
#include "cli/plan_levels.h"
#include "cli/plan_strip.h"
#include "effects/effects.h"
#include "floewear/campaign.h"
#include "realisation/accuracy.h"
#include "realisation/cost.h"
#include "realisation/facts.h"

enum { MAX_SETS = 64, KEY_SET = 1000, KEY_JSON, KEY_PILOT, KEY_SEED, KEY_ACCURACY, KEY_EFFECTS, KEY_BUDGET, KEY_WHOLE, KEY_LEVELS, KEY_LEVELS_BUDGET };

typedef struct arguments {
    const char *campaign, *accuracy_from, *out;
    const char *sets[MAX_SETS];
    size_t      n_sets;
    bool        is_json, is_effects, is_levels, is_quiet;
    long        pilot, n_whole;
    double      effects_budget_s, levels_budget_s;
    int64_t     seed;
} arguments;

/* An option that would be passed over is refused. */
static void check_options(const arguments *a, struct argp_state *state)
{
    if (!a->is_effects && a->effects_budget_s > 0) argp_error(state, "--effects-budget goes with --effects");
    if (!a->is_effects && a->n_whole > 0) argp_error(state, "--effects-whole goes with --effects");
    if (a->n_whole > 0 && a->effects_budget_s > 0) argp_error(state, "--effects-whole says how many windows, and so does --effects-budget: one of them");
    if (!a->is_levels && a->levels_budget_s > 0) argp_error(state, "--levels-budget goes with --levels");
    if (a->is_levels && a->is_effects) argp_error(state, "--levels and --effects are two studies: one of them");
    if (a->is_levels && (a->pilot >= 0 || a->out)) argp_error(state, "%s goes without --levels, which has a pilot of its own and writes no file", a->out ? "--output" : "--pilot");
    if (a->is_effects && a->pilot >= 0) argp_error(state, "--pilot goes without --effects, which runs no pilot");
    if (a->is_effects && a->accuracy_from)
        argp_error(state, "--accuracy-from goes without --effects, which takes the numerics that are built in or stand in the campaign");
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    char      *end;
    switch (key) {
    case KEY_SET:
        if (a->n_sets == MAX_SETS) argp_error(state, "at most %d --set", (int)MAX_SETS);
        a->sets[a->n_sets++] = arg;
        return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case KEY_ACCURACY: a->accuracy_from = arg; return 0;
    case KEY_EFFECTS: a->is_effects = true; return 0;
    case KEY_LEVELS: a->is_levels = true; return 0;
    case KEY_LEVELS_BUDGET: return fw_argument_duration("--levels-budget", arg, state, &a->levels_budget_s);
    case KEY_BUDGET: return fw_argument_duration("--effects-budget", arg, state, &a->effects_budget_s);
    case KEY_WHOLE:
        a->n_whole = strtol(arg, &end, 10);
        if (*end || end == arg || a->n_whole < 1 || a->n_whole > 10000)
            argp_error(state, "--effects-whole takes a whole number from 1 to 10000, not '%s'", arg);
        return 0;
    case 'o': a->out = arg; return 0;
    case 'q': a->is_quiet = true; return 0;
    case KEY_PILOT:
        a->pilot = strtol(arg, &end, 10);
        if (*end || end == arg || a->pilot < 0 || a->pilot > 10000)
            argp_error(state, "--pilot takes a whole number from 0 to 10000, not '%s'", arg);
        return 0;
    case KEY_SEED:
        a->seed = strtoll(arg, &end, 10);
        if (*end || end == arg || a->seed < 0) argp_error(state, "--seed takes a whole number, not '%s'", arg);
        return 0;
    case ARGP_KEY_ARG:
        if (a->campaign) argp_error(state, "one campaign file, not also '%s'", arg);
        a->campaign = arg;
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a campaign file is needed"); return 0;
    case ARGP_KEY_SUCCESS: check_options(a, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option OPTIONS[] = {
    {"pilot", KEY_PILOT, "N", 0, "realisations of the pilot (default: up to 64, as long as they are not expected to take more than minutes; 0: none)", 0},
    {"effects", KEY_EFFECTS, NULL, 0, "measure instead what each effect and open choice moves and costs, on the same ice; writes OUT.effects.h5, which run, plan and report of this campaign show", 1},
    {"effects-budget", KEY_BUDGET, "TIME", 0, "choose the number of windows for about this much CPU time (default 5min)", 1},
    {"effects-whole", KEY_WHOLE, "N", 0, "N whole windows of the campaign instead of short ones: what those are to be checked against", 1},
    {"levels", KEY_LEVELS, NULL, 0, "measure instead what cheaper models of the same windows would be worth beside the campaign's own (multilevel, multifidelity); writes nothing", 2},
    {"levels-budget", KEY_LEVELS_BUDGET, "TIME", 0, "choose the number of windows for about this much CPU time (default 3min; 128 windows at least)", 2},
    {"output", 'o', "OUT", 0, "stem of the files that belong to this campaign (default: its name, in the current folder)", 0},
    {"quiet", 'q', NULL, 0, "no progress on stderr", 0},
    {"accuracy-from", KEY_ACCURACY, "FILE", 0, "numerics chosen by floewear accuracy (default: NAME.accuracy.h5, if it is there)", 0},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a key by its dotted path", 0},
    {"seed", KEY_SEED, "N", 0, "override the seed", 0},
    {"json", KEY_JSON, NULL, 0, "print JSON", 0},
    {0},
};
static const struct argp ARGP = {OPTIONS,
                                 parse,
                                 "CAMPAIGN.yaml",
                                 "Shows the effects the scenes call for and why, the accuracy settings, and the cost "
                                 "and precision that a pilot predicts, and which sampling design pays; writes OUT.plan.h5, which run takes it from. Writes no results; with --effects the measured effects ledger.",
                                 NULL,
                                 NULL,
                                 NULL};

/* What the cost model expects of the campaign's windows [force evaluations]: mean and largest of the first thousand. */
typedef struct expected {
    double mean, most;
} expected;

static fw_status expect(const fw_campaign *c, expected *e, fw_msg *m)
{
    const uint64_t n = c->precision.max_realisations < 1000 ? c->precision.max_realisations : 1000;
    *e = (expected){0, 0};
    for (uint64_t id = 0; id < n; id++) {
        fw_scenario s;
        double      one;
        fw_campaign_scenario(c, id, &s);
        FW_TRY(fw_cost_expected(&c->model, &s, &one, m));
        e->mean += one / (double)n, e->most = fmax(e->most, one);
    }
    return FW_OK;
}

/* On or off, and why (FW_REASON_SIZE): the rule's own words, or that the file overrides them. */
static bool effect_state(const fw_campaign *c, const fw_scene_facts *f, const fw_choice *choice, const fw_effect *e, char *reason)
{
    char rule[FW_REASON_SIZE];
    bool is_on = fw_effects_have(&c->model, e->bit), is_needed = e->is_needed(&c->model, f, rule);
    if (is_on == is_needed)
        snprintf(reason, FW_REASON_SIZE, "%s", rule);
    else if (is_on)
        snprintf(reason, FW_REASON_SIZE, "asked for by the file (auto: off, %.160s)", rule);
    else if (choice->dropped & (uint32_t)e->bit)
        snprintf(reason, FW_REASON_SIZE, "left out, as it was measured to move less than effects_tolerance: %s", e->off);
    else
        snprintf(reason, FW_REASON_SIZE, "switched off by the file: %s", e->off);
    return is_on;
}

static void print_json(const fw_campaign *c, const fw_scene_facts *facts, const fw_choice *choice, const expected *of, const fw_plan_strip *strip,
                       const fw_outlook *x, const fw_plan_forecast *f, double speed)
{
    fw_json                 j = fw_json_onto(stdout);
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_key(&j, "effects");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < n; i++) {
        char reason[FW_REASON_SIZE];
        bool is_on = effect_state(c, facts, choice, e[i], reason);
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "name", e[i]->name);
        fw_json_put_bool(&j, "on", is_on);
        fw_json_put_string(&j, "reason", reason);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_put_string(&j, "effects_choice", choice->effects_line);
    fw_json_key(&j, "effects_ledger"), fw_effects_json_rows(&j, &choice->effects);
    fw_json_put_string(&j, "effects_measured", choice->effects.n_rows ? choice->effects.origin : "nowhere");
    fw_accuracy_line lines[16];
    size_t           n_lines = fw_accuracy_lines(&c->model, speed, lines, 16);
    fw_json_put_string(&j, "numerics", choice->line);
    fw_json_key(&j, "accuracy");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < n_lines; i++) {
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "name", lines[i].name);
        fw_json_put_number(&j, "value", lines[i].value);
        fw_json_put_string(&j, "unit", lines[i].unit);
        fw_json_put_string(&j, "why", lines[i].why);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_key(&j, "expected");
    fw_json_begin_object(&j);
    fw_json_put_number(&j, "force_evaluations_mean", of->mean);
    fw_json_put_number(&j, "force_evaluations_most", of->most);
    fw_json_end(&j);
    fw_plan_strip_json(&j, c, strip);
    fw_plan_design_json(&j, c, x, f);
    fw_json_key(&j, "not_applied");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < c->n_not_applied; i++) fw_json_string(&j, c->not_applied[i]);
    fw_json_end(&j);
    fw_json_end(&j);
}

/* With what `plan --effects` measured, where its file is there. */
static void print_effects(const fw_campaign *c, const fw_scene_facts *facts, const fw_choice *choice)
{
    static const fw_change   NONE = {NAN, NAN, NAN};
    const fw_effects_ledger *l = &choice->effects;
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    printf("  %-14s %-3s ", "effect", "on");
    if (l->n_rows) printf("%10s %-26s P%-25g", "CPU share", "switched: mean", l->percentile);
    printf(" why\n");
    for (size_t i = 0; i < n; i++) {
        char reason[FW_REASON_SIZE];
        bool is_on = effect_state(c, facts, choice, e[i], reason);
        printf("  %-14s %-3s ", e[i]->name, is_on ? "on" : "off");
        if (l->n_rows) {
            const fw_effects_row *row = fw_effects_find_row(l, e[i]->name);
            char                  mean[48], percentile[48], share[24] = "-";
            if (row && isfinite(row->cpu_share)) snprintf(share, sizeof share, "%.1f %%", 100 * row->cpu_share);
            printf("%10s %-26s %-26s", share, fw_effects_say_change(mean, sizeof mean, row ? &row->mean : &NONE),
                   fw_effects_say_change(percentile, sizeof percentile, row ? &row->percentile : &NONE));
        }
        printf(" %s\n", reason);
    }
    if (l->n_rows) printf("  (each switched against the others, measured %s)\n", l->origin);
    if (choice->effects_line[0]) printf("  %s\n", choice->effects_line);
}

static void print_text(const arguments *a, const fw_campaign *c, const fw_scene_facts *facts, const fw_choice *choice, const expected *of,
                       const fw_plan_strip *strip, const fw_outlook *x, const fw_plan_forecast *f, double speed)
{
    printf("plan of campaign %s\n\n", c->name);
    print_effects(c, facts, choice);
    fw_accuracy_line lines[16];
    size_t           n_lines = fw_accuracy_lines(&c->model, speed, lines, 16);
    printf("\naccuracy %g %% of a window's depth, at %.3g m/s; %s\n", 100 * c->model.accuracy, speed, choice->line);
    for (size_t i = 0; i < n_lines; i++)
        printf("  %-13s %10.4g %-4s  %s\n", lines[i].name, lines[i].value, lines[i].unit, lines[i].why);
    printf("\ncost model: %.2g force evaluations a window in the mean, %.2g at most: about %.2g and %.2g CPU s\n", of->mean, of->most,
           of->mean / FW_PLAN_EVALUATIONS_PER_S, of->most / FW_PLAN_EVALUATIONS_PER_S);
    if (c->model.max_evaluations > 0)
        printf("  one that takes more than %.3g fails (exposure.max_force_evaluations)\n", c->model.max_evaluations);
    else
        printf("  one that takes more than 100 times what is expected of it and than 1e9 fails (exposure.max_force_evaluations: auto)\n");
    fw_plan_strip_print(stdout, c, strip);
    fw_plan_design_print(stdout, c, x, f, fw_plan_pilot_size(c, a->pilot));
    for (size_t i = 0; i < c->n_not_applied; i++)
        printf("%s%s is read and checked but not applied in this version\n", i ? "" : "\n", c->not_applied[i]);
}

/* The choice is for `run`, unless there is none to make, or a journal whose design stands. */
static fw_status store_choice(const arguments *a, const fw_campaign *c, const fw_outlook *x, const fw_plan_forecast *f, size_t n, const fw_record *pilot,
                              fw_msg *m)
{
    char        path[4096], journal[4096];
    fw_campaign bare;
    struct stat there;
    if (!x->is_known || !c->sampling.is_auto) return FW_OK;
    FW_TRY(fw_choice_path(path, sizeof path, a->out ? a->out : c->name, FW_CHOICE_PLAN, m));
    FW_TRY(fw_choice_path(journal, sizeof journal, a->out ? a->out : c->name, FW_CHOICE_JOURNAL, m));
    if (stat(journal, &there) == 0) {
        if (!a->is_quiet) fprintf(stderr, "%s is there: it goes on by its own design, and the choice is not stored\n", journal);
        return FW_OK;
    }
    FW_TRY(fw_config_campaign(&bare, a->campaign, a->n_sets, a->sets, a->seed, m));
    fw_status s = fw_plan_file_write(path, &bare, x, f, n, pilot, m);
    fw_campaign_free(&bare);
    if (s == FW_OK && !a->is_quiet) fprintf(stderr, "%s: run takes this design\n", path);
    return s;
}

static double mean_speed(const fw_campaign *c, size_t n, const fw_record *pilot)
{
    fw_scenario first;
    double      sum = 0;
    fw_campaign_plain_scenario(c, 0, &first);
    for (size_t i = 0; i < n; i++) sum += pilot[i].speed / (double)n;
    return n ? sum : first.speed;
}

static fw_status plan(const arguments *a, fw_msg *m)
{
    fw_campaign      c = {0};
    fw_record       *pilot = NULL;
    size_t           n = 0;
    fw_outlook       x = {0};
    fw_plan_strip    strip = {0};
    expected         e = {0, 0};
    fw_choice        choice;
    fw_scene_facts   facts;
    fw_choice_wanted wanted = {
        .campaign = a->campaign, .n_sets = a->n_sets, .sets = a->sets, .seed = a->seed, .from = a->accuracy_from, .out = a->out, .is_planning = true};
    FW_TRY(fw_choice_campaign(&c, &wanted, &choice, m));
    fw_status s = fw_facts_campaign(&c.model, &c.site, &facts, m);
    if (s == FW_OK) s = expect(&c, &e, m);
    if (s == FW_OK) s = fw_plan_strip_make(&strip, &c, m);
    if (s == FW_OK) s = fw_plan_pilot(&c, a->pilot, a->is_quiet, &pilot, &n, m);
    if (s == FW_OK) s = fw_plan_outlook(&x, &c, n, pilot, a->is_quiet, m);
    if (s == FW_OK) {
        fw_plan_forecast f = fw_plan_forecast_make(&c, &x);
        double           speed = mean_speed(&c, n, pilot);
        s = store_choice(a, &c, &x, &f, n, pilot, m);
        if (a->is_json)
            print_json(&c, &facts, &choice, &e, &strip, &x, &f, speed);
        else
            print_text(a, &c, &facts, &choice, &e, &strip, &x, &f, speed);
        if (s == FW_OK) s = fw_output_finish(m);
    }
    fw_outlook_free(&x);
    fw_plan_strip_free(&strip);
    for (size_t i = 0; i < n; i++) fw_record_free(&pilot[i]);
    free(pilot);
    fw_campaign_free(&c);
    return s;
}

int fw_cmd_plan(int argc, char **argv)
{
    arguments a = {.pilot = -1, .seed = -1};
    fw_msg    m = {""};
    argp_parse(&ARGP, argc, argv, 0, NULL, &a);
    fw_plan_effects_wanted effects = {.campaign = a.campaign,
                                      .n_sets = a.n_sets,
                                      .sets = a.sets,
                                      .seed = a.seed,
                                      .out = a.out,
                                      .cpu_budget_s = a.effects_budget_s,
                                      .n_windows = (size_t)a.n_whole,
                                      .is_json = a.is_json,
                                      .is_quiet = a.is_quiet};
    fw_plan_levels_wanted levels = {.choice = {.campaign = a.campaign, .n_sets = a.n_sets, .sets = a.sets, .seed = a.seed, .from = a.accuracy_from},
                                    .cpu_budget_s = a.levels_budget_s,
                                    .is_json = a.is_json,
                                    .is_quiet = a.is_quiet};
    fw_status s = a.is_effects ? fw_plan_effects(&effects, &m) : a.is_levels ? fw_plan_levels(&levels, &m) : plan(&a, &m);
    if (s != FW_OK) fprintf(stderr, "floewear plan: %s\n", m.text[0] ? m.text : fw_status_sentence(s));
    return fw_status_exit_code(s);
}
