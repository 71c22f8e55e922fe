#include "study/trial.h"

#include <math.h>
#include <string.h>

static double ring_sum(size_t n, const double *ring)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum += ring[k];
    return sum / (double)n; /* rings of different sizes compare */
}

static void read_points(const fw_campaign *c, const fw_record *r, double *to)
{
    const double *ring = fw_record_load(r, 0, FW_RING_LOAD);
    for (size_t p = 0; p < c->points.n; p++) {
        double theta = fmod(c->points.bearing[p] - c->points.bearing[0] + 360, 360);
        /* a bearing on an arc's border belongs to the arc that begins there, as in directions.c */
        size_t arc = (size_t)floor(theta * (double)r->n_arcs / 360 + 1e-9);
        to[p] = ring[arc % r->n_arcs];
    }
}

fw_status fw_trial_run(const fw_campaign *c, const fw_model *model, size_t n, const fw_trial_window *windows,
                       const fw_tick *tick, fw_trial_sample *out, double *points, fw_msg *m)
{
    memset(out, 0, n * sizeof *out);
    for (size_t i = 0; i < n; i++) {
        fw_model  own = *model;
        fw_record r;
        own.window = windows[i].window;
        if (windows[i].warm_up >= 0) own.warm_up = windows[i].warm_up;
        FW_TRY(fw_realise(&own, &windows[i].scenario, tick, &r, m));
        out[i] = (fw_trial_sample){.is_ok = r.status == FW_OK,
                                   .impulse = r.normal_impulse,
                                   .evaluations = r.force_evaluations,
                                   .cpu_s = r.host_cpu_s,
                                   .truncation = r.energy_truncation};
        if (out[i].is_ok) {
            out[i].depth = ring_sum(r.n_arcs, fw_record_load(&r, 0, FW_RING_LOAD));
            out[i].path = ring_sum(r.n_arcs, fw_record_path(&r));
            if (points) read_points(c, &r, points + i * c->points.n);
        }
        fw_record_free(&r);
    }
    return FW_OK;
}

double fw_trial_depth(const fw_trial_sample *s) { return s->depth; }
double fw_trial_path(const fw_trial_sample *s) { return s->path; }
double fw_trial_impulse(const fw_trial_sample *s) { return s->impulse; }

fw_pairs fw_pairs_compare(size_t n, const fw_trial_sample *a, const fw_trial_sample *reference, fw_trial_value value,
                          const bool *counts)
{
    fw_pairs out = {.mean = NAN, .error = NAN, .rms = NAN};
    double   sum = 0, squares = 0;
    for (size_t i = 0; i < n; i++) {
        if ((counts && !counts[i]) || !a[i].is_ok || !reference[i].is_ok) continue;
        double x = value(&a[i]), y = value(&reference[i]), size = 0.5 * (x + y);
        if (!(size > 0)) continue;
        double e = (x - y) / size;
        out.n++, sum += e, squares += e * e;
    }
    if (out.n == 0) return out;
    double k = (double)out.n;
    out.mean = sum / k;
    out.rms = sqrt(squares / k);
    if (out.n > 1) out.error = sqrt(fmax(0, (squares - sum * sum / k) / (k - 1)) / k);
    return out;
}

size_t fw_pairs_find_coupled(size_t n, const fw_trial_sample *a, const fw_trial_sample *reference, double limit,
                             bool *is_coupled)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double x = a[i].depth, y = reference[i].depth;
        is_coupled[i] = a[i].is_ok && reference[i].is_ok && x + y > 0 && fabs(x - y) <= limit * 0.5 * (x + y);
        count += is_coupled[i];
    }
    return count;
}
