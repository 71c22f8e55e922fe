/* How many of the realisations each stratum gets. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "study/outlook_inside.h"

enum { DRAWS = 8 };                      /* of a scenario's ice */
static const double PROPORTIONAL = 0.3;  /* of the realisations */
static const double BETWEEN = 0.1;       /* of the variance between a stratum's scenarios: control variates take nearly all of it */

/* Sums over the law's points in a stratum. */
typedef struct stratum_sums {
    double share, cost;
    double f, ff, within_f; /* of P(D <= x): mean, mean of squares, variance by ice */
    double d, dd, within_d; /* of the depth */
} stratum_sums;

typedef struct moments {
    double f, ff, d, dd;
} moments;

/* Mean and mean square over draws of the ice of P(D <= x) and of the mean depth at the point. */
static void draw_scenario(const fw_outlook_windows *w, const fw_depth *d, double depth, const fw_scenario *s, fw_record *r, moments *out)
{
    size_t                     n;
    size_t                     law = d->directions.n_laws == 1 ? 0 : s->cell;
    const fw_direction_weight *row = fw_directions_row(&d->directions, law, 0, &n);
    *out = (moments){0};
    for (uint64_t i = 0; i < DRAWS; i++) {
        double f = 0, mean = 0;
        fw_outlook_windows_draw(w, s, i, r);
        const double *load = fw_record_load(r, 0, FW_RING_LOAD);
        for (size_t k = 0; k < n; k++) {
            double one = load[d->directions.used[row[k].column]];
            f += row[k].weight * (one > 0 ? fw_scale_cdf(&d->scale, depth / one) : 1);
            mean += row[k].weight * one * d->scale.moment[1];
        }
        out->f += f / DRAWS, out->ff += f * f / DRAWS, out->d += mean / DRAWS, out->dd += mean * mean / DRAWS;
    }
}

static fw_status sum_law(const fw_outlook_windows *w, const fw_depth *d, double depth, stratum_sums *sums, fw_msg *m)
{
    const fw_campaign *c = w->campaign;
    fw_record          r;
    FW_TRY(fw_record_init(&r, c->model.n_arcs, c->model.n_laws, m));
    fw_status s = FW_OK;
    uint64_t  step = w->o->law.n > 2048 && c->site.n_cells == 0 ? w->o->law.n / 2048 : 1; /* any stretch of Sobol points is spread evenly */
    for (uint64_t i = 0; i < w->o->law.n / step && s == FW_OK; i++) {
        fw_scenario sc;
        moments     q;
        double      cost;
        w->o->law.point(c, i, &sc);
        if (!(sc.weight > 0)) continue;
        s = fw_outlook_windows_cost(w, &sc, &cost, m);
        if (s != FW_OK) break;
        draw_scenario(w, d, depth, &sc, &r, &q);
        stratum_sums *to = &sums[w->o->stratum(c, &sc)];
        double        a = sc.weight;
        to->share += a, to->cost += a * cost;
        to->f += a * q.f, to->ff += a * q.f * q.f, to->within_f += a * fmax(0, q.ff - q.f * q.f);
        to->d += a * q.d, to->dd += a * q.d * q.d, to->within_d += a * fmax(0, q.dd - q.d * q.d);
    }
    fw_record_free(&r);
    return s;
}

static double variance(double share, double mean, double squares, double within)
{
    if (!(share > 0)) return 0;
    double between = squares / share - (mean / share) * (mean / share);
    return within / share + BETWEEN * fmax(0, between);
}

/* a += part x the allocation by one quantity's variances. */
static void add_neyman(size_t n, const stratum_sums *sums, bool is_depth, double part, double *allocation)
{
    double total = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < n; i++) {
            const stratum_sums *s = &sums[i];
            double v = is_depth ? variance(s->share, s->d, s->dd, s->within_d) : variance(s->share, s->f, s->ff, s->within_f);
            double q = s->cost > 0 ? s->share * sqrt(v / (s->cost / s->share)) : 0;
            if (pass == 0)
                total += q;
            else if (total > 0)
                allocation[i] += part * q / total;
        }
}

/* To four digits, so that a file can say it. */
static double round_share(double share)
{
    char text[32];
    snprintf(text, sizeof text, "%.4g", share);
    return strtod(text, NULL);
}

fw_status fw_outlook_allocate(const fw_outlook_windows *w, double bearing, double depth_mm, size_t n_strata, double *allocation, fw_msg *m)
{
    const fw_campaign *c = w->campaign;
    fw_depth           d;
    stratum_sums      *sums = NULL;
    bool               needs_means = c->service.is_asked || c->precision.quantity == FW_QUANTITY_MEAN;
    FW_TRY(fw_depth_make(&d, c, 0, 1, &bearing, m));
    fw_status s = fw_alloc(&sums, n_strata, sizeof *sums, "sums over strata", m);
    if (s == FW_OK) s = sum_law(w, &d, depth_mm, sums, m);
    double all = 0, sum = 0;
    for (size_t i = 0; i < n_strata && s == FW_OK; i++) all += sums[i].share;
    for (size_t i = 0; i < n_strata && s == FW_OK; i++) allocation[i] = PROPORTIONAL * sums[i].share / all;
    if (s == FW_OK) {
        add_neyman(n_strata, sums, false, (1 - PROPORTIONAL) * (needs_means ? 0.5 : 1), allocation);
        if (needs_means) add_neyman(n_strata, sums, true, (1 - PROPORTIONAL) * 0.5, allocation);
        for (size_t i = 0; i < n_strata; i++) sum += allocation[i];
        for (size_t i = 0; i < n_strata; i++) allocation[i] = round_share(allocation[i] / sum);
    }
    free(sums);
    fw_depth_free(&d);
    return s;
}
