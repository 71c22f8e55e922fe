/* Does one disc meet any of a few others? As many are compared at a time as a register holds, and the answer is looked at
 * once per stretch of them: where it comes from is chance, and a branch per disc would be guessed wrong as often.
 *
 * The compiler's own vectors, because it does not find them in loops this short; the arithmetic is that of single
 * numbers, operation by operation. */
#ifndef FW_FIELD_ABREAST_H
#define FW_FIELD_ABREAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FW_ABREAST = 8 }; /* discs come in multiples of it, filled up with discs nowhere: x = INFINITY */

#if defined(__AVX512F__)
enum { FW_LANES = 8 };
#elif defined(__AVX__)
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

static inline bool fw_lanes_any(fw_lane_bits bits)
{
    /* halves upon halves: lane by lane takes as long as the comparison itself */
    typedef int64_t two __attribute__((vector_size(16), aligned(8), may_alias));
#if defined(__AVX512F__)
    typedef int64_t four __attribute__((vector_size(32), aligned(8), may_alias));
    four            all4 = *(four *)&bits | *((four *)&bits + 1);
    two             all2 = *(two *)&all4 | *((two *)&all4 + 1);
#elif defined(__AVX__)
    two all2 = *(two *)&bits | *((two *)&bits + 1);
#else
    two all2 = bits;
#endif
    return (all2[0] | all2[1]) != 0;
}

/* Is the place taken by one of discs [0, n) of x, y, r? n is a multiple of FW_ABREAST. */
static inline bool fw_abreast_is_taken(const double *x, const double *y, const double *r, size_t n, fw_place at)
{
    const size_t       stretch = 8 * FW_LANES; /* looked at together */
    const fw_lane_bits height = (fw_lane_bits)((fw_lanes){0} + at.height);
    const double       half = 0.5 * at.height;
    for (size_t begin = 0; begin < n; begin += stretch) {
        fw_lane_bits is_taken = {0};
        size_t       end = n - begin < stretch ? n : begin + stretch;
        for (size_t i = begin; i < end; i += FW_LANES) {
            fw_lanes dx = at.x - *(const fw_lanes *)(x + i), dy = at.y - *(const fw_lanes *)(y + i);
            fw_lanes limit = at.r + *(const fw_lanes *)(r + i) + at.gap;
            /* one height less where dy > half of it, one more where dy < -half; else no change */
            dy += (fw_lanes)(height & (dy < -half)) - (fw_lanes)(height & (dy > half));
            is_taken |= dx * dx + dy * dy < limit * limit;
        }
        if (fw_lanes_any(is_taken)) return true;
    }
    return false;
}

#endif
