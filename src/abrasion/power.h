/* p^m for one fixed m and many p > 0, within 1e-12: a table of powers and a short series between its entries.
 *
 * A law's p^m was a quarter of the wear's time as log and exp, which wait for one another; this is two loads and a quartic. */
#ifndef FW_ABRASION_POWER_H
#define FW_ABRASION_POWER_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { FW_POWER_BINS = 64, FW_POWER_OCTAVES = 128, FW_POWER_LOWEST = -64 };

typedef struct fw_power {
    double m, c[4];                  /* series (1 + e)^m = 1 + c[0] e + ... */
    double inverse[FW_POWER_BINS];   /* 1 / middle of the bin of [1, 2) */
    double bin[FW_POWER_BINS];       /* middle^m */
    double octave[FW_POWER_OCTAVES]; /* 2^(m k), k from FW_POWER_LOWEST */
} fw_power;

void fw_power_init(fw_power *t, double m);

static inline double fw_power_of(const fw_power *t, double p)
{
    uint64_t bits, one = (uint64_t)1023 << 52;
    memcpy(&bits, &p, sizeof bits);
    size_t k = (size_t)(bits >> 52) - (size_t)(1023 + FW_POWER_LOWEST), b = bits >> 46 & (FW_POWER_BINS - 1);
    if (k >= FW_POWER_OCTAVES) return pow(p, t->m); /* 5e-20 Pa, 2e19 Pa, or no number */
    bits = (bits & (((uint64_t)1 << 52) - 1)) | one;
    double x;
    memcpy(&x, &bits, sizeof x);
    double e = x * t->inverse[b] - 1; /* at most 1/129: what the series leaves out is below 0.03 e^5 */
    return t->octave[k] * t->bin[b] * (1 + e * (t->c[0] + e * (t->c[1] + e * (t->c[2] + e * t->c[3]))));
}

#endif
