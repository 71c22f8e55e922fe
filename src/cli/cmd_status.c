/* floewear status JOURNAL: progress of a running or stopped campaign, from outside. It reads the journal beside a run
 * that appends to it, takes no lock and changes nothing. */
#include <argp.h>
#include <inttypes.h>
#include <stdio.h>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/output.h"
#include "store/journal.h"

typedef struct arguments {
    const char *journal;
    bool        is_json;
} arguments;

static const struct argp_option options[] = {
    {.name = "json", .key = 'j', .doc = "print JSON", .group = 0},
    {0},
};

static error_t parse(int key, char *word, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 'j': a->is_json = true; return 0;
    case ARGP_KEY_ARG:
        if (a->journal != NULL) argp_error(state, "one journal, not more: '%s' is too much", word);
        a->journal = word;
        return 0;
    case ARGP_KEY_END:
        if (a->journal == NULL) argp_error(state, "a journal is wanted: NAME.journal");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp parser = {
    .options = options,
    .parser = parse,
    .args_doc = "JOURNAL",
    .doc = "Progress of a running or stopped campaign, from outside. JOURNAL is the NAME.journal that `floewear run` "
           "writes.",
};

/* A run can also end well before max_realisations, by its precision; the journal alone cannot tell that from a stop. */
static const char *state_of(const fw_journal_facts *f)
{
    if (f->is_running) return "running";
    return f->max_realisations > 0 && f->prefix >= f->max_realisations ? "complete" : "stopped";
}

static void print_json(const fw_journal_facts *f)
{
    char hash[20];
    snprintf(hash, sizeof hash, "%016" PRIx64, f->hash);
    fw_json j = fw_json_onto(stdout);
    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", f->name);
    fw_json_put_string(&j, "state", state_of(f));
    fw_json_put_bool(&j, "running", f->is_running);
    fw_json_put_integer(&j, "done", (int64_t)f->n_done);
    fw_json_put_integer(&j, "failed", (int64_t)f->n_failed);
    fw_json_put_integer(&j, "prefix", (int64_t)f->prefix);
    fw_json_put_integer(&j, "first_id", (int64_t)f->first);
    fw_json_key(&j, "max_realisations");
    if (f->max_realisations > 0)
        fw_json_integer(&j, (int64_t)f->max_realisations);
    else
        fw_json_null(&j);
    fw_json_put_integer(&j, "seed", (int64_t)f->seed);
    fw_json_put_string(&j, "settings_hash", hash);
    fw_json_put_integer(&j, "n_arcs", (int64_t)f->n_arcs);
    fw_json_put_integer(&j, "n_laws", (int64_t)f->n_laws);
    fw_json_put_integer(&j, "torn_bytes", (int64_t)f->torn_bytes);
    fw_json_put_number(&j, "host_cpu_s", f->host_cpu_s);
    fw_json_end(&j);
}

static void print_table(const fw_journal_facts *f)
{
    printf("campaign      %s (seed %" PRIu64 ", settings %016" PRIx64 ")\n", f->name, f->seed, f->hash);
    printf("state         %s\n", state_of(f));
    printf("done          %" PRIu64, f->n_done);
    if (f->max_realisations > 0) {
        printf(" of at most %" PRIu64 " (%.1f %%)", f->max_realisations,
               100.0 * (double)f->n_done / (double)f->max_realisations);
    }
    printf(", %" PRIu64 " failed\n", f->n_failed);
    if (f->first == 0)
        printf("without gaps  the first %" PRIu64 " (what results are made from)\n", f->prefix);
    else
        printf("a part        of realisations %" PRIu64 " to %" PRIu64 "\n", f->first, f->end - 1);
    if (f->n_done > 0) {
        printf("CPU time      %.1f s, %.3g s per realisation\n", f->host_cpu_s, f->host_cpu_s / (double)f->n_done);
    }
    if (f->torn_bytes > 0) {
        printf("torn tail     %" PRIu64 " bytes (%s)\n", f->torn_bytes,
               f->is_running ? "a commit is under way" : "dropped when the campaign goes on");
    }
}

int fw_cmd_status(int argc, char **argv)
{
    arguments        a = {.journal = NULL};
    fw_journal_facts f;
    fw_msg           m = {.text = ""};
    argp_parse(&parser, argc, argv, 0, NULL, &a);
    fw_status status = fw_journal_facts_of(a.journal, &f, &m);
    if (status != FW_OK) {
        fprintf(stderr, "floewear status: %s\n", m.text);
        return fw_status_exit_code(status);
    }
    if (a.is_json)
        print_json(&f);
    else
        print_table(&f);
    return fw_output_end("floewear status");
}
