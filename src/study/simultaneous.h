/* Intervals of a percentile that cover at all answered points together (statistics/bands.h), and the effective sample size there.
 *
 * One point's window law is in memory at a time: a first round over the points keeps their units' shares in the error of each percentile, a second one,
 * when it is known at which confidence the points cover together, takes the ends. Points whose percentile is 0, and those where nothing scatters, have no
 * say in that confidence; their own ends are taken at it all the same. */
#ifndef FW_STUDY_SIMULTANEOUS_H
#define FW_STUDY_SIMULTANEOUS_H

#include "study/answer.h"
#include "study/depth.h"

typedef struct fw_simultaneous {
    const fw_depth  *depth; /* settled; borrowed */
    size_t           n_percentiles, n_groups;
    double          *shares; /* (n_percentiles x n_points x n_groups); owned */
    fw_window_level *levels; /* (n_points x n_percentiles); owned */
} fw_simultaneous;

fw_status fw_simultaneous_open(fw_simultaneous *out, const fw_depth *d, size_t n_percentiles, fw_msg *m);
void      fw_simultaneous_close(fw_simultaneous *s);
/* Percentile number k, p (0 .. 1), of w's point. Returns the CDF there, which stays until the close. */
const fw_window_level *fw_simultaneous_add(fw_simultaneous *s, const fw_window *w, size_t k, double p);
/* After the last point. rows (n_points x n_percentiles): their own intervals there; band_low_mm and band_high_mm are filled. */
fw_status fw_simultaneous_end(fw_simultaneous *s, double confidence, fw_percentile_row *rows, fw_msg *m);

#endif
