#include "validation/hard_sheet.h"

#include <math.h>
#include <string.h>

static const hard_run *base(const hard_row *r) { return &r->c.runs[HARD_BASE]; }

static double n_floes(const hard_row *r) { return hard_is_window(r->c.scene) ? base(r)->record.floes_touched : (double)base(r)->n; }
static double accuracy(const hard_row *r) { return r->c.accuracy; }
static double depth_change(const hard_row *r)
{
    const hard_run *f = &r->c.runs[HARD_FINE];
    return f->is_made && f->depth > 0 ? fabs(base(r)->depth / f->depth - 1) : NAN;
}
static double n_held(const hard_row *r)
{
    double n = 0;
    for (int k = 0; k < HARD_N_LAWS; k++) n += r->state[k] == HARD_HELD;
    return n;
}
static double n_asked(const hard_row *r)
{
    double n = 0;
    for (int k = 0; k < HARD_N_LAWS; k++) n += r->state[k] != HARD_NOT_ASKED;
    return n;
}

/* A column is one line: key in the JSON, heading, format, and a number of fw_record or a function. */
typedef struct column {
    const char *key, *heading, *format;
    size_t      offset;
    double (*value)(const hard_row *);
} column;
#define OF_RECORD(name, heading, format) {#name, heading, format, offsetof(fw_record, name), NULL}
static const column COLUMNS[] = {
    {"floes", "floes", "%.0f", 0, n_floes},
    {"accuracy", "accuracy", "%g", 0, accuracy},
    OF_RECORD(max_overlap_share, "largest overlap over radius", "%.3f"),
    OF_RECORD(energy_relative, "energy books", "%.0e"),
    OF_RECORD(momentum_relative, "momentum books", "%.0e"),
    OF_RECORD(wear_conservation, "wear books", "%.0e"),
    OF_RECORD(energy_truncation, "energy balance", "%.1e"),
    OF_RECORD(tries, "tries", "%.0f"),
    OF_RECORD(refined_steps, "refined steps", "%.0f"),
    OF_RECORD(slip_chatter, "slip chatter", "%.1e"),
    OF_RECORD(late_touches, "late touches", "%.0f"),
    OF_RECORD(force_evaluations, "force evaluations", "%.0f"),
    OF_RECORD(steps, "steps", "%.0f"),
    {"depth_change", "depth, 1 % against 0.1 %", "%.1e", 0, depth_change},
    {"laws_asked", "laws", "%.0f", 0, n_asked},
    {"laws_held", "held", "%.0f", 0, n_held},
};
enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

static double value_of(const column *c, const hard_row *r)
{
    double v;
    if (c->value) return c->value(r);
    memcpy(&v, (const char *)&base(r)->record + c->offset, sizeof v);
    return v;
}

void hard_sheet_head(FILE *to)
{
    fprintf(to, "# Hard cases\n\nOutput of `build/tests/validation/validate_hard --all`: scenes and windows that are the hardest on a discrete-element engine, each with "
                "the laws it must obey, at accuracy 1 %%. What the laws say, and any that is not held, stands below. Tries: 2 where finer steps were taken from the start after a first failure.\n\n| scene | status");
    for (size_t i = 0; i < N_COLUMNS; i++) fprintf(to, " | %s", COLUMNS[i].heading);
    fprintf(to, " | not held |\n|---|---");
    for (size_t i = 0; i < N_COLUMNS; i++) fprintf(to, "|---");
    fprintf(to, "|---|\n");
}

void hard_sheet_row(FILE *to, const hard_row *r)
{
    fprintf(to, "| %s | %s", r->c.scene->name, fw_status_name(base(r)->status));
    for (size_t i = 0; i < N_COLUMNS; i++) {
        double v = value_of(&COLUMNS[i], r);
        fputs(" | ", to);
        if (!isnan(v)) fprintf(to, COLUMNS[i].format, v);
    }
    fputs(" | ", to);
    for (int k = 0; k < HARD_N_LAWS; k++)
        if (r->state[k] == HARD_BROKEN) fprintf(to, "%s ", hard_law_keys[k]);
    fputs("|\n", to);
}

void hard_sheet_tail(FILE *to, size_t n, const hard_row *r)
{
    size_t n_broken = 0;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < HARD_N_LAWS; k++) {
            if (r[i].state[k] != HARD_BROKEN) continue;
            if (n_broken++ == 0) fprintf(to, "\n## Laws not held\n\n| scene | law | found | bound |\n|---|---|---|---|\n");
            fprintf(to, "| %s | %s | %.2e | %.0e |\n", r[i].c.scene->name, hard_law_keys[k], r[i].verdict[k].value, r[i].verdict[k].bound);
        }
    fprintf(to, "\n## What the laws say\n\n| law | | scenes | held | worst of the held over its bound |\n|---|---|---|---|---|\n");
    for (int k = 0; k < HARD_N_LAWS; k++) {
        int    asked = 0, held = 0;
        double worst = 0;
        for (size_t i = 0; i < n; i++) {
            if (r[i].state[k] == HARD_NOT_ASKED) continue;
            asked++;
            if (r[i].state[k] != HARD_HELD) continue;
            held++;
            if (r[i].verdict[k].bound > 0) worst = fmax(worst, r[i].verdict[k].value / r[i].verdict[k].bound);
        }
        fprintf(to, "| %s | %s | %d | %d | %.2g |\n", hard_law_keys[k], hard_law_texts[k], asked, held, worst);
    }
}

static void number(FILE *to, double v)
{
    if (isfinite(v))
        fprintf(to, "%.6g", v);
    else
        fputs("null", to);
}

void hard_sheet_json(FILE *to, size_t n, const hard_row *r)
{
    static const char *const STATE[] = {[HARD_HELD] = "held", [HARD_BROKEN] = "broken"};
    fprintf(to, "{\"scenes\": [\n");
    for (size_t i = 0; i < n; i++) {
        fprintf(to, "  {\"scene\": \"%s\", \"status\": \"%s\"", r[i].c.scene->name, fw_status_name(base(&r[i])->status));
        for (size_t q = 0; q < N_COLUMNS; q++) {
            fprintf(to, ", \"%s\": ", COLUMNS[q].key);
            number(to, value_of(&COLUMNS[q], &r[i]));
        }
        fprintf(to, ", \"laws\": {");
        const char *comma = "";
        for (int k = 0; k < HARD_N_LAWS; k++) {
            if (r[i].state[k] == HARD_NOT_ASKED) continue;
            fprintf(to, "%s\"%s\": {\"state\": \"%s\", \"value\": ", comma, hard_law_keys[k], STATE[r[i].state[k]]);
            number(to, r[i].verdict[k].value);
            fprintf(to, ", \"bound\": ");
            number(to, r[i].verdict[k].bound);
            fputs("}", to);
            comma = ", ";
        }
        fprintf(to, "}}%s\n", i + 1 < n ? "," : "");
    }
    fprintf(to, "]}\n");
}
