#include "statistics/calibrate.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* What is left of a function after the earlier ones, relative to itself: below this it is rounding. */
static const double DEPENDENT = 1e-9;
/* A realisation that a function follows alone leaves no residual: it counts at most twenty-fold. */
static const double LEAST_FREE = 0.05;

static double weighted_product(const fw_calibration *c, size_t stride, const double *a, size_t column, const double *v)
{
    double sum = 0;
    for (size_t i = 0; i < c->n; i++) sum += c->plain[i] * a[i * stride + column] * v[i];
    return sum;
}

static double squares(const fw_calibration *c, const double *v)
{
    double sum = 0;
    for (size_t i = 0; i < c->n; i++) sum += c->plain[i] * v[i] * v[i];
    return sum;
}

/* Take the functions so far out of v, twice, as one pass leaves rounding behind; its total follows. */
static void orthogonalise(const fw_calibration *c, size_t stride, const double *known, double *v, double *total)
{
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < c->n_functions; k++) {
            double part = weighted_product(c, stride, c->function, k, v);
            for (size_t i = 0; i < c->n; i++) v[i] -= part * c->function[i * stride + k];
            *total -= part * known[k];
        }
}

/* The functions get rows of p + 1 at first; afterwards as long as there are functions. */
static void make_functions(fw_calibration *c, size_t p, const double *basis, const double *totals, double *v, double *known)
{
    size_t stride = p + 1;
    for (size_t i = 0; i < c->n; i++) c->function[i * stride] = 1;
    known[0] = 1;
    c->n_functions = 1;
    for (size_t j = 0; j < p && c->n_functions < c->n; j++) {
        double total = totals[j];
        for (size_t i = 0; i < c->n; i++) v[i] = basis[i * p + j];
        double before = squares(c, v);
        orthogonalise(c, stride, known, v, &total);
        double left = squares(c, v);
        if (!(left > DEPENDENT * before)) continue;
        double unit = 1 / sqrt(left);
        for (size_t i = 0; i < c->n; i++) c->function[i * stride + c->n_functions] = v[i] * unit;
        known[c->n_functions++] = total * unit;
    }
    for (size_t i = 0; i < c->n; i++) {
        double sum = 0;
        for (size_t k = 0; k < c->n_functions; k++) sum += known[k] * c->function[i * stride + k];
        double own = 0;
        for (size_t k = 0; k < c->n_functions; k++) own += c->function[i * stride + k] * c->function[i * stride + k];
        c->weight[i] = c->plain[i] * sum;
        c->alone[i] = 1 / fmax(1 - c->plain[i] * own, LEAST_FREE);
        memmove(c->function + i * c->n_functions, c->function + i * stride, c->n_functions * sizeof *c->function);
    }
}

fw_status fw_calibration_make(fw_calibration *out, size_t n, const double *plain, size_t p, const double *basis, const double *totals, fw_msg *m)
{
    double *v = NULL;
    *out = (fw_calibration){.n = n, .plain = plain};
    FW_CHECK(n > 0, m, FW_E_ARG, "no realisation to calibrate");
    fw_status s = fw_alloc(&out->function, n * (p + 1), sizeof *out->function, "functions of scenarios", m);
    if (s == FW_OK) s = fw_alloc(&out->weight, n, sizeof *out->weight, "calibrated weights", m);
    if (s == FW_OK) s = fw_alloc(&out->alone, n, sizeof *out->alone, "scales of residuals", m);
    if (s == FW_OK) s = fw_alloc(&v, n, sizeof *v, "a function of scenarios", m);
    if (s == FW_OK) s = fw_alloc(&out->known, p + 1, sizeof *out->known, "means of functions", m);
    if (s == FW_OK) make_functions(out, p, basis, totals, v, out->known);
    free(v);
    if (s != FW_OK) fw_calibration_free(out);
    return s;
}

/* ---- raking ------------------------------------------------------------------------------------------------------ */

/* On the Hessian, the unit matrix at the start: where weights pile up on a few realisations it would not be definite any more. */
static const double RIDGE = 1e-9;

/* The convex function whose gradient is what is left to the means: log sum a exp(lambda'q) - lambda'known, with gradient and Hessian. lambda[0] is
 * taken by the logarithm. weight (n): softmax. */
