#include "study/answer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/rows.h"
#include "study/service_run.h"
#include "study/simultaneous.h"

/* Options with their defaults put in, and the points they name. */
typedef struct question {
    size_t  n_percentiles, n_points, law;
    double *percentiles; /* (n_percentiles); owned */
    double  confidence;
    size_t *numbers;  /* (n_points) from 1; owned */
    double *bearings; /* (n_points) [deg]; owned */
} question;

static void free_question(question *q)
{
    free(q->percentiles);
    free(q->numbers);
    free(q->bearings);
}

/* The usual four and the one that the campaign's precision is about, ascending. */
static void usual_percentiles(question *q, const fw_campaign *c)
{
    const double usual[] = {50, 90, 95, 99};
    double       own = c->precision.quantity == FW_QUANTITY_PERCENTILE ? c->precision.percentile : 50;
    bool         is_own_in = !(own > 0 && own < 100);
    for (size_t k = 0; k < 4; k++) {
        if (!is_own_in && own < usual[k]) q->percentiles[q->n_percentiles++] = own;
        is_own_in = is_own_in || own <= usual[k];
        q->percentiles[q->n_percentiles++] = usual[k];
    }
    if (!is_own_in) q->percentiles[q->n_percentiles++] = own;
}

static fw_status choose_percentiles(question *q, const fw_campaign *c, const fw_answer_options *o, fw_msg *m)
{
    FW_TRY(fw_alloc(&q->percentiles, o->n_percentiles + 5, sizeof *q->percentiles, "percentiles", m));
    if (o->n_percentiles == 0) usual_percentiles(q, c);
    for (size_t k = 0; k < o->n_percentiles; k++) {
        FW_CHECK(o->percentiles[k] > 0 && o->percentiles[k] < 100, m, FW_E_ARG, "percentile %g is outside (0, 100)",
                 o->percentiles[k]);
        q->percentiles[q->n_percentiles++] = o->percentiles[k];
    }
    return FW_OK;
}

static fw_status choose_points(question *q, const fw_campaign *c, const fw_answer_options *o, fw_msg *m)
{
    q->n_points = o->n_points ? o->n_points : c->points.n;
    FW_CHECK(q->n_points > 0, m, FW_E_ARG, "the campaign has no measuring points");
    FW_TRY(fw_alloc(&q->numbers, q->n_points, sizeof *q->numbers, "measuring points", m));
    FW_TRY(fw_alloc(&q->bearings, q->n_points, sizeof *q->bearings, "bearings of measuring points", m));
    for (size_t i = 0; i < q->n_points; i++) {
        size_t number = o->n_points ? o->points[i] : i + 1;
        FW_CHECK(number >= 1 && number <= c->points.n, m, FW_E_ARG,
                 "measuring point %zu does not exist; the campaign has 1 .. %zu", number, c->points.n);
        q->numbers[i] = number;
        q->bearings[i] = c->points.bearing[number - 1];
    }
    return FW_OK;
}

static fw_status read_options(question *q, const fw_campaign *c, const fw_answer_options *options, fw_msg *m)
{
    const fw_answer_options  defaults = {0};
    const fw_answer_options *o = options ? options : &defaults;
    q->law = o->law;
    q->confidence = o->confidence > 0 ? o->confidence : c->precision.confidence > 0 ? c->precision.confidence : 0.95;
    FW_CHECK(q->confidence < 1, m, FW_E_ARG, "a confidence of %g is not below 1", q->confidence);
    FW_TRY(choose_percentiles(q, c, o, m));
    return choose_points(q, c, o, m);
}

static fw_status collect(fw_depth *d, fw_sanity *sanity, const fw_answer_source *source, fw_msg *m)
{
    FW_TRY(fw_depth_stream(d, sanity, &source->records, m));
    return d->n > 0 ? fw_depth_settle(d, source->law.point ? &source->law : NULL, sanity, m) : FW_OK;
}

static double choose_design_percentile(const fw_campaign *c, const question *q)
{
    double wanted = c->precision.quantity == FW_QUANTITY_PERCENTILE && c->precision.percentile > 0
                        ? c->precision.percentile
                        : 90;
    double largest = 0;
    for (size_t k = 0; k < q->n_percentiles; k++) {
        if (q->percentiles[k] == wanted) return wanted;
        largest = fmax(largest, q->percentiles[k]);
    }
    return largest;
}

static void fill_percentiles(const question *q, size_t i, const fw_window *w, fw_simultaneous *together, fw_percentile_row *rows)
{
    for (size_t k = 0; k < q->n_percentiles; k++) {
        const fw_window_level *l = fw_simultaneous_add(together, w, k, q->percentiles[k] / 100);
        fw_interval            v = fw_window_interval_at(w, l, q->confidence);
        rows[k] = (fw_percentile_row){.point = q->numbers[i],
                                      .bearing_deg = q->bearings[i],
                                      .percentile = q->percentiles[k],
                                      .depth_mm = l->depth,
                                      .low_mm = v.low,
                                      .high_mm = v.high,
                                      .n_effective = fw_window_effective_size(w, l),
                                      .coverage = v.coverage,
                                      .method = fw_window_method(w)};
    }
}

