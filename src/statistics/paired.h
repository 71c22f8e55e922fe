/* What a change does to the mean and to a percentile, from windows that were run both ways on the same ice.
 *
 * Windows are pairs: what they share (their ice, their scenario) leaves the difference. Both intervals come from resampling whole pairs, 999 times
 * with the same draws for every comparison of a seed, so that a change that changes nothing is exactly 0 with an interval of no width.
 *
 *   mean        change = mean a / mean b - 1; bootstrap-t on its logarithm: the resamples' (ln R* - ln R) / s*, s the standard error of a ratio of
 *               paired means, gives the quantiles that Student's t has wrong for skew depths
 *   percentile  change = q_a / q_b - 1 of the laws averaged over windows; percentile interval of ln(q_a* / q_b*)
 *
 * Coverage of intervals of 95 %, counted in 2000 repeats (tests/statistics/test_paired.c): lognormal windows of CV 1.5 under weather of their own, an
 * effect that differs from window to window by a lognormal factor of sigma:
 *
 *     sigma           0.05                 0.3                  1
 *     windows    48   128   384      48   128   384      48   128   384
 *     mean       94    94    94      93    94    94      90    92    93 %
 *     P90       100   100   100      96    96    96      95    95    95 %
 *
 * where Student's t gives 93 / 92 / 95, 93 / 91 / 93 and 87 / 90 / 91 for the mean. A percentile of few windows steps from one to the next: small
 * changes of it are known better than their intervals say.
 * A percentile needs windows beyond it: none is offered where n (1 - p) is below 3. */
#ifndef FW_STATISTICS_PAIRED_H
#define FW_STATISTICS_PAIRED_H

#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

enum { FW_PAIRED_RESAMPLES = 999 };

typedef struct fw_change {
    double change;    /* a over b - 1; NAN: b is 0 */
    double low, high; /* its interval; NAN: none */
} fw_change;

/* How often each of n pairs is in each resample: (FW_PAIRED_RESAMPLES x n), resample by resample. */
typedef struct fw_paired_draws {
    size_t    n;
    uint16_t *times; /* owned */
} fw_paired_draws;
fw_status fw_paired_draws_make(fw_paired_draws *out, size_t n, uint64_t seed, fw_msg *m);
void      fw_paired_draws_free(fw_paired_draws *d);

/* a, b: (draws->n), at least 0. */
fw_status fw_paired_mean(const fw_paired_draws *draws, const double *a, const double *b, double confidence, fw_change *out, fw_msg *m);

/* The law of what windows give: a window is a few values with weights that sum to 1. */
typedef struct fw_paired_atom {
    double   value, weight;
    uint32_t window;
} fw_paired_atom;

/* Sorts atoms by value, which the other two need. */
void   fw_paired_sort(size_t n_atoms, fw_paired_atom *atoms);
/* Smallest value with P(X <= value) >= p over n windows. */
double fw_paired_quantile(size_t n, size_t n_atoms, const fw_paired_atom *sorted, double p);
fw_status fw_paired_percentile(const fw_paired_draws *draws, size_t n_a, const fw_paired_atom *a, size_t n_b, const fw_paired_atom *b, double p,
                               double confidence, fw_change *out, fw_msg *m);

#endif
