/* Windows made up from a pilot: what they look like, and what they cost. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"
#include "realisation/cost.h"
#include "study/outlook_inside.h"

static fw_status fit(fw_outlook_windows *w, size_t n, const fw_record *pilot, fw_msg *m)
{
    fw_scenario *scenarios = NULL;
    double      *load = NULL;
    size_t       good = 0;
    fw_status    s = fw_alloc(&scenarios, n, sizeof *scenarios, "scenarios of the pilot", m);
    if (s == FW_OK) s = fw_alloc(&load, n, sizeof *load, "loads of the pilot", m);
    for (size_t i = 0; i < n && s == FW_OK; i++)
        if (pilot[i].status == FW_OK) scenarios[good] = fw_record_scenario(&pilot[i], w->campaign->seed), load[good++] = fw_record_mean_load(&pilot[i], 0);
    if (s == FW_OK) s = fw_emulator_fit(&w->emulator, w->campaign, w->strip, good, scenarios, load, m);
    free(scenarios);
    free(load);
    return s;
}

static const double NEARLY_ALL = 0.99;

/* Least squares in which a window counts by its load, so that those that carry the design value decide. */
typedef struct shape_fit {
    gsl_matrix                    *X, *cov;
    gsl_vector                    *y, *weight, *c;
    gsl_multifit_linear_workspace *work;
} shape_fit;

static void free_fit(shape_fit *f)
{
    if (f->work) gsl_multifit_linear_free(f->work);
    if (f->c) gsl_vector_free(f->c);
    if (f->weight) gsl_vector_free(f->weight);
    if (f->y) gsl_vector_free(f->y);
    if (f->cov) gsl_matrix_free(f->cov);
    if (f->X) gsl_matrix_free(f->X);
}

static bool make_fit(shape_fit *f, size_t n)
{
    *f = (shape_fit){gsl_matrix_alloc(n, FW_OUTLOOK_SHAPE), gsl_matrix_alloc(FW_OUTLOOK_SHAPE, FW_OUTLOOK_SHAPE), gsl_vector_alloc(n), gsl_vector_alloc(n),
                     gsl_vector_alloc(FW_OUTLOOK_SHAPE), gsl_multifit_linear_alloc(n, FW_OUTLOOK_SHAPE)};
    return f->X && f->cov && f->y && f->weight && f->c && f->work;
}

/* An arc that windows leave bare has no law of its own: the same share of the ring's load at all times. */
static void fit_bare(fw_outlook_windows *w, size_t k, size_t n, const fw_record *pilot)
{
    double load = 0, all = 0;
    for (size_t i = 0; i < n; i++)
        if (pilot[i].status == FW_OK) load += fw_record_load(&pilot[i], 0, FW_RING_LOAD)[k], all += fw_record_mean_load(&pilot[i], 0);
    w->shape[k * FW_OUTLOOK_SHAPE] = load > 0 ? log(load / all) : 0;
    w->scatter[k] = load > 0 ? 0.5 : NAN;
}

/* A window that left the arc bare has no weight. False: that is too much of the load. */
static bool fit_arc(fw_outlook_windows *w, size_t k, size_t n, const fw_record *pilot, shape_fit *f)
{
    double worn = 0, all = 0, chi2;
    for (size_t i = 0; i < n; i++) {
        const fw_record *r = &pilot[i];
        double           load = r->status == FW_OK ? fw_record_load(r, 0, FW_RING_LOAD)[k] : 0, mean = fw_record_mean_load(r, 0), share = load > 0 ? mean : 0;
        gsl_matrix_set(f->X, i, 0, 1);
        gsl_matrix_set(f->X, i, 1, log(r->concentration));
        gsl_matrix_set(f->X, i, 2, log(fmax(r->speed, FW_SLOWEST)));
        gsl_vector_set(f->y, i, load > 0 ? log(load / mean) : 0);
        gsl_vector_set(f->weight, i, share);
        worn += share, all += r->status == FW_OK ? mean : 0;
    }
    if (!(worn > NEARLY_ALL * all)) return false;
    gsl_vector_scale(f->weight, 1 / worn);
    if (gsl_multifit_wlinear(f->X, f->weight, f->y, f->c, f->cov, &chi2, f->work) != GSL_SUCCESS) return false;
    for (size_t q = 0; q < FW_OUTLOOK_SHAPE; q++) w->shape[k * FW_OUTLOOK_SHAPE + q] = gsl_vector_get(f->c, q);
    w->scatter[k] = fmin(1, sqrt(chi2)); /* weights sum to 1 */
    return true;
}

