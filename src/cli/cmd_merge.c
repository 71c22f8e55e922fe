/* floewear merge: campaigns run apart become one, as if it had been run in one place.
 *
 *   A.h5, B.h5, ... --in order of id--> OUT.journal --answers from all of it--> OUT.h5, table or JSON
 *
 * The journal comes first and is a campaign's truth as after any run: `floewear run CAMPAIGN -o OUT` goes on from it, and so does a merge that was
 * stopped, when it is started again. Records go through one at a time; of every file only the ids are in memory. */
#include <argp.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/campaign_arguments.h"
#include "cli/choice.h"
#include "cli/commands.h"
#include "cli/results_input.h"
#include "cli/run_answer.h"

typedef struct merge_arguments {
    const char **paths; /* (n_paths) */
    size_t       n_paths, paths_capacity;
    const char  *out;
    bool         is_fresh, is_quiet, is_json;
} merge_arguments;

enum { KEY_FRESH = 256, KEY_JSON };

static const struct argp_option merge_options[] = {
    {"output", 'o', "OUT", 0, "write OUT.journal and OUT.h5", 0},
    {"fresh", KEY_FRESH, NULL, 0, "start anew where OUT is there already; an old journal is kept as OUT.journal.old", 0},
    {"quiet", 'q', NULL, 0, "nothing on stderr but what is missing or wrong", 0},
    {"json", KEY_JSON, NULL, 0, "results as JSON instead of tables", 0},
    {0}};

static const char merge_doc[] =
    "Join the results of a campaign that was run in parts (`floewear run --ids`), each realisation in one of them. OUT.journal and OUT.h5 are what "
    "one run of all of them leaves; `floewear run CAMPAIGN.yaml -o OUT` goes on from there.\vExit codes: 0 done, 2 wrong input (a realisation "
    "that is in two files), 3 no realisation succeeded, 4 input or output error, or files of different campaigns.";

