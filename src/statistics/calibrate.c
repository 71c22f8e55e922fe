#include "statistics/calibrate.h"

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
    double *v = NULL, *known = NULL;
    *out = (fw_calibration){.n = n, .plain = plain};
    FW_CHECK(n > 0, m, FW_E_ARG, "no realisation to calibrate");
    fw_status s = fw_alloc(&out->function, n * (p + 1), sizeof *out->function, "functions of scenarios", m);
    if (s == FW_OK) s = fw_alloc(&out->weight, n, sizeof *out->weight, "calibrated weights", m);
    if (s == FW_OK) s = fw_alloc(&out->alone, n, sizeof *out->alone, "scales of residuals", m);
    if (s == FW_OK) s = fw_alloc(&v, n, sizeof *v, "a function of scenarios", m);
    if (s == FW_OK) s = fw_alloc(&known, p + 1, sizeof *known, "means of functions", m);
    if (s == FW_OK) make_functions(out, p, basis, totals, v, known);
    free(v);
    free(known);
    if (s != FW_OK) fw_calibration_free(out);
    return s;
}

void fw_calibration_free(fw_calibration *c)
{
    if (!c) return;
    free(c->function);
    free(c->weight);
    free(c->alone);
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
