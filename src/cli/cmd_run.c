/* floewear run: a campaign from its file to percentiles, alone or under mpirun; the same command again goes on.
 *
 *   all ranks   arguments, campaign file
 *   rank 0      NAME.journal -> what is there -> fw_campaign_run -> answers -> NAME.h5 -> table or JSON on stdout
 *   the others  fw_campaign_serve, silently: what goes wrong there is told to rank 0, which says it once */
#include <argp.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "cli/campaign_arguments.h"
#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/config.h"
#include "cli/failed_scene.h"
#include "cli/output.h"
#include "cli/progress_line.h"
#include "cli/record_print.h"
#include "cli/report_summary.h"
#include "cli/run_answer.h"
#include "cli/run_files.h"

typedef struct run_arguments {
    fw_campaign_arguments of; /* the campaign */
    const char           *out, *accuracy_from;
    int64_t               only_id; /* < 0: the whole campaign */
    int64_t               first_id, end_id; /* of a part; end_id 0: all of it */
    bool                  is_fresh, is_quiet, is_json, runs_failed_again;
} run_arguments;

enum { KEY_FRESH = 256, KEY_RERUN, KEY_JSON, KEY_ONLY_ID, KEY_ACCURACY, KEY_IDS };

static const struct argp_option run_options[] = {
    {"output", 'o', "OUT", 0, "write OUT.journal and OUT.h5 (default: the campaign's name, in the current folder)", 0},
    FW_OPTION_SET,
    FW_OPTION_SEED,
    {"time-budget", FW_KEY_BUDGET, "TIME", 0, "stop in good order after this much wall-clock time, as in 2h or 90min", 0},
    {"fresh", KEY_FRESH, NULL, 0, "start anew; an old journal is kept as OUT.journal.old", 0},
    {"rerun-failed", KEY_RERUN, NULL, 0, "run those of the journal again that failed", 0},
    {"accuracy-from", KEY_ACCURACY, "FILE", 0, "numerics chosen by floewear accuracy (default: OUT.accuracy.h5, if it is there)", 0},
    {"ids", KEY_IDS, "FIRST:END", 0, "a part: only realisations FIRST to END-1, as in 0:1000 and 1000:2000 on two machines; it does not stop by precision, and floewear merge joins parts", 0},
    {"quiet", 'q', NULL, 0, "no progress on stderr", 0},
    {"json", KEY_JSON, NULL, 0, "results as JSON instead of tables", 0},
    {"only-id", KEY_ONLY_ID, "N", 0, "run realisation N alone and print its record; nothing is written but, if it fails, OUT.failed-N.yaml, a scene that fails too", 0},
    {0}};

static const char run_doc[] =
    "Run a campaign and print its design percentiles. Under mpirun all ranks share the work. Run the same command "
    "again to go on after a stop.\vExit codes: 0 done, 2 wrong input, 3 too many failed realisations, 4 input or "
    "output error, 75 stopped early (signal or time budget).";

/* "1000:2000", half-open, so that parts meet without a number between them. */
static bool run_parse_ids(const char *text, run_arguments *a)
{
    char        first[32];
    const char *colon = strchr(text, ':');

    if (!colon || (size_t)(colon - text) >= sizeof first) return false;
    snprintf(first, sizeof first, "%.*s", (int)(colon - text), text);
    return fw_argument_number(first, &a->first_id) && fw_argument_number(colon + 1, &a->end_id) && a->first_id < a->end_id;
}

static error_t run_parse(int key, char *text, struct argp_state *state)
{
    run_arguments *a = state->input;

    switch (key) {
    case 'o': a->out = text; return 0;
    case 'q': a->is_quiet = true; return 0;
    case KEY_ACCURACY: a->accuracy_from = text; return 0;
    case KEY_FRESH: a->is_fresh = true; return 0;
    case KEY_RERUN: a->runs_failed_again = true; return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case KEY_ONLY_ID:
        if (fw_argument_number(text, &a->only_id)) return 0;
        argp_error(state, "--only-id %s: a realisation's number from 0 on is wanted", text);
        return EINVAL;
    case KEY_IDS:
        if (run_parse_ids(text, a)) return 0;
        argp_error(state, "--ids %s: FIRST:END is wanted, as in 0:1000 for realisations 0 to 999", text);
        return EINVAL;
    case ARGP_KEY_END:
        if (a->end_id > 0 && a->only_id >= 0) {
            argp_error(state, "--ids or --only-id, not both");
            return EINVAL;
        }
        return fw_campaign_arguments_parse(key, text, state, &a->of);
    default: return fw_campaign_arguments_parse(key, text, state, &a->of);
    }
}

/* --- rank 0 ------------------------------------------------------------------------------------------------------- */

