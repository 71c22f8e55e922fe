/* Inside the kernel: who is near whom, listed with a skin and listed anew when somebody may have crossed it. */
#ifndef FW_KERNEL_NEIGHBOURS_H
#define FW_KERNEL_NEIGHBOURS_H

#include "kernel/kernel.h"

typedef struct fw_near {
    int32_t i, j; /* awake floes i < j, or j = FW_WALL */
} fw_near;

typedef struct fw_sleeper_near {
    int32_t i;          /* awake floe, or FW_WALL */
    size_t  block, row; /* of the untouched floe */
} fw_sleeper_near;

typedef struct fw_neighbours {
    fw_near         *near;
    size_t           n_near, near_capacity; /* ordered by (i, j), structure last */
    fw_sleeper_near *sleepers;
    size_t           n_sleepers, sleeper_capacity;
    fw_cells         cells;
    double           drift_listed[2]; /* of the world when listed */
    uint64_t         blocks_listed; /* the world's block_changes then */
    bool             is_valid;
} fw_neighbours;

void      fw_neighbours_free(fw_neighbours *n);
bool      fw_neighbours_is_stale(const fw_neighbours *n, const fw_setup *s, const fw_world *w, double macro_time);
fw_status fw_neighbours_list(fw_neighbours *n, const fw_setup *s, fw_world *w, fw_msg *m);

#endif
