#include "study/law_factor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"
#include "study/depth.h"

enum { PART = 3 /* of the service streams */ };

/* ---- draws ------------------------------------------------------------------------------------------------------ */

/* n stratified draws in an order of their own (Fisher and Yates), times what is there. */
static fw_status draw(double *to, size_t n, const fw_distribution *d, uint64_t seed, uint64_t which, fw_msg *m)
{
    uint32_t *order = NULL;
    fw_random r;
    fw_random_stream(&r, seed, FW_STREAM_SERVICE, which, PART);
    FW_TRY(fw_alloc(&order, n, sizeof *order, "draws of a law", m));
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
    for (size_t i = n; i > 1; i--) {
        size_t   k = (size_t)(fw_random_uniform(&r) * (double)i);
        uint32_t other = order[k];
        order[k] = order[i - 1], order[i - 1] = other;
    }
    for (size_t i = 0; i < n; i++) to[i] *= fw_distribution_quantile(d, ((double)order[i] + fw_random_uniform(&r)) / (double)n);
    free(order);
    return FW_OK;
}

static fw_status draw_all(fw_law_factor *f, const fw_campaign *c, size_t n, fw_msg *m)
{
    const fw_after *a = &c->after;
    FW_TRY(fw_alloc(&f->common, n, sizeof *f->common, "draws of a law", m));
    for (size_t i = 0; i < n; i++) f->common[i] = 1;
    if (a->has_law_scatter) FW_TRY(draw(f->common, n, &a->law_scatter, c->seed, 0, m));
    if (a->has_law_coefficient) FW_TRY(draw(f->common, n, &a->law_coefficient, c->seed, 1, m));
    f->n = n;
    if (!a->has_law_exponent) return FW_OK;
    FW_TRY(fw_alloc(&f->exponent, n, sizeof *f->exponent, "draws of a law", m));
    for (size_t i = 0; i < n; i++) f->exponent[i] = 1;
    return draw(f->exponent, n, &a->law_exponent, c->seed, 2, m);
}

/* ---- mean depths of the campaign's laws ------------------------------------------------------------------------- */

/* Means of all points under one law. */
static fw_status take_means(fw_law_factor *f, size_t node, const fw_campaign *c, const fw_answer_source *source, size_t law, size_t n_points,
                            const double *bearings, fw_msg *m)
{
    fw_depth  d;
    fw_window w;
    FW_TRY(fw_depth_make(&d, c, law, n_points, bearings, m));
    fw_status s = fw_depth_stream(&d, NULL, &source->records, m);
    if (s == FW_OK) s = fw_depth_settle(&d, source->law.point ? &source->law : NULL, NULL, m);
    for (size_t i = 0; i < n_points && s == FW_OK; i++) {
        s = fw_window_make(&w, &d, i, m);
        if (s != FW_OK) break;
        f->ln_mean[i * FW_MAX_LAWS + node] = log(w.moment[1] / c->model.laws[law].coefficient);
        fw_window_free(&w);
    }
    fw_depth_free(&d);
    return s;
}

static fw_status take_nodes(fw_law_factor *f, const fw_campaign *c, const fw_answer_source *source, size_t n_points, const double *bearings, fw_msg *m)
{
    size_t law[FW_MAX_LAWS];
    for (size_t i = 0; i < c->model.n_laws; i++) {
        const fw_abrasion_law *q = &c->model.laws[i];
        size_t                 at = 0;
        if (q->uses_temperature != c->model.laws[0].uses_temperature) continue;
        while (at < f->n_nodes && f->node[at] < q->exponent) at++;
        if (at < f->n_nodes && f->node[at] == q->exponent) continue; /* another coefficient: the same load */
        for (size_t k = f->n_nodes++; k > at; k--) f->node[k] = f->node[k - 1], law[k] = law[k - 1];
        f->node[at] = q->exponent, law[at] = i;
    }
    f->own = c->model.laws[0].exponent;
    for (size_t i = 0; i < f->n; i++)
        FW_CHECK(f->exponent[i] >= f->node[0] * (1 - 1e-12) && f->exponent[i] <= f->node[f->n_nodes - 1] * (1 + 1e-12), m, FW_E_ARG,
                 "an exponent of %g lies outside those of the campaign's laws, %g to %g", f->exponent[i], f->node[0], f->node[f->n_nodes - 1]);
    FW_TRY(fw_alloc(&f->ln_mean, n_points * FW_MAX_LAWS, sizeof *f->ln_mean, "mean depths of the laws", m));
    for (size_t k = 0; k < f->n_nodes; k++) FW_TRY(take_means(f, k, c, source, law[k], n_points, bearings, m));
    return FW_OK;
}

fw_status fw_law_factor_make(fw_law_factor *out, const fw_campaign *c, const fw_answer_source *source, size_t law, size_t n_points,
                             const double *bearings, size_t n_draws, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    if (law != 0 || !(c->after.has_law_scatter || c->after.has_law_coefficient || c->after.has_law_exponent)) return FW_OK;
    fw_status s = draw_all(out, c, n_draws, m);
    if (s == FW_OK && out->exponent) s = take_nodes(out, c, source, n_points, bearings, m);
    if (s != FW_OK) fw_law_factor_free(out);
    return s;
}

void fw_law_factor_free(fw_law_factor *f)
{
    if (!f) return;
    free(f->common);
    free(f->exponent);
    free(f->ln_mean);
    memset(f, 0, sizeof *f);
}

static double ln_mean_at(const fw_law_factor *f, const double *ln_mean, double exponent)
{
    size_t k = 0;
    if (f->n_nodes == 1) return ln_mean[0];
    while (k + 2 < f->n_nodes && f->node[k + 1] < exponent) k++;
    double part = (exponent - f->node[k]) / (f->node[k + 1] - f->node[k]);
    return part == 0 ? ln_mean[k] : part == 1 ? ln_mean[k + 1] : (1 - part) * ln_mean[k] + part * ln_mean[k + 1];
}

void fw_law_factor_of_point(const fw_law_factor *f, size_t i, double *out)
{
    const double *ln_mean = f->ln_mean ? f->ln_mean + i * FW_MAX_LAWS : NULL;
    bool          wears = ln_mean && isfinite(ln_mean[0]); /* where nothing wore, no exponent makes it wear */
    double        own = wears ? ln_mean_at(f, ln_mean, f->own) : 0;
    for (size_t k = 0; k < f->n; k++) out[k] = f->common[k] * (wears ? exp(ln_mean_at(f, ln_mean, f->exponent[k]) - own) : 1);
}
