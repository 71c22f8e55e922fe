/* Weights of the realisations that make up for the scenarios that happened to be drawn.
 *
 * Most of the scatter of a window's depth is that of its scenario (99.6 % on the default campaign), and the law of scenarios is known. So functions of the
 * scenario whose means over the law are known serve as control variates, by way of calibrated weights (statistics/calibrate.h): one set of
 * weights for every point, percentile, mean and moment. What is left to scatter is the ice, and what the functions do not follow.
 *
 * The functions: straight between K knots of the emulator's ln load (emulator.h), the knots at levels 1 - (1 - j/(K - 1))^2 of its law over scenarios,
 * closer towards the scenarios that wear most; K up to 12. A percentile asks P(depth <= x | scenario), and that is a smooth step in ln load. The emulator's load itself,
 * which means and moments go with. Then concentration and mix by themselves; with a joint table, whose cells have direction laws of their own, the knots' functions times the first two
 * harmonics of the cell's direction law. As many of them as there are 15 realisations for each.
 *
 * Measured on the default campaign: half-widths of P50 to P99 are those of 40 to 160 times as many realisations without it (README). A percentile of
 * a campaign with one scenario has nothing to gain, and is_on says so. */
#ifndef FW_STUDY_CONTROL_H
#define FW_STUDY_CONTROL_H

#include "floewear/campaign.h"
#include "statistics/calibrate.h"
#include "study/emulator.h"

typedef struct fw_control {
    bool           is_on, has_load; /* has_load: the emulator's load is one of the functions */
    fw_emulator    emulator;
    fw_calibration calibration; /* with is_on false: plain weights and the constant alone */
    double         least, most; /* calibrated over plain weights */
} fw_control;

/* law NULL: no control. strip: of the emulator; borrowed; may be NULL. scenarios, ring_load (mean over the ring, first answered law), plain (weights that sum to 1): (n), of the realisations that
 * did not fail; plain must outlive it. */
fw_status fw_control_make(fw_control *out, const fw_campaign *c, const fw_scenario_law *law, const fw_sanity *strip, size_t n, const fw_scenario *scenarios,
                          const double *ring_load, const double *plain, fw_msg *m);
void      fw_control_free(fw_control *x);

#endif
