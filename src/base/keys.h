/* Key tables: what a section of an input file may say, in one place that parses, checks, documents and prints it
 * back.
 *
 * A section is a table of keys over a plain struct; every key names its kind, unit, default, range and meaning and
 * the member's offset. Nested shapes (lists, distributions) have rows too, so that names are checked and documented
 * from the same table; their own readers read them. */
#ifndef FW_BASE_KEYS_H
#define FW_BASE_KEYS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/units.h"
#include "floewear/status.h"

enum { FW_KEY_TEXT_SIZE = 64 };

typedef enum fw_key_kind {
    FW_KEY_NUMBER, /* double in `unit` */
    FW_KEY_AUTO,   /* double in `unit`, or the word auto (another one in `words`): -1 */
    FW_KEY_COUNT,  /* uint64_t */
    FW_KEY_FLAG,   /* bool: on, off, true, false, yes, no */
    FW_KEY_CHOICE, /* int: the place of the word in `words` */
    FW_KEY_TEXT,   /* char[FW_KEY_TEXT_SIZE] */
    FW_KEY_SHAPED  /* a list, a map or a distribution with a reader of its own; `words` says what it looks like */
} fw_key_kind;

typedef struct fw_key {
    const char *name;
    fw_key_kind kind;
    size_t      offset;   /* of the member; unused when SHAPED */
    const char *unit;     /* of member and range; NULL: none */
    const char *fallback; /* the default as a file would say it; NULL: must be given; "": may be left out */
    double      least, most;
    bool        is_open;  /* least itself is refused */
    const char *words;    /* choices "number|area"; of an AUTO its word; for SHAPED its shape */
    const char *meaning;
} fw_key;

typedef struct fw_section {
    const char   *name; /* dotted, "" for the top level */
    const char   *meaning;
    size_t        n_keys;
    const fw_key *keys;
} fw_section;

/* NULL when the section has no such key. */
const fw_key *fw_keys_find(const fw_section *s, const char *name);
/* The key of the section that a wrong name is nearest to; NULL when none is near enough to be meant. */
const char   *fw_keys_nearest(const fw_section *s, const char *wrong);
/* The same for any words: (n) names. */
const char   *fw_keys_nearest_word(size_t n, const char *const *names, const char *wrong);

/* Parse and check text into base's member. FW_E_INPUT: the sentence quotes text and names the wanted range and unit. */
fw_status fw_keys_read(const fw_key *k, const fw_units *u, const char *text, void *base, fw_msg *m);
/* Every key that has a default takes it. */
fw_status fw_keys_defaults(const fw_section *s, const fw_units *u, void *base, fw_msg *m);
/* "more than 0 m and at most 100 m"; empty when any value will do. */
void      fw_keys_range(const fw_key *k, char *out, size_t size);
/* Canonical line "contact.stiffness = 2000000 N/m\n" (%.17g, so that a reader gets the same double back) of one key
 * that is not SHAPED. Returns the length as snprintf does. */
int       fw_keys_print(const fw_section *s, const fw_key *k, const void *base, char *out, size_t size);

#endif
