#include "statistics/latin.h"

#include <assert.h>
#include <math.h>

#include "base/random.h"

enum { ROUNDS = 16, STRATA = 1, JITTER = 2 }; /* STRATA, JITTER: uses of FW_STREAM_DESIGN, the upper half of its part */

/* One pass over 0 .. 2^bits - 1: halves of a and bits - a bits flip each other in turn, by functions that are random and independent round by round. */
static uint64_t feistel(const fw_random *stream, unsigned bits, uint64_t x)
{
    unsigned a = bits / 2;
    uint64_t lower = (UINT64_C(1) << a) - 1, upper = (UINT64_C(1) << (bits - a)) - 1;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        uint32_t block[4];
        fw_random_block(stream, round << 32 | (round % 2 ? x >> a : x & lower), block);
        x ^= round % 2 ? block[0] & lower : (block[0] & upper) << a;
    }
    return x;
}

/* Following the cycle of the larger permutation from inside back to inside is a permutation of what is inside; fewer than two passes on average
 * (four below a size of 3: halves have at least a bit). */
static uint64_t permuted(const fw_random *stream, uint64_t size, uint64_t index)
{
    unsigned bits = 2;
    while ((size - 1) >> bits) bits++;
    do index = feistel(stream, bits, index);
    while (index >= size);
    return index;
}

void fw_latin_point(uint64_t index, uint64_t size, size_t n_dimensions, uint64_t seed, uint64_t replicate, double *u)
{
    assert(index < size && size <= UINT64_C(1) << 32);
    for (uint64_t d = 0; d < n_dimensions; d++) {
        fw_random strata, jitter;
        uint32_t  block[4];
        fw_random_stream(&strata, seed, FW_STREAM_DESIGN, replicate, (uint64_t)STRATA << 32 | d);
        fw_random_stream(&jitter, seed, FW_STREAM_DESIGN, replicate, (uint64_t)JITTER << 32 | d);
        fw_random_block(&jitter, index, block);
        double within = ((double)block[0] + 0.5) * 0x1p-32; /* its sum with an interval's number is exact for a million of them */
        u[d] = fmin(((double)permuted(&strata, size, index) + within) / (double)size, 1 - 0x1p-53);
    }
}
