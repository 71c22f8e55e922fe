/* Inside abrasion: nodes of an interval -> sums and ring. Compiled twice: for wear.c, and for wear_limited.c, so that a run without a limit
 * has not an instruction of it. */
#ifndef FW_ABRASION_WEAR_INSIDE_H
#define FW_ABRASION_WEAR_INSIDE_H

#include <math.h>

#ifndef FW_WEAR_IS_LIMITED
#define FW_WEAR_IS_LIMITED 0
#endif

#include "abrasion/wear.h"
#include "geometry/lens.h"
#include "geometry/ring.h"
#include "physics/crush.h"

/* Neighbouring nodes share a patch as long as its edges move less than this many arcs. What a patch of several nodes puts wrong
 * grows like the square: over many hits 1e-5 of the load in the front 150 degrees, 2e-4 of an arc's load. */
static const double EDGE_WAY = 0.85;

enum { ALL, IMPACT, HIGH, PATH, QUAD };

static const double TWO_PI = 6.283185307179586476925286766559;
static const double PER_ROOT =
    1.2909944487358056; /* 1 / sqrt(3/5): the outer Gauss nodes are sqrt(3/5) of the interval apart */

/* What one patch leaves on the wall, each a quantity times the patch's chord: a quad per law as in fw_wear.cells. */
typedef double deposit[FW_MAX_LAWS * QUAD];

/* asin by its series where that is short: to 1e-13 of a half-angle of 11 degrees. */
static double asin_of(double x)
{
    static const double C[] = {1.0 / 6,     3.0 / 40,     5.0 / 112,     35.0 / 1152,
                               63.0 / 2816, 231.0 / 13312, 143.0 / 10240, 6435.0 / 557056};
    double y = x * x;
    if (!(x < 0.2)) return asin(x < 1 ? x : 1);
    double low = C[0] + y * C[1] + y * y * (C[2] + y * C[3]), upper = C[4] + y * C[5] + y * y * (C[6] + y * C[7]);
    return x + x * y * (low + y * y * y * y * upper);
}

/* The patch's centre moves from `from` to `to`, its chord grows by `growth` on the way. Its arc is a little longer than its
 * chord; amounts per chord keep the integral. */
static void spread(fw_wear *w, const deposit d, double thickness, double from, double to, double chord, double growth)
{
    w->x_thickness += d[ALL] * thickness;
    double wide = 2 * w->structure_radius, half = asin_of(chord / wide);
    double most = half < chord / wide ? half : chord / wide; /* a chord that is said to shrink by more than itself would turn inside out */
    double more = 0.5 * growth / wide;
    more = more > most ? most : more < -most ? -most : more;
    double low[2] = {from - half + more, to - half - more};
    double high[2] = {from + half - more, to + half + more};
    fw_ring_spread(w->cells, w->n_laws, w->n_arcs, low, high, d);
}

/* What a node is besides its numbers; bits. */
enum { IS_IMPACT = 1, IS_BEYOND = 2 };

static unsigned traits(const fw_wear *w, const fw_wear_interval *iv, double u, double depth)
{
    double small = iv->radius < w->structure_radius ? iv->radius : w->structure_radius;
    return (u * iv->length < iv->impact_left ? IS_IMPACT : 0) | (depth > 0.1 * small && !iv->is_crushed ? IS_BEYOND : 0);
}

/* Pressure under a chord: of a spring's force, or as ice that crushes has it. The latter is capped node by node where there is a limit as well: below the
 * pressure that crushes it contradicts the contact, above it there is nothing to cap. */
static inline double pressure(const fw_wear *w, const fw_wear_interval *iv, double normal, double chord)
{
    double area = chord * iv->thickness;
    if (!iv->is_crushed) return normal / area;
    double p = iv->is_push ? fw_crush_pressure(&iv->crush, area) : normal;
    if (!FW_WEAR_IS_LIMITED) return p;
    double most = area > 0 ? fw_limit_force(&w->quadrature.limit, area) / area : INFINITY;
    return p < most ? p : most;
}

/* Share of a node's load above high_pressure. Soon after a touch sigma = p / lift falls through it inside a node's part of the
 * interval, lift^2 growing evenly and p hardly changing; counting whole nodes there would be 10 % off. */
static double high(const fw_wear *w, const fw_rule_nodes *at, size_t q, double p)
{
    double ratio = p / w->high_pressure, from = at->lift2_from[q], to = at->lift2_to[q];
    ratio *= ratio;
    return ratio <= from ? 0 : ratio >= to ? 1 : (ratio - from) / (to - from);
}

/* How far either edge of the patch moves in node q's part, in arcs. */
static double way(const fw_rule_nodes *at, const double *edge, size_t q, double per_turn, double per_chord)
{
    return (at->to[q] - at->from[q]) * per_turn + fabs(edge[q + 1] - edge[q]) * per_chord;
}

/* Of law l, along the contact and on the wall. */
static void count(fw_wear *w, size_t l, double path, double along, double wall, unsigned is, double above, deposit d)
{
    fw_wear_sums *s = &w->sums[l];
    s->path += path, s->along += along, s->x_wall += wall;
    if (is & IS_IMPACT) s->impact += along;
    if (is & IS_BEYOND) s->beyond += along;
    d[QUAD * l + ALL] += wall;
    d[QUAD * l + IMPACT] += is & IS_IMPACT ? wall : 0;
    d[QUAD * l + HIGH] += wall * above;
}

