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
/* None at all is no balance: the ledger says 0 when less than nothing is dissipated. */
static hard_verdict balance(hard_case *c)
{
    const fw_record *q = &hard_case_run(c, HARD_BASE)->record;
    bool             is_none = q->energy_truncation == 0 && q->normal_impulse > 0 && c->model.damping_ratio > 0;
    return (hard_verdict){is_none ? NAN : q->energy_truncation, c->accuracy};
}
static hard_verdict overlap(hard_case *c) { return (hard_verdict){hard_case_run(c, HARD_BASE)->record.max_overlap_share, 1 - 1e-12}; }

static hard_verdict punctual(hard_case *c)
{
    const fw_record *q = &hard_case_run(c, HARD_BASE)->record;
    return (hard_verdict){q->late_touches, hard_is_window(c->scene) ? 1e-2 * q->floes_touched : 0};
}

static hard_verdict refuses(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    bool            is_refused = (r->status == FW_E_NUMERIC || r->status == FW_E_ARG) && strstr(r->cause, "floe");
    return (hard_verdict){!is_refused, 0};
}

/* ---- two runs ------------------------------------------------------------------------------------------------------ */

static hard_verdict depth(hard_case *c)
{
    double base = hard_case_run(c, HARD_BASE)->depth, fine = hard_case_run(c, HARD_FINE)->depth;
    return (hard_verdict){base == fine ? 0 : fabs(base / fine - 1), c->accuracy};
}

static hard_verdict twice(hard_case *c)
{
    hard_verdict v = depth(c);
    v.bound *= 2;
    return v;
}

static hard_verdict roughly(hard_case *c)
{
    double fine = hard_case_run(c, HARD_FINE)->depth;
    return (hard_verdict){depth(c).value, fmax(c->accuracy, fabs(hard_case_run(c, HARD_SHIFTED)->depth / fine - 1))};
}

/* Arc k of the base run lies on this one of the image. */
static size_t arc_of(const hard_image *to, size_t k, size_t n)
{
    return to->flip < 0 ? n - 1 - k : (k + n - (size_t)to->degrees * n / 360) % n;
}

/* Of a run from the image of HARD_BASE: largest difference of place over the longest way (at least a metre), and of velocity over the fastest. */
static double off_motion(hard_case *c, hard_which which)
{
    const hard_run   *a = hard_case_run(c, HARD_BASE), *b = hard_case_run(c, which);
    const hard_image *to = &hard_images[which];
    double            co = to->cosine, si = to->sine, way = fmax(1, c->fastest * c->scene->duration), d = 0;
    if (a->status != FW_OK || b->status != FW_OK) return NAN;
    for (size_t i = 0; i < a->n; i++) {
        const fw_floe *p = &a->end[i], *q = &b->end[to->is_reversed ? a->n - 1 - i : i];
        double         y = to->flip * p->y, vx = to->velocity * p->vx, vy = to->velocity * to->flip * p->vy, v = to->velocity * c->fastest;
        d = worse(d, hypot(q->x - (co * p->x - si * y), q->y - (si * p->x + co * y)) / way);
        d = worse(d, hypot(q->vx - (co * vx - si * vy), q->vy - (si * vx + co * vy)) / v);
        d = worse(d, 0.5 * p->diameter * fabs(q->spin - to->velocity * to->flip * p->spin) / v);
    }
    return d;
}

/* Likewise the wear: largest difference of what lies between the first arc and any other, over all of it. */
static double off_ring(hard_case *c, hard_which which)
{
    const fw_record  *a = &hard_case_run(c, HARD_BASE)->record, *b = &hard_case_run(c, which)->record;
    const hard_image *to = &hard_images[which];
    const double     *la = fw_record_load(a, 0, FW_RING_LOAD), *lb = fw_record_load(b, 0, FW_RING_LOAD);
    double            all = 0, sum = 0, d = 0;
    for (size_t k = 0; k < a->n_arcs; k++) all += la[k];
    for (size_t k = 0; all > 0 && k < a->n_arcs; k++) sum += lb[arc_of(to, k, a->n_arcs)] - la[k], d = worse(d, fabs(sum) / all);
    return d;
}

static double off(hard_case *c, hard_which which) { return worse(off_motion(c, which), off_ring(c, which)); }

