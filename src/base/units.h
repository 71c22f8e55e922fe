/* Quantities "number unit" by UDUNITS-2, read strictly.
 *
 * A quantity is a decimal number and a unit; the space between may be missing ("2h"). Beyond UDUNITS: `deg` is the
 * angular degree, `year` is 365.25 d (UDUNITS means the tropical year of 365.242 d), and compact products as
 * engineers write them (kNs, kNm) are known. Stricter than UDUNITS: NaN, Inf, hexadecimal, overflow and underflow
 * are refused, so are scales and offsets inside a unit ("m 3", "m @ 2"); an angle is no plain number: `deg` is
 * wanted where an angle is, and nowhere else. */
#ifndef FW_BASE_UNITS_H
#define FW_BASE_UNITS_H

#include "floewear/status.h"

typedef struct fw_units fw_units;

/* Loads the unit database that UDUNITS was installed with. FW_E_IO when it is missing. Silences UDUNITS's own
 * printing. */
fw_status fw_units_open(fw_units **out, fw_msg *m);
void      fw_units_close(fw_units *u); /* NULL is fine */

/* Read text as a quantity in `unit`.
 *
 * unit     what *value is given in: "m", "N/m", "deg", "1" (then the text may be bare or in %), "degC" (a
 *          temperature: the offset of a scale counts) or "K" (a difference of temperatures: 1.8 K and 1.8 degC are
 *          the same)
 * Errors:  FW_E_INPUT with a sentence that starts with the text in quotes: no number, no unit, wrong unit, trailing
 *          junk, not finite. *value is then untouched. */
fw_status fw_units_read(const fw_units *u, const char *text, const char *unit, double *value, fw_msg *m);

/* A bare decimal number, nothing behind it but blanks. */
fw_status fw_units_number(const char *text, double *value, fw_msg *m);

#endif
