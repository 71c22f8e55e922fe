/* Tables of numbers in a text file: a line of column names, then one row a line.
 *
 * A name may carry a unit, `speed [m/s]`, for the bare numbers below it; without one they are in the column's own
 * unit. A cell may carry its own unit too (`40 %`). Commas part the fields; blank lines and lines that begin with #
 * are skipped. Bounds: 4 MiB, 20000 rows. */
#ifndef FW_CLI_CSV_H
#define FW_CLI_CSV_H

#include "cli/reader.h"

enum { FW_CSV_MAX_BYTES = 4 << 20, FW_CSV_MAX_ROWS = 20000, FW_CSV_MAX_COLUMNS = 8 };

typedef struct fw_csv_column {
    const char *name, *unit;
    bool        is_optional;
} fw_csv_column;

typedef struct fw_csv {
    char    path[512];               /* as opened */
    size_t  n_rows, n_columns;
    bool    has[FW_CSV_MAX_COLUMNS]; /* whether the file has the column */
    double *cells;                   /* (n_rows, n_columns) row-major, columns' units, 0 where absent; owned */
    size_t *line;                    /* (n_rows) in the file, from 1, owned */
} fw_csv;

/* file is taken from the reader's directory unless it is absolute; at is the node that names it.
 * FW_E_IO: unreadable; FW_E_INPUT "file:line: ...". *out is then empty. */
fw_status fw_csv_read(const fw_reader *r, const fw_node *at, const char *path, const char *file, size_t n_columns,
                      const fw_csv_column *columns, fw_csv *out);
void      fw_csv_free(fw_csv *t);

#endif
