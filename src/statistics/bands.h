/* Simultaneous intervals of one percentile at many points (max-type band).
 *
 * An interval of 95 % at each of 24 points leaves out some point's true value in far more than 5 % of all campaigns. The errors of the points are
 * sums of the shares of the same realisations, e_p = sum over i of z_ip, and hang together: by how much their largest, in standard errors, exceeds
 * that of one point is asked of the shares themselves. With independent normal multipliers g_i,
 *
 *     max over p of |sum over i of g_i z_ip| / s_p,   s_p^2 = sum over i of z_ip^2,
 *
 * has the law of the largest error (multiplier bootstrap: Chernozhukov, Chetverikov and Kato 2013, Ann. Statist. 41, 2786). Its quantile c says at which
 * confidence, 2 Phi(c) - 1, every point's own interval has to be taken so that all of them cover together. Given the shares these sums are normal
 * with the covariance of the shares, and are drawn from it: P numbers a draw instead of one for each realisation.
 *
 * c lies between that of one point and that of P independent ones (Sidak 1967, J. Am. Statist. Assoc. 62, 626). */
#ifndef FW_STATISTICS_BANDS_H
#define FW_STATISTICS_BANDS_H

#include <stddef.h>
#include <stdint.h>

#include "floewear/status.h"

/* More units than these add nothing to the law of the largest error; they are summed into so many groups. */
enum { FW_BANDS_MOST_GROUPS = 512 };

/* shares (n): of the units, in order of id, become those of groups of neighbours. Returns the number of groups: n, at most FW_BANDS_MOST_GROUPS. */
size_t fw_bands_group(size_t n, double *shares);

/* *pointwise: the confidence at which all points' intervals cover together with the one that is asked for. shares (n_points x n_groups): of the groups
 * in each point's error; a point whose shares are all equal has no error and is left out. A pure function of its arguments: the seed's stream
 * FW_STREAM_SECTIONING. Work: the points' square times groups and times a few thousand draws. FW_E_ARG: a confidence outside (0, 1). */
fw_status fw_bands_confidence(size_t n_points, size_t n_groups, const double *shares, double confidence, uint64_t seed, double *pointwise, fw_msg *m);

/* That of n independent points: confidence^(1/n). */
double fw_bands_independent(double confidence, size_t n);

#endif
