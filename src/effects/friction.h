/* Viscous Coulomb friction; the force itself is a part of physics/contact.h. */
#ifndef FW_EFFECTS_FRICTION_H
#define FW_EFFECTS_FRICTION_H

#include "effects/effects.h"

/* The larger of the coefficients on the structure and between floes. */
double fw_friction_largest(const fw_model *m, const fw_scene_facts *f);

#endif
