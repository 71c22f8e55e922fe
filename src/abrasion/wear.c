#include "abrasion/wear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "geometry/lens.h"
#include "geometry/ring.h"

static const double TWO_PI = 6.283185307179586476925286766559;

fw_status fw_wear_init(fw_wear *w, double structure_radius, size_t n_arcs, size_t n_laws, const fw_abrasion_law *laws,
                       fw_msg *m)
{
    memset(w, 0, sizeof *w);
    w->structure_radius = structure_radius;
    w->n_arcs = n_arcs;
    w->n_laws = n_laws;
    w->high_pressure = 5e6;
    double *block;
    FW_TRY(fw_alloc(&block, n_arcs * (1 + 3 * n_laws) + n_arcs + 1, sizeof *block, "wear ring", m));
    w->path = block;
    w->share = block + n_arcs * (1 + 3 * n_laws);
    for (size_t l = 0; l < n_laws; l++) {
        w->exponent[l] = laws[l].exponent;
        for (size_t q = 0; q < 3; q++) w->load[l][q] = block + n_arcs * (1 + 3 * l + q);
    }
    return FW_OK;
}

void fw_wear_free(fw_wear *w)
{
    free(w->path);
    memset(w, 0, sizeof *w);
}

/* Lagrange interpolation through the stages: scale once per interval, basis once per instant, one sum per quantity. */
typedef struct stages {
    size_t        n;
    const double *at;
    double        scale[FW_WEAR_STAGES], basis[FW_WEAR_STAGES];
} stages;

static void stages_set(stages *s, size_t n, const double *at)
{
    s->n = n, s->at = at;
    for (size_t i = 0; i < n; i++) {
        double p = 1;
        for (size_t j = 0; j < n; j++)
            if (j != i) p *= at[i] - at[j];
        s->scale[i] = 1 / p;
    }
}

static void stages_go_to(stages *s, double u)
{
    for (size_t i = 0; i < s->n; i++) {
        double p = s->scale[i];
        for (size_t j = 0; j < s->n; j++)
            if (j != i) p *= u - s->at[j];
        s->basis[i] = p;
    }
}

static double stages_value(const stages *s, const double *value)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++) sum += s->basis[i] * value[i];
    return sum;
}

static double hermite(double f0, double s0, double f1, double s1, double h, double u)
{
    double a = 1 - u;
    return a * a * ((1 + 2 * u) * f0 + u * h * s0) + u * u * ((1 + 2 * a) * f1 - a * h * s1);
}

/* One node: weight dt, all quantities at one instant. */
static void deposit(fw_wear *w, double dt, double normal, double slip, double chord, double angle, double thickness,
                    bool is_impact, bool is_beyond)
{
    double sigma = normal / (chord * thickness), way = fabs(slip) * dt;
    if (!(way > 0) || !(chord > 0)) return;
    double half = asin(fmin(1.0, chord / (2 * w->structure_radius)));
    size_t first, count = fw_ring_cover(w->n_arcs, angle, half, &first, w->share);
    /* The arc under the patch is a little longer than the chord; chord / arc length keeps the patch's integral. */
    double per_arc = chord * (double)w->n_arcs / (TWO_PI * w->structure_radius);
    double add_load[FW_MAX_LAWS];
    for (size_t l = 0; l < w->n_laws; l++) {
        double        load = sigma > 0 ? pow(sigma, w->exponent[l]) * way : 0;
        fw_wear_sums *s = &w->sums[l];
        s->path += way;
        s->along += load;
        s->x_wall += load * chord;
        if (is_impact) s->impact += load;
        if (is_beyond) s->beyond += load;
        add_load[l] = load * per_arc;
    }
    bool is_high = sigma > w->high_pressure;
    for (size_t a = 0, k = first; a < count; a++, k = k + 1 == w->n_arcs ? 0 : k + 1) {
        w->path[k] += way * per_arc * w->share[a];
        for (size_t l = 0; l < w->n_laws; l++) {
            double add = add_load[l] * w->share[a];
            w->load[l][0][k] += add;
            if (is_impact) w->load[l][1][k] += add;
            if (is_high) w->load[l][2][k] += add;
        }
    }
}

