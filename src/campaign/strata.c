#include "campaign/strata.h"

#include <math.h>

enum { MOST_VALUES = 8, MOST_BINS = 32 };

static fw_bins even_bins(size_t n)
{
    fw_bins b = {.n = n};
    for (size_t i = 0; i <= n; i++) b.edge[i] = (double)i / (double)n;
    return b;
}

static fw_bins bins_of_speed(const fw_distribution *d)
{
    static const fw_bins fine = {.n = 8, .edge = {0, 0.25, 0.5, 0.65, 0.75, 0.85, 0.92, 0.97, 1}};
    return fw_distribution_is_constant(d) ? even_bins(1) : fine;
}

static fw_bins bins_of_concentration(const fw_distribution *d)
{
    if (fw_distribution_is_constant(d)) return even_bins(1);
    if (d->kind != FW_DIST_VALUES || d->n > MOST_VALUES) return even_bins(4);
    fw_bins b = {0};
    for (size_t i = 0; i < d->n; i++) { /* values outside of the law's limits have no share, and values may come twice */
        double to = fw_distribution_cdf(d, d->values[i]);
        if (to > b.edge[b.n]) b.edge[++b.n] = to;
    }
    b.edge[b.n] = 1;
    return b;
}

static fw_bins bins_of_mixes(const fw_model *m)
{
    fw_bins b = {.n = m->n_mixes};
    for (size_t i = 0; i < m->n_mixes; i++) b.edge[i + 1] = b.edge[i] + m->mixes[i].probability;
    b.edge[b.n] = 1;
    return b;
}

void fw_strata_make(fw_strata *out, const fw_model *m, const fw_site *s)
{
    *out = (fw_strata){.n = s->n_cells, .site = s};
    if (s->n_cells) return;
    out->speed = bins_of_speed(&s->speed);
    out->concentration = bins_of_concentration(&s->concentration);
    out->mix = bins_of_mixes(m);
    out->n = out->speed.n * out->concentration.n * out->mix.n;
}

typedef struct place {
    size_t speed, concentration, mix;
} place;

static place place_of(const fw_strata *s, size_t stratum)
{
    return (place){stratum / s->mix.n / s->concentration.n, stratum / s->mix.n % s->concentration.n, stratum % s->mix.n};
}

static double width(const fw_bins *b, size_t i) { return b->edge[i + 1] - b->edge[i]; }

double fw_strata_share(const fw_strata *s, size_t stratum)
{
    if (s->site->n_cells) return s->site->cells[stratum].probability;
    place p = place_of(s, stratum);
    return width(&s->speed, p.speed) * width(&s->concentration, p.concentration) * width(&s->mix, p.mix);
}

/* The bin whose values hold x. Of a law with atoms a bin is found by the middle of the levels that give x. */
static size_t bin_of(const fw_bins *b, const fw_distribution *d, double x)
{
    double level = 0.5 * (fw_distribution_cdf_left(d, x) + fw_distribution_cdf(d, x));
    size_t i = 0;
    while (i + 1 < b->n && level >= b->edge[i + 1]) i++;
    return i;
}

size_t fw_strata_find(const fw_strata *s, const fw_scenario *sc)
{
    if (s->site->n_cells) return sc->cell;
    size_t speed = bin_of(&s->speed, &s->site->speed, sc->speed);
    size_t concentration = bin_of(&s->concentration, &s->site->concentration, sc->concentration);
    return (speed * s->concentration.n + concentration) * s->mix.n + sc->mix;
}

static double level_in(const fw_bins *b, size_t i, double at) { return b->edge[i] + at * width(b, i); }

void fw_strata_place(const fw_strata *s, size_t stratum, double at_speed, double at_concentration, double *u_speed, double *u_concentration,
                     uint32_t *mix)
{
    place p = place_of(s, stratum);
    *u_speed = level_in(&s->speed, p.speed, at_speed);
    *u_concentration = level_in(&s->concentration, p.concentration, at_concentration);
    *mix = (uint32_t)p.mix;
}
