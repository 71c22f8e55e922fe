#include "cli/table_builder.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void fw_table_start(fw_table_builder *b, const char *name, size_t n_rows, fw_msg *m)
{
    memset(b, 0, sizeof *b);
    b->table = (fw_table){.name = name, .n_rows = n_rows, .columns = b->columns};
    b->m = m;
}

/* Space for one column; NULL after any failure, which the builder remembers. */
static void *add(fw_table_builder *b, const char *name, const char *unit, const char *long_name, size_t size)
{
    void *array = NULL;
    if (b->status == FW_OK && b->table.n_columns == FW_TABLE_COLUMNS)
        b->status = fw_fail(b->m, FW_E_INTERNAL, "table %s has more than %d columns", b->table.name,
                            (int)FW_TABLE_COLUMNS);
    if (b->status == FW_OK) b->status = fw_alloc(&array, b->table.n_rows, size, name, b->m);
    if (b->status != FW_OK) return NULL;
    b->arrays[b->table.n_columns] = array;
    b->columns[b->table.n_columns++] = (fw_column){.name = name, .unit = unit, .long_name = long_name};
    return array;
}

void fw_table_numbers(fw_table_builder *b, const char *name, const char *unit, const char *long_name, const void *rows,
                      size_t stride, size_t offset)
{
    double *to = add(b, name, unit, long_name, sizeof *to);
    for (size_t i = 0; to && i < b->table.n_rows; i++)
        memcpy(&to[i], (const char *)rows + i * stride + offset, sizeof *to);
    if (to) b->columns[b->table.n_columns - 1].number = to;
}

void fw_table_counts(fw_table_builder *b, const char *name, const char *long_name, const void *rows, size_t stride,
                     size_t offset)
{
    int64_t *to = add(b, name, "1", long_name, sizeof *to);
    for (size_t i = 0; to && i < b->table.n_rows; i++) {
        size_t count;
        memcpy(&count, (const char *)rows + i * stride + offset, sizeof count);
        to[i] = (int64_t)count;
    }
    if (to) b->columns[b->table.n_columns - 1].integer = to;
}

const char **fw_table_texts(fw_table_builder *b, const char *name, const char *long_name)
{
    const char **to = add(b, name, "1", long_name, sizeof *to);
    if (to) b->columns[b->table.n_columns - 1].text = to;
    return to;
}

double *fw_table_number_column(fw_table_builder *b, const char *name, const char *unit, const char *long_name)
{
    double *to = add(b, name, unit, long_name, sizeof *to);
    if (to) b->columns[b->table.n_columns - 1].number = to;
    return to;
}

void fw_table_free(fw_table_builder *b)
{
    for (size_t k = 0; k < b->table.n_columns; k++) free(b->arrays[k]);
    memset(b, 0, sizeof *b);
}
