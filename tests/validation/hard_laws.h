/* The laws. Each is one number of a case and the bound it must not pass; NaN breaks a law. */
#ifndef TESTS_HARD_LAWS_H
#define TESTS_HARD_LAWS_H

#include "validation/hard_case.h"

/* name in C, key in the sheet's JSON, what it says */
#define HARD_LAW_LIST(X)                                                                                                                        \
    X(ENDS, "ends", "the run ends well")                                                                                                        \
    X(FINITE, "finite", "states, ledgers and rings are finite; impulse, path, depth and load are not negative")                                 \
    X(ENERGY_BOOKS, "energy_books", "impulse times mean velocity is the change of kinetic energy to 1e-10")                                     \
    X(MOMENTUM_BOOKS, "momentum_books", "impulses are the change of momentum to 1e-10")                                                         \
    X(WEAR_BOOKS, "wear_books", "the ring holds the patch integral to 1e-10")                                                                   \
    X(BALANCE, "balance", "the energy balance of the trajectory closes to the accuracy")                                                        \
    X(PUNCTUAL, "punctual", "no touch is found after the rims have overlapped; in a window one for a hundred floes")                           \
    X(OVERLAP, "overlap", "no overlap of a whole radius")                                                                                       \
    X(DEPTH, "depth", "a tenth of the accuracy changes depth by less than the accuracy")                                                        \
    X(TWICE, "twice", "of rafts whose wear hangs on few contacts of many: a tenth of the accuracy changes depth by less than twice the accuracy") \
    X(ROUGHLY, "roughly", "where contacts hang by a hair: that changes depth by less than the accuracy or than shifting each floe by up to a millimetre does") \
    X(MIRROR, "mirror", "the mirror image of the scene gives the mirror image of the result, to rounding")                                       \
    X(SIMILAR, "similar", "a quarter of every force, or twice the speed and four times the stiffness: the same ways, to rounding")               \
    X(ORDER, "order", "floes named in reverse order give the same to the accuracy")                                                              \
    X(WATCHING, "watching", "saving 200 instants, which cuts steps, gives the same depth to the accuracy")                                         \
    X(TURNED, "turned", "the scene turned by 90 and by 37 degrees gives the turned result, to the accuracy")                                                  \
    X(NO_GAIN, "no_gain", "kinetic and stored energy never pass the start's, where no current feeds them")                                      \
    X(KEPT, "kept", "momentum of a free cluster stays, to 1e-12 of the momenta in it")                                                          \
    X(RESTS, "rests", "comes to rest: at the end no floe moves at more than 1 % of the largest speed at the start")                            \
    X(ON_AXIS, "on_axis", "floes on the axis stay there and do not turn, to rounding")                                                          \
    X(SYMMETRIC, "symmetric", "a scene that is its own mirror image stays so to the accuracy, and its ring is; ten times better at a tenth of it") \
    X(RESTITUTION, "restitution", "head-on without drag: relative speed after over before, and impulse, as the damped oscillator's closed form, to the accuracy, and a tenth of it") \
    X(DEEPEST, "deepest", "head-on without drag: largest overlap as the closed form, to the accuracy")                                           \
    X(PEAK, "peak", "head-on on the structure without drag: largest force as the closed form, to the accuracy")                                  \
    X(NO_SPIN, "no_spin", "without friction nobody's spin changes, to rounding")                                                                 \
    X(TOUCHES, "touches", "the floe meets the structure")                                                                                        \
    X(FLIGHT, "flight", "free flight under drag is the closed form")                                                                            \
    X(UNTOUCHED, "untouched", "no impulse, path or change of velocity")                                                                         \
    X(REFUSES, "refuses", "an overlap of a whole radius ends the run with FW_E_NUMERIC and the floe's name; at the start it is refused")

enum hard_law_number {
#define X(name, key, text) HARD_LAW_##name,
    HARD_LAW_LIST(X)
#undef X
        HARD_N_LAWS
};
typedef enum hard_law {
#define X(name, key, text) name = 1 << HARD_LAW_##name,
    HARD_LAW_LIST(X)
#undef X
} hard_law;

/* Of every run that must not be refused; and of given floes besides, unless they are too many to be run again and again. */
enum { HARD_ALWAYS = ENDS | FINITE | ENERGY_BOOKS | MOMENTUM_BOOKS | WEAR_BOOKS | BALANCE | PUNCTUAL | OVERLAP, HARD_OF_SCENES = MIRROR | SIMILAR };

typedef struct hard_verdict {
    double value, bound;
} hard_verdict;

extern const char *const hard_law_keys[HARD_N_LAWS], *const hard_law_texts[HARD_N_LAWS];

uint64_t     hard_laws_of(const hard_scene *s);
hard_verdict hard_law_judge(int law, hard_case *c);
static inline bool hard_is_held(hard_verdict v) { return v.value <= v.bound; }

#endif
