/* Paired trials: the same windows of ice under different numerics, and what the differences say.
 *
 * Same seed and id are the same ice, floe by floe, so a difference between two settings is an error and no scatter, as long
 * as the two runs stay coupled. In a jam they do not: one touch that comes a little earlier changes all that follow. Such
 * windows are found (fw_pairs_find_coupled) and kept apart: in them a step error shows in the mean only. */
#ifndef FW_STUDY_TRIAL_H
#define FW_STUDY_TRIAL_H

#include "floewear/campaign.h"

/* One window of a trial: a scenario of the campaign and how long of it is run. */
typedef struct fw_trial_window {
    fw_scenario scenario;
    double      window, warm_up; /* [s]; warm_up < 0: as the campaign says */
} fw_trial_window;

typedef struct fw_trial_sample {
    bool   is_ok;         /* the realisation did not fail */
    double depth;         /* sum of the ring's wear load, first law */
    double path, impulse; /* sum of the ring's path; normal impulse on the structure */
    double hits, evaluations, cpu_s, truncation;
} fw_trial_sample;

/* Run every window with the model's numerics, ring and domain. points: (n x c->points.n) loads at the measuring points with
 * the current straight on the first one; may be NULL. tick may be NULL. */
fw_status fw_trial_run(const fw_campaign *c, const fw_model *model, size_t n, const fw_trial_window *windows,
                       const fw_tick *tick, fw_trial_sample *out, double *points, fw_msg *m);

/* What is being run, as printf says it, to whoever wants to know; say may be NULL. */
void fw_trial_say(void (*say)(void *self, const char *what), void *self, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

/* What the measuring points read of a ring with the current straight on the first of them. to: (c->points.n) */
void fw_trial_read_points(const fw_campaign *c, size_t n_arcs, const double *ring, double *to);

/* What n pairs say: e = (value - reference) over their mean size, so that a decoupled pair counts alike both ways. */
typedef struct fw_pairs {
    size_t n;                /* pairs in which something was worn */
    double mean, error, rms; /* of e; error: standard error of the mean, NAN below two pairs; rms: of single windows */
} fw_pairs;

typedef double (*fw_trial_value)(const fw_trial_sample *s);
double fw_trial_depth(const fw_trial_sample *s);
double fw_trial_path(const fw_trial_sample *s);
double fw_trial_impulse(const fw_trial_sample *s);

/* counts: (n) which pairs to look at; NULL: all that did not fail. */
fw_pairs fw_pairs_compare(size_t n, const fw_trial_sample *a, const fw_trial_sample *reference, fw_trial_value value,
                          const bool *counts);
/* Loads at measuring points (n x n_points), over scale (n), the windows' means over the ring; weight (n): how much a window knows,
 * its hits. A point of one window has a scatter of its own, because hits are few and their patches narrow: that is rms. What stays
 * in the mean over windows is b per point with standard error s: mean = sqrt(mean b^2 - s^2) over points; error is what that
 * would be if all were noise. NAN below two windows. */
fw_pairs fw_pairs_compare_points(size_t n, size_t n_points, const double *points, const double *reference,
                                 const double *scale, const double *weight);
/* Coupled: depth of two fine levels agrees within limit. Returns their number. */
size_t   fw_pairs_find_coupled(size_t n, const fw_trial_sample *a, const fw_trial_sample *reference, double limit,
                               bool *is_coupled);

#endif
