/* Cheap models beside a dear one: closed forms on pairs whose correlation is exact, limits, Giles's checks, coverage of the interval on normal and
 * skew pairs, and the promise kept by the estimate itself. */
#include "statistics/coupled.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

enum { MOST = 512 };

typedef struct pairs {
    double dear[MOST], cheap[MOST], dear_cost[MOST], cheap_cost[MOST];
} pairs;

static double normal(fw_random *r) { return gsl_cdf_ugaussian_Pinv(fw_random_uniform(r)); }

static fw_coupled compare(const pairs *p, size_t n, const fw_paired_draws *draws)
{
    fw_coupled_pairs x = {n, p->dear, p->cheap, p->dear_cost, p->cheap_cost};
    fw_coupled       out;
    assert_int_equal(fw_coupled_compare(&x, draws, 0.95, &out, NULL), FW_OK);
    return out;
}

static fw_paired_draws make_draws(size_t n)
{
    fw_paired_draws d;
    assert_int_equal(fw_paired_draws_make(&d, n, 1, NULL), FW_OK);
    return d;
}

static void set_costs(pairs *p, size_t n, double ratio)
{
    for (size_t i = 0; i < n; i++) p->dear_cost[i] = 3, p->cheap_cost[i] = 3 / ratio;
}

/* Two orthogonal patterns of signs: the correlation of the sample is exactly rho, the cheap value's scatter s times the dear one's. */
static void set_exact(pairs *p, size_t n, double rho, double s)
{
    for (size_t i = 0; i < n; i++) {
        double a = i % 2 ? -1 : 1, b = i % 4 < 2 ? 1 : -1;
        p->dear[i] = 5 * a, p->cheap[i] = 5 * s * (rho * a + sqrt(1 - rho * rho) * b);
    }
}

static void closed_forms(void **state)
{
    (void)state;
    static pairs    p;
    fw_paired_draws d = make_draws(256);
    const double    RHO[] = {0.3, 0.9, -0.99, 0.999}, RATIO[] = {2, 10, 1000}, S[] = {1, 0.5};
    for (size_t i = 0; i < 4; i++)
        for (size_t j = 0; j < 3; j++)
            for (size_t k = 0; k < 2; k++) {
                double rho = RHO[i], w = RATIO[j], s = S[k];
                set_exact(&p, 256, rho, s);
                set_costs(&p, 256, w);
                fw_coupled c = compare(&p, 256, &d);
                assert_near(c.correlation, rho, 1e-12);
                assert_near(c.cost_ratio, w, 1e-12);
                /* V = 1, budget 1 at dear cost 1: n dear ones and m cheap ones with n + m / w = 1 and the least (1 - rho^2) / n + rho^2 / m */
                double best = INFINITY;
                for (double n = 1e-4; n < 1; n += 1e-4) best = fmin(best, (1 - rho * rho) / n + rho * rho / ((1 - n) * w));
                assert_near(c.multifidelity.gain, 1 / best, 2e-3);
                double difference = 1 + s * s - 2 * rho * s, both = sqrt(s * s / w) + sqrt(difference * (1 + 1 / w));
                assert_near(c.multilevel.gain, 1 / (both * both), 1e-10);
                assert_true(c.multilevel.gain < c.multifidelity.gain * (1 + 1e-12));
            }
    fw_paired_draws_free(&d);
}

static void limits(void **state)
{
    (void)state;
    static pairs    p;
    fw_paired_draws d = make_draws(256);
    fw_random       r;
    fw_coupled      c;
    fw_random_stream(&r, 3, FW_STREAM_TEST, 0, 0);
    /* the same: worth what it costs less, known exactly */
    for (size_t i = 0; i < 256; i++) p.dear[i] = p.cheap[i] = normal(&r);
    set_costs(&p, 256, 10);
    c = compare(&p, 256, &d);
    assert_near(c.multifidelity.gain, 10, 1e-6);
    assert_near(c.multifidelity.low, 10, 1e-6);
    assert_near(c.multifidelity.high, 10, 1e-6);
    assert_near(c.multilevel.gain, 10, 1e-10);
    assert_true(c.kurtosis == 1 && c.consistency < 1);
    /* unrelated: a loss */
    for (size_t i = 0; i < 256; i++) p.cheap[i] = normal(&r);
    c = compare(&p, 256, &d);
    assert_true(c.multifidelity.gain < 1 && c.multifidelity.high < 1.1 && c.multilevel.gain < 0.5);
    /* for nothing: 1 / (1 - rho^2), the regression's */
    set_exact(&p, 256, 0.8, 1);
    for (size_t i = 0; i < 256; i++) p.cheap_cost[i] = 0;
    c = compare(&p, 256, &d);
    assert_true(isinf(c.cost_ratio));
    assert_near(c.multifidelity.gain, 1 / 0.36, 1e-12);
    /* a constant explains nothing and scatters nothing */
    for (size_t i = 0; i < 256; i++) p.cheap[i] = 0;
    c = compare(&p, 256, &d);
    assert_true(c.correlation == 0 && c.multifidelity.gain == 1);
    for (size_t i = 0; i < 256; i++) p.dear[i] = 0;
    c = compare(&p, 256, &d);
    assert_true(isnan(c.multifidelity.gain) && isnan(c.multifidelity.low) && isnan(c.multilevel.gain));
    fw_paired_draws_free(&d);
}

