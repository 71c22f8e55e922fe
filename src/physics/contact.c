#include "physics/contact.h"

#include <math.h>

fw_contact_constants fw_contact_law_apply(const fw_contact_law *law, double m_eff)
{
    fw_contact_constants c;
    c.k = law->stiffness;
    c.c = law->damping_ratio * 2 * sqrt(law->stiffness * m_eff);
    c.ct = law->slip_damping_ratio * c.c;
    c.mu = law->friction;
    c.omega = sqrt(law->stiffness / m_eff);
    return c;
}

double fw_contact_critical_depth(double omega, double v, double t)
{
    /* Past wt = 2 the wall no longer holds: N = 0 and the floe moves out at the speed it has then, -v e^-2. */
    double t2 = 2 / omega;
    if (t <= t2) return v * t * exp(-omega * t);
    return v * exp(-2.0) * (t2 - (t - t2));
}

double fw_contact_critical_force(double m, double omega, double v, double t)
{
    return omega * t < 2 ? m * omega * v * exp(-omega * t) * (2 - omega * t) : 0;
}
