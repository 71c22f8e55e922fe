/* The embedded reference solutions: single floes against the structure, solved to 1e-10 by an independent adaptive code with
 * located events; the same rows as tests/reference/single_floe.csv (its README names units and parameters). They are what the
 * study's finest level is itself checked against, in the same command, on the machine that runs it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "floewear/realisation.h"
#include "study/accuracy.h"

typedef struct hit {
    const char *name;
    double      diameter, thickness, offset; /* [m] */
    double      release;                     /* [s] after the touch; 0: pinned, INFINITY: misses */
    double      impulse, path, depth;        /* [N s], [m], [mm] along the contact at -10 degC */
} hit;

static const hit HITS[] = {
    {"case 1, offset 0.5 m", 2.5, 0.5, 0.5, 7.545822819225896, 140651.63638572115, 0.02446326772837026,
     4.934193746986562e-08},
    {"case 1, offset 2 m", 2.5, 0.5, 2.0, 3.6889563176911313, 47068.07619967379, 0.04531629254766263,
     2.387048037637167e-07},
    {"case 1, offset 4 m", 2.5, 0.5, 4.0, 1.2570676889813082, 7106.401062501034, 1.3549333991056214,
     8.165701766174243e-07},
    {"case 1, offset 5 m", 2.5, 0.5, 5.0, INFINITY, 0, 0, 0},
    {"case 2, offset 1 m", 5.0, 0.5, 1.0, 8.087780309896296, 287781.04092517414, 0.05934498117332719,
     1.7208285114030173e-07},
    {"case 2, offset 3 m", 5.0, 0.5, 3.0, 4.004929523798968, 97031.15251102486, 0.19153766111867288,
     7.321553761161649e-07},
    {"case 3, offset 2 m", 5.0, 1.0, 2.0, 5.603012510708467, 329483.4376975102, 0.08796706203296656,
     3.1737288601856837e-07},
    {"case 4, offset 0 m", 10.0, 1.0, 0.0, 0, 12429131.766365224, 0, 0},
    {"case 4, offset 4 m", 10.0, 1.0, 4.0, 6.112571995554791, 635532.3403810208, 0.39110850135182407,
     1.2917889210478199e-06},
};

static double deviation(double got, double wanted)
{
    if (wanted > 0) return fabs(got / wanted - 1);
    return got > 1e-12 ? INFINITY : 0; /* a floe that misses leaves nothing; a pinned one does not slide */
}

fw_status fw_accuracy_hits(double accuracy, const fw_numerics *numerics, double *worst, char *name, size_t size,
                           fw_msg *m)
{
    *worst = 0;
    if (name) snprintf(name, size, "%s", HITS[0].name);
    for (size_t i = 0; i < sizeof HITS / sizeof HITS[0]; i++) {
        const hit      *h = &HITS[i];
        double          reach = 3.7 + 0.5 * h->diameter, gap = 0.3;
        bool            is_miss = isinf(h->release), is_pinned = h->release == 0;
        double          x = is_miss ? -8 : -(sqrt(reach * reach - h->offset * h->offset) + gap);
        fw_floe         floe = {.x = x, .y = h->offset, .diameter = h->diameter, .thickness = h->thickness, .vx = 2};
        fw_scene        scene = {.speed = 2, .temperature = -10, .n_floes = 1, .floes = &floe};
        fw_scene_result r;
        scene.duration = 0.5 * gap + (is_miss ? 10 : is_pinned ? 60 : h->release + 1);
        fw_model_defaults(&scene.model);
        scene.model.accuracy = accuracy;
        if (numerics) scene.model.numerics = *numerics;
        FW_TRY(fw_scene_run(&scene, NULL, NULL, &r, m));
        double off = fmax(deviation(r.depth_along_contact, h->depth), deviation(r.record.normal_impulse, h->impulse));
        if (off > *worst) {
            *worst = off;
            if (name) snprintf(name, size, "%s", h->name);
        }
        fw_scene_result_free(&r);
    }
    return FW_OK;
}
