/* floewear accuracy: error against cost on a campaign's own scenes, measured; the cheapest setting goes to NAME.accuracy.h5, where
 * `run` and `plan` find it. One process: its CPU seconds are part of the result, and ranks that share a machine would blur them. */
#include <argp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/clock.h"
#include "campaign/signals.h"
#include "cli/accuracy_file.h"
#include "cli/accuracy_print.h"
#include "cli/campaign_arguments.h"
#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/config.h"
#include "cli/output.h"

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

/* ---- while it runs ---------------------------------------------------------------------------------------------- */

typedef struct watch {
    double start, budget_s, said; /* [s] */
    bool   is_quiet, is_terminal, is_line_open;
} watch;

static fw_status look(void *self, double done)
{
    const watch *w = self;
    (void)done;
    if (fw_signals_received()) return FW_E_STOPPED;
    return w->budget_s > 0 && fw_seconds() - w->start > w->budget_s ? FW_E_STOPPED : FW_OK;
}

/* On a terminal one line that is rewritten; in a log one a minute. */
static void say(void *self, const char *what)
{
    watch *w = self;
    double now = fw_seconds();
    if (w->is_quiet || (!w->is_terminal && now - w->said < 60)) return;
    w->said = now;
    w->is_line_open = w->is_terminal;
    fprintf(stderr, w->is_terminal ? "\r\033[K%5.0f s  %s" : "%.0f s: %s\n", now - w->start, what);
    fflush(stderr);
}

/* ---- the command ------------------------------------------------------------------------------------------------ */

/* A place that cannot be written is told now, not after minutes. */
static fw_status check_place(const char *path, fw_msg *m)
{
    char        folder[4096];
    const char *slash = strrchr(path, '/');
    struct stat s;
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash == path ? 1 : slash - path) : 1, slash ? path : ".");
    FW_CHECK(stat(folder, &s) == 0, m, FW_E_IO, "-o: the folder %s cannot be used: %s", folder, strerror(errno));
    FW_CHECK(S_ISDIR(s.st_mode), m, FW_E_IO, "-o: %s is not a folder", folder);
    FW_CHECK(access(folder, W_OK) == 0, m, FW_E_IO, "-o: the folder %s cannot be written: %s", folder, strerror(errno));
    fw_tables *old = NULL;
    fw_msg     why = {""};
    if (stat(path, &s) != 0) return FW_OK;
    fw_status status = fw_tables_open(&old, path, FW_ACCURACY_FILETYPE, &why);
    fw_tables_close(old);
    FW_CHECK(status == FW_OK, m, FW_E_MISMATCH, "will not replace a file that is no accuracy study of ours: %s",
             why.text);
    return FW_OK;
}

static fw_status measure(const accuracy_arguments *a, const fw_campaign *c, const char *path, fw_msg *m)
{
    watch w = {
        .start = fw_seconds(), .budget_s = a->of.budget_s, .is_quiet = a->is_quiet, .is_terminal = isatty(STDERR_FILENO)};
    fw_tick             tick = {.call = look, .self = &w};
    fw_accuracy_options o = {.scenario = fw_campaign_scenario,
                             .cpu_budget_s = a->is_quick ? QUICK_S : USUAL_S,
                             .tick = &tick,
                             .say = say,
                             .say_self = &w};
    fw_accuracy         result;
    w.said = w.start;
    if (a->of.budget_s > 0 && SHARE_OF_BUDGET * a->of.budget_s < o.cpu_budget_s)
        o.cpu_budget_s = SHARE_OF_BUDGET * a->of.budget_s;
    if (a->cpu_budget_s > 0) o.cpu_budget_s = a->cpu_budget_s;
    fw_status s = fw_accuracy_study(&result, c, &o, m);
    if (w.is_line_open) fprintf(stderr, "\r\033[K");
    if (s == FW_E_STOPPED) {
        return fw_signals_received()
                   ? fw_fail(m, s, "stopped by signal %d; nothing is written", fw_signals_received())
                   : fw_fail(m, s, "the time budget of %g s is used up; nothing is written", a->of.budget_s);
    }
    FW_TRY(s);
    s = fw_accuracy_file_write(path, c, &result, m);
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

/* One process; a launcher that starts several of us says so in the environment, whoever's it is. */
static bool is_one_of_many(void)
{
    static const char *const NAMES[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++) {
        const char *n = getenv(NAMES[i]);
        if (n && strtol(n, NULL, 10) > 1) return true;
    }
    return false;
}

static fw_status accuracy(const accuracy_arguments *a, fw_msg *m)
{
    char        path[4096];
    fw_campaign c;
    FW_CHECK(!is_one_of_many(), m, FW_E_INPUT, "it runs on one core: start it without mpirun (it measures CPU time)");
    FW_TRY(fw_config_campaign(&c, a->of.campaign, a->of.n_sets, a->of.sets, a->of.seed, m));
    fw_status s = fw_choice_path(path, sizeof path, a->out ? a->out : c.name, m);
    if (s == FW_OK) s = check_place(path, m);
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
