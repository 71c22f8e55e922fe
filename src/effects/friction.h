/* Viscous Coulomb friction; the force itself is a part of physics/contact.h. */
#ifndef FW_EFFECTS_FRICTION_H
#define FW_EFFECTS_FRICTION_H

#include "effects/effects.h"

/* The larger of the coefficients on the structure and between floes. */
double fw_friction_largest(const fw_model *m, const fw_scene_facts *f);
/* Has the flat of ice that crushes a moment? It is viscous below its cap, cr = ct R^2, as friction is. */
bool fw_friction_flat_turns(const fw_model *m);

#endif
