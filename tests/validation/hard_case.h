/* One hard scene and its runs: as it is, at a tenth of the accuracy, mirrored, turned and so on. A run is made when a law first asks for it. */
#ifndef TESTS_HARD_CASE_H
#define TESTS_HARD_CASE_H

#include "validation/hard_scenes.h"

typedef enum hard_which {
    HARD_BASE,
    HARD_FINE,     /* a tenth of the accuracy */
    HARD_MIRROR,   /* y -> -y */
    HARD_QUARTER,  /* turned by 90 degrees anticlockwise */
    HARD_TURNED,   /* by 37 */
    HARD_REVERSED, /* the last floe first */
    HARD_WATCHED,  /* saved at instants, which cuts steps; energy is looked at there */
    HARD_LIGHT,    /* densities and stiffness over 4: every force over 4, the same motion */
    HARD_SWIFT,    /* speeds times 2, stiffness times 4, half the time: every force times 4, the same ways */
    HARD_SHIFTED,  /* a tenth of the accuracy, floes shifted by a millimetre or so each */
    HARD_N_RUNS
} hard_which;

/* How a run's result follows from that of HARD_BASE. */
typedef struct hard_image {
    double flip;            /* of y and spin */
    int    degrees;         /* anticlockwise; whole arcs of a ring of 360 */
    double cosine, sine;    /* of them, as numbers: no library's last digit gets into the sheet */
    double velocity, force; /* factors */
    bool   is_reversed;
} hard_image;
extern const hard_image hard_images[HARD_N_RUNS];

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

#endif
