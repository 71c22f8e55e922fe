/* The sampling design: id -> scenario.
 *
 * Plain sampling. Every scenario takes its numbers from its own stream in a fixed order, one uniform per quantity
 * whether the site needs it or not, so that a site that turns a constant into a law leaves the other quantities'
 * numbers alone:
 *
 *   u[0] concentration   u[1] speed   u[2] thickness mix   u[3] cell of the joint table
 *
 * What came later has a stream of its own, so that it shifts none of these:
 *
 *   wind   u[0] speed   u[1] angle          tide   u[0] phase */
#include <math.h>

#include "base/random.h"
#include "floewear/campaign.h"

enum { U_CONCENTRATION, U_SPEED, U_MIX, U_CELL, N_UNIFORMS };

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

static void design_draw_wind(const fw_site *s, fw_scenario *out)
{
    fw_random random;
    double    u[2];

    fw_random_stream(&random, out->seed, FW_STREAM_WIND, out->id, 0);
    for (int i = 0; i < 2; i++) u[i] = fw_random_uniform(&random);
    out->wind_speed = fw_distribution_quantile(&s->wind_speed, u[0]);
    out->wind_angle = -fw_distribution_quantile(&s->wind_angle, u[1]) * TURN / 360; /* clockwise in the site, anticlockwise here */
}

static double design_draw_phase(const fw_tide *t, const fw_scenario *s)
{
    fw_random random;

    if (t->n_rows > 0) return 0; /* a table has none */
    if (!isnan(t->phase)) return t->phase;
    fw_random_stream(&random, s->seed, FW_STREAM_TIDE, s->id, 0);
    return TURN * fw_random_uniform(&random);
}

void fw_campaign_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    fw_random random;
    double    u[N_UNIFORMS];

    fw_random_stream(&random, c->seed, FW_STREAM_SCENARIO, id, 0);
    for (int i = 0; i < N_UNIFORMS; i++) u[i] = fw_random_uniform(&random);

    *out = (fw_scenario){.seed = c->seed, .id = id};
    if (c->site.n_cells) {
        const fw_site_cell *cell;

        out->cell          = design_pick_cell(&c->site, u[U_CELL]);
        cell               = &c->site.cells[out->cell];
        out->concentration = cell->concentration;
        out->speed         = cell->speed;
        out->mix           = cell->mix;
    } else {
        out->concentration = fw_distribution_quantile(&c->site.concentration, u[U_CONCENTRATION]);
        out->speed         = fw_distribution_quantile(&c->site.speed, u[U_SPEED]);
        out->mix           = design_pick_mix(&c->model, u[U_MIX]);
    }
    if (c->model.effects & FW_EFFECT_WIND) design_draw_wind(&c->site, out);
    if (c->model.effects & FW_EFFECT_TIDE) out->tide_phase = design_draw_phase(&c->model.tide, out);
}
