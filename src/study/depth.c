#include "study/depth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { MOST_RANDOMISATIONS = 1 << 24 };

static fw_status make(fw_depth *d, const fw_campaign *c, fw_msg *m)
{
    const fw_abrasion_law *law = &c->model.laws[d->law];
    FW_TRY(fw_scale_make(&d->scale, law->coefficient, law->exponent,
                         law->uses_temperature ? &c->site.temperature : NULL, m));
    FW_TRY(fw_directions_make(&d->directions, &c->site, c->model.n_arcs, d->n_points, d->bearings, m));
    for (int i = 0; i < 4; i++)
        FW_TRY(fw_alloc(&d->ring[i], d->directions.n_laws * c->model.n_arcs, sizeof *d->ring[i], "sums of rings", m));
    return FW_OK;
}

fw_status fw_depth_make(fw_depth *out, const fw_campaign *c, size_t law, size_t n_points, const double *bearings,
                        fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_CHECK(law < c->model.n_laws, m, FW_E_ARG, "abrasion law %zu does not exist; the campaign has %zu", law + 1,
             c->model.n_laws);
    out->campaign = c;
    out->law = law;
    out->n_points = n_points;
    out->bearings = bearings;
    out->stride = 1;
    out->most_loads = FW_DEPTH_MOST_LOADS;
    fw_status s = make(out, c, m);
    if (s != FW_OK) fw_depth_free(out);
    return s;
}

double fw_depth_ring_mean(const fw_depth *d, size_t point, int ring)
{
    double sum = 0;
    for (size_t law = 0; law < d->directions.n_laws; law++) {
        size_t                     n = 0;
        const fw_direction_weight *w = fw_directions_row(&d->directions, law, point, &n);
        const double              *of = d->ring[ring] + law * d->directions.n_arcs;
        for (size_t k = 0; k < n; k++) sum += w[k].weight * of[d->directions.used[w[k].column]];
    }
    return d->weight > 0 ? sum / d->weight : 0;
}

/* Every second kept record goes: those whose number is odd in the coarser count. By randomisation: every second id of all would take whole randomisations
 * away, and with them what intervals are made from. */
static void thin(fw_depth *d)
{
    size_t n_used = d->directions.n_used, n = 0;
    d->stride *= 2;
    for (size_t i = 0; i < d->n; i++) {
        if (d->row[i].number % d->stride) continue;
        d->row[n] = d->row[i];
        memmove(d->load + n * n_used, d->load + i * n_used, n_used * sizeof *d->load);
        if (d->ln_load) memmove(d->ln_load + n * n_used, d->ln_load + i * n_used, n_used * sizeof *d->ln_load);
        n++;
    }
    d->n = n;
}

static fw_status keep(fw_depth *d, const fw_record *r, size_t direction_law, double ring_load, uint64_t number, fw_msg *m)
{
    const fw_directions *q = &d->directions;
    const double        *ring = fw_record_load(r, d->law, FW_RING_LOAD);
    FW_TRY(fw_grow(&d->row, &d->capacity_row, d->n + 1, sizeof *d->row, "records", m));
    FW_TRY(fw_grow(&d->load, &d->capacity_load, (d->n + 1) * q->n_used, sizeof *d->load, "wear loads of records", m));
    d->row[d->n] = (fw_depth_row){fw_record_scenario(r, d->campaign->seed), ring_load, r->wear_thickness, number};
    d->row[d->n].scenario.cell = (uint32_t)direction_law;
    double *load = d->load + d->n * q->n_used;
    for (size_t k = 0; k < q->n_used; k++) load[k] = ring[q->used[k]];
    if (!d->scale.is_discrete) {
        FW_TRY(fw_grow(&d->ln_load, &d->capacity_ln, (d->n + 1) * q->n_used, sizeof *d->ln_load,
                       "wear loads of records", m));
        for (size_t k = 0; k < q->n_used; k++) d->ln_load[d->n * q->n_used + k] = log(load[k]);
    }
    d->n++;
    if (d->n * q->n_used > d->most_loads && d->n > 1) thin(d);
    return FW_OK;
}

