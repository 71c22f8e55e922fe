/* Philox4x32-10 (Salmon et al., SC11), counter based: stream = f(seed, purpose, id, part), so that no realisation,
 * tile or test ever shares numbers with another and a new purpose never shifts an old one's. Wrapped as our own
 * gsl_rng_type: Random123's shipped GSL wrapper carries its counter wrongly. */
#ifndef FW_BASE_RANDOM_H
#define FW_BASE_RANDOM_H

#include <gsl/gsl_rng.h>
#include <stdint.h>

/* Append only: the numbers are part of every result. */
typedef enum fw_purpose {
    FW_STREAM_SCENARIO   = 1, /* id = realisation: concentration, speed, mix, cell */
    FW_STREAM_FIELD      = 2, /* id = realisation, part = tile */
    FW_STREAM_SERVICE    = 3, /* id = life number */
    FW_STREAM_SECTIONING = 4, /* interval methods that draw */
    FW_STREAM_SUBSETS    = 5, /* accuracy study: which records a sub-set takes */
    FW_STREAM_WIND       = 6, /* id = realisation: speed, angle */
    FW_STREAM_TIDE       = 7, /* id = realisation: phase */
    FW_STREAM_DESIGN     = 8, /* id = randomisation or replicate, part = use << 32 | dimension: 0 scramble, 1 strata, 2 jitter */
    FW_STREAM_OUTLOOK    = 9, /* id = realisation of a made-up campaign, part = which: its ice */
    FW_STREAM_TEST       = 99
} fw_purpose;

typedef struct fw_random {
    uint32_t key[2], counter[4], block[4];
    uint32_t n_used; /* words of block already given out; 4: block is stale */
} fw_random;

void fw_philox4x32_10(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]); /* the bare function */

void     fw_random_stream(fw_random *r, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part);
uint32_t fw_random_u32(fw_random *r);
double   fw_random_uniform(fw_random *r); /* open (0, 1), 53 bits, two words each */

/* Words 4 n .. 4 n + 3 of the stream that r was set to, wherever r has got to: a random function of n. */
void fw_random_block(const fw_random *r, uint64_t n, uint32_t block[4]);

/* A stream read as uniforms alone, eight blocks at a time: the numbers of fw_random_uniform, in its order, in two
 * thirds of the time, with AVX-512 in a fifth. A copy goes on independently. */
enum { FW_UNIFORMS_READY = 16 };
typedef struct fw_uniforms {
    uint64_t n_blocks; /* made so far */
    uint32_t key[2], tail[2];
    uint32_t n_used; /* of ready; FW_UNIFORMS_READY: none is left */
    double   ready[FW_UNIFORMS_READY];
} fw_uniforms;

void fw_uniforms_stream(fw_uniforms *u, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part);
void fw_uniforms_refill(fw_uniforms *u); /* for fw_uniforms_next */

static inline double fw_uniforms_next(fw_uniforms *u)
{
    if (u->n_used == FW_UNIFORMS_READY) fw_uniforms_refill(u);
    return u->ready[u->n_used++];
}

/* gsl_rng_alloc(fw_rng_philox()) then fw_rng_stream(); gsl_rng_set(r, s) is the stream (s, FW_STREAM_TEST, 0, 0). */
const gsl_rng_type *fw_rng_philox(void);
void                fw_rng_stream(gsl_rng *r, uint64_t seed, fw_purpose purpose, uint64_t id, uint64_t part);

#endif