static void fill_point(const question *q, size_t i, const fw_window *w, fw_point_row *row)
{
    const fw_depth *d = w->depth;
    fw_interval     mean = fw_window_mean_interval(w, q->confidence);
    double          load = fw_depth_ring_mean(d, i, FW_DEPTH_RING_LOAD); /* shares are ratios of means */
    *row = (fw_point_row){.point = q->numbers[i],
                          .bearing_deg = q->bearings[i],
                          .mean_mm = w->moment[1],
                          .mean_low_mm = mean.low,
                          .mean_high_mm = mean.high,
                          .path_km = fw_depth_ring_mean(d, i, FW_DEPTH_RING_PATH),
                          .impact_share = load > 0 ? fw_depth_ring_mean(d, i, FW_DEPTH_RING_IMPACT) / load : NAN,
                          .high_share = load > 0 ? fw_depth_ring_mean(d, i, FW_DEPTH_RING_HIGH) / load : NAN};
}

static fw_status fill_life(fw_answer *a, fw_service_run *run, const question *q, size_t i, const fw_window *w, fw_msg *m)
{
    fw_life_row *rows = a->life + i * q->n_percentiles;
    for (size_t k = 0; k < q->n_percentiles; k++) {
        rows[k].point = q->numbers[i];
        rows[k].bearing_deg = q->bearings[i];
    }
    return fw_service_point(run, w, i, rows, &a->service, m);
}

/* ---- the relative half-width that stop rule and table share
 * ------------------------------------------------------- */

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

static fw_status answered_width(fw_answer *a, const fw_campaign *c, size_t n_percentiles, fw_msg *m)
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

/* ---- the whole answer
 * --------------------------------------------------------------------------------------------- */

static fw_status allocate(fw_answer *a, const fw_campaign *c, const question *q, fw_msg *m)
{
    a->n_points = q->n_points;
    a->n_percentiles = q->n_points * q->n_percentiles;
    a->n_life = c->service.is_asked ? a->n_percentiles : 0;
    FW_TRY(fw_alloc(&a->points, a->n_points, sizeof *a->points, "rows of points", m));
    FW_TRY(fw_alloc(&a->percentiles, a->n_percentiles, sizeof *a->percentiles, "rows of percentiles", m));
    return fw_alloc(&a->life, a->n_life, sizeof *a->life, "rows of service life", m);
}

static const fw_percentile_row *find_governing(const fw_answer *a, size_t n_percentiles)
{
    const fw_percentile_row *worst = NULL;
    for (size_t i = 0; i < a->n_points * n_percentiles; i++) {
        const fw_percentile_row *row = &a->percentiles[i];
        if (row->percentile == a->design_percentile && (!worst || row->depth_mm > worst->depth_mm)) worst = row;
    }
    return worst;
}

/* Every realisation's thickness with its share of the governing point's mean depth. */
static fw_status water_level(fw_answer *a, const fw_campaign *c, const fw_window *w, fw_msg *m)
{
    const fw_depth *d = w->depth;
    double         *thickness = NULL, *shares = NULL;
    fw_status       s = fw_alloc(&thickness, d->n, sizeof *thickness, "thicknesses of records", m);
    if (s == FW_OK) s = fw_alloc(&shares, d->n, sizeof *shares, "shares of depth", m);
    for (size_t i = 0; i < d->n && s == FW_OK; i++) thickness[i] = d->row[i].thickness, shares[i] = d->units.weight[i] * w->means[i];
    if (s == FW_OK)
        s = fw_water_level_make(&a->water_level, &c->after.water_level, c->model.ice_density / c->model.water_density, d->n, thickness, shares, m);
    free(thickness);
    free(shares);
    return s;
}

/* One point after the other, so that only one point's law is in memory. */
static fw_status answer_points(fw_answer *a, const question *q, const fw_depth *d, fw_service_run *run, fw_simultaneous *together, fw_msg *m)
{
    fw_window w;
    for (size_t i = 0; i < q->n_points; i++) {
        FW_TRY(fw_window_make(&w, d, i, m));
        fill_percentiles(q, i, &w, together, a->percentiles + i * q->n_percentiles);
        fill_point(q, i, &w, &a->points[i]);
        fw_status s = a->n_life ? fill_life(a, run, q, i, &w, m) : FW_OK;
        fw_window_free(&w);
        FW_TRY(s);
    }
    return fw_simultaneous_end(together, q->confidence, a->percentiles, m);
}

