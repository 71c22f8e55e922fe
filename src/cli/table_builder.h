/* From rows to the columns of a finished table (store/results.h): each column an array of its own, owned by the builder until
 * the file is written. Errors are remembered, so that a table is built without a check after every column. */
#ifndef FW_CLI_TABLE_BUILDER_H
#define FW_CLI_TABLE_BUILDER_H

#include <stddef.h>

#include "store/results.h"

enum { FW_TABLE_COLUMNS = 32 };

typedef struct fw_table_builder {
    fw_table  table;
    fw_column columns[FW_TABLE_COLUMNS];
    void     *arrays[FW_TABLE_COLUMNS];
    fw_status status; /* the first failure; then table must not be used */
    fw_msg   *m;
} fw_table_builder;

/* Must stay where it is until the table is written: table points into it. */
void fw_table_start(fw_table_builder *b, const char *name, size_t n_rows, fw_msg *m);
void fw_table_free(fw_table_builder *b);

/* One member of every row; stride and offset say where it lies. */
void fw_table_numbers(fw_table_builder *b, const char *name, const char *unit, const char *long_name, const void *rows,
                      size_t stride, size_t offset);
void fw_table_counts(fw_table_builder *b, const char *name, const char *long_name, const void *rows, size_t stride,
                     size_t offset);
/* A column for the caller to fill; NULL after any failure. Texts are borrowed. */
const char **fw_table_texts(fw_table_builder *b, const char *name, const char *long_name);
double      *fw_table_number_column(fw_table_builder *b, const char *name, const char *unit, const char *long_name);

#define FW_TABLE_NUMBERS(b, rows, type, member, unit, long_name)                                                       \
    fw_table_numbers((b), #member, (unit), (long_name), (rows), sizeof(type), offsetof(type, member))
#define FW_TABLE_COUNTS(b, rows, type, member, long_name)                                                              \
    fw_table_counts((b), #member, (long_name), (rows), sizeof(type), offsetof(type, member))

#endif
