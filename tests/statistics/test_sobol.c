/* Sobol points: published points, the law of the directions, evenness in boxes, the coins of a scramble, variances. */
#include "statistics/sobol.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_qrng.h>

#include "statistics/near.h"

enum { S = FW_SOBOL_DIMENSIONS, MOST = 1024 };

static const fw_scramble KINDS[] = {FW_SCRAMBLE_NONE, FW_SCRAMBLE_OWEN, FW_SCRAMBLE_SHIFT};

/* The 52 bits of a coordinate. */
static uint64_t bits_of(double u) { return (uint64_t)(u * 0x1p52); }

/* n points from `first` on, point by point. */
static void points(uint64_t first, size_t n, size_t s, fw_scramble kind, uint64_t randomisation, double *u)
{
    for (size_t i = 0; i < n; i++) fw_sobol_point(first + i, s, kind, 20, randomisation, u + i * s);
}

/* Published: the output of Joe and Kuo's own program sobol.cc with new-joe-kuo-6.21201, 20 dimensions, as kept with Sobol.jl (test/results/exp_results_20),
 * lines 0 to 15, 31 and 63; the last four lines hold the first six direction numbers of every dimension. */
static void published_points(void **state)
{
    (void)state;
    static const struct {
        uint64_t index;
        int      denominator, numerator[S];
    } rows[] = {
        {0, 1, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
        {1, 16, {8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8}},
        {2, 16, {12, 4, 4, 4, 12, 12, 4, 12, 12, 12, 12, 12, 4, 4, 12, 4}},
        {3, 16, {4, 12, 12, 12, 4, 4, 12, 4, 4, 4, 4, 4, 12, 12, 4, 12}},
        {4, 16, {6, 6, 10, 14, 6, 2, 6, 14, 14, 10, 14, 6, 6, 10, 6, 14}},
        {5, 16, {14, 14, 2, 6, 14, 10, 14, 6, 6, 2, 6, 14, 14, 2, 14, 6}},
        {6, 16, {10, 2, 14, 10, 10, 14, 2, 2, 2, 6, 2, 10, 2, 14, 10, 10}},
        {7, 16, {2, 10, 6, 2, 2, 6, 10, 10, 10, 14, 10, 2, 10, 6, 2, 2}},
        {8, 16, {3, 5, 15, 7, 9, 5, 7, 15, 15, 5, 11, 1, 15, 15, 13, 15}},
        {9, 16, {11, 13, 7, 15, 1, 13, 15, 7, 7, 13, 3, 9, 7, 7, 5, 7}},
        {10, 16, {15, 1, 11, 3, 5, 9, 3, 3, 3, 9, 7, 13, 11, 11, 1, 11}},
        {11, 16, {7, 9, 3, 11, 13, 1, 11, 11, 11, 1, 15, 5, 3, 3, 9, 3}},
        {12, 16, {5, 3, 5, 9, 15, 7, 1, 1, 1, 15, 5, 7, 9, 5, 11, 1}},
        {13, 16, {13, 11, 13, 1, 7, 15, 9, 9, 9, 7, 13, 15, 1, 13, 3, 9}},
        {14, 16, {9, 7, 1, 13, 3, 11, 5, 13, 13, 3, 9, 11, 13, 1, 7, 5}},
        {15, 16, {1, 15, 9, 5, 11, 3, 13, 5, 5, 11, 1, 3, 5, 9, 15, 13}},
        {31, 32, {1, 17, 29, 31, 31, 25, 11, 17, 5, 19, 1, 11, 31, 7, 21, 27}},
        {63, 64, {1, 51, 23, 29, 55, 9, 37, 9, 53, 37, 27, 43, 35, 49, 21, 49}},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        double u[S];
        fw_sobol_point(rows[r].index, S, FW_SCRAMBLE_NONE, 0, 0, u);
        for (int d = 0; d < S; d++) assert_true(u[d] == (double)rows[r].numerator[d] / rows[r].denominator);
    }
}

/* Points 12345 and 12345678 of another program: scipy.stats.qmc.Sobol 1.10.1, 16 dimensions, 30 bits, fast_forward; in units of 2^-30. */
static void far_points(void **state)
{
    (void)state;
    static const uint32_t at_12345[S] = {0x29050000, 0x340f0000, 0x0a430000, 0x21b70000, 0x38dd0000, 0x03c50000, 0x08250000, 0x07410000,
                                         0x33510000, 0x1b7f0000, 0x04c10000, 0x26530000, 0x3b950000, 0x3c470000, 0x02350000, 0x29030000};
    static const uint32_t at_12345678[S] = {0x25e291c0, 0x04a89640, 0x3d3875c0, 0x226ff9c0, 0x14aaa440, 0x3423b240, 0x1727ce40, 0x3e9852c0,
                                            0x26c452c0, 0x34bef040, 0x0afeb7c0, 0x0ac3cd40, 0x11c93cc0, 0x3f4adec0, 0x08f45fc0, 0x2742a240};
    double u[S];
    fw_sobol_point(12345, S, FW_SCRAMBLE_NONE, 0, 0, u);
    for (int d = 0; d < S; d++) assert_true(u[d] == at_12345[d] * 0x1p-30);
    fw_sobol_point(12345678, S, FW_SCRAMBLE_NONE, 0, 0, u);
    for (int d = 0; d < S; d++) assert_true(u[d] == at_12345678[d] * 0x1p-30);
}

/* GSL has other directions from the third dimension on and leaves the origin out. */
static void gsl_agrees_where_it_can(void **state)
{
    (void)state;
    gsl_qrng *q = gsl_qrng_alloc(gsl_qrng_sobol, 2);
    for (uint64_t i = 1; i < 5000; i++) {
        double u[2], v[2];
        gsl_qrng_get(q, v);
        fw_sobol_point(i, 2, FW_SCRAMBLE_NONE, 0, 0, u);
        assert_true(u[0] == v[0] && u[1] == v[1]);
    }
    gsl_qrng_free(q);
}

/* ---- directions ------------------------------------------------------------------------------------------------- */

/* x generates the multiplicative group of polynomials modulo p of this degree: primitive. */
static bool is_primitive(unsigned p, unsigned degree)
{
    unsigned x = 1, order = 0;
    do {
        x <<= 1, order++;
        if (x >> degree & 1) x ^= p;
    } while (x != 1 && x != 0 && order < 1u << degree);
    return x == 1 && order == (1u << degree) - 1;
}

/* Joe and Kuo take the primitive polynomials in order of degree, then of their number; m_k is read off point 2^k - 1, whose Gray code has bit k alone.
 * All 52 directions of a dimension are odd, below 2^k, and follow the recurrence of their polynomial. */
static void directions_follow_primitive_polynomials(void **state)
{
    (void)state;
    unsigned p = 2, s = 1; /* x^s + ... + 1 as bits */
    for (size_t d = 1; d < S; d++) {
        uint64_t m[FW_SOBOL_BITS + 1];
        double   u[S];
        do {
            p++;
            if (p >> (s + 1)) s++;
        } while (!is_primitive(p, s));
        for (unsigned k = 1; k <= FW_SOBOL_BITS; k++) {
            fw_sobol_point((UINT64_C(1) << k) - 1, S, FW_SCRAMBLE_NONE, 0, 0, u);
            assert_true(u[0] == ldexp(1, -(int)k));
            m[k] = (uint64_t)ldexp(u[d], (int)k);
            assert_true(u[d] == ldexp((double)m[k], -(int)k) && m[k] % 2 == 1 && m[k] >> k == 0);
            if (k <= s) continue;
            uint64_t wanted = m[k - s]; /* m_k = 2 a_1 m_(k-1) + ... + 2^s m_(k-s) + m_(k-s) */
            for (unsigned i = 1; i <= s; i++) wanted ^= p >> (s - i) & 1 ? m[k - i] << i : 0;
            assert_true(m[k] == wanted);
        }
    }
    assert_int_equal(s, 6);
}

/* ---- evenness --------------------------------------------------------------------------------------------------- */

/* Every block of 2^m points has one in each interval of length 2^-m, also far out and also when scrambled. */
static void one_point_per_interval(void **state)
{
    (void)state;
    static double  u[MOST * S];
    static bool    is_hit[S][MOST];
    const uint64_t blocks[] = {0, 5, (UINT64_C(1) << 30) + 3, UINT64_C(0xfffffffff)};
    for (unsigned kind = 0; kind < 3; kind++)
        for (unsigned m = 0; m <= 10; m++)
            for (int b = 0; b < 4; b++) {
                size_t n = (size_t)1 << m;
                memset(is_hit, 0, sizeof is_hit);
                points(blocks[b] << m, n, S, KINDS[kind], 3, u);
                for (size_t i = 0; i < n; i++)
                    for (size_t d = 0; d < S; d++) {
                        size_t at = bits_of(u[i * S + d]) >> (FW_SOBOL_BITS - m);
                        assert_false(is_hit[d][at]);
                        is_hit[d][at] = true;
                    }
            }
}

/* The smallest t for which each box 2^-q x 2^-(m - t - q) has 2^t of the 2^m points. */
static unsigned t_of_pair(unsigned m, const double *u, size_t j, size_t k)
{
    for (unsigned t = 0;; t++) {
        bool is_even = true;
        for (unsigned q = 0; q <= m - t && is_even; q++) {
            unsigned r = m - t - q;
            size_t   count[MOST] = {0};
            for (size_t i = 0; i < (size_t)1 << m; i++)
                count[bits_of(u[i * S + j]) >> (FW_SOBOL_BITS - q) << r | bits_of(u[i * S + k]) >> (FW_SOBOL_BITS - r)]++;
            for (size_t box = 0; box < (size_t)1 << (m - t); box++) is_even &= count[box] == (size_t)1 << t;
        }
        if (is_even) return t;
    }
}

/* t of a pair is at most the sum of (degree - 1) over its two polynomials, "degree" 1 for the first dimension (Sobol 1967), and a
 * scramble changes it for no pair. */
static void pairs_stay_even(void **state)
{
    (void)state;
    static const unsigned degree[S] = {1, 1, 2, 3, 3, 4, 4, 5, 5, 5, 5, 5, 5, 6, 6, 6};
    static double         u[3][MOST * S];
    unsigned              largest = 0;
    for (unsigned m = 6; m <= 8; m += 2) {
        for (unsigned kind = 0; kind < 3; kind++) points(0, (size_t)1 << m, S, KINDS[kind], 8, u[kind]);
        for (size_t j = 0; j < S; j++)
            for (size_t k = 0; k < j; k++) {
                unsigned t = t_of_pair(m, u[0], j, k);
                assert_true(t <= degree[j] + degree[k] - 2);
                assert_int_equal(t_of_pair(m, u[1], j, k), t);
                assert_int_equal(t_of_pair(m, u[2], j, k), t);
                if (t > largest) largest = t;
            }
    }
    print_message("largest t of a pair: %u\n", largest);
}

/* ---- the index ---------------------------------------------------------------------------------------------------- */

static void a_point_is_a_function_of_its_index(void **state)
{
    (void)state;
    static double forward[MOST * S];
    double        u[S];
    for (unsigned kind = 0; kind < 3; kind++) {
        points(0, MOST, S, KINDS[kind], 4, forward);
        for (size_t i = MOST; i-- > 0;)
            for (size_t s = 0; s <= S; s += 5) { /* fewer dimensions: the first of them */
                fw_sobol_point(i, s, KINDS[kind], 20, 4, u);
                assert_memory_equal(u, forward + i * S, s * sizeof *u);
            }
    }
    /* each of seed and randomisation makes another scramble, and none touches plain points */
    for (unsigned kind = 0; kind < 3; kind++) {
        double a[1], b[1], c[1];
        fw_sobol_point(77, 1, KINDS[kind], 1, 1, a);
        fw_sobol_point(77, 1, KINDS[kind], 2, 1, b);
        fw_sobol_point(77, 1, KINDS[kind], 1, 2, c);
        assert_true((*a == *b) == (kind == 0) && (*a == *c) == (kind == 0) && (*b == *c) == (kind == 0));
    }
}

/* The first dimension reverses the Gray code: 2^40 ^ 2^39 becomes 2^-41 + 2^-40; the last index has bit 51 alone, 2^-52. */
static void far_indices(void **state)
{
    (void)state;
    double u[S];
    fw_sobol_point(UINT64_C(1) << 40, 1, FW_SCRAMBLE_NONE, 0, 0, u);
    assert_true(u[0] == 0x3p-41);
    fw_sobol_point((UINT64_C(1) << 52) - 1, S, FW_SCRAMBLE_NONE, 0, 0, u);
    assert_true(u[0] == 0x1p-52);
    for (uint64_t i = 0; i < 1000; i++) {
        double plain[S];
        fw_sobol_point((UINT64_C(1) << 40) + i * 0x10001, S, FW_SCRAMBLE_NONE, 0, 0, plain);
        fw_sobol_point((UINT64_C(1) << 40) + i * 0x10001, S, KINDS[1 + i % 2], 1, i, u);
        for (int d = 0; d < S; d++) assert_true(plain[d] >= 0 && plain[d] < 1 && u[d] > 0 && u[d] < 1);
    }
}

/* ---- the coins ---------------------------------------------------------------------------------------------------- */

/* chi-square against equal chances, within 4 standard errors of its mean. */
static void assert_equal_chances(size_t n_cells, const unsigned *count, double n)
{
    double chi2 = 0, expected = n / (double)n_cells, f = (double)n_cells - 1;
    for (size_t c = 0; c < n_cells; c++) chi2 += (count[c] - expected) * (count[c] - expected) / expected;
    assert_true(fabs(chi2 - f) < 4 * sqrt(2 * f));
}

static void each_point_is_uniform(void **state)
{
    (void)state;
    enum { CELLS = 64, REPEATS = 20000 };
    const uint64_t indices[] = {0, 1, 37, UINT64_C(1) << 40};
    for (unsigned kind = 1; kind < 3; kind++)
        for (int j = 0; j < 4; j++) {
            unsigned high[2][CELLS] = {{0}}, low[2][CELLS] = {{0}}, both[CELLS] = {0}, blocks[CELLS] = {0};
            for (uint64_t r = 0; r < REPEATS; r++) {
                double u[2];
                fw_sobol_point(indices[j], 2, KINDS[kind], 7, r, u);
                for (int d = 0; d < 2; d++) high[d][bits_of(u[d]) >> 46]++, low[d][bits_of(u[d]) & 63]++;
                both[bits_of(u[0]) >> 49 << 3 | bits_of(u[1]) >> 49]++; /* dimensions have coins of their own */
                blocks[bits_of(u[0]) >> 49 << 3 | (bits_of(u[0]) >> 42 & 7)]++; /* and so have bits 0 to 2 and 7 to 9 */
            }
            for (int d = 0; d < 2; d++) assert_equal_chances(CELLS, high[d], REPEATS), assert_equal_chances(CELLS, low[d], REPEATS);
            assert_equal_chances(CELLS, both, REPEATS), assert_equal_chances(CELLS, blocks, REPEATS);
        }
}

/* Nested: how two points' coordinates part is kept, bit for bit down to where they part. */
static void common_leading_bits_stay_common(void **state)
{
    (void)state;
    enum { N = 128 };
    static double plain[N * S], owen[N * S];
    points(0, N, S, FW_SCRAMBLE_NONE, 0, plain);
    points(0, N, S, FW_SCRAMBLE_OWEN, 9, owen);
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < i; j++)
            for (size_t d = 0; d < S; d++) {
                uint64_t before = bits_of(plain[i * S + d]) ^ bits_of(plain[j * S + d]), after = bits_of(owen[i * S + d]) ^ bits_of(owen[j * S + d]);
                unsigned bit = 51;
                while (!(before >> bit & 1)) bit--;
                assert_true(after >> bit == 1);
            }
}

