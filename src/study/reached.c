/* How precise the answer is: half-widths that stop rule and table share, and the stop rule's question. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/rows.h"

fw_status fw_answer_collect(fw_depth *d, fw_sanity *sanity, const fw_answer_source *source, fw_msg *m)
{
    FW_TRY(fw_depth_stream(d, sanity, &source->records, m));
    return d->n > 0 ? fw_depth_settle(d, source->law.point ? &source->law : NULL, sanity, m) : FW_OK;
}

typedef struct point_width {
    double value, half; /* [mm]; half INFINITY when an end does not exist */
} point_width;

static point_width width_of(double value, double low, double high)
{
    return (point_width){value, isnan(low) || isnan(high) ? INFINITY : 0.5 * (high - low)};
}

/* The worst over points, see answer.h; *largest is the index of the largest value. */
static double worst_width(size_t n, const point_width *widths, size_t *largest)
{
    *largest = 0;
    for (size_t i = 0; i < n; i++)
        if (widths[i].value > widths[*largest].value) *largest = i;
    double least = 0.1 * widths[*largest].value, worst = 0;
    for (size_t i = 0; i < n; i++) {
        double against = fmax(widths[i].value, least);
        worst = fmax(worst, against > 0 ? widths[i].half / against : INFINITY);
    }
    return worst;
}

fw_status fw_answer_take_width(fw_answer *a, const fw_campaign *c, size_t n_percentiles, fw_msg *m)
{
    point_width *widths = NULL;
    size_t       n = 0, largest = 0;
    a->half_width = INFINITY;
    FW_TRY(fw_alloc(&widths, a->n_percentiles, sizeof *widths, "interval widths", m));
    if (c->precision.quantity == FW_QUANTITY_MEAN) {
        for (size_t i = 0; i < a->n_points; i++)
            widths[n++] = width_of(a->points[i].mean_mm, a->points[i].mean_low_mm, a->points[i].mean_high_mm);
    } else {
        for (size_t i = 0; i < a->n_points * n_percentiles; i++) {
            const fw_percentile_row *row = &a->percentiles[i];
            if (row->percentile == a->design_percentile)
                widths[n++] = width_of(row->depth_mm, row->low_mm, row->high_mm);
        }
    }
    if (n > 0) a->half_width = worst_width(n, widths, &largest);
    free(widths);
    return FW_OK;
}

static fw_status measure_width(const fw_campaign *c, const fw_depth *d, size_t point, point_width *out, double *vov, fw_msg *m)
{
    fw_window w;
    FW_TRY(fw_window_make(&w, d, point, m));
    if (c->precision.quantity == FW_QUANTITY_MEAN) {
        fw_interval v = fw_window_mean_interval(&w, c->precision.confidence);
        *out = width_of(w.moment[1], v.low, v.high);
        *vov = fw_window_mean_vov(&w);
    } else {
        fw_window_level l;
        fw_window_look(&w, c->precision.percentile / 100, &l, d->scratch);
        fw_interval v = fw_window_interval_at(&w, &l, c->precision.confidence);
        *out = width_of(l.depth, v.low, v.high);
        *vov = w.is_sample ? 0 : l.at.spread.vov; /* order statistics have no variance to know */
    }
    fw_window_free(&w);
    return FW_OK;
}

/* The points that precision is asked of. */
static fw_status asked_points(const fw_campaign *c, double **bearings, size_t *n, fw_msg *m)
{
    const fw_precision *p = &c->precision;
    *n = p->n_points ? p->n_points : c->points.n;
    FW_CHECK(*n > 0, m, FW_E_ARG, "the campaign has no measuring points");
    FW_TRY(fw_alloc(bearings, *n, sizeof **bearings, "bearings of measuring points", m));
    for (size_t i = 0; i < *n; i++) (*bearings)[i] = c->points.bearing[p->n_points ? p->points[i] - 1 : i];
    return FW_OK;
}

static fw_status measure_reached(const fw_campaign *c, const fw_depth *d, fw_reached *out, fw_msg *m)
{
    point_width *widths = NULL;
    double      *vov = NULL;
    size_t       largest = 0;
    fw_status    s = fw_alloc(&widths, d->n_points, sizeof *widths, "interval widths", m);
    if (s == FW_OK) s = fw_alloc(&vov, d->n_points, sizeof *vov, "variances of variances", m);
    for (size_t i = 0; i < d->n_points && s == FW_OK; i++) s = measure_width(c, d, i, &widths[i], &vov[i], m);
    if (s == FW_OK) {
        out->half_width = worst_width(d->n_points, widths, &largest);
        out->value_mm = widths[largest].value;
        out->point = c->precision.n_points ? c->precision.points[largest] : largest + 1;
        out->vov = vov[largest];
        out->most_vov = fmax(FW_ANSWER_MOST_VOV, 3 / (double)d->n_units);
        out->is_enough = out->half_width <= c->precision.half_width && out->vov <= out->most_vov;
    }
    free(widths);
    free(vov);
    return s;
}

fw_status fw_answer_reached(const fw_campaign *c, const fw_answer_source *source, fw_reached *out, fw_msg *m)
{
    fw_sanity strip;
    fw_status s = fw_sanity_begin(&strip, c, 0, m);
    if (s == FW_OK) s = fw_answer_reached_beside(c, source, &strip, out, m);
    fw_sanity_free(&strip);
    return s;
}

fw_status fw_answer_reached_beside(const fw_campaign *c, const fw_answer_source *source, fw_sanity *strip, fw_reached *out, fw_msg *m)
{
    fw_depth d;
    double  *bearings = NULL;
    size_t   n = 0;
    *out = (fw_reached){.half_width = INFINITY, .value_mm = NAN, .vov = NAN, .point = 1};
    memset(&d, 0, sizeof d);
    fw_status s = asked_points(c, &bearings, &n, m);
    if (s == FW_OK) s = fw_depth_make(&d, c, 0, n, bearings, m);
    if (s == FW_OK) s = fw_answer_collect(&d, strip, source, m);
    if (s == FW_OK && d.n > 0) s = measure_reached(c, &d, out, m); /* with nothing but failures the width stays infinite */
    fw_depth_free(&d);
    free(bearings);
    return s;
}
