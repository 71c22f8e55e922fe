#include "study/trial.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void fw_trial_say(void (*say)(void *self, const char *what), void *self, const char *fmt, ...)
{
    char    text[160];
    va_list ap;
    if (!say) return;
    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    say(self, text);
}

static double ring_sum(size_t n, const double *ring)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum += ring[k];
    return sum / (double)n; /* rings of different sizes compare */
}

void fw_trial_read_points(const fw_campaign *c, size_t n_arcs, const double *ring, double *to)
{
    for (size_t p = 0; p < c->points.n; p++) {
        double theta = fmod(c->points.bearing[p] - c->points.bearing[0] + 360, 360);
        /* a bearing on an arc's border belongs to the arc that begins there, as in directions.c */
        size_t arc = (size_t)floor(theta * (double)n_arcs / 360 + 1e-9);
        to[p] = ring[arc % n_arcs];
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
                                   .hits = r.hits,
                                   .evaluations = r.force_evaluations,
                                   .cpu_s = r.host_cpu_s,
                                   .truncation = r.energy_truncation};
        if (out[i].is_ok) {
            out[i].depth = ring_sum(r.n_arcs, fw_record_load(&r, 0, FW_RING_LOAD));
            out[i].path = ring_sum(r.n_arcs, fw_record_path(&r));
            if (points)
                fw_trial_read_points(c, r.n_arcs, fw_record_load(&r, 0, FW_RING_LOAD), points + i * c->points.n);
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

fw_pairs fw_pairs_compare_points(size_t n, size_t n_points, const double *points, const double *reference,
                                 const double *scale, const double *weight)
{
    fw_pairs out = {.mean = NAN, .error = NAN, .rms = NAN};
    double   weights = 0, squares = 0, bias = 0, noise = 0, P = (double)n_points;
    for (size_t i = 0; i < n; i++)
        if (scale[i] > 0 && weight[i] > 0) out.n++, weights += weight[i];
    if (out.n < 2) return out;
    for (size_t p = 0; p < n_points; p++) {
        double sum = 0, own = 0, s2 = 0;
        for (size_t i = 0; i < n; i++) {
            if (!(scale[i] > 0 && weight[i] > 0)) continue;
            double e = (points[i * n_points + p] - reference[i * n_points + p]) / scale[i];
            sum += weight[i] * e, own += weight[i] * e * e;
        }
        double b = sum / weights;
        for (size_t i = 0; i < n; i++) {
            if (!(scale[i] > 0 && weight[i] > 0)) continue;
            double off = weight[i] * ((points[i * n_points + p] - reference[i * n_points + p]) / scale[i] - b);
            s2 += off * off;
        }
        s2 *= (double)out.n / (double)(out.n - 1) / (weights * weights);
        squares += own / weights;
        bias += b * b - s2, noise += s2;
    }
    out.mean = sqrt(fmax(0, bias / P));
    out.error = sqrt(noise / P) * pow(2 / P, 0.25);
    out.rms = sqrt(squares / P);
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
