#include "effects/skin_drag.h"

double fw_skin_drag_coefficient(double water_density, double skin_drag, double radius)
{
    return 0.5 * water_density * skin_drag * 3.14159265358979323846 * radius * radius;
}
