/* floewear/scenario.h: everything one realisation depends on, as plain data in SI units and radians.
 *
 * fw_model     what is fixed for a whole campaign: structure, ice, contact, water, effects, window, accuracy
 * fw_scenario  what changes from realisation to realisation: seed, id, concentration, speed, thickness mix
 * fw_site      where scenarios come from: the laws of speed, concentration, direction, temperature, mixes
 *
 * Temperature and current direction never enter a simulation: temperature only multiplies the wear and a disc looks the
 * same from every side, so both are integrated exactly after the run (study). */
#ifndef FLOEWEAR_SCENARIO_H
#define FLOEWEAR_SCENARIO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "floewear/distribution.h"
#include "floewear/status.h"

enum { FW_MAX_CLASSES = 16, FW_MAX_MIXES = 16, FW_MAX_LAWS = 4 };

/* Effects that a scene may switch; one bit each. The table of names, reasons and rules is src/effects/effects.h. */
typedef enum fw_effect_bit {
    FW_EFFECT_FLOE_CONTACT = 1u << 0,
    FW_EFFECT_FRICTION = 1u << 1,
    FW_EFFECT_ROTATION = 1u << 2,
    FW_EFFECT_FORM_DRAG = 1u << 3,
    FW_EFFECT_SKIN_DRAG = 1u << 4,      /* of the water on the lower face: force and spin torque */
    FW_EFFECT_WIND = 1u << 5,
    FW_EFFECT_ADDED_MASS = 1u << 6,
    FW_EFFECT_TIDE = 1u << 7,           /* a current that changes within the window */
    FW_EFFECT_DEFLECTED_FLOW = 1u << 8, /* round the structure */
    FW_EFFECT_CRUSHING_LIMIT = 1u << 9, /* on the pressure that wears; acts in abrasion alone */
    FW_EFFECT_ICE_ON_ICE = 1u << 10,    /* stiffness and friction of their own between floes */
    FW_EFFECT_CRUSH_CONTACT = 1u << 11  /* contact.law: crush instead of the spring */
} fw_effect_bit;
enum { FW_EFFECTS_CORE = 0xf };

/* Keys that somebody wrote, as far as `effects: auto` and its refusals look at them: a default calls for nothing and contradicts nothing. */
typedef enum fw_given_bit {
    FW_GIVEN_LAW_SPRING = 1u << 0, /* contact.law: spring */
    FW_GIVEN_LAW_CRUSH = 1u << 1,  /* contact.law: crush */
    FW_GIVEN_PRESSURE = 1u << 2,   /* contact.pressure */
    FW_GIVEN_FLAT = 1u << 3,
    FW_GIVEN_UNLOADING = 1u << 4,
    FW_GIVEN_FLOE_STIFFNESS = 1u << 5,
    FW_GIVEN_FLOE_FRICTION = 1u << 6,
    FW_GIVEN_SKIN_DRAG = 1u << 7,      /* water.skin_drag */
    FW_GIVEN_ADDED_MASS_ON = 1u << 8,  /* water.added_mass: on */
    FW_GIVEN_ADDED_MASS_OFF = 1u << 9, /* the same: off */
    FW_GIVEN_DEFLECTED_ON = 1u << 10,
    FW_GIVEN_DEFLECTED_OFF = 1u << 11,
    FW_GIVEN_WIND = 1u << 12,       /* any key of it */
    FW_GIVEN_WIND_SPEED = 1u << 13, /* the one that makes it blow */
    FW_GIVEN_TIDE = 1u << 14,
    FW_GIVEN_COURSE = 1u << 15,
    FW_GIVEN_CRUSHING_LIMIT = 1u << 16,
    FW_GIVEN_PRESSURE_EXPONENT = 1u << 17, /* contact.pressure_exponent */
    FW_GIVEN_EFFECTS = 1u << 30 /* effects: anything but auto */
} fw_given_bit;

typedef struct fw_thickness_class {
    double thickness; /* [m], 0.0855 .. 8.04 (4h <= sqrt(130h - 11), Lindseth 2013) */
    double share;     /* of the floes, or of the ice area when by_area; sums to 1 over the mix */
} fw_thickness_class;

typedef struct fw_thickness_mix {
    double             probability; /* of this mix; sums to 1 over the mixes */
    bool               by_area;
    size_t             n_classes;
    fw_thickness_class classes[FW_MAX_CLASSES]; /* ascending thickness */
} fw_thickness_mix;

typedef enum fw_size_law {
    FW_SIZE_UNIFORM,   /* D uniform in [4h, sqrt(130h - 11)] */
    FW_SIZE_POWER_LAW, /* density ~ D^-size_a there */
    FW_SIZE_LOGNORMAL  /* ln D normal (size_a [ln m], size_b), truncated there */
} fw_size_law;

