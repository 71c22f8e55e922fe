/* The integrators: stiffly accurate ESDIRK methods (explicit first stage, one diagonal value), L-stable, stage order 2.
 *
 * Why implicit: the stiffest mode of a structure contact is slip, 6 w, and a floe stays pressed on the structure for
 * some 200 / w; beyond its step limit an explicit scheme does not blow up, its friction chatters and wear is silently too large.
 * Why this family: every stage is the same small solve, the error estimate costs nothing, and steps grow after a touch by themselves. */
#ifndef FW_KERNEL_METHOD_H
#define FW_KERNEL_METHOD_H

#include <stddef.h>

enum { FW_MAX_STAGES = 6 };

typedef struct fw_method {
    const char *name, *source;
    size_t      n_stages;
    int         order, error_order; /* error estimate ~ h^error_order */
    double      gamma;              /* diagonal */
    double      a[FW_MAX_STAGES][FW_MAX_STAGES];
    double      c[FW_MAX_STAGES];
    double      b[FW_MAX_STAGES]; /* equals the last row of a */
    double      e[FW_MAX_STAGES]; /* b minus the embedded weights */
} fw_method;

extern const fw_method *const FW_METHOD_TRBDF2; /* order 2, 2 evaluations a step */
extern const fw_method *const FW_METHOD_ARK3;   /* order 3, 3 evaluations a step */
extern const fw_method *const FW_METHOD_ARK4;   /* order 4, 5 evaluations a step */

#endif
