/* Floes push each other: spring, dashpot and friction between two floes. */
#ifndef FW_EFFECTS_FLOE_CONTACT_H
#define FW_EFFECTS_FLOE_CONTACT_H

#include "effects/effects.h"

/* Floes that one on the structure is expected to meet: those whose centres lie within mean_diameter of its line while the ice drifts past by
 * 2 Rs + mean_diameter, in a field of this concentration; mean_area is E[pi D^2 / 4] of its floes. */
double fw_floe_contact_encounters(double concentration, double structure_radius, double mean_diameter, double mean_area);

bool fw_floe_contact_can_matter(const fw_scene_facts *f);

#endif
