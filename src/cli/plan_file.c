/* NAME.plan.h5: written by `floewear plan`, read by `run`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/plan_design.h"
#include "cli/table_builder.h"

/* A row of /pilot. */
typedef struct pilot_row {
    double id, speed, concentration, mix, ring_load, force_evaluations, cpu_s;
} pilot_row;

static void fill_pilot(pilot_row *rows, size_t n, const fw_record *pilot)
{
    for (size_t i = 0; i < n; i++) {
        const fw_record *r = &pilot[i];
        rows[i] = (pilot_row){(double)r->id, r->speed, r->concentration, r->mix, fw_record_mean_load(r, 0), r->force_evaluations, r->host_cpu_s};
    }
}

static void build_pilot(fw_table_builder *b, size_t n, const pilot_row *rows, fw_msg *m)
{
    fw_table_start(b, "pilot", n, m);
    FW_TABLE_NUMBERS(b, rows, pilot_row, id, "1", "number of the realisation, by plain sampling");
    FW_TABLE_NUMBERS(b, rows, pilot_row, speed, "m s-1", "current speed");
    FW_TABLE_NUMBERS(b, rows, pilot_row, concentration, "1", "ice concentration");
    FW_TABLE_NUMBERS(b, rows, pilot_row, mix, "1", "index of the thickness mix");
    FW_TABLE_NUMBERS(b, rows, pilot_row, ring_load, "1", "mean wear load round the ring, first law, in the unit of wear_load");
    FW_TABLE_NUMBERS(b, rows, pilot_row, force_evaluations, "1", "contact force evaluations");
    FW_TABLE_NUMBERS(b, rows, pilot_row, cpu_s, "s", "processor time");
}

static void build_designs(fw_table_builder *b, const fw_outlook *x, fw_msg *m)
{
    fw_table_start(b, "designs", x->n_designs, m);
    const char **name = fw_table_texts(b, "design", "how scenarios are drawn");
    FW_TABLE_NUMBERS(b, x->design, fw_outlook_design, half_width, "1", "relative half-width after n_virtual realisations, of made-up campaigns");
    FW_TABLE_NUMBERS(b, x->design, fw_outlook_design, evaluations, "1", "force evaluations of a realisation");
    FW_TABLE_NUMBERS(b, x->design, fw_outlook_design, pays, "1", "plain sampling's cost for the same half-width over this one's");
    for (size_t i = 0; name && i < x->n_designs; i++) name[i] = x->design[i].name;
}

static const fw_sampling *chosen(const fw_outlook *x) { return &x->design[x->chosen].sampling; }

static void build_allocation(fw_table_builder *b, const fw_outlook *x, fw_msg *m)
{
    const fw_sampling *s = chosen(x);
    fw_table_start(b, "allocation", s->n_allocation, m);
    double *share = fw_table_number_column(b, "share", "1", "share of the realisations per stratum of speed, concentration and mix");
    for (size_t i = 0; share && i < s->n_allocation; i++) share[i] = s->allocation[i];
}

static const char *word_of(const fw_sampling *s)
{
    static const char *const words[] = {"plain", "stratified", "latin_hypercube", "sobol"};
    return words[s->design];
}

static void build_choice(fw_table_builder *b, const fw_outlook *x, fw_msg *m)
{
    fw_table_start(b, "choice", 1, m);
    const char **design = fw_table_texts(b, "design", "how scenarios are drawn"), **reason = fw_table_texts(b, "reason", "why");
    double      *n = fw_table_number_column(b, "randomisations", "1", "independent randomisations of the design");
    if (design) design[0] = word_of(chosen(x));
    if (reason) reason[0] = x->reason;
    if (n) n[0] = chosen(x)->n_randomisations;
}

