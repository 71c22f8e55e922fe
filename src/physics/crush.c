#include "physics/crush.h"

#include <math.h>

/* Power of the area; q = 0, the usual case, exactly and without a power. */
static double of_area(double area, double power) { return power == 1 ? area : area > 0 ? pow(area, power) : 0; }

double fw_crush_force(const fw_pressure_law *p, double area) { return p->pressure * of_area(area, 1 - p->exponent); }

double fw_crush_pressure(const fw_pressure_law *p, double area)
{
    return p->exponent == 0 ? p->pressure : p->pressure * pow(area, -p->exponent);
}

double fw_crush_unloading(const fw_pressure_law *p, double restitution)
{
    double e = 1.5 - 0.5 * p->exponent, undamped = restitution * exp(1);
    return e / (2 * undamped * undamped);
}

double fw_crush_depth(const fw_pressure_law *p, double m, double v, double reduced_radius, double h)
{
    /* F = P0 (2 sqrt(2 R*) h)^(1-q) D^(e-1) */
    double e = 1.5 - 0.5 * p->exponent, per_depth = fw_crush_force(p, 2 * sqrt(2 * reduced_radius) * h);
    return pow(0.5 * m * v * v * e / per_depth, 1 / e);
}

double fw_crush_chord(double reduced_radius, double depth) { return 2 * sqrt(2 * reduced_radius * depth); }

double fw_crush_stiffness(const fw_pressure_law *p, double m_eff, double v, double reduced_radius, double h)
{
    double D = fw_crush_depth(p, m_eff, v, reduced_radius, h);
    return m_eff * v * v / (exp(2) * D * D);
}
