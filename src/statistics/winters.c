#include "statistics/winters.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"

enum { SCORES = 3000000, FEWEST = 256, MOST = 16384, PART = 1 /* of the service streams */ };

static float node_of(double score)
{
    double at = (score + FW_SCORES_REACH) * FW_SCORES_PER_UNIT;
    return (float)fmin(fmax(at, 0), FW_SCORES_NODES - 1.001);
}

fw_status fw_winters_make(fw_winters *out, uint64_t seed, double phi, size_t longest, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_CHECK(phi >= 0 && phi < 1, m, FW_E_ARG, "a correlation of %g from window to window is outside [0, 1)", phi);
    out->block = longest > 0 ? (longest + FW_WINTERS_LONGEST - 1) / FW_WINTERS_LONGEST : 1;
    out->n_scores = (longest + out->block - 1) / out->block;
    out->phi = phi;
    size_t n = SCORES / (longest > 0 ? out->n_scores : 1);
    out->n_winters = n < FEWEST ? FEWEST : n > MOST ? MOST : n;
    FW_TRY(fw_alloc(&out->at, out->n_winters * out->n_scores, sizeof *out->at, "windows of simulated winters", m));
    double step = pow(phi, (double)out->block), fresh = sqrt(1 - step * step);
    for (size_t i = 0; i < out->n_winters; i++) {
        fw_uniforms u;
        fw_uniforms_stream(&u, seed, FW_STREAM_SERVICE, i, PART);
        double z = gsl_cdf_ugaussian_Pinv(((double)i + fw_uniforms_next(&u)) / (double)out->n_winters);
        for (size_t k = 0; k < out->n_scores; k++) {
            out->at[i * out->n_scores + k] = node_of(z);
            z = step * z + fresh * gsl_cdf_ugaussian_Pinv(fw_uniforms_next(&u));
        }
    }
    return FW_OK;
}

void fw_winters_free(fw_winters *w)
{
    if (!w) return;
    free(w->at);
    memset(w, 0, sizeof *w);
}

static inline double depth_at(const fw_scores *s, float at)
{
    size_t        node = (size_t)at;
    const double *d = s->depth + node;
    return d[0] + ((double)at - (double)node) * (d[1] - d[0]);
}

/* Keep the shape, take mean and variance; a winter that would fall below 0 stays at 0. */
static void match_moments(size_t n, double *x, double mean, double variance)
{
    double sum = 0, square = 0;
    for (size_t i = 0; i < n; i++) sum += x[i];
    double own = sum / (double)n;
    for (size_t i = 0; i < n; i++) square += (x[i] - own) * (x[i] - own);
    double stretch = square > 0 ? sqrt(variance * (double)n / square) : 0;
    for (size_t i = 0; i < n; i++) x[i] = fmax(0, mean + stretch * (x[i] - own));
}

void fw_winters_sum(const fw_winters *w, const fw_scores *s, size_t n_lengths, const size_t *lengths, double *sums)
{
    for (size_t i = 0; i < w->n_winters; i++) {
        const float *at = w->at + i * w->n_scores;
        double       sum = 0;
        size_t       k = 0;
        for (size_t l = 0; l < n_lengths; l++) {
            for (; (k + 1) * w->block <= lengths[l]; k++) sum += depth_at(s, at[k]);
            double part = (double)(lengths[l] - k * w->block) / (double)w->block; /* of a block that this length cuts */
            sums[l * w->n_winters + i] = sum + (part > 0 ? part * depth_at(s, at[k]) : 0);
        }
    }
    for (size_t l = 0; l < n_lengths; l++) {
        double n = (double)lengths[l];
        match_moments(w->n_winters, sums + l * w->n_winters, n * s->mean, lengths[l] ? s->variance * fw_scores_sum(s, w->phi, n) : 0);
    }
}
