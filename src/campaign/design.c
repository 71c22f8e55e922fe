/* The sampling design: id -> scenario.
 *
 * A design gives every id a point of the unit cube, and quantile functions turn its coordinates into a scenario:
 *
 *   u[0] concentration   u[1] speed   u[2] thickness mix   u[3] cell of the joint table   u[4] wind speed   u[5] wind angle   u[6] tide
 *
 * Plain sampling takes them from streams, one uniform per quantity whether the site needs it or not, so that a site that turns a constant
 * into a law leaves the other quantities' numbers alone; wind and tide, which came later, have streams of their own.
 *
 * The other designs come in n independent randomisations. Realisation id is point id / n of randomisation id % n: every prefix of ids has
 * about as many points of each, and their scatter is what an interval is made from.
 *
 *   Sobol        the quantities that matter most have the first coordinates; speed, concentration, mix
 *   Latin        hypercubes of FW_LATIN_SIZE points, one after the other
 *   stratified   a van der Corput point, scrambled, picks the stratum from the allocation's shares: n points take of every stratum their share
 *                to within two where n is a power of 2, else to within a few; the place inside the stratum is plain. Weight: share of time over share of
 *                realisations */
#include <math.h>

#include "base/random.h"
#include "campaign/strata.h"
#include "floewear/campaign.h"
#include "statistics/latin.h"
#include "statistics/sobol.h"

enum { U_CONCENTRATION, U_SPEED, U_MIX, U_CELL, N_PLAIN, U_WIND_SPEED = N_PLAIN, U_WIND_ANGLE, U_TIDE, N_UNIFORMS };

static uint32_t design_pick_mix(const fw_model *m, double u)
{
    double   sum  = 0.0;
    uint32_t last = 0;

    for (uint32_t i = 0; i < m->n_mixes; i++) {
        if (m->mixes[i].probability <= 0.0) continue;
        last = i; /* rounding may leave the sum below u at the end: then the last one that can happen at all */
        sum += m->mixes[i].probability;
        if (u < sum) return i;
    }
    return last;
}

/* Cells carry their share of time; the table's shares are added up once per scenario, which is cheap beside any
 * realisation (10^4 cells take some 10 us) and keeps the campaign free of derived arrays. */
static uint32_t design_pick_cell(const fw_site *s, double u)
{
    double   sum  = 0.0;
    uint32_t last = 0;

    for (size_t i = 0; i < s->n_cells; i++) {
        if (s->cells[i].probability <= 0.0) continue;
        last = (uint32_t)i;
        sum += s->cells[i].probability;
        if (u < sum) return last;
    }
    return last;
}

static const double TURN = 2 * 3.14159265358979323846;

static void design_take_cell(const fw_site *s, uint32_t cell, fw_scenario *out)
{
    out->cell          = cell;
    out->concentration = s->cells[cell].concentration;
    out->speed         = s->cells[cell].speed;
    out->mix           = s->cells[cell].mix;
}

static void design_take_ice(const fw_campaign *c, const double *u, fw_scenario *out)
{
    if (c->site.n_cells) {
        design_take_cell(&c->site, design_pick_cell(&c->site, u[U_CELL]), out);
        return;
    }
    out->concentration = fw_distribution_quantile(&c->site.concentration, u[U_CONCENTRATION]);
    out->speed         = fw_distribution_quantile(&c->site.speed, u[U_SPEED]);
    out->mix           = design_pick_mix(&c->model, u[U_MIX]);
}

/* What stands in no stratum. */
static void design_take_weather(const fw_campaign *c, const double *u, fw_scenario *out)
{
    const fw_tide *t = &c->model.tide;

    if (c->model.effects & FW_EFFECT_WIND) {
        out->wind_speed = fw_distribution_quantile(&c->site.wind_speed, u[U_WIND_SPEED]);
        out->wind_angle = -fw_distribution_quantile(&c->site.wind_angle, u[U_WIND_ANGLE]) * TURN / 360; /* clockwise in the site, anticlockwise here */
    }
    if ((c->model.effects & FW_EFFECT_TIDE) && t->n_rows == 0) out->tide_phase = isnan(t->phase) ? TURN * u[U_TIDE] : t->phase; /* a table has none */
}

