/* The only list of effects. An effect that is off is absent from the kernel's set-up, so it costs nothing. */
#ifndef FW_EFFECTS_EFFECTS_H
#define FW_EFFECTS_EFFECTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/scenario.h"

typedef struct fw_effect {
    const char   *name;
    fw_effect_bit bit;
    const char   *does;   /* one line */
    const char   *needed; /* the sentence that says when a scene needs it */
    const char   *off;    /* what the scene is without it */
} fw_effect;

size_t           fw_effects_list(const fw_effect **effects);
const fw_effect *fw_effects_find(const char *name); /* NULL: unknown */

/* `effects: auto`: whether this model needs the effect, and why in words and numbers. */
bool     fw_effects_needed(const fw_effect *e, const fw_model *m, char *reason, size_t n_reason);
uint32_t fw_effects_auto(const fw_model *m); /* the set of those needed */

#endif
