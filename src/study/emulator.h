/* What a window's wear is by its scenario alone: ln(mean wear load round the ring) by least squares on
 *
 *   1, ln L, ln C, (ln C)^2, ln u, (ln u)^2, ln u ln C, thickness mix, mix x ln C, and with wind or tide their speed, angle and phase
 *
 * u the current's speed, C the concentration, L the load of the swept strip (sanity.h), which knows the mix and the laws of single hits. Depth
 * goes nearly as u^3 C^1.5, over six decades on the default campaign, of which this leaves a scatter of 15 % (the ice, and what a quadratic misses). It orders scenarios by how much they wear: sampling designs and control variates (control.h) are made
 * from it. No depth is read off it: what it misses costs precision, never truth. */
#ifndef FW_STUDY_EMULATOR_H
#define FW_STUDY_EMULATOR_H

#include "floewear/campaign.h"
#include "study/sanity.h"

enum { FW_EMULATOR_FUNCTIONS = 48 };

typedef struct fw_emulator {
    const fw_campaign *campaign; /* borrowed */
    const fw_sanity   *strip;    /* borrowed; NULL: none */
    size_t n, n_functions;       /* windows with wear that it was fitted to; functions taken: at most n / 4 */
    double coefficient[FW_EMULATOR_FUNCTIONS];
    double scatter;       /* standard deviation of ln load about all its values' mean */
    double held_out;      /* r.m.s. error of ln load on windows that were not fitted to: ten times a tenth of them */
    double dry_share;     /* of the windows without any wear, which it does not know of */
} fw_emulator;

/* scenarios (n), load (n): mean over the ring [MPa^m km]. strip: NULL, or one that is there. With fewer than 12 windows that wore n_functions is 0:
 * nothing is known. */
fw_status fw_emulator_fit(fw_emulator *out, const fw_campaign *c, const fw_sanity *strip, size_t n, const fw_scenario *scenarios, const double *load, fw_msg *m);
double    fw_emulator_ln_load(const fw_emulator *e, const fw_scenario *s);

#endif
