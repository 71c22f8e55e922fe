/* What is kept of a campaign's records to answer for its points, and the law of one point's window depth.
 *
 * Window depth of point p in realisation i: D_ip = Y M_i(arc), Y = a |T|^-m the temperature factor
 * (statistics/scale.h), the arc drawn by the direction law (directions.h). T and direction are integrated: F_p(x) =
 * sum over i of w_i times sum over arcs of w P(Y <= x / M). Weights w_i: the design's, calibrated on the law of scenarios (control.h).
 *
 * Records are streamed; of each one only the loads on arcs in use stay (n x arcs doubles, twice with their logarithms: 23 MB for 4000 records of
 * 360 arcs). Beyond FW_DEPTH_MOST_LOADS of them every second record of each randomisation is let go, again and again: 44000 records of 360 arcs or 690000 of 24 know a
 * percentile to some 0.3 %, and nothing is gained by knowing it better than the discretisation. Costs, failures and the sums of path, impact and
 * high load are those of all records.
 *
 * Failed realisations (status other than FW_OK) have no load. They are counted, never dropped from an interval: its
 * lower end takes them as depth 0, its upper end as +infinity. Central values and means are those of the others. */
#ifndef FW_STUDY_DEPTH_H
#define FW_STUDY_DEPTH_H

#include "floewear/campaign.h"
#include "floewear/records.h"
#include "statistics/averaged.h"
#include "statistics/mixture.h"
#include "study/control.h"
#include "study/directions.h"

enum { FW_DEPTH_MOST_LOADS = 1 << 24 };

/* One record as far as it is kept. */
typedef struct fw_depth_row {
    fw_scenario scenario;  /* its cell is the row of directions: 0 without a joint table */
    double      ring_load; /* mean over the ring [MPa^m km] */
    double      thickness; /* of what wore [m] */
    uint64_t    number; /* of the records that did not fail of its randomisation, from 0 */
} fw_depth_row;

typedef struct fw_depth {
    const fw_campaign *campaign; /* borrowed */
    fw_scale      scale;
    fw_directions directions;
    size_t        n_points;
    const double *bearings; /* (n_points) [deg]; borrowed */
    size_t        law;      /* abrasion law */

    size_t        n;        /* records kept */
    size_t        stride;   /* of the records that did not fail of each randomisation (of all, where there is none) one in so many is kept */
    uint64_t     *n_seen;   /* (1 + randomisations) of them so far, those without one first; owned */
    size_t        most_loads; /* FW_DEPTH_MOST_LOADS; tests take less */
    fw_depth_row *row;      /* (n); owned */
    double       *load;     /* (n x n_used) [MPa^m km]; owned */
    double       *ln_load;  /* (n x n_used) its logarithm, only with a continuous temperature law; owned */
    size_t        capacity_row, capacity_load, capacity_ln, capacity_seen;

    /* of all records */
    size_t        n_good, n_failed;
    double        weight, failed_weight;      /* sums of weights: of those that did not fail, of those that did */
    double       *ring[4];                    /* (n_laws x n_arcs) weighted sums: load, impact, high [MPa^m km], path [km]; owned */
    double        cpu_s, evaluations;         /* sums of host_cpu_s and force_evaluations */
    double        truncation;                 /* sum of energy_truncation over those that did not fail; theirs too: */
    double        all_load, overlap_wear;     /* ring means of load; of that in contacts beyond a tenth of the smaller radius [MPa^m km] */
    double        overlap_time, overlap_most; /* sum of shares of time with such a contact; largest overlap over the smaller radius */
    double        ice_ratio, size_ratio;      /* sums of what was packed over what was wanted: concentration, mean diameter */
    size_t        n_second;                   /* that finer steps brought to an end */

    /* made by fw_depth_settle */
    double       *plain; /* (n) the design's weights, sum to 1; owned */
    int32_t      *unit;  /* (n) randomisations; NULL: each record is one of its own; owned */
    size_t        n_units;
    fw_control    control;
    fw_units      units;   /* what a variance is made from, with the calibrated weights */
    double       *scratch; /* (2 x max(n, n_units)); owned */
} fw_depth;

