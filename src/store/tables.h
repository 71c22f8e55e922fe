/* Files of finished tables (NAME.accuracy.h5, NAME.effects.h5, NAME.plan.h5), and single tables read back from them or from NAME.h5.
 *
 * Root attributes, groups, units and long_name as in NAME.h5 (store/results.h); sealed and renamed like it. */
#ifndef FW_STORE_TABLES_H
#define FW_STORE_TABLES_H

#include "store/results.h"

#define FW_ACCURACY_FILETYPE "floewear accuracy"
#define FW_EFFECTS_FILETYPE  "floewear effects"
#define FW_PLAN_FILETYPE     "floewear plan"

/* Another kind of file under this name is somebody's work: FW_E_MISMATCH. */
fw_status fw_tables_check_kind(const char *path, const char *filetype, fw_msg *m);
/* FW_E_IO: unwritable, disk full, in use; FW_E_MISMATCH: path is there and is another kind of file. On error path is as it was. */
fw_status fw_tables_write(const char *path, const char *filetype, const fw_campaign *c, size_t n_tables,
                          const fw_table *tables, fw_msg *m);

typedef struct fw_tables fw_tables;
/* filetype: what the file has to be; NULL: any of ours. FW_E_IO, FW_E_FORMAT as fw_results_open. */
fw_status                fw_tables_open(fw_tables **out, const char *path, const char *filetype, fw_msg *m);
void                     fw_tables_close(fw_tables *t);          /* NULL is fine */
const char              *fw_tables_settings(const fw_tables *t); /* of the campaign that the file belongs to */
bool                     fw_tables_has(const fw_tables *t, const char *table);
/* One column of a table, NULL-safe to free by the caller: numbers (n), or NUL-terminated texts of *width bytes each (n x width).
 * FW_E_FORMAT: missing, of another type, or longer than most rows. */
fw_status fw_tables_numbers(const fw_tables *t, const char *table, const char *column, size_t most, size_t *n,
                            double **values, fw_msg *m);
fw_status fw_tables_texts(const fw_tables *t, const char *table, const char *column, size_t most, size_t *n,
                          size_t *width, char **texts, fw_msg *m);

#endif
