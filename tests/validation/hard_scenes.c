#include "validation/hard_laws.h"

#define FLOES(...) .floes = (const fw_floe[]){__VA_ARGS__}, .n = sizeof((const fw_floe[]){__VA_ARGS__}) / sizeof(fw_floe)
#define LAYOUT(name, ...) .layout = hard_##name, .p = {__VA_ARGS__}
#define CHANGE(...) .change = {__VA_ARGS__}
#define OFF(which) .change.off = FW_EFFECT_##which

/* x y D h vx vy spin. The paper's structure has 3.7 m, so a floe of 5 m touches at a reach of 6.2 m. */
#define FIVE(x, y, v) {x, y, 5, 0.5, v, 0, 0}
#define HIT FLOES(FIVE(-7, 2, 2)), .speed = 2, .duration = 12 /* one oblique hit and the way round */

/* Coupled: runs that differ in the last digit stay together. */
enum { COUPLED = DEPTH | MIRROR, FREE = MIRROR | TURNED | NO_GAIN | KEPT, HEAD_ON = ON_AXIS | MIRROR };

const hard_scene hard_scenes[] = {
    /* ---- head-on: closed forms ------------------------------------------------------------------------------------- */
    {"head-on, zeta 1", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, OFF(FORM_DRAG)},
    {"head-on, zeta 0", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = NONE, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 0.1", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 0.1, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 2", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 2, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, zeta 5", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.5, 0, 2)), .duration = 3, CHANGE(.damping = 5, .off = FW_EFFECT_FORM_DRAG)},
    {"head-on, held by the current", HEAD_ON | RESTS, FLOES(FIVE(-6.5, 0, 2)), .speed = 2, .duration = 60},
    {"two floes head-on, zeta 1", HEAD_ON | RESTITUTION | FREE, FLOES(FIVE(-50, 0, 1), {-44.9, 0, 5, 0.5, -1, 0, 0}), .duration = 3, OFF(FORM_DRAG)},
    {"two floes head-on, zeta 0", HEAD_ON | RESTITUTION | FREE, FLOES(FIVE(-50, 0, 1), {-44.9, 0, 5, 0.5, -1, 0, 0}), .duration = 3, CHANGE(.damping = NONE, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes head-on, zeta 2", HEAD_ON | RESTITUTION | FREE, FLOES(FIVE(-50, 0, 1), {-44.9, 0, 5, 0.5, -1, 0, 0}), .duration = 3, CHANGE(.damping = 2, .off = FW_EFFECT_FORM_DRAG)},
    {"two floes at 5 m/s", HEAD_ON | RESTITUTION | FREE, FLOES(FIVE(-50, 0, 5), {-44.5, 0, 5, 0.5, -5, 0, 0}), .duration = 3, OFF(FORM_DRAG)},
    {"two floes at 5 m/s, oblique", FREE, FLOES(FIVE(-50, 1.5, 5), {-44, 0, 5, 0.5, -5, 0, 0}), .duration = 3, OFF(FORM_DRAG)},
    {"huge floe hits a tiny one, 500 : 1", HEAD_ON | RESTITUTION | FREE, FLOES({-60, 0, 12, 1.5, 2, 0, 0}, {-53.2, 0, 1.2, 0.3, 0, 0, 0}), .duration = 2, OFF(FORM_DRAG)},
    {"free flight under drag", FLIGHT | MIRROR, FLOES({-100, 3, 5, 0.5, 5, -2, 1}, {-200, 0, 1.2, 0.3, -1, 3, -2}), .speed = 1, .duration = 20},

    /* ---- one floe on the structure, one thing at its end ---------------------------------------------------------- */
    {"one hit", COUPLED, HIT},
    {"one hit, still water, at any angle", COUPLED | TURNED | NO_GAIN, FLOES(FIVE(-7, 2, 2)), .duration = 12},
    {"stiffness 1e4", COUPLED, FLOES(FIVE(-7, 2, 0.4)), .speed = 0.4, .duration = 60, CHANGE(.stiffness = 1e4)},
    {"stiffness 1e5", COUPLED, HIT, CHANGE(.stiffness = 1e5)},
    {"stiffness 1e7", COUPLED, HIT, CHANGE(.stiffness = 1e7)},
    {"stiffness 1e8", COUPLED, HIT, CHANGE(.stiffness = 1e8)},
    {"stiffness 1e9", COUPLED, HIT, CHANGE(.stiffness = 1e9)},
    {"damping ratio 0", COUPLED, HIT, CHANGE(.damping = NONE)},
    {"damping ratio 0.1", COUPLED, HIT, CHANGE(.damping = 0.1)},
    {"damping ratio 2", COUPLED, HIT, CHANGE(.damping = 2)},
    {"damping ratio 5", COUPLED, HIT, CHANGE(.damping = 5)},
    {"friction 0", COUPLED | NO_SPIN, HIT, CHANGE(.friction = NONE)},
    {"friction 0.5", COUPLED, HIT, CHANGE(.friction = 0.5)},
    {"friction 1", COUPLED, HIT, CHANGE(.friction = 1)},
    {"friction effect off", COUPLED | NO_SPIN, HIT, OFF(FRICTION)},
    {"rotation off", COUPLED | NO_SPIN, HIT, OFF(ROTATION)},
    {"slip damping 0", COUPLED | NO_SPIN, HIT, CHANGE(.slip_damping = NONE)},
    {"slip damping 10", COUPLED, HIT, CHANGE(.slip_damping = 10)},
    {"spin +50", COUPLED, FLOES({-7, 2, 5, 0.5, 2, 0, 50}), .speed = 2, .duration = 12},
    {"spin -50", COUPLED, FLOES({-7, 2, 5, 0.5, 2, 0, -50}), .speed = 2, .duration = 12},
    {"current of 1 mm/s", COUPLED, FLOES(FIVE(-6.3, 2, 1e-3)), .speed = 1e-3, .duration = 20000},
    {"current of 5 m/s", COUPLED, FLOES(FIVE(-8, 2, 5)), .speed = 5, .duration = 6},
    {"thin ice, 0.09 m", COUPLED, FLOES({-5, 1.5, 0.6, 0.09, 2, 0, 0}), .speed = 2, .duration = 10},
    {"thick ice, 3 m", COUPLED, FLOES({-13, 3, 15, 3, 2, 0, 0}), .speed = 2, .duration = 30},
    {"structure of 100 m", COUPLED, FLOES(FIVE(-51, 15, 2)), .speed = 2, .duration = 60, CHANGE(.radius = 50)},
    {"structure of 0.5 m", COUPLED, FLOES(FIVE(-4, 1, 2)), .speed = 2, .duration = 10, CHANGE(.radius = 0.25)},
    {"grazing by 1 mm", COUPLED, FLOES(FIVE(-3, 6.199, 2)), .speed = 2, .duration = 6},
    {"grazing by 1 micrometre", COUPLED, FLOES(FIVE(-3, 6.199999, 2)), .speed = 2, .duration = 6},
    {"passing by 1 micrometre", UNTOUCHED | MIRROR, FLOES(FIVE(-3, 6.200001, 2)), .speed = 2, .duration = 6},

    /* ---- touching at the start -------------------------------------------------------------------------------------- */
    {"resting on it in still water", UNTOUCHED | MIRROR, FLOES(FIVE(-6.2, 0, 0)), .duration = 10},
    {"at rest on it in a current", HEAD_ON | RESTS, FLOES(FIVE(-6.2, 0, 0)), .speed = 2, .duration = 60},
    {"touching with closing speed", HEAD_ON | RESTITUTION | NO_GAIN, FLOES(FIVE(-6.2, 0, 2)), .duration = 3, OFF(FORM_DRAG)},
    {"touching, and leaving", UNTOUCHED | MIRROR, FLOES({-6.2, 0, 5, 0.5, -1, 0.5, 0}), .duration = 5, OFF(FORM_DRAG)},
    {"leaving against the current", COUPLED, FLOES({-4.96, 3.72, 5, 0.5, -0.5, 0, 0}), .speed = 1, .duration = 20},

    /* ---- two or three ------------------------------------------------------------------------------------------------ */
    {"two mirror images at once", COUPLED | SYMMETRIC, FLOES(FIVE(-7, 2.6, 2), FIVE(-7, -2.6, 2)), .speed = 2, .duration = 8},
    {"two on opposite sides", HEAD_ON | NO_GAIN, FLOES(FIVE(-6.5, 0, 2), {6.5, 0, 5, 0.5, -2, 0, 0}), .duration = 3, OFF(FORM_DRAG)},
    {"tiny between structure and huge, 1 : 500", COUPLED, FLOES({-4.4, 0.3, 1.2, 0.3, 0.5, 0, 0}, {-11.1, 0, 12, 1.5, 0.5, 0, 0}), .speed = 0.5, .duration = 60},
    {"tiny before huge in line, 1 : 500", HEAD_ON, FLOES({-4.4, 0, 1.2, 0.3, 0.2, 0, 0}, {-11.1, 0, 12, 1.5, 0.2, 0, 0}), .speed = 0.2, .duration = 60},
    {"wedged between structure and two large", COUPLED | SYMMETRIC, FLOES({-4.6, 0, 1.6, 0.4, 1, 0, 0}, {-9, 4.05, 8, 0.9, 1, 0, 0}, {-9, -4.05, 8, 0.9, 1, 0, 0}), .speed = 1, .duration = 12},
    {"small and fast between two large", FREE, FLOES({-60, 5.2, 8, 0.8, 0, -1, 0}, {-60, -5.2, 8, 0.8, 0, 1, 0}, {-66, 0.2, 1.2, 0.3, 5, 0, 0}), .duration = 6, OFF(FORM_DRAG)},
    {"squeezed out between two large", FREE, FLOES({-60, 4.7, 8, 0.8, 0, -1, 0}, {-60, -4.7, 8, 0.8, 0, 1, 0}, {-60.8, 0, 1.2, 0.3, 0, 0, 0}), .duration = 6, OFF(FORM_DRAG)},
    {"floe contact off", COUPLED, FLOES(FIVE(-7, 2, 2), FIVE(-8, 1.5, 2)), .speed = 2, .duration = 12, OFF(FLOE_CONTACT)},

    /* ---- many ------------------------------------------------------------------------------------------------------------ */
    {"chain of ten in line", HEAD_ON | RESTS, LAYOUT(line, 10, 5, 0.5, -3.8, 0.05, 1), .speed = 1, .duration = 120},
    {"trapped in an arch", COUPLED | SYMMETRIC, FLOES({-5, 0, 2, 0.5, 1, 0, 0}, {-5.6, 3.6, 5, 0.7, 1, 0, 0}, {-5.6, -3.6, 5, 0.7, 1, 0, 0}, {-10, 2.6, 5, 0.7, 1, 0, 0}, {-10, -2.6, 5, 0.7, 1, 0, 0}), .speed = 1, .duration = 15},
    {"six large round one, pressed", FREE, LAYOUT(flower, 2, 6, 0.7, 2.2, 1, -60), .duration = 6, OFF(FORM_DRAG)},
    {"six equal round one, pressed", FREE, LAYOUT(flower, 5, 5, 0.7, 0.1, 1, -60), .duration = 6, OFF(FORM_DRAG)},
    {"ring round the structure, pressed", MIRROR | NO_GAIN | DEPTH | RESTS, LAYOUT(ring, 7, 5, 0.5, 1, 3.7), .duration = 120},
    {"raft of 19", COUPLED, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1), .speed = 1, .duration = 20},
    {"raft of 19 in still water", COUPLED | NO_GAIN | RESTS, LAYOUT(hexagon, 2, 5, 0.5, -3.8, 0.02, 1), .duration = 300},
    {"raft of 19 on a wide structure", COUPLED | RESTS, LAYOUT(hexagon, 2, 5, 0.5, -50.1, 0.02, 1), .speed = 1, .duration = 120, CHANGE(.radius = 50)},
    {"raft of 100", MIRROR, LAYOUT(square, 10, 10, 4, 0.6, 0.02, 1), .speed = 1, .duration = 20},
    {"mixed raft, masses 1 : 100", MIRROR, LAYOUT(mixed, 6, 6, 6, 0.1, 1, 1), .speed = 1, .duration = 20},
    {"crowd of 20 without drag", FREE, LAYOUT(crowd, 20, 4, 0.6, 0.3, 2, 1), .duration = 6, OFF(FORM_DRAG)},
    {"crowd of 20, elastic", NO_GAIN | KEPT | MIRROR, LAYOUT(crowd, 20, 4, 0.6, 0.3, 2, 1), .duration = 6, CHANGE(.damping = NONE, .friction = NONE, .off = FW_EFFECT_FORM_DRAG)},

    /* ---- beyond the model: must refuse ------------------------------------------------------------------------------- */
    {"pushed through the structure", REFUSES, FLOES({-8, 0, 5, 3, 20, 0, 0}), .speed = 2, .duration = 10, CHANGE(.stiffness = 1e4)},
    {"two floes pushed through each other", REFUSES, FLOES({-60, 0.1, 5, 3, 20, 0, 0}, {-54, 0, 5, 3, -20, 0, 0}), .speed = 0, .duration = 3, CHANGE(.stiffness = 1e4)},
    {"two floes in one place", REFUSES, FLOES(FIVE(-60, 0, 0), FIVE(-60, 0, 0)), .duration = 1},

    /* ---- windows of ice ------------------------------------------------------------------------------------------------ */
    {"window, 2 %, 1 h", DEPTH, .concentration = 0.02, .speed = 0.5, .duration = 3600},
    {"window, 40 %, 60 s", 0, .concentration = 0.4, .speed = 2, .duration = 60},
    {"window, 60 %, 60 s", 0, .concentration = 0.6, .speed = 2, .duration = 60},
    {"window, 75 %, 30 s", 0, .concentration = 0.75, .speed = 2, .duration = 30},
    {"window, 2 %, 30 days", DEPTH, .concentration = 0.02, .speed = 0.1, .duration = 30 * 86400.0, .is_long = true},
    {"10 000 floes at random velocities", NO_GAIN | KEPT, LAYOUT(crowd, 10000, 4, 0.6, 0.3, 1, 2), .duration = 2, OFF(FORM_DRAG), .is_long = true, .is_once = true},
};
const size_t hard_n_scenes = sizeof hard_scenes / sizeof *hard_scenes;