/* What the live line and the stop rule need while the campaign goes on. */
typedef struct run_session {
    const fw_campaign *campaign;
    fw_run_files       files;
    fw_choice          choice; /* of numerics */
    fw_progress_line   line;
    double             estimated, estimate_cost; /* when the last live estimate was made, what it took [s] */
    uint64_t           estimated_n;
} run_session;

/* "P90 2.31e-04 mm +- 12 %, point 5" from the first n realisations. */
static fw_status run_estimate(run_session *s, uint64_t n, char *out, size_t size, fw_msg *m)
{
    const fw_campaign *c      = s->campaign;
    fw_answer_source   source = fw_run_files_answer(&s->files, n);
    fw_reached         r;
    char               quantity[32], interval[32];

    FW_TRY(fw_answer_reached(c, &source, &r, m));
    if (!isfinite(r.half_width)) {
        snprintf(interval, sizeof interval, "+- ?");
    } else {
        snprintf(interval, sizeof interval, r.half_width < 0.1 ? "+- %.2g %%" : "+- %.0f %%", 100.0 * r.half_width);
    }
    snprintf(out, size, "%s %.3g mm %s, point %zu", fw_report_quantity(c, quantity, sizeof quantity), r.value_mm, interval, r.point);
    return FW_OK;
}

/* The estimate may use any complete prefix: it decides nothing. It is refreshed every 2 s at most and takes at most a
 * fiftieth of rank 0's time. */
static void run_show(void *self, const fw_progress *p)
{
    run_session *s   = self;
    double       now = fw_seconds();
    fw_msg       m   = {.text = ""};

    if (p->prefix >= 2 && p->prefix != s->estimated_n && now - s->estimated > fmax(2.0, 50.0 * s->estimate_cost)) {
        /* An estimate that cannot be made is no reason to end a campaign; the looks report what is wrong. */
        if (run_estimate(s, p->prefix, s->line.estimate, sizeof s->line.estimate, &m) != FW_OK) {
            s->line.estimate[0] = '\0';
        }
        s->estimated     = fw_seconds();
        s->estimate_cost = s->estimated - now;
        s->estimated_n   = p->prefix;
    }
    fw_progress_line_show(&s->line, p);
}

static fw_status run_look(void *self, uint64_t n, bool *is_enough, fw_msg *m)
{
    run_session     *s          = self;
    fw_answer_source source     = fw_run_files_answer(&s->files, n);
    fw_reached       r;

    FW_TRY(fw_answer_reached(s->campaign, &source, &r, m));
    *is_enough = r.is_enough;
    return FW_OK;
}

/* Failed realisations are told in any case: how to see each again stands beside it. */
static void run_list_failures(run_session *s, uint64_t n)
{
    fw_record_source records = fw_run_files_records(&s->files, n);
    const fw_model *model  = &s->campaign->model;
    uint64_t        n_told = 0, n_failed = 0, n_cured = 0;
    fw_record       r = {.id = 0};
    fw_msg          m;

    if (fw_record_init(&r, model->n_arcs, model->n_laws, &m) != FW_OK) return;
    for (uint64_t i = 0; i < n; i++) {
        if (records.read(records.self, i, &r, &m) != FW_OK) continue;
        if (r.status == FW_OK && r.tries > 1 && n_cured++ < 3)
            fprintf(stderr, "cured by finer steps: id %" PRIu64 ": %s\n", r.id, r.cause);
        if (r.status == FW_OK) continue;
        n_failed++;
        if (n_told++ < 10) {
            fprintf(stderr, "failed: id %" PRIu64 " (seed %" PRIu64 "): %s; --only-id %" PRIu64 " runs it again\n", r.id,
                    s->campaign->seed, r.cause, r.id);
        }
    }
    if (n_cured > 3) fprintf(stderr, "cured by finer steps: %" PRIu64 " in all\n", n_cured);
    if (n_failed > 10) fprintf(stderr, "failed: %" PRIu64 " more\n", n_failed - 10);
    fw_record_free(&r);
}

static void run_say_not_applied(const fw_campaign *c)
{
    for (size_t i = 0; i < c->n_not_applied; i++) {
        fprintf(stderr, "not applied in this version: %s\n", c->not_applied[i]);
    }
}

