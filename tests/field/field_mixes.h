/* Thickness mixes that the field tests share. */
#ifndef FW_TESTS_FIELD_MIXES_H
#define FW_TESTS_FIELD_MIXES_H

#include "floewear/scenario.h"

/* The source paper's five classes, one fifth each. */
static inline fw_thickness_mix mix_paper(bool by_area)
{
    return (fw_thickness_mix){.probability = 1.0,
                              .by_area = by_area,
                              .n_classes = 5,
                              .classes = {{0.5, 0.2}, {0.7, 0.2}, {0.9, 0.2}, {1.1, 0.2}, {1.3, 0.2}}};
}

/* Thin ice, two of 0.3 m to one of 0.5 m. */
static inline fw_thickness_mix mix_thin(bool by_area)
{
    return (fw_thickness_mix){
        .probability = 1.0, .by_area = by_area, .n_classes = 2, .classes = {{0.3, 2.0 / 3.0}, {0.5, 1.0 / 3.0}}};
}

static inline fw_thickness_mix mix_single(double thickness)
{
    return (fw_thickness_mix){.probability = 1.0, .n_classes = 1, .classes = {{thickness, 1.0}}};
}

#endif
