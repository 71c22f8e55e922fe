/* floewear/campaign.h: what a campaign file says, once read and checked, and the run that answers it. */
#ifndef FLOEWEAR_CAMPAIGN_H
#define FLOEWEAR_CAMPAIGN_H

#include "floewear/realisation.h"
#include "floewear/record.h"
#include "floewear/scenario.h"
#include "floewear/status.h"

typedef struct fw_points {
    size_t  n;       /* measuring points, numbered from 1 at the first, clockwise */
    double *bearing; /* (n) [deg], outward normal clockwise from north, 0 <= . < 360; owned */
} fw_points;

typedef enum fw_quantity { FW_QUANTITY_PERCENTILE, FW_QUANTITY_MEAN } fw_quantity;

typedef struct fw_precision {
    fw_quantity quantity;
    double      percentile; /* 0..100 when quantity is a percentile */
    double      half_width; /* relative, 0.1 = 10 %; 0: no precision asked, run max_realisations */
    double      confidence; /* 0.95 */
    uint64_t    max_realisations;
    uint64_t
        max_failed; /* more failures than this end the campaign with exit 3; default 1 % of max_realisations, at least 1 */
    size_t  n_points; /* 0: all of the campaign's */
    size_t *points;   /* (n_points) that it is asked of, from 1; owned */
    double budget_s; /* wall-clock budget of one call, 0: none (from --time-budget, not part of the hash) */
} fw_precision;

/* One whole year of a site's record. */
typedef struct fw_service_year {
    double ice_hours; /* [h] */
    double factor;    /* on the depth of its windows, 1 when the table says nothing */
} fw_service_year;

typedef struct fw_service {
    bool   is_asked;
    double life_years, ice_hours_per_year; /* with a table its mean */
    double year_to_year_cv;                /* of a lognormal factor of mean 1; 0 with a table */
    double persistence;                    /* correlation of the normal scores of neighbouring windows' depths */
    double allowance;                      /* [mm], 0: none */
    size_t n_table;                        /* 0: no table of years */
    fw_service_year *table;                /* (n_table), owned */
} fw_service;

/* How scenarios are drawn. The designs but plain come in randomisations that are independent of each other: realisation id is point
 * id / n of randomisation id % n. */
typedef enum fw_design {
    FW_DESIGN_PLAIN,      /* independent */
    FW_DESIGN_STRATIFIED, /* strata of speed, concentration and mix (cells of a joint table) taken in turns, each by its allocation */
    FW_DESIGN_LATIN,      /* Latin hypercubes of FW_LATIN_SIZE points */
    FW_DESIGN_SOBOL       /* scrambled Sobol points */
} fw_design;
enum { FW_LATIN_SIZE = 16, FW_MAX_STRATA = 4096 };

typedef struct fw_sampling {
    fw_design design;
    bool      is_auto;          /* the file leaves the choice to a pilot */
    bool      is_shifted;       /* Sobol: by a digital shift instead of Owen's scramble */
    uint32_t  n_randomisations; /* at least 16 */
    size_t    n_allocation;     /* 0: proportional; else the number of strata (campaign/strata.h) */
    double   *allocation;       /* (n_allocation) share of the realisations, more than 0, sums to 1; owned */
} fw_sampling;

/* What acts on a campaign's answers after the run; not part of the hash. */
typedef struct fw_after {
    bool            has_water_level, has_law_scatter, has_law_coefficient, has_law_exponent;
    fw_distribution water_level;     /* above the mean level [m] */
    fw_distribution law_scatter;     /* factor on the law's rate [-] */
    fw_distribution law_coefficient; /* factor on the first law's coefficient, as far as it is not known [-] */
    fw_distribution law_exponent;    /* the first law's exponent, as far as it is not known [-] */
} fw_after;

typedef struct fw_campaign {
    char      name[64];
    char     *text;     /* the file as read, owned, NUL-terminated */
    char     *settings; /* canonical "key = value unit\n" lines of every key that shapes a record, after --set; owned.
                                   * Its hash names the campaign; comparing lines names the differing keys. */
    uint64_t  hash;     /* of settings */
    uint64_t  seed;
    fw_model  model;
    fw_site   site;
    fw_points points;
    fw_sampling  sampling;
    fw_precision precision;     /* not part of the hash: a run may be continued to a finer precision */
    fw_service   service;       /* not part of the hash */
    fw_after     after;
    size_t       n_not_applied; /* keys that are read and checked but not acted on yet */
    char (*not_applied)[96];    /* (n_not_applied), owned */
    size_t n_sets; /* --set overrides that settings already contains; kept so that text + sets give it again */
    char **sets;   /* (n_sets) "dotted.path=value", array and strings owned */
} fw_campaign;