static void build_forecast(fw_table_builder *b, const fw_outlook *x, const fw_plan_forecast *f, fw_msg *m)
{
    fw_table_start(b, "forecast", 1, m);
    double *n = fw_table_number_column(b, "realisations", "1", "realisations of the run"),
           *width = fw_table_number_column(b, "half_width", "1", "relative half-width that they reach"),
           *wanted = fw_table_number_column(b, "realisations_wanted", "1", "realisations that the precision wants; NaN: none asked, or not known"),
           *cpu = fw_table_number_column(b, "cpu_s", "s", "processor time of the run"),
           *made_up = fw_table_number_column(b, "n_virtual", "1", "realisations of a made-up campaign");
    if (n) n[0] = f->n;
    if (width) width[0] = f->half_width;
    if (wanted) wanted[0] = f->n_wanted;
    if (cpu) cpu[0] = f->cpu_s;
    if (made_up) made_up[0] = (double)x->n_virtual;
}

fw_status fw_plan_file_write(const char *path, const fw_campaign *bare, const fw_outlook *x, const fw_plan_forecast *f, size_t n, const fw_record *pilot,
                             fw_msg *m)
{
    enum { N = 5 };
    fw_table_builder b[N];
    fw_table         tables[N];
    pilot_row       *rows;
    FW_TRY(fw_alloc(&rows, n, sizeof *rows, "rows of the pilot", m));
    fill_pilot(rows, n, pilot);
    build_pilot(&b[0], n, rows, m);
    build_designs(&b[1], x, m);
    build_allocation(&b[2], x, m);
    build_choice(&b[3], x, m);
    build_forecast(&b[4], x, f, m);
    fw_status s = FW_OK;
    for (int i = 0; i < N; i++) {
        tables[i] = b[i].table;
        if (s == FW_OK) s = b[i].status;
    }
    if (s == FW_OK) s = fw_tables_write(path, FW_PLAN_FILETYPE, bare, N, tables, m);
    for (int i = 0; i < N; i++) fw_table_free(&b[i]);
    free(rows);
    return s;
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* Shares have four digits (study/outlook_allocate.c): the text is the number. */
static fw_status make_set(const char *design, double randomisations, size_t n, const double *shares, char **set, fw_msg *m)
{
    enum { ROOM = 128, ITEM = 24 };
    size_t size = ROOM + n * ITEM, at;
    FW_TRY(fw_alloc(set, size, 1, "a design", m));
    at = (size_t)snprintf(*set, size, "sampling={design: %.40s, randomisations: %.0f", design, randomisations);
    if (n) at += (size_t)snprintf(*set + at, size - at, ", allocation: [");
    for (size_t i = 0; i < n; i++) at += (size_t)snprintf(*set + at, size - at, "%s%.4g", i ? ", " : "", shares[i]);
    snprintf(*set + at, size - at, n ? "]}" : "}");
    return FW_OK;
}

fw_status fw_plan_file_read(const fw_tables *t, char **set, char *words, size_t size, fw_msg *m)
{
    char     *design = NULL, *reason = NULL;
    double   *randomisations = NULL, *shares = NULL;
    size_t    n = 0, n_reasons = 0, n_randomisations = 0, n_shares = 0, width;
    fw_status s = fw_tables_texts(t, "choice", "design", 1, &n, &width, &design, m);
    if (s == FW_OK) s = fw_tables_texts(t, "choice", "reason", 1, &n_reasons, &width, &reason, m);
    if (s == FW_OK) s = fw_tables_numbers(t, "choice", "randomisations", 1, &n_randomisations, &randomisations, m);
    if (s == FW_OK) s = fw_tables_numbers(t, "allocation", "share", FW_MAX_STRATA, &n_shares, &shares, m);
    if (s == FW_OK && !(n == 1 && n_reasons == 1 && n_randomisations == 1)) s = fw_fail(m, FW_E_FORMAT, "a plan without a choice");
    if (s == FW_OK) s = make_set(design, randomisations[0], n_shares, shares, set, m);
    if (s == FW_OK) snprintf(words, size, "%s: %s", design, reason);
    free(design);
    free(reason);
    free(randomisations);
    free(shares);
    return s;
}
