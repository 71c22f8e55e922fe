/* From measured rows to the numbers that a run takes, and to the ledger's amounts. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/accuracy_inside.h"

const char *fw_accuracy_group_name(fw_accuracy_group g)
{
    static const char *const NAMES[] = {"step", "ring", "strip width", "downstream", "warm-up", "window"};
    return NAMES[g];
}

/* The rows that a campaign may choose from: what its users get, at any level but the reference. */
static bool is_candidate(const fw_accuracy_row *row)
{
    return row->group == FW_ACCURACY_STEP && !row->is_reference && row->numerics.scheme == FW_SCHEME_EVENTS &&
           row->numerics.wear_rule == FW_WEAR_HERMITE;
}

/* Largest of: mean error of coupled windows with twice its standard error, the worst single hit, the energy balance (which has
 * to be within the accuracy as well). Without coupled windows the last two are all there is. */
static double total_error(const fw_accuracy_row *row)
{
    double truth = fmax(row->hit_error, row->truncation);
    return row->coupled.n > 1 ? fmax(truth, fabs(row->coupled.mean) + 2 * row->coupled.error)
                              : row->hit_error + row->truncation;
}

void fw_accuracy_choose_step(fw_accuracy_run *r)
{
    fw_accuracy_row *best = NULL, *finest = NULL;
    double           accuracy = r->c->model.accuracy;
    for (size_t i = 0; i < r->out->n_rows; i++) {
        fw_accuracy_row *row = &r->out->rows[i];
        if (!is_candidate(row)) continue;
        if (!finest || total_error(row) < total_error(finest)) finest = row;
        if (total_error(row) <= accuracy && (!best || row->evaluations < best->evaluations)) best = row;
    }
    fw_accuracy_choice *choice = &r->out->choice;
    *choice = (fw_accuracy_choice){.strip_width = -1, .downstream = -1, .warm_up = -1, .is_within = best != NULL};
    if (!best) best = finest; /* there always is one: the built-in row */
    best->is_chosen = true;
    choice->numerics = best->numerics;
    choice->error = total_error(best);
    const char *what = best->coupled.n > 1 ? "coupled windows, single hits and energy balance"
                                           : "single hits and energy balance, as no windows stay coupled";
    if (choice->is_within)
        snprintf(choice->why, sizeof choice->why, "fewest force evaluations within %g %%: %.2g %% by %s",
                 100 * accuracy, 100 * choice->error, what);
    else
        snprintf(choice->why, sizeof choice->why,
                 "nothing that was tried is within %g %%; this comes nearest: %.2g %% by %s", 100 * accuracy,
                 100 * choice->error, what);
}

static fw_accuracy_row *default_row(const fw_accuracy_run *r, fw_accuracy_group g)
{
    for (size_t i = 0; i < r->out->n_rows; i++)
        if (r->out->rows[i].group == g && r->out->rows[i].is_default) return &r->out->rows[i];
    return NULL;
}

/* A warm-up enters once in a window, however long that is: what was seen in the study's short windows shrinks with their share. */
static double in_the_campaign(const fw_accuracy_run *r, const fw_accuracy_row *row)
{
    return row->group == FW_ACCURACY_WARM_UP ? fmin(1, r->out->mean_window_s / r->c->model.window) : 1;
}

/* Did the campaign leave this to us? What its file names is its own, and is only remarked upon. */
static bool is_left_open(const fw_model *m, fw_accuracy_group g)
{
    switch (g) {
    case FW_ACCURACY_RING: {
        fw_model usual;
        fw_model_defaults(&usual);
        return m->n_arcs == usual.n_arcs;
    }
    case FW_ACCURACY_STRIP: return !(m->strip_width > 0);
    case FW_ACCURACY_DOWNSTREAM: return !(m->downstream > 0);
    default: return m->warm_up < 0;
    }
}

static void take(fw_accuracy_run *r, fw_accuracy_row *row)
{
    fw_accuracy_choice *choice = &r->out->choice;
    row->is_chosen = true;
    if (row->group == FW_ACCURACY_RING) choice->n_arcs = (size_t)row->level;
    if (row->group == FW_ACCURACY_STRIP) choice->strip_width = row->level;
    if (row->group == FW_ACCURACY_DOWNSTREAM) choice->downstream = row->level;
    if (row->group == FW_ACCURACY_WARM_UP) choice->warm_up = row->level / r->out->mean_speed;
}

/* A wider setting than the default is taken only when that is shown to be off by more than the accuracy: three standard errors
 * beyond it, from at least six windows (with four, a standard error is itself good to 40 % only). What lies within the scatter of a
 * few windows is no reason to change a campaign. */