static void checks_of_giles(void **state)
{
    (void)state;
    static pairs    p;
    fw_paired_draws d = make_draws(256);
    fw_random       r;
    fw_random_stream(&r, 4, FW_STREAM_TEST, 0, 0);
    for (size_t i = 0; i < 256; i++) p.cheap[i] = normal(&r), p.dear[i] = p.cheap[i] + 0.1 * normal(&r);
    set_costs(&p, 256, 20);
    fw_coupled c = compare(&p, 256, &d);
    assert_near(c.kurtosis, 3, 0.3); /* of a normal law */
    assert_true(c.most_kurtosis == 64 && c.consistency < 1);
    p.dear[17] += 20; /* one pair carries the difference: n */
    c = compare(&p, 256, &d);
    assert_true(c.kurtosis > 200 && c.kurtosis < 256 && c.kurtosis > c.most_kurtosis);
    /* levels that do not add up: the cheap one of every third pair is another model */
    p.dear[17] -= 20;
    for (size_t i = 1; i < 256; i += 3) p.cheap[i] += 5;
    assert_true(compare(&p, 256, &d).consistency > 1);
    fw_paired_draws_free(&d);
    pairs few = {.dear = {1, 2}, .cheap = {1, 3}, .dear_cost = {1, 1}, .cheap_cost = {1, 1}};
    d = make_draws(2);
    assert_true(isnan(compare(&few, 2, &d).consistency));
    fw_coupled_pairs x = {1, few.dear, few.cheap, few.dear_cost, few.cheap_cost};
    assert_int_equal(fw_coupled_compare(&x, &d, 0.95, &c, NULL), FW_E_ARG);
    fw_paired_draws_free(&d);
}

/* Normal values, or skew ones: exp(Z) less its mean, correlated by exp(rho) - 1 over exp(1) - 1. */
static void coverage(void **state)
{
    (void)state;
    enum { REPEATS = 500 };
    static pairs p;
    const size_t N[] = {128, 384};
    const double RHO[] = {0.5, 0.95};
    for (size_t k = 0; k < 2; k++) {
        fw_paired_draws d = make_draws(N[k]);
        set_costs(&p, N[k], 10);
        for (size_t j = 0; j < 4; j++) {
            bool   is_skew = j > 1;
            double rho = RHO[j % 2], truth = fw_coupled_gain(is_skew ? expm1(rho) / expm1(1) : rho, 10);
            size_t covered = 0;
            for (uint64_t repeat = 0; repeat < REPEATS; repeat++) {
                fw_random r;
                fw_random_stream(&r, 8, FW_STREAM_TEST, repeat, j);
                for (size_t i = 0; i < N[k]; i++) {
                    double a = normal(&r), b = rho * a + sqrt(1 - rho * rho) * normal(&r);
                    p.dear[i] = is_skew ? exp(a) - exp(0.5) : a, p.cheap[i] = is_skew ? exp(b) - exp(0.5) : b;
                }
                fw_coupled c = compare(&p, N[k], &d);
                covered += c.multifidelity.low <= truth && truth <= c.multifidelity.high;
            }
            double share = (double)covered / REPEATS;
            print_message("%s pairs, n = %zu, rho %.2f: interval of a gain of %.2f covers it in %.1f %%\n", is_skew ? "skew" : "normal", N[k], rho, truth, 100 * share);
            assert_true(share > (is_skew ? 0.86 : 0.9) && share < 0.99);
        }
        fw_paired_draws_free(&d);
    }
}

/* What is promised is what comes out: the estimate with the best division, repeated. */
static void promise_is_kept(void **state)
{
    (void)state;
    enum { REPEATS = 4000, N_DEAR = 20 };
    const double rho = 0.95, w = 20;
    double       ratio = sqrt(w * rho * rho / (1 - rho * rho)); /* cheap ones for each dear one */
    size_t       n_cheap = (size_t)lround(ratio * N_DEAR);
    double       sum = 0, squares = 0, cost = N_DEAR + (double)n_cheap / w;
    for (uint64_t repeat = 0; repeat < REPEATS; repeat++) {
        fw_random r;
        double    few = 0, many = 0;
        fw_random_stream(&r, 9, FW_STREAM_TEST, repeat, 0);
        for (size_t i = 0; i < n_cheap; i++) {
            double b = normal(&r);
            many += rho * b / (double)n_cheap;
            if (i < N_DEAR) few += sqrt(1 - rho * rho) * normal(&r) / N_DEAR;
        }
        sum += few + many, squares += (few + many) * (few + many);
    }
    double variance = squares / REPEATS - (sum / REPEATS) * (sum / REPEATS), alone = 1 / cost;
    assert_near(alone / variance, fw_coupled_gain(rho, w), 0.1); /* 4 sqrt(2 / REPEATS) */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(closed_forms), cmocka_unit_test(limits), cmocka_unit_test(checks_of_giles),
                                       cmocka_unit_test(coverage), cmocka_unit_test(promise_is_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