static fw_status check(const fw_depth *d, const fw_record *r, fw_msg *m)
{
    const fw_directions *q = &d->directions;
    unsigned long long   id = (unsigned long long)r->id;
    FW_CHECK(r->n_arcs == q->n_arcs && d->law < r->n_laws, m, FW_E_ARG,
             "record %llu has %zu arcs and %zu laws; the campaign has %zu arcs and asks for law %zu", id, r->n_arcs, r->n_laws, q->n_arcs, d->law + 1);
    FW_CHECK(r->weight > 0 && isfinite(r->weight), m, FW_E_FORMAT, "record %llu has the weight %g; wanted more than 0", id, r->weight);
    FW_CHECK(q->n_laws == 1 || (r->cell >= 0 && r->cell < (double)q->n_laws), m, FW_E_FORMAT,
             "record %llu belongs to cell %g of the site table, which has %zu", id, r->cell, q->n_laws);
    FW_CHECK(r->mix >= 0 && r->mix < FW_MAX_MIXES, m, FW_E_FORMAT, "record %llu has the thickness mix %g", id, r->mix);
    FW_CHECK(r->randomisation >= -1 && r->randomisation < MOST_RANDOMISATIONS, m, FW_E_FORMAT, "record %llu belongs to randomisation %g", id, r->randomisation);
    return FW_OK;
}

/* Weighted sums of the rings; *mean is the mean load round it. */
static fw_status add_rings(fw_depth *d, const fw_record *r, size_t direction_law, double *mean, fw_msg *m)
{
    size_t        n = r->n_arcs;
    const double *from[4] = {fw_record_load(r, d->law, FW_RING_LOAD), fw_record_load(r, d->law, FW_RING_IMPACT),
                             fw_record_load(r, d->law, FW_RING_HIGH), fw_record_path(r)};
    double        all = 0, least = 0;
    for (size_t k = 0; k < n; k++) all += from[0][k], least = fmin(least, from[0][k]);
    FW_CHECK(isfinite(all) && least >= 0, m, FW_E_FORMAT, "record %llu has a wear load that is negative or no number", (unsigned long long)r->id);
    for (int i = 0; i < 4; i++) {
        double *to = d->ring[i] + direction_law * n;
        for (size_t k = 0; k < n; k++) to[k] += r->weight * from[i][k];
    }
    *mean = all / (double)n;
    return FW_OK;
}

fw_status fw_depth_add(fw_depth *d, const fw_record *r, fw_msg *m)
{
    FW_TRY(check(d, r, m));
    d->cpu_s += r->host_cpu_s;
    d->evaluations += r->force_evaluations;
    if (r->status != FW_OK) {
        d->n_failed++;
        d->failed_weight += r->weight;
        return FW_OK;
    }
    size_t law = d->directions.n_laws == 1 ? 0 : (size_t)r->cell;
    double ring_load = 0;
    FW_TRY(add_rings(d, r, law, &ring_load, m));
    size_t randomisation = (size_t)(r->randomisation + 1);
    FW_TRY(fw_grow(&d->n_seen, &d->capacity_seen, randomisation + 1, sizeof *d->n_seen, "records of randomisations", m));
    uint64_t number = d->n_seen[randomisation]++;
    if (number % d->stride == 0) FW_TRY(keep(d, r, law, ring_load, number, m));
    d->n_good++;
    d->weight += r->weight;
    d->truncation += r->energy_truncation;
    d->all_load += ring_load, d->overlap_wear += ring_load * r->overlap_wear_share;
    d->overlap_time += r->overlap_time_share;
    d->ice_ratio += r->concentration > 0 ? r->concentration_achieved / r->concentration : 1;
    d->size_ratio += r->mean_diameter_wanted > 0 ? r->mean_diameter / r->mean_diameter_wanted : 1;
    d->overlap_most = fmax(d->overlap_most, r->max_overlap_share);
    d->n_second += r->tries > 1;
    return FW_OK;
}

