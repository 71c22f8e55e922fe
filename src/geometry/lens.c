#include "geometry/lens.h"

#include <math.h>

/* Heron's formula on the triangle of the centres and a corner of the lens; each factor is free of cancellation for the
 * shallow lenses that matter: distance = r1 + r2 - depth. Deeper than the smaller disc's centre the chord shrinks again; the
 * contact does not. Selections instead of branches, so that four go at a time. */
static inline double chord_of(double depth, double r1, double r2)
{
    double widest = 2 * (r1 < r2 ? r1 : r2), distance = r1 + r2 - depth;
    double p = depth * (2 * (r1 + r2) - depth) * (2 * r1 - depth) * (2 * r2 - depth);
    double chord = sqrt(p > 0 ? p : 0) / distance;
    double past = fabs(r1 * r1 - r2 * r2) - distance * distance; /* > 0: a centre lies inside the other disc */
    chord = chord < widest ? chord : widest;
    chord = past > 0 ? widest : chord;
    chord = distance > 0 ? chord : widest;
    chord = p > 0 ? chord : widest;
    return depth > 0 ? chord : 0;
}

double fw_lens_chord(double depth, double r1, double r2) { return chord_of(depth, r1, r2); }

void fw_lens_chords(const double depth[4], double r1, double r2, double chord[4])
{
    for (int i = 0; i < 4; i++) chord[i] = chord_of(depth[i], r1, r2);
}
