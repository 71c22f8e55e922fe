#include "physics/drag.h"

#include <math.h>

double fw_drag_coefficient(double water_density, double form_drag, double diameter, double thickness)
{
    return 0.5 * water_density * form_drag * diameter * thickness;
}

fw_drag_flow fw_drag_free(double K, double r0, double t)
{
    double       a = K * r0 * t;
    fw_drag_flow f;
    f.speed = r0 / (1 + a);
    /* log1p(a)/K loses its digits as a -> 0 only through the division by K; the series is exact to 1e-17 there. */
    f.distance = a < 1e-5 ? r0 * t * (1 - a * (0.5 - a * (1.0 / 3 - a * 0.25))) : log1p(a) / K;
    return f;
}
