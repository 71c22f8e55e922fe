#include "geometry/lens.h"

#include <math.h>

double fw_lens_chord(double depth, double r1, double r2)
{
    if (!(depth > 0)) return 0;
    double small = fmin(r1, r2);
    /* Heron's formula on the triangle of the centres and a corner of the lens; each factor is free of cancellation for
     * the shallow lenses that matter: distance = r1 + r2 - depth. */
    double distance = r1 + r2 - depth;
    double p = depth * (2 * (r1 + r2) - depth) * (2 * r1 - depth) * (2 * r2 - depth);
    if (distance <= 0 || p <= 0) return 2 * small;
    double chord = sqrt(p) / distance;
    /* Deeper than the smaller disc's centre the chord shrinks again; the contact does not. */
    if (distance * distance < fabs(r1 * r1 - r2 * r2)) return 2 * small;
    return fmin(chord, 2 * small);
}