static error_t merge_parse(int key, char *text, struct argp_state *state)
{
    merge_arguments *a = state->input;
    fw_msg           m = {.text = ""};
    switch (key) {
    case 'o': a->out = text; return 0;
    case 'q': a->is_quiet = true; return 0;
    case KEY_FRESH: a->is_fresh = true; return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case ARGP_KEY_ARG:
        if (fw_grow(&a->paths, &a->paths_capacity, a->n_paths + 1, sizeof *a->paths, "results files", &m) != FW_OK)
            return fw_argument_no_memory(state, &m);
        a->paths[a->n_paths++] = text;
        return 0;
    case ARGP_KEY_END:
        if (a->n_paths == 0) {
            argp_error(state, "which results files? (NAME.h5, as `floewear run` writes them)");
            return EINVAL;
        }
        if (!a->out) {
            argp_error(state, "-o OUT is wanted: where the merged results go");
            return EINVAL;
        }
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- the parts -------------------------------------------------------------------------------------------------- */

typedef struct part {
    const char      *path;
    fw_results      *results;
    fw_record_source records;
    uint64_t        *ids;  /* (records.n) */
    uint64_t         next; /* index of the next one to be taken */
} part;

typedef struct merge {
    size_t            n_parts;
    part             *parts;
    fw_campaign       campaign; /* of the first part */
    fw_measured       measured;
    fw_effects_ledger effects;
    fw_run_files      files;
} merge;

static fw_status part_open(part *p, const char *path, const part *first, fw_msg *m)
{
    char key[64];
    p->path = path;
    FW_TRY(fw_results_open(&p->results, path, m));
    p->records = fw_results_records(p->results);
    if (p != first) {
        const char *ours = fw_results_settings(first->results), *theirs = fw_results_settings(p->results);
        fw_choice_first_difference(theirs, ours, key, sizeof key);
        FW_CHECK(strcmp(ours, theirs) == 0, m, FW_E_MISMATCH, "%s and %s are of different campaigns (%s differs): they cannot be merged", first->path,
                 path, key);
    }
    FW_TRY(fw_alloc(&p->ids, (size_t)p->records.n, sizeof *p->ids, "ids of a results file", m));
    return fw_results_ids(p->results, p->ids, m);
}

/* The part whose next id is the smallest; NULL: all are taken. */
static part *next_part(const merge *g)
{
    part *least = NULL;
    for (size_t i = 0; i < g->n_parts; i++) {
        part *p = &g->parts[i];
        if (p->next < p->records.n && (!least || p->ids[p->next] < least->ids[least->next])) least = p;
    }
    return least;
}

/* All of it before anything is written. */
static fw_status check_disjoint(merge *g, fw_msg *m)
{
    const part *before = NULL;
    uint64_t    last = 0;
    for (part *p = next_part(g); p; p = next_part(g)) {
        uint64_t id = p->ids[p->next++];
        FW_CHECK(!before || id != last, m, FW_E_INPUT, "realisation %" PRIu64 " is in both %s and %s: parts must have no realisation in common", id,
                 before->path, p->path);
        before = p;
        last = id;
    }
    for (size_t i = 0; i < g->n_parts; i++) g->parts[i].next = 0;
    return FW_OK;
}

/* The results that will be written must not replace what they are made from. */
static fw_status check_output(const merge *g, const char *out, fw_msg *m)
{
    char        path[4096];
    struct stat ours, theirs;
    FW_TRY(fw_choice_path(path, sizeof path, out, FW_CHOICE_RESULTS, m));
    if (stat(path, &ours) != 0) return FW_OK;
    for (size_t i = 0; i < g->n_parts; i++) {
        FW_CHECK(stat(g->parts[i].path, &theirs) != 0 || ours.st_dev != theirs.st_dev || ours.st_ino != theirs.st_ino, m, FW_E_INPUT,
                 "-o %s: %s is one of the files to be merged; choose another name", out, g->parts[i].path);
    }
    return FW_OK;
}

static fw_status check_campaign(const merge *g, fw_msg *m)
{
    char        key[64];
    const char *theirs = fw_results_settings(g->parts[0].results);
    fw_choice_first_difference(theirs, g->campaign.settings, key, sizeof key);
    FW_CHECK(strcmp(theirs, g->campaign.settings) == 0, m, FW_E_MISMATCH,
             "%s holds results of another version of floewear (%s differs): this one would not go on with them", g->parts[0].path, key);
    return FW_OK;
}

static fw_status open_parts(merge *g, const merge_arguments *a, fw_msg *m)
{
    FW_TRY(fw_alloc(&g->parts, a->n_paths, sizeof *g->parts, "parts", m));
    for (size_t i = 0; i < a->n_paths; i++) {
        g->n_parts = i + 1;
        FW_TRY(part_open(&g->parts[i], a->paths[i], g->parts, m));
    }
    FW_TRY(check_output(g, a->out, m));
    FW_TRY(check_disjoint(g, m));
    FW_TRY(fw_results_input_campaign(g->parts[0].results, g->parts[0].path, &g->campaign, m));
    FW_TRY(check_campaign(g, m));
    return fw_results_input_measured(g->parts[0].results, &g->campaign, &g->measured, &g->effects, m);
}

static void close_parts(merge *g)
{
    for (size_t i = 0; i < g->n_parts; i++) {
        fw_results_close(g->parts[i].results);
        free(g->parts[i].ids);
    }
    free(g->parts);
    g->parts = NULL;
    g->n_parts = 0;
}

/* ---- joining them ----------------------------------------------------------------------------------------------- */

static fw_status fill_journal(merge *g, fw_msg *m)
{
    fw_sink   sink = fw_run_files_sink(&g->files);
    fw_record r;
    FW_TRY(fw_record_init(&r, g->campaign.model.n_arcs, g->campaign.model.n_laws, m));
    fw_status s = FW_OK;
    for (part *p = next_part(g); p && s == FW_OK; p = next_part(g)) {
        s = p->records.read(p->records.self, p->next++, &r, m);
        if (s == FW_OK) s = sink.append(sink.self, &r, m);
    }
    if (s == FW_OK) s = sink.flush(sink.self, m);
    fw_record_free(&r);
    return s;
}

static void say_parts(const merge *g)
{
    for (size_t i = 0; i < g->n_parts; i++) {
        const fw_record_source *s = &g->parts[i].records;
        fprintf(stderr, "%s: %" PRIu64 " realisations", g->parts[i].path, s->n);
        if (s->n) fprintf(stderr, ", %" PRIu64 " to %" PRIu64, s->span.first, s->span.end - 1);
        fputc('\n', stderr);
    }
}

/* Told in any case: a percentile of what is there says nothing of what is not. */
static void say_gaps(const fw_run_files *f)
{
    size_t          n, n_gaps = 0;
    const uint64_t *ids = fw_journal_ids(f->journal, &n);
    uint64_t        wanted = 0, n_missing = 0;
    for (size_t i = 0; i < n; wanted = ids[i++] + 1) {
        if (ids[i] == wanted) continue;
        n_missing += ids[i] - wanted;
        if (++n_gaps > 5) continue;
        fprintf(stderr, "missing: realisations %" PRIu64 " to %" PRIu64 "\n", wanted, ids[i] - 1);
    }
    if (n_gaps > 5) fprintf(stderr, "missing: %zu gaps more\n", n_gaps - 5);
    if (n_gaps) fprintf(stderr, "missing: %" PRIu64 " in all; floewear run CAMPAIGN.yaml with this -o computes them\n", n_missing);
}

static fw_status join_parts(merge *g, const merge_arguments *a, fw_msg *m)
{
    size_t n;
    FW_TRY(fw_run_files_open(&g->files, &g->campaign, a->out, a->is_fresh, false, 0, m));
    if (!a->is_quiet) say_parts(g);
    if (g->files.n_have && !a->is_quiet) fprintf(stderr, "%s: %zu realisations are there already\n", g->files.journal_path, g->files.n_have);
    FW_TRY(fill_journal(g, m));
    close_parts(g);
    fw_journal_ids(g->files.journal, &n);
    say_gaps(&g->files);
    FW_CHECK(n > 0, m, FW_E_INPUT, "no file has a realisation: nothing to merge");
    FW_TRY(fw_run_answer(&g->files, n, &g->measured, &g->effects, a->is_json, m));
    if (!a->is_quiet) fprintf(stderr, "%s: %zu realisations\n", g->files.results_path, n);
    return FW_OK;
}

static fw_status merge_all(const merge_arguments *a, fw_msg *m)
{
    merge     g;
    fw_msg    later = {.text = ""};
    fw_status s, closed;
    memset(&g, 0, sizeof g);
    s = open_parts(&g, a, m);
    if (s == FW_OK) s = join_parts(&g, a, m);
    closed = fw_run_files_close(&g.files, &later);
    if (closed != FW_OK && s == FW_OK) {
        s = closed;
        *m = later;
    }
    close_parts(&g);
    fw_campaign_free(&g.campaign);
    return s;
}

int fw_cmd_merge(int argc, char **argv)
{
    const struct argp argp = {.options = merge_options, .parser = merge_parse, .args_doc = "RESULTS.h5...", .doc = merge_doc};
    merge_arguments   a = {0};
    fw_msg            m = {.text = ""};
    fw_status         s = FW_E_INPUT;
    if (argp_parse(&argp, argc, argv, 0, NULL, &a) == 0) s = merge_all(&a, &m);
    if (m.text[0] && s != FW_OK) fprintf(stderr, "floewear merge: %s\n", m.text);
    free(a.paths);
    return fw_status_exit_code(s);
}