/* The campaign itself, with its journal open. */
static fw_status run_campaign(run_session *s, const run_arguments *a, fw_msg *m)
{
    const fw_campaign *c      = s->campaign;
    fw_run_result      result = {0};
    fw_msg             later  = {.text = ""};
    fw_status          status, written = FW_OK;
    fw_run             run = {.campaign      = c,
                              .have          = s->files.have,
                              .n_have        = s->files.n_have,
                              .have_failed   = s->files.have_failed,
                              .n_have_failed = s->files.n_have_failed,
                              .sink          = fw_run_files_sink(&s->files),
                              .watcher       = {.show = run_show, .self = s},
                              .first_id      = (uint64_t)a->first_id,
                              .end_id        = (uint64_t)a->end_id,
                              .only_id       = -1};
    uint64_t           total = a->end_id ? run.end_id - run.first_id : c->precision.max_realisations;

    if (c->precision.half_width > 0.0) run.stop = (fw_stop_rule){.look = run_look, .self = s};
    if (!a->is_quiet) fprintf(stderr, "%s\n", s->choice.line);
    if (s->choice.design_line[0] && !a->is_quiet) fprintf(stderr, "%s\n", s->choice.design_line);
    if (s->choice.effects_line[0] && (!a->is_quiet || s->choice.dropped)) fprintf(stderr, "%s\n", s->choice.effects_line);
    if (a->end_id && !a->is_quiet) {
        fprintf(stderr, "a part: realisations %" PRId64 " to %" PRId64 "; it does not stop by precision, as its ids are no prefix of the campaign\n",
                a->first_id, a->end_id - 1);
    }
    fw_progress_line_start(&s->line, stderr, a->is_quiet);
    if (s->files.n_have && !a->is_quiet) {
        fprintf(stderr, "%s: going on from %zu of %" PRIu64 " realisations\n", s->files.journal_path, s->files.n_have,
                total);
    }
    status = fw_campaign_run(&run, &result, m);
    fw_progress_line_end(&s->line);

    if (!a->is_quiet || result.n_failed) run_list_failures(s, result.n_prefix);
    if (status != FW_OK && status != FW_E_STOPPED && status != FW_E_FAILURES) return status;
    /* Stopped while it ran failed ones again: fewer stand without a gap than before, and results of all are there. */
    if (result.n_prefix > 0 && !(status == FW_E_STOPPED && a->runs_failed_again)) {
        written = fw_run_answer(&s->files, result.n_prefix, &s->choice.measured, &s->choice.effects, a->is_json, &later);
        if (written == FW_OK && !a->is_quiet && a->end_id) {
            fprintf(stderr, "%s: realisations %" PRIu64 " to %" PRIu64 "\n", s->files.results_path, run.first_id, run.first_id + result.n_prefix - 1);
        } else if (written == FW_OK && !a->is_quiet) {
            fprintf(stderr, "%s: the first %" PRIu64 " realisations\n", s->files.results_path, result.n_prefix);
        }
    }
    if (status == FW_E_STOPPED) {
        fw_msg why = *m;

        fw_fail(m, status, "%s with %" PRIu64 " of %" PRIu64 " realisations in %s; run the same command again to go on",
                why.text, result.n_done, total, s->files.journal_path);
    }
    if (status == FW_E_FAILURES) {
        fw_fail(m, status, "more than %" PRIu64 " (precision.max_failed) of the first %" PRIu64 " realisations%s failed",
                c->precision.max_failed, result.n_prefix, a->end_id ? " of this part" : "");
    }
    if (written != FW_OK && !(written == FW_E_FAILURES && status != FW_OK)) { /* that there is no answer after that is no news */
        *m = later;
        return written;
    }
    return status;
}

/* --- one realisation ---------------------------------------------------------------------------------------------- */

typedef struct run_printer {
    const fw_campaign *campaign;
    bool               is_json;
    fw_record          record; /* without its rings */
} run_printer;

static fw_status run_print_record(void *self, const fw_record *r, fw_msg *m)
{
    run_printer *p = self;

    p->record = *r;
    p->record.rings = NULL;
    if (p->is_json) {
        fw_record_print_json(stdout, p->campaign, r);
    } else {
        fw_record_print_text(stdout, r);
    }
    return fw_output_finish(m);
}

/* A failure that happens without its history is worth more as a scene: seconds instead of hours. Whatever comes in between, the failure is told. */
static void run_show_alone(const run_printer *p, const run_arguments *a)
{
    char        path[4200];
    const char *stem = a->out ? a->out : p->campaign->name;
    size_t      n = strlen(stem);
    bool        is_written = false;
    fw_msg      m = {.text = ""};

    if (p->record.status != FW_E_NUMERIC) return;
    if (n > 3 && strcmp(stem + n - 3, ".h5") == 0) n -= 3;
    snprintf(path, sizeof path, "%.*s.failed-%" PRId64 ".yaml", (int)(n < 4000 ? n : 4000), stem, a->only_id);
    if (fw_failed_scene_write(p->campaign, &p->record, path, &is_written, &m) != FW_OK) {
        fprintf(stderr, "no scene file: %s\n", m.text);
    } else if (is_written) {
        fprintf(stderr, "it fails alone too: floewear scene %s\n", path);
    } else {
        fprintf(stderr, "no scene file: it does not fail without what went before\n");
    }
}

