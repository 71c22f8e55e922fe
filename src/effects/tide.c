#include <math.h>
#include <stdio.h>

#include "effects/rows.h"

static const double FASTEST = 20; /* [m/s], of any current, as current.speed is checked */

static bool is_given(const fw_scene_facts *f) { return fw_effects_given(f, FW_GIVEN_TIDE) || fw_effects_given(f, FW_GIVEN_COURSE); }

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    const fw_tide *t = &m->tide;
    if (!is_given(f)) {
        snprintf(reason, FW_REASON_SIZE, "neither current.tide nor current.course");
        return false;
    }
    if (t->n_rows == 0) {
        snprintf(reason, FW_REASON_SIZE, "a window of %.3g h is %.3g deg of the tide's %.4g h, minor over major axis %.3g", m->window / 3600, 360 * m->window / t->period,
                 t->period / 3600, t->minor_ratio + 0.0); /* -0 + 0 = 0 */
        return true;
    }
    double least = INFINITY, most = -INFINITY, left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < t->n_rows; i++) {
        least = fmin(least, t->rows[i].factor), most = fmax(most, t->rows[i].factor);
        left = fmin(left, t->rows[i].turn), right = fmax(right, t->rows[i].turn);
    }
    snprintf(reason, FW_REASON_SIZE, "current.course of %zu rows, %.4g to %.4g h of a window of %.4g h: %.3g to %.3g times the speed, turning through %.3g deg",
             t->n_rows, t->rows[0].time / 3600, t->rows[t->n_rows - 1].time / 3600, m->window / 3600, least + 0.0, most + 0.0,
             (right - left) * 180 / 3.14159265358979323846);
    return true;
}

static bool is_constant(const fw_tide *t)
{
    for (size_t i = 0; i < t->n_rows; i++)
        if (t->rows[i].factor != 1 || t->rows[i].turn != 0) return false;
    return t->n_rows > 0;
}

/* Largest current of a course over the scenario's speed. */
static double largest_factor(const fw_tide *t)
{
    double most = 0;
    for (size_t i = 0; i < t->n_rows; i++) most = fmax(most, fabs(t->rows[i].factor));
    return most;
}

/* Choices of a course that make no current, or none that the window sees change. */
static const char *refuse_course(const fw_model *m, const fw_scene_facts *f)
{
    const fw_tide *t = &m->tide;
    double         most = largest_factor(t);
    if (is_constant(t)) return "factor 1 and turn 0 in every row: the current would not change";
    if (!(most > 0)) return "factor 0 in every row: there would be no current";
    if (t->n_rows && t->rows[0].time >= m->window) return "its first row lies behind the window's end: the current would not change; is time in the unit that was meant?";
    if (isfinite(f->speed.high) && most * f->speed.high > FASTEST) return "factor times current.speed reaches above 20 m/s, wanted at most that";
    return NULL;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "current.course";
    if (fw_effects_given(f, FW_GIVEN_TIDE) && fw_effects_given(f, FW_GIVEN_COURSE)) return "current.tide says already how the current changes, wanted one of them";
    if (!fw_effects_have(m, FW_EFFECT_TIDE)) return NULL;
    const char *why = fw_effects_given(f, FW_GIVEN_COURSE) ? refuse_course(m, f) : NULL;
    if (why) return why;
    *key = "effects";
    if (!is_given(f)) return "tide cannot be on: there is neither current.tide nor current.course";
    *key = "current.speed";
    if (!(f->speed.high > 0)) return "tide cannot be on: there is no current that could change";
    return NULL;
}

const fw_effect fw_effect_tide = {
    .name = "tide",
    .bit = FW_EFFECT_TIDE,
    .does = "the current changes its speed and direction within a window, and ice comes in from other sides",
    .equation = "u(t) = U (cos phi, r sin phi), phi = phase + 2 pi (t - middle of the window) / period; or a table of speed over U and turn",
    .source = "a tidal ellipse of one constituent, M2: 12.42 h (Pugh, Tides, Surges and Mean Sea-Level)",
    .range = "the same current everywhere at an instant; minor over major axis -1 to 1, negative turns clockwise",
    .limit = "a period much longer than the window: the steady current; a tide to and fro through a whole period: no way made",
    .needed = "needed where current.tide or current.course is given",
    .off = "the current is the tide's largest throughout",
    .is_needed = is_needed,
    .refuse = refuse,
};
