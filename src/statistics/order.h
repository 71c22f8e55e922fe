/* Percentiles of a sample and their order-statistic intervals. */
#ifndef FW_STATISTICS_ORDER_H
#define FW_STATISTICS_ORDER_H

#include <stddef.h>

typedef struct fw_interval {
    double low, high; /* an end that does not exist is NAN */
    double coverage;  /* of the interval as it stands, a missing end read as "no bound"; NAN: no interval at all */
} fw_interval;

/* Percentile at level p (0..1) of n ascending numbers: linear between order statistics at rank 1 + (n - 1) p (type 7 of
 * Hyndman and Fan 1996, what numpy, R and spreadsheets do when nothing else is said). NAN when n = 0 or p is not in
 * [0, 1]. */
double fw_order_percentile(size_t n, const double *sorted, double p);

/* Two-sided interval [x_(l), x_(u)] of the p-quantile, free of any assumption but independence: l is the largest
 * rank with P(Bin(n, p) < l) <= (1 - confidence)/2, u the smallest one with P(Bin(n, p) >= u) <= (1 - confidence)/2.
 * Where no such rank exists there is no end: at 95 % the upper end of P90 needs n >= 36, of P95 72, of P99 368.
 * coverage = P(l <= Bin < u).
 *
 * n_failed realisations have no value but must not be dropped (hard runs are the wearing ones): the lower end counts
 * them as 0, below all n values, the upper end as +infinity, above them; n + n_failed is the sample size of both. */
fw_interval fw_order_interval(size_t n, const double *sorted, size_t n_failed, double p, double confidence);

#endif