/* The usual interval. Its three patches are laid down as one that sweeps from the interval's start to its end, when that is as
 * good: total and mean edges stay. Load that grows while the patch moves then lies a twelfth of growth x way too far back, less than
 * a tenth of an arc; edges that do not move evenly are off by the chord's bend, a part of the arc and a half that either
 * may move by growth. Both are gone again when the patch slows or shrinks. */
static inline __attribute__((always_inline)) void lay_smooth(fw_wear *w, const fw_wear_interval *iv, const fw_rule_smooth *at, const double chord[4],
                                                             const double p[4], double turn)
{
    static const double U[3] = FW_RULE_NODES3, WEIGHT[3] = FW_RULE_WEIGHTS3;
    double              path[3], above[3];
    unsigned            is[3];
    for (size_t q = 0; q < 3; q++) {
        path[q] = fabs(at->slip[q]) * (WEIGHT[q] * iv->length);
        is[q] = traits(w, iv, U[q], at->depth[q]);
        above[q] = p[q] > w->high_pressure ? 1 : 0;
    }
    double arcs = (double)w->n_arcs * (1 / TWO_PI), slip = fabs(at->slip[1]);
    double growth = 2 * fabs(p[2] - p[0]) * slip + fabs(at->slip[2] - at->slip[0]) * p[1];
    bool   is_one = fabs(chord[2] - chord[0]) * arcs < 3 * w->structure_radius &&
                  fabs(turn) * arcs * growth < p[1] * slip;
    double edge = iv->angle[0], rise = (chord[2] - chord[0]) * PER_ROOT;
    deposit d = {0};
    for (size_t q = 0; q < 3; q++) {
        d[PATH] += path[q] * chord[q];
        for (size_t l = 0; l < w->n_laws; l++) {
            double along = fw_power_of(&w->power[l], p[q]) * path[q];
            count(w, l, path[q], along, along * chord[q], is[q], above[q], d);
        }
        if (is_one) continue;
        spread(w, d, iv->thickness, edge, edge + turn * WEIGHT[q], chord[q], rise * WEIGHT[q]);
        edge += turn * WEIGHT[q];
        for (size_t i = 0; i < QUAD * w->n_laws; i++) d[i] = 0;
    }
    if (!is_one) return;
    double mean = chord[0] * WEIGHT[0] + chord[1] * WEIGHT[1] + chord[2] * WEIGHT[2];
    spread(w, d, iv->thickness, iv->angle[0], iv->angle[0] + turn, mean, rise);
}

/* Intervals that begin or end with a touch, a release or a turn of slip. */
static void collect_nodes(fw_wear *w, const fw_wear_interval *iv, fw_rule_nodes *at, double turn)
{
    double chord[FW_RULE_NODES], edge[FW_RULE_NODES + 1], arcs = (double)w->n_arcs * (1 / TWO_PI);
    double per_turn = fabs(turn) * arcs, per_chord = 0.5 * arcs / w->structure_radius;
    size_t n = at->n, n_quads = QUAD * w->n_laws;
    for (size_t q = n; q % 4; q++) at->depth[q] = 0;
    for (size_t q = 0; q < n; q += 4) fw_lens_chords(at->depth + q, iv->radius, w->structure_radius, chord + q);
    /* the patch grows from half-way to the node before to half-way to the one after, else the ring would show steps */
    for (size_t q = 1; q < n; q++) edge[q] = 0.5 * (chord[q - 1] + chord[q]);
    edge[0] = n > 1 ? 2 * chord[0] - edge[1] : chord[0], edge[n] = n > 1 ? 2 * chord[n - 1] - edge[n - 1] : chord[0];
    if (edge[0] < 0) edge[0] = 0;
    if (edge[n] < 0) edge[n] = 0;
    deposit sum = {0};
    double  moved = 0, above = 0;
    bool    is_any = false;
    for (size_t q = 0, first = 0; q < n; q++) {
        double slip = fabs(at->slip[q]);
        if (slip > 0 && chord[q] > 0 && at->normal[q] > 0) {
            double   breadth = chord[q] / at->lift[q], p = pressure(w, iv, at->normal[q], breadth);
            unsigned is = traits(w, iv, at->u[q], at->depth[q]);
            above = high(w, at, q, p), is_any = true;
            sum[PATH] += slip * breadth * at->wide[q];
            for (size_t l = 0; l < w->n_laws; l++) {
                double rate = fw_power_of(&w->power[l], p) * slip;
                count(w, l, slip * at->dt[q], rate * at->along[l][q], rate * breadth * at->wall[l][q], is, above, sum);
            }
        }
        moved += way(at, edge, q, per_turn, per_chord);
        bool falls = above > 0 && above < 1; /* through high_pressure: what lies above keeps to its own arcs */
        if (q + 1 < n && !falls && moved + way(at, edge, q + 1, per_turn, per_chord) < EDGE_WAY) continue;
        if (is_any)
            spread(w, sum, iv->thickness, iv->angle[0] + turn * at->from[first], iv->angle[0] + turn * at->to[q],
                   0.5 * (edge[first] + edge[q + 1]), edge[q + 1] - edge[first]);
        for (size_t i = 0; i < n_quads; i++) sum[i] = 0;
        moved = 0, is_any = false, first = q + 1;
    }
}

void fw_wear_collect_limited(fw_wear *w, const fw_wear_interval *iv);

#endif
