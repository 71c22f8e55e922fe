/* Abrasion laws: depth per sliding path as a power of contact pressure. A law is a row of this table. */
#ifndef FW_PHYSICS_ABRASION_H
#define FW_PHYSICS_ABRASION_H

#include <stddef.h>

#include "floewear/scenario.h"

typedef struct fw_abrasion_entry {
    fw_abrasion_law law;
    const char     *equation, *source, *range, *remark;
} fw_abrasion_entry;

size_t                 fw_abrasion_list(const fw_abrasion_entry **entries);
const fw_abrasion_law *fw_abrasion_find(const char *name); /* NULL: unknown */

/* fw_abrasion_rate (declared in floewear/scenario.h): factor from wear load [MPa^m km] to depth [mm]. */

#endif
