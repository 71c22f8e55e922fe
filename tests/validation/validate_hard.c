/* The hard cases, each with its laws. Prints a table; the committed stability.md and stability.json are the output of --all.
 *
 *   validate_hard [--all] [FOLDER]    --all: the long ones too; the sheets go to FOLDER; exit code 1 when a law is broken
 *   validate_hard --only PART         scenes with PART in their names, each law with its number */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "validation/hard_sheet.h"

static bool is_told; /* every law */

static void judge(hard_row *r, const hard_scene *s)
{
    hard_case *c = &r->c;
    hard_case_open(c, s);
    hard_case_run(c, HARD_BASE);
    if (!(s->laws & REFUSES) && !s->is_once && c->runs[HARD_BASE].depth > 0) hard_case_run(c, HARD_FINE); /* for its column, law or not */
    for (int k = 0; k < HARD_N_LAWS; k++) {
        uint64_t bit = (uint64_t)1 << k;
        if (!(hard_laws_of(s) & bit)) continue;
        hard_verdict v = r->verdict[k] = hard_law_judge(k, c);
        r->state[k] = hard_is_held(v) ? HARD_HELD : HARD_BROKEN;
        bench_expect(r->state[k] != HARD_BROKEN, "%s: %s: found %.3g, bound %.3g", s->name, hard_law_keys[k], v.value, v.bound);
        if (is_told) fprintf(stderr, "    %-15s %10.3g %10.3g\n", hard_law_keys[k], v.value, v.bound);
    }
    if (is_told) fprintf(stderr, "%s: %.2f s\n", s->name, c->cpu_s);
}

static FILE *open_in(const char *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        exit(1);
    }
    return f;
}

static void write_sheets(const char *folder, size_t n, const hard_row *r)
{
    FILE *md = open_in(folder, "stability.md"), *json = open_in(folder, "stability.json");
    hard_sheet_head(md);
    for (size_t i = 0; i < n; i++) hard_sheet_row(md, &r[i]);
    hard_sheet_tail(md, n, r);
    hard_sheet_json(json, n, r);
    bench_expect(fclose(md) == 0 && fclose(json) == 0, "sheets could be written");
}

int main(int argc, char **argv)
{
    bool        is_all = false;
    const char *folder = NULL, *only = NULL;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--all") == 0)
            is_all = true;
        else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc)
            only = argv[++i], is_told = is_all = true;
        else if (argv[i][0] != '-' && !folder)
            folder = argv[i];
        else {
            fprintf(stderr, "usage: validate_hard [--all | --only PART] [FOLDER]\n");
            return 2;
        }
    }
    hard_row *rows = calloc(hard_n_scenes, sizeof *rows);
    size_t    n = 0;
    double    cpu = 0;
    hard_sheet_head(stdout);
    for (size_t i = 0; rows && i < hard_n_scenes; i++) {
        const hard_scene *s = &hard_scenes[i];
        if ((s->is_long && !is_all) || (only && !strstr(s->name, only))) continue;
        judge(&rows[n], s);
        hard_sheet_row(stdout, &rows[n]);
        fflush(stdout);
        cpu += rows[n++].c.cpu_s;
    }
    hard_sheet_tail(stdout, n, rows);
    if (folder) write_sheets(folder, n, rows);
    fprintf(stderr, "%zu scenes, %.1f s of simulation\n", n, cpu);
    for (size_t i = 0; i < n; i++) hard_case_close(&rows[i].c);
    free(rows);
    return bench_end();
}
