/* Everything but the step: ring, strip, reach downstream, warm-up, and the length of a window. One at a time, at the step that
 * was chosen, against the widest level of its own group. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "realisation/accuracy.h"
#include "study/accuracy_inside.h"

/* Levels of a group; the last one is its reference. Beyond them: 1440 arcs of 16 mm are finer than any patch is wide, past 50 m
 * nothing comes back, and 200 m of strip is twice what the disturbance of a 40 % field reaches sideways. */
static const struct group {
    fw_accuracy_group group;
    const char       *unit;
    double            levels[8]; /* ascending; 0 ends, but for the first */
} GROUPS[] = {
    {FW_ACCURACY_RING, "arcs", {72, 180, 360, 720, 1440}},
    {FW_ACCURACY_STRIP, "m wide", {40, 60, 80, 100, 140, 200}},
    {FW_ACCURACY_DOWNSTREAM, "m downstream", {8, 12, 16, 20, 30, 50}},
    {FW_ACCURACY_WARM_UP, "m of ice before", {0, 30, 60, 120, 240}},
};
enum { MOST_LEVELS = 10 };

static double usual_level(const fw_accuracy_run *r, fw_accuracy_group g)
{
    switch (g) {
    case FW_ACCURACY_RING: return (double)r->model.n_arcs;
    case FW_ACCURACY_STRIP: return fw_accuracy_strip_width(&r->model);
    case FW_ACCURACY_DOWNSTREAM: return fw_accuracy_downstream(&r->model);
    default: return fw_accuracy_warm_up(&r->model, r->out->mean_speed) * r->out->mean_speed;
    }
}

/* The table's levels and the campaign's own, ascending. Returns their number and which one is the campaign's. */
static size_t levels_with(const struct group *g, double own, double *levels, size_t *usual)
{
    size_t n = 0;
    *usual = MOST_LEVELS;
    for (size_t k = 0; k < 8 && (k == 0 || g->levels[k] > 0); k++) {
        double next = g->levels[k];
        if (*usual == MOST_LEVELS && own < next * (1 - 1e-6)) *usual = n, levels[n++] = own;
        if (fabs(own - next) <= 1e-6 * next) *usual = n;
        levels[n++] = next;
    }
    if (*usual == MOST_LEVELS) *usual = n, levels[n++] = own;
    return n;
}

static void set_level(fw_accuracy_run *r, fw_model *model, fw_accuracy_group g, double level)
{
    switch (g) {
    case FW_ACCURACY_RING: model->n_arcs = (size_t)level; break;
    case FW_ACCURACY_STRIP: model->strip_width = level; break;
    case FW_ACCURACY_DOWNSTREAM: model->downstream = level; break;
    default:
        for (size_t i = 0; i < r->n; i++) r->windows[i].warm_up = level / r->windows[i].scenario.speed;
        break;
    }
}

/* Of the ring what matters is what the measuring points read. */
static fw_pairs compare_points(const fw_accuracy_run *r, const double *points)
{
    double scale[FW_ACCURACY_WINDOWS], weight[FW_ACCURACY_WINDOWS];
    for (size_t i = 0; i < r->n; i++) scale[i] = r->reference[i].depth, weight[i] = r->reference[i].hits;
    return fw_pairs_compare_points(r->n, r->c->points.n, points, r->points_reference, scale, weight);
}

static void say_in_words(const fw_accuracy_run *r, fw_accuracy_row *row)
{
    if (row->is_reference)
        snprintf(row->words, sizeof row->words, "what the others are compared with");
    else if (row->group == FW_ACCURACY_RING)
        fw_accuracy_say_ring(r, row, r->n, r->out->mean_window_s);
    else if (row->group == FW_ACCURACY_WARM_UP)
        snprintf(row->words, sizeof row->words, "once at a window's start: %.1g %% of the campaign's window",
                 100 * fabs(row->depth.mean) * r->out->mean_window_s / r->c->model.window);
    else if (row->depth.n > 1 && fabs(row->depth.mean) < 2 * row->depth.error)
        snprintf(row->words, sizeof row->words, "mean error within its scatter");
}

