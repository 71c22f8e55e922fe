/* What the outlook's files share: windows made up from a pilot. */
#ifndef FW_STUDY_OUTLOOK_INSIDE_H
#define FW_STUDY_OUTLOOK_INSIDE_H

#include "study/depth.h"
#include "study/outlook.h"

enum { FW_OUTLOOK_SHAPE = 3 };

/* Loads are exp(ln load by the emulator + scatter x normal) over the ring, times the ring's shape there: of each arc, ln(load / ring mean) is straight in
 * ln C and ln u (ice that presses leaves other floes in the middle than thin ice), with a scatter of its own. */
typedef struct fw_outlook_windows {
    const fw_campaign        *campaign;
    const fw_outlook_options *o;
    fw_sanity                *strip;
    fw_emulator               emulator;
    size_t                    n_arcs;
    double                   *shape;   /* (n_arcs x FW_OUTLOOK_SHAPE) ln(load / ring mean) = 1, ln C, ln u times these; owned */
    double                   *scatter; /* (n_arcs) about that; NAN: the arc never wore; owned */
    double                    evaluations; /* the pilot's over what the cost model expects of it */
} fw_outlook_windows;

fw_status fw_outlook_windows_make(fw_outlook_windows *out, const fw_campaign *c, size_t n, const fw_record *pilot, fw_sanity *strip,
                                  const fw_outlook_options *o, fw_msg *m);
void      fw_outlook_windows_free(fw_outlook_windows *w);
/* The ring of a scenario's window; r is initialised. Numbers from the stream (seed, FW_STREAM_OUTLOOK, id, part). */
void      fw_outlook_windows_draw(const fw_outlook_windows *w, const fw_scenario *s, uint64_t part, fw_record *r);
fw_status fw_outlook_windows_cost(const fw_outlook_windows *w, const fw_scenario *s, double *evaluations, fw_msg *m);

/* Neyman's allocation over strata, (n_strata) shares that sum to 1. bearing: of the governing point; depth: its design percentile [mm]. */
fw_status fw_outlook_allocate(const fw_outlook_windows *w, double bearing, double depth_mm, size_t n_strata, double *allocation, fw_msg *m);

#endif
