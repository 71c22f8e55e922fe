#include "statistics/sobol.h"

#include <assert.h>

#include "base/random.h"

enum { BITS = FW_SOBOL_BITS, MOST_DEGREE = 6 };

/* new-joe-kuo-6, dimensions 2 to 16: primitive polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1 with a = (a_1 ... a_(s-1)) in binary, and the first s
 * direction numbers m_k, odd and below 2^k. */
static const struct {
    unsigned char s, a, m[MOST_DEGREE];
} JOE_KUO[FW_SOBOL_DIMENSIONS - 1] = {
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
};

/* The first dimension reverses the bits: v_k = 2^-k, here in units of 2^-BITS. */
static uint64_t first_coordinate(uint64_t gray)
{
    uint64_t x = 0;
    for (uint64_t v = UINT64_C(1) << (BITS - 1); gray; gray >>= 1, v >>= 1) x ^= gray & 1 ? v : 0;
    return x;
}

/* v_k = m_k 2^-k to the degree, then v_k = a_1 v_(k-1) + ... + a_(s-1) v_(k-s+1) + v_(k-s) + v_(k-s) 2^-s, + the exclusive or: made as far as the
 * index has bits, which costs less than the scramble. */
static uint64_t coordinate(size_t dimension, uint64_t gray)
{
    if (dimension == 0) return first_coordinate(gray);
    unsigned s = JOE_KUO[dimension - 1].s, a = JOE_KUO[dimension - 1].a;
    uint64_t v[BITS], x = 0;
    for (unsigned k = 0; gray >> k; k++) {
        if (k < s) {
            v[k] = (uint64_t)JOE_KUO[dimension - 1].m[k] << (BITS - 1 - k);
        } else {
            v[k] = v[k - s] ^ v[k - s] >> s;
            for (unsigned i = 1; i < s; i++) v[k] ^= a >> (s - 1 - i) & 1 ? v[k - i] : 0;
        }
        x ^= gray >> k & 1 ? v[k] : 0;
    }
    return x;
}

/* The coins of a scramble hang on a binary tree: one at each value of the bits above. A block of 128 random bits holds the 127 coins of seven levels of
 * it below one node, so that 52 levels are eight blocks. The node at level l with bits p above it has the number 2^l + p, that of a block of the stream;
 * within a block the same numbering starts at 1 again. */
enum { LEVELS = 7 };

static uint64_t owen_flips(const fw_random *stream, uint64_t x)
{
    uint64_t flips = 0;
    for (unsigned top = 0; top < BITS; top += LEVELS) {
        uint32_t coins[4], node = 1;
        fw_random_block(stream, UINT64_C(1) << top | x >> (BITS - top), coins);
        for (unsigned level = top; level < top + LEVELS && level < BITS; level++) {
            flips = flips << 1 | (coins[node / 32] >> node % 32 & 1);
            node = node << 1 | (uint32_t)(x >> (BITS - 1 - level) & 1);
        }
    }
    return flips;
}

/* No node has the number 0. */
static uint64_t shift_flips(const fw_random *stream)
{
    uint32_t block[4];
    fw_random_block(stream, 0, block);
    return ((uint64_t)block[1] << 32 | block[0]) >> (64 - BITS);
}

void fw_sobol_point(uint64_t index, size_t n_dimensions, fw_scramble kind, uint64_t seed, uint64_t randomisation, double *u)
{
    assert(index >> BITS == 0 && n_dimensions <= FW_SOBOL_DIMENSIONS);
    for (size_t d = 0; d < n_dimensions; d++) {
        fw_random stream;
        uint64_t  x = coordinate(d, index ^ index >> 1);
        if (kind == FW_SCRAMBLE_NONE) {
            u[d] = (double)x * 0x1p-52;
            continue;
        }
        fw_random_stream(&stream, seed, FW_STREAM_DESIGN, randomisation, d);
        x ^= kind == FW_SCRAMBLE_OWEN ? owen_flips(&stream, x) : shift_flips(&stream);
        u[d] = ((double)x + 0.5) * 0x1p-52;
    }
}
