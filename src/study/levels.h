/* Would cheap models beside the campaign's own pay? A pilot of coupled pairs: the same scenario, seed and id are the same ice, computed the campaign's
 * own way and once more in every cheap way (multilevel and multifidelity estimates; statistics/coupled.h has the formulas).
 *
 *   coarse steps      accuracy 10 % with the campaign's own warm-up
 *   third of window   the first third of the same window, its wear times three
 *   no floe contact   floes pass through one another
 *   spring            instead of ice that crushes, where the campaign has that
 *   swept strip       no floes at all (sanity.h): its load, with the mean shape round the ring
 *
 * What is compared is what decides the campaign's precision: of each window P(D <= x) at the governing point, x the design percentile, temperature and
 * direction integrated, or its mean depth, where the campaign asks for a mean; and of it the residuals of the control variates (control.h), which the
 * campaign uses anyway. Two models that agree because both know the scenario have nothing left to give: that is why correlations of
 * 0.98 come down to 0.1 to 0.8 here. A level is worth its trouble from twofold on: the interval's lower end above 2, and Giles's checks passed.
 *
 * With few windows there are few control variates, and what they leave of the scenario is common to both ways: small pilots promise too much, and no promise is
 * taken from them. Gains measured, variance at equal CPU time, [95 %]:
 *
 *                     Raahe, 512 windows   60 % ice alone, 256   crushing ice, 128   40 % ice at 1 m/s, 192
 *   coarse steps      0.59 [0.56, 0.66]    0.88 [0.62, 0.99]     0.55 [0.53, 0.62]   0.57 [0.55, 0.60]
 *   third of window   0.74 [0.74, 0.79]    0.74 [0.74, 0.81]     0.86 [0.76, 1.07]   0.76 [0.75, 0.80]
 *   no floe contact   1.15 [0.97, 1.46]    0.98 [0.97, 1.00]     0.72 [0.69, 0.81]   0.88 [0.85, 0.96]
 *   spring                                                       0.81 [0.78, 1.04]
 *   beyond the strip  1.19 [1.04, 1.51]    1.01 [1.00, 1.07]     1.16 [1.00, 1.86]   1.00
 *
 * None comes near twofold, so there is no such estimate. A whole window is what knows its ice: coarse steps keep it and save a fifth, all that
 * is much cheaper has lost it. */
#ifndef FW_STUDY_LEVELS_H
#define FW_STUDY_LEVELS_H

#include "floewear/campaign.h"
#include "statistics/coupled.h"

enum { FW_LEVELS_ROWS = 5 };
/* What a level has to promise. */
#define FW_LEVELS_WANTED 2.0

typedef struct fw_levels_row {
    char       name[24], what[96];
    char       note[160];         /* why it was not measured; empty: it was */
    fw_coupled pairs;             /* costs in processor time */
    double     evaluations_ratio; /* force evaluations of the campaign's own way over those of the cheap one */
    double     correlation_before; /* without the control variates */
    double     correlation_mean;   /* of the windows' mean depths, behind the control variates */
    bool       is_promising;
    char       verdict[160]; /* in words */
} fw_levels_row;

typedef struct fw_levels {
    size_t n_windows, n_failed;   /* windows that count; those left out because one way or the other failed */
    size_t n_functions;           /* control variates, 0: none */
    size_t point;                 /* governing, from 1 */
    double percentile, depth_mm;  /* 90 and x; NAN and the mean depth, where the campaign asks for that */
    double confidence;
    double cpu_s_window, cpu_s;   /* of a window the campaign's own way; of the study */
    size_t n_rows;
    fw_levels_row rows[FW_LEVELS_ROWS];
} fw_levels;

typedef struct fw_levels_options {
    void (*scenario)(const fw_campaign *c, uint64_t id, fw_scenario *out); /* fw_campaign_plain_scenario */
    fw_scenario_law law;          /* for the control variates; zeros: none */
    double          cpu_budget_s; /* aimed at in force evaluations, 128 windows at least: one campaign and budget always give the same windows */
    const fw_tick  *tick;         /* may be NULL */
    void (*say)(void *self, const char *what); /* may be NULL */
    void *say_self;
} fw_levels_options;

/* FW_E_FAILURES: no window succeeds in all ways. What the tick says: passed on. */
fw_status fw_levels_measure(fw_levels *out, const fw_campaign *c, const fw_levels_options *o, fw_msg *m);

#endif
