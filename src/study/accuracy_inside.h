/* Inside the accuracy study only: what its groups share while they run. */
#ifndef FW_STUDY_ACCURACY_INSIDE_H
#define FW_STUDY_ACCURACY_INSIDE_H

#include "study/accuracy.h"

enum { FW_ACCURACY_WINDOWS = 64 }; /* at most, of a paired group */

/* The reference level, and the finer of the two levels that tell whether a window stays coupled. */
#define FW_ACCURACY_REFERENCE 1e-4
#define FW_ACCURACY_SECOND    1e-3

typedef struct fw_accuracy_run {
    const fw_campaign         *c;
    const fw_accuracy_options *o;
    fw_accuracy               *out;
    fw_model                   model;   /* the campaign's, with the events scheme and its built-in numerics */
    size_t                     n;       /* windows of a paired group */
    fw_trial_window           *windows; /* (n) */
    fw_trial_sample           *sample, *reference, *usual; /* (n) now, reference of the group, default settings */
    double                    *points, *points_reference, *points_usual; /* (n x c->points.n) */
    bool                      *is_coupled;                               /* (n) */
    size_t                     row_capacity;
} fw_accuracy_run;

/* Every group appends its rows to out->rows. */
fw_status fw_accuracy_step_group(fw_accuracy_run *r, fw_msg *m);
fw_status fw_accuracy_domain_groups(fw_accuracy_run *r, fw_msg *m);
fw_status fw_accuracy_percentile_group(fw_accuracy_run *r, fw_msg *m);
/* From rows to a choice, the ledger's rows and the budget. */
void      fw_accuracy_choose_step(fw_accuracy_run *r);
void      fw_accuracy_choose_domain(fw_accuracy_run *r);
void      fw_accuracy_measure(fw_accuracy_run *r);
fw_status fw_accuracy_split_budget(fw_accuracy_run *r, fw_msg *m);

/* What many windows on a fine ring say of coarser ones: replaces the depth errors of the ring group's rows. */
fw_status fw_accuracy_ring_rows(fw_accuracy_run *r, size_t n, const fw_record *records, fw_msg *m);
void      fw_accuracy_say_ring(const fw_accuracy_run *r, fw_accuracy_row *row, size_t n_windows, double window_s);
/* The same records on a ring of fewer arcs; n_arcs divides theirs. */
fw_status fw_accuracy_coarsen(fw_record *record, size_t n_arcs, fw_msg *m);

fw_status fw_accuracy_append(fw_accuracy_run *r, const fw_accuracy_row *row, fw_msg *m);
#define FW_ACCURACY_SAY(r, ...) fw_trial_say((r)->o->say, (r)->o->say_self, __VA_ARGS__)
/* Mean cost of the samples into the row. */
void      fw_accuracy_cost(fw_accuracy_row *row, size_t n, const fw_trial_sample *s);
/* Windows of so many metres of ice, and so many before it (< 0: the campaign's own warm-up). */
void      fw_accuracy_set_windows(fw_accuracy_run *r, double way, double warm_up_way);

#endif