/* The whole tree: every pattern of coins is as likely as any other, at the top, where one block of random bits goes over into the next, and at the
 * bottom. The node of bit b of a coordinate is the value of the bits above it. */
static void coins_are_fair_and_independent(void **state)
{
    (void)state;
    enum { REPEATS = 40000 };
    static unsigned top[128], middle[256], bottom[64];
    memset(top, 0, sizeof top), memset(middle, 0, sizeof middle), memset(bottom, 0, sizeof bottom);
    for (uint64_t r = 0; r < REPEATS; r++) {
        unsigned pattern = 0, seams = 0, ends = 0;
        uint64_t flips[12], plain[12];
        for (int i = 0; i < 12; i++) { /* 0 to 7, and 300 to 303, which part at once */
            uint64_t index = i < 8 ? (uint64_t)i : 292 + (uint64_t)i;
            double   a, b;
            fw_sobol_point(index, 1, FW_SCRAMBLE_NONE, 0, 0, &a);
            fw_sobol_point(index, 1, FW_SCRAMBLE_OWEN, 8, r, &b);
            plain[i] = bits_of(a), flips[i] = bits_of(b) ^ plain[i];
        }
        for (int i = 0; i < 8; i++) /* seven nodes: 1 of bit 0, 2 of bit 1, 4 of bit 2 */
            for (unsigned bit = 0; bit < 3; bit++) {
                unsigned node = (1u << bit | (unsigned)(plain[i] >> (52 - bit))) - 1, coin = flips[i] >> (51 - bit) & 1;
                pattern = (pattern & ~(1u << node)) | coin << node;
            }
        for (int i = 8; i < 12; i++) seams = seams << 2 | (flips[i] >> (51 - 7) & 3); /* bits 6 and 7 of four points */
        for (int i = 8; i < 10; i++) ends = ends << 3 | (flips[i] & 7);
        top[pattern]++, middle[seams]++, bottom[ends]++;
    }
    assert_equal_chances(128, top, REPEATS);
    assert_equal_chances(256, middle, REPEATS);
    assert_equal_chances(64, bottom, REPEATS);
}

