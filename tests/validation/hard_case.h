/* One hard scene and its runs: as it is, at a tenth of the accuracy, mirrored, turned. A run is made when a law first asks for it. */
#ifndef TESTS_HARD_CASE_H
#define TESTS_HARD_CASE_H

#include "validation/hard_scenes.h"

/* QUARTER, TURNED: by 90 and 37 degrees anticlockwise. WATCHED: with energy sampled, which cuts steps. */
typedef enum hard_which { HARD_BASE, HARD_FINE, HARD_MIRROR, HARD_QUARTER, HARD_TURNED, HARD_WATCHED, HARD_N_RUNS } hard_which;

typedef struct hard_run {
    bool      is_made;
    fw_status status;
    char      cause[200];
    fw_record record;
    double    depth, path; /* depth x wall [mm m]; of a window the mean load of the ring [MPa^m km] */
    double    max_overlap; /* [m] */
    size_t    n;
    fw_floe  *start, *end; /* (n); NULL of a window */
    double    energy[2], highest; /* kinetic and stored [J] at start and end; the most that was seen between */
} hard_run;

typedef struct hard_case {
    const hard_scene *scene;
    fw_model          model; /* with the scene's changes */
    double            accuracy, fastest; /* [-]; largest speed at the start, and the current's [m/s] */
    double            cpu_s; /* of all its runs */
    hard_run          runs[HARD_N_RUNS];
} hard_case;

void            hard_case_open(hard_case *c, const hard_scene *s);
void            hard_case_close(hard_case *c);
const hard_run *hard_case_run(hard_case *c, hard_which which);

static inline bool hard_is_window(const hard_scene *s) { return s->concentration > 0; }
double             hard_mass(const hard_case *c, const fw_floe *f); /* [kg] */
/* Kinetic and stored in overlaps [J]. */
double hard_energy(const hard_case *c, size_t n, const fw_floe *floes);
/* Anticlockwise turn of a run against HARD_BASE in degrees, whole arcs of a ring of 360. */
int hard_degrees(hard_which which);

#endif
