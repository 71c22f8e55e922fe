/* Inside study: the hits that the swept strip is made from. */
#ifndef FW_STUDY_SWEPT_INSIDE_H
#define FW_STUDY_SWEPT_INSIDE_H

#include "floewear/scenario.h"

enum { FW_SWEPT_DIAMETERS = 2 };
extern const double fw_swept_diameter_at[FW_SWEPT_DIAMETERS]; /* shares of a class that are smaller: Gauss nodes */

/* Mean over a class's floes of an integral over the tracks that touch, both sides. */
typedef struct fw_swept_row {
    double *load;   /* (n_arcs) of a hit's load [MPa^m km m] */
    double *square; /* (n_arcs) of its square */
} fw_swept_row;

/* The model as one hit on an undisturbed wall has it. */
fw_model fw_swept_hit_model(const fw_model *model, size_t law);

/* Adds the floes of one thickness [m] and these diameters (FW_SWEPT_DIAMETERS) [m] to row, which was zero. evaluations is added to. */
fw_status fw_swept_solve(const fw_model *hit_model, double thickness, const double *diameter, double speed, fw_swept_row *row, double *evaluations,
                         fw_msg *m);

#endif
