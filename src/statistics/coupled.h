/* What a cheap model is worth beside a dear one, from pairs: the same realisations computed both ways.
 *
 * A mean over realisations is wanted. Let the dear value e_i scatter with variance V, a cheap value d_i of the same realisation correlate with it by
 * rho, and cost a w-th. Many cheap values and few dear ones give the mean of e as
 *
 *     mean over few (e - a d) + a mean over many d                           (multifidelity; a the regression's slope)
 *
 * which for the best division of a budget has a variance smaller than that of the dear values alone by the factor
 *
 *     gain = 1 / (sqrt(1 - rho^2) + sqrt(rho^2 / w))^2                       (Peherstorfer, Willcox and Gunzburger 2016, two models)
 *
 * At rho = 1 that is w; with a cheap value for nothing 1 / (1 - rho^2); below 1 the dear values do better alone. Multilevel estimates (Giles 2015)
 * take a = 1 and other realisations for the cheap mean:
 *
 *     gain = V c / (sqrt(V_d c_d) + sqrt(V_(e-d) (c + c_d)))^2
 *
 * Giles's checks: the kurtosis of the difference e - d, which says whether its variance can be known from so few pairs; and whether mean e - mean d
 * is mean (e - d) within three standard errors of each, here on a third of the pairs each, so that the three are independent.
 *
 * Intervals come from resampling whole pairs with their costs (paired.h): percentiles of 999 gains. Values that are residuals of a regression are
 * resampled as they are: what the regression's own coefficients scatter is not in it. Coverage of intervals of 95 %, counted in 1000 repeats
 * (tests/statistics/test_coupled.c), w = 10: normal pairs 93.6 to 95.7 % at 128 and 384 pairs, rho 0.5 and 0.95; exponentials of such 91 to 96 %. */
#ifndef FW_STATISTICS_COUPLED_H
#define FW_STATISTICS_COUPLED_H

#include "statistics/paired.h"

typedef struct fw_coupled_pairs {
    size_t        n;
    const double *dear, *cheap;           /* (n) values about 0, each times n and the realisation's weight; borrowed */
    const double *dear_cost, *cheap_cost; /* (n); borrowed */
} fw_coupled_pairs;

typedef struct fw_gain {
    double gain, low, high; /* NAN: the dear values do not scatter */
} fw_gain;

typedef struct fw_coupled {
    double  cost_ratio;  /* sum of dear costs over cheap ones; INFINITY: for nothing */
    double  correlation; /* about 0; 0 when either does not scatter */
    fw_gain multifidelity, multilevel; /* of the mean's variance at equal cost */
    double  kurtosis;    /* of dear - cheap; 1 when they never differ */
    double  most_kurtosis; /* 100 (Giles), and n/4: beyond that fewer than four pairs carry the variance */
    double  consistency; /* abs(mean dear - mean cheap - mean difference) / (3 (standard errors)); wanted below 1 */
} fw_coupled;

/* gain of two models in closed form; w INFINITY: the cheap one is for nothing. */
double fw_coupled_gain(double rho, double w);

/* draws: of n pairs. FW_E_NOMEM. */
fw_status fw_coupled_compare(const fw_coupled_pairs *x, const fw_paired_draws *draws, double confidence, fw_coupled *out, fw_msg *m);

#endif