void fw_campaign_free(fw_campaign *c);

/* id -> scenario, a pure function of (campaign, id): the design's point in the unit cube, then quantile functions. */
void fw_campaign_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out);
/* The same by plain sampling, whatever the design: what studies of numerics and effects run. */
void fw_campaign_plain_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out);

/* The strata of the site's scenarios (campaign/strata.h): their number, and that of a scenario. */
size_t fw_campaign_n_strata(const fw_campaign *c);
size_t fw_campaign_stratum(const fw_campaign *c, const fw_scenario *s);

/* The law of scenarios itself, as n points whose weights sum to 1: what an average over scenarios is taken with where none of them is
 * simulated. Exact for a joint table without wind and tide and for constants, else n Sobol points. */
typedef struct fw_scenario_law {
    uint64_t n;
    void (*point)(const fw_campaign *c, uint64_t i, fw_scenario *out);
} fw_scenario_law;
fw_scenario_law fw_campaign_law(const fw_campaign *c);

/* Where finished records go (rank 0 only), in arrival order; the sink copies what it keeps. */
typedef struct fw_sink {
    fw_status (*append)(void *self, const fw_record *r, fw_msg *m);
    fw_status (*flush)(void *self, fw_msg *m); /* group commit; called at least once a second while records arrive */
    void *self;
} fw_sink;

/* Asked by rank 0 whenever the complete prefix 0..n-1 has reached a look (n0 = 100, then x1.5, and max_realisations).
 * Sets *is_enough. The rule reads its records from where the sink put them. */
typedef struct fw_stop_rule {
    fw_status (*look)(void *self, uint64_t n_prefix, bool *is_enough, fw_msg *m);
    void *self;
} fw_stop_rule;

/* Numbers for the live line; called at most every 0.2 s on rank 0. */
typedef struct fw_progress {
    uint64_t done, failed, prefix, total; /* of a part: within it */
    double   elapsed_s, rate_per_s, eta_s;
    int      ranks;
} fw_progress;
typedef struct fw_watcher {
    void (*show)(void *self, const fw_progress *p);
    void *self;
} fw_watcher;

typedef struct fw_run {
    const fw_campaign *campaign;
    const uint64_t    *have; /* (n_have) ids already in the journal, ascending: not computed again */
    size_t             n_have;
    const uint64_t    *have_failed; /* (n_have_failed) those of them whose realisation failed, ascending */
    size_t             n_have_failed;
    fw_sink            sink;
    fw_stop_rule       stop;    /* look may be NULL: run to max_realisations */
    fw_watcher         watcher; /* show may be NULL */
    int64_t            only_id; /* >= 0: this one only */
    /* A part of a campaign that is run in several places and merged afterwards: ids first_id .. end_id - 1 alone; zeros: all of it. It asks no
     * stop rule: how precise the whole will be cannot be seen from ids that are no prefix of it. */
    uint64_t           first_id, end_id;
} fw_run;

/* Filled on every return but FW_E_ARG, so that an early stop can be reported and continued. */
typedef struct fw_run_result {
    uint64_t n_prefix;         /* complete prefix 0..n_prefix-1 (a part: from first_id on) that the answer is made from */
    uint64_t n_done, n_failed; /* records below max_realisations (a part: of its ids) now in the sink, those of earlier calls included */
    bool     is_enough;        /* the stop rule said so (else max_realisations, or stopped) */
} fw_run_result;

/* Collective over the ranks: start, then rank 0 calls run and the others serve until it ends, then stop.
 * FW_E_STOPPED after a signal or when the budget is used up: everything that arrived is in the sink. */
fw_status fw_ranks_start(int *argc, char ***argv, int *rank, int *n_ranks, fw_msg *m);
void      fw_ranks_stop(void);
void      fw_ranks_abort(int exit_code);
/* Rank 0's view of the campaign decides: its bytes are checked against the other ranks' hash before work starts. */
fw_status fw_campaign_run(const fw_run *run, fw_run_result *result, fw_msg *m); /* rank 0 */
fw_status fw_campaign_serve(const fw_campaign *c, fw_msg *m);                   /* other ranks */
/* Tell every rank to leave before any work (bad input found on rank 0); serve then returns FW_E_STOPPED. */
void      fw_campaign_cancel(void);

#endif
