/* The kernel: moves the awake floes of a world through time.
 *
 *   untouched ice      drifts in its blocks, costs nothing, wakes when it is touched
 *   a floe in no contact  flies by the closed form of its drag until somebody touches it
 *   a cluster          floes joined by contacts: ESDIRK steps with error control, at its own pace
 *   a lone floe on the structure  is such a cluster, stepped by closed forms (lone.h)
 *   a floe on a structure that crushes it  is stepped as the others, with a memory of its rim (crush.h)
 *   a touch            is located, because the force jumps there by c d': a step across the jump is first order
 *
 * Events are worked in the order of time (kernel.c); a cluster's step is tried ahead and cut when somebody comes in.
 *
 * What is fixed during a run is fw_setup, what changes is fw_world and fw_wear. */
#ifndef FW_KERNEL_KERNEL_H
#define FW_KERNEL_KERNEL_H

#include "abrasion/wear.h"
#include "floewear/scenario.h"
#include "floewear/status.h"
#include "kernel/method.h"
#include "world/world.h"

/* What carries the floes from outside [m/s]. It changes between two steps only: fw_kernel_turn. */
typedef struct fw_flow {
    double ux, uy;         /* water, far from the structure */
    double ice_x, ice_y;   /* ice that nothing has touched */
    double wind_x, wind_y; /* air */
} fw_flow;

typedef struct fw_setup {
    double           structure_radius; /* [m] */
    fw_flow          flow;
    fw_contact_law   contact, floe_contact; /* with the structure; between floes */
    bool             has_floe_contact, has_drag, has_rotation;
    bool             has_body_forces; /* any of the next three */
    bool             has_wind, has_deflection, has_spin_drag, has_added_mass;
    double           ice_density, water_density; /* [kg/m3] of woken floes and what they swim in */
    double           drag_per_area; /* 1/2 rho_w Cf [kg/m3]: times D h gives fw_body.drag; 0 without drag */
    double           skin_drag;     /* Cs [-] on the face; 0 without */
    fw_wind          wind;          /* coefficients; with has_wind */
    double           wake_radius, wake_upstream; /* ice nearer to the structure's centre, or to its line within this way upstream, is awake [m]; 0: when touched */
    bool             is_crush;         /* floe on structure: crush.h instead of the spring */
    bool             is_from_pressure; /* k of springs from the pressure that crushes */
    fw_crush         crush;            /* unloading resolved; for either */
    double           crush_speed;      /* that k is as deep at [m/s] */
    double           crush_share;      /* of the tolerances of velocity and wear below: for a floe on a structure that crushes it */
    /* numerics */
    bool             is_lone_exact; /* a lone floe on the structure by closed forms (lone.h) instead of the method */
    const fw_method *method;
    double           tolerance;      /* local error of velocity per sub-step over velocity_scale */
    double           wear_tolerance; /* error of a step's wear over the wear of its touch so far */
    double           energy_tolerance; /* a step's imbalance of energy over what its cluster has dissipated: beyond, it is repeated finer */
    double           velocity_scale; /* [m/s] */
    double           first_step;     /* after a touch, in 1/w */
    double           growth;         /* largest factor from one sub-step to the next */
    double max_step;        /* longest step, as way of the current [m]: errors of velocity add up to errors of place */
    double solver_share;    /* of the tolerance: what the sweeps of a stage may leave */
    double landing;         /* a touch is located to this share of closing rate / w [m] */
    double horizon;         /* way of the current between two listings of who may touch whom [m] */
    double margin;          /* a floe in contact is listed anew when it is this far off its line [m] */
    double skin;            /* of the plain method: neighbours are listed up to this gap [m] */
    double half_width;      /* of the strip: untouched floes outside are not there; INFINITY: all */
    double downstream;      /* floes past this way behind the structure, along the ice's way, are forgotten [m]; INFINITY: none */
    double max_evaluations; /* force evaluations allowed; INFINITY: no limit */
    /* Called between events, every few milliseconds of work; another status than FW_OK ends the step with it. NULL: nobody waits. */
    fw_status (*attend)(void *self);
    void *attend_self;
} fw_setup;

/* Is an effect on? A program built with FW_OPTIONAL_EFFECTS = 0 has none of these, and no code for them: to be measured against
 * (tests/valgrind/test_nothing.py). */
#ifndef FW_OPTIONAL_EFFECTS
#define FW_OPTIONAL_EFFECTS 1
#endif
static inline bool fw_has_body_forces(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->has_body_forces; }
static inline bool fw_has_wind(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->has_wind; }
static inline bool fw_has_deflection(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->has_deflection; }
static inline bool fw_has_spin_drag(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->has_spin_drag; }
static inline bool fw_is_crush(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->is_crush; }
static inline bool fw_is_from_pressure(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->is_from_pressure; }
static inline bool fw_has_added_mass(const fw_setup *s) { return FW_OPTIONAL_EFFECTS && s->has_added_mass; }

typedef struct fw_kernel fw_kernel;

fw_status fw_kernel_create(fw_kernel **out, const fw_setup *setup, fw_msg *m);
void      fw_kernel_destroy(fw_kernel *k);

/* To the next listing, at most to t_end; there (and only there) all floes stand at the same instant, w->t. t_end is where the caller
 * wants them to: no step passes it. The caller has put enough untouched ice into the world: up to
 * fw_kernel_needs_ice. Errors: FW_E_NUMERIC (non-finite state, floe inside the structure, step
 * limit) naming floe and time; FW_E_LIMIT; FW_E_NOMEM. */
fw_status fw_kernel_step(fw_kernel *k, fw_world *w, fw_wear *wear, double t_end, fw_msg *m);
/* The flow is another from w->t on, where the last step ended at its t_end. */
void      fw_kernel_turn(fw_kernel *k, fw_world *w, const fw_flow *flow);
/* The instant that the kernel has come to, also within a step that failed. */
double    fw_kernel_now(const fw_kernel *k, const fw_world *w);
/* Untouched ice that the next step wants in the world (kernel frame [m]). */
typedef struct fw_box {
    double x0, x1, y0, y1;
} fw_box;
fw_box    fw_kernel_needs_ice(const fw_kernel *k, const fw_world *w);
/* Velocity of a floe that nothing has touched: of the water far from the structure, and through it where the air's drag and the water's balance. */
void      fw_kernel_free_drift(const fw_setup *s, const fw_body *b, double *vx, double *vy);

/* An ice floe: the mass that its velocity moves [kg], added mass included, and a body at rest in the origin with all that follows from its
 * size. */
double  fw_kernel_floe_mass(const fw_setup *s, double radius, double thickness);
fw_body fw_kernel_floe(const fw_setup *s, double radius, double thickness);

#endif