typedef struct fw_abrasion_law {
    char   name[24];         /* "bekker2011", "archard", "power" */
    double coefficient;      /* a: rate = a (sigma / |T|)^exponent [mm/km], sigma in MPa, T in degC */
    double exponent;         /* m, 0 < m < 2; to 4 under a crushing limit whose exponent x m < 2 */
    bool   uses_temperature; /* false: rate = a sigma^exponent */
} fw_abrasion_law;

/* Factor that turns a law's wear load [MPa^m km] into depth [mm] at temperature T [degC]. */
double fw_abrasion_rate(const fw_abrasion_law *law, double temperature);

/* Densest ice that is made: the size laws of unbreakable floes pack to this without overlap, equal floes of the largest kind (32 m) nearly. */
#define FW_MAX_CONCENTRATION 0.8

/* Slowest current that is simulated [m/s]. A slower one is taken as this: wear goes with the cube of speed, and a window of 3 h moves the ice by
 * 11 m then. A campaign's law may lie below for a tenth of the time at most. */
#define FW_SLOWEST 1e-3

/* How a window is computed. Zeros stand for what a user gets: the event-driven kernel with the settings that
 * realisation/accuracy.c chooses for fw_model.accuracy. Everything else is there to measure that choice against. */
typedef enum fw_scheme {
    FW_SCHEME_EVENTS, /* touches located, each cluster of touching floes with steps of its own, error control */
    FW_SCHEME_EULER,  /* every floe, fixed step: semi-implicit Euler, the plain DEM */
    FW_SCHEME_VERLET, /* every floe, fixed step: velocity Verlet with explicit forces */
    FW_SCHEME_RK4     /* every floe, fixed step: the classical fourth-order method */
} fw_scheme;

typedef enum fw_wear_rule {
    FW_WEAR_HERMITE,  /* overlap as a cubic, force through the stages, nodes that know how a touch begins */
    FW_WEAR_SINGULAR, /* the same nodes, overlap, force and slip linear between the step's ends */
    FW_WEAR_NAIVE     /* the rate at the step's end times the step */
} fw_wear_rule;

typedef struct fw_numerics {
    fw_scheme    scheme;
    fw_wear_rule wear_rule;
    double       step;       /* of a fixed-step scheme [s] */
    int          order;      /* of the event-driven kernel's integrator, 2, 3 or 4; 0: chosen */
    double       tolerance;  /* local error of velocity over the current's speed [-]; 0: chosen */
    double       wear_tolerance; /* error of a step's wear over the wear of its touch so far [-]; 0: chosen */
    double       first_step; /* after a touch [1/w]; 0: chosen */
    double       growth;     /* largest factor from one step to the next; 0: chosen */
} fw_numerics;

/* Pressure of ice that crushes: p = pressure (A / 1 m2)^-exponent, A the nominal contact area b h. */
typedef struct fw_pressure_law {
    double pressure; /* at 1 m2 [Pa] */
    double exponent; /* 0: constant */
} fw_pressure_law;

/* Air over the floes: a skin on pi R^2 and a side of the freeboard (1 - rho_i / rho_w) h times D. */
typedef struct fw_wind {
    double density;   /* of the air [kg/m3] */
    double skin_drag; /* on pi R^2 [-] */
    double form_drag; /* on the freeboard's side [-] */
} fw_wind;

/* A current that changes within the window. n_rows = 0: an ellipse, u = speed (cos phi, minor_ratio sin phi), the scenario's speed being the
 * largest of the tide and +x its direction then; else a table, straight between its rows. */
enum { FW_MAX_COURSE = 512 };
typedef struct fw_course_row {
    double time;   /* since the window's start [s], ascending; the warm-up goes as the first row */
    double factor; /* of the scenario's speed [-] */
    double turn;   /* from +x, anticlockwise seen from above [rad] */
} fw_course_row;
typedef struct fw_tide {
    double         period;      /* [s] */
    double         minor_ratio; /* -1 .. 1; < 0 turns clockwise; 0: to and fro */
    double         phase;       /* of the window's middle [rad]; NAN: drawn, evenly over the period */
    size_t         n_rows;
    fw_course_row *rows;        /* (n_rows), owned by the model's campaign or scene */
} fw_tide;

typedef struct fw_crush {
    fw_pressure_law law;
    double          unloading; /* slope of the unloading line over force / deepest overlap [-]; <= 0: restitution e^-2 head-on */
    bool            has_flat;  /* the crushed flat carries a moment up to N b / 2 */
} fw_crush;

