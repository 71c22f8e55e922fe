#include "study/control.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { FEWEST = 60, PER_FUNCTION = 15, MOST_KNOTS = 12, FEWEST_KNOTS = 4, HARMONICS = 2 };
/* Straight weights below this part of themselves are raked. A weight that grows beyond this says that there are too many functions for these scenarios. */
static const double LEAST_WEIGHT = 0.2, MOST_WEIGHT = 5;

/* Which functions, and where the knots are. */
typedef struct functions {
    const fw_campaign *campaign;
    const fw_emulator *emulator;
    size_t             n_knots, n_own, n_harmonics; /* own: concentration and mix */
    bool               has_load;
    double             knot[MOST_KNOTS];
    const double      *harmonic; /* (n_cells x 2 HARMONICS); NULL without a joint table */
} functions;

static size_t n_shapes(const functions *f) { return f->n_knots + (f->has_load ? 1 : 0); }

static size_t count(const functions *f) { return n_shapes(f) * (1 + 2 * f->n_harmonics) + f->n_own; }

/* 1 at its own knot, 0 at the others, straight between; constant beyond the outer ones. */
static void hats(const functions *f, double x, double *values)
{
    size_t k = 0;
    for (size_t j = 0; j < f->n_knots; j++) values[j] = 0;
    if (!(x > f->knot[0])) {
        values[0] = 1;
        return;
    }
    while (k + 1 < f->n_knots && x >= f->knot[k + 1]) k++;
    if (k + 1 == f->n_knots) {
        values[k] = 1;
        return;
    }
    double part = (x - f->knot[k]) / (f->knot[k + 1] - f->knot[k]);
    values[k] = 1 - part, values[k + 1] = part;
}

/* ln_load: the emulator's, of the scenario. */
static void evaluate(const functions *f, const fw_scenario *s, double ln_load, double *values)
{
    size_t n = n_shapes(f), at = n;
    hats(f, ln_load, values);
    if (f->has_load) values[f->n_knots] = exp(ln_load - f->knot[f->n_knots - 1]);
    for (size_t h = 0; h < 2 * f->n_harmonics; h++)
        for (size_t j = 0; j < n; j++) values[at++] = values[j] * f->harmonic[s->cell * 2 * HARMONICS + h];
    double ln_c = log(fmax(s->concentration, 1e-6));
    if (f->n_own) values[at++] = ln_c;
    for (uint32_t k = 1; k < f->campaign->model.n_mixes && f->n_own; k++) values[at++] = s->mix == k, values[at++] = s->mix == k ? ln_c : 0;
}

/* Mean cosine and sine of j times the direction in a cell. */
static fw_status make_harmonics(const fw_site *site, double **out, fw_msg *m)
{
    enum { LEVELS = 256 };
    const double RADIAN = 3.14159265358979323846 / 180;
    *out = NULL;
    if (site->n_cells == 0) return FW_OK;
    FW_TRY(fw_alloc(out, site->n_cells * 2 * HARMONICS, sizeof **out, "harmonics of direction laws", m));
    for (size_t i = 0; i < site->n_cells; i++)
        for (size_t k = 0; k < LEVELS; k++) {
            double d = RADIAN * fw_distribution_quantile(&site->cells[i].direction, ((double)k + 0.5) / LEVELS);
            for (size_t h = 0; h < HARMONICS; h++) {
                double *to = *out + (i * HARMONICS + h) * 2;
                to[0] += cos((double)(h + 1) * d) / LEVELS, to[1] += sin((double)(h + 1) * d) / LEVELS;
            }
        }
    return FW_OK;
}

/* ---- the law of scenarios ---------------------------------------------------------------------------------------- */

typedef struct law_point {
    double      ln_load;
    fw_scenario scenario;
} law_point;

static int by_ln_load(const void *a, const void *b)
{
    double x = ((const law_point *)a)->ln_load, y = ((const law_point *)b)->ln_load;
    return (x > y) - (x < y);
}

static fw_status make_law(const fw_campaign *c, const fw_scenario_law *law, const fw_emulator *e, law_point **out, fw_msg *m)
{
    FW_TRY(fw_alloc(out, (size_t)law->n, sizeof **out, "points of the law of scenarios", m));
    for (uint64_t i = 0; i < law->n; i++) {
        law->point(c, i, &(*out)[i].scenario);
        (*out)[i].ln_load = fw_emulator_ln_load(e, &(*out)[i].scenario);
    }
    qsort(*out, (size_t)law->n, sizeof **out, by_ln_load);
    return FW_OK;
}

static void place_knots(functions *f, size_t n_knots, size_t n_law, const law_point *law)
{
    double sum = 0;
    size_t i = 0;
    f->n_knots = 0;
    for (size_t j = 0; j < n_knots; j++) {
        double back = 1 - (double)j / (double)(n_knots - 1), level = 1 - back * back;
        for (; i + 1 < n_law && sum + law[i].scenario.weight < level * (1 - 1e-12); i++) sum += law[i].scenario.weight;
        if (f->n_knots == 0 || law[i].ln_load > f->knot[f->n_knots - 1] + 1e-9) f->knot[f->n_knots++] = law[i].ln_load;
    }
}

/* ---- the weights ------------------------------------------------------------------------------------------------- */

