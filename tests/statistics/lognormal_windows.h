/* Windows of lognormal depth, median 1 and CV 1.5, as a function of their score: the law whose copula has a closed form. */
#ifndef FW_TESTS_STATISTICS_LOGNORMAL_WINDOWS_H
#define FW_TESTS_STATISTICS_LOGNORMAL_WINDOWS_H

#include "statistics/near.h"
#include "statistics/scores.h"

static inline double lognormal_depth(const void *self, double score)
{
    (void)self;
    return exp(lognormal_sigma(1.5) * score);
}

static inline void lognormal_scores(fw_scores *s)
{
    double s2 = log(3.25); /* ln(1 + CV^2) */
    assert_int_equal(fw_scores_make(s, lognormal_depth, NULL, exp(s2 / 2), exp(2 * s2) - exp(s2), NULL), FW_OK);
}

#endif
