#include <math.h>
#include <stdio.h>

#include "effects/rows.h"

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
                 t->period / 3600, t->minor_ratio);
        return true;
    }
    double least = INFINITY, most = -INFINITY, left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < t->n_rows; i++) {
        least = fmin(least, t->rows[i].factor), most = fmax(most, t->rows[i].factor);
        left = fmin(left, t->rows[i].turn), right = fmax(right, t->rows[i].turn);
    }
    snprintf(reason, FW_REASON_SIZE, "current.course of %zu rows: %.3g to %.3g times the speed, turning through %.3g deg", t->n_rows, least, most,
             (right - left) * 180 / 3.14159265358979323846);
    return true;
}

static bool is_constant(const fw_tide *t)
{
    for (size_t i = 0; i < t->n_rows; i++)
        if (t->rows[i].factor != 1 || t->rows[i].turn != 0) return false;
    return t->n_rows > 0;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "current.course";
    if (fw_effects_given(f, FW_GIVEN_TIDE) && fw_effects_given(f, FW_GIVEN_COURSE)) return "current.tide says already how the current changes, wanted one of them";
    if (!fw_effects_have(m, FW_EFFECT_TIDE)) return NULL;
    if (fw_effects_given(f, FW_GIVEN_COURSE) && is_constant(&m->tide)) return "factor 1 and turn 0 in every row: the current would not change";
    *key = "effects";
    if (!is_given(f)) return "tide is switched on, but there is neither current.tide nor current.course";
    *key = "current.speed";
    if (!(f->speed.high > 0)) return "tide is switched on, but there is no current that could change";
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