static void take_range(fw_control *x)
{
    x->least = INFINITY, x->most = 0;
    for (size_t i = 0; i < x->calibration.n; i++) {
        double ratio = x->calibration.weight[i] / x->calibration.plain[i];
        x->least = fmin(x->least, ratio), x->most = fmax(x->most, ratio);
    }
}

static fw_status rake(fw_control *x, fw_msg *m)
{
    bool is_done = false;
    FW_TRY(fw_calibration_rake(&x->calibration, &is_done, m));
    if (is_done) take_range(x);
    return FW_OK;
}

static fw_status calibrate(fw_control *x, const functions *f, size_t n_law, const law_point *law, size_t n, const fw_scenario *scenarios,
                           const double *plain, fw_msg *m)
{
    size_t  p = count(f);
    double *basis = NULL, *totals = NULL, *values = NULL;
    fw_status s = fw_alloc(&basis, n * p, sizeof *basis, "functions of scenarios", m);
    if (s == FW_OK) s = fw_alloc(&totals, p, sizeof *totals, "means of functions", m);
    if (s == FW_OK) s = fw_alloc(&values, p, sizeof *values, "functions of a scenario", m);
    for (size_t i = 0; i < n_law && s == FW_OK; i++) {
        evaluate(f, &law[i].scenario, law[i].ln_load, values);
        for (size_t k = 0; k < p; k++) totals[k] += law[i].scenario.weight * values[k];
    }
    for (size_t i = 0; i < n && s == FW_OK; i++) evaluate(f, &scenarios[i], fw_emulator_ln_load(f->emulator, &scenarios[i]), basis + i * p);
    if (s == FW_OK) s = fw_calibration_make(&x->calibration, n, plain, p, basis, totals, m);
    if (s == FW_OK) take_range(x);
    if (s == FW_OK && x->least < LEAST_WEIGHT) s = rake(x, m);
    free(basis);
    free(totals);
    free(values);
    return s;
}

/* What n realisations have room for, and less at every further attempt: without the load itself, which few windows of the fastest scenarios hold; then
 * without what is beside the knots; then with fewer knots. False: nothing is left. */
static bool choose(functions *f, const fw_campaign *c, size_t n, size_t attempt, size_t *n_knots)
{
    size_t room = n / PER_FUNCTION, fewer = attempt > 2 ? 2 * (attempt - 2) : 0;
    f->has_load = attempt == 0;
    f->n_harmonics = c->site.n_cells == 0 || attempt > 2 ? 0 : room >= 5 * 8 ? 2 : room >= 3 * FEWEST_KNOTS ? 1 : 0;
    f->n_own = 1 + 2 * (c->model.n_mixes - 1);
    if (c->site.n_cells || room < f->n_own + 7 || attempt > 1) f->n_own = 0;
    size_t shapes = (room - f->n_own) / (1 + 2 * f->n_harmonics);
    *n_knots = shapes > MOST_KNOTS + 1 ? MOST_KNOTS : shapes > 0 ? shapes - 1 : 0;
    if (*n_knots < FEWEST_KNOTS + fewer) return false;
    *n_knots -= fewer;
    return true;
}

static fw_status switch_on(fw_control *x, const fw_campaign *c, const fw_scenario_law *law, size_t n, const fw_scenario *scenarios, const double *plain,
                           fw_msg *m)
{
    functions  f = {.campaign = c, .emulator = &x->emulator};
    law_point *points = NULL;
    double    *harmonic = NULL;
    size_t     n_knots = 0;
    fw_status  s = make_harmonics(&c->site, &harmonic, m);
    if (s == FW_OK) s = make_law(c, law, &x->emulator, &points, m);
    f.harmonic = harmonic;
    for (size_t attempt = 0; s == FW_OK && !x->is_on && choose(&f, c, n, attempt, &n_knots); attempt++) {
        place_knots(&f, n_knots, (size_t)law->n, points);
        if (f.n_knots < 2) break; /* all scenarios wear alike */
        fw_calibration_free(&x->calibration);
        s = calibrate(x, &f, (size_t)law->n, points, n, scenarios, plain, m);
        x->is_on = x->least > 0 && x->most < MOST_WEIGHT;
        x->has_load = x->is_on && f.has_load;
    }
    free(points);
    free(harmonic);
    return s;
}

fw_status fw_control_make(fw_control *out, const fw_campaign *c, const fw_scenario_law *law, const fw_sanity *strip, size_t n, const fw_scenario *scenarios,
                          const double *ring_load, const double *plain, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    fw_status s = fw_emulator_fit(&out->emulator, c, strip, n, scenarios, ring_load, m);
    if (s == FW_OK && law && law->n > 1 && n >= FEWEST && out->emulator.n_functions > 0)
        s = switch_on(out, c, law, n, scenarios, plain, m);
    if (s == FW_OK && !out->is_on) {
        fw_calibration_free(&out->calibration);
        out->least = out->most = 1;
        s = fw_calibration_make(&out->calibration, n, plain, 0, NULL, NULL, m);
    }
    if (s != FW_OK) fw_control_free(out);
    return s;
}

void fw_control_free(fw_control *x)
{
    if (!x) return;
    fw_calibration_free(&x->calibration);
    memset(x, 0, sizeof *x);
}
