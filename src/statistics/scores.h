/* The depth of a window as a function of its normal score, and sums of windows whose scores are a first-order
 * autoregressive sequence (a Gaussian copula): z' = phi z + sqrt(1 - phi^2) e, phi the lag-one correlation.
 *
 *     depth(z) = Q(Phi(z)),  Q the quantile function of the window depth
 *     cov(D_t, D_t+k) = sum over j >= 1 of c_j^2 phi^(j k),  c_j = E depth(Z) He_j(Z) / sqrt(j!)   (Mehler 1866)
 *
 * so that the variance of a sum of n windows is a sum of geometric series. phi is the correlation of scores; that of depths is
 * lower, (exp(s^2 phi) - 1)/(exp(s^2) - 1) for a lognormal, and dies out sooner the heavier the tail.
 *
 * The law is tabulated at even scores. Coefficients are sums over these nodes, which converge faster than any power of the step for a
 * smooth law and as its square for one with kinks; mean and variance are the caller's exact ones, the coefficients only say how the
 * variance is shared among the powers of phi. */
#ifndef FW_STATISTICS_SCORES_H
#define FW_STATISTICS_SCORES_H

#include <stddef.h>

#include "floewear/status.h"

/* Scores -12 .. 12 by 1/20: beyond lie 4e-33 of all windows, whose share in E D^2 is below 1e-10 for a lognormal of CV 1.5 (tested).
 * 48 terms hold all of it there; of a law with steps some 10 % are left. */
enum { FW_SCORES_PER_UNIT = 20, FW_SCORES_REACH = 12, FW_SCORES_NODES = 2 * FW_SCORES_REACH * FW_SCORES_PER_UNIT + 1, FW_SCORES_TERMS = 48 };

typedef struct fw_scores {
    double mean, variance;              /* of one window */
    double depth[FW_SCORES_NODES];      /* at score k / PER_UNIT - REACH, not descending */
    double share[1 + FW_SCORES_TERMS];  /* c_j^2 over the variance, j = 1 ..; share[0] is what the terms leave, counted as the next one */
} fw_scores;

/* depth: of a window at a score, not descending; mean and variance: its law's own. FW_E_ARG: not finite, negative, descending. */
fw_status fw_scores_make(fw_scores *out, double (*depth)(const void *self, double score), const void *self, double mean, double variance,
                         fw_msg *m);
/* Mean and variance alone, which is all that sums of independent windows (phi = 0) need. */
void      fw_scores_bare(fw_scores *out, double mean, double variance);
/* Correlation of the depths of two windows this far apart. 0 <= phi < 1. */
double fw_scores_correlation(const fw_scores *s, double phi, double lag);
/* Variance of a sum of n neighbouring windows, over that of one: n when phi = 0, n^2 when phi -> 1. */
double fw_scores_sum(const fw_scores *s, double phi, double n);

#endif
