/* floewear accuracy: error against cost on a campaign's own scenes, measured; the cheapest setting goes to NAME.accuracy.h5, where
 * `run` and `plan` find it. One process: its CPU seconds are part of the result, and ranks that share a machine would blur them. */
#include <argp.h>
#include <stdlib.h>

#include "campaign/signals.h"
#include "cli/accuracy_file.h"
#include "cli/accuracy_print.h"
#include "cli/campaign_arguments.h"
#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/config.h"
#include "cli/output.h"
#include "cli/study_run.h"

typedef struct accuracy_arguments {
    fw_campaign_arguments of; /* the campaign */
    const char           *out;
    double                cpu_budget_s;
    bool                  is_quick, is_quiet, is_json;
} accuracy_arguments;

enum { KEY_CPU_BUDGET = 256, KEY_QUICK, KEY_JSON };

static const struct argp_option OPTIONS[] = {
    {"output", 'o', "OUT", 0, "write OUT.accuracy.h5 (default: the campaign's name, in the current folder)", 0},
    {"quick", KEY_QUICK, NULL, 0, "a small study, within two minutes on a busy machine", 0},
    FW_OPTION_SET,
    FW_OPTION_SEED,
    {"time-budget", FW_KEY_BUDGET, "TIME", 0,
     "stop after this much wall-clock time, as in 20min; sizes are chosen to fit it", 0},
    {"cpu-budget", KEY_CPU_BUDGET, "TIME", 0, "choose sizes for this much CPU time (default 15min; with --quick 45s)",
     0},
    {"quiet", 'q', NULL, 0, "no progress on stderr", 0},
    {"json", KEY_JSON, NULL, 0, "print JSON", 0},
    {0}};

static const char DOC[] = "Measure the error of every numerical choice against its cost on the campaign's own scenes, "
                          "print the work-precision table, "
                          "store it in NAME.accuracy.h5 and choose the cheapest setting within the campaign's "
                          "accuracy; run and plan take it from "
                          "there.\vExit codes: 0 done, 2 wrong input, 3 nothing to measure, 4 input or output error, "
                          "75 stopped (signal or time budget; "
                          "nothing is written).";

/* CPU seconds by the forecast, which is nearly twice what an idle machine takes; a busy one gives half of its time. */
static const double QUICK_S = 45, USUAL_S = 900, SHARE_OF_BUDGET = 0.5;

static error_t parse(int key, char *text, struct argp_state *state)
{
    accuracy_arguments *a = state->input;
    switch (key) {
    case 'o': a->out = text; return 0;
    case 'q': a->is_quiet = true; return 0;
    case KEY_QUICK: a->is_quick = true; return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case KEY_CPU_BUDGET: return fw_argument_duration("--cpu-budget", text, state, &a->cpu_budget_s);
    default: return fw_campaign_arguments_parse(key, text, state, &a->of);
    }
}

/* ---- the command ------------------------------------------------------------------------------------------------ */

static fw_status measure(const accuracy_arguments *a, const fw_campaign *c, const char *path, fw_msg *m)
{
    fw_study_watch      w = fw_study_watch_start(a->of.budget_s, a->is_quiet);
    fw_tick             tick = fw_study_watch_tick(&w);
    fw_accuracy_options o = {.scenario = fw_campaign_plain_scenario,
                             .cpu_budget_s = a->is_quick ? QUICK_S : USUAL_S,
                             .tick = &tick,
                             .say = fw_study_watch_say,
                             .say_self = &w};
    fw_accuracy         result;
    if (a->of.budget_s > 0 && SHARE_OF_BUDGET * a->of.budget_s < o.cpu_budget_s)
        o.cpu_budget_s = SHARE_OF_BUDGET * a->of.budget_s;
    if (a->cpu_budget_s > 0) o.cpu_budget_s = a->cpu_budget_s;
    FW_TRY(fw_study_watch_end(&w, fw_accuracy_study(&result, c, &o, m), m));
    fw_status s = fw_accuracy_file_write(path, c, &result, m);
    if (s == FW_OK) {
        if (a->is_json)
            fw_accuracy_print_json(stdout, c, &result);
        else
            fw_accuracy_print_text(stdout, c, &result);
        s = fw_output_finish(m);
        if (s == FW_OK && !a->is_quiet)
            fprintf(stderr, "%s: %.3g CPU s; run and plan take its choice\n", path, result.cpu_s);
    }
    fw_accuracy_free(&result);
    return s;
}

static fw_status accuracy(const accuracy_arguments *a, fw_msg *m)
{
    char        path[4096];
    fw_campaign c;
    FW_TRY(fw_study_check_alone(m));
    FW_TRY(fw_config_campaign(&c, a->of.campaign, a->of.n_sets, a->of.sets, a->of.seed, m));
    fw_status s = fw_choice_path(path, sizeof path, a->out ? a->out : c.name, FW_CHOICE_ACCURACY, m);
    if (s == FW_OK) s = fw_study_check_place(path, FW_ACCURACY_FILETYPE, m);
    if (s == FW_OK) s = measure(a, &c, path, m);
    fw_campaign_free(&c);
    return s;
}

int fw_cmd_accuracy(int argc, char **argv)
{
    const struct argp  argp = {.options = OPTIONS, .parser = parse, .args_doc = "CAMPAIGN.yaml", .doc = DOC};
    accuracy_arguments a = {.of.seed = -1};
    fw_msg             m = {.text = ""};
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    fw_signals_catch();
    fw_status s = accuracy(&a, &m);
    if (s != FW_OK) fprintf(stderr, "floewear accuracy: %s\n", m.text[0] ? m.text : fw_status_sentence(s));
    free(a.of.sets);
    return fw_status_exit_code(s);
}
