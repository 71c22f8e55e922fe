/* The lens that two overlapping discs share. */
#ifndef FW_GEOMETRY_LENS_H
#define FW_GEOMETRY_LENS_H

/* Chord [m] of the lens of discs with radii r1, r2 whose rims overlap by depth [m]; 0 when depth <= 0, and the smaller
 * diameter once the chord would pass through a centre that lies inside the other disc. Exact for two circles. */
double fw_lens_chord(double depth, double r1, double r2);

/* The same for four overlaps at once: one vector operation where the machine has it, the same bits. */
void fw_lens_chords(const double depth[4], double r1, double r2, double chord[4]);

#endif