void fw_accuracy_choose_domain(fw_accuracy_run *r)
{
    double accuracy = r->c->model.accuracy;
    for (int g = FW_ACCURACY_RING; g <= FW_ACCURACY_WARM_UP; g++) {
        fw_accuracy_row *row = default_row(r, (fw_accuracy_group)g), *end = r->out->rows + r->out->n_rows;
        if (!row) continue;
        double share = in_the_campaign(r, row);
        row->is_chosen = true;
        if (row->depth.n < 6 || !((fabs(row->depth.mean) - 3 * row->depth.error) * share > accuracy)) continue;
        if (!is_left_open(&r->c->model, row->group)) {
            snprintf(row->words, sizeof row->words, "off by more than the accuracy; the campaign's own, and left so");
            continue;
        }
        for (fw_accuracy_row *wider = row + 1; wider + 1 < end && wider[1].group == row->group; wider++) {
            bool is_last = wider[1].is_reference; /* the widest whose error is known */
            if (fabs(wider->depth.mean) * share > accuracy && !is_last) continue;
            row->is_chosen = false;
            take(r, wider);
            break;
        }
    }
}

/* ---- the ledger's rows ------------------------------------------------------------------------------------------ */

#define SAY(field, ...) snprintf((field), sizeof(field), __VA_ARGS__)

/* Cost of half the error: along the chosen method to the first finer level that has it, on a straight line in logarithms. */
static void measure_step(const fw_accuracy_run *r, const fw_accuracy_row *chosen, fw_measured_row *to)
{
    SAY(to->row, "discretisation");
    if (chosen->coupled.n > 1) {
        to->amount = fmax(fabs(chosen->coupled.mean), chosen->coupled.error), to->error = chosen->coupled.error;
    } else {
        to->amount = chosen->hit_error + chosen->truncation, to->error = NAN;
    }
    SAY(to->shrinks_with, "accuracy: (tolerance %.2g; energy balance %.2g)", chosen->level, chosen->truncation);
    SAY(to->halved_by, "no level that was tried");
    to->cost_factor = NAN;
    for (size_t i = 0; i < r->out->n_rows; i++) {
        const fw_accuracy_row *row = &r->out->rows[i];
        double                 ratio = chosen->coupled.rms / row->coupled.rms;
        if (row->group != FW_ACCURACY_STEP || strcmp(row->method, chosen->method) != 0 || !(ratio >= 2)) continue;
        double part = log(2) / log(ratio);
        to->cost_factor = pow(row->evaluations / chosen->evaluations, part);
        SAY(to->halved_by, "tolerance %.2g", chosen->level * pow(row->level / chosen->level, part));
        return;
    }
}

static void measure_domain(const fw_accuracy_run *r, const fw_accuracy_row *row, fw_measured_row *to)
{
    static const char *const KEYS[] = {"", "ring.arcs", "field.strip_width", "field.downstream", "exposure.warm_up"};
    const fw_accuracy_row   *end = r->out->rows + r->out->n_rows;
    double                   share = in_the_campaign(r, row);
    SAY(to->row, "%s", fw_accuracy_group_name(row->group));
    to->amount = share * (row->depth.n > 1 ? fmax(fabs(row->depth.mean), row->depth.error) : fabs(row->depth.mean));
    to->error = share * row->depth.error;
    to->cost_factor = NAN;
    bool is_noise = row->depth.n > 1 && fabs(row->depth.mean) < 2 * row->depth.error;
    SAY(to->shrinks_with, "%s (%s%s)", KEYS[row->group], row->setting,
        is_noise ? "; within the scatter of the study" : "");
    if (row->is_reference) to->amount = NAN;
    for (const fw_accuracy_row *wider = row + 1; wider < end && wider->group == row->group; wider++) {
        if (wider->is_reference || !(fabs(wider->depth.mean) <= 0.5 * fabs(row->depth.mean))) continue;
        to->cost_factor = fmax(1, wider->cpu_s / row->cpu_s);
        SAY(to->halved_by, "%s", wider->setting);
        return;
    }
    SAY(to->halved_by, "no level that was tried");
}

void fw_accuracy_measure(fw_accuracy_run *r)
{
    fw_measured *to = &r->out->measured;
    *to = (fw_measured){.is_own = true};
    SAY(to->origin, "on this campaign, %zu windows of %.3g and %.3g m of ice", r->n, r->out->sizes.way,
        r->out->sizes.domain_way);
    for (size_t i = 0; i < r->out->n_rows && to->n_rows < FW_MEASURED_ROWS; i++) {
        const fw_accuracy_row *row = &r->out->rows[i];
        if (!row->is_chosen) continue;
        if (row->group == FW_ACCURACY_STEP)
            measure_step(r, row, &to->rows[to->n_rows++]);
        else
            measure_domain(r, row, &to->rows[to->n_rows++]);
    }
}