static fw_status run_only(const fw_campaign *c, const run_arguments *a, fw_msg *m)
{
    run_printer   printer = {.campaign = c, .is_json = a->is_json};
    fw_run_result result;
    fw_run        run = {.campaign = c,
                         .sink     = {.append = run_print_record, .self = &printer},
                         .only_id  = a->only_id};

    FW_TRY(fw_campaign_run(&run, &result, m));
    if (printer.record.status != FW_OK) {
        run_show_alone(&printer, a);
        return fw_fail(m, printer.record.status, "realisation %" PRId64 " failed: %s", a->only_id, printer.record.cause);
    }
    return FW_OK;
}

/* --- all ranks ---------------------------------------------------------------------------------------------------- */

static fw_choice_wanted run_wanted(const run_arguments *a)
{
    return (fw_choice_wanted){.campaign = a->of.campaign,
                              .n_sets   = a->of.n_sets,
                              .sets     = a->of.sets,
                              .seed     = a->of.seed,
                              .from     = a->accuracy_from,
                              .out      = a->out};
}

static fw_status run_check_part(const run_arguments *a, const fw_campaign *c, fw_msg *m)
{
    FW_CHECK((uint64_t)a->end_id <= c->precision.max_realisations, m, FW_E_INPUT,
             "--ids %" PRId64 ":%" PRId64 ": the campaign has realisations 0 to %" PRIu64 " (precision.max_realisations %" PRIu64 ")", a->first_id,
             a->end_id, c->precision.max_realisations - 1, c->precision.max_realisations);
    return FW_OK;
}

static fw_status run_lead(const run_arguments *a, fw_msg *m)
{
    fw_campaign c;
    run_session s = {.campaign = &c};
    fw_msg      later = {.text = ""};
    fw_status   status, closed;
    fw_choice_wanted wanted;

    wanted = run_wanted(a);
    status = fw_choice_campaign(&c, &wanted, &s.choice, m);
    if (status != FW_OK) {
        fw_campaign_cancel();
        return status;
    }
    c.precision.budget_s = a->of.budget_s;
    run_say_not_applied(&c);
    status = run_check_part(a, &c, m);
    if (status != FW_OK) {
        fw_campaign_cancel();
        fw_campaign_free(&c);
        return status;
    }
    if (a->only_id >= 0) {
        status = run_only(&c, a, m);
        fw_campaign_free(&c);
        return status;
    }
    status = fw_run_files_open(&s.files, &c, a->out, a->is_fresh, a->runs_failed_again, (uint64_t)a->first_id, m);
    if (status == FW_OK) {
        status = run_campaign(&s, a, m);
    } else {
        fw_campaign_cancel();
    }
    closed = fw_run_files_close(&s.files, &later);
    if (closed != FW_OK && (status == FW_OK || status == FW_E_STOPPED)) {
        status = closed;
        *m     = later;
    }
    fw_campaign_free(&c);
    return status;
}

static void run_follow(const run_arguments *a)
{
    fw_campaign c;
    fw_msg      m = {.text = ""};
    fw_choice   choice;
    fw_choice_wanted wanted = run_wanted(a);

    /* the same file as rank 0 reads; a rank that does not see it has another campaign, and rank 0 says so */
    if (fw_choice_campaign(&c, &wanted, &choice, &m) == FW_OK) {
        fw_campaign_serve(&c, &m);
        fw_campaign_free(&c);
    } else {
        fw_campaign_serve(NULL, &m);
    }
}

int fw_cmd_run(int argc, char **argv)
{
    const struct argp argp = {.options = run_options, .parser = run_parse, .args_doc = "CAMPAIGN.yaml", .doc = run_doc};
    run_arguments     a    = {.of.seed = -1, .only_id = -1};
    fw_msg            m    = {.text = ""};
    fw_status         s;
    int               rank = 0, n_ranks = 1;

    /* Help needs no ranks, and argp ends the program after it. */
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-?") == 0 || strcmp(argv[i], "--usage") == 0) {
            argp_parse(&argp, argc, argv, 0, NULL, &a);
        }
    }
    s = fw_ranks_start(&argc, &argv, &rank, &n_ranks, &m);
    if (s == FW_OK) {
        unsigned flags = ARGP_NO_EXIT | (rank > 0 ? ARGP_NO_ERRS : 0u);
        error_t  wrong = argp_parse(&argp, argc, argv, flags, NULL, &a);

        if (wrong) {
            /* argp has said it on rank 0, and every rank leaves for the same reason */
            s = wrong == ENOMEM ? FW_E_NOMEM : FW_E_INPUT;
        } else if (rank == 0) {
            s = run_lead(&a, &m);
        } else {
            run_follow(&a);
        }
    }
    if (rank == 0 && m.text[0] && s != FW_OK) fprintf(stderr, "floewear run: %s\n", m.text);
    fw_ranks_stop();
    free(a.of.sets);
    return rank == 0 ? fw_status_exit_code(s) : 0;
}
