#include "study/depth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static fw_status make(fw_depth *d, const fw_campaign *c, fw_msg *m)
{
    const fw_abrasion_law *law = &c->model.laws[d->law];
    FW_TRY(fw_scale_make(&d->scale, law->coefficient, law->exponent,
                         law->uses_temperature ? &c->site.temperature : NULL, m));
    FW_TRY(fw_directions_make(&d->directions, &c->site, c->model.n_arcs, d->n_points, d->bearings, m));
    FW_TRY(fw_alloc(&d->impact, d->n_points, sizeof *d->impact, "sums of impact load", m));
    FW_TRY(fw_alloc(&d->high, d->n_points, sizeof *d->high, "sums of load above 5 MPa", m));
    return fw_alloc(&d->path, d->n_points, sizeof *d->path, "sums of path", m);
}

fw_status fw_depth_make(fw_depth *out, const fw_campaign *c, size_t law, size_t n_points, const double *bearings,
                        fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_CHECK(law < c->model.n_laws, m, FW_E_ARG, "abrasion law %zu does not exist; the campaign has %zu", law + 1,
             c->model.n_laws);
    out->law = law;
    out->n_points = n_points;
    out->bearings = bearings;
    fw_status s = make(out, c, m);
    if (s != FW_OK) fw_depth_free(out);
    return s;
}

/* Direction mean of one ring for one point. */
static double ring_mean(const fw_depth *d, size_t law, size_t point, const double *ring)
{
    size_t                     n = 0;
    const fw_direction_weight *w = fw_directions_row(&d->directions, law, point, &n);
    double                     sum = 0;
    for (size_t k = 0; k < n; k++) sum += w[k].weight * ring[d->directions.used[w[k].column]];
    return sum;
}

fw_status fw_depth_add(fw_depth *d, const fw_record *r, fw_msg *m)
{
    const fw_directions *q = &d->directions;
    FW_CHECK(r->n_arcs == q->n_arcs && d->law < r->n_laws, m, FW_E_ARG,
             "record %llu has %zu arcs and %zu laws; the campaign has %zu arcs and asks for law %zu",
             (unsigned long long)r->id, r->n_arcs, r->n_laws, q->n_arcs, d->law + 1);
    d->cpu_s += r->host_cpu_s;
    d->evaluations += r->force_evaluations;
    if (r->status != FW_OK) {
        d->n_failed++;
        return FW_OK;
    }
    FW_CHECK(q->n_laws == 1 || (r->cell >= 0 && r->cell < (double)q->n_laws), m, FW_E_FORMAT,
             "record %llu belongs to cell %g of the site table, which has %zu", (unsigned long long)r->id, r->cell,
             q->n_laws);
    size_t law = q->n_laws == 1 ? 0 : (size_t)r->cell;
    FW_TRY(fw_grow(&d->direction_law, &d->capacity_law, d->n + 1, sizeof *d->direction_law, "direction laws of records",
                   m));
    FW_TRY(fw_grow(&d->load, &d->capacity_load, (d->n + 1) * q->n_used, sizeof *d->load, "wear loads of records", m));
    FW_TRY(fw_grow(&d->thickness, &d->capacity_thickness, d->n + 1, sizeof *d->thickness, "thicknesses of records", m));
    d->direction_law[d->n] = (uint32_t)law;
    d->thickness[d->n] = r->wear_thickness;
    const double *ring = fw_record_load(r, d->law, FW_RING_LOAD);
    double       *load = d->load + d->n * q->n_used;
    for (size_t k = 0; k < q->n_used; k++) {
        load[k] = ring[q->used[k]];
        FW_CHECK(isfinite(load[k]) && load[k] >= 0, m, FW_E_FORMAT, "record %llu has a wear load of %g on arc %zu",
                 (unsigned long long)r->id, load[k], q->used[k]);
    }
    if (!d->scale.is_discrete) {
        FW_TRY(fw_grow(&d->ln_load, &d->capacity_ln, (d->n + 1) * q->n_used, sizeof *d->ln_load,
                       "wear loads of records", m));
        for (size_t k = 0; k < q->n_used; k++) d->ln_load[d->n * q->n_used + k] = log(load[k]);
    }
    for (size_t p = 0; p < d->n_points; p++) {
        d->impact[p] += ring_mean(d, law, p, fw_record_load(r, d->law, FW_RING_IMPACT));
        d->high[p] += ring_mean(d, law, p, fw_record_load(r, d->law, FW_RING_HIGH));
        d->path[p] += ring_mean(d, law, p, fw_record_path(r));
    }
    d->truncation += r->energy_truncation;
    double all = 0;
    for (size_t k = 0; k < r->n_arcs; k++) all += ring[k] / (double)r->n_arcs;
    d->all_load += all, d->overlap_wear += all * r->overlap_wear_share;
    d->overlap_time += r->overlap_time_share;
    d->ice_ratio += r->concentration > 0 ? r->concentration_achieved / r->concentration : 1;
    d->size_ratio += r->mean_diameter_wanted > 0 ? r->mean_diameter / r->mean_diameter_wanted : 1;
    d->overlap_most = fmax(d->overlap_most, r->max_overlap_share);
    d->n_second += r->tries > 1;
    d->n++;
    return FW_OK;
}

void fw_depth_free(fw_depth *d)
{
    if (!d) return;
    fw_scale_free(&d->scale);
    fw_directions_free(&d->directions);
    free(d->direction_law);
    free(d->thickness);
    free(d->load);
    free(d->ln_load);
    free(d->impact);
    free(d->high);
    free(d->path);
    memset(d, 0, sizeof *d);
}