/* The part [u0, u1] of the interval with a force. The signed law k d + c d' is smooth where the clamp at zero has a kink, so
 * its zero is found on the interpolant: a floe that leaves slides fast on its last millimetres and a step that counts
 * whole nodes there would be off by some per cent in path. */
static void loaded_part(stages *s, const fw_wear_interval *iv, double *u0, double *u1)
{
    double first = iv->normal[0], last = iv->normal[iv->n_stages - 1];
    *u0 = 0, *u1 = 1;
    if (first > 0 && last > 0) return;
    if (!(first > 0) && !(last > 0)) {
        *u1 = 0;
        return;
    }
    double lo = 0, hi = 1; /* loaded at lo when first > 0, else at hi */
    for (int n = 0; n < 40; n++) {
        double u = 0.5 * (lo + hi);
        stages_go_to(s, u);
        if ((stages_value(s, iv->normal) > 0) == (first > 0))
            lo = u;
        else
            hi = u;
    }
    if (first > 0)
        *u1 = lo;
    else
        *u0 = hi;
}

void fw_wear_collect(fw_wear *w, const fw_wear_interval *iv)
{
    if (!w->is_open || !(iv->length > 0)) return;
    /* Gauss-Legendre, 3 nodes on (0, 1). */
    static const double NODE[3] = {0.11270166537925831, 0.5, 0.88729833462074169};
    static const double WEIGHT[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

    double u0, u1;
    stages at;
    stages_set(&at, iv->n_stages, iv->at);
    loaded_part(&at, iv, &u0, &u1);
    if (!(u1 > u0)) return;
    double turn = iv->angle[1] - iv->angle[0];
    turn -= TWO_PI * round(turn / TWO_PI);
    /* A patch that moves over several arcs in a step is set down often enough for the ring to look smooth. */
    double arcs = fabs(turn) * (u1 - u0) * (double)w->n_arcs / TWO_PI;
    size_t parts = arcs > 24 ? 8 : (size_t)(arcs / 3) + 1;
    /* Substitution s = t^p, p = 1 - m/2 of the first law, t the time since touch, takes the t^(-m/2) of the pressure
     * out. Ten step lengths after the touch it is smooth enough without. */
    double p = 1 - 0.5 * w->exponent[0], from = iv->since_touch + u0 * iv->length,
           to = iv->since_touch + u1 * iv->length;
    bool   is_early = iv->since_touch < 10 * iv->length;
    double s0 = is_early ? pow(from, p) : from, s1 = is_early ? pow(to, p) : to;
    for (size_t part = 0; part < parts; part++) {
        for (size_t q = 0; q < 3; q++) {
            double f = ((double)part + NODE[q]) / (double)parts, t = s0 + (s1 - s0) * f;
            double dt = (s1 - s0) * WEIGHT[q] / (double)parts;
            if (is_early) {
                double s = t;
                t = pow(s, 1 / p);
                dt *= t / (p * s);
            }
            double u = fmin(1.0, fmax(0.0, (t - iv->since_touch) / iv->length));
            double depth = hermite(iv->depth[0], iv->rate[0], iv->depth[1], iv->rate[1], iv->length, u);
            stages_go_to(&at, u);
            double normal = stages_value(&at, iv->normal);
            if (!(depth > 0) || !(normal > 0)) continue;
            double slip = stages_value(&at, iv->slip);
            double chord = fw_lens_chord(depth, iv->radius, w->structure_radius);
            deposit(w, dt, normal, slip, chord, iv->angle[0] + turn * u, iv->thickness,
                    u * iv->length<iv->impact_left, depth> 0.1 * fmin(iv->radius, w->structure_radius));
        }
    }
}

double fw_wear_conservation(const fw_wear *w)
{
    double arc = TWO_PI * w->structure_radius / (double)w->n_arcs, worst = 0;
    for (size_t l = 0; l < w->n_laws; l++) {
        double sum = 0;
        for (size_t k = 0; k < w->n_arcs; k++) sum += w->load[l][0][k];
        if (w->sums[l].x_wall > 0) worst = fmax(worst, fabs(sum * arc - w->sums[l].x_wall) / w->sums[l].x_wall);
    }
    return worst;
}
