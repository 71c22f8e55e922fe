#include "realisation/flow.h"

#include <math.h>

#include "effects/wind.h"
#include "field/sizes.h"

static const double TWO_PI = 6.283185307179586476925286766559;

/* Change of the current from one segment to the next, over its speed and the accuracy. Places are wrong by the square of it (tests/realisation), but
 * ice that nothing has touched meets the structure with the segment's velocity, wrong by up to half of it either way: that is first order for a hit,
 * and goes away over hits. Load in a tide of 40 minutes that reverses in the window, against an eighth of a segment, 200 windows of 20 minutes at 10 % ice
 * [%]: 0.25 +0.01 +- 0.07, 0.5 -0.01 +- 0.14, 1 -0.01 +- 0.23, 2 +0.10 +- 0.15, 4 +0.18 +- 0.49; such a window at 40 % ice takes 1.2 times as long at 0.5 as
 * at 1, one in a tide of 12.42 h as long. */
static const double TURN = 0.5;
/* Way within a segment, over the same: a jump needs no more of them than that, ice that is off by a centimetre at 1 % is where it was [m]. */
static const double SHORTEST = 2;
/* Floes feel the deflected flow up to here, in radii of the structure at an accuracy of 1 %; what is left of it goes with the square of the distance.
 * Load against 40 radii, 400 windows of 20 minutes on the same ice, 1 m/s [%]:    5               7               10              20 radii
 *   10 % ice                                                           0.69 +- 0.10    0.30 +- 0.07    0.13 +- 0.05    0.02 +- 0.03
 *   40 % ice                                                           0.62 +- 0.41                    0.31 +- 0.26    0.19 +- 0.23
 * So it goes with the cube root of the accuracy: 22 radii at 0.1 %. A window takes 1.6 times as long as without at 10 radii, 4 times at 40. */
static const double DEFLECTED = 10, DEFLECTED_FOR = 0.01;
/* In the wind floes drift apart: those within this way upstream are awake, unless on that way they come apart by less than this share of the
 * mean diameter, over the accuracy. Load against 200 m, windows on the same ice [%]; apart, of a diameter on 100 m:
 *                                          apart   windows   100 m            50 m             none awake
 *   40 % ice, 1 m/s, 15 m/s against        0.010   200       -0.4 +- 0.8      -0.7 +- 0.8      -0.4 +- 0.8
 *   40 % ice, 1 m/s, 15 m/s along, Cf 0.9  0.030   600       -0.4 +- 1.0      -0.7 +- 1.0      -0.3 +- 1.0
 *   40 % ice, 0.3 m/s, along / against     0.033   200, 200  -0.3, -0.1 +- 1.2  -0.3, -0.4 +- 1.4  -0.5, -0.8 +- 1.4
 *   20 % ice, 1 m/s, along                 0.009   600       +0.1 +- 0.2                       +0.2 +- 0.3
 *   20 % ice, 1 m/s, against, Cf 0.9       0.034   600       +0.2 +- 0.5      +0.4 +- 0.5      +0.1 +- 0.6
 *   20 % ice, 0.3 m/s, along, Cf 0.9       0.10    400       +0.1 +- 1.0      -0.3 +- 0.9      -0.3 +- 1.1
 *   20 % ice, 0.1 m/s, across, Cf 0.9      0.31    300       -0.6 +- 1.2      +0.1 +- 1.3      0.0 +- 1.4
 *   40 % ice, 0.1 m/s, across, Cf 0.9      0.31    200       -0.5 +- 1.4      -0.8 +- 1.6      -1.0 +- 1.5
 *   40 % ice, 1 m/s, against, Cf 0.9       0.034   900       -0.9 +- 0.7      -1.3 +- 0.7      -1.5 +- 0.7      400 m: +0.9 +- 0.7
 * Over the rows at 40 % ice up to 0.034: 100 m -0.5 +- 0.4, none awake -0.8 +- 0.4; at 20 % nothing is seen. The last row goes on growing with the way, some
 * 0.9 % for each doubling: ice that has long drifted in the wind is not as it was packed, and no way awake is enough for that. It is left at about
 * twice what a jam at 40 % reaches. Up to 0.02 nobody need be awake at 1 %, which makes a window 3 times cheaper. */
