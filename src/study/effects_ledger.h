/* The effects ledger: what every effect and every open choice of the model moves in the depth of a window, and what it costs, measured on a campaign's
 * own scenes.
 *
 * Paired windows: the same seed and id are the same ice, floe by floe, so that two runs of a window differ by the effect and not by their ice. Every
 * effect is switched, one at a time, against the campaign's own set; the open choices of the model are changed one at a time likewise.
 * What changes is told for the mean and the design percentile of the window depth at the governing point, temperature and direction integrated, each
 * with an interval from resampled pairs (statistics/paired.h).
 *
 * Windows are the campaign's ids 0 .. n-1, after the campaign's own warm-up, but short: all of one time, in which ice at their mean speed drifts `way`
 * metres; wear counts times the campaign's window over that. Short windows scatter more each, by about 1/sqrt(way), and there are the more of
 * them; a jam that drifts apart costs width of interval and leaves no bias. One time and not one way for all: depth goes as speed^3, so that the
 * fast windows make the numbers and their scatter, and they are where ice is worth its cost. Locked rotation on the Raahe campaign: 256 windows of
 * 480 m each x3.81 [3.35, 4.35] for 7.7 CPU s a way, 192 of one time, 720 m in the mean, x3.60 [3.36, 3.91] for 6.9, 128 whole ones x3.68 [3.52, 3.88] for 23.
 * Under a tide windows are whole: part of one is not the tide.
 *
 * A point is read with a width of 5 degrees of the ring, 0.3 m at Raahe and less than nearly every patch: what a patch lays down on one arc or the
 * next is no effect. A crushing limit at 5 MPa there takes 0.15 % off the wear all round, and with one degree scatter of the same size came on top.
 *
 * Cost shares: effects are switched off one after another, down to drift and touch, on the same windows; each difference of cost is that effect's
 * share. With the bare rest they add up to the first of the sums; what they are shares of is the same windows run once more, so that their sum says how
 * well processor time is known. A share may be negative: without drag floes stay, and cost more. */
#ifndef FW_STUDY_EFFECTS_LEDGER_H
#define FW_STUDY_EFFECTS_LEDGER_H

#include "floewear/campaign.h"
#include "statistics/paired.h"

enum { FW_EFFECTS_ROWS = 40, FW_EFFECTS_MOST = 20 };

typedef struct fw_effects_row {
    char      name[40];   /* an effect's, or a key: "rotation", "water.form_drag" */
    uint32_t  bit;        /* fw_effect_bit; 0: an open choice */
    char      change[48]; /* "on -> off", "10 -> 0.9" */
    char      why[160];   /* what that is, or why one asks */
    char      note[160];  /* why it was not measured; empty: it was */
    bool      is_effect;  /* else an open choice */
    bool      was_on;     /* an effect: in the campaign's own set */
    fw_change mean, percentile;               /* of window depth at the governing point */
    double    evaluations_saved, cpu_saved;   /* over the campaign's own cost; < 0: it costs more */
    double    evaluations_share, cpu_share;   /* of an effect that was on; NAN: it was off */
    size_t    n_pairs, n_failed;              /* windows that count, and those of them that failed one way or the other */
} fw_effects_row;

typedef struct fw_effects_ledger {
    char   origin[120]; /* "on this campaign, 512 windows of 600 m of ice" */
    size_t n_windows;
    double way, seconds;             /* mean way of ice in a window [m]; its time [s] */
    size_t point;                    /* governing, from 1 */
    double percentile, confidence;   /* 90, 0.95 */
    double mean_mm, percentile_mm;   /* of a window of the campaign's length at that point, from these short ones */
    double evaluations;              /* of the campaign's own set, all windows */
    double evaluations_bare;         /* share of drift and touch without any effect */
    double cpu_s, cpu_s_first;       /* the same windows once more, which shares are of; and the first time */
    double cpu_bare;                 /* share */
    double cpu_noise;                /* standard error of a difference of two such sums, over cpu_s */
    double cpu_s_study;              /* of all */
    size_t n_rows;                   /* 0: not measured */
    fw_effects_row rows[FW_EFFECTS_ROWS];
} fw_effects_ledger;

/* One effect that can be switched. */
typedef struct fw_effects_switch {
    const char *name;
    uint32_t    bit;     /* fw_effect_bit */
    const char *no_data; /* why it cannot be switched on here; NULL: it can, or it is on */
    const char *why;     /* what switching it does to the scene */
} fw_effects_switch;

typedef struct fw_effects_options {
    void (*scenario)(const fw_campaign *c, uint64_t id, fw_scenario *out); /* fw_campaign_scenario */
    size_t                   n_switches;                                   /* at most FW_EFFECTS_MOST */
    const fw_effects_switch *switches;
    double                   cpu_budget_s; /* aimed at by a forecast in force evaluations: one campaign and budget always give the same windows */
    size_t                   n_windows;    /* > 0: so many windows of `way` instead */
    double                   way;          /* mean way of ice in a window [m]; INFINITY: the campaign's own windows */
    const fw_tick           *tick;         /* may be NULL */
    void (*say)(void *self, const char *what); /* may be NULL */
    void *say_self;
} fw_effects_options;

/* FW_E_FAILURES: no window of the campaign's own set succeeds. What the tick says: passed on. On error out is zeroed. */
fw_status fw_effects_ledger_make(fw_effects_ledger *out, const fw_campaign *c, const fw_effects_options *o, fw_msg *m);

/* Effects that were on and may be left out for `tolerance`: |change| + half of its interval is below it for mean and percentile, one after another
 * as long as their sum is, the costliest first. One that saves no more than 1 % of processor time and twice its noise stays: it
 * costs nothing, so that leaving it out would be an error for nothing. Returns how many of rows, which has FW_EFFECTS_ROWS places. */
size_t fw_effects_ledger_drops(const fw_effects_ledger *l, double tolerance, const fw_effects_row **rows);

#endif
