/* The law of a positive random factor Y = a |T|^-m, T < 0 following a given distribution: what turns a
 * temperature-free wear load into depth. With T constant, or m without temperature, Y is a number.
 *
 * P(Y <= y) = P(T <= -(a/y)^(1/m)) is exact. Averaging it over a million loads needs a cheaper form: for a
 * continuous law the CDF is also tabulated over ln y (16384 nodes, linear between them; error below 1e-7, tested). */
#ifndef FW_STATISTICS_SCALE_H
#define FW_STATISTICS_SCALE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "floewear/distribution.h"

enum { FW_SCALE_NODES = 16384, FW_SCALE_MOMENTS = 3 };

typedef struct fw_scale {
    double                 coefficient, exponent;
    double                 moment[1 + FW_SCALE_MOMENTS]; /* E Y^k, k = 0..3 */
    bool                   is_discrete;
    size_t                 n;                       /* atoms, when discrete */
    double                *values;                  /* (n) ascending; owned */
    double                *weights;                 /* (n) sum to 1; owned */
    const fw_distribution *temperature;             /* borrowed */
    double                 ln_min, ln_max, ln_step; /* of ln y, when continuous */
    double                *table;                   /* (FW_SCALE_NODES + 1) P(Y <= y) at ln_min + k ln_step; owned */
} fw_scale;

/* temperature NULL: Y = coefficient. FW_E_ARG when T reaches 0 or more. The distribution must outlive the scale. */
fw_status fw_scale_make(fw_scale *out, double coefficient, double exponent, const fw_distribution *temperature,
                        fw_msg *m);
void      fw_scale_free(fw_scale *s);
double    fw_scale_cdf(const fw_scale *s, double y);      /* exact */
double    fw_scale_quantile(const fw_scale *s, double u); /* u in (0, 1) */

/* P(ln Y <= ln_y) of a continuous law from the table. */
static inline double fw_scale_cdf_ln(const fw_scale *s, double ln_y)
{
    double at = (ln_y - s->ln_min) / s->ln_step;
    if (!(at > 0)) return 0;
    if (at >= FW_SCALE_NODES) return 1;
    size_t k = (size_t)at;
    return s->table[k] + (at - (double)k) * (s->table[k + 1] - s->table[k]);
}

#endif
