/* When a campaign may ask whether it is precise enough: n0 = 100 realisations, then half as many again each time,
 * and at the end. Looking after every record would stop on a lucky streak far too often; a geometric schedule keeps
 * the number of looks (and so the loss of coverage) at log(n) and never overshoots the need by more than half. */
#ifndef FW_CAMPAIGN_LOOKS_H
#define FW_CAMPAIGN_LOOKS_H

#include <stdint.h>

uint64_t fw_looks_first(uint64_t max);               /* min(100, max) */
uint64_t fw_looks_next(uint64_t look, uint64_t max); /* min(1.5 look rounded half up, max); max stays max */

#endif
