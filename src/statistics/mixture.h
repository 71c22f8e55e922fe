/* The averaged CDF F(x) = sum over entries of weight * P(load * Y <= x), Y a random factor (scale.h), and its inverse.
 *
 * Entries are (load >= 0, weight >= 0) pairs: for a measuring point, every realisation's load on every arc that the
 * direction law can turn towards it. Loads of 0 make an atom of F at 0.
 * With a discrete factor all entries are kept and F is a step function, exact. With a continuous one, beyond 20000
 * entries neighbours within ln load of 1e-3 are joined at their weighted mean; the first-order error cancels and
 * what is left is below 1e-6 of a quantile (tested). */
#ifndef FW_STATISTICS_MIXTURE_H
#define FW_STATISTICS_MIXTURE_H

#include "statistics/scale.h"

typedef struct fw_mixture_entry {
    double load, weight;
} fw_mixture_entry;

typedef struct fw_mixture {
    const fw_scale   *scale;       /* borrowed */
    double            zero_weight; /* of the loads that are 0 */
    size_t            n;
    fw_mixture_entry *entries;    /* (n) loads > 0 ascending; load holds ln load when the factor is continuous; owned */
    double           *cumulative; /* (n + 1) weight of the first k entries, zero_weight included; owned */
} fw_mixture;

/* entries (n) are copied; weights are divided by their sum. FW_E_ARG: no weight at all, a load or weight that is
 * negative or not finite. */
fw_status fw_mixture_make(fw_mixture *out, const fw_scale *scale, size_t n, const fw_mixture_entry *entries, fw_msg *m);
void      fw_mixture_free(fw_mixture *x);
double    fw_mixture_cdf(const fw_mixture *x, double depth);
/* Smallest depth with F >= p; 0 when the atom at 0 reaches p; NAN when p is not in (0, 1]. */
double    fw_mixture_quantile(const fw_mixture *x, double p);

#endif
