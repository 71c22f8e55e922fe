#include "mpi/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mpi/job.h"
#include "store/results.h"

static bool compare_records(fw_results *const *files, const char *const *paths, uint64_t n, size_t n_arcs,
                            size_t n_laws)
{
    size_t         n_bytes  = fw_record_packed_size(n_arcs, n_laws);
    unsigned char *bytes[2] = {malloc(n_bytes), malloc(n_bytes)};
    fw_record      r        = {.id = 0};
    bool           is_same  = bytes[0] && bytes[1] && fw_record_init(&r, n_arcs, n_laws, NULL) == FW_OK;

    for (uint64_t id = 0; is_same && id < n; id++) {
        for (int k = 0; k < 2; k++) {
            fw_record_source source = fw_results_records(files[k]);
            fw_msg           m      = {.text = ""};

            if (source.n != n || source.read(source.self, id, &r, &m) != FW_OK || r.id != id) {
                fprintf(stderr, "%s: %llu records, wanted %llu; id %llu: %s\n", paths[k], (unsigned long long)source.n,
                        (unsigned long long)n, (unsigned long long)id, m.text);
                is_same = false;
                break;
            }
            r.host_cpu_s = 0.0;
            fw_record_pack(&r, bytes[k]);
        }
        if (is_same && memcmp(bytes[0], bytes[1], n_bytes) != 0) {
            fprintf(stderr, "%s and %s: record %llu differs\n", paths[0], paths[1], (unsigned long long)id);
            is_same = false;
        }
    }
    fw_record_free(&r);
    free(bytes[0]);
    free(bytes[1]);
    return is_same;
}

bool fw_compare_results(const char *path_a, const char *path_b, uint64_t n, size_t n_arcs, size_t n_laws)
{
    const char *paths[2] = {path_a, path_b};
    fw_results *files[2] = {NULL, NULL};
    fw_msg      m        = {.text = ""};
    bool        is_same  = fw_results_open(&files[0], path_a, &m) == FW_OK &&
                   fw_results_open(&files[1], path_b, &m) == FW_OK;

    if (is_same) {
        is_same = compare_records(files, paths, n, n_arcs, n_laws);
    } else {
        fprintf(stderr, "%s\n", m.text);
    }
    if (files[0]) fw_results_close(files[0]);
    if (files[1]) fw_results_close(files[1]);
    return is_same;
}

/* Blank the value behind every `cpu...":` */
static void blank_cpu(char *text)
{
    for (char *key = strstr(text, "cpu"); key; key = strstr(key + 1, "cpu")) {
        char *at = strchr(key, ':');

        if (!at || at > key + 16) continue;
        for (at++; *at && *at != ',' && *at != '}' && *at != '\n'; at++) *at = ' ';
    }
}

/* Spaces say nothing: a blanked value may have been longer in one text than in the other. */
static void squeeze(char *text)
{
    char *to = text;

    for (; *text; text++) {
        if (*text != ' ') *to++ = *text;
    }
    *to = '\0';
}

bool fw_compare_json(const char *path_a, const char *path_b)
{
    char *text[2] = {fw_job_read(path_a, NULL), fw_job_read(path_b, NULL)};
    bool  is_same = text[0] && text[1] && text[0][0];

    for (int k = 0; k < 2 && is_same; k++) {
        blank_cpu(text[k]);
        squeeze(text[k]);
    }
    is_same = is_same && strcmp(text[0], text[1]) == 0;
    if (!is_same) fprintf(stderr, "%s and %s differ\n", path_a, path_b);
    free(text[0]);
    free(text[1]);
    return is_same;
}