enum { FW_DEPTH_RING_LOAD, FW_DEPTH_RING_IMPACT, FW_DEPTH_RING_HIGH, FW_DEPTH_RING_PATH };

/* The campaign (its temperature law) must outlive it. FW_E_ARG: no such law, T reaches 0. */
fw_status fw_depth_make(fw_depth *out, const fw_campaign *c, size_t law, size_t n_points, const double *bearings,
                        fw_msg *m);
fw_status fw_depth_add(fw_depth *d, const fw_record *r, fw_msg *m);
/* All records of a source, as many in memory at a time as it lends. strip: NULL, or they are added to it. */
fw_status fw_depth_stream(fw_depth *d, fw_sanity *strip, const fw_record_source *from, fw_msg *m);
/* After the last record: weights. scenarios NULL: no control variates. strip: NULL, or helps them. FW_E_FAILURES when no realisation succeeded. */
fw_status fw_depth_settle(fw_depth *d, const fw_scenario_law *scenarios, const fw_sanity *strip, fw_msg *m);
void      fw_depth_free(fw_depth *d);
/* Mean over records of a point's direction mean of one of the rings. */
double    fw_depth_ring_mean(const fw_depth *d, size_t point, int ring);

/* One point's window law. With T, direction and scenario constant it is a sample; else an averaged CDF. */
typedef struct fw_window {
    const fw_depth *depth; /* settled; borrowed */
    size_t          point; /* from 0 */
    bool            is_sample;
    double         *means;  /* (n) each kept realisation's mean depth [mm], in order of id; owned */
    double         *squares; /* (n) and its mean square [mm2]; owned */
    double         *sorted; /* (n) ascending when is_sample; owned */
    fw_mixture      mixture;
    double          moment[1 + FW_SCALE_MOMENTS]; /* E D^k [mm^k] of the window depth */
} fw_window;

fw_status   fw_window_make(fw_window *out, const fw_depth *d, size_t point, fw_msg *m);
void        fw_window_free(fw_window *w);
double      fw_window_percentile(const fw_window *w, double p);                  /* p in (0, 1); [mm] */
fw_interval fw_window_interval(const fw_window *w, double p, double confidence); /* [mm] */

/* A percentile and the CDF there, which its intervals of every confidence start from. */
typedef struct fw_window_level {
    double         p, depth; /* [mm] */
    fw_averaged_at at;
} fw_window_level;
/* values (2 x n): the first d->n_units become the units' shares in the error of the CDF there. */
void        fw_window_look(const fw_window *w, double p, fw_window_level *out, double *values);
fw_interval fw_window_interval_at(const fw_window *w, const fw_window_level *l, double confidence); /* [mm] */
/* Kish's effective sample size there (statistics/averaged.h), the failed ones counted: the size of a plain sample that would know the percentile as
 * well; NAN: nothing scatters, or too few records to tell. */
double      fw_window_effective_size(const fw_window *w, const fw_window_level *l);
const char *fw_window_method(const fw_window *w);                                /* of that interval */
fw_interval fw_window_mean_interval(const fw_window *w, double confidence);      /* [mm] */
/* Relative variance of the variance (statistics/spread.h) that the mean's interval is made from; that of a percentile is in its level. 0 for order statistics. */
double      fw_window_mean_vov(const fw_window *w);
/* Of a number that is, to first order, a weighted mean over realisations, and is about; at the lower end a failed realisation has the value none. values
 * (2 x n): of the first n each realisation's own; changed. */
fw_interval fw_window_interval_of(const fw_window *w, double about, double none, double *values, double confidence);
/* The central value if the failed ones were all 0 (low) or all infinite (high; INFINITY when it is one of them). */
void        fw_window_failure_ends(const fw_window *w, double p, double *low, double *high);

/* values (n) := P(D <= depth) of every realisation; returns their weighted mean. */
double      fw_window_cdfs(const fw_window *w, double depth, double *values);

/* Variances between windows of P(D <= depth), temperature and direction integrated: of all of it, and of what the control variates leave. */
typedef struct fw_window_scatter {
    double averaged, controlled;
} fw_window_scatter;
fw_window_scatter fw_window_scatter_at(const fw_window *w, double depth);

#endif