static fw_status take_shape(fw_outlook_windows *w, size_t n, const fw_record *pilot, fw_msg *m)
{
    shape_fit f;
    bool      is_made = make_fit(&f, n);
    for (size_t k = 0; k < w->n_arcs && is_made; k++)
        if (!fit_arc(w, k, n, pilot, &f)) fit_bare(w, k, n, pilot);
    free_fit(&f);
    return is_made ? FW_OK : fw_fail(m, FW_E_NOMEM, "out of memory: shape of the ring");
}

static fw_status take_cost(fw_outlook_windows *w, size_t n, const fw_record *pilot, fw_msg *m)
{
    double spent = 0, expected = 0;
    for (size_t i = 0; i < n; i++) {
        fw_scenario s = fw_record_scenario(&pilot[i], w->campaign->seed);
        double      one;
        FW_TRY(fw_cost_expected(&w->campaign->model, &s, &one, m));
        spent += pilot[i].force_evaluations, expected += one;
    }
    w->evaluations = expected > 0 ? spent / expected : 1;
    return FW_OK;
}

fw_status fw_outlook_windows_make(fw_outlook_windows *out, const fw_campaign *c, size_t n, const fw_record *pilot, fw_sanity *strip,
                                  const fw_outlook_options *o, fw_msg *m)
{
    *out = (fw_outlook_windows){.campaign = c, .o = o, .strip = strip, .n_arcs = c->model.n_arcs};
    fw_status s = fw_alloc(&out->shape, out->n_arcs * FW_OUTLOOK_SHAPE, sizeof *out->shape, "shape of the ring", m);
    if (s == FW_OK) s = fw_alloc(&out->scatter, out->n_arcs, sizeof *out->scatter, "scatter round the ring", m);
    if (s == FW_OK) s = fit(out, n, pilot, m);
    if (s == FW_OK) s = take_shape(out, n, pilot, m);
    if (s == FW_OK) s = take_cost(out, n, pilot, m);
    if (s != FW_OK) fw_outlook_windows_free(out);
    return s;
}

void fw_outlook_windows_free(fw_outlook_windows *w)
{
    free(w->shape);
    free(w->scatter);
    memset(w, 0, sizeof *w);
}

/* Neighbouring arcs share their ice: a normal for every 15 degrees, straight between them. */
void fw_outlook_windows_draw(const fw_outlook_windows *w, const fw_scenario *s, uint64_t part, fw_record *r)
{
    enum { N = 24 };
    const double VARIANCE = 2.0 / 3; /* mean over a stretch of that of a value straight between two */
    fw_random    g;
    double       z[N + 1];
    fw_random_stream(&g, s->seed, FW_STREAM_OUTLOOK, s->id, part);
    double level = exp(fw_emulator_ln_load(&w->emulator, s) + w->emulator.held_out * gsl_cdf_ugaussian_Pinv(fw_random_uniform(&g)));
    for (int i = 0; i < N; i++) z[i] = gsl_cdf_ugaussian_Pinv(fw_random_uniform(&g));
    z[N] = z[0];
    double *load = r->rings + r->n_arcs, ln_c = log(s->concentration), ln_u = log(fmax(s->speed, FW_SLOWEST));
    for (size_t k = 0; k < w->n_arcs; k++) {
        double at = (double)k * N / (double)w->n_arcs, part_of = at - floor(at);
        size_t i = (size_t)at;
        double noise = (z[i] * (1 - part_of) + z[i + 1] * part_of) / sqrt(VARIANCE);
        const double *b = w->shape + k * FW_OUTLOOK_SHAPE;
        load[k] = isnan(w->scatter[k]) ? 0 : level * exp(b[0] + b[1] * ln_c + b[2] * ln_u + w->scatter[k] * noise);
    }
    fw_record_take_scenario(r, s);
    r->status = FW_OK;
}

fw_status fw_outlook_windows_cost(const fw_outlook_windows *w, const fw_scenario *s, double *evaluations, fw_msg *m)
{
    FW_TRY(fw_cost_expected(&w->campaign->model, s, evaluations, m));
    *evaluations *= w->evaluations;
    return FW_OK;
}
