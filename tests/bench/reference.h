/* The scenes of tests/reference with the numbers they must come to. */
#ifndef TESTS_BENCH_REFERENCE_H
#define TESTS_BENCH_REFERENCE_H

#include <stddef.h>

#include "floewear/realisation.h"

enum { REFERENCE_FLOES = 4, REFERENCE_SCENES = 32 };

typedef struct reference_scene {
    char    name[48];
    double  duration; /* [s] */
    double  depth;    /* along the contact [mm]; 0: the floes only meet each other */
    size_t  n_floes;
    fw_floe start[REFERENCE_FLOES];
    bool    has_end;
    fw_floe end[REFERENCE_FLOES]; /* x, y only, when has_end */
} reference_scene;

/* Scenes with a contact (misses and floes that stay pinned are left out), at most REFERENCE_SCENES; exits when the files cannot be read. */
size_t reference_read(reference_scene *scenes);

#endif