/* The governing point's law is made again for the ledger. */
static fw_status answer(fw_answer *a, const fw_campaign *c, const question *q, const fw_depth *d, const fw_law_factor *law, fw_msg *m)
{
    fw_window       w;
    fw_service_run  run;
    fw_simultaneous together;
    FW_CHECK(d->n > 0, m, FW_E_FAILURES, "no realisation succeeded (%zu failed): there is nothing to answer from", d->n_failed);
    FW_TRY(allocate(a, c, q, m));
    FW_TRY(fw_service_open(&run, c, q->n_percentiles, q->percentiles, a->design_percentile, q->confidence, law, q->n_points, &a->service, m));
    fw_status s = fw_simultaneous_open(&together, d, q->n_percentiles, m);
    if (s == FW_OK) s = answer_points(a, q, d, &run, &together, m);
    fw_simultaneous_close(&together);
    fw_service_close(&run);
    FW_TRY(s);
    FW_TRY(answered_width(a, c, q->n_percentiles, m));
    const fw_percentile_row *governing = find_governing(a, q->n_percentiles);
    a->governing_point = governing->point;
    size_t at = (size_t)(governing - a->percentiles) / q->n_percentiles;
    FW_TRY(fw_window_make(&w, d, at, m));
    s = fw_ledger_rows(a, c, &w, governing, law, at, m);
    if (s == FW_OK) fw_ledger_advise(a, q->n_percentiles);
    if (s == FW_OK && c->after.has_water_level) s = water_level(a, c, &w, m);
    fw_window_free(&w);
    return s;
}

/* The swept strip beside the points that were answered. */
static fw_status check_sanity(fw_answer *a, const fw_campaign *c, const fw_depth *d, const fw_sanity *sanity, fw_msg *m)
{
    snprintf(a->swept_why, sizeof a->swept_why, "%s", sanity->why);
    if (sanity->why[0]) return FW_OK;
    FW_TRY(fw_alloc(&a->swept, a->n_points, sizeof *a->swept, "rows of the swept strip", m));
    a->n_swept = a->n_points;
    FW_TRY(fw_sanity_end(sanity, c, &d->directions, d->scale.moment[1], a->swept, &a->swept_ring, m));
    for (size_t i = 0; i < a->n_swept; i++) {
        fw_sanity_row *row = &a->swept[i];
        row->point = a->points[i].point, row->bearing_deg = a->points[i].bearing_deg;
        row->ratio = row->strip_mm > 0 ? d->scale.moment[1] * fw_depth_ring_mean(d, i, FW_DEPTH_RING_LOAD) / row->strip_mm : NAN; /* in the same scenarios */
    }
    return FW_OK;
}

fw_status fw_answer_make(fw_answer *out, const fw_campaign *c, const fw_answer_source *source,
                         const fw_answer_options *o, fw_msg *m)
{
    question      q;
    fw_depth      d;
    fw_sanity     sanity;
    fw_law_factor law;
    memset(out, 0, sizeof *out);
    memset(&q, 0, sizeof q);
    memset(&d, 0, sizeof d);
    memset(&sanity, 0, sizeof sanity);
    memset(&law, 0, sizeof law);
    fw_status s = read_options(&q, c, o, m);
    if (s == FW_OK) s = fw_depth_make(&d, c, q.law, q.n_points, q.bearings, m);
    if (s == FW_OK) s = fw_sanity_begin(&sanity, c, q.law, m);
    if (s == FW_OK) s = collect(&d, &sanity, source, m);
    if (s == FW_OK) s = fw_law_factor_make(&law, c, source, q.law, q.n_points, q.bearings, fw_service_lives(c), m);
    if (s == FW_OK) {
        out->n = source->records.n;
        out->n_failed = d.n_failed;
        out->span = source->records.span;
        out->confidence = q.confidence;
        if (o && o->measured)
            out->measured = *o->measured;
        else
            fw_measured_default(&out->measured, &c->model);
        if (o && o->effects) out->effects = *o->effects;
        out->design_percentile = choose_design_percentile(c, &q);
        s = answer(out, c, &q, &d, &law, m);
        if (s == FW_OK) s = check_sanity(out, c, &d, &sanity, m);
    }
    fw_sanity_free(&sanity);
    fw_law_factor_free(&law);
    fw_depth_free(&d);
    free_question(&q);
    if (s != FW_OK) fw_answer_free(out);
    return s;
}

void fw_answer_free(fw_answer *a)
{
    if (!a) return;
    free(a->percentiles);
    free(a->points);
    free(a->life);
    fw_service_answer_free(&a->service);
    free(a->ledger);
    free(a->swept);
    memset(a, 0, sizeof *a);
}

/* ---- the stop rule's question
 * -------------------------------------------------------------------------------------- */

static fw_status measure_width(const fw_campaign *c, const fw_depth *d, size_t point, point_width *out, double *vov, fw_msg *m)
{
    fw_window w;
    FW_TRY(fw_window_make(&w, d, point, m));
    bool        is_mean = c->precision.quantity == FW_QUANTITY_MEAN;
    double      p = c->precision.percentile / 100;
    fw_interval v = is_mean ? fw_window_mean_interval(&w, c->precision.confidence)
                            : fw_window_interval(&w, p, c->precision.confidence);
    *out = width_of(is_mean ? w.moment[1] : fw_window_percentile(&w, p), v.low, v.high);
    *vov = fw_window_vov(&w, is_mean ? NAN : p);
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
    if (s == FW_OK) s = collect(&d, strip, source, m);
    if (s == FW_OK && d.n > 0) s = measure_reached(c, &d, out, m); /* with nothing but failures the width stays infinite */
    fw_depth_free(&d);
    free(bearings);
    return s;
}
