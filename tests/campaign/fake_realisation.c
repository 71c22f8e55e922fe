#include "campaign/fake_realisation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"

fw_fake fw_fake_settings = {.nomem_id = -1};

void fw_fake_from_environment(void)
{
    const char *s;

    if ((s = getenv("FAKE_COST_MS"))) fw_fake_settings.cost_s = 1e-3 * strtod(s, NULL);
    if ((s = getenv("FAKE_SPREAD"))) fw_fake_settings.cost_spread = strtod(s, NULL);
    if ((s = getenv("FAKE_FAIL_EVERY"))) fw_fake_settings.fail_every = strtoll(s, NULL, 10);
    if ((s = getenv("FAKE_NOMEM_ID"))) fw_fake_settings.nomem_id = strtoll(s, NULL, 10);
}

static double cpu_seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Use up processor time in slices of 2 ms with a tick after each. What the ticks take is not counted as work, so that a
 * master which serves many workers has to pay for it. */
static fw_status fake_spin(double cost, const fw_tick *tick, double *spent)
{
    volatile double x = 1.0;

    *spent = 0.0;
    while (*spent < cost) {
        double start = cpu_seconds(), slice = fmin(2e-3, cost - *spent), used = 0.0;

        while (used < slice) {
            for (int i = 0; i < 1000; i++) x = x * 1.0000001 + 1e-9;
            used = cpu_seconds() - start;
        }
        *spent += used;
        if (tick) FW_TRY(tick->call(tick->self, *spent / cost));
    }
    return FW_OK;
}

fw_status fw_realise(const fw_model *model, const fw_scenario *scenario, const fw_tick *tick, fw_record *out, fw_msg *m)
{
    const fw_fake *f = &fw_fake_settings;
    fw_random      random;
    double         spent, cost;
    int64_t        id = (int64_t)scenario->id;
    size_t         n;

    fw_fake_settings.n_calls++;
    fw_random_stream(&random, scenario->seed, FW_STREAM_TEST, scenario->id, 0);
    cost = f->cost_s * (1.0 + f->cost_spread * (2.0 * fw_random_uniform(&random) - 1.0));
    if (id == f->nomem_id) return fw_fail(m, FW_E_NOMEM, "out of memory on purpose");
    FW_TRY(fake_spin(cost, tick, &spent));

    FW_TRY(fw_record_init(out, model->n_arcs, model->n_laws, m));
    out->id            = scenario->id;
    out->concentration = scenario->concentration;
    out->speed         = scenario->speed;
    out->mix           = scenario->mix;
    out->cell          = scenario->cell;
    out->weight        = scenario->weight;
    out->randomisation = scenario->randomisation;
    out->window        = model->window;
    out->host_cpu_s    = spent;
    if (f->fail_every > 0 && id % f->fail_every == 0) {
        out->status = FW_E_NUMERIC;
        snprintf(out->cause, sizeof out->cause, "failed on purpose");
        return FW_OK; /* zero rings */
    }

    out->hits = floor(100.0 * fw_random_uniform(&random));
    n         = fw_record_n_rings(model->n_arcs, model->n_laws);
    for (size_t i = 0; i < n; i++) { /* wear grows with the cube of the speed, scatters by a third */
        out->rings[i] = 1e-3 * pow(scenario->speed, 3.0) * scenario->concentration * (0.5 + fw_random_uniform(&random));
    }
    return FW_OK;
}

fw_status fw_fake_campaign(fw_campaign *c, uint64_t seed, uint64_t max_realisations, fw_msg *m)
{
    char settings[128];

    memset(c, 0, sizeof *c);
    snprintf(c->name, sizeof c->name, "fake");
    c->seed              = seed;
    c->model.n_arcs      = 72;
    c->model.n_laws      = 1;
    c->model.laws[0]     = (fw_abrasion_law){"archard", 1.0, 1.0, false};
    c->model.window      = 60.0;
    c->model.n_mixes     = 2;
    c->model.mixes[0]    = (fw_thickness_mix){.probability = 0.25, .n_classes = 1, .classes = {{0.5, 1.0}}};
    c->model.mixes[1]    = (fw_thickness_mix){.probability = 0.75, .n_classes = 1, .classes = {{0.9, 1.0}}};
    c->site.speed        = (fw_distribution){.kind = FW_DIST_UNIFORM, .a = 0.5, .b = 1.5,
                                             .low = -INFINITY, .high = INFINITY};
    c->site.concentration = c->site.speed;
    c->site.concentration.a = 0.2;
    c->site.concentration.b = 0.6;
    fw_distribution_constant(&c->site.direction, 90.0);
    fw_distribution_constant(&c->site.temperature, -10.0);
    c->site.temperature_floor     = 1.8;
    c->precision.quantity         = FW_QUANTITY_MEAN;
    c->precision.confidence       = 0.95;
    c->precision.max_realisations = max_realisations;
    c->precision.max_failed       = max_realisations;

    snprintf(settings, sizeof settings, "name = fake\nseed = %llu\n", (unsigned long long)seed);
    c->hash     = fw_fnv1a64(settings, strlen(settings));
    c->settings = fw_strdup(settings);
    c->text     = fw_strdup("name: fake\n");
    c->points.n = 3;
    FW_TRY(fw_alloc(&c->points.bearing, 3, sizeof(double), "points", m));
    for (int i = 0; i < 3; i++) c->points.bearing[i] = 30.0 * i;
    FW_CHECK(c->settings && c->text, m, FW_E_NOMEM, "out of memory");
    return FW_OK;
}
