/* A map of a file against its key table. */
#ifndef FW_CLI_READER_H
#define FW_CLI_READER_H

#include <stdint.h>

#include "base/keys.h"
#include "cli/yaml.h"

typedef struct fw_reader {
    const fw_units *units;
    const fw_node  *root;      /* where a section that is missing would stand */
    const char     *directory; /* table files are looked for here; "" : the current one */
    fw_msg         *m;
} fw_reader;

/* The folder that the files of path lie in; "" : the current one. */
void fw_reader_directory(const char *path, char *out, size_t size);

/* Read the plain keys of a section into base, defaults for what is absent, and check every name.
 *
 * path   what messages call the section ("ice.thickness_mixes[2]"); "" at the top
 * map    the section's node; NULL when it is absent
 * given  bit i set: key i of the table is in the file; may be NULL (tables have at most 64 keys)
 * Errors: FW_E_INPUT: no map, unknown key (the nearest is named), missing key, wrong value. */
fw_status fw_read_section(const fw_reader *r, const fw_section *s, const char *path, const fw_node *map, void *base,
                          uint64_t *given);
bool      fw_read_is_given(const fw_section *s, uint64_t given, const char *key);

/* A scalar's text; FW_E_INPUT when it is a list, a map or empty. */
fw_status fw_read_text(const fw_reader *r, const fw_node *n, const char *path, const char **text);
/* A scalar as a quantity in unit. */
fw_status fw_read_quantity(const fw_reader *r, const fw_node *n, const char *path, const char *unit, double *value);

/* "section.key" into out (size >= 96); parts that are too long are cut. */
void fw_read_path(char *out, size_t size, const char *section, const char *key);

#endif