typedef struct fw_model {
    double   structure_radius;   /* [m] */
    double   ice_density;        /* [kg/m3] */
    double   water_density;      /* [kg/m3] */
    double   form_drag;          /* Cf on the side area D h [-] */
    double   stiffness;          /* k [N/m] */
    double   damping_ratio;      /* zeta [-]: c = zeta 2 sqrt(k m_eff) */
    double   friction;           /* mu [-] */
    double   slip_damping_ratio; /* ct = slip_damping_ratio c [-] */
    uint32_t effects;            /* fw_effect_bit set */
    double   effects_tolerance;  /* auto may drop an effect whose measured change of depth is below this [-]; 0: none is dropped */
    uint32_t given;              /* fw_given_bit set; looked at where effects are chosen, never in a simulation */

    /* What the further effects act with; each while its bit is set. */
    double          skin_drag;      /* Cs on the face pi R^2 [-] */
    double          floe_stiffness; /* k between floes [N/m] */
    double          floe_friction;  /* mu between floes [-] */
    fw_wind         wind;           /* speed and angle are the scenario's */
    fw_tide         tide;
    fw_pressure_law crushing_limit; /* on the pressure that wears; 0 <= exponent < 1 */
    fw_crush        crush;          /* contact law, and stiffness_from_pressure */
    bool            stiffness_from_pressure; /* k of every contact from crush.law, the floes and the current's speed instead of stiffness */

    size_t          n_laws;
    fw_abrasion_law laws[FW_MAX_LAWS]; /* the first one governs stop rule and default report */

    size_t           n_mixes;
    fw_thickness_mix mixes[FW_MAX_MIXES];
    fw_size_law      size_law;
    double           size_a, size_b;

    double window;      /* [s] */
    double warm_up;     /* [s]; < 0: chosen by the realisation ("auto") */
    double accuracy;    /* wanted relative discretisation error of a window's depth, 1e-4 .. 0.1 */
    size_t n_arcs;      /* of the ring, >= 72; default 360 */
    double strip_width; /* [m]; <= 0: auto (100 m) */
    double downstream;  /* floes are forgotten this far behind the structure [m]; <= 0: auto */
    double max_evaluations; /* force evaluations that one realisation may take; <= 0: auto, 100 times what is expected of it, 1e9 at least */
    fw_numerics numerics;
} fw_model;

typedef struct fw_scenario {
    uint64_t seed;          /* of the campaign */
    uint64_t id;            /* of the realisation, 0 .. */
    double   concentration; /* more than 0, at most FW_MAX_CONCENTRATION [-] */
    double   speed;         /* of the current [m/s], > 0 */
    uint32_t mix;           /* index into fw_model.mixes */
    uint32_t cell; /* index into fw_site.cells when the site has a joint table, else 0: names the direction law */
    double   wind_speed; /* [m/s]; 0 without wind */
    double   wind_angle; /* where the wind blows to, from +x, anticlockwise seen from above [rad] */
    double   tide_phase; /* of the window's middle [rad]; 0 without tide */
    double   weight;        /* in averages; 1 where the design draws scenarios as often as the site has them */
    int32_t  randomisation; /* of the design, from 0; < 0: drawn on its own */
} fw_scenario;

/* One cell of a joint site table: a value of (speed, concentration, thickness) with its share of time and the law of
 * direction inside it. */
typedef struct fw_site_cell {
    double          probability;
    double          speed, concentration;
    uint32_t        mix;       /* index into fw_model.mixes */
    fw_distribution direction; /* where the current flows TO, degrees clockwise from north */
} fw_site_cell;

typedef struct fw_site {
    fw_distribution speed;             /* [m/s] */
    fw_distribution concentration;     /* [-] */
    fw_distribution direction;         /* [deg], flows TO, clockwise from north; integrated, not sampled */
    fw_distribution temperature;       /* [degC], < 0; integrated, not sampled */
    double          temperature_floor; /* smallest |T| allowed [K], default 1.8 */
    fw_distribution wind_speed;        /* [m/s]; constant 0 without wind */
    fw_distribution wind_angle;        /* where it blows to, from the current's direction, clockwise from above [deg] */
    size_t          n_cells;           /* > 0: joint table; then speed, concentration, direction above are unused */
    fw_site_cell   *cells;             /* (n_cells), owned */
} fw_site;

/* The direction law that a scenario's window belongs to. */
static inline const fw_distribution *fw_site_direction(const fw_site *s, const fw_scenario *c)
{
    return s->n_cells ? &s->cells[c->cell].direction : &s->direction;
}

void      fw_model_defaults(fw_model *m); /* the source paper's Raahe example */
fw_status fw_model_check(const fw_model *m, fw_msg *msg);
/* What of this model the fixed-step methods do not have, in words; NULL: they have all of it. */
const char *fw_model_beyond_fixed_steps(const fw_model *m);
void      fw_site_free(fw_site *s);

#endif
