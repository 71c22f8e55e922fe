#include "effects/added_mass.h"

#include <math.h>

double fw_added_mass_share(double radius, double draft)
{
    double eps = draft / radius, e2 = 1 - eps * eps, b0;
    if (e2 < 1e-4) { /* near the sphere, or thicker than wide: the closed form is 0/0; b0 = 2/3 (1 - e2/10 (...)) to first order */
        b0 = 2.0 / 3 * (1 - 0.2 * e2);
    } else {
        double e = sqrt(e2);
        b0 = eps * asin(e) / (e2 * e) - eps * eps / e2;
    }
    return b0 / (2 - b0);
}
