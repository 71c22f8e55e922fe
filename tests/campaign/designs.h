/* Campaigns for the tests of sampling designs: a site whose means are closed forms, drawn by any design. */
#ifndef FW_TESTS_CAMPAIGN_DESIGNS_H
#define FW_TESTS_CAMPAIGN_DESIGNS_H

#include "base/memory.h"
#include "campaign/fake_realisation.h"
#include "campaign/strata.h"
#include "check.h"

enum { N_WAYS = 6 };
static const char *const WAYS[N_WAYS] = {"plain", "stratified", "stratified, skewed", "latin hypercube", "sobol", "sobol, shifted"};

/* Shares of the realisations from 1 to 10 times each other where the site's are not: fast, dense strata are drawn more often. */
static inline void designs_skew(fw_campaign *c)
{
    fw_strata s;
    double    sum = 0;
    fw_strata_make(&s, &c->model, &c->site);
    assert_int_equal(fw_alloc(&c->sampling.allocation, s.n, sizeof(double), "allocation", NULL), FW_OK);
    c->sampling.n_allocation = s.n;
    for (size_t i = 0; i < s.n; i++) {
        c->sampling.allocation[i] = fw_strata_share(&s, i) * (1 + 9 * (double)i / (double)s.n);
        sum += c->sampling.allocation[i];
    }
    for (size_t i = 0; i < s.n; i++) c->sampling.allocation[i] /= sum;
}

static inline void designs_choose(fw_campaign *c, int way, uint32_t n_randomisations)
{
    static const fw_design design[N_WAYS] = {FW_DESIGN_PLAIN, FW_DESIGN_STRATIFIED, FW_DESIGN_STRATIFIED, FW_DESIGN_LATIN, FW_DESIGN_SOBOL, FW_DESIGN_SOBOL};
    c->sampling.design = design[way];
    c->sampling.n_randomisations = n_randomisations;
    c->sampling.is_shifted = way == 5;
    if (way == 2) designs_skew(c);
}

/* Speed uniform on [0.5, 1.5], concentration on [0.2, 0.6], mixes 1 : 3 (fake_realisation.c). */
static inline fw_campaign designs_campaign(uint64_t seed, int way, uint32_t n_randomisations)
{
    fw_campaign c;
    assert_int_equal(fw_fake_campaign(&c, seed, 1000, NULL), FW_OK);
    designs_choose(&c, way, n_randomisations);
    return c;
}

/* Four cells, of which the second never happens. */
static const double CELL_SHARE[4] = {0.1, 0, 0.35, 0.55}, CELL_SPEED[4] = {0.2, 0.3, 1, 2};

static inline fw_campaign designs_joint_campaign(uint64_t seed, int way)
{
    fw_campaign c;
    assert_int_equal(fw_fake_campaign(&c, seed, 1000, NULL), FW_OK);
    c.site.n_cells = 4;
    assert_int_equal(fw_alloc(&c.site.cells, 4, sizeof *c.site.cells, "cells", NULL), FW_OK);
    for (uint32_t i = 0; i < 4; i++) {
        c.site.cells[i] = (fw_site_cell){.probability = CELL_SHARE[i], .speed = CELL_SPEED[i], .concentration = 0.1 * (i + 1), .mix = i % 2};
        fw_distribution_constant(&c.site.cells[i].direction, 45.0 * i);
    }
    designs_choose(&c, way, 16);
    return c;
}

/* Angles uniform on [0, 90] deg clockwise, phases on a full turn. */
static inline void designs_add_weather(fw_campaign *c)
{
    c->model.effects |= FW_EFFECT_WIND | FW_EFFECT_TIDE;
    c->model.tide = (fw_tide){.period = 44712, .phase = NAN};
    c->site.wind_speed = (fw_distribution){.kind = FW_DIST_UNIFORM, .a = 5, .b = 15, .low = -INFINITY, .high = INFINITY};
    c->site.wind_angle = (fw_distribution){.kind = FW_DIST_UNIFORM, .b = 90, .low = -INFINITY, .high = INFINITY};
}

#endif
