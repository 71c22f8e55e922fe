/* Does one disc meet any of a few others? All of them are compared, as many at a time as a register holds, and there is one
 * branch at the end: most places are refused or free by chance, and a branch per disc would be guessed wrong as often.
 *
 * The compiler's own vectors, because it does not find them in loops this short; the arithmetic is that of single
 * numbers, operation by operation. */
#ifndef FW_FIELD_ABREAST_H
#define FW_FIELD_ABREAST_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __AVX__
enum { FW_LANES = 4 };
#else
enum { FW_LANES = 2 };
#endif
typedef double  fw_lanes __attribute__((vector_size(8 * FW_LANES), aligned(8), may_alias));
typedef int64_t fw_lane_bits __attribute__((vector_size(8 * FW_LANES), aligned(8), may_alias));

typedef struct fw_place {
    double x, y, r, gap; /* of the disc, and the distance that rims must keep [m] */
    double height;       /* after which places repeat in y, infinite when they do not [m] */
} fw_place;

/* Discs [0, n) of x, y, r; n is a constant and a multiple of 4. A disc nowhere has x = INFINITY. */
static inline bool fw_abreast_is_taken(const double *x, const double *y, const double *r, int n, fw_place at)
{
    fw_lane_bits is_taken = {0}, height = (fw_lane_bits)((fw_lanes){0} + at.height);
    double       half = 0.5 * at.height;
    for (int i = 0; i < n; i += FW_LANES) {
        fw_lanes dx = at.x - *(const fw_lanes *)(x + i), dy = at.y - *(const fw_lanes *)(y + i);
        fw_lanes limit = at.r + *(const fw_lanes *)(r + i) + at.gap;
        /* one height less where dy > half of it, one more where dy < -half; else no change */
        dy += (fw_lanes)(height & (dy < -half)) - (fw_lanes)(height & (dy > half));
        is_taken |= dx * dx + dy * dy < limit * limit;
    }
    int64_t any = is_taken[0];
    for (int i = 1; i < FW_LANES; i++) any |= is_taken[i];
    return any != 0;
}

#endif
