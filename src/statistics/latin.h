/* Latin hypercube: `size` points of which, in every dimension, each of the `size` intervals of equal length has exactly one, the intervals of different
 * dimensions joined at random. The mean of a sum of functions of one coordinate each errs by n^(-3/2), that of anything else no worse than n / (n - 1)
 * times plain sampling in variance. For an interval take several replicates: points of one hypercube are not independent.
 *
 * Point i comes straight from i: its interval is entry i of a random permutation that is never stored, a Feistel network over the next power of 2 (round
 * function: Philox) followed until it lands below size again. 16 rounds, for the sake of the smallest sizes: they bring the 24 orders of 4 to within
 * 6e-5 of equal likelihood (12 rounds: 1e-3, 8 rounds: 1.6 %; counted out), and larger sizes need fewer. Where size is a power of 2 above 8 all
 * permutations are even, which shows in no statistics of fewer than size - 1 points.
 *
 * Sources: M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979), 239-245; M. Stein, "Large sample properties of simulations using Latin
 * hypercube sampling", Technometrics 29 (1987), 143-151; J. Black, P. Rogaway, "Ciphers with arbitrary finite domains", CT-RSA 2002. */
#ifndef FW_STATISTICS_LATIN_H
#define FW_STATISTICS_LATIN_H

#include <stddef.h>
#include <stdint.h>

/* index      below size
 * size       1 to 2^32 points
 * replicate  which hypercube of this seed
 * u          (n_dimensions), open (0, 1); uniform within its interval; a point of fewer dimensions is the start of one of more */
void fw_latin_point(uint64_t index, uint64_t size, size_t n_dimensions, uint64_t seed, uint64_t replicate, double *u);

#endif
