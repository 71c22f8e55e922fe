#include "study/measured.h"

#include <math.h>
#include <stdio.h>

/* What `floewear accuracy campaigns/raahe.yaml --cpu-budget 300s` measured: 20 windows of 40 m of ice (steps) and of 400 m (the rest),
 * 384 windows for the ring. Amount: |mean| or its standard error, whichever is larger, of the built-in method at the next coarser
 * tolerance that was tried (0.01 %: the reference, its worst single hit) and of the default of each domain setting. */
static const struct step {
    double accuracy, amount, error, cost_factor;
} STEPS[] = {
    {1e-1, 3.7e-3, 3.7e-3, 1.10},
    {1e-2, 9.1e-4, 9.1e-4, 1.16},
    {1e-3, 2.7e-4, 2.0e-4, 1.28},
    {1e-4, 1.3e-5, NAN, 1.29},
};
static const fw_measured_row DOMAIN_ROWS[] = {
    {"ring", 1.4e-2, 1.2e-2, NAN, "ring.arcs (360 arcs; within the scatter of the study)", "no level that was tried"},
    {"strip width", 1.4e-2, 1.4e-2, 1.11, "field.strip_width (100 m wide; within the scatter of the study)",
     "140 m wide"},
    {"downstream", 3.0e-2, 2.1e-2, 1.05, "field.downstream (16 m downstream; within the scatter of the study)",
     "30 m downstream"},
    {"warm-up", 4.1e-3, 2.1e-3, NAN, "exposure.warm_up (120 m of ice before; within the scatter of the study)",
     "no level that was tried"},
};
/* An accuracy that is this much finer has half of the error: the r.m.s. of windows goes with accuracy^0.97 from 1 % to 0.1 %. */
static const double HALVED = 0.49;
enum { N_STEPS = sizeof STEPS / sizeof STEPS[0], N_DOMAIN = sizeof DOMAIN_ROWS / sizeof DOMAIN_ROWS[0] };

/* Between two accuracies that were measured the larger error of both. */
static fw_measured_row discretisation(const fw_model *model)
{
    fw_measured_row    row = {.row = "discretisation", .cost_factor = NAN};
    const fw_numerics *own = &model->numerics;
    if (own->order || own->tolerance > 0 || own->wear_tolerance > 0 || own->first_step > 0 || own->growth > 0) {
        row.amount = row.error = NAN;
        snprintf(row.shrinks_with, sizeof row.shrinks_with,
                 "the campaign names its own numerics; floewear accuracy measures the built-in ones");
        return row;
    }
    size_t k = N_STEPS - 1;
    while (k > 0 && STEPS[k].accuracy < model->accuracy * (1 - 1e-9)) k--;
    row.amount = STEPS[k].amount, row.error = STEPS[k].error, row.cost_factor = STEPS[k].cost_factor;
    snprintf(row.shrinks_with, sizeof row.shrinks_with, "accuracy: (%g %%)", 100 * model->accuracy);
    snprintf(row.halved_by, sizeof row.halved_by, "accuracy: %.2g %%", 100 * model->accuracy * HALVED);
    return row;
}

static bool is_usual(const fw_model *m, size_t k)
{
    return k == 0 ? m->n_arcs == 360 : k == 1 ? !(m->strip_width > 0) : k == 2 ? !(m->downstream > 0) : m->warm_up < 0;
}

void fw_measured_default(fw_measured *out, const fw_model *model)
{
    *out = (fw_measured){.origin = "on the Raahe campaign"};
    out->rows[out->n_rows++] = discretisation(model);
    for (size_t k = 0; k < N_DOMAIN; k++) {
        fw_measured_row *row = &out->rows[out->n_rows++];
        *row = DOMAIN_ROWS[k];
        if (is_usual(model, k)) continue;
        row->amount = row->error = row->cost_factor = NAN;
        snprintf(row->shrinks_with, sizeof row->shrinks_with,
                 "floewear accuracy measures settings that are not the default");
    }
}