fw_status fw_depth_stream(fw_depth *d, fw_sanity *strip, const fw_record_source *from, fw_msg *m)
{
    fw_record        r;
    const fw_record *lent;
    size_t           n = 0;
    FW_TRY(fw_record_init(&r, d->campaign->model.n_arcs, d->campaign->model.n_laws, m));
    fw_status s = FW_OK;
    for (uint64_t at = 0; at < from->n && s == FW_OK; at += n) {
        s = fw_records_lend(from, at, &r, &lent, &n, m);
        for (size_t i = 0; i < n && s == FW_OK; i++) {
            s = fw_depth_add(d, &lent[i], m);
            if (s == FW_OK && strip) fw_sanity_add(strip, &lent[i], lent[i].weight);
        }
    }
    fw_record_free(&r);
    return s;
}

/* ---- weights ----------------------------------------------------------------------------------------------------- */

/* Randomisations, when every record belongs to one: numbered from 0 without gaps. Records of a plain design are units themselves. */
static fw_status find_units(fw_depth *d, fw_msg *m)
{
    int32_t most = -1, *number = NULL;
    d->n_units = d->n;
    for (size_t i = 0; i < d->n; i++) {
        if (d->row[i].scenario.randomisation < 0) return FW_OK;
        most = d->row[i].scenario.randomisation > most ? d->row[i].scenario.randomisation : most;
    }
    FW_TRY(fw_alloc(&d->unit, d->n, sizeof *d->unit, "randomisations of records", m));
    FW_TRY(fw_alloc(&number, (size_t)most + 1, sizeof *number, "numbers of randomisations", m));
    d->n_units = 0;
    for (size_t i = 0; i < d->n; i++) {
        int32_t *at = &number[d->row[i].scenario.randomisation];
        if (*at == 0) *at = (int32_t)++d->n_units;
        d->unit[i] = *at - 1;
    }
    free(number);
    return FW_OK;
}

static fw_status weigh(fw_depth *d, const fw_scenario_law *law, const fw_sanity *strip, fw_msg *m)
{
    fw_scenario *scenarios = NULL;
    double      *load = NULL, sum = 0;
    FW_TRY(fw_alloc(&d->plain, d->n, sizeof *d->plain, "weights of records", m));
    for (size_t i = 0; i < d->n; i++) sum += d->row[i].scenario.weight;
    for (size_t i = 0; i < d->n; i++) d->plain[i] = d->row[i].scenario.weight / sum;
    fw_status s = fw_alloc(&scenarios, d->n, sizeof *scenarios, "scenarios of records", m);
    if (s == FW_OK) s = fw_alloc(&load, d->n, sizeof *load, "loads of records", m);
    for (size_t i = 0; i < d->n && s == FW_OK; i++) scenarios[i] = d->row[i].scenario, load[i] = d->row[i].ring_load;
    if (s == FW_OK) s = fw_control_make(&d->control, d->campaign, law, strip, d->n, scenarios, load, d->plain, m);
    free(scenarios);
    free(load);
    return s;
}

fw_status fw_depth_settle(fw_depth *d, const fw_scenario_law *law, const fw_sanity *strip, fw_msg *m)
{
    FW_CHECK(d->n > 0, m, FW_E_FAILURES, "no realisation succeeded (%zu failed): there is nothing to answer from",
             d->n_failed);
    FW_TRY(find_units(d, m));
    FW_TRY(weigh(d, law, strip, m));
    FW_TRY(fw_alloc(&d->scratch, 2 * d->n, sizeof *d->scratch, "values of records", m));
    d->units = (fw_units){.n = d->n,
                          .weight = d->control.calibration.weight,
                          .unit = d->unit,
                          .n_units = d->n_units,
                          .n_fitted = d->control.calibration.n_functions};
    return FW_OK;
}

void fw_depth_free(fw_depth *d)
{
    if (!d) return;
    fw_scale_free(&d->scale);
    fw_directions_free(&d->directions);
    fw_control_free(&d->control);
    for (int i = 0; i < 4; i++) free(d->ring[i]);
    free(d->row);
    free(d->n_seen);
    free(d->load);
    free(d->ln_load);
    free(d->plain);
    free(d->unit);
    free(d->scratch);
    memset(d, 0, sizeof *d);
}
