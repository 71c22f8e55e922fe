/* The strata of a site's scenarios: the cells of its joint table, else bins of speed x bins of concentration x thickness mixes.
 *
 * A bin is a range of the law's quantile level, [low, high). Speed has eight (none where it is constant), finer towards fast currents, because depth
 * goes as its cube and design percentiles lie in the tail. A concentration of at most MOST_VALUES values has a bin for each, so that a
 * stratum is one condition; else four. The order of strata, and so the meaning of an allocation's numbers: speed, then concentration, then mix. */
#ifndef FW_CAMPAIGN_STRATA_H
#define FW_CAMPAIGN_STRATA_H

#include "floewear/campaign.h"

typedef struct fw_bins {
    size_t n;
    double edge[33]; /* (n + 1) quantile levels from 0 to 1 */
} fw_bins;

typedef struct fw_strata {
    size_t         n;
    fw_bins        speed, concentration, mix; /* unused with a joint table */
    const fw_site *site;                      /* borrowed */
} fw_strata;

void   fw_strata_make(fw_strata *out, const fw_model *m, const fw_site *s);
double fw_strata_share(const fw_strata *s, size_t stratum); /* of time; they sum to 1 */
/* The stratum of a scenario of this site. */
size_t fw_strata_find(const fw_strata *s, const fw_scenario *sc);
/* Quantile levels of stratum's bins at a point (speed, concentration) of the unit square, and its mix. No joint table. */
void   fw_strata_place(const fw_strata *s, size_t stratum, double at_speed, double at_concentration, double *u_speed, double *u_concentration,
                       uint32_t *mix);

#endif