/* ---- variances ---------------------------------------------------------------------------------------------------- */

enum { DIMENSIONS = 3 };

/* Mean 1; plain variance of one value (1 + c^2 / 12)^s - 1. */
static double smooth(const double *u)
{
    double f = 1;
    for (int d = 0; d < DIMENSIONS; d++) f *= 1 + (u[d] - 0.5);
    return f;
}

/* Mean 1/3! = volume of the corner x_1 + x_2 + x_3 < 1. */
static double step(const double *u) { return u[0] + u[1] + u[2] < 1; }

typedef struct spread {
    double mean, variance, lag; /* of means over n points; correlation of the means of one randomisation and the next */
} spread;

static spread spread_of(double (*f)(const double *), fw_scramble kind, size_t n, uint64_t repeats)
{
    double sum = 0, squares = 0, products = 0, before = 0, first = 0;
    for (uint64_t r = 0; r < repeats; r++) {
        double e = 0, u[DIMENSIONS];
        for (uint64_t i = 0; i < n; i++) {
            fw_sobol_point(i, DIMENSIONS, kind, 31, r, u);
            e += f(u) / (double)n;
        }
        if (r == 0) first = e;
        e -= first; /* no loss of digits in the squares */
        sum += e, squares += e * e, products += e * before, before = e;
    }
    double k = (double)repeats, mean = sum / k, variance = (squares - k * mean * mean) / (k - 1);
    return (spread){first + mean, variance, (products / k - mean * mean) / variance};
}

