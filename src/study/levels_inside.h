/* Inside the pilot of levels only: the ways that its windows are run. */
#ifndef FW_STUDY_LEVELS_INSIDE_H
#define FW_STUDY_LEVELS_INSIDE_H

#include "study/depth.h"
#include "study/levels.h"

/* A way of computing windows; windows that failed in any of them are in none. */
typedef struct fw_levels_way {
    fw_levels_row *row;   /* NULL: the campaign's own way */
    fw_model       model; /* borrows what the campaign's owns */
    bool           is_strip;
    fw_depth       depth; /* owned */
    double        *cpu_s, evaluations; /* (n windows) owned; their sum */
} fw_levels_way;

/* Fills the ways' rows from pairs with own, whose depth is settled; out has its governing point, and its percentile and depth. */
fw_status fw_levels_compare(fw_levels *out, const fw_campaign *c, const fw_levels_way *own, size_t n_cheap, fw_levels_way *cheap, fw_msg *m);

#endif
