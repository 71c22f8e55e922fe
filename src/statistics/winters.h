/* Winters: sums of windows whose normal scores are an autoregressive sequence (scores.h), each winter starting afresh.
 *
 * A pool of them stands for their law. The paths of scores are drawn once and serve every point: what a lucky winter does to one point it
 * does to all. Sums are shifted and stretched to the mean and variance that are known exactly, so that the pool gives only their shape;
 * first scores are stratified, which makes the pool of one-window winters the window's own law.
 *
 * paths   n_winters >= 256, 16384 when a winter has few windows: at most some 3 million scores in all, four bytes each; 0.2 s for 24 points.
 *         A winter of more than FW_WINTERS_LONGEST windows is made of blocks of equal windows, whose scores are correlated like their first ones:
 *         mean and variance are matched anyway, and of the shape of so long a sum little is left */
#ifndef FW_STATISTICS_WINTERS_H
#define FW_STATISTICS_WINTERS_H

#include <stdint.h>

#include "statistics/scores.h"

enum { FW_WINTERS_LONGEST = 8192 };

typedef struct fw_winters {
    size_t  n_winters, n_scores; /* of the longest winter */
    size_t  block;               /* windows that one score stands for, 1 but for very long winters */
    double  phi;
    float  *at;                  /* (n_winters x n_scores) scores, in nodes of fw_scores; owned */
} fw_winters;

/* phi in [0, 1): FW_E_ARG. */
fw_status fw_winters_make(fw_winters *out, uint64_t seed, double phi, size_t longest, fw_msg *m);
void      fw_winters_free(fw_winters *w);
/* The depths of all winters, cut to each of the given lengths.
 * lengths   (n_lengths) windows, ascending, at most longest; 0 gives 0
 * sums      (n_lengths x n_winters) out, in the unit of the scores' depth, >= 0 */
void      fw_winters_sum(const fw_winters *w, const fw_scores *s, size_t n_lengths, const size_t *lengths, double *sums);

#endif