static const double AWAKE_WAY = 100, APART = 2;

/* Along +x and to its left, over the speed. */
static void course_at(const fw_weather *w, double t, double *x, double *y)
{
    const fw_tide *tide = w->tide;
    if (tide->n_rows == 0) {
        double phi = w->phase + TWO_PI * (t - w->middle) / tide->period;
        *x = cos(phi), *y = tide->minor_ratio * sin(phi);
        return;
    }
    const fw_course_row *r = tide->rows;
    size_t               k = 0;
    double               at = t - w->start;
    while (k + 1 < tide->n_rows && r[k + 1].time <= at) k++;
    double factor = r[k].factor, turn = r[k].turn;
    if (k + 1 < tide->n_rows && at > r[k].time) {
        double u = (at - r[k].time) / (r[k + 1].time - r[k].time);
        factor += u * (r[k + 1].factor - factor), turn += u * (r[k + 1].turn - turn);
    }
    *x = factor * cos(turn), *y = factor * sin(turn);
}

/* Change of the current between two rows, over the scenario's speed. */
static double change_between(const fw_course_row *a, const fw_course_row *b)
{
    return hypot(b->factor - a->factor, fmax(fabs(a->factor), fabs(b->factor)) * (b->turn - a->turn));
}

/* From row k - 1 to row k? */
static bool changes(const fw_tide *tide, size_t k) { return k > 0 && k < tide->n_rows && change_between(&tide->rows[k - 1], &tide->rows[k]) > 0; }

typedef struct segment {
    double middle, end;
} segment;

/* That t lies in. A table is cut between its rows, each stretch by its own change: a jump within a second costs no more than one within an hour, one within a millisecond next to nothing. */
static segment segment_at(const fw_weather *w, double t)
{
    const fw_tide *tide = w->tide;
    if (tide->n_rows == 0) {
        double length = w->turn * tide->period / TWO_PI, i = floor(t / length + 1e-9);
        return (segment){(i + 0.5) * length, (i + 1) * length};
    }
    const fw_course_row *r = tide->rows;
    size_t               k = 0;
    while (k < tide->n_rows && w->start + r[k].time <= t) k++;
    if (!changes(tide, k)) { /* to where it does */
        do k++;
        while (k < tide->n_rows && !changes(tide, k));
        return (segment){t, k < tide->n_rows ? w->start + r[k - 1].time : INFINITY};
    }
    double to = w->start + r[k].time, from = w->start + r[k - 1].time, way = fabs(w->speed) * fmax(fabs(r[k - 1].factor), fabs(r[k].factor)) * (to - from);
    double n = fmax(1, ceil(fmin(change_between(&r[k - 1], &r[k]), way / SHORTEST) / w->turn)), length = (to - from) / n;
    double i = fmin(n - 1, floor((t - from) / length + 1e-9));
    return (segment){from + (i + 0.5) * length, i + 1 < n ? from + (i + 1) * length : to};
}

/* Largest speed of the current from 0 to t_end, over the scenario's: a window at slack water is to be as accurate as any. */
static double largest_factor(const fw_weather *w, double t_end)
{
    enum { LOOKS = 64 };
    const fw_tide *tide = w->tide;
    double         most = 0, x, y;
    if (tide->n_rows == 0 && t_end >= 0.5 * tide->period) return 1; /* the major axis is passed */
    for (int i = 0; i <= LOOKS; i++) {
        course_at(w, t_end * i / LOOKS, &x, &y);
        most = fmax(most, hypot(x, y));
    }
    for (size_t k = 0; k < tide->n_rows; k++)
        if (w->start + tide->rows[k].time < t_end) most = fmax(most, fabs(tide->rows[k].factor));
    return most;
}

