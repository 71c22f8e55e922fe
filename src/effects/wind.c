#include "effects/wind.h"

#include <math.h>
#include <stdio.h>

#include "effects/rows.h"
#include "effects/skin_drag.h"

double fw_wind_drag(const fw_wind *w, double ice_density, double water_density, double radius, double thickness)
{
    double freeboard = fmax(0, (1 - ice_density / water_density) * thickness);
    return 0.5 * w->density * (w->skin_drag * 3.14159265358979323846 * radius * radius + w->form_drag * 2 * radius * freeboard);
}

double fw_wind_free_drift(double air, double water, double speed)
{
    double r = sqrt(air), s = sqrt(water);
    return r > 0 ? speed * r / (r + s) : 0;
}

/* Free drift over the wind's speed in still water, of a floe of radius 1 m: both drags go with R^2 at one aspect. */
static double drift_share(const fw_model *m, const fw_scene_facts *f, double aspect)
{
    char   reason[FW_REASON_SIZE];
    double water = 0.5 * m->water_density * m->form_drag * 2 * aspect;
    if (fw_effects_have(m, FW_EFFECT_SKIN_DRAG) || fw_effect_skin_drag.is_needed(m, f, reason))
        water += fw_skin_drag_coefficient(m->water_density, m->skin_drag, 1);
    return fw_wind_free_drift(fw_wind_drag(&m->wind, m->ice_density, m->water_density, 1, aspect), water, 1);
}

/* Ice that does not float has no freeboard. */
static bool acts(const fw_model *m) { return m->wind.skin_drag > 0 || (m->wind.form_drag > 0 && m->ice_density < m->water_density); }

/* "of 10 m/s", "of 2 to 20 m/s"; a law without an upper end: "of 2 m/s and more" */
static void say_speed(char text[64], const fw_range *r)
{
    if (isinf(r->high))
        snprintf(text, 64, "of %.3g m/s and more", r->low);
    else if (r->high > r->low)
        snprintf(text, 64, "of %.3g to %.3g m/s", r->low, r->high);
    else
        snprintf(text, 64, "of %.3g m/s", r->low);
}

static bool is_needed(const fw_model *m, const fw_scene_facts *f, char *reason)
{
    bool it_is = fw_effects_given(f, FW_GIVEN_WIND_SPEED) && f->wind_speed.high > 0 && acts(m);
    if (it_is) {
        double a = drift_share(m, f, f->aspect.low), b = drift_share(m, f, f->aspect.high);
        char   of[64];
        say_speed(of, &f->wind_speed);
        snprintf(reason, FW_REASON_SIZE, "wind %s: floes drift through the water by %.2g to %.2g %% of it", of, 100 * fmin(a, b), 100 * fmax(a, b));
    } else {
        snprintf(reason, FW_REASON_SIZE, "%s", fw_effects_given(f, FW_GIVEN_WIND_SPEED) ? "wind.speed = 0, or no drag of the air" : "no wind.speed");
    }
    return it_is;
}

static const char *refuse(const fw_model *m, const fw_scene_facts *f, const char **key)
{
    *key = "wind";
    if (fw_effects_given(f, FW_GIVEN_WIND) && !fw_effects_given(f, FW_GIVEN_WIND_SPEED)) return "there is no wind without wind.speed";
    if (!fw_effects_have(m, FW_EFFECT_WIND)) return NULL;
    *key = "effects";
    if (!fw_effects_given(f, FW_GIVEN_WIND_SPEED)) return "wind cannot be on: there is no wind.speed";
    *key = "wind.speed";
    if (!(f->wind_speed.high > 0)) return "wind cannot be on: its speed is 0";
    *key = "wind";
    if (!acts(m)) return "wind cannot be on: it drags nothing: skin drag 0, and form drag 0 or ice without a freeboard";
    if (f->n_floes == 0 && !fw_effects_have(m, FW_EFFECT_FORM_DRAG) && !fw_effects_have(m, FW_EFFECT_SKIN_DRAG))
        return "without any drag of the water a field of floes drifts at the wind's own speed";
    return NULL;
}

const fw_effect fw_effect_wind = {
    .name = "wind",
    .bit = FW_EFFECT_WIND,
    .does = "wind drags floes by their upper faces and freeboards; floes of different shape drift apart",
    .equation = "F = 1/2 rho_a (Cs pi R^2 + Cf D f) |W - v| (W - v), freeboard f = (1 - rho_i / rho_w) h",
    .source = "Leppaeranta, The Drift of Sea Ice (2011): rho_a = 1.3 kg/m3, Cs = 0.0018; Cf = 1.1 of a bluff side",
    .range = "one wind for a window; no waves, no gusts, no shelter behind other floes",
    .limit = "free drift through the water W r / (1 + r), r^2 the air's drag over the water's: 0.43 % of the wind (5 x 0.5 m, form drag 10), 2.0 % (skin drag alone)",
    .needed = "needed where wind.speed is given and more than 0",
    .off = "floes drift with the water",
    .is_needed = is_needed,
    .refuse = refuse,
};
