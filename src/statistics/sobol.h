/* Sobol points, plain or randomised: each straight from its index.
 *
 * The first 2^m points (and each later block of them, k 2^m to (k + 1) 2^m) are spread evenly over boxes of the unit cube: in every dimension each of
 * the 2^m intervals of length 2^-m has exactly one, in pairs of dimensions each box of area 2^(t - m) has 2^t, with t small for these directions. The
 * mean of a smooth function over them errs by nearly 1 / n, over scrambled ones by nearly n^(-3/2). The origin is point 0: without it none of this holds.
 * n other than a power of 2 is allowed and loses part of the gain.
 *
 *   none    point 0 is the origin; nothing tells how large the error is
 *   Owen    nested uniform scramble: bit b of a coordinate is flipped or not by a coin of its own for every value of the bits above b. Each point is
 *           uniform, means are unbiased, the spread over randomisations tells the error, and no function does worse than a few times plain sampling
 *           (e times where t = 0)
 *   shift   every coordinate of a randomisation is xor-ed with one number: unbiased too, in less than half the time (0.5 against 1.2 us for 8
 *           dimensions), error nearly 1 / n
 *
 * A coordinate has 52 bits, all of them scrambled, and where randomised half a unit more: open (0, 1), as fw_random_uniform.
 * The order is that of the Gray code, as in most programs: any block of 2^m points is the same set in either order.
 *
 * Sources: S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008), 2635-2654,
 * directions new-joe-kuo-6; A. B. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995 (the scramble), "Monte Carlo variance of scrambled
 * net quadrature", SIAM J. Numer. Anal. 34 (1997), 1884-1910 (e times), "Scrambled net variance for integrals of smooth functions", Ann. Statist. 25
 * (1997), 1541-1562 (n^-3), and "On dropping the first Sobol' point", 2020. */
#ifndef FW_STATISTICS_SOBOL_H
#define FW_STATISTICS_SOBOL_H

#include <stddef.h>
#include <stdint.h>

enum { FW_SOBOL_DIMENSIONS = 16, FW_SOBOL_BITS = 52 };

typedef enum fw_scramble { FW_SCRAMBLE_NONE, FW_SCRAMBLE_OWEN, FW_SCRAMBLE_SHIFT } fw_scramble;

/* index         below 2^52
 * n_dimensions  at most FW_SOBOL_DIMENSIONS; a point of fewer dimensions is the start of one of more
 * seed, randomisation   which coins; without a scramble neither matters
 * u             (n_dimensions) */
void fw_sobol_point(uint64_t index, size_t n_dimensions, fw_scramble kind, uint64_t seed, uint64_t randomisation, double *u);

#endif
