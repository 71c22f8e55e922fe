#include "base/random.h"

#include <string.h>

/* Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC11, section 3.3 and table 2. */
#define PHILOX_M0 0xD2511F53u
#define PHILOX_M1 0xCD9E8D57u
#define PHILOX_W0 0x9E3779B9u /* golden ratio */
#define PHILOX_W1 0xBB67AE85u /* sqrt(3) - 1 */

void fw_philox4x32_10(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4])
{
    uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
    uint32_t k0 = key[0], k1 = key[1];

    for (int round = 0; round < 10; round++) {
        uint64_t p0 = (uint64_t)PHILOX_M0 * c0, p1 = (uint64_t)PHILOX_M1 * c2;
        c0 = (uint32_t)(p1 >> 32) ^ c1 ^ k0;
        c1 = (uint32_t)p1;
        c2 = (uint32_t)(p0 >> 32) ^ c3 ^ k1;
        c3 = (uint32_t)p0;
        k0 += PHILOX_W0;
        k1 += PHILOX_W1;
    }
    out[0] = c0;
    out[1] = c1;
    out[2] = c2;
    out[3] = c3;
}

static uint32_t low(uint64_t x) { return (uint32_t)x; }
static uint32_t high(uint64_t x) { return (uint32_t)(x >> 32); }

/* seed and purpose make a key, that key turns (id, part) into key and upper counter half of the stream, and the lower
 * half counts blocks. Philox under one key is a bijection of its counter, so two streams of one seed and purpose never
 * share a block (2^64 blocks each); different seeds or purposes differ by an independent 128-bit value. */
void fw_random_stream(fw_random *r, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part)
{
    const uint32_t seed_key[2] = {low(seed), high(seed)};
    const uint32_t use[4] = {(uint32_t)purpose, 0, 0, 0};
    const uint32_t which[4] = {low(id), high(id), low(part), high(part)};
    uint32_t       purpose_key[4], stream[4];

    fw_philox4x32_10(use, seed_key, purpose_key);
    fw_philox4x32_10(which, purpose_key, stream);
    memset(r, 0, sizeof *r);
    r->key[0] = stream[0];
    r->key[1] = stream[1];
    r->counter[2] = stream[2];
    r->counter[3] = stream[3];
    r->n_used = 4;
}

uint32_t fw_random_u32(fw_random *r)
{
    if (r->n_used >= 4) {
        fw_philox4x32_10(r->counter, r->key, r->block);
        for (int i = 0; i < 4 && ++r->counter[i] == 0; i++) {} /* 128-bit increment: carry while a word wraps to zero */
        r->n_used = 0;
    }
    return r->block[r->n_used++];
}

void fw_random_block(const fw_random *r, uint64_t n, uint32_t block[4])
{
    const uint32_t counter[4] = {low(n), high(n), r->counter[2], r->counter[3]};
    fw_philox4x32_10(counter, r->key, block);
}

/* Of 64 bits 52: with the half added the numerator has 53, so no value rounds to 1. */
static double to_uniform(uint64_t bits) { return ((double)(int64_t)(bits >> 12) + 0.5) * 0x1p-52; }

double fw_random_uniform(fw_random *r)
{
    uint64_t w0 = fw_random_u32(r), w1 = fw_random_u32(r);

    return to_uniform(w1 << 32 | w0);
}

void fw_uniforms_stream(fw_uniforms *u, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part)
{
    fw_random r;
    fw_random_stream(&r, seed, purpose, id, part);
    memset(u, 0, sizeof *u);
    memcpy(u->key, r.key, sizeof u->key);
    memcpy(u->tail, r.counter + 2, sizeof u->tail);
    u->n_used = FW_UNIFORMS_READY;
}

/* Eight blocks side by side, so that their multiplications share vector instructions: one block alone is a chain of ten
 * rounds that wait for each other. Words of 32 bits are held in 64, as wide as the products: no lane changes its width. */
void fw_uniforms_refill(fw_uniforms *u)
{
    enum { N = FW_UNIFORMS_READY / 2 };
    uint64_t c0[N], c1[N], c2[N], c3[N];
    uint32_t k0 = u->key[0], k1 = u->key[1];
    for (uint64_t i = 0; i < N; i++) {
        c0[i] = low(u->n_blocks + i);
        c1[i] = high(u->n_blocks + i);
        c2[i] = u->tail[0];
        c3[i] = u->tail[1];
    }
    for (int round = 0; round < 10; round++) {
        for (int i = 0; i < N; i++) {
            uint64_t p0 = PHILOX_M0 * c0[i], p1 = PHILOX_M1 * c2[i];
            c0[i] = (p1 >> 32) ^ c1[i] ^ k0;
            c1[i] = low(p1);
            c2[i] = (p0 >> 32) ^ c3[i] ^ k1;
            c3[i] = low(p0);
        }
        k0 += PHILOX_W0;
        k1 += PHILOX_W1;
    }
    for (int i = 0; i < N; i++) {
        u->ready[2 * i] = to_uniform(c1[i] << 32 | c0[i]);
        u->ready[2 * i + 1] = to_uniform(c3[i] << 32 | c2[i]);
    }
    u->n_blocks += N;
    u->n_used = 0;
}

static void gsl_set(void *state, unsigned long seed) { fw_random_stream(state, seed, FW_STREAM_TEST, 0, 0); }

static unsigned long gsl_get(void *state) { return fw_random_u32(state); }

static double gsl_get_double(void *state) { return fw_random_uniform(state); }

const gsl_rng_type *fw_rng_philox(void)
{
    static const gsl_rng_type type = {"philox4x32-10", 0xffffffffUL,  0, sizeof(fw_random), gsl_set,
                                      gsl_get,         gsl_get_double};

    return &type;
}

void fw_rng_stream(gsl_rng *r, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part)
{
    fw_random_stream(gsl_rng_state(r), seed, purpose, id, part);
}
