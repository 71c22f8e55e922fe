/* Inside the store only: what every file of a campaign begins with, finished tables, and the open file that they are read from. */
#ifndef FW_STORE_TABLES_PUT_H
#define FW_STORE_TABLES_PUT_H

#include "store/h5_data.h"
#include "store/results.h"
#include "store/tables.h"

struct fw_tables {
    fw_h5_file file;
    char      *settings;
};

/* Root attributes: origin, name, campaign, sets, settings, settings_hash, seed. */
fw_status fw_tables_put_root(const fw_h5_file *f, const char *filetype, uint64_t version, const fw_campaign *c,
                             fw_msg *m);
fw_status fw_tables_put(const fw_h5_file *f, const fw_table *t, fw_msg *m);

#endif
