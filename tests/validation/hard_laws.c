#include "validation/hard_laws.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define X(name, key, text) key,
const char *const hard_law_keys[HARD_N_LAWS] = {HARD_LAW_LIST(X)};
#undef X
#define X(name, key, text) text,
const char *const hard_law_texts[HARD_N_LAWS] = {HARD_LAW_LIST(X)};
#undef X

static const double PI = 3.14159265358979323846;

/* The larger; NaN wins. */
static double worse(double a, double b) { return a >= b || isnan(a) ? a : b; }

/* ---- ledgers ------------------------------------------------------------------------------------------------------- */

static hard_verdict ends(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    if (r->status != FW_OK) fprintf(stderr, "%s: %s\n", c->scene->name, r->cause);
    return (hard_verdict){r->status != FW_OK, 0};
}

static hard_verdict finite(hard_case *c)
{
    const hard_run  *r = hard_case_run(c, HARD_BASE);
    const fw_record *q = &r->record;
    double           n_bad = 0;
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        double value;
        memcpy(&value, (const char *)q + fw_record_columns[i].offset, sizeof value);
        n_bad += !isfinite(value);
    }
    for (size_t i = 0; i < fw_record_n_rings(q->n_arcs, q->n_laws); i++) n_bad += !(q->rings[i] >= 0 && isfinite(q->rings[i]));
    for (size_t i = 0; r->end && i < r->n; i++) {
        const fw_floe *f = &r->end[i];
        n_bad += !isfinite(f->x + f->y + f->vx + f->vy + f->spin);
    }
    n_bad += !(q->normal_impulse >= 0) + !(q->peak_force >= 0) + !(q->contact_time >= 0) + !(r->depth >= 0) + !(r->path >= 0);
    return (hard_verdict){n_bad, 0};
}

static hard_verdict energy_books(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.energy_relative, 1e-10}; }
static hard_verdict momentum_books(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.momentum_relative, 1e-10}; }
static hard_verdict wear_books(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.wear_conservation, 1e-10}; }
static hard_verdict balance(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.energy_truncation, c->accuracy}; }
static hard_verdict overlap(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.max_overlap_share, 1 - 1e-12}; }

static hard_verdict refuses(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    bool            is_refused = r->status == FW_E_NUMERIC && strstr(r->cause, "floe ");
    return (hard_verdict){!is_refused, 0};
}

/* ---- two runs ------------------------------------------------------------------------------------------------------ */

static hard_verdict depth(hard_case *c)
{
    double base = hard_case_run(c, HARD_BASE)->depth, fine = hard_case_run(c, HARD_FINE)->depth;
    return (hard_verdict){base == fine ? 0 : fabs(base / fine - 1), c->accuracy};
}

/* Arc k of the base run lies on this one of the other. */
static size_t arc_of(hard_which which, size_t k, size_t n)
{
    return which == HARD_MIRROR ? n - 1 - k : (k + n - (size_t)hard_degrees(which) * n / 360) % n;
}

/* Largest difference of place over a metre, of velocity over the fastest, and of an arc's load over the largest arc's. */
static double difference(hard_case *c, hard_which which)
{
    const hard_run *a = hard_case_run(c, HARD_BASE), *b = hard_case_run(c, which);
    double          angle = hard_degrees(which) * PI / 180, co = cos(angle), si = sin(angle), flip = which == HARD_MIRROR ? -1 : 1, d = 0, load = 0;
    if (a->status != FW_OK || b->status != FW_OK) return NAN;
    for (size_t i = 0; i < a->n; i++) {
        const fw_floe *p = &a->end[i], *q = &b->end[i];
        double         y = flip * p->y, vy = flip * p->vy;
        d = worse(d, hypot(q->x - (co * p->x - si * y), q->y - (si * p->x + co * y)));
        d = worse(d, hypot(q->vx - (co * p->vx - si * vy), q->vy - (si * p->vx + co * vy)) / c->fastest);
        d = worse(d, 0.5 * p->diameter * fabs(q->spin - flip * p->spin) / c->fastest);
    }
    const double *la = fw_record_load(&a->record, 0, FW_RING_LOAD), *lb = fw_record_load(&b->record, 0, FW_RING_LOAD);
    size_t        n = a->record.n_arcs;
    for (size_t k = 0; k < n; k++) load = fmax(load, la[k]);
    for (size_t k = 0; load > 0 && k < n; k++) d = worse(d, fabs(lb[arc_of(which, k, n)] - la[k]) / load);
    return d;
}

