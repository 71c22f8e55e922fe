/* Inside the kernel only: an untouched floe becomes an awake one that still drifts freely. */
#ifndef FW_KERNEL_WAKE_H
#define FW_KERNEL_WAKE_H

#include "kernel/kernel.h"

fw_status fw_wake(const fw_setup *s, fw_world *w, size_t block, size_t row, fw_msg *m);

#endif
