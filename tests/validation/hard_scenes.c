#include "validation/hard_laws.h"

#define FLOES(...) .floes = (const fw_floe[]){__VA_ARGS__}, .n = sizeof((const fw_floe[]){__VA_ARGS__}) / sizeof(fw_floe)
#define LAYOUT(name, ...) .layout = hard_##name, .p = {__VA_ARGS__}
#define CHANGE(...) .change = {__VA_ARGS__}
#define OFF(which) .change.off = FW_EFFECT_##which

/* x y D h vx vy spin. The paper's structure has 3.7 m, so a floe of 5 m touches at a reach of 6.2 m. */
#define FIVE(x, y, v) {x, y, 5, 0.5, v, 0, 0}
#define HIT FLOES(FIVE(-7, 2, 2)), .speed = 2, .duration = 12 /* one oblique hit and the way round */

#define SMALL_AND_SLOW FLOES({-6, 0.09, 1.2, 0.3, 0.3, 0, 0}), .speed = 0.3, .duration = 100

/* Coupled: runs that differ in the last digit stay together. The rest of the laws of given floes is hard_laws_of's. */
enum { COUPLED = DEPTH | WATCHING | ORDER, FREE = TURNED | NO_GAIN | KEPT | WATCHING | ORDER, HEAD_ON = ON_AXIS, BOUNCES = HEAD_ON | RESTITUTION | DEEPEST | NO_GAIN };