static void design_plain(const fw_campaign *c, uint64_t id, double *u)
{
    fw_random random;

    fw_random_stream(&random, c->seed, FW_STREAM_SCENARIO, id, 0);
    for (int i = 0; i < N_PLAIN; i++) u[i] = fw_random_uniform(&random);
    fw_random_stream(&random, c->seed, FW_STREAM_WIND, id, 0);
    u[U_WIND_SPEED] = fw_random_uniform(&random);
    u[U_WIND_ANGLE] = fw_random_uniform(&random);
    fw_random_stream(&random, c->seed, FW_STREAM_TIDE, id, 0);
    u[U_TIDE] = fw_random_uniform(&random);
}

/* Coordinates of low-discrepancy points in their order of use. */
static const int BY_WEIGHT[N_UNIFORMS] = {U_SPEED, U_CONCENTRATION, U_MIX, U_CELL, U_TIDE, U_WIND_SPEED, U_WIND_ANGLE};

/* With a joint table the cell says all of the ice, so it comes first. */
static void design_spread(const fw_campaign *c, const double *point, double *u)
{
    size_t k = c->site.n_cells ? 3 : 0;

    for (size_t i = 0; i < N_UNIFORMS; i++) u[BY_WEIGHT[(i + k) % N_UNIFORMS]] = point[i];
}

/* The stratum at v in [0, 1) of the allocation, and its weight. */
static size_t design_pick_stratum(const fw_strata *s, const fw_sampling *a, double v, double *weight)
{
    double sum  = 0;
    size_t last = 0;

    for (size_t i = 0; i < s->n; i++) {
        double share = fw_strata_share(s, i), q = a->n_allocation ? a->allocation[i] : share;

        if (!(share > 0)) continue;
        last    = i;
        *weight = share / q;
        sum += q;
        if (v < sum) break;
    }
    return last;
}

static void design_stratified(const fw_campaign *c, uint64_t k, uint64_t randomisation, double *u, fw_scenario *out)
{
    fw_strata strata;
    double    v, u_speed, u_concentration;
    size_t    stratum;

    fw_strata_make(&strata, &c->model, &c->site);
    fw_sobol_point(k, 1, FW_SCRAMBLE_OWEN, c->seed, randomisation, &v);
    stratum = design_pick_stratum(&strata, &c->sampling, v, &out->weight);
    if (c->site.n_cells) {
        design_take_cell(&c->site, (uint32_t)stratum, out);
        return;
    }
    fw_strata_place(&strata, stratum, u[U_SPEED], u[U_CONCENTRATION], &u_speed, &u_concentration, &out->mix);
    out->speed         = fw_distribution_quantile(&c->site.speed, u_speed);
    out->concentration = fw_distribution_quantile(&c->site.concentration, u_concentration);
}

void fw_campaign_plain_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    double u[N_UNIFORMS];

    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = -1};
    design_plain(c, id, u);
    design_take_ice(c, u, out);
    design_take_weather(c, u, out);
}

