/* What a wanted accuracy means in numerics: one table, measured. */
#ifndef FW_REALISATION_ACCURACY_H
#define FW_REALISATION_ACCURACY_H

#include "floewear/scenario.h"
#include "kernel/kernel.h"

/* The kernel's set-up for a model, a current speed [m/s] and the model's accuracy. */
void fw_accuracy_setup(fw_setup *s, const fw_model *m, double speed, double velocity_scale);

/* The same model for a second try: a tenth of the tolerances, all else as it is. */
fw_model fw_accuracy_finer(const fw_model *m);

/* Where "auto" stands in the model. */
double fw_accuracy_strip_width(const fw_model *m);
double fw_accuracy_downstream(const fw_model *m);
double fw_accuracy_warm_up(const fw_model *m, double speed);
size_t fw_accuracy_arcs(double accuracy);

/* Every choice as a line of text: name, value, how it was found (for `floewear plan`). Returns the number of lines. */
typedef struct fw_accuracy_line {
    const char *name, *unit, *why;
    double      value;
} fw_accuracy_line;
size_t fw_accuracy_lines(const fw_model *m, double speed, fw_accuracy_line *lines, size_t capacity);

/* What the table says for the model's accuracy, whatever the model's own numerics are: tolerances, first step, growth. Its order is
 * 0: the table's method, with closed forms for floes that touch nothing but the wall. */
fw_numerics fw_accuracy_built_in(const fw_model *m);
/* Another tolerance, with all that has to go with it: the ladder of a study moves along one line. */
void fw_accuracy_set_tolerance(fw_numerics *n, double tolerance);

#endif
