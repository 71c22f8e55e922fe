/* What is kept of a campaign's records to answer for its points, and the law of one point's window depth.
 *
 * Window depth of point p in realisation i: D_ip = Y M_i(arc), Y = a |T|^-m the temperature factor
 * (statistics/scale.h), the arc drawn by the direction law (directions.h). T and direction are integrated: F_p(x) =
 * mean over i of sum over arcs w P(Y <= x / M). Records are streamed; of each one only the loads on arcs in use stay
 * (n x arcs doubles, twice with their logarithms: 23 MB for 4000 records of 360 arcs) and running sums of path,
 * impact and high load.
 *
 * Failed realisations (status other than FW_OK) have no load. They are counted, never dropped from an interval: its
 * lower end takes them as depth 0, its upper end as +infinity. Central values and means are those of the others. */
#ifndef FW_STUDY_DEPTH_H
#define FW_STUDY_DEPTH_H

#include "floewear/campaign.h"
#include "statistics/mixture.h"
#include "statistics/order.h"
#include "study/directions.h"

typedef struct fw_depth {
    fw_scale      scale;
    fw_directions directions;
    size_t        n_points;
    const double *bearings; /* (n_points) [deg]; borrowed */
    size_t        law;      /* abrasion law */
    size_t        n, n_failed, capacity_law, capacity_thickness, capacity_load, capacity_ln;
    uint32_t     *direction_law;        /* (n) row of directions per record; owned */
    double       *thickness;            /* (n) of what wore in each record [m]; owned */
    double       *load;                 /* (n x n_used) [MPa^m km]; owned */
    double       *ln_load;              /* (n x n_used) its logarithm, only with a continuous temperature law; owned */
    double       *impact, *high, *path; /* (n_points) sums over records of direction means; owned */
    double        cpu_s, evaluations;   /* sums of host_cpu_s and force_evaluations over all records */
    double        truncation;           /* sum of energy_truncation over those that did not fail; theirs too: */
    double        all_load, overlap_wear; /* ring means of load; of that in contacts beyond a tenth of the smaller radius [MPa^m km] */
    double        overlap_time, overlap_most; /* sum of shares of time with such a contact; largest overlap over the smaller radius */
    double        ice_ratio, size_ratio; /* sums of what was packed over what was wanted: concentration, mean diameter */
    size_t        n_second; /* that finer steps brought to an end */
} fw_depth;

/* The campaign (its temperature law) must outlive it. FW_E_ARG: no such law, T reaches 0. */
fw_status fw_depth_make(fw_depth *out, const fw_campaign *c, size_t law, size_t n_points, const double *bearings,
                        fw_msg *m);
fw_status fw_depth_add(fw_depth *d, const fw_record *r, fw_msg *m);
void      fw_depth_free(fw_depth *d);

/* One point's window law. With T and direction constant it is a sample; else an averaged CDF. */
typedef struct fw_window {
    const fw_depth *depth; /* borrowed */
    size_t          point; /* from 0 */
    bool            is_sample;
    double         *means;  /* (n) each realisation's mean depth [mm], in order of id; owned */
    double         *sorted; /* (n) ascending when is_sample; owned */
    fw_mixture      mixture;
    double          moment[1 + FW_SCALE_MOMENTS]; /* E D^k [mm^k] of the window depth */
    double          load;                         /* mean load [MPa^m km] */
} fw_window;

/* FW_E_FAILURES when no realisation succeeded. */
fw_status   fw_window_make(fw_window *out, const fw_depth *d, size_t point, fw_msg *m);
void        fw_window_free(fw_window *w);
double      fw_window_percentile(const fw_window *w, double p);                  /* p in (0, 1); [mm] */
fw_interval fw_window_interval(const fw_window *w, double p, double confidence); /* [mm] */
fw_interval fw_window_mean_interval(const fw_window *w, double confidence);      /* [mm] */
/* The central value if the failed ones were all 0 (low) or all infinite (high; INFINITY when it is one of them). */
void        fw_window_failure_ends(const fw_window *w, double p, double *low, double *high);
/* One window drawn from the law by three independent uniforms: realisation, arc, temperature. [mm] */
double      fw_window_draw(const fw_window *w, double u_record, double u_arc, double u_factor);

#endif
