/* The kernel's hits, and from those at 0, 6, .. degrees to all of them.
 *
 * A hit's ring moves with the angle of its touch. So a solved hit stands for its neighbours by its own ring turned, with a weight that falls to nothing
 * at the next solved one: load, width of the patch and length of the slide are interpolated, the place is exact.
 *
 *      weight   /\/\/\            Tracks are even in y = sin(angle) (Ds + D)/2, so an angle counts with its cosine.
 *              /\/\/\/\           Beyond the last one load falls to 0 at 90 degrees, where floes pass by. */
#include "study/swept_inside.h"

#include <math.h>

#include "floewear/realisation.h"

static const double HALF_PI = 1.5707963267948966;

/* Gauss, of equal weights: exact for a cubic in the quantile. Against 2584 hits on a Fibonacci lattice over floes and angles (default ice, 1 m/s, floes of
 * 0.5 to 1.3 m | 0.5 and 0.7 m): sum of the ring, r.m.s. over arcs within 75 degrees, both over the ring's mean [%]
 *   3 diameters, 10 angles   -0.1 2.1 | -0.2 2.3     2 diameters, 10 angles   -0.1 2.1 | -0.2 2.3
 *   3 diameters, 15 angles   -0.3 1.1 | -0.2 1.2     2 diameters, 15 angles   -0.3 1.1 | -0.2 1.1     2, 18   -0.2 0.8 | -0.1 0.8
 * What is left lies at the middle (+8 % of a thirtieth of the most). A lattice of as many hits leaves 5 %, as every hit's patch is an island. */
const double fw_swept_diameter_at[FW_SWEPT_DIAMETERS] = {0.21132486540518712, 0.78867513459481288};

enum { N_ANGLES = 15 };
/* Instead of 0, from where a floe never comes off [rad]. */
static const double FIRST_ANGLE = 0.005;
/* 0.3 % along the contact for 99 % of random hits (realisation/accuracy.c). */
static const double HIT_ACCURACY = 0.1;
/* Time for a floe to leave the wall, in ways of (Ds + D)/2 at the current's speed; from the first angle it takes 7.5. One that cannot roll hangs on
 * friction for hundreds: to the end of the window (11 % of the load at 1 m/s). */
static const double STAY = 20;
/* A hit takes 20 to 300 evaluations on the spring, 3000 on ice that crushes. */
static const double MOST_EVALUATIONS = 1e6;

fw_model fw_swept_hit_model(const fw_model *model, size_t law)
{
    fw_model m = *model;
    m.effects &= ~(uint32_t)(FW_EFFECT_FLOE_CONTACT | FW_EFFECT_ICE_ON_ICE | FW_EFFECT_WIND | FW_EFFECT_TIDE);
    m.n_laws = 1, m.laws[0] = model->laws[law];
    m.accuracy = HIT_ACCURACY;
    m.numerics = (fw_numerics){.scheme = FW_SCHEME_EVENTS};
    m.max_evaluations = MOST_EVALUATIONS;
    return m;
}

/* Of neighbours that are off by i arcs. */
static double weight_at(long i, double arc, double angle, double reach)
{
    double off = (double)i * arc;
    return fmax(0, 1 - fabs(off) / reach) * fmax(0, cos(angle + off));
}

/* The ring turned by -reach .. reach (0 .. reach of the first one) and mirrored into row; weights sum to weight. */
static void smear(size_t n_arcs, const double *ring, double angle, double reach, bool is_first, double weight, fw_swept_row *row)
{
    double arc = 4 * HALF_PI / (double)n_arcs, sum = 0;
    long   far = (long)(reach / arc), n = (long)n_arcs, from = is_first ? 0 : -far;
    for (long i = from; i <= far; i++) sum += weight_at(i, arc, angle, reach);
    for (long i = from; i <= far; i++) {
        double share = 0.5 * weight / sum * weight_at(i, arc, angle, reach);
        for (long k = 0; k < n; k++) {
            if (ring[k] == 0) continue;
            long at = (k + i + n) % n, mirror = n - 1 - at;
            row->load[at] += share * ring[k], row->square[at] += share * ring[k] * ring[k];
            row->load[mirror] += share * ring[k], row->square[mirror] += share * ring[k] * ring[k];
        }
    }
}

/* width: of all tracks of this floe times its share of the floes [m]. */
static fw_status add_hit(const fw_model *model, const fw_floe *kind, double speed, size_t j, double width, fw_swept_row *row, double *evaluations,
                         fw_msg *m)
{
    double          step = HALF_PI / N_ANGLES, angle = j ? (double)j * step : FIRST_ANGLE, reach = model->structure_radius + 0.5 * kind->diameter;
    double          start = model->effects & FW_EFFECT_DEFLECTED_FLOW ? 10 * model->structure_radius : 0.05 * reach;
    fw_floe         floe = {.x = -reach * cos(angle) - start, .y = reach * sin(angle), .diameter = kind->diameter, .thickness = kind->thickness, .vx = speed};
    fw_scene        scene = {.model = *model, .speed = speed, .temperature = -10, .duration = (STAY * reach + 2 * start) / speed, .n_floes = 1, .floes = &floe};
    fw_scene_result r;
    if (!(model->effects & FW_EFFECT_ROTATION)) scene.duration = fmax(scene.duration, model->window);
    fw_status s = fw_scene_run(&scene, NULL, NULL, &r, m);
    if (s == FW_OK) {
        double share = (1 - cos(step)) / step * (j ? 2 * cos(angle) : 1); /* int of the weight times the cosine of the angle */
        smear(model->n_arcs, fw_record_load(&r.record, 0, FW_RING_LOAD), angle, step, j == 0, share * width, row);
        *evaluations += r.record.force_evaluations;
    } else {
        fw_msg_prefix(m, "a hit of the swept strip: ");
    }
    fw_scene_result_free(&r);
    return s;
}

fw_status fw_swept_solve(const fw_model *hit_model, double thickness, const double *diameter, double speed, fw_swept_row *row, double *evaluations,
                         fw_msg *m)
{
    for (size_t d = 0; d < FW_SWEPT_DIAMETERS; d++) {
        fw_floe kind = {.diameter = diameter[d], .thickness = thickness};
        double  width = (2 * hit_model->structure_radius + diameter[d]) / FW_SWEPT_DIAMETERS;
        for (size_t j = 0; j < N_ANGLES; j++) FW_TRY(add_hit(hit_model, &kind, speed, j, width, row, evaluations, m));
    }
    return FW_OK;
}
