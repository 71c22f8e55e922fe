/* floewear/realisation.h: run one realisation, or one scene of given floes. */
#ifndef FLOEWEAR_REALISATION_H
#define FLOEWEAR_REALISATION_H

#include "floewear/record.h"
#include "floewear/scenario.h"
#include "floewear/status.h"

/* Called every few milliseconds of work (a master answers its workers, a signal is seen). A status other than FW_OK ends
 * the run with that status; it is not a failure of the realisation and no record is kept. done is the share 0..1. */
typedef struct fw_tick {
    fw_status (*call)(void *self, double done);
    void *self;
} fw_tick;

/* A record is a pure function of (model, scenario). A realisation that fails gives FW_OK here and a record with its status
 * and cause; another return value means that there is no record (no memory, stopped by the tick).
 * tick may be NULL. out is initialised here; the caller frees it with fw_record_free. */
fw_status fw_realise(const fw_model *model, const fw_scenario *scenario, const fw_tick *tick, fw_record *out,
                     fw_msg *m);

/* One given floe: position of its centre in the kernel frame (structure at the origin, current along +x). */
typedef struct fw_floe {
    double x, y, diameter, thickness; /* [m] */
    double vx, vy;                    /* [m/s] */
    double spin;                      /* [rad/s], anticlockwise */
} fw_floe;

typedef struct fw_scene {
    fw_model model;
    double   speed;       /* current [m/s] along +x */
    double   temperature; /* [degC] */
    double   duration;    /* [s] */
    double   wind_speed, wind_angle; /* as in fw_scenario: [m/s], [rad] */
    double   tide_phase;  /* in the middle of the duration [rad] */
    size_t   n_floes;
    fw_floe *floes; /* (n_floes), owned */
} fw_scene;

/* One saved instant, for trajectories: t and the floes' states then. */
typedef struct fw_frame_sink {
    /* The first frame is at t = 0. Another one at t = 0 begins anew: the run is repeated with finer steps, what came before is void. */
    fw_status (*frame)(void *self, double t, size_t n_floes, const fw_floe *floes, fw_msg *m);
    void  *self;
    double interval; /* [s] of simulated time */
} fw_frame_sink;

typedef struct fw_scene_result {
    fw_record record;              /* rings and ledgers; loads temperature-free */
    double    path;                /* int |vt| dt over all structure contacts [m] */
    double    depth_along_contact; /* int rate |vt| dt, first law [mm] */
    double    depth_x_wall;        /* int rate |vt| b dt, first law [mm m] */
    double    depth_impact;        /* share of depth_along_contact within 2/w of a first touch [mm] */
    double    max_overlap;         /* [m] */
    size_t    n_floes;
    fw_floe  *floes; /* (n_floes) final states, owned */
} fw_scene_result;

/* The floes of a realisation at time t after its start, warm-up included, that move then or may within `duration`, as a scene of its own: to see
 * a failure without what went before. Temperature is left at 0. The caller frees it. */
fw_status fw_realise_excerpt(const fw_model *model, const fw_scenario *scenario, double t, double duration, const fw_tick *tick,
                             fw_scene *out, fw_msg *m);

fw_status fw_scene_run(const fw_scene *scene, const fw_tick *tick, const fw_frame_sink *frames, fw_scene_result *out,
                       fw_msg *m);
void      fw_scene_free(fw_scene *s);
void      fw_scene_result_free(fw_scene_result *r);

#endif
