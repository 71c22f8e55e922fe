#include "effects/wind.h"

#include <math.h>

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