static hard_verdict mirror(hard_case *c) { return (hard_verdict){difference(c, HARD_MIRROR), 1e-9}; }
static hard_verdict turned(hard_case *c)
{
    return (hard_verdict){worse(difference(c, HARD_QUARTER), difference(c, HARD_TURNED)), c->accuracy};
}

/* ---- energy and momentum --------------------------------------------------------------------------------------------- */

/* Where nothing is dissipated, energy stays to the accuracy; elsewhere it only falls. */
static hard_verdict no_gain(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_WATCHED);
    bool            is_elastic = c->model.damping_ratio == 0;
    return (hard_verdict){r->status == FW_OK ? fmax(0, r->highest / r->energy[0] - 1) : NAN, is_elastic ? c->accuracy : 1e-9};
}

static hard_verdict kept(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          p[2] = {0, 0}, size = 0;
    for (size_t i = 0; i < r->n; i++) {
        double m = hard_mass(c, &r->start[i]);
        p[0] += m * (r->end[i].vx - r->start[i].vx), p[1] += m * (r->end[i].vy - r->start[i].vy);
        size += m * hypot(r->start[i].vx, r->start[i].vy);
    }
    return (hard_verdict){hypot(p[0], p[1]) / size, 1e-12};
}

static hard_verdict rests(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          v = 0;
    for (size_t i = 0; i < r->n; i++) v = worse(v, fmax(hypot(r->end[i].vx, r->end[i].vy), 0.5 * r->end[i].diameter * fabs(r->end[i].spin)));
    return (hard_verdict){v / c->fastest, 0.01};
}

/* ---- symmetry of one run --------------------------------------------------------------------------------------------- */

static double asymmetry_of_ring(const fw_record *q)
{
    const double *l = fw_record_load(q, 0, FW_RING_LOAD);
    double        load = 0, d = 0;
    for (size_t k = 0; k < q->n_arcs; k++) load = fmax(load, l[k]), d = worse(d, fabs(l[k] - l[q->n_arcs - 1 - k]));
    return load > 0 ? d / load : 0;
}

static hard_verdict on_axis(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = asymmetry_of_ring(&r->record);
    for (size_t i = 0; i < r->n; i++) d = worse(d, fabs(r->end[i].y) + (fabs(r->end[i].vy) + 0.5 * r->end[i].diameter * fabs(r->end[i].spin)) / c->fastest);
    return (hard_verdict){d, 1e-12};
}

static hard_verdict symmetric(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = asymmetry_of_ring(&r->record);
    for (size_t i = 0; i < r->n; i++) {
        double nearest = INFINITY; /* of the partners: a floe that starts in the mirror image's place */
        for (size_t j = 0; j < r->n; j++) {
            if (hypot(r->start[i].x - r->start[j].x, r->start[i].y + r->start[j].y) > 1e-9) continue;
            const fw_floe *p = &r->end[i], *q = &r->end[j];
            double         apart = hypot(p->x - q->x, p->y + q->y) + (hypot(p->vx - q->vx, p->vy + q->vy) + 0.5 * p->diameter * fabs(p->spin + q->spin)) / c->fastest;
            nearest = fmin(nearest, apart);
        }
        d = worse(d, nearest);
    }
    return (hard_verdict){d, 1e-6};
}

/* ---- closed forms ---------------------------------------------------------------------------------------------------- */

/* m x'' + c x' + k x = 0 from the touch until k d + c d' = 0 (tension is refused): the speed there over the speed of the touch.
 * Schwager and Poeschel 2007; e^-2 at zeta = 1, 1 at zeta = 0. */
static double restitution_of(double zeta)
{
    if (zeta == 1) return exp(-2);
    if (zeta > 1) {
        double root = sqrt(zeta * zeta - 1);
        return exp(-zeta / root * log((zeta + root) / (zeta - root)));
    }
    double root = sqrt(1 - zeta * zeta);
    return exp(-zeta / root * atan2(2 * zeta * root, 2 * zeta * zeta - 1));
}