void fw_campaign_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    const fw_sampling *a = &c->sampling;
    uint64_t           n = a->design == FW_DESIGN_PLAIN ? 1 : a->n_randomisations, r = id % n, k = id / n;
    double             u[N_UNIFORMS], point[N_UNIFORMS];

    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = a->design == FW_DESIGN_PLAIN ? -1 : (int32_t)r};
    switch (a->design) {
    case FW_DESIGN_PLAIN:
    case FW_DESIGN_STRATIFIED: design_plain(c, id, u); break;
    case FW_DESIGN_LATIN:
        fw_latin_point(k % FW_LATIN_SIZE, FW_LATIN_SIZE, N_UNIFORMS, c->seed, r + k / FW_LATIN_SIZE * n, point);
        design_spread(c, point, u);
        break;
    case FW_DESIGN_SOBOL:
        fw_sobol_point(k, N_UNIFORMS, a->is_shifted ? FW_SCRAMBLE_SHIFT : FW_SCRAMBLE_OWEN, c->seed, r, point);
        design_spread(c, point, u);
        break;
    }
    if (a->design == FW_DESIGN_STRATIFIED)
        design_stratified(c, k, r, u, out);
    else
        design_take_ice(c, u, out);
    design_take_weather(c, u, out);
}

size_t fw_campaign_n_strata(const fw_campaign *c)
{
    fw_strata strata;

    fw_strata_make(&strata, &c->model, &c->site);
    return strata.n;
}

size_t fw_campaign_stratum(const fw_campaign *c, const fw_scenario *s)
{
    fw_strata strata;

    fw_strata_make(&strata, &c->model, &c->site);
    return fw_strata_find(&strata, s);
}

/* ---- the law itself ---------------------------------------------------------------------------------------------- */

/* With this many an average of log-linear functions of speed, concentration and mix is right to 1e-4 of their scatter (tests/campaign/test_law.c),
 * which a quarter of them miss where the concentration has a few values only. */
enum { LAW_POINTS = 1 << 15 };
/* No randomisation of a campaign has this number. */
static const uint64_t LAW_RANDOMISATION = UINT64_C(1) << 40;

static bool has_weather(const fw_campaign *c) { return (c->model.effects & (FW_EFFECT_WIND | FW_EFFECT_TIDE)) != 0; }

static bool has_one_scenario(const fw_campaign *c)
{
    return !c->site.n_cells && !has_weather(c) && fw_distribution_is_constant(&c->site.speed) && fw_distribution_is_constant(&c->site.concentration) && c->model.n_mixes == 1;
}

static void design_law_cell(const fw_campaign *c, uint64_t i, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = i, .weight = c->site.cells[i].probability, .randomisation = -1};
    design_take_cell(&c->site, (uint32_t)i, out);
}

/* Speed's quantile level at v in [0, 1]: closer towards fast currents, because depth goes as the cube of a speed that may have no upper limit. With
 * 8192 even levels averages of u^3 over a Weibull law were off by up to 1.6e-3 of its scatter. */
static double law_level(double v) { return 1 - pow(1 - v, 2); }

static void design_law_point(const fw_campaign *c, uint64_t i, fw_scenario *out)
{
    double u[N_UNIFORMS], point[N_UNIFORMS];

    *out = (fw_scenario){.seed = c->seed, .id = i, .weight = has_one_scenario(c) ? 1 : 1.0 / LAW_POINTS, .randomisation = -1};
    fw_sobol_point(i, N_UNIFORMS, FW_SCRAMBLE_OWEN, c->seed, LAW_RANDOMISATION, point);
    if (!c->site.n_cells && !fw_distribution_is_constant(&c->site.speed)) { /* one point in each n-th of v, which has this share of the levels */
        double slot = floor(point[0] * LAW_POINTS);
        out->weight = law_level((slot + 1) / LAW_POINTS) - law_level(slot / LAW_POINTS);
        point[0] = fmin(law_level(point[0]), 1 - 0x1p-53); /* 1 has no quantile */
    }
    design_spread(c, point, u);
    design_take_ice(c, u, out);
    design_take_weather(c, u, out);
}

fw_scenario_law fw_campaign_law(const fw_campaign *c)
{
    if (has_one_scenario(c)) return (fw_scenario_law){1, design_law_point};
    if (c->site.n_cells && !has_weather(c)) return (fw_scenario_law){c->site.n_cells, design_law_cell};
    return (fw_scenario_law){LAW_POINTS, design_law_point};
}
