#include "physics/unbreakable.h"

#include <math.h>

double fw_unbreakable_max_diameter(double thickness)
{
    double d2 = 130 * thickness - 11;
    return d2 > 0 ? sqrt(d2) : 0;
}

double fw_unbreakable_min_diameter(double thickness) { return 4 * thickness; }

bool fw_unbreakable_class_exists(double thickness)
{
    return thickness >= FW_THICKNESS_MIN && thickness <= FW_THICKNESS_MAX;
}
