/* The ring's size. Coarser rings are means over a fine one's arcs (spreading is conservative), so that the many windows of the
 * percentile group, run on one fine ring, tell what a measuring point would read on any of them: a dozen paired windows know a
 * point's mean to some per cent only. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/accuracy_inside.h"

static void average(size_t n, size_t share, const double *fine, double *coarse)
{
    for (size_t k = 0; k < n; k++) {
        double sum = 0;
        for (size_t i = 0; i < share; i++) sum += fine[k * share + i];
        coarse[k] = sum / (double)share;
    }
}

fw_status fw_accuracy_coarsen(fw_record *record, size_t n_arcs, fw_msg *m)
{
    size_t n_rings = fw_record_n_rings(record->n_arcs, record->n_laws) / record->n_arcs,
           share = record->n_arcs / n_arcs;
    double *rings;
    if (share == 1) return FW_OK;
    FW_TRY(fw_alloc(&rings, n_rings * n_arcs, sizeof *rings, "rings of a record", m));
    for (size_t k = 0; k < n_rings; k++) average(n_arcs, share, record->rings + k * record->n_arcs, rings + k * n_arcs);
    free(record->rings);
    record->rings = rings;
    record->n_arcs = n_arcs;
    return FW_OK;
}

void fw_accuracy_say_ring(const fw_accuracy_run *r, fw_accuracy_row *row, size_t n_windows, double window_s)
{
    double scatter = row->depth.rms * sqrt(fmin(1, window_s / r->c->model.window));
    if (row->is_reference)
        snprintf(row->words, sizeof row->words, "what the others are compared with");
    else
        snprintf(row->words, sizeof row->words,
                 "of the points, from %zu windows; a point's own scatter over %.3g s: %.2g %%", n_windows,
                 r->c->model.window, 100 * scatter);
}

typedef struct buffers {
    double *ring, *points, *reference, *scale, *weight; /* (arcs), twice (n x points), twice (n) */
} buffers;

static void compare(fw_accuracy_run *r, fw_accuracy_row *row, size_t n, const fw_record *records, const buffers *b)
{
    size_t n_points = r->c->points.n, n_arcs = (size_t)row->level, n_ok = 0;
    for (size_t i = 0; i < n; i++) {
        if (records[i].status != FW_OK) continue;
        const double *fine = fw_record_load(&records[i], 0, FW_RING_LOAD);
        average(n_arcs, records[i].n_arcs / n_arcs, fine, b->ring);
        fw_trial_read_points(r->c, n_arcs, b->ring, b->points + n_ok * n_points);
        fw_trial_read_points(r->c, records[i].n_arcs, fine, b->reference + n_ok * n_points);
        average(1, records[i].n_arcs, fine, &b->scale[n_ok]);
        b->weight[n_ok++] = records[i].hits;
    }
    row->depth = fw_pairs_compare_points(n_ok, n_points, b->points, b->reference, b->scale, b->weight);
    fw_accuracy_say_ring(r, row, n_ok, r->out->percentile_window_s);
}

fw_status fw_accuracy_ring_rows(fw_accuracy_run *r, size_t n, const fw_record *records, fw_msg *m)
{
    double *block;
    size_t  n_points = r->c->points.n, n_arcs = records[0].n_arcs;
    FW_TRY(fw_alloc(&block, n_arcs + 2 * n * (n_points + 1), sizeof *block, "points of the accuracy study", m));
    buffers b = {.ring = block, .points = block + n_arcs};
    b.reference = b.points + n * n_points, b.scale = b.reference + n * n_points, b.weight = b.scale + n;
    for (size_t i = 0; i < r->out->n_rows; i++) {
        fw_accuracy_row *row = &r->out->rows[i];
        if (row->group == FW_ACCURACY_RING && n_arcs % (size_t)row->level == 0) compare(r, row, n, records, &b);
    }
    free(block);
    return FW_OK;
}
