/* `floewear plan CAMPAIGN.yaml`: what a run would do and cost, measured on a pilot of its first realisations; no results. */
#include <argp.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>

#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/config.h"
#include "cli/campaign_arguments.h"
#include "cli/effects_print.h"
#include "cli/json.h"
#include "cli/output.h"
#include "cli/plan_effects.h"
#include "cli/plan_levels.h"
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
    {"pilot", KEY_PILOT, "N", 0, "realisations of the pilot (default: up to 16, as long as they are expected to take minutes; 0: none)", 0},
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
                                 "and precision that a pilot predicts. Writes no results; with --effects the measured effects ledger.",
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

/* About what a core of 2020 does in a second, at 40 to 80 % ice. */
static const double EVALUATIONS_PER_S = 1.3e7;
enum { USUAL_PILOT = 16 };
static const double PILOT_S = 200; /* expected of all its windows */

typedef struct pilot {
    size_t n, n_failed, n_wear;
    double cpu, cpu_max;     /* [s] mean and largest */
    double mean_log, sd_log; /* of ln(mean wear load over the ring) */
    double mean_speed;       /* [m/s] */
} pilot;

/* n < 0: the usual number, but no more than PILOT_S. */
static fw_status run_pilot(const fw_campaign *c, long n, pilot *p, fw_msg *m)
{
    double sum = 0, sum2 = 0, evaluations = 0;
    size_t most = n < 0 ? USUAL_PILOT : (size_t)n;
    for (size_t id = 0; id < most; id++) {
        fw_scenario s;
        fw_record   r;
        double      one;
        fw_campaign_scenario(c, id, &s);
        FW_TRY(fw_cost_expected(&c->model, &s, &one, m));
        evaluations += one;
        if (n < 0 && evaluations > PILOT_S * EVALUATIONS_PER_S) break;
        FW_TRY(fw_realise(&c->model, &s, NULL, &r, m));
        p->n++;
        p->cpu += r.host_cpu_s;
        p->cpu_max = fmax(p->cpu_max, r.host_cpu_s);
        p->mean_speed += r.speed;
        double load = 0;
        for (size_t k = 0; k < r.n_arcs; k++) load += fw_record_load(&r, 0, FW_RING_LOAD)[k];
        if (r.status != FW_OK)
            p->n_failed++;
        else if (load > 0) {
            double l = log(load);
            p->n_wear++, sum += l, sum2 += l * l;
        }
        fw_record_free(&r);
    }
    if (p->n) p->cpu /= (double)p->n, p->mean_speed /= (double)p->n;
    if (p->n_wear > 1) {
        double k = (double)p->n_wear;
        p->mean_log = sum / k, p->sd_log = sqrt(fmax(0, (sum2 - sum * sum / k) / (k - 1)));
    }
    return FW_OK;
}

/* Relative half-width of a percentile of a lognormal from n samples: z sqrt(q (1 - q) / n) / (f(x) x), f(x) x = phi(z_q) / sd.
 * Averaging over temperature and direction makes the truth narrower. */
