#include "abrasion/power.h"

void fw_power_init(fw_power *t, double m)
{
    t->m = m;
    double c = 1;
    for (int k = 0; k < 4; k++) t->c[k] = c *= (m - k) / (k + 1);
    for (int b = 0; b < FW_POWER_BINS; b++) {
        t->inverse[b] = 1 / (1 + (b + 0.5) / FW_POWER_BINS);
        t->bin[b] = pow(1 / t->inverse[b], m);
    }
    for (int k = 0; k < FW_POWER_OCTAVES; k++) t->octave[k] = pow(2, m * (k + FW_POWER_LOWEST));
}
