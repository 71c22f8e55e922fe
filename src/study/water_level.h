/* Where over height the wear of a campaign lies, from the statistics of the water level: tide, surge, seiches.
 *
 *      z  |                              Ice of thickness h floats rho_i/rho_w h deep. It touches the wall from level - draft to
 *         |====.  <- level + freeboard   level + freeboard, and at no other height, so that of a window's depth on its wall line
 *         |    |
 *      ~~~|~~~~|~~~~ level               depth(z) = depth x P(level - draft <= z <= level + freeboard)
 *         |    |
 *         |===='  <- level - draft       stays at height z. The share of a campaign is the mean over its windows, weighted by
 *         |                              their load at the point, with h the mean thickness of what wore in each.
 *
 * Exact for windows of one thickness through which the level runs its law; a window shorter than a tide sees one level, and its own share at
 * a height is then nearer to 0 or 1: percentiles over windows at a height scatter more than this share tells, means over many do not. */
#ifndef FW_STUDY_WATER_LEVEL_H
#define FW_STUDY_WATER_LEVEL_H

#include "floewear/distribution.h"
#include "floewear/status.h"

enum { FW_WATER_LEVEL_HEIGHTS = 221 };

typedef struct fw_water_level {
    size_t n;                     /* heights; 0: not asked for, or nothing wore */
    double height[FW_WATER_LEVEL_HEIGHTS]; /* (n) above the mean level, evenly [m] */
    double share[FW_WATER_LEVEL_HEIGHTS];  /* (n) of a window's depth at that height */
    double thickness;             /* mean of the floes that wore, weighted by load [m] */
    double most_height;           /* where most wears: the middle when it is a range [m] */
    double most_share;            /* of a window's depth there */
    double band_low, band_high;   /* carry 90 % of the wear between them, 5 % lie beyond either [m] */
} fw_water_level;

/* thickness, weight (n): of the windows; afloat: density of the ice over that of the water, below 1. */
fw_status fw_water_level_make(fw_water_level *out, const fw_distribution *level, double afloat, size_t n, const double *thickness,
                              const double *weight, fw_msg *m);

/* The share of a window's depth that stays at each of the heights [m]; shares (n_heights), 0 where nothing wore. */
fw_status fw_water_level_shares(const fw_distribution *level, double afloat, size_t n, const double *thickness, const double *weight,
                                size_t n_heights, const double *heights, double *shares, fw_msg *m);

#endif