static fw_status run_group(fw_accuracy_run *r, const struct group *g, fw_msg *m)
{
    double levels[MOST_LEVELS];
    size_t usual, n = levels_with(g, usual_level(r, g->group), levels, &usual);
    for (size_t k = n; k-- > 0;) { /* from the reference downwards; rows are put in ascending order below */
        fw_model         model = r->model;
        fw_accuracy_row  row = {.group = g->group,
                                .numerics = r->model.numerics,
                                .level = levels[k],
                                .is_reference = k + 1 == n,
                                .is_default = k == usual,
                                .order = NAN,
                                .hit_error = NAN};
        fw_trial_sample *sample = k + 1 == n ? r->reference : r->sample;
        double          *points = k + 1 == n ? r->points_reference : r->points;
        snprintf(row.method, sizeof row.method, "%s", fw_accuracy_group_name(g->group));
        snprintf(row.setting, sizeof row.setting, "%.4g %s", levels[k], g->unit);
        FW_ACCURACY_SAY(r, "%s: %s", row.method, row.setting);
        if (k == usual) { /* all groups share this one */
            memcpy(sample, r->usual, r->n * sizeof *sample);
            memcpy(points, r->points_usual, r->n * r->c->points.n * sizeof *points);
        } else {
            fw_accuracy_set_windows(r, r->out->sizes.domain_way, -1);
            set_level(r, &model, g->group, levels[k]);
            FW_TRY(fw_trial_run(r->c, &model, r->n, r->windows, r->o->tick, sample, points, m));
        }
        row.depth = g->group == FW_ACCURACY_RING ? compare_points(r, points)
                                                 : fw_pairs_compare(r->n, sample, r->reference, fw_trial_depth, NULL);
        row.path = fw_pairs_compare(r->n, sample, r->reference, fw_trial_path, NULL);
        row.impulse = fw_pairs_compare(r->n, sample, r->reference, fw_trial_impulse, NULL);
        row.coupled = (fw_pairs){.mean = NAN, .error = NAN, .rms = NAN};
        fw_accuracy_cost(&row, r->n, sample);
        say_in_words(r, &row);
        FW_TRY(fw_accuracy_append(r, &row, m));
    }
    fw_accuracy_row *rows = r->out->rows + r->out->n_rows - n;
    for (size_t a = 0, b = n - 1; a < b; a++, b--) {
        fw_accuracy_row swap = rows[a];
        rows[a] = rows[b];
        rows[b] = swap;
    }
    return FW_OK;
}

/* Two windows of other ice under the same conditions: half the mean square of their difference is the variance of one. */
static fw_status run_window_lengths(fw_accuracy_run *r, fw_msg *m)
{
    for (double share = 0.25; share < 1.5; share *= 2) {
        fw_accuracy_row row = {.group = FW_ACCURACY_WINDOW,
                               .numerics = r->model.numerics,
                               .level = share * r->out->sizes.domain_way,
                               .order = NAN,
                               .hit_error = NAN};
        snprintf(row.method, sizeof row.method, "%s", fw_accuracy_group_name(FW_ACCURACY_WINDOW));
        snprintf(row.setting, sizeof row.setting, "%.4g m of ice", row.level);
        FW_ACCURACY_SAY(r, "%s: %s", row.method, row.setting);
        fw_accuracy_set_windows(r, row.level, -1);
        FW_TRY(fw_trial_run(r->c, &r->model, r->n, r->windows, r->o->tick, r->sample, NULL, m));
        for (size_t i = 0; i < r->n; i++) r->windows[i].scenario.id += 1u << 20; /* ice that no realisation has */
        FW_TRY(fw_trial_run(r->c, &r->model, r->n, r->windows, r->o->tick, r->reference, NULL, m));
        for (size_t i = 0; i < r->n; i++) r->windows[i].scenario.id -= 1u << 20;
        fw_pairs pairs = fw_pairs_compare(r->n, r->sample, r->reference, fw_trial_depth, NULL);
        row.depth = (fw_pairs){.n = pairs.n, .mean = NAN, .error = NAN, .rms = pairs.rms / sqrt(2)};
        row.path = row.impulse = row.coupled = (fw_pairs){.mean = NAN, .error = NAN, .rms = NAN};
        fw_accuracy_cost(&row, r->n, r->sample);
        double seconds = 0;
        for (size_t i = 0; i < r->n; i++) seconds += r->windows[i].window / (double)r->n;
        snprintf(row.words, sizeof row.words, "scatter of one window; as 1/sqrt(length) %.2g %% over %.3g s",
                 100 * row.depth.rms * sqrt(seconds / r->c->model.window), r->c->model.window);
        FW_TRY(fw_accuracy_append(r, &row, m));
    }
    return FW_OK;
}

fw_status fw_accuracy_domain_groups(fw_accuracy_run *r, fw_msg *m)
{
    fw_accuracy_set_windows(r, r->out->sizes.domain_way, -1);
    FW_ACCURACY_SAY(r, "domain: the default settings");
    FW_TRY(fw_trial_run(r->c, &r->model, r->n, r->windows, r->o->tick, r->usual, r->points_usual, m));
    r->out->mean_window_s = 0;
    for (size_t i = 0; i < r->n; i++) r->out->mean_window_s += r->windows[i].window / (double)r->n;
    for (size_t k = 0; k < sizeof GROUPS / sizeof GROUPS[0]; k++) FW_TRY(run_group(r, &GROUPS[k], m));
    return run_window_lengths(r, m);
}