static void smooth_means_converge_fast(void **state)
{
    (void)state;
    enum { REPEATS = 400 };
    const double plain = pow(13.0 / 12, DIMENSIONS) - 1;
    for (unsigned kind = 1; kind < 3; kind++) {
        double variance[5];
        for (int j = 0; j < 5; j++) {
            size_t n = (size_t)64 << j;
            spread s = spread_of(smooth, KINDS[kind], n, REPEATS);
            variance[j] = s.variance;
            print_message("%s, n %4zu: variance %.3g, 1/%.0f of plain, lag %.2f\n", kind == 1 ? "Owen" : "shift", n, s.variance,
                          plain / (double)n / s.variance, s.lag);
            assert_true(fabs(s.mean - 1) < 4 * sqrt(s.variance / REPEATS));
            assert_true(fabs(s.lag) < 4 / sqrt(REPEATS)); /* randomisations know nothing of each other */
        }
        double slope = log(variance[4] / variance[0]) / log(16);
        print_message("slope %.2f\n", slope);
        assert_true(slope < (kind == 1 ? -2.5 : -1.8)); /* n^-3 and n^-2 up to powers of log n */
    }
}

/* No function fares worse than e times plain where t = 0 (Owen 1997, SIAM J. Numer. Anal.), here also at t > 0 and for n that is no power of 2. */
static void steps_fare_no_worse_than_plain(void **state)
{
    (void)state;
    enum { REPEATS = 400 };
    const double p = 1.0 / 6;
    const size_t ns[] = {1, 4, 64, 100, 256};
    for (int j = 0; j < 5; j++) {
        spread s = spread_of(step, FW_SCRAMBLE_OWEN, ns[j], REPEATS);
        double plain = p * (1 - p) / (double)ns[j];
        print_message("step, n %4zu: variance %.2f of plain\n", ns[j], s.variance / plain);
        assert_true(fabs(s.mean - p) < 4 * sqrt(plain / REPEATS));
        assert_true(s.variance < exp(1) * plain);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_points),
        cmocka_unit_test(far_points),
        cmocka_unit_test(gsl_agrees_where_it_can),
        cmocka_unit_test(directions_follow_primitive_polynomials),
        cmocka_unit_test(one_point_per_interval),
        cmocka_unit_test(pairs_stay_even),
        cmocka_unit_test(a_point_is_a_function_of_its_index),
        cmocka_unit_test(far_indices),
        cmocka_unit_test(each_point_is_uniform),
        cmocka_unit_test(common_leading_bits_stay_common),
        cmocka_unit_test(coins_are_fair_and_independent),
        cmocka_unit_test(smooth_means_converge_fast),
        cmocka_unit_test(steps_fare_no_worse_than_plain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
