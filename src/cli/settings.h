/* The canonical text of everything that shapes a campaign's records. */
#ifndef FW_CLI_SETTINGS_H
#define FW_CLI_SETTINGS_H

#include "cli/tables.h"
#include "floewear/campaign.h"

/* "key = value unit\n" lines in a fixed order, numbers with %.17g in the key table's units, into c->settings
 * (owned), and their FNV-1a 64 into c->hash.
 *
 * In:  the generation of the program's records, structure.diameter, ice, current, contact, water, effects, the laws' exponents, exposure, field, ring,
 *      numerics as far as they are given, accuracy, seed; what an effect acts with while it is on. Out: what enters after the runs (measuring points, temperature, direction of single laws,
 *      coefficients, precision, service) and names. A joint table counts whole, directions too, because its cells
 *      are numbered. */
fw_status fw_settings_make(fw_campaign *c, const fw_values *v, fw_msg *m);

#endif