/* Of depth: the ring may differ where pressure passes 5 MPa, since what lies above keeps to its own arcs (abrasion/wear.c). */
static double off_depth(hard_case *c, hard_which which)
{
    double a = hard_case_run(c, HARD_BASE)->depth, b = hard_case_run(c, which)->depth / pow(hard_images[which].force, c->model.laws[0].exponent);
    return a == b ? 0 : fabs(b / a - 1);
}
static double off_similar(hard_case *c, hard_which which) { return worse(off_motion(c, which), off_depth(c, which)); }

static hard_verdict mirror(hard_case *c) { return (hard_verdict){off(c, HARD_MIRROR), 1e-9}; }
static hard_verdict similar(hard_case *c) { return (hard_verdict){worse(off_similar(c, HARD_LIGHT), off_similar(c, HARD_SWIFT)), 1e-9}; }
static hard_verdict order(hard_case *c) { return (hard_verdict){off(c, HARD_REVERSED), c->accuracy}; }
/* Of depth, which is what accuracy promises; of motion where there is none. */
static hard_verdict watching(hard_case *c)
{
    bool has_depth = hard_case_run(c, HARD_BASE)->depth > 0;
    return (hard_verdict){has_depth ? off_depth(c, HARD_WATCHED) : off_motion(c, HARD_WATCHED), c->accuracy};
}
static hard_verdict turned(hard_case *c)
{
    return (hard_verdict){worse(off(c, HARD_QUARTER), off(c, HARD_TURNED)), c->accuracy};
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

/* Spin is not asked for: form drag does not slow it. */
static hard_verdict rests(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          v = 0;
    for (size_t i = 0; i < r->n; i++) v = worse(v, hypot(r->end[i].vx, r->end[i].vy));
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

static double asymmetry(const hard_case *c, const hard_run *r)
{
    double d = asymmetry_of_ring(&r->record);
    if (r->status != FW_OK) return NAN;
    for (size_t i = 0; i < r->n; i++) {
        double nearest = INFINITY; /* of the partners: floes that start in the mirror image's place */
        for (size_t j = 0; j < r->n; j++) {
            if (hypot(r->start[i].x - r->start[j].x, r->start[i].y + r->start[j].y) > 1e-9) continue;
            const fw_floe *p = &r->end[i], *q = &r->end[j];
            double         apart = hypot(p->x - q->x, p->y + q->y) + (hypot(p->vx - q->vx, p->vy + q->vy) + 0.5 * p->diameter * fabs(p->spin + q->spin)) / c->fastest;
            nearest = fmin(nearest, apart);
        }
        d = worse(d, nearest);
    }
    return d;
}

static hard_verdict symmetric(hard_case *c)
{
    return (hard_verdict){worse(asymmetry(c, hard_case_run(c, HARD_BASE)), 10 * asymmetry(c, hard_case_run(c, HARD_FINE))), c->accuracy};
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

/* One floe on the structure, or two floes: how far the speed after and the impulse are off. */
static double off_restitution(const hard_case *c, const hard_run *r)
{
    double e = restitution_of(c->model.damping_ratio), v = r->start[0].vx;
    if (r->n == 2) return fabs((r->end[1].vx - r->end[0].vx) / (v - r->start[1].vx) - e);
    double impulse = hard_mass(c, r->start) * v * (1 + e);
    return worse(fabs(-r->end[0].vx / v - e), fabs(r->record.normal_impulse / impulse - 1));
}

/* The same oscillator, times in 1/w: overlap d(t) and force N(t) = d + 2 zeta d' for unit speed, mass and stiffness. */
static void oscillate(double zeta, double t, double *d, double *n)
{
    double root = sqrt(fabs(1 - zeta * zeta)), decay = exp(-zeta * t), sine = t, cosine = 1;
    if (zeta < 1) sine = sin(root * t) / root, cosine = cos(root * t);
    if (zeta > 1) sine = sinh(root * t) / root, cosine = cosh(root * t);
    *d = decay * sine, *n = *d + 2 * zeta * decay * (cosine - zeta * sine);
}

/* d' = 0: tan(root t) = root / zeta. N' = 0: tan(root t) = root (1 - 4 zeta^2) / (zeta (3 - 4 zeta^2)); from zeta 1/2 on it only falls. */
static double deepest_of(double zeta)
{
    double root = sqrt(fabs(1 - zeta * zeta)), t = 1, d, n;
    if (zeta < 1) t = atan2(root, zeta) / root;
    if (zeta > 1) t = atanh(root / zeta) / root;
    oscillate(zeta, t, &d, &n);
    return d;
}
static double peak_of(double zeta)
{
    double root = sqrt(fabs(1 - zeta * zeta)), d, n;
    oscillate(zeta, zeta < 0.5 ? atan2(root * (1 - 4 * zeta * zeta), zeta * (3 - 4 * zeta * zeta)) / root : 0, &d, &n);
    return n;
}

static hard_verdict deepest(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    bool            is_pair = r->n == 2;
    double          inv = 1 / hard_mass(c, r->start) + (is_pair ? 1 / hard_mass(c, r->start + 1) : 0), w = sqrt(c->model.stiffness * inv);
    double          v = r->start[0].vx - (is_pair ? r->start[1].vx : 0);
    return (hard_verdict){fabs(r->max_overlap / (v / w * deepest_of(c->model.damping_ratio)) - 1), c->accuracy};
}

/* Of one floe on the structure. */
static hard_verdict peak(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          w = sqrt(c->model.stiffness / hard_mass(c, r->start)), v = r->start[0].vx;
    return (hard_verdict){fabs(r->record.peak_force / (c->model.stiffness * v / w * peak_of(c->model.damping_ratio)) - 1), c->accuracy};
}

static hard_verdict restitution(hard_case *c)
{
    return (hard_verdict){worse(off_restitution(c, hard_case_run(c, HARD_BASE)), 10 * off_restitution(c, hard_case_run(c, HARD_FINE))), c->accuracy};
}

static hard_verdict no_spin(hard_case *c)
{
    const hard_run *r = hard_case_run(c, HARD_BASE);
    double          d = 0;
    for (size_t i = 0; i < r->n; i++) d = worse(d, 0.5 * r->end[i].diameter * fabs(r->end[i].spin - r->start[i].spin));
    return (hard_verdict){d / c->fastest, 1e-12};
}

static hard_verdict touches(hard_case *c) { return (hard_verdict){!(hard_case_run(c, HARD_BASE)->record.hits >= 1), 0}; }

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
    [HARD_LAW_PUNCTUAL] = punctual,
    [HARD_LAW_OVERLAP] = overlap,
    [HARD_LAW_DEPTH] = depth,
    [HARD_LAW_TWICE] = twice,
    [HARD_LAW_ROUGHLY] = roughly,
    [HARD_LAW_MIRROR] = mirror,
    [HARD_LAW_SIMILAR] = similar,
    [HARD_LAW_ORDER] = order,
    [HARD_LAW_WATCHING] = watching,
    [HARD_LAW_TURNED] = turned,
    [HARD_LAW_NO_GAIN] = no_gain,
    [HARD_LAW_KEPT] = kept,
    [HARD_LAW_RESTS] = rests,
    [HARD_LAW_ON_AXIS] = on_axis,
    [HARD_LAW_SYMMETRIC] = symmetric,
    [HARD_LAW_RESTITUTION] = restitution,
    [HARD_LAW_DEEPEST] = deepest,
    [HARD_LAW_PEAK] = peak,
    [HARD_LAW_NO_SPIN] = no_spin,
    [HARD_LAW_TOUCHES] = touches,
    [HARD_LAW_FLIGHT] = flight,
    [HARD_LAW_UNTOUCHED] = untouched,
    [HARD_LAW_REFUSES] = refuses,
};

uint64_t hard_laws_of(const hard_scene *s)
{
    if (s->laws & REFUSES) return s->laws;
    return (s->laws | HARD_ALWAYS | (hard_is_window(s) || s->is_once ? 0 : HARD_OF_SCENES)) & ~s->without;
}

hard_verdict hard_law_judge(int law, hard_case *c)
{
    if (law != HARD_LAW_ENDS && law != HARD_LAW_REFUSES && hard_case_run(c, HARD_BASE)->status != FW_OK) return (hard_verdict){NAN, 0};
    return JUDGES[law](c);
}
