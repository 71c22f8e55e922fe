#include "study/swept.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "realisation/floes.h"
#include "study/swept_inside.h"

/* Between two nodes of speed, at most. A hit's load without its power of speed changes by 1 % over this on the spring. Ice that crushes has a flat that
 * stops a floe from rolling at some speeds and not at others: 34 % too much at 1 m/s, between nodes at 0.43 and 2 m/s. */
static const double SPEED_STEP = 6, SPEED_STEP_CRUSH = 2;

/* Thicknesses of all mixes, each once: mixes share classes, and a class has the same floes in all of them. */
typedef struct classes {
    size_t  n;
    double  thickness[FW_MAX_MIXES * FW_MAX_CLASSES];
    double  diameter[FW_MAX_MIXES * FW_MAX_CLASSES][FW_SWEPT_DIAMETERS];
    double  share[FW_MAX_MIXES * FW_MAX_CLASSES][FW_MAX_MIXES]; /* of each mix's floes */
} classes;

static fw_status collect(fw_swept *s, const fw_model *model, classes *c, fw_msg *m)
{
    c->n = 0;
    for (size_t mix = 0; mix < s->n_mixes; mix++) {
        fw_floe_mix f;
        double      diameter[FW_MAX_CLASSES][FW_SWEPT_DIAMETERS];
        FW_TRY(fw_floes_of_mix(model, mix, FW_SWEPT_DIAMETERS, fw_swept_diameter_at, &f, diameter[0], m));
        s->diameter[mix] = f.mean_diameter, s->area[mix] = f.mean_area;
        for (size_t k = 0; k < f.n; k++) {
            size_t at = 0;
            if (!(f.share[k] > 0)) continue;
            while (at < c->n && c->thickness[at] != f.thickness[k]) at++;
            c->n += at == c->n;
            c->thickness[at] = f.thickness[k];
            memcpy(c->diameter[at], diameter[k], sizeof diameter[k]);
            c->share[at][mix] += f.share[k];
        }
    }
    return FW_OK;
}

static void add_row(fw_swept *s, size_t to, double share, const fw_swept_row *row)
{
    double *load = s->load + to * s->n_arcs, *square = s->square + to * s->n_arcs;
    for (size_t k = 0; k < s->n_arcs; k++) load[k] += share * row->load[k], square[k] += share * row->square[k];
}

static double row_sum(const fw_swept *s, size_t row)
{
    double sum = 0;
    for (size_t k = 0; k < s->n_arcs; k++) sum += s->load[row * s->n_arcs + k];
    return sum;
}

static void find_power(fw_swept *s)
{
    double first = 0, last = 0;
    for (size_t mix = 0; mix < s->n_mixes; mix++) first += row_sum(s, mix * s->n_speeds), last += row_sum(s, (mix + 1) * s->n_speeds - 1);
    if (first > 0 && last > 0) s->power = log(last / first) / (s->ln_speed[s->n_speeds - 1] - s->ln_speed[0]);
}

/* own: one class's row, 2 n_arcs doubles to work with. */
static fw_status solve(fw_swept *s, const fw_model *model, size_t law, const classes *c, double *own, fw_msg *m)
{
    fw_model hit_model = fw_swept_hit_model(model, law);
    for (size_t k = 0; k < c->n; k++)
        for (size_t v = 0; v < s->n_speeds; v++) {
            fw_swept_row row = {.load = own, .square = own + s->n_arcs};
            memset(own, 0, 2 * s->n_arcs * sizeof *own);
            FW_TRY(fw_swept_solve(&hit_model, c->thickness[k], c->diameter[k], exp(s->ln_speed[v]), &row, &s->force_evaluations, m));
            for (size_t mix = 0; mix < s->n_mixes; mix++) add_row(s, mix * s->n_speeds + v, c->share[k][mix], &row);
        }
    find_power(s);
    return FW_OK;
}

