/* The only list of effects: what each does, where it holds, and when a scene needs it.
 *
 * An effect that is off is absent from the kernel's set-up, so it costs nothing. Which are on is settled once, before a run: auto asks every row
 * whether the scene needs it, the user's words override, and the rows say which choices contradict each other or mean nothing. */
#ifndef FW_EFFECTS_EFFECTS_H
#define FW_EFFECTS_EFFECTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/scenario.h"

typedef struct fw_range {
    double low, high;
} fw_range;

/* What is known of the scenes before any of them is run; realisation/facts.h works it out. */
typedef struct fw_scene_facts {
    uint32_t given;         /* fw_given_bit set: keys that somebody wrote */
    size_t   n_floes;       /* of a scene; 0: a campaign, whose ice is a field */
    fw_range concentration; /* of a campaign [-]; 0 in a scene */
    fw_range speed;         /* of the current [m/s] */
    fw_range thickness;     /* of the floes [m] */
    fw_range diameter;      /* [m] */
    fw_range aspect;        /* thickness over radius [-] */
    fw_range wind_speed;    /* [m/s]; 0 without wind */
    double   encounters;    /* of a campaign: floes that a floe on the structure is expected to meet, at the highest concentration */
} fw_scene_facts;

enum { FW_REASON_SIZE = 200 };

typedef struct fw_effect {
    const char   *name;
    fw_effect_bit bit;
    const char   *does;     /* one line */
    const char   *equation; /* letters of the paper */
    const char   *source;
    const char   *range;  /* where it holds */
    const char   *limit;  /* the case with a known answer */
    const char   *needed; /* the sentence that says when a scene needs it */
    const char   *off;    /* what the scene is without it */
    /* `effects: auto`: whether these scenes need it; why (or why not) in words and numbers into reason (FW_REASON_SIZE). */
    bool (*is_needed)(const fw_model *m, const fw_scene_facts *f, char *reason);
    /* With m->effects settled: why this choice, on or off, contradicts a key that was given or means nothing, and at which key; NULL: it is fine. */
    const char *(*refuse)(const fw_model *m, const fw_scene_facts *f, const char **key);
} fw_effect;

size_t           fw_effects_list(const fw_effect *const **effects); /* (n) rows */
const fw_effect *fw_effects_find(const char *name);                 /* NULL: unknown */

/* The set of those that the scenes need. */
uint32_t    fw_effects_auto(const fw_model *m, const fw_scene_facts *f);
/* The first refusal of any row; NULL: none. key is a dotted path of the file ("contact.law"). */
const char *fw_effects_refuse(const fw_model *m, const fw_scene_facts *f, const char **key);

static inline bool fw_effects_have(const fw_model *m, fw_effect_bit bit) { return (m->effects & (uint32_t)bit) != 0; }
static inline bool fw_effects_given(const fw_scene_facts *f, fw_given_bit bit) { return (f->given & (uint32_t)bit) != 0; }

#endif