/* One floe on the structure, or two floes. */
static hard_verdict restitution(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          e = restitution_of(c->model.damping_ratio);
    if (r->n == 2) {
        double before = r->start[0].vx - r->start[1].vx, after = r->end[0].vx - r->end[1].vx;
        return (hard_verdict){fabs(-after / before - e), 1e-3};
    }
    double v = r->start[0].vx, impulse = hard_mass(c, r->start) * v * (1 + e);
    return (hard_verdict){worse(fabs(-r->end[0].vx / v - e), fabs(r->record.normal_impulse / impulse - 1)), 1e-3};
}

static hard_verdict no_spin(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = 0;
    for (size_t i = 0; i < r->n; i++) d = worse(d, fabs(r->end[i].spin - r->start[i].spin));
    return (hard_verdict){d, 0};
}

/* v' = -K |v| v against the water: v0 / (1 + K v0 t), way log(1 + K v0 t) / K along v0. */
static hard_verdict flight(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = 0, t = c->scene->duration, u = c->scene->speed;
    for (size_t i = 0; i < r->n; i++) {
        const fw_floe *a = &r->start[i], *b = &r->end[i];
        double         K = 0.5 * c->model.water_density * c->model.form_drag * a->diameter * a->thickness / hard_mass(c, a);
        double         v0 = hypot(a->vx - u, a->vy), slower = 1 / (1 + K * v0 * t), way = log1p(K * v0 * t) / (K * v0);
        d = worse(d, hypot(b->vx - u - (a->vx - u) * slower, b->vy - a->vy * slower) / v0);
        d = worse(d, hypot(b->x - a->x - u * t - (a->vx - u) * way, b->y - a->y - a->vy * way) / (v0 * t));
        d = worse(d, fabs(b->spin - a->spin));
    }
    return (hard_verdict){d, 1e-12};
}

static hard_verdict untouched(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = r->record.normal_impulse + r->path;
    for (size_t i = 0; i < r->n; i++) d = worse(d, hypot(r->end[i].vx - r->start[i].vx, r->end[i].vy - r->start[i].vy) + fabs(r->end[i].spin - r->start[i].spin));
    return (hard_verdict){d, 0};
}

/* ---- all of them ------------------------------------------------------------------------------------------------------ */

static hard_verdict (*const JUDGES[HARD_N_LAWS])(hard_case *) = {
    [HARD_LAW_ENDS] = ends,
    [HARD_LAW_FINITE] = finite,
    [HARD_LAW_ENERGY_BOOKS] = energy_books,
    [HARD_LAW_MOMENTUM_BOOKS] = momentum_books,
    [HARD_LAW_WEAR_BOOKS] = wear_books,
    [HARD_LAW_BALANCE] = balance,
    [HARD_LAW_OVERLAP] = overlap,
    [HARD_LAW_DEPTH] = depth,
    [HARD_LAW_MIRROR] = mirror,
    [HARD_LAW_TURNED] = turned,
    [HARD_LAW_NO_GAIN] = no_gain,
    [HARD_LAW_KEPT] = kept,
    [HARD_LAW_RESTS] = rests,
    [HARD_LAW_ON_AXIS] = on_axis,
    [HARD_LAW_SYMMETRIC] = symmetric,
    [HARD_LAW_RESTITUTION] = restitution,
    [HARD_LAW_NO_SPIN] = no_spin,
    [HARD_LAW_FLIGHT] = flight,
    [HARD_LAW_UNTOUCHED] = untouched,
    [HARD_LAW_REFUSES] = refuses,
};

uint64_t hard_laws_of(const hard_scene *s) { return s->laws & REFUSES ? s->laws : s->laws | HARD_ALWAYS; }

hard_verdict hard_law_judge(int law, hard_case *c)
{
    if (law != HARD_LAW_ENDS && law != HARD_LAW_REFUSES && hard_case_run(c, HARD_BASE)->status != FW_OK) return (hard_verdict){NAN, 0};
    return JUDGES[law](c);
}
