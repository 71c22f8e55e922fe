#include "study/sanity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Hits are solved down to this share of the fastest current; below it their load goes on as a power of speed. Load of a window goes with the cube. */
static const double SLOWEST_SHARE = 0.01;
/* Of a law without an end. */
static const double FASTEST_QUANTILE = 1 - 1e-6;
/* Equal shares of time that the law of speed is taken at. */
enum { N_SPEEDS = 4000 };

static size_t n_rows(const fw_sanity *s) { return s->swept.n_mixes * s->swept.n_speeds; }

static void speeds_of(const fw_site *site, double *slowest, double *fastest)
{
    *slowest = INFINITY, *fastest = 0;
    for (size_t i = 0; i < site->n_cells; i++) {
        if (!(site->cells[i].probability > 0)) continue;
        *slowest = fmin(*slowest, site->cells[i].speed), *fastest = fmax(*fastest, site->cells[i].speed);
    }
    if (site->n_cells == 0) *slowest = fw_distribution_min(&site->speed), *fastest = fw_distribution_max(&site->speed);
    if (!isfinite(*fastest)) *fastest = fw_distribution_quantile(&site->speed, FASTEST_QUANTILE);
    *slowest = fmax(*slowest, SLOWEST_SHARE * *fastest);
}

fw_status fw_sanity_begin(fw_sanity *out, const fw_campaign *c, size_t law, fw_msg *m)
{
    fw_msg own = {""};
    memset(out, 0, sizeof *out);
    double slowest, fastest;
    speeds_of(&c->site, &slowest, &fastest);
    fw_status s = fw_swept_make(&out->swept, &c->model, slowest, fastest, law, &own);
    if (s == FW_E_NOMEM) return fw_fail(m, s, "%s", own.text);
    if (s != FW_OK) {
        snprintf(out->why, sizeof out->why, "%.*s", (int)sizeof out->why - 1, own.text);
        return FW_OK;
    }
    out->law = law;
    out->n_laws = c->site.n_cells ? c->site.n_cells : 1;
    s = fw_alloc(&out->records, out->n_laws * n_rows(out), sizeof *out->records, "shares of the swept strip", m);
    if (s == FW_OK) s = fw_alloc(&out->total, n_rows(out), sizeof *out->total, "loads of the swept strip", m);
    for (size_t k = 0; s == FW_OK && k < n_rows(out) * c->model.n_arcs; k++) out->total[k / c->model.n_arcs] += out->swept.load[k];
    if (s != FW_OK) fw_sanity_free(out);
    return s;
}

void fw_sanity_free(fw_sanity *s)
{
    if (!s) return;
    fw_swept_free(&s->swept);
    free(s->records);
    free(s->total);
    memset(s, 0, sizeof *s);
}

/* Returns the load that it adds, summed over the ring. */
static double add(const fw_sanity *s, double *shares, size_t law, const fw_scenario *sc, double weight)
{
    fw_swept_share a = fw_swept_share_of(&s->swept, sc);
    double        *row = shares + law * n_rows(s) + a.row;
    row[0] += weight * a.share[0], row[1] += weight * a.share[1];
    return weight * (a.share[0] * s->total[a.row] + a.share[1] * s->total[a.row + 1]);
}

double fw_sanity_ln_strip(const fw_sanity *s, const fw_scenario *sc)
{
    fw_swept_share a = fw_swept_share_of(&s->swept, sc);
    return log(a.share[0] * s->total[a.row] + a.share[1] * s->total[a.row + 1]);
}

void fw_sanity_add(fw_sanity *s, const fw_record *r, double weight)
{
    if (s->why[0] || r->status != FW_OK || !(r->mix >= 0 && r->mix < (double)s->swept.n_mixes)) return;
    fw_scenario   sc = {.concentration = r->concentration, .speed = r->speed, .mix = (uint32_t)r->mix};
    const double *ring = fw_record_load(r, s->law, FW_RING_LOAD);
    double        strip = add(s, s->records, s->n_laws == 1 ? 0 : (size_t)r->cell, &sc, weight), load = 0;
    for (size_t k = 0; k < r->n_arcs; k++) load += ring[k];
    s->weight += weight, s->load += weight * load, s->strip += strip, s->crowded += strip * fw_swept_crowding(sc.concentration);
}

/* Load is in proportion to the concentration, which is drawn on its own where there is no table: its mean will do. Returns the load, summed over the ring. */
static double add_site(const fw_sanity *s, const fw_campaign *c, double *shares)
{
    double         sum = 0;
    const fw_site *site = &c->site;
    for (size_t i = 0; i < site->n_cells; i++) {
        const fw_site_cell *cell = &site->cells[i];
        sum += add(s, shares, i, &(fw_scenario){.concentration = cell->concentration, .speed = cell->speed, .mix = cell->mix}, cell->probability);
    }
    if (site->n_cells) return sum;
    double concentration = fw_distribution_mean(&site->concentration);
    for (size_t i = 0; i < N_SPEEDS; i++) {
        double speed = fw_distribution_quantile(&site->speed, ((double)i + 0.5) / N_SPEEDS);
        for (size_t k = 0; k < s->swept.n_mixes; k++)
            sum += add(s, shares, 0, &(fw_scenario){.concentration = concentration, .speed = speed, .mix = (uint32_t)k},
                       c->model.mixes[k].probability / N_SPEEDS);
    }
    return sum;
}

/* Mean load at every point; ring: (n_arcs) to work with; loads: (n_points), added to. */
static void read_points(const fw_sanity *s, const double *shares, const fw_directions *d, double *ring, double *loads)
{
    for (size_t law = 0; law < s->n_laws; law++) {
        memset(ring, 0, d->n_arcs * sizeof *ring);
        for (size_t row = 0; row < n_rows(s); row++) {
            double        share = shares[law * n_rows(s) + row];
            const double *load = s->swept.load + row * d->n_arcs;
            for (size_t k = 0; k < d->n_used && share > 0; k++) ring[d->used[k]] += share * load[d->used[k]];
        }
        for (size_t p = 0; p < d->n_points; p++) {
            size_t                     n;
            const fw_direction_weight *w = fw_directions_row(d, law, p, &n);
            for (size_t k = 0; k < n; k++) loads[p] += w[k].weight * ring[d->used[w[k].column]];
        }
    }
}

fw_status fw_sanity_end(const fw_sanity *s, const fw_campaign *c, const fw_directions *d, double factor, fw_sanity_row *rows, fw_sanity_ring *whole,
                        fw_msg *m)
{
    double *work = NULL;
    size_t  n = s->n_laws * n_rows(s);
    if (s->why[0]) return FW_OK;
    FW_TRY(fw_alloc(&work, n + d->n_arcs + 2 * d->n_points, sizeof *work, "loads of the swept strip", m));
    double *site = work, *ring = site + n, *drawn = ring + d->n_arcs, *law = drawn + d->n_points;
    double  of_site = add_site(s, c, site);
    read_points(s, s->records, d, ring, drawn);
    read_points(s, site, d, ring, law);
    for (size_t p = 0; p < d->n_points; p++) {
        rows[p].strip_mm = s->weight > 0 ? factor * drawn[p] / s->weight : NAN;
        rows[p].law_mm = factor * law[p];
    }
    *whole = (fw_sanity_ring){NAN, NAN, NAN};
    if (s->strip > 0) *whole = (fw_sanity_ring){s->load / s->strip, s->crowded / s->strip, of_site * s->weight / s->strip};
    free(work);
    return FW_OK;
}
