/* floewear report: percentiles, service life and ledger of a results file, made afresh from its records. */
#include <argp.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/campaign_arguments.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/report_table.h"
#include "cli/results_input.h"

typedef struct report_arguments {
    const char *path, *law;
    double     *percentiles; /* (n_percentiles) */
    size_t      n_percentiles, percentiles_capacity;
    size_t     *points; /* (n_points) */
    size_t      n_points, points_capacity;
    bool        is_csv, is_json, is_together;
} report_arguments;

enum { KEY_CSV = 256, KEY_JSON, KEY_LAW, KEY_SIMULTANEOUS };

static const struct argp_option report_options[] = {
    {"points", 'p', "LIST", 0, "measuring points by number, as in 1,6 (default: all)", 0},
    {"percentiles", 'q', "LIST", 0, "percentiles, as in 50,90,95,99 (default: these)", 0},
    {"law", KEY_LAW, "NAME", 0, "abrasion law of the campaign (default: its first)", 0},
    {"simultaneous", KEY_SIMULTANEOUS, NULL, 0, "in the table of points: intervals that cover at all of them together (CSV and JSON have both)", 0},
    {"csv", KEY_CSV, NULL, 0, "one line per point and percentile", 0},
    {"json", KEY_JSON, NULL, 0, "print JSON", 0},
    {0}};

static const char report_doc[] = "Percentiles with intervals, service life and ledger of a results file.";

/* Split "1,6" and hand each word on; a word that add refuses ends the program's parse with what is wrong with it. */
static error_t report_list(struct argp_state *state, const char *option, char *text,
                           fw_status (*add)(report_arguments *, const char *, fw_msg *))
{
    for (char *word = text; word;) {
        char *comma = strchr(word, ',');
        if (comma) *comma = '\0';
        fw_msg    m = {.text = ""};
        fw_status s = add(state->input, word, &m);
        if (s == FW_E_NOMEM) return fw_argument_no_memory(state, &m);
        if (s != FW_OK) {
            argp_error(state, "--%s: '%s' is wrong; numbers with commas between them are wanted, as in %s", option,
                       word, strcmp(option, "points") == 0 ? "1,6 (from 1 on)" : "50,90,95,99 (above 0, below 100)");
            return EINVAL;
        }
        word = comma ? comma + 1 : NULL;
    }
    return 0;
}

static fw_status add_point(report_arguments *a, const char *word, fw_msg *m)
{
    char *end;
    errno = 0;
    unsigned long long n = strtoull(word, &end, 10);
    if (errno || end == word || *end || word[0] == '-' || n == 0) return FW_E_INPUT;
    FW_TRY(fw_grow(&a->points, &a->points_capacity, a->n_points + 1, sizeof *a->points, "points", m));
    a->points[a->n_points++] = (size_t)n;
    return FW_OK;
}

static fw_status add_percentile(report_arguments *a, const char *word, fw_msg *m)
{
    char  *end;
    double p = strtod(word[0] == 'P' ? word + 1 : word, &end);
    if (end == word || *end || !(p > 0 && p < 100)) return FW_E_INPUT;
    FW_TRY(fw_grow(&a->percentiles, &a->percentiles_capacity, a->n_percentiles + 1, sizeof *a->percentiles,
                   "percentiles", m));
    a->percentiles[a->n_percentiles++] = p;
    return FW_OK;
}

static error_t report_parse(int key, char *text, struct argp_state *state)
{
    report_arguments *a = state->input;
    switch (key) {
    case 'p': return report_list(state, "points", text, add_point);
    case 'q': return report_list(state, "percentiles", text, add_percentile);
    case KEY_LAW: a->law = text; return 0;
    case KEY_CSV: a->is_csv = true; return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case KEY_SIMULTANEOUS: a->is_together = true; return 0;
    case ARGP_KEY_ARG:
        if (a->path) {
            argp_error(state, "one results file is wanted, not also %s", text);
            return EINVAL;
        }
        a->path = text;
        return 0;
    case ARGP_KEY_END:
        if (!a->path) {
            argp_error(state, "which results file? (NAME.h5, as `floewear run` writes it)");
            return EINVAL;
        }
        if (a->is_csv && a->is_json) {
            argp_error(state, "--csv or --json, not both");
            return EINVAL;
        }
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static fw_status find_law(const fw_campaign *c, const char *name, size_t *law, fw_msg *m)
{
    char known[256] = "";
    *law = 0;
    if (!name) return FW_OK;
    for (size_t i = 0; i < c->model.n_laws; i++) {
        if (strcmp(c->model.laws[i].name, name) == 0) {
            *law = i;
            return FW_OK;
        }
        size_t at = strlen(known);
        snprintf(known + at, sizeof known - at, "%s%s", i ? ", " : "", c->model.laws[i].name);
    }
    return fw_fail(m, FW_E_INPUT, "--law %s: the campaign has no such abrasion law; it has %s", name, known);
}

static fw_status report_campaign(const report_arguments *a, const fw_campaign *c, fw_results *r, fw_msg *m)
{
    fw_answer_source  source = {.records = fw_results_records(r), .law = fw_campaign_law(c)};
    fw_answer_options o = {
        .n_percentiles = a->n_percentiles, .percentiles = a->percentiles, .n_points = a->n_points, .points = a->points};
    fw_answer   answer;
    fw_measured measured;
    fw_effects_ledger effects;
    FW_TRY(fw_results_input_measured(r, c, &measured, &effects, m));
    o.measured = &measured, o.effects = &effects;
    FW_TRY(find_law(c, a->law, &o.law, m));
    FW_TRY(fw_answer_make(&answer, c, &source, &o, m));
    if (a->is_json) {
        fw_report_print_json(stdout, c, &answer);
    } else if (a->is_csv) {
        fw_report_print_csv(stdout, c, &answer);
    } else if (a->is_together) {
        fw_report_print_simultaneous(stdout, c, &answer);
    } else {
        fw_report_print_table(stdout, c, &answer);
    }
    fw_answer_free(&answer);
    return fw_output_finish(m);
}

static fw_status report(const report_arguments *a, fw_msg *m)
{
    fw_results *r = NULL;
    fw_campaign c;
    FW_TRY(fw_results_open(&r, a->path, m));
    fw_status s = fw_results_input_campaign(r, a->path, &c, m);
    if (s == FW_OK) {
        s = report_campaign(a, &c, r, m);
        fw_campaign_free(&c);
    }
    fw_results_close(r);
    return s;
}

int fw_cmd_report(int argc, char **argv)
{
    const struct argp argp = {
        .options = report_options, .parser = report_parse, .args_doc = "RESULTS.h5", .doc = report_doc};
    report_arguments a = {0};
    fw_msg           m = {.text = ""};
    fw_status        s = FW_E_INPUT;
    argp_err_exit_status = fw_status_exit_code(FW_E_INPUT);
    if (argp_parse(&argp, argc, argv, 0, NULL, &a) == 0) s = report(&a, &m);
    if (m.text[0] && s != FW_OK) fprintf(stderr, "floewear report: %s\n", m.text);
    free(a.points);
    free(a.percentiles);
    return fw_status_exit_code(s);
}
