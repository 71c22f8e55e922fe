/* How a law that is not known well moves depths: one draw of the law is one factor on every depth of a point, the same over a whole life.
 *
 *     factor = scatter x coefficient x E D(exponent) / E D(exponent of the first law)
 *
 * with the mean depth E D at other exponents from the campaign's further laws of the same temperature use: their loads are in the records.
 * Between two laws ln(E D / coefficient) is taken as straight in the exponent; it is convex, so that the factor is overestimated between
 * laws, by about (variance of ln pressure over the wear) x (distance of the two)^2 / 8 at most. Percentiles are taken to move like means.
 *
 * Draws are a Latin hypercube, the same for every point. They belong to the first law: with another one asked for, n is 0. */
#ifndef FW_STUDY_LAW_FACTOR_H
#define FW_STUDY_LAW_FACTOR_H

#include "study/answer.h"

typedef struct fw_law_factor {
    size_t  n;        /* draws; 0: nothing is said of the law */
    double *common;   /* (n) scatter x coefficient; owned */
    double *exponent; /* (n) or NULL: known; owned */
    size_t  n_nodes;
    double  node[FW_MAX_LAWS]; /* exponents of the campaign's laws, ascending */
    double  own;               /* of the first law */
    double *ln_mean;           /* (n_points x n_nodes) ln of mean depth over coefficient, -INFINITY where nothing wore; owned */
} fw_law_factor;

/* The records are read once more for every law with an exponent of its own, and only when the exponent is uncertain.
 * bearings (n_points) [deg]. FW_E_ARG: an exponent beyond the laws'. */
fw_status fw_law_factor_make(fw_law_factor *out, const fw_campaign *c, const fw_answer_source *source, size_t law, size_t n_points,
                             const double *bearings, size_t n_draws, fw_msg *m);
void      fw_law_factor_free(fw_law_factor *f);
/* Factors of the ith of the points; out (n). */
void      fw_law_factor_of_point(const fw_law_factor *f, size_t i, double *out);

#endif