static double potential(const fw_calibration *c, const double *lambda, double *weight, gsl_vector *gradient, gsl_matrix *hessian)
{
    size_t p = c->n_functions;
    double most = -INFINITY, sum = 0, value = 0;
    for (size_t i = 0; i < c->n; i++) {
        double at = 0;
        for (size_t k = 1; k < p; k++) at += lambda[k] * c->function[i * p + k];
        weight[i] = at;
        most = fmax(most, at);
    }
    for (size_t i = 0; i < c->n; i++) weight[i] = c->plain[i] * exp(weight[i] - most), sum += weight[i];
    for (size_t i = 0; i < c->n; i++) weight[i] /= sum;
    gsl_vector_set_zero(gradient);
    gsl_matrix_set_zero(hessian);
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 1; k < p; k++) {
            double q = weight[i] * c->function[i * p + k];
            *gsl_vector_ptr(gradient, k - 1) += q;
            for (size_t l = 1; l <= k; l++) *gsl_matrix_ptr(hessian, k - 1, l - 1) += q * c->function[i * p + l];
        }
    value = log(sum) + most;
    for (size_t k = 1; k < p; k++) value -= lambda[k] * c->known[k];
    for (size_t k = 1; k < p; k++)
        for (size_t l = 1; l <= k; l++) *gsl_matrix_ptr(hessian, k - 1, l - 1) -= gsl_vector_get(gradient, k - 1) * gsl_vector_get(gradient, l - 1);
    for (size_t k = 1; k < p; k++) {
        *gsl_vector_ptr(gradient, k - 1) -= c->known[k];
        *gsl_matrix_ptr(hessian, k - 1, k - 1) += RIDGE;
    }
    return value;
}

/* Newton's method with halved steps. */
static bool minimise(const fw_calibration *c, double *lambda, double *next, double *weight, gsl_vector *g, gsl_vector *step, gsl_matrix *H)
{
    enum { ROUNDS = 60, HALVINGS = 12 };
    size_t p = c->n_functions;
    double value = potential(c, lambda, weight, g, H);
    for (int round = 0; round < ROUNDS; round++) {
        double left = 0;
        for (size_t k = 0; k + 1 < p; k++) left = fmax(left, fabs(gsl_vector_get(g, k)));
        if (left < 1e-11) return true;
        if (gsl_linalg_cholesky_decomp1(H) != GSL_SUCCESS || gsl_linalg_cholesky_solve(H, g, step) != GSL_SUCCESS) return false;
        double factor = 1, was = value;
        for (int halving = 0; halving < HALVINGS; halving++, factor *= 0.5) {
            for (size_t k = 1; k < p; k++) next[k] = lambda[k] - factor * gsl_vector_get(step, k - 1);
            value = potential(c, next, weight, g, H);
            if (value <= was + 1e-14 * fabs(was)) break;
        }
        if (!(value <= was + 1e-14 * fabs(was))) return false;
        memcpy(lambda, next, p * sizeof *lambda);
    }
    return false;
}

fw_status fw_calibration_rake(fw_calibration *c, bool *is_done, fw_msg *m)
{
    size_t  p = c->n_functions;
    double *work = NULL, *weight = NULL;
    *is_done = p == 1;
    if (p == 1) return FW_OK;
    FW_TRY(fw_alloc(&work, 2 * p, sizeof *work, "multipliers", m));
    fw_status   s = fw_alloc(&weight, c->n, sizeof *weight, "raked weights", m);
    gsl_vector *g = gsl_vector_alloc(p - 1), *step = gsl_vector_alloc(p - 1);
    gsl_matrix *H = gsl_matrix_alloc(p - 1, p - 1);
    if (s == FW_OK && !(g && step && H)) s = fw_fail(m, FW_E_NOMEM, "out of memory: raking");
    if (s == FW_OK) *is_done = minimise(c, work, work + p, weight, g, step, H);
    if (*is_done) memcpy(c->weight, weight, c->n * sizeof *weight);
    if (g) gsl_vector_free(g);
    if (step) gsl_vector_free(step);
    if (H) gsl_matrix_free(H);
    free(work);
    free(weight);
    return s;
}

void fw_calibration_free(fw_calibration *c)
{
    if (!c) return;
    free(c->function);
    free(c->weight);
    free(c->alone);
    free(c->known);
    memset(c, 0, sizeof *c);
}

void fw_calibration_residuals(const fw_calibration *c, double *values)
{
    enum { MOST = 64 };
    for (size_t first = 0; first < c->n_functions; first += MOST) { /* orthonormal: block by block is as good as all at once */
        double part[MOST] = {0};
        size_t k = c->n_functions - first < MOST ? c->n_functions - first : MOST;
        for (size_t i = 0; i < c->n; i++) {
            const double *q = c->function + i * c->n_functions + first;
            double        f = c->plain[i] * values[i];
            for (size_t j = 0; j < k; j++) part[j] += f * q[j];
        }
        for (size_t i = 0; i < c->n; i++) {
            const double *q = c->function + i * c->n_functions + first;
            double        fit = 0;
            for (size_t j = 0; j < k; j++) fit += part[j] * q[j];
            values[i] -= fit;
        }
    }
    for (size_t i = 0; i < c->n; i++) values[i] *= c->alone[i];
}
