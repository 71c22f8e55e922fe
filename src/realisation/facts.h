/* What the rules of effects look at: the range of the scenes, before any of them is run. */
#ifndef FW_REALISATION_FACTS_H
#define FW_REALISATION_FACTS_H

#include "effects/effects.h"
#include "floewear/realisation.h"

/* Of a campaign's model and site. FW_E_ARG: a law of sizes that has no floes. */
fw_status fw_facts_campaign(const fw_model *model, const fw_site *site, fw_scene_facts *out, fw_msg *m);
void      fw_facts_scene(const fw_scene *scene, fw_scene_facts *out);

#endif
