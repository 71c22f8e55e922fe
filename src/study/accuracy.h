/* The accuracy study: error against cost of every choice in the numerics, measured on a campaign's own scenes.
 *
 *   step      step level x scheme x wear rule, paired on the same ice (fixed steps where they have the campaign's effects);
 *             reference: the events scheme at accuracy 0.01 %, itself checked against embedded reference solutions of single hits
 *   ring, strip width, downstream, warm-up    one at a time at the chosen step, paired, against the widest
 *   window    scatter of one window under fixed conditions against its length
 *   P90 (the campaign's percentile) against the number of realisations, and what a CPU budget buys
 *
 * What is run: of the first 2 n ids of the campaign's own design the n with the faster current, because fast windows carry
 * the design value (depth goes as speed^3) and slow ones see no ice in a short time; each for `way` metres of drifting ice. */
#ifndef FW_STUDY_ACCURACY_H
#define FW_STUDY_ACCURACY_H

#include "floewear/campaign.h"
#include "study/measured.h"
#include "study/trial.h"

/* How much is run. */
typedef struct fw_accuracy_sizes {
    size_t n_windows;        /* of every paired group */
    double way, warm_up_way; /* of ice in a window of the step group and before it [m] */
    size_t n_steps;          /* fixed steps, from the coarsest on */
    double domain_way;       /* of the other groups, with the campaign's own warm-up [m] */
    size_t n_percentile;     /* windows for the percentile's error */
} fw_accuracy_sizes;

typedef struct fw_accuracy_options {
    void (*scenario)(const fw_campaign *c, uint64_t id, fw_scenario *out); /* fw_campaign_scenario */
    double         cpu_budget_s; /* aimed at: sizes shrink until a pilot's forecast fits; they are one of a few */
    const fw_tick *tick;         /* may be NULL */
    void (*say)(void *self, const char *what); /* what is being run; may be NULL */
    void *say_self;
} fw_accuracy_options;

typedef enum fw_accuracy_group {
    FW_ACCURACY_STEP,
    FW_ACCURACY_RING,
    FW_ACCURACY_STRIP,
    FW_ACCURACY_DOWNSTREAM,
    FW_ACCURACY_WARM_UP,
    FW_ACCURACY_WINDOW
} fw_accuracy_group;
const char *fw_accuracy_group_name(fw_accuracy_group g); /* "step", "ring", ... */

/* One setting of one group. Errors are relative. Of the ring group depth_* are of the measuring points: the r.m.s. difference over
 * points relative to their mean. Of the window group depth_rms is the scatter of one window and nothing is compared. */
typedef struct fw_accuracy_row {
    fw_accuracy_group group;
    char              method[40];  /* the line of the diagram it belongs to: "events, hermite", "events 2, hermite" (its order) */
    char              setting[40]; /* "tolerance 1e-4", "1 ms", "360 arcs" */
    fw_numerics       numerics;
    double            level;                /* tolerance [-], step [s], arcs, width [m], way [m] */
    fw_pairs          depth, path, impulse; /* over all windows with wear */
    fw_pairs          coupled;              /* depth over the coupled ones; step group only */
    double            evaluations, cpu_s;   /* mean of a window, its warm-up included */
    double            truncation;           /* mean energy truncation */
    double            order;     /* of coupled.rms, between the next coarser level of the method and this; NAN: none */
    double            hit_error; /* worst depth error of the embedded single hits; NAN: not the events scheme */
    bool              is_reference, is_default, is_chosen;
    char              words[120]; /* what has to be said beside the numbers */
} fw_accuracy_row;

typedef struct fw_accuracy_percentile_row {
    size_t n;     /* realisations */
    double error; /* relative r.m.s. error of the percentile, from sub-sets of the windows that were run */
    double fit;   /* error_one / sqrt(n) */
} fw_accuracy_percentile_row;

/* A CPU budget spent on windows of the campaign at one step level: coarse steps buy more windows. */
typedef struct fw_accuracy_budget_row {
    double budget_cpu_s, tolerance, step_error, cpu_s_window, n, sampling_error, total_error;
    bool   is_chosen;
} fw_accuracy_budget_row;

typedef struct fw_accuracy_choice {
    fw_numerics numerics;                         /* order, tolerance, first_step, growth */
    size_t      n_arcs;                           /* 0: the campaign's is enough */
    double      strip_width, downstream, warm_up; /* [m], [m], [s]; < 0: the campaign's is enough */
    double error; /* |mean| + 2 standard errors over coupled windows, the worst hit, energy truncation: the largest */
    bool   is_within; /* the campaign's accuracy */
    char   why[240];
} fw_accuracy_choice;

typedef struct fw_accuracy {
    fw_accuracy_sizes           sizes;
    size_t                      n_coupled;                 /* of sizes.n_windows */
    double                      mean_speed, mean_window_s; /* of the step group */
    double                      reference_hit_error;       /* of the reference level on the embedded solutions, worst */
    char                        reference_hit[32];         /* which */
    size_t                      n_rows;
    fw_accuracy_row            *rows; /* owned, by group */
    size_t                      n_percentile;
    fw_accuracy_percentile_row *percentile; /* owned */
    double                      percentile_value, error_one, percentile_slope,
        percentile_window_s; /* P90 [mm] of the short windows; error of one window */
    double
        cpu_s_window; /* of one window of the campaign at the chosen step [s], from the windows of the percentile group */
    size_t                  n_budget;
    fw_accuracy_budget_row *budget; /* owned */
    fw_accuracy_choice      choice;
    fw_measured             measured; /* the ledger's rows */
    double                  cpu_s;    /* of the whole study */
} fw_accuracy;

/* FW_E_FAILURES: no window of the study has wear. What the tick says: passed on. On error out is zeroed. */
fw_status fw_accuracy_study(fw_accuracy *out, const fw_campaign *c, const fw_accuracy_options *o, fw_msg *m);
void      fw_accuracy_free(fw_accuracy *a);

/* Relative r.m.s. error of percentile p (0..1) of the campaign's governing point from n of the records: random sub-sets of the
 * prefix, corrected for their being a part of it. Needs n <= n_records / 2. */
fw_status fw_accuracy_percentile_error(const fw_campaign *c, size_t n_records, const fw_record *records, double p,
                                       size_t n, double *error, double *value, fw_msg *m);

/* Depth errors of the embedded single hits under the given accuracy and numerics: the worst of them, and which one. */
fw_status fw_accuracy_hits(double accuracy, const fw_numerics *numerics, double *worst, char *name, size_t size,
                           fw_msg *m);

#endif
