/* A site and its windows made up for the tests of weights: a window's mean load round the ring is a known function of its scenario times lognormal ice of
 * mean 1, so that every percentile is a quadrature. Scenarios are drawn by hand, plain or by designs in randomisations. */
#ifndef FW_TESTS_STUDY_MADE_UP_SITE_H
#define FW_TESTS_STUDY_MADE_UP_SITE_H

#include "base/memory.h"
#include "study/made_up.h"
#include "statistics/latin.h"
#include "statistics/sobol.h"
#include "study/depth.h"

/* Weibull speed, three concentrations, two mixes, T even on [-12, -2] degC, current to the north, a point that faces it. */
static inline fw_campaign site_campaign(double *bearings)
{
    static const double values[] = {0.2, 0.4, 0.6}, weights[] = {0.3, 0.5, 0.2};
    fw_campaign         c = made_up_campaign(bearings);
    c.model.n_arcs = 24;
    c.model.n_mixes = 2, c.model.mixes[0].probability = 0.6, c.model.mixes[1].probability = 0.4;
    c.points.n = 1, bearings[0] = 180;
    c.site.speed = made_up_law(FW_DIST_WEIBULL, 0.4, 1.6);
    c.site.speed.low = 0.05, c.site.speed.high = 2;
    assert_int_equal(fw_distribution_values(&c.site.concentration, 3, values, weights, NULL), FW_OK);
    c.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    return c;
}

/* [MPa^m km] */
static inline double site_load(const fw_scenario *s) { return 3 * pow(s->speed, 3) * pow(s->concentration, 1.5) * (s->mix ? 1.4 : 1); }

static inline void site_at(const fw_campaign *c, const double *u, fw_scenario *out)
{
    out->speed = fw_distribution_quantile(&c->site.speed, u[0]);
    out->concentration = fw_distribution_quantile(&c->site.concentration, u[1]);
    out->mix = u[2] < c->model.mixes[0].probability ? 0u : 1u;
}

/* ---- the law as points -------------------------------------------------------------------------------------------- */

enum { SITE_LEVELS = 200, SITE_LAW = SITE_LEVELS * 6 };

/* Speed's levels 1 - (1 - v)^2 at even v, times concentrations and mixes, exact. */
static inline void site_law_point(const fw_campaign *c, uint64_t i, fw_scenario *out)
{
    size_t k = i % 3, mix = i / 3 % 2;
    double v = (double)(i / 6) / SITE_LEVELS, next = v + 1.0 / SITE_LEVELS, mid = v + 0.5 / SITE_LEVELS;
    *out = (fw_scenario){.seed = c->seed, .id = i, .randomisation = -1, .mix = (uint32_t)mix, .concentration = c->site.concentration.values[k]};
    out->speed = fw_distribution_quantile(&c->site.speed, 1 - (1 - mid) * (1 - mid));
    out->weight = ((1 - v) * (1 - v) - (1 - next) * (1 - next)) * c->site.concentration.weights[k] * c->model.mixes[mix].probability;
}

static const fw_scenario_law SITE = {SITE_LAW, site_law_point};

/* ---- scenarios ----------------------------------------------------------------------------------------------------- */

enum { SITE_RANDOMISATIONS = 16, SITE_STREAM_SCENARIO = 1, SITE_STREAM_ICE = 2 };
typedef enum site_way { SITE_PLAIN, SITE_SKEWED, SITE_LATIN, SITE_SOBOL, SITE_WAYS } site_way;
static const char *const SITE_WAY[SITE_WAYS] = {"plain", "strata of speed, skewed", "latin hypercube", "sobol"};

/* Half of the realisations to the fastest fifth of the time. */
static inline void site_skew(double v, double *u_speed, double *weight)
{
    static const double level[] = {0, 0.5, 0.8, 0.95, 1}, share[] = {0.2, 0.3, 0.25, 0.25};
    double              sum = 0;
    size_t              k = 0;
    while (k < 3 && v >= sum + share[k]) sum += share[k++];
    *weight = (level[k + 1] - level[k]) / share[k];
    *u_speed = level[k] + *u_speed * (level[k + 1] - level[k]);
}

