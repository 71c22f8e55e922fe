/* HDF5's virtual file driver onto an open file descriptor that never fails a write; see h5_file.h for why. */
#ifndef FW_STORE_H5_DRIVER_H
#define FW_STORE_H5_DRIVER_H

#include "store/h5_file.h"

hid_t  fw_h5_driver_register(void); /* < 0 on error; H5FDunregister when done */
/* Make a file access list use it on disk, which must live longer than the file. */
herr_t fw_h5_driver_use(hid_t access_list, hid_t driver, fw_h5_disk *disk);

#endif
