#include "statistics/bands.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"

/* 8192 draws leave the band's coverage open by 0.24 % (95 %), its width by 0.5 %. Of a point's variance a ten-thousandth may stay unexplained by
 * the other points: it moves nothing, and makes neighbours in a dense ring one. */
enum { DRAWS = 8192, PART = 1 /* of the stream; part 0 is that of paired.h */ };
static const double UNEXPLAINED = 1e-4;

typedef struct factors {
    size_t  n, rank;
    double *of_shares; /* (n x n_groups) centred, of length 1 */
    double *column;    /* (n x n), the first `rank` rows used: correlation of p and q = sum over k of column[k][p] column[k][q] */
    double *left;      /* (n) of each point's variance 1, not yet explained */
    double *errors;    /* (n) */
    double *largest;   /* (DRAWS) */
} factors;

size_t fw_bands_group(size_t n, double *shares)
{
    size_t n_groups = n < FW_BANDS_MOST_GROUPS ? n : FW_BANDS_MOST_GROUPS, at = 0;
    for (size_t g = 0; g < n_groups && n_groups < n; g++) {
        size_t end = (g + 1) * n / n_groups;
        double sum = 0;
        while (at < end) sum += shares[at++];
        shares[g] = sum;
    }
    return n_groups;
}

double fw_bands_independent(double confidence, size_t n) { return pow(confidence, 1 / (double)n); }

/* Centred and brought to length 1; false: there is nothing left. */
static bool standardise(size_t n, const double *shares, double *out)
{
    double mean = 0, squares = 0, all = 0;
    for (size_t i = 0; i < n; i++) mean += shares[i] / (double)n, all += shares[i] * shares[i];
    for (size_t i = 0; i < n; i++) {
        out[i] = shares[i] - mean;
        squares += out[i] * out[i];
    }
    if (!(squares > 1e-20 * all)) return false; /* rounding of equal numbers */
    for (size_t i = 0; i < n; i++) out[i] /= sqrt(squares);
    return true;
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Column k of the Cholesky factor of the points' correlation, from the point `next`. */
static void explain(factors *f, size_t n_groups, size_t next)
{
    size_t  n = f->n, k = f->rank;
    double *column = f->column + k * n, root = sqrt(f->left[next]);
    for (size_t p = 0; p < n; p++) column[p] = dot(n_groups, f->of_shares + p * n_groups, f->of_shares + next * n_groups);
    for (size_t j = 0; j < k; j++) {
        const double *before = f->column + j * n, of_next = before[next];
        for (size_t p = 0; p < n; p++) column[p] -= of_next * before[p];
    }
    for (size_t p = 0; p < n; p++) {
        column[p] /= root;
        f->left[p] -= column[p] * column[p];
    }
    f->left[next] = 0;
}

/* The point with most unexplained variance next, until little is left in any; that little is given to the rest. */
static void factorise(factors *f, size_t n_groups)
{
    for (size_t p = 0; p < f->n; p++) f->left[p] = 1;
    for (f->rank = 0; f->rank < f->n; f->rank++) {
        size_t next = 0;
        for (size_t p = 1; p < f->n; p++)
            if (f->left[p] > f->left[next]) next = p;
        if (!(f->left[next] > UNEXPLAINED)) break;
        explain(f, n_groups, next);
    }
    for (size_t p = 0; p < f->n; p++) {
        double squares = 0;
        for (size_t k = 0; k < f->rank; k++) squares += f->column[k * f->n + p] * f->column[k * f->n + p];
        for (size_t k = 0; k < f->rank; k++) f->column[k * f->n + p] /= sqrt(squares);
    }
}

static void draw(factors *f, uint64_t seed)
{
    size_t      n = f->n;
    fw_uniforms u;
    fw_uniforms_stream(&u, seed, FW_STREAM_SECTIONING, 0, PART);
    for (size_t i = 0; i < DRAWS; i++) {
        double most = 0;
        memset(f->errors, 0, n * sizeof *f->errors);
        for (size_t k = 0; k < f->rank; k++) {
            const double *column = f->column + k * n, g = gsl_cdf_ugaussian_Pinv(fw_uniforms_next(&u));
            for (size_t p = 0; p < n; p++) f->errors[p] += column[p] * g;
        }
        for (size_t p = 0; p < n; p++) most = fabs(f->errors[p]) > most ? fabs(f->errors[p]) : most;
        f->largest[i] = most;
    }
}

static fw_status find(factors *f, size_t n_points, size_t n_groups, const double *shares, double confidence, uint64_t seed, double *pointwise, fw_msg *m)
{
    FW_TRY(fw_alloc(&f->of_shares, n_points * n_groups, sizeof *f->of_shares, "shares of points in a band", m));
    for (size_t p = 0; p < n_points; p++) f->n += standardise(n_groups, shares + p * n_groups, f->of_shares + f->n * n_groups);
    FW_TRY(fw_alloc(&f->column, f->n * f->n, sizeof *f->column, "correlations of points", m));
    FW_TRY(fw_alloc(&f->left, f->n, sizeof *f->left, "variances of points", m));
    FW_TRY(fw_alloc(&f->errors, f->n, sizeof *f->errors, "errors of points", m));
    factorise(f, n_groups);
    *pointwise = confidence;
    if (f->rank < 2) return FW_OK; /* all points are one */
    FW_TRY(fw_alloc(&f->largest, DRAWS, sizeof *f->largest, "largest errors of a band", m));
    draw(f, seed);
    double c = gsl_stats_select(f->largest, 1, DRAWS, (size_t)ceil(confidence * DRAWS) - 1);
    *pointwise = fmin(fmax(1 - 2 * gsl_cdf_ugaussian_Q(c), confidence), fw_bands_independent(confidence, f->n));
    return FW_OK;
}

fw_status fw_bands_confidence(size_t n_points, size_t n_groups, const double *shares, double confidence, uint64_t seed, double *pointwise, fw_msg *m)
{
    factors f;
    memset(&f, 0, sizeof f);
    FW_CHECK(confidence > 0 && confidence < 1, m, FW_E_ARG, "a band of confidence %g, wanted within (0, 1)", confidence);
    fw_status s = find(&f, n_points, n_groups, shares, confidence, seed, pointwise, m);
    free(f.column);
    free(f.of_shares);
    free(f.left);
    free(f.errors);
    free(f.largest);
    return s;
}
