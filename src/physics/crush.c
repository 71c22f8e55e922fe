#include "physics/crush.h"

#include <math.h>

double fw_crush_pressure(const fw_pressure_law *p, double area)
{
    if (p->exponent == 0) return p->pressure;
    return p->pressure * pow(area > FW_CRUSH_LEAST_AREA ? area : FW_CRUSH_LEAST_AREA, -p->exponent);
}

double fw_crush_force(const fw_pressure_law *p, double area) { return area > 0 ? fw_crush_pressure(p, area) * area : 0; }

double fw_crush_unloading(const fw_pressure_law *p, double restitution)
{
    double e = 1.5 - 0.5 * p->exponent, undamped = restitution * exp(1);
    return e / (2 * undamped * undamped);
}

double fw_crush_depth(const fw_pressure_law *p, double m, double v, double reduced_radius, double h)
{
    /* F = P0 (g sqrt d)^(1-q), g = 2 sqrt(2 R*) h, but below the least area A0 = g sqrt d0, where q = 0 and the work is 2/3 of F d */
    double q = p->exponent, e = 1.5 - 0.5 * q, g = 2 * sqrt(2 * reduced_radius) * h, E = 0.5 * m * v * v;
    double d0 = q == 0 ? 0 : FW_CRUSH_LEAST_AREA / g * (FW_CRUSH_LEAST_AREA / g), F0 = fw_crush_force(p, g * sqrt(d0)), W0 = 2.0 / 3 * F0 * d0;
    if (E < W0) return d0 * pow(E / W0, 2.0 / 3);
    return pow((E - W0) * e / (p->pressure * pow(g, 1 - q)) + pow(d0, e), 1 / e);
}

double fw_crush_chord(double reduced_radius, double depth) { return 2 * sqrt(2 * reduced_radius * depth); }

double fw_crush_stiffness(const fw_pressure_law *p, double m_eff, double v, double reduced_radius, double h)
{
    double D = fw_crush_depth(p, m_eff, v, reduced_radius, h);
    return m_eff * v * v / (exp(2) * D * D);
}