static inline fw_scenario site_scenario(const fw_campaign *c, site_way way, uint64_t seed, uint64_t id)
{
    const uint64_t n = SITE_RANDOMISATIONS, r = id % n, k = id / n;
    fw_scenario    out = {.seed = seed, .id = id, .weight = 1, .randomisation = way == SITE_PLAIN ? -1 : (int32_t)r};
    fw_random      random;
    double         u[3], v;
    fw_random_stream(&random, seed, FW_STREAM_TEST, id, SITE_STREAM_SCENARIO);
    for (int i = 0; i < 3; i++) u[i] = fw_random_uniform(&random);
    if (way == SITE_LATIN) fw_latin_point(k % 16, 16, 3, seed, r + k / 16 * n, u);
    if (way == SITE_SOBOL) fw_sobol_point(k, 3, FW_SCRAMBLE_OWEN, seed, r, u);
    if (way == SITE_SKEWED) {
        fw_sobol_point(k, 1, FW_SCRAMBLE_OWEN, seed, r, &v);
        site_skew(v, &u[0], &out.weight);
    }
    site_at(c, u, &out);
    return out;
}

static inline double site_ice(uint64_t seed, uint64_t id, double sigma)
{
    fw_random r;
    fw_random_stream(&r, seed, FW_STREAM_TEST, id, SITE_STREAM_ICE);
    return exp(sigma * gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r)) - 0.5 * sigma * sigma);
}

/* ---- records ------------------------------------------------------------------------------------------------------- */

typedef struct site_records {
    const fw_campaign *campaign;
    site_way           way;
    uint64_t           seed;
    double             sigma; /* of ln ice */
    double (*load)(const fw_scenario *s); /* NULL: site_load */
} site_records;

/* Cosine round the ring: arc k has 1 + cos theta times the mean, which stays the mean. */
static inline double site_shape(size_t k, size_t n) { return 1 + cos(((double)k + 0.5) * 6.283185307179586 / (double)n); }

static inline void site_record(fw_record *r, const fw_scenario *s, double load)
{
    r->id = s->id, r->status = FW_OK, r->concentration = s->concentration, r->speed = s->speed, r->mix = s->mix, r->cell = s->cell;
    r->weight = s->weight, r->randomisation = s->randomisation, r->wear_thickness = 0.5, r->host_cpu_s = 1;
    for (size_t k = 0; k < r->n_arcs; k++) r->rings[r->n_arcs + k] = load * site_shape(k, r->n_arcs);
}

static inline fw_status site_read(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    (void)m;
    const site_records *s = self;
    fw_scenario         sc = site_scenario(s->campaign, s->way, s->seed, id);
    site_record(r, &sc, (s->load ? s->load : site_load)(&sc) * site_ice(s->seed, id, s->sigma));
    return FW_OK;
}

/* n records of a site, settled; law NULL: no control variates. most_loads 0: the usual. */
static inline void site_depth(fw_depth *d, const site_records *s, size_t n, const fw_scenario_law *law, size_t most_loads)
{
    fw_record r;
    assert_int_equal(fw_depth_make(d, s->campaign, 0, s->campaign->points.n, s->campaign->points.bearing, NULL), FW_OK);
    if (most_loads) d->most_loads = most_loads;
    assert_int_equal(fw_record_init(&r, s->campaign->model.n_arcs, 1, NULL), FW_OK);
    for (uint64_t id = 0; id < n; id++) {
        assert_int_equal(site_read((void *)s, id, &r, NULL), FW_OK);
        assert_int_equal(fw_depth_add(d, &r, NULL), FW_OK);
    }
    fw_record_free(&r);
    assert_int_equal(fw_depth_settle(d, law, NULL, NULL), FW_OK);
}

/* ---- the truth ------------------------------------------------------------------------------------------------------ */

/* P(D <= depth) at the point that faces the current: the law's points times 20 temperatures, the ice in closed form. */
static inline double site_cdf(const fw_campaign *c, double sigma, double depth)
{
    enum { LEVELS = 20 };
    double      ln_factor[LEVELS], sum = 0;
    fw_scenario s;
    for (size_t t = 0; t < LEVELS; t++) {
        double T = fw_distribution_quantile(&c->site.temperature, ((double)t + 0.5) / LEVELS);
        ln_factor[t] = log(0.116 * pow(fabs(T), -1.121) * site_shape(0, c->model.n_arcs));
    }
    for (uint64_t i = 0; i < SITE_LAW; i++) {
        site_law_point(c, i, &s);
        double ln_load = log(site_load(&s)) - 0.5 * sigma * sigma;
        for (size_t t = 0; t < LEVELS; t++) sum += s.weight / LEVELS * gsl_cdf_ugaussian_P((log(depth) - ln_load - ln_factor[t]) / sigma);
    }
    return sum;
}

static inline double site_percentile(const fw_campaign *c, double sigma, double p)
{
    double from = log(1e-9), to = log(1e3);
    for (int i = 0; i < 34; i++) {
        double x = 0.5 * (from + to);
        if (site_cdf(c, sigma, exp(x)) < p)
            from = x;
        else
            to = x;
    }
    return exp(0.5 * (from + to));
}

#endif