static double predicted_half_width(const fw_campaign *c, const pilot *p, double n)
{
    double z = gsl_cdf_ugaussian_Pinv(0.5 + 0.5 * c->precision.confidence);
    if (c->precision.quantity == FW_QUANTITY_MEAN) return z * sqrt(expm1(p->sd_log * p->sd_log) / n);
    double q = c->precision.percentile / 100;
    return z * sqrt(q * (1 - q) / n) * p->sd_log / gsl_ran_ugaussian_pdf(gsl_cdf_ugaussian_Pinv(q));
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

typedef struct forecast {
    double n, half_width, cpu_s,
        n_wanted; /* realisations of the run, what they reach, cost; realisations that the precision wants */
} forecast;

static forecast predict(const fw_campaign *c, const pilot *p)
{
    forecast f = {.n = (double)c->precision.max_realisations, .half_width = NAN, .n_wanted = NAN};
    if (p->n_wear > 1) {
        double one = predicted_half_width(c, p, 1);
        if (c->precision.half_width > 0) {
            f.n_wanted = ceil(one * one / (c->precision.half_width * c->precision.half_width));
            f.n = fmin(f.n, fmax(f.n_wanted, 100));
        }
        f.half_width = one / sqrt(f.n);
    }
    f.cpu_s = p->n ? f.n * p->cpu : NAN;
    return f;
}

static void print_json(const fw_campaign *c, const fw_scene_facts *facts, const fw_choice *choice, const expected *of, const pilot *p,
                       const forecast *f, double speed)
{
    fw_json                 j = fw_json_onto(stdout);
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    fw_json_begin_object(&j);
    fw_json_key(&j, "campaign"), fw_json_string(&j, c->name);
    fw_json_key(&j, "effects");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < n; i++) {
        char reason[FW_REASON_SIZE];
        bool is_on = effect_state(c, facts, choice, e[i], reason);
        fw_json_begin_object(&j);
        fw_json_key(&j, "name"), fw_json_string(&j, e[i]->name);
        fw_json_key(&j, "on"), fw_json_bool(&j, is_on);
        fw_json_key(&j, "reason"), fw_json_string(&j, reason);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_key(&j, "effects_choice"), fw_json_string(&j, choice->effects_line);
    fw_json_key(&j, "effects_ledger"), fw_effects_json_rows(&j, &choice->effects);
    fw_json_key(&j, "effects_measured"), fw_json_string(&j, choice->effects.n_rows ? choice->effects.origin : "nowhere");
    fw_accuracy_line lines[16];
    size_t           n_lines = fw_accuracy_lines(&c->model, speed, lines, 16);
    fw_json_key(&j, "numerics"), fw_json_string(&j, choice->line);
    fw_json_key(&j, "accuracy");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < n_lines; i++) {
        fw_json_begin_object(&j);
        fw_json_key(&j, "name"), fw_json_string(&j, lines[i].name);
        fw_json_key(&j, "value"), fw_json_number(&j, lines[i].value);
        fw_json_key(&j, "unit"), fw_json_string(&j, lines[i].unit);
        fw_json_key(&j, "why"), fw_json_string(&j, lines[i].why);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_key(&j, "expected");
    fw_json_begin_object(&j);
    fw_json_key(&j, "force_evaluations_mean"), fw_json_number(&j, of->mean);
    fw_json_key(&j, "force_evaluations_most"), fw_json_number(&j, of->most);
    fw_json_end(&j);
    fw_json_key(&j, "pilot");
    fw_json_begin_object(&j);
    fw_json_key(&j, "n"), fw_json_integer(&j, (int64_t)p->n);
    fw_json_key(&j, "failed"), fw_json_integer(&j, (int64_t)p->n_failed);
    fw_json_key(&j, "cpu_s_mean"), fw_json_number(&j, p->n ? p->cpu : NAN);
    fw_json_key(&j, "cpu_s_max"), fw_json_number(&j, p->n ? p->cpu_max : NAN);
    fw_json_key(&j, "sd_of_log_load"), fw_json_number(&j, p->n_wear > 1 ? p->sd_log : NAN);
    fw_json_end(&j);
    fw_json_key(&j, "predicted");
    fw_json_begin_object(&j);
    fw_json_key(&j, "realisations"), fw_json_number(&j, f->n);
    fw_json_key(&j, "realisations_wanted"), fw_json_number(&j, f->n_wanted);
    fw_json_key(&j, "half_width"), fw_json_number(&j, f->half_width);
    fw_json_key(&j, "cpu_s"), fw_json_number(&j, f->cpu_s);
    fw_json_end(&j);
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
                       const pilot *p, const forecast *f, double speed)
{
    size_t wanted = a->pilot < 0 ? USUAL_PILOT : (size_t)a->pilot;
    printf("plan of campaign %s\n\n", c->name);
    print_effects(c, facts, choice);
    fw_accuracy_line lines[16];
    size_t           n_lines = fw_accuracy_lines(&c->model, speed, lines, 16);
    printf("\naccuracy %g %% of a window's depth, at %.3g m/s; %s\n", 100 * c->model.accuracy, speed, choice->line);
    for (size_t i = 0; i < n_lines; i++)
        printf("  %-13s %10.4g %-4s  %s\n", lines[i].name, lines[i].value, lines[i].unit, lines[i].why);
    printf("\ncost model: %.2g force evaluations a window in the mean, %.2g at most: about %.2g and %.2g CPU s\n", of->mean, of->most,
           of->mean / EVALUATIONS_PER_S, of->most / EVALUATIONS_PER_S);
    if (c->model.max_evaluations > 0)
        printf("  one that takes more than %.3g fails (exposure.max_force_evaluations)\n", c->model.max_evaluations);
    else
        printf("  one that takes more than 100 times what is expected of it and than 1e9 fails (exposure.max_force_evaluations: auto)\n");
    if (p->n < wanted) printf("\npilot: %s; --pilot %zu runs %zu all the same\n", p->n ? "cut short, its next window may take minutes" : "none, its first window may take minutes", wanted, wanted);
    if (p->n) {
        printf("\npilot of %zu realisations: %.3g CPU s each in the mean, %.3g at most, %zu failed\n", p->n, p->cpu,
               p->cpu_max, p->n_failed);
        if (p->n_wear > 1)
            printf("  spread between windows: %.2f in the log of the wear load over the ring\n", p->sd_log);
        printf("\npredicted\n");
        if (isfinite(f->n_wanted))
            printf("  %.0f realisations reach a half-width of %.3g %%", f->n_wanted, 100 * c->precision.half_width);
        if (isfinite(f->n_wanted))
            printf(f->n_wanted > (double)c->precision.max_realisations ? ": more than max_realisations\n" : "\n");
        printf("  a run of %.0f realisations costs %.3g CPU s: %.3g s on 1 core, %.3g s on 2, %.3g s on 16", f->n,
               f->cpu_s, f->cpu_s, f->cpu_s / 2, f->cpu_s / 16);
        if (isfinite(f->half_width)) printf("; half-width about %.2g %%", 100 * f->half_width);
        printf("\n  (lognormal spread of the pilot; averaging over temperature and direction can only make it "
               "narrower)\n");
    }
    for (size_t i = 0; i < c->n_not_applied; i++)
        printf("%s%s is read and checked but not applied in this version\n", i ? "" : "\n", c->not_applied[i]);
}

static fw_status plan(const arguments *a, fw_msg *m)
{
    fw_campaign      c = {0};
    pilot            p = {0};
    expected         e = {0, 0};
    fw_choice        choice;
    fw_scene_facts   facts;
    fw_choice_wanted wanted = {
        .campaign = a->campaign, .n_sets = a->n_sets, .sets = a->sets, .seed = a->seed, .from = a->accuracy_from, .out = a->out};
    FW_TRY(fw_choice_campaign(&c, &wanted, &choice, m));
    fw_status s = fw_facts_campaign(&c.model, &c.site, &facts, m);
    if (s == FW_OK) s = expect(&c, &e, m);
    if (s == FW_OK) s = run_pilot(&c, a->pilot, &p, m);
    if (s == FW_OK) {
        fw_scenario sc;
        fw_campaign_scenario(&c, 0, &sc);
        forecast f = predict(&c, &p);
        double   speed = p.n ? p.mean_speed : sc.speed;
        if (a->is_json)
            print_json(&c, &facts, &choice, &e, &p, &f, speed);
        else
            print_text(a, &c, &facts, &choice, &e, &p, &f, speed);
        s = fw_output_finish(m);
    }
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