/* Free drift over the wind's speed of the mean floe and its spread, weighted by area: what the ice as a whole does, and how floes come apart. */
static fw_status mean_drift(const fw_model *model, int mix, const fw_setup *set, double *mean, double *spread, double *diameter, fw_msg *m)
{
    enum { N = 400 };
    fw_sizes sizes;
    double   weight = 0, sum = 0, squares = 0;
    FW_TRY(fw_sizes_init(&sizes, &model->mixes[mix], model->size_law, model->size_a, model->size_b, m));
    for (int i = 0; i < N; i++) {
        double D, h;
        fw_sizes_draw(&sizes, (i + 0.5) / N, &D, &h);
        fw_body b = fw_kernel_floe(set, 0.5 * D, h);
        double  share = fw_wind_free_drift(b.air, b.drag, 1);
        weight += D * D, sum += D * D * share, squares += D * D * share * share;
    }
    *mean = sum / weight;
    *spread = sqrt(fmax(0, squares / weight - *mean * *mean));
    *diameter = sizes.mean_diameter;
    return FW_OK;
}

fw_status fw_weather_init(fw_weather *w, fw_setup *set, const fw_model *model, const fw_scenario *sc, double start, double duration, int mix,
                          fw_msg *m)
{
    FW_CHECK(!set->has_wind || (sc->wind_speed >= 0 && isfinite(sc->wind_speed) && isfinite(sc->wind_angle)), m, FW_E_ARG,
             "wind of %g m/s to %g rad: wanted finite numbers, and at least 0 m/s", sc->wind_speed, sc->wind_angle);
    FW_CHECK(!(model->effects & FW_EFFECT_TIDE) || model->tide.n_rows || isfinite(sc->tide_phase), m, FW_E_ARG, "phase of the tide %g rad: wanted a finite number",
             sc->tide_phase);
    *w = (fw_weather){.speed = sc->speed, .phase = sc->tide_phase, .middle = start + 0.5 * duration, .start = start, .turn = TURN * model->accuracy};
    if (model->effects & FW_EFFECT_TIDE) w->tide = &model->tide;
    if (set->has_wind) w->wind_x = sc->wind_speed * cos(sc->wind_angle), w->wind_y = sc->wind_speed * sin(sc->wind_angle);
    if (set->has_wind && mix >= 0) {
        double spread, diameter, through = hypot(w->wind_x - sc->speed, w->wind_y);
        FW_TRY(mean_drift(model, mix, set, &w->drift, &spread, &diameter, m));
        double apart = spread * through * AWAKE_WAY / sc->speed;
        set->wake_upstream = apart > APART * model->accuracy * diameter ? AWAKE_WAY : 0;
    }
    if (set->has_deflection && mix >= 0) set->wake_radius = DEFLECTED * cbrt(DEFLECTED_FOR / model->accuracy) * model->structure_radius;
    set->flow = fw_weather_flow(w, 0);
    w->fastest = w->tide ? fmax(fabs(sc->speed) * largest_factor(w, start + duration), FW_SLOWEST) : fabs(sc->speed);
    w->fastest += w->drift * fmax(0, hypot(w->wind_x, w->wind_y) - w->fastest);
    return FW_OK;
}

fw_flow fw_weather_flow(const fw_weather *w, double t)
{
    fw_flow f = {.ux = w->speed, .wind_x = w->wind_x, .wind_y = w->wind_y};
    if (w->tide) {
        course_at(w, segment_at(w, t).middle, &f.ux, &f.uy);
        f.ux *= w->speed, f.uy *= w->speed;
    }
    f.ice_x = f.ux + w->drift * (f.wind_x - f.ux), f.ice_y = f.uy + w->drift * (f.wind_y - f.uy);
    return f;
}

double fw_weather_segment_end(const fw_weather *w, double t)
{
    return w->tide ? segment_at(w, t).end : INFINITY;
}