static fw_status make(fw_swept *s, const fw_model *model, double slowest, double fastest, size_t law, fw_msg *m)
{
    double span = log(fastest / slowest);
    s->n_speeds = 2 + (size_t)(span / log(model->effects & FW_EFFECT_CRUSH_CONTACT ? SPEED_STEP_CRUSH : SPEED_STEP));
    size_t rows = s->n_mixes * s->n_speeds;
    FW_TRY(fw_alloc(&s->ln_speed, s->n_speeds, sizeof *s->ln_speed, "speeds of hits", m));
    FW_TRY(fw_alloc(&s->diameter, s->n_mixes, sizeof *s->diameter, "diameters of mixes", m));
    FW_TRY(fw_alloc(&s->area, s->n_mixes, sizeof *s->area, "areas of mixes", m));
    FW_TRY(fw_alloc(&s->load, rows * s->n_arcs, sizeof *s->load, "rings of hits", m));
    FW_TRY(fw_alloc(&s->square, rows * s->n_arcs, sizeof *s->square, "rings of hits", m));
    for (size_t v = 0; v < s->n_speeds; v++) s->ln_speed[v] = log(slowest) + span * (double)v / (double)(s->n_speeds - 1);

    classes  *c = NULL;
    double   *own = NULL;
    fw_status status = fw_alloc(&c, 1, sizeof *c, "thickness classes", m);
    if (status == FW_OK) status = fw_alloc(&own, 2 * s->n_arcs, sizeof *own, "rings of hits", m);
    if (status == FW_OK) status = collect(s, model, c, m);
    if (status == FW_OK) status = solve(s, model, law, c, own, m);
    free(c);
    free(own);
    return status;
}

fw_status fw_swept_make(fw_swept *out, const fw_model *model, double slowest, double fastest, size_t law, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_TRY(fw_model_check(model, m));
    FW_CHECK(law < model->n_laws, m, FW_E_ARG, "abrasion law %zu does not exist; the model has %zu", law + 1, model->n_laws);
    FW_CHECK(fastest >= slowest && slowest > 0 && isfinite(fastest), m, FW_E_ARG, "hits at %g to %g m/s: wanted more than 0, ascending", slowest,
             fastest);
    out->n_arcs = model->n_arcs, out->n_mixes = model->n_mixes;
    out->structure_diameter = 2 * model->structure_radius, out->window = model->window;
    fastest = fmax(fastest, FW_SLOWEST);
    slowest = fmin(fmax(slowest, FW_SLOWEST), 0.5 * fastest); /* a power of speed takes two speeds */
    fw_status s = make(out, model, slowest, fastest, law, m);
    if (s != FW_OK) fw_swept_free(out);
    return s;
}

void fw_swept_free(fw_swept *s)
{
    if (!s) return;
    free(s->ln_speed);
    free(s->diameter);
    free(s->area);
    free(s->load);
    free(s->square);
    memset(s, 0, sizeof *s);
}

static double speed_of(const fw_scenario *sc) { return fmax(sc->speed, FW_SLOWEST); }

/* Floes that come by in a window on a metre of width. */
static double floes_per_width(const fw_swept *s, const fw_scenario *sc)
{
    return sc->concentration * speed_of(sc) * s->window / s->area[sc->mix];
}

/* Straight between two nodes of what is left after u^power; beyond the ends the nearest node's. */
static fw_swept_share blend(const fw_swept *s, const fw_scenario *sc, double power)
{
    double at = log(speed_of(sc)), step = s->ln_speed[1] - s->ln_speed[0], u = (at - s->ln_speed[0]) / step, floes = floes_per_width(s, sc);
    u = fmin(fmax(u, 0), (double)(s->n_speeds - 1));
    size_t v = (size_t)fmin(floor(u), (double)(s->n_speeds - 2));
    double f = u - (double)v;
    return (fw_swept_share){.row = sc->mix * s->n_speeds + v,
                            .share = {(1 - f) * floes * exp(power * (at - s->ln_speed[v])), f * floes * exp(power * (at - s->ln_speed[v + 1]))}};
}

fw_swept_share fw_swept_share_of(const fw_swept *s, const fw_scenario *sc) { return blend(s, sc, s->power); }

double fw_swept_hits(const fw_swept *s, const fw_scenario *sc)
{
    return floes_per_width(s, sc) * (s->structure_diameter + s->diameter[sc->mix]);
}

static void sum_rows(const fw_swept *s, const double *rows, const fw_swept_share *a, double *out)
{
    const double *low = rows + a->row * s->n_arcs, *high = low + s->n_arcs;
    for (size_t k = 0; k < s->n_arcs; k++) out[k] = a->share[0] * low[k] + a->share[1] * high[k];
}

void fw_swept_ring(const fw_swept *s, const fw_scenario *sc, double *load, double *variance)
{
    fw_swept_share a = fw_swept_share_of(s, sc), b = blend(s, sc, 2 * s->power);
    sum_rows(s, s->load, &a, load);
    if (variance) sum_rows(s, s->square, &b, variance);
}
