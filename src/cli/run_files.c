#include "cli/run_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/results_input.h"

/* "results/a.h5" and "results/a" both mean results/a.journal and results/a.h5. */
static fw_status files_name(fw_run_files *f, const char *out, fw_msg *m)
{
    size_t n = strlen(out), room = sizeof f->journal_path - sizeof ".journal";

    FW_CHECK(n > 0, m, FW_E_INPUT, "-o: an output name is wanted");
    if (n > 3 && strcmp(out + n - 3, ".h5") == 0) n -= 3;
    FW_CHECK(n > 0 && out[n - 1] != '/', m, FW_E_INPUT, "-o %s: a file name is wanted, not a folder", out);
    FW_CHECK(n < room, m, FW_E_INPUT, "-o: the output name is longer than %zu characters", room - 1);
    snprintf(f->journal_path, sizeof f->journal_path, "%.*s.journal", (int)n, out);
    snprintf(f->results_path, sizeof f->results_path, "%.*s.h5", (int)n, out);
    return FW_OK;
}

static fw_status files_check_folder(const char *path, fw_msg *m)
{
    char        folder[4096];
    const char *end = strrchr(path, '/');
    struct stat s;

    if (!end) return FW_OK;
    snprintf(folder, sizeof folder, "%.*s", end == path ? 1 : (int)(end - path), path);
    FW_CHECK(stat(folder, &s) == 0, m, FW_E_IO, "-o: the folder %s cannot be used: %s", folder, strerror(errno));
    FW_CHECK(S_ISDIR(s.st_mode), m, FW_E_IO, "-o: %s is not a folder", folder);
    return FW_OK;
}

/* A results file that is there already will be replaced at the end: make sure now that this loses nothing. */
static fw_status files_check_results(const fw_run_files *f, bool is_fresh, fw_msg *m)
{
    struct stat        s;
    fw_results        *r = NULL;
    fw_campaign        old;
    fw_msg             why    = {.text = ""};
    fw_status          status;
    bool               is_same;

    if (stat(f->results_path, &s) != 0) return FW_OK;
    status = fw_results_open(&r, f->results_path, m);
    if (status == FW_E_MISMATCH && is_fresh) return FW_OK; /* ours, of another version */
    FW_CHECK(status != FW_E_MISMATCH, m, FW_E_MISMATCH,
             "%s holds results of another version of floewear; choose another name with -o, or --fresh to replace it", f->results_path);
    if (status != FW_OK) {
        fw_msg_prefix(m, "will not replace a file that is no results file of ours: ");
        return status;
    }
    if (is_fresh || stat(f->journal_path, &s) == 0) { /* a journal that fits is what the results file was made from */
        fw_results_close(r);
        return FW_OK;
    }
    status  = fw_results_input_campaign(r, f->results_path, &old, &why);
    is_same = status == FW_OK && old.hash == f->campaign->hash;
    if (status == FW_OK) fw_campaign_free(&old);
    fw_results_close(r);
    FW_CHECK(status != FW_E_NOMEM, m, FW_E_NOMEM, "%s", why.text);
    FW_CHECK(is_same, m, FW_E_MISMATCH,
             "%s holds the results of another campaign; choose another name with -o, or --fresh to replace it",
             f->results_path);
    return FW_OK;
}

/* What the journal holds: it may append while the campaign goes on, so ids are copied. Failed ones are left out when they are to run again. */
static fw_status files_index(fw_run_files *f, bool runs_failed_again, fw_msg *m)
{
    const fw_model *model = &f->campaign->model;
    size_t          n;
    const uint64_t *ids   = fw_journal_ids(f->journal, &n);
    fw_record       r     = {.id = 0};
    fw_status       s;

    FW_TRY(fw_alloc(&f->have, n, sizeof *f->have, "ids of the journal", m));
    s = fw_record_init(&r, model->n_arcs, model->n_laws, m);
    for (size_t i = 0; i < n && s == FW_OK; i++) {
        s = fw_journal_read(f->journal, ids[i], &r, m);
        if (s != FW_OK || (r.status != FW_OK && runs_failed_again)) continue;
        f->have[f->n_have++] = ids[i];
        if (r.status == FW_OK) continue;
        s = fw_grow(&f->have_failed, &f->failed_capacity, f->n_have_failed + 1, sizeof *f->have_failed, "failed ids",
                    m);
        if (s == FW_OK) f->have_failed[f->n_have_failed++] = r.id;
    }
    fw_record_free(&r);
    return s;
}

fw_status fw_run_files_open(fw_run_files *f, const fw_campaign *c, const char *out, bool is_fresh, bool runs_failed_again,
                            uint64_t first_id, fw_msg *m)
{
    *f = (fw_run_files){.campaign = c};
    FW_TRY(files_name(f, out ? out : c->name, m));
    FW_TRY(files_check_folder(f->journal_path, m));
    FW_TRY(files_check_results(f, is_fresh, m));
    FW_TRY(fw_journal_open(&f->journal, f->journal_path, c, is_fresh, m));
    FW_TRY(files_index(f, runs_failed_again, m));
    size_t          n;
    const uint64_t *ids = fw_journal_ids(f->journal, &n);
    while (f->n_before < n && ids[f->n_before] < first_id) f->n_before++;
    return FW_OK;
}

fw_status fw_run_files_close(fw_run_files *f, fw_msg *m)
{
    fw_status s = fw_journal_close(f->journal, m);

    free(f->have);
    free(f->have_failed);
    memset(f, 0, sizeof *f);
    return s;
}

static fw_status files_append(void *self, const fw_record *r, fw_msg *m)
{
    return fw_journal_append(((fw_run_files *)self)->journal, r, m);
}

static fw_status files_flush(void *self, fw_msg *m)
{
    return fw_journal_flush(((fw_run_files *)self)->journal, m);
}

/* Found anew each time: the journal may have appended since. A part's journal gets no further ids below its first one. */
static fw_status files_read(void *self, uint64_t index, fw_record *r, fw_msg *m)
{
    fw_run_files   *f = self;
    size_t          n;
    const uint64_t *ids = fw_journal_ids(f->journal, &n);

    FW_CHECK(index < n - f->n_before, m, FW_E_ARG, "%s: no record number %llu", f->journal_path, (unsigned long long)index);
    return fw_journal_read(f->journal, ids[f->n_before + index], r, m);
}

fw_sink fw_run_files_sink(fw_run_files *f)
{
    return (fw_sink){.append = files_append, .flush = files_flush, .self = f};
}

static fw_id_span files_span(const uint64_t *ids, uint64_t n)
{
    fw_id_span s = {.first = ids[0], .end = ids[n - 1] + 1};

    if (s.end - s.first == n) return s; /* no gap to look for */
    for (uint64_t i = 1; i < n; i++) {
        if (ids[i] == ids[i - 1] + 1) continue;
        s.gap_first = ids[i - 1] + 1;
        s.gap_end   = ids[i];
        break;
    }
    return s;
}

fw_record_source fw_run_files_records(fw_run_files *f, uint64_t n)
{
    size_t           n_ids;
    const uint64_t  *ids = fw_journal_ids(f->journal, &n_ids);
    fw_record_source s   = {.n = n, .read = files_read, .self = f};

    if (n > 0 && n <= n_ids - f->n_before) s.span = files_span(ids + f->n_before, n);
    return s;
}

fw_answer_source fw_run_files_answer(fw_run_files *f, uint64_t n)
{
    return (fw_answer_source){.records = fw_run_files_records(f, n), .law = fw_campaign_law(f->campaign)};
}
