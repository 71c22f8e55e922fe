/* A campaign and its records made up for the tests of study: lognormal loads with a shape round the ring. */
#ifndef FW_TESTS_STUDY_MADE_UP_H
#define FW_TESTS_STUDY_MADE_UP_H

#include <gsl/gsl_cdf.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "check.h"
#include "study/answer.h"

static inline fw_distribution made_up_law(fw_distribution_kind kind, double a, double b)
{
    return (fw_distribution){.kind = kind, .a = a, .b = b, .low = -INFINITY, .high = INFINITY};
}

/* 24 points from north, 360 arcs, one law a |T|^-1.121 with T = -10 degC and a current towards the north. */
static inline fw_campaign made_up_campaign(double *bearings)
{
    fw_campaign c;
    memset(&c, 0, sizeof c);
    strcpy(c.name, "made up");
    c.model.n_arcs = 360;
    c.model.n_laws = 1;
    c.model.laws[0] = (fw_abrasion_law){"bekker2011", 0.116, 1.121, true};
    c.model.window = 10800;
    c.model.accuracy = 0.01;
    c.points.n = 24;
    c.points.bearing = bearings;
    for (size_t i = 0; i < 24; i++) bearings[i] = 15.0 * (double)i;
    fw_distribution_constant(&c.site.temperature, -10);
    fw_distribution_constant(&c.site.direction, 0);
    c.precision = (fw_precision){
        .quantity = FW_QUANTITY_PERCENTILE, .percentile = 90, .half_width = 0.1, .confidence = 0.95};
    c.service = (fw_service){.is_asked = true, .life_years = 50, .ice_hours_per_year = 1200};
    return c;
}

/* Load of record id: lognormal (sigma) times 1 + cos(theta - twist); every n_good-th record fails when fails is set. */
typedef struct made_up {
    const fw_campaign *campaign;
    double             sigma, twist_deg;
    uint64_t           fail_every; /* 0: none fails */
} made_up;

static inline double made_up_size(const made_up *s, uint64_t id)
{
    fw_random r;
    fw_random_stream(&r, 7, FW_STREAM_TEST, id, 0);
    return exp(s->sigma * gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r)));
}

static inline double made_up_shape(const made_up *s, size_t arc, size_t n_arcs)
{
    return 1 + cos(((double)arc + 0.5) * 6.283185307179586 / (double)n_arcs - s->twist_deg * 0.017453292519943295);
}

static inline double made_up_thickness(uint64_t id) { return 0.5 + 0.1 * (double)(id % 7); }

static inline fw_status made_up_read(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    (void)m;
    const made_up *s = self;
    size_t         n = r->n_arcs;
    bool           is_failed = s->fail_every && id % s->fail_every == s->fail_every - 1;
    double         size = made_up_size(s, id);
    r->id = id;
    r->status = is_failed ? FW_E_NUMERIC : FW_OK;
    r->host_cpu_s = 2;
    r->wear_thickness = made_up_thickness(id);
    r->weight = 1, r->randomisation = -1;
    memset(r->rings, 0, fw_record_n_rings(n, r->n_laws) * sizeof *r->rings);
    for (size_t k = 0; k < n && !is_failed; k++) {
        r->rings[k] = 1e-3; /* path [km] */
        for (size_t law = 0; law < r->n_laws; law++) {
            double *ring = r->rings + n * (1 + FW_RINGS_PER_LAW * law);
            ring[k] = size * made_up_shape(s, k, n);
            ring[n + k] = 0.75 * ring[k];
            ring[2 * n + k] = 0.2 * ring[k];
        }
    }
    return FW_OK;
}

static inline fw_answer_source made_up_source(made_up *s, uint64_t n)
{
    return (fw_answer_source){.records = {.n = n, .read = made_up_read, .self = s}};
}

#endif