const hard_scene hard_scenes[] = {
    /* ---- head-on: closed forms ------------------------------------------------------------------------------------- */
    {"head-on, zeta 1", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, OFF(FORM_DRAG)},
    {"head-on, zeta 0", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = NONE, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 0.1", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 0.1, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 2", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 2, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 5", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 5, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, stiffness 1e9", BOUNCES | PEAK, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.stiffness = 1e9, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, held by the current", HEAD_ON | RESTS, FLOES(FIVE(-6.5, 0, 2)), .speed = 2, .duration = 60},
    {"head-on, held, zeta 0.1", HEAD_ON | RESTS, FLOES(FIVE(-6.5, 0, 2)), .speed = 2, .duration = 60, CHANGE(.damping = 0.1)},
    {"two floes head-on, zeta 1", BOUNCES | FREE, FLOES(FIVE(-50, 0, 1), FIVE(-44.9, 0, -1)), .duration = 3, OFF(FORM_DRAG)},
    {"two floes head-on, zeta 0", BOUNCES | FREE, FLOES(FIVE(-50, 0, 1), FIVE(-44.9, 0, -1)), .duration = 3, CHANGE(.damping = NONE, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes head-on, zeta 0.1", BOUNCES | FREE, FLOES(FIVE(-50, 0, 1), FIVE(-44.9, 0, -1)), .duration = 3, CHANGE(.damping = 0.1, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes head-on, zeta 2", BOUNCES | FREE, FLOES(FIVE(-50, 0, 1), FIVE(-44.9, 0, -1)), .duration = 3, CHANGE(.damping = 2, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes head-on, zeta 5", BOUNCES | FREE, FLOES(FIVE(-50, 0, 1), FIVE(-44.9, 0, -1)), .duration = 3, CHANGE(.damping = 5, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes at 5 m/s", BOUNCES | FREE, FLOES(FIVE(-50, 0, 5), FIVE(-44.5, 0, -5)), .duration = 3, OFF(FORM_DRAG)},
    {"two floes at 5 m/s, oblique", FREE, FLOES(FIVE(-50, 1.5, 5), FIVE(-44, 0, -5)), .duration = 3, OFF(FORM_DRAG)},
    {"two floes, spins +50 and -50", FREE, FLOES({-50, 1.5, 5, 0.5, 2, 0, 50}, {-44, 0, 5, 0.5, -2, 0, -50}), .duration = 5, OFF(FORM_DRAG)},
    {"two floes, both spins +50", FREE, FLOES({-50, 1.5, 5, 0.5, 2, 0, 50}, {-44, 0, 5, 0.5, -2, 0, 50}), .duration = 5, OFF(FORM_DRAG)},
    {"two floes, both spins +50, 2 cm/s", FREE, FLOES({-50, 1.5, 5, 0.5, 0.02, 0, 50}, {-44, 0, 5, 0.5, -0.02, 0, 50}), .duration = 500, OFF(FORM_DRAG)},
    {"huge floe hits a tiny one, 500 : 1", BOUNCES | FREE, FLOES({-60, 0, 12, 1.5, 2, 0, 0}, {-53.2, 0, 1.2, 0.3, 0, 0, 0}), .duration = 2, OFF(FORM_DRAG)},
    {"tiny floe hits a huge one, 1 : 500", BOUNCES | FREE, FLOES({-60, 0, 1.2, 0.3, 5, 0, 0}, {-53.2, 0, 12, 1.5, 0, 0, 0}), .duration = 2, OFF(FORM_DRAG)},
    {"free flight under drag", FLIGHT, FLOES({-100, 3, 5, 0.5, 5, -2, 1}, {-200, 0, 1.2, 0.3, -1, 3, -2}), .speed = 1, .duration = 20},

    /* ---- one floe on the structure, one thing at its end ---------------------------------------------------------- */
    {"one hit", COUPLED, HIT},
    {"one hit, still water, at any angle", COUPLED | TURNED | NO_GAIN, FLOES(FIVE(-7, 2, 2)), .duration = 12},
    {"stiffness 1e4", COUPLED, FLOES(FIVE(-7, 2, 0.4)), .speed = 0.4, .duration = 60, CHANGE(.stiffness = 1e4)},
    {"stiffness 1e5", COUPLED, HIT, CHANGE(.stiffness = 1e5)},
    {"stiffness 1e7", COUPLED, HIT, CHANGE(.stiffness = 1e7)},
    {"stiffness 1e8", COUPLED, HIT, CHANGE(.stiffness = 1e8)},
    {"stiffness 1e9", COUPLED, HIT, CHANGE(.stiffness = 1e9)},
    {"damping ratio 0", COUPLED, HIT, CHANGE(.damping = NONE)},
    {"damping ratio 0, friction 0", COUPLED | NO_SPIN, HIT, CHANGE(.damping = NONE, .friction = NONE)},
    {"damping ratio 0.1", COUPLED, HIT, CHANGE(.damping = 0.1)},
    {"damping ratio 0.3", COUPLED, HIT, CHANGE(.damping = 0.3)},
    {"damping ratio 2", COUPLED, HIT, CHANGE(.damping = 2)},
    {"damping ratio 5", COUPLED, HIT, CHANGE(.damping = 5)},
    {"friction 0", COUPLED | NO_SPIN, HIT, CHANGE(.friction = NONE)},
    {"friction 0.5", COUPLED, HIT, CHANGE(.friction = 0.5)},
    {"friction 1", COUPLED, HIT, CHANGE(.friction = 1)},
    {"friction effect off", COUPLED | NO_SPIN, HIT, OFF(FRICTION)},
    {"rotation off", COUPLED | NO_SPIN, HIT, OFF(ROTATION)},
    {"slip damping 0", COUPLED | NO_SPIN, HIT, CHANGE(.slip_damping = NONE)},
    {"slip damping 10", COUPLED, HIT, CHANGE(.slip_damping = 10)},
    {"slip damping 3, small and slow", COUPLED, SMALL_AND_SLOW, CHANGE(.slip_damping = 3, .friction = 0.5)},
    {"slip damping 30, small and slow", COUPLED, SMALL_AND_SLOW, CHANGE(.slip_damping = 30, .friction = 0.5)},
    {"slip damping 8, near the axis", COUPLED, FLOES(FIVE(-7, 0.3, 2)), .speed = 2, .duration = 25, CHANGE(.slip_damping = 8)},
    {"small floe on a wide structure", COUPLED, FLOES({-38.94608073598495, -6.9093852580384691, 0.72561841076586786, 0.10069298938074307, 0.82130890664736, 0.46270995890798405, 0.51686629939384532}), .speed = 0.53, .duration = 109, CHANGE(.radius = 22.4, .stiffness = 1.24e8, .friction = 0.013)},
    {"spin +50", COUPLED, FLOES({-7, 2, 5, 0.5, 2, 0, 50}), .speed = 2, .duration = 12},
    {"spin -50", COUPLED, FLOES({-7, 2, 5, 0.5, 2, 0, -50}), .speed = 2, .duration = 12},
    {"current of 1 mm/s", COUPLED, FLOES(FIVE(-6.3, 2, 1e-3)), .speed = 1e-3, .duration = 20000},
    {"current of 5 m/s", COUPLED, FLOES(FIVE(-8, 2, 5)), .speed = 5, .duration = 6},
    {"thin ice, 0.09 m", COUPLED, FLOES({-5, 1.5, 0.6, 0.09, 2, 0, 0}), .speed = 2, .duration = 10},
    {"thick ice, 3 m", COUPLED, FLOES({-13, 3, 15, 3, 2, 0, 0}), .speed = 2, .duration = 30},
    {"structure of 100 m", COUPLED, FLOES(FIVE(-51, 15, 2)), .speed = 2, .duration = 60, CHANGE(.radius = 50)},
    {"structure of 0.5 m", COUPLED, FLOES(FIVE(-4, 1, 2)), .speed = 2, .duration = 10, CHANGE(.radius = 0.25)},
    {"a micrometre off the axis", COUPLED, FLOES(FIVE(-7, 1e-6, 2)), .speed = 2, .duration = 30},
    {"grazing by 1 mm", COUPLED | TOUCHES, FLOES(FIVE(-3, 6.199, 2)), .speed = 2, .duration = 6},
    {"grazing by 10 micrometres", COUPLED | TOUCHES, FLOES(FIVE(-3, 6.19999, 2)), .speed = 2, .duration = 6},
    /* the search for touches sees a dip of some 3 micrometres; this one would be 1e-5 of a hit */
    {"grazing by 1 micrometre", COUPLED, FLOES(FIVE(-3, 6.199999, 2)), .speed = 2, .duration = 6},
    {"passing by 1 micrometre", UNTOUCHED, FLOES(FIVE(-3, 6.200001, 2)), .speed = 2, .duration = 6},

    /* ---- touching at the start -------------------------------------------------------------------------------------- */
    {"resting on it in still water", UNTOUCHED, FLOES(FIVE(-6.2, 0, 0)), .duration = 10},
    {"at rest on it in a current", HEAD_ON | RESTS, FLOES(FIVE(-6.2, 0, 0)), .speed = 2, .duration = 60},
    {"touching with closing speed", BOUNCES | PEAK, FLOES(FIVE(-6.2, 0, 2)), .duration = 3, OFF(FORM_DRAG)},
    {"touching, and leaving", UNTOUCHED, FLOES({-6.2, 0, 5, 0.5, -1, 0.5, 0}), .duration = 5, OFF(FORM_DRAG)},
    {"leaving against the current", COUPLED, FLOES({-4.96, 3.72, 5, 0.5, -0.5, 0, 0}), .speed = 1, .duration = 20},
    {"overlapping at the start", COUPLED, FLOES(FIVE(-5.7, 2, 1), FIVE(-10.5, 2, 1)), .speed = 1, .duration = 20, .without = PUNCTUAL},

    /* ---- two or three ------------------------------------------------------------------------------------------------ */
    {"two mirror images at once", COUPLED | SYMMETRIC, FLOES(FIVE(-7, 2.6, 2), FIVE(-7, -2.6, 2)), .speed = 2, .duration = 8},
    {"two on opposite sides", HEAD_ON | NO_GAIN, FLOES(FIVE(-6.5, 0, 2), FIVE(6.5, 0, -2)), .duration = 3, OFF(FORM_DRAG)},
    {"tiny between structure and huge, 1 : 500", COUPLED, FLOES({-4.4, 0.3, 1.2, 0.3, 0.5, 0, 0}, {-11.1, 0, 12, 1.5, 0.5, 0, 0}), .speed = 0.5, .duration = 60},
    {"the same at 2 m/s", COUPLED, FLOES({-4.4, 0.3, 1.2, 0.3, 2, 0, 0}, {-11.1, 0, 12, 1.5, 2, 0, 0}), .speed = 2, .duration = 15},
    {"tiny before huge in line, 1 : 500", HEAD_ON, FLOES({-4.4, 0, 1.2, 0.3, 0.2, 0, 0}, {-11.1, 0, 12, 1.5, 0.2, 0, 0}), .speed = 0.2, .duration = 60},
    {"wedged between structure and two large", COUPLED | SYMMETRIC, FLOES({-4.6, 0, 1.6, 0.4, 1, 0, 0}, {-9, 4.05, 8, 0.9, 1, 0, 0}, {-9, -4.05, 8, 0.9, 1, 0, 0}), .speed = 1, .duration = 12},
    {"the same, a hand off the middle", COUPLED, FLOES({-4.6, 0.1, 1.6, 0.4, 1, 0, 0}, {-9, 4.05, 8, 0.9, 1, 0, 0}, {-9, -4.05, 8, 0.9, 1, 0, 0}), .speed = 1, .duration = 12},
    {"small and fast between two large", FREE, FLOES({-60, 5.2, 8, 0.8, 0, -1, 0}, {-60, -5.2, 8, 0.8, 0, 1, 0}, {-66, 0.2, 1.2, 0.3, 5, 0, 0}), .duration = 6, OFF(FORM_DRAG)},
    {"squeezed out between two large", FREE, FLOES({-60, 4.7, 8, 0.8, 0, -1, 0}, {-60, -4.7, 8, 0.8, 0, 1, 0}, {-60.8, 0, 1.2, 0.3, 0, 0, 0}), .duration = 6, OFF(FORM_DRAG)},
    {"rotation off, three", COUPLED, FLOES(FIVE(-7, 2, 2), FIVE(-8, -3.2, 2), FIVE(-12, 0.5, 2)), .speed = 2, .duration = 10, OFF(ROTATION)},
    {"friction effect off, three", COUPLED | NO_SPIN, FLOES(FIVE(-7, 2, 2), FIVE(-8, -3.2, 2), FIVE(-12, 0.5, 2)), .speed = 2, .duration = 10, OFF(FRICTION)},
    {"floe contact off", COUPLED, FLOES(FIVE(-7, 2, 2), FIVE(-8, 1.5, 2)), .speed = 2, .duration = 12, OFF(FLOE_CONTACT)},

    /* ---- many ------------------------------------------------------------------------------------------------------------ */
    {"chain of ten in line", HEAD_ON | RESTS, LAYOUT(line, 10, 5, 0.5, -3.8, 0.05, 1), .speed = 1, .duration = 120},
    {"row of five on a wall of 1 km", COUPLED, LAYOUT(row_of, 5, 5, 0.5, 500, 0.02, 1), .speed = 1, .duration = 120, CHANGE(.radius = 500)},
    {"trapped in an arch", COUPLED | SYMMETRIC, FLOES({-5, 0, 2, 0.5, 1, 0, 0}, {-5.6, 3.6, 5, 0.7, 1, 0, 0}, {-5.6, -3.6, 5, 0.7, 1, 0, 0}, {-10.6, 2.6, 5, 0.7, 1, 0, 0}, {-10.6, -2.6, 5, 0.7, 1, 0, 0}), .speed = 1, .duration = 15},
    {"six small in a slow current, stiffness 6e8", MIRROR, FLOES({-4.87789, -5.0843, 0.725832, 0.104261, 0.136299, 0, 0}, {-3.60077, 2.52769, 0.84026, 0.195006, 0.136299, 0, 0}, {-4.7195, 3.36709, 0.380621, 0.09, 0.136299, 0, 0},
           {-9.29921, 4.92304, 1.17606, 0.243279, 0.136299, 0, 0}, {-9.44499, 0.823803, 0.510611, 0.122975, 0.136299, 0, 0}, {-3.16849, -3.07695, 0.433238, 0.09, 0.136299, 0, 0}),
     .speed = 0.136, .duration = 171, CHANGE(.stiffness = 6.2e8, .damping = 2.9, .slip_damping = 0.1)},
    {"twelve small at random", MIRROR, FLOES({-8.72779, -1.06632, 0.448896, 0.102375, 0.341574, -0.0307715, -0.442035}, {-9.69166, -1.62525, 0.705485, 0.0974244, 0.327996, -0.0481396, -0.105232}, {-12.0993,
           -3.02513, 0.630848, 0.133149, 0.228479, -0.00112225, 0.877351}, {-11.5008, 3.71788, 0.961635, 0.0955882, 0.308996, -0.0385658, -0.8937}, {-6.75675, 4.8747, 1.01202,
           0.232035, 0.252452, -0.134232, 0.802157}, {-10.126, 4.07994, 0.409285, 0.09, 0.101452, 0.161988, -0.708898}, {-6.11403, 5.76167, 0.50614, 0.114882, 0.0388045, -0.0940708,
           0.926135}, {-10.9328, 1.70556, 0.462987, 0.09, 0.269152, 0.107731, 0.33521}, {-10.7321, -1.85178, 0.979698, 0.09, 0.147773, -0.0901546, -0.317781}, {-0.372139, 5.81777,
           0.996457, 0.181902, 0.301696, 0.0791932, -0.973257}, {-6.18532, -4.50267, 0.579765, 0.114885, 0.216023, 0.13278, 0.829193}, {-12.0447, 5.92544, 0.651816, 0.096625,
           0.240816, -0.068772, 0.581254}),
     .speed = 0.174, .duration = 131, CHANGE(.stiffness = 9.6e5, .damping = 1.1, .friction = 0.94, .slip_damping = 3.3)},
    {"ten small on a slender structure", MIRROR, FLOES({-4.90718, 1.11784, 0.386357, 0.0962755, 0.0268444, 0, 0}, {-6.21113, 0.0787261, 0.418445, 0.09, 0.0268444, 0, 0}, {-1.37312, -1.90182, 0.593262, 0.142928, 0.0268444, 0,
           0}, {-2.71107, -0.753401, 0.881089, 0.138295, 0.0268444, 0, 0}, {-4.16018, -3.06776, 0.771781, 0.117624, 0.0268444, 0, 0}, {-0.704337, 1.93377, 0.581908, 0.09, 0.0268444,
           0, 0}, {-4.79721, 2.29377, 0.370431, 0.09, 0.0268444, 0, 0}, {-2.26017, -2.50491, 0.66812, 0.09, 0.0268444, 0, 0}, {-3.97141, -0.0499852, 0.756744, 0.09, 0.0268444, 0,
           0}, {-5.76107, -1.02303, 0.844429, 0.104818, 0.0268444, 0, 0}),
     .speed = 0.0268, .duration = 560, CHANGE(.radius = 0.604, .stiffness = 2.78e8, .damping = 0.72), .without = SIMILAR /* back within a second, which is the same visit: no ratio */},
    {"six large round one, pressed", FREE, LAYOUT(flower, 2, 6, 0.7, 2.2, 1, -60), .duration = 6, OFF(FORM_DRAG)},
    {"six equal round one, pressed", FREE, LAYOUT(flower, 5, 5, 0.7, 0.1, 1, -60), .duration = 6, OFF(FORM_DRAG)},
    {"ring of seven round it, pressed", NO_GAIN | RESTS, LAYOUT(ring, 7, 5, 0.5, 1, 3.7), .duration = 120},
    {"closed ring of seven, pressed", NO_GAIN | RESTS, LAYOUT(ring, 7, 5.65, 0.5, 1, 3.7), .duration = 120},
    {"raft of 19", COUPLED, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .speed = 1, .duration = 20},
    {"raft of 19, zeta 0.1", COUPLED, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .speed = 1, .duration = 20, CHANGE(.damping = 0.1)},
    {"raft of 19, friction 1", ROUGHLY | ORDER, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .speed = 1, .duration = 20, CHANGE(.friction = 1)},
    {"raft of 19, stiffness 1e9", TWICE | ORDER, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .speed = 1, .duration = 20, CHANGE(.stiffness = 1e9)},
    {"raft of 19, slip damping 10", COUPLED, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .speed = 1, .duration = 20, CHANGE(.slip_damping = 10)},
    {"raft of 19 in still water", COUPLED | NO_GAIN | RESTS, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1, 0.4), .duration = 300},
    {"raft of 19 on a wide structure", ROUGHLY | ORDER, LAYOUT(hexagon, 2, 5, 0.5, -50.1, 0.02, 1, 0.4), .speed = 1, .duration = 40, CHANGE(.radius = 50)},
    {"raft of 100", COUPLED, LAYOUT(square, 10, 10, 4, 0.6, 0.02, 1), .speed = 1, .duration = 20},
    {"mixed raft, masses 1 : 100", COUPLED, LAYOUT(mixed, 6, 6, 6, 0.1, 1, 1), .speed = 1, .duration = 20},
    {"mixed raft of 100", TWICE | ORDER, LAYOUT(mixed, 10, 10, 4, 0.02, 1, 2), .speed = 1, .duration = 20},
    {"crowd of 20 without drag", FREE, LAYOUT(crowd, 20, 4, 0.6, 0.3, 2, 1), .duration = 6, OFF(FORM_DRAG)},
    {"crowd of 20, elastic", NO_GAIN | KEPT, LAYOUT(crowd, 20, 4, 0.6, 0.3, 2, 1), .duration = 6, CHANGE(.damping = NONE, .friction = NONE, .off = FW_EFFECT_FORM_DRAG)},
    {"crowd of 20, zeta 0.1", NO_GAIN | KEPT, LAYOUT(crowd, 20, 4, 0.6, 0.3, 2, 1), .duration = 6, CHANGE(.damping = 0.1, .off = FW_EFFECT_FORM_DRAG)},
    {"crowd of 400, stiffness 1e8", NO_GAIN | KEPT, LAYOUT(crowd, 400, 4, 0.6, 0.3, 2, 3), .duration = 6, CHANGE(.stiffness = 1e8, .off = FW_EFFECT_FORM_DRAG)},

    /* ---- beyond the model: must refuse ------------------------------------------------------------------------------- */
    {"pushed through the structure", REFUSES, FLOES({-8, 0, 5, 3, 20, 0, 0}), .speed = 2, .duration = 10, CHANGE(.stiffness = 1e4)},
    {"two floes pushed through each other", REFUSES, FLOES({-60, 0.1, 5, 3, 20, 0, 0}, {-54, 0, 5, 3, -20, 0, 0}), .duration = 3, CHANGE(.stiffness = 1e4)},
    {"two floes in one place", REFUSES, FLOES(FIVE(-60, 0, 0), FIVE(-60, 0, 0)), .duration = 1},

    /* ---- windows of ice ------------------------------------------------------------------------------------------------ */
    {"window, 2 %, 1 h", DEPTH, .concentration = 0.02, .speed = 0.5, .duration = 3600},
    {"window, 40 %, 60 s", 0, .concentration = 0.4, .speed = 2, .duration = 60},
    {"window, 60 %, 60 s", 0, .concentration = 0.6, .speed = 2, .duration = 60},
    {"window, 75 %, 30 s", 0, .concentration = 0.75, .speed = 2, .duration = 30},
    {"window, 60 %, 60 s, zeta 0.1", 0, .concentration = 0.6, .speed = 2, .duration = 60, CHANGE(.damping = 0.1)},
    {"window, 60 %, 60 s, friction 1", 0, .concentration = 0.6, .speed = 2, .duration = 60, CHANGE(.friction = 1)},
    {"window, 60 %, 60 s, stiffness 1e8", 0, .concentration = 0.6, .speed = 2, .duration = 60, CHANGE(.stiffness = 1e8)},
    {"window, 60 %, 60 s, stiffness 1e5", 0, .concentration = 0.6, .speed = 1, .duration = 60, CHANGE(.stiffness = 1e5)},
    {"window, 40 %, 2 cm/s", 0, .concentration = 0.4, .speed = 0.02, .duration = 6000},
    {"window, 20 %, 5 mm/s", 0, .concentration = 0.2, .speed = 0.005, .duration = 24000},
    {"window, 42 %, 0.65 m structure", REFUSES, .concentration = 0.42, .speed = 2.89, .duration = 21, CHANGE(.radius = 0.324)},
    {"window, 2 %, 30 days", DEPTH, .concentration = 0.02, .speed = 0.1, .duration = 30 * 86400.0, .is_long = true},
    {"window, 75 %, 1 h", 0, .concentration = 0.75, .speed = 2, .duration = 3600, .is_long = true, .is_once = true},
    {"raft of 1000 on the structure", 0, LAYOUT(square, 40, 25, 4, 0.6, 0.02, 1), .speed = 1, .duration = 60, .is_long = true, .is_once = true},
    {"raft of 10 000 on the structure", 0, LAYOUT(square, 100, 100, 4, 0.6, 0.02, 1), .speed = 1, .duration = 60, .is_long = true, .is_once = true},
    {"10 000 floes at random velocities", NO_GAIN | KEPT, LAYOUT(crowd, 10000, 4, 0.6, 0.3, 1, 2), .duration = 5, OFF(FORM_DRAG), .is_long = true, .is_once = true},
};
const size_t hard_n_scenes = sizeof hard_scenes / sizeof *hard_scenes;
