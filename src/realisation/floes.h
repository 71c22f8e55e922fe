/* The floes of a thickness mix, for those who run floes and do not make fields. */
#ifndef FW_REALISATION_FLOES_H
#define FW_REALISATION_FLOES_H

#include "floewear/scenario.h"

typedef struct fw_floe_mix {
    size_t n;                            /* thickness classes */
    double thickness[FW_MAX_CLASSES];    /* (n) [m] */
    double share[FW_MAX_CLASSES];        /* (n) of the floes, by number */
    double mean_diameter, mean_area;     /* E[D] [m], E[pi D^2 / 4] [m2], over all floes */
} fw_floe_mix;

/* diameter: (n classes, n_at): below it lies the share at[j], in (0, 1), of the floes of its class [m]. FW_E_ARG: no such sizes. */
fw_status fw_floes_of_mix(const fw_model *model, size_t mix, size_t n_at, const double *at, fw_floe_mix *out, double *diameter, fw_msg *m);

#endif
