#include "study/emulator.h"

#include <gsl/gsl_multifit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { FEWEST_WINDOWS = 12, WINDOWS_PER_FUNCTION = 4, FOLDS = 10 };

/* Functions of a scenario in the order in which they are taken: few windows have room for the first ones alone. Returns their number. */
static size_t functions_of(const fw_campaign *c, const fw_sanity *strip, const fw_scenario *s, double *values)
{
    double u = log(fmax(s->speed, FW_SLOWEST)), i = log(fmax(s->concentration, 1e-6));
    size_t n = 0;
    values[n++] = 1;
    if (strip) values[n++] = fmax(fw_sanity_ln_strip(strip, s), -700);
    if (strip) values[n++] = i, values[n++] = i * i;
    values[n++] = u;
    if (!strip) values[n++] = i;
    values[n++] = u * u, values[n++] = u * i;
    if (!strip) values[n++] = i * i;
    for (uint32_t k = 1; k < c->model.n_mixes; k++) values[n++] = s->mix == k;
    for (uint32_t k = 1; k < c->model.n_mixes; k++) values[n++] = s->mix == k ? i : 0;
    if (c->model.effects & FW_EFFECT_WIND) {
        double w = s->wind_speed, a = cos(s->wind_angle);
        values[n++] = w, values[n++] = w * a, values[n++] = w * w, values[n++] = w * a * a;
    }
    if (c->model.effects & FW_EFFECT_TIDE) values[n++] = cos(2 * s->tide_phase), values[n++] = sin(2 * s->tide_phase);
    return n;
}

/* ln load over functions, row by row. */
typedef struct table {
    size_t  n, n_functions;
    double *functions; /* (n x FW_EMULATOR_FUNCTIONS); owned */
    double *ln_load;   /* (n); owned */
} table;

static fw_status make_table(table *t, const fw_emulator *e, size_t n, const fw_scenario *scenarios, const double *load, fw_msg *m)
{
    FW_TRY(fw_alloc(&t->functions, n * FW_EMULATOR_FUNCTIONS, sizeof *t->functions, "functions of scenarios", m));
    FW_TRY(fw_alloc(&t->ln_load, n, sizeof *t->ln_load, "logarithms of loads", m));
    for (size_t i = 0; i < n; i++) {
        if (!(load[i] > 0)) continue;
        t->n_functions = functions_of(e->campaign, e->strip, &scenarios[i], t->functions + t->n * FW_EMULATOR_FUNCTIONS);
        t->ln_load[t->n++] = log(load[i]);
    }
    return FW_OK;
}

/* Least squares over the rows outside of `fold` (of FOLDS; FOLDS: all rows). By singular values: what the campaign does not vary gets no coefficient. */
static fw_status fit(const table *t, size_t n_functions, size_t fold, double *coefficient, fw_msg *m)
{
    size_t n = 0, at = 0;
    for (size_t i = 0; i < t->n; i++) n += i % FOLDS != fold;
    gsl_matrix                    *X = gsl_matrix_alloc(n, n_functions), *cov = gsl_matrix_alloc(n_functions, n_functions);
    gsl_vector                    *y = gsl_vector_alloc(n), *c = gsl_vector_alloc(n_functions);
    gsl_multifit_linear_workspace *w = gsl_multifit_linear_alloc(n, n_functions);
    fw_status                      s = FW_OK;
    double                         chi2;
    if (X && cov && y && c && w) {
        for (size_t i = 0; i < t->n; i++) {
            if (i % FOLDS == fold) continue;
            for (size_t k = 0; k < n_functions; k++) gsl_matrix_set(X, at, k, t->functions[i * FW_EMULATOR_FUNCTIONS + k]);
            gsl_vector_set(y, at++, t->ln_load[i]);
        }
        size_t rank;
        if (gsl_multifit_linear_tsvd(X, y, 1e-10, c, cov, &chi2, &rank, w) != GSL_SUCCESS)
            s = fw_fail(m, FW_E_INTERNAL, "the least squares of ln load did not come to an end");
        for (size_t k = 0; k < n_functions && s == FW_OK; k++) coefficient[k] = gsl_vector_get(c, k);
    } else {
        s = fw_fail(m, FW_E_NOMEM, "out of memory: least squares of ln load");
    }
    if (w) gsl_multifit_linear_free(w);
    if (c) gsl_vector_free(c);
    if (y) gsl_vector_free(y);
    if (cov) gsl_matrix_free(cov);
    if (X) gsl_matrix_free(X);
    return s;
}

static double predict(size_t n_functions, const double *coefficient, const double *functions)
{
    double sum = 0;
    for (size_t k = 0; k < n_functions; k++) sum += coefficient[k] * functions[k];
    return sum;
}

static fw_status hold_out(fw_emulator *e, const table *t, fw_msg *m)
{
    double squares = 0, coefficient[FW_EMULATOR_FUNCTIONS];
    for (size_t fold = 0; fold < FOLDS; fold++) {
        FW_TRY(fit(t, e->n_functions, fold, coefficient, m));
        for (size_t i = fold; i < t->n; i += FOLDS) {
            double miss = t->ln_load[i] - predict(e->n_functions, coefficient, t->functions + i * FW_EMULATOR_FUNCTIONS);
            squares += miss * miss;
        }
    }
    e->held_out = sqrt(squares / (double)t->n);
    return FW_OK;
}

static double scatter_of(const table *t)
{
    double mean = 0, squares = 0;
    for (size_t i = 0; i < t->n; i++) mean += t->ln_load[i] / (double)t->n;
    for (size_t i = 0; i < t->n; i++) squares += (t->ln_load[i] - mean) * (t->ln_load[i] - mean);
    return sqrt(squares / ((double)t->n - 1));
}

fw_status fw_emulator_fit(fw_emulator *out, const fw_campaign *c, const fw_sanity *strip, size_t n, const fw_scenario *scenarios,
                          const double *load, fw_msg *m)
{
    table t = {0};
    *out = (fw_emulator){.campaign = c, .strip = strip && !strip->why[0] ? strip : NULL, .scatter = NAN, .held_out = NAN, .dry_share = 1};
    if (n == 0) return FW_OK;
    fw_status s = make_table(&t, out, n, scenarios, load, m);
    out->dry_share = 1 - (double)t.n / (double)n;
    if (s == FW_OK && t.n >= FEWEST_WINDOWS) {
        size_t most = t.n / WINDOWS_PER_FUNCTION;
        out->n = t.n;
        out->n_functions = t.n_functions < most ? t.n_functions : most;
        out->scatter = scatter_of(&t);
        s = fit(&t, out->n_functions, FOLDS, out->coefficient, m);
        if (s == FW_OK) s = hold_out(out, &t, m);
    }
    free(t.functions);
    free(t.ln_load);
    return s;
}

double fw_emulator_ln_load(const fw_emulator *e, const fw_scenario *s)
{
    double functions[FW_EMULATOR_FUNCTIONS];
    functions_of(e->campaign, e->strip, s, functions);
    return predict(e->n_functions, e->coefficient, functions);
}
