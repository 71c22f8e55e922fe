/* From records to answers: percentiles of the window depth per measuring point, means, shares, service life, ledger.
 * Knows no MPI, no files and no printing. */
#ifndef FW_STUDY_ANSWER_H
#define FW_STUDY_ANSWER_H

#include "floewear/campaign.h"
#include "floewear/records.h"
#include "study/effects_ledger.h"
#include "study/measured.h"
#include "study/sanity.h"
#include "study/service.h"
#include "study/water_level.h"

/* The records that an answer is made from: every one is needed once, in order (fw_records_lend). law: what the site's scenarios
 * are drawn from, for control variates; zeros: there are none. */
typedef struct fw_answer_source {
    fw_record_source records;
    fw_scenario_law  law;
} fw_answer_source;

typedef struct fw_answer_options {
    size_t        n_percentiles;
    const double *percentiles; /* (n_percentiles) 0 < p < 100 */
    size_t        n_points;    /* 0: all */
    const size_t *points;      /* (n_points) numbers from 1 */
    size_t        law;         /* index into the campaign's laws */
    double        confidence;  /* 0.95 */
    const fw_measured *measured; /* numerical errors for the ledger; NULL: the Raahe campaign's */
    const fw_effects_ledger *effects; /* what effects and open choices move; NULL or no rows: not measured */
} fw_answer_options;

typedef struct fw_percentile_row {
    size_t      point; /* from 1 */
    double      bearing_deg, percentile;
    double      depth_mm, low_mm, high_mm; /* an end that does not exist is NAN */
    double      band_low_mm, band_high_mm; /* of the intervals that cover at all answered points together (simultaneous.h) */
    double      n_effective;               /* Kish's effective sample size at the percentile (statistics/averaged.h); order statistics: n; NAN: nothing scatters */
    double      coverage;                  /* attained (order statistics) or nominal (averaged CDF); NAN: no interval */
    const char *method;                    /* "order statistics" (T, direction and scenario constant), or "averaged CDF" (statistics/averaged.h says why
                                            * that and not sectioning) and what it is made with: "control variates" (study/control.h), "randomisations" */
} fw_percentile_row;

typedef struct fw_point_row {
    size_t point;
    double bearing_deg, mean_mm, mean_low_mm, mean_high_mm, path_km, impact_share, high_share; /* high: above 5 MPa */
    char   dominated_by[48];  /* the ledger's largest row in this point's design percentile: its own sampling and failed runs, the rest as at the governing point */
    double dominating_amount; /* of that row, relative; NAN: the percentile is 0 */
} fw_point_row;

typedef struct fw_life_row {
    size_t point;
    double bearing_deg, percentile, depth_mm, low_mm, high_mm;
    double windows;        /* in the life */
    double allowance_year; /* in which the percentile uses up the allowance, from 1; NAN: never, or none asked */
    /* What is not known of the law in it: the percentile of depth times factor, and the percentile alone at the factor's confidence ends. NAN:
     * nothing is said of the law. */
    double with_law_depth_mm, with_law_low_mm, with_law_high_mm;
} fw_life_row;

typedef struct fw_ledger_row {
    char   row[48];                             /* "sampling", "discretisation", ... */
    double amount;                              /* relative amount in the governing design number; NAN: not measured */
    char   shrinks_with[224], cost_to_halve[128]; /* no clock in them: the same for every run of a campaign */
    double cost_to_halve_cpu_s;                 /* on the machines that computed the records; NAN: not measured */
    bool   is_sum;                              /* of the rows behind it */
    bool   is_scatter;                          /* what is, not what is not known: years that differ, windows that resemble each other */
} fw_ledger_row;

/* What to do about the largest doubts in the governing number. Indices into the ledger; n_ledger: there is none. */
typedef struct fw_advice {
    size_t largest;   /* amount among the rows that are no sums and no scatter */
    size_t best_paid; /* most of the number's total error, rows added in squares, taken off per CPU second if that row is halved */
    double total, total_after; /* relative: now, and with that row halved */
} fw_advice;

/* The factor on the law's rate: its scatter as the campaign gives it, and at the governing point what is not known of coefficient and exponent. */
typedef struct fw_law_scatter {
    bool   is_given;
    double mean, median, low, high; /* low, high: 95 % lie between them */
} fw_law_scatter;

typedef struct fw_answer {
    uint64_t n, n_failed;
    fw_id_span span; /* which realisations these are, as their source says */
    double   confidence;
    double   design_percentile; /* the campaign's precision percentile, else 90 if asked for, else the largest */
    size_t   governing_point;   /* largest design percentile among the answered points, from 1 */
    double   half_width;        /* as fw_answer_half_width says, over the answered points */
    size_t   n_percentiles;
    fw_percentile_row *percentiles; /* point-major */
    size_t             n_points;
    fw_point_row      *points;
    size_t             n_life;
    fw_life_row       *life;
    fw_service_answer  service; /* fan, allowance, map */
    fw_measured        measured; /* what the ledger's numerical rows are made from */
    fw_effects_ledger  effects;  /* what its rows of switched-off effects are made from */
    size_t             n_ledger;
    fw_ledger_row     *ledger;
    fw_advice          advice;
    size_t             n_swept;        /* n_points, or 0: there is no strip beside it */
    fw_sanity_row     *swept;
    fw_sanity_ring     swept_ring;
    char               swept_why[160]; /* there is none */
    fw_law_scatter     law_scatter;
    fw_water_level     water_level; /* of the governing point */
} fw_answer;

/* o: NULL or zeros stand for 50, 90, 95, 99 % and the precision's own percentile, all points, the first law, the
 * precision's confidence. FW_E_ARG: a percentile or point outside its range. FW_E_FAILURES: no realisation
 * succeeded. Failed realisations: see depth.h. */
fw_status fw_answer_make(fw_answer *out, const fw_campaign *c, const fw_answer_source *source,
                         const fw_answer_options *o, fw_msg *m);
void      fw_answer_free(fw_answer *a);

/* The stop rule's question. */
typedef struct fw_reached {
    double half_width; /* of the interval of the campaign's precision quantity, relative to its value, the worst over the points that it is asked of;
                        * INFINITY when an end does not exist. A point below a tenth of the largest one is measured against that tenth: the lee
                        * side, where a window's wear is nearly always 0, must not keep a campaign running */
    double value_mm; /* of the point with the largest value; */
    size_t point;    /* that point, from 1 */
    double vov;      /* relative variance of the variance that its interval is made from: a few rare windows must not decide that all is known */
    double most_vov; /* with more of it nothing is enough: 0.1, or three times what normal shares of so few randomisations have */
    bool   is_enough;
} fw_reached;
#define FW_ANSWER_MOST_VOV 0.1
fw_status fw_answer_reached(const fw_campaign *c, const fw_answer_source *source, fw_reached *out, fw_msg *m);
/* The same with a strip of the first law that is there already (sanity.h); records are added to it. */
fw_status fw_answer_reached_beside(const fw_campaign *c, const fw_answer_source *source, fw_sanity *strip, fw_reached *out, fw_msg *m);

#endif
