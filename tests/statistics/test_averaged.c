/* Interval of a percentile of an averaged CDF: its limit, its existence, and its coverage on known laws. */
#include "statistics/averaged.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/calibrate.h"
#include "statistics/near.h"
#include "statistics/scale.h"

static void levels_pass_into_order_statistics(void **state)
{
    (void)state;
    /* ends exist from the n on from which the exact interval has them, and levels lie within one rank of the binomial ones */
    const struct {
        double p;
        size_t n;
    } limits[] = {{0.9, 36}, {0.95, 72}, {0.99, 368}};
    double low, high;
    for (size_t i = 0; i < 3; i++) {
        fw_averaged_levels((double)limits[i].n - 1, limits[i].p, 0.95, &low, &high);
        assert_true(isnan(high));
        fw_averaged_levels((double)limits[i].n, limits[i].p, 0.95, &low, &high);
        assert_true(high <= 1 && high > 1 - 1.0 / (double)limits[i].n);
    }
    double ranks[1000];
    for (size_t i = 0; i < 1000; i++) ranks[i] = (double)(i + 1);
    fw_interval exact = fw_order_interval(1000, ranks, 0, 0.9, 0.95);
    fw_averaged_levels(1000, 0.9, 0.95, &low, &high);
    assert_true(fabs(1000 * low - exact.low) <= 1 && fabs(1000 * high - exact.high) <= 1);
    fw_averaged_levels(0, 0.9, 0.95, &low, &high);
    assert_true(isnan(low) && isnan(high));
}

static void levels_are_those_of_the_normal_law_for_many(void **state)
{
    (void)state;
    double low, high, half = 1.959964 * sqrt(0.9 * 0.1 / 1e6); /* de Moivre; the next term is O(1/n) = 1e-6 */
    fw_averaged_levels(1e6, 0.9, 0.95, &low, &high);
    assert_near(0.9 - low, half, 0.01);
    assert_near(high - 0.9, half, 0.01);
}

static void effective_size(void **state)
{
    (void)state;
    /* F_i in {0, 1}: variance F (1 - F) / n; (1.959964 / 1.962341)^2 is lost by t(0.975, 999) */
    fw_averaged_at steps = {0.9, {.variance = 0.09 / 1000, .dof = 999}}, equal = {0.9, {.variance = 0, .dof = 999}},
                   unknown = {0.9, {.variance = NAN, .dof = NAN}};
    assert_near(fw_averaged_effective_size(&steps, 0.95), 1000 * pow(1.959964 / 1.962341, 2), 1e-5);
    assert_near(fw_averaged_effective_size(&equal, 0.95), 1e8, 0);
    assert_true(fw_averaged_effective_size(&unknown, 0.95) == 0);
}

/* ---- windows of known laws --------------------------------------------------------------------------------------- */

enum { N_DIRECTIONS = 4, REPEATS = 2000, MOST = 4000 };

/* Load on direction d: multiple[d] times a draw; T uniform. */
typedef struct plan {
    double coldest, warmest, weight[N_DIRECTIONS], multiple[N_DIRECTIONS];
} plan;

static const plan TEMPERATURE = {-12, -2, {1, 0, 0, 0}, {1, 1, 1, 1}}, NEARLY_PLAIN = {-11, -9, {1, 0, 0, 0}, {1, 1, 1, 1}},
                  ROSE = {-12, -2, {0.4, 0.3, 0.2, 0.1}, {0, 0.1, 1, 3}};

typedef struct sample {
    const plan     *plan;
    const fw_scale *scale;
    size_t          n;
    double          ln_load[MOST], plain[MOST], values[MOST];
    fw_units        units;
    const fw_calibration *calibration; /* NULL: none */
} sample;

static double own_cdf(const sample *s, double ln_load, double ln_depth)
{
    double sum = 0;
    for (int d = 0; d < N_DIRECTIONS; d++) {
        double multiple = s->plan->multiple[d];
        if (s->plan->weight[d] > 0) sum += s->plan->weight[d] * (multiple > 0 ? fw_scale_cdf_ln(s->scale, ln_depth - ln_load - log(multiple)) : 1);
    }
    return sum;
}

static double cdf(const sample *s, double ln_depth)
{
    double sum = 0;
    for (size_t i = 0; i < s->n; i++) sum += s->units.weight[i] * own_cdf(s, s->ln_load[i], ln_depth);
    return sum;
}

static double quantile(void *self, double level)
{
    double from = -12, to = 8;
    if (cdf(self, -1e3) >= level) return 0;
    for (int i = 0; i < 30; i++) {
        double mid = 0.5 * (from + to);
        if (cdf(self, mid) >= level * (1 - 1e-13))
            to = mid;
        else
            from = mid;
    }
    return exp(to);
}

static void at(void *self, double depth, fw_averaged_at *out)
{
    sample *s = self;
    double  scratch[64];
    out->cdf = cdf(s, log(depth));
    for (size_t i = 0; i < s->n; i++) s->values[i] = own_cdf(s, s->ln_load[i], log(depth));
    for (size_t i = 0; i < s->n && !s->calibration; i++) s->values[i] = (s->values[i] - out->cdf) * (double)s->n / ((double)s->n - 1);
    if (s->calibration) fw_calibration_residuals(s->calibration, s->values);
    out->spread = fw_spread_of(&s->units, s->values, scratch);
}

static fw_interval interval(sample *s, double level)
{
    fw_averaged x = {.at = at, .quantile = quantile, .self = s, .n = s->n};
    return fw_averaged_interval(&x, level, 0.95);
}

static fw_scale make_scale(const plan *p, fw_distribution *T)
{
    fw_scale scale;
    *T = (fw_distribution){.kind = FW_DIST_UNIFORM, .a = p->coldest, .b = p->warmest, .low = -INFINITY, .high = INFINITY};
    assert_int_equal(fw_scale_make(&scale, 1, 1.121, T, NULL), FW_OK);
    return scale;
}

static void start(sample *s, const plan *p, const fw_scale *scale, size_t n)
{
    s->plan = p, s->scale = scale, s->n = n, s->calibration = NULL;
    for (size_t i = 0; i < n; i++) s->plain[i] = 1 / (double)n;
    s->units = (fw_units){.n = n, .weight = s->plain, .n_units = n, .n_fitted = 1};
}

static double truth_of(sample *s, const plan *p, const fw_scale *scale, test_law law, double level)
{
    start(s, p, scale, MOST);
    for (size_t i = 0; i < MOST; i++) s->ln_load[i] = log(law_draw(law, ((double)i + 0.5) / MOST));
    return quantile(s, level);
}

/* 93 to 97 %, give or take two standard errors of 2000 repeats, 0.5 % each. Counted where both ends exist. */
static void check(const char *what, test_law law, size_t n, double level, int hit, int offered)
{
    double got = (double)hit / offered;
    if (!(got >= 0.92 && got <= 0.98)) fail_msg("%s, law %d, P%g at n = %zu: coverage %g", what, (int)law, 100 * level, n, got);
}

static void plain_coverage(const plan *p, const char *what, size_t n, double level)
{
    fw_distribution T;
    fw_scale        scale = make_scale(p, &T);
    sample         *s = malloc(sizeof *s);
    for (int law = 0; law < N_LAWS; law++) {
        double    truth = truth_of(s, p, &scale, (test_law)law, level);
        int       hit = 0, offered = 0;
        fw_random r;
        fw_random_stream(&r, 5, FW_STREAM_TEST, n, (uint64_t)law + 10 * (uint64_t)(100 * level));
        start(s, p, &scale, n);
        for (int repeat = 0; repeat < REPEATS; repeat++) {
            for (size_t i = 0; i < n; i++) s->ln_load[i] = log(law_draw((test_law)law, fw_random_uniform(&r)));
            fw_interval v = interval(s, level);
            hit += !(v.low > truth) && !(v.high < truth);
            offered += isfinite(v.low) && isfinite(v.high);
            if (!isfinite(v.low) || !isfinite(v.high)) hit -= !(v.low > truth) && !(v.high < truth);
        }
        assert_true(offered > 0.97 * REPEATS);
        check(what, (test_law)law, n, level, hit, offered);
    }
    free(s);
    fw_scale_free(&scale);
}

static void coverage_on_known_laws(void **state)
{
    (void)state;
    plain_coverage(&TEMPERATURE, "temperature", 40, 0.5);
    plain_coverage(&TEMPERATURE, "temperature", 60, 0.9);
    plain_coverage(&TEMPERATURE, "temperature", 400, 0.99);
    plain_coverage(&NEARLY_PLAIN, "nearly plain", 100, 0.9);
    plain_coverage(&NEARLY_PLAIN, "nearly plain", 120, 0.95);
    plain_coverage(&ROSE, "rose", 40, 0.9);
    plain_coverage(&ROSE, "rose", 100, 0.99);
}

/* ---- with a control variate, and in randomisations --------------------------------------------------------------- */

/* Load = scenario (a draw of the law) x ice (lognormal, 20 %); calibrated on straight functions between knots of the scenario's logarithm. */
enum { KNOTS = 6 };
static void hats(const double *knot, double x, double *values)
{
    for (int j = 0; j < KNOTS; j++) values[j] = 0;
    for (int j = 0; j + 1 < KNOTS; j++)
        if (x >= knot[j] && x < knot[j + 1]) values[j + 1] = (x - knot[j]) / (knot[j + 1] - knot[j]), values[j] = 1 - values[j + 1];
    if (x < knot[0]) values[0] = 1;
    if (x >= knot[KNOTS - 1]) values[KNOTS - 1] = 1;
}

/* By bisection on a grid: 8192 scenarios, ice in the three nodes of Gauss and Hermite (weights 1/6, 2/3, 1/6 at 0 and +-sqrt 3), right to the 5th moment. */
static double controlled_truth(sample *s, test_law law, double level)
{
    enum { LAW = 8192 };
    double from = -25, to = 25, *ln_load = malloc(LAW * sizeof *ln_load);
    for (int i = 0; i < LAW; i++) ln_load[i] = log(law_draw(law, (i + 0.5) / LAW));
    for (int k = 0; k < 36; k++) {
        double mid = 0.5 * (from + to), sum = 0;
        for (int i = 0; i < LAW; i++)
            for (int node = -1; node <= 1; node++) sum += (node ? 1.0 / 6 : 2.0 / 3) * own_cdf(s, ln_load[i] + node * 0.2 * sqrt(3), mid) / LAW;
        if (sum >= level)
            to = mid;
        else
            from = mid;
    }
    free(ln_load);
    return exp(to);
}

static void controlled_coverage(size_t n, double level, bool in_randomisations)
{
    enum { LAW = 8192 };
    fw_distribution T;
    fw_scale        scale = make_scale(&ROSE, &T);
    sample         *s = malloc(sizeof *s);
    double         *basis = malloc(n * KNOTS * sizeof *basis);
    int32_t        *unit = malloc(n * sizeof *unit);
    for (int law = 0; law < N_LAWS; law++) {
        double knot[KNOTS], totals[KNOTS] = {0}, values[KNOTS];
        for (int j = 0; j < KNOTS; j++) knot[j] = log(law_draw((test_law)law, fmin(0.9995, fmax(0.01, 1 - pow(1 - j / (KNOTS - 1.0), 2)))));
        for (int i = 0; i < LAW; i++) {
            hats(knot, log(law_draw((test_law)law, (i + 0.5) / LAW)), values);
            for (int j = 0; j < KNOTS; j++) totals[j] += values[j] / LAW;
        }
        start(s, &ROSE, &scale, n);
        double    truth = controlled_truth(s, (test_law)law, level), narrow = 0, wide = 0;
        int       hit = 0, offered = 0;
        fw_random r;
        fw_random_stream(&r, 6, FW_STREAM_TEST, n, (uint64_t)law + (in_randomisations ? 100 : 0));
        for (int repeat = 0; repeat < REPEATS; repeat++) {
            fw_calibration c;
            start(s, &ROSE, &scale, n);
            for (size_t i = 0; i < n; i++) {
                double scenario = log(law_draw((test_law)law, fw_random_uniform(&r)));
                s->ln_load[i] = scenario + 0.2 * gsl_cdf_ugaussian_Pinv(fw_random_uniform(&r));
                hats(knot, scenario, basis + i * KNOTS);
                unit[i] = (int32_t)(i % 32);
            }
            fw_interval bare = interval(s, level);
            assert_int_equal(fw_calibration_make(&c, n, s->plain, KNOTS, basis, totals, NULL), FW_OK);
            s->calibration = &c;
            s->units = (fw_units){.n = n, .weight = c.weight, .unit = in_randomisations ? unit : NULL, .n_units = in_randomisations ? 32 : n,
                                  .n_fitted = c.n_functions};
            fw_interval v = interval(s, level);
            if (isfinite(v.low) && isfinite(v.high)) hit += v.low <= truth && truth <= v.high, offered++;
            narrow += (v.high - v.low) / REPEATS, wide += (bare.high - bare.low) / REPEATS;
            fw_calibration_free(&c);
        }
        assert_true(offered > 0.97 * REPEATS);
        assert_true(!(narrow > 0.7 * wide));
        check(in_randomisations ? "controlled, in randomisations" : "controlled", (test_law)law, n, level, hit, offered);
    }
    free(unit);
    free(basis);
    free(s);
    fw_scale_free(&scale);
}

static void coverage_with_control_variates(void **state)
{
    (void)state;
    controlled_coverage(100, 0.9, false);
    controlled_coverage(400, 0.9, false);
    controlled_coverage(200, 0.99, false);
    controlled_coverage(400, 0.9, true);
}

static void failed_runs_open_both_ends(void **state)
{
    (void)state;
    fw_distribution T;
    fw_scale        scale = make_scale(&TEMPERATURE, &T);
    sample         *s = malloc(sizeof *s);
    start(s, &TEMPERATURE, &scale, 200);
    for (size_t i = 0; i < s->n; i++) s->ln_load[i] = log(lognormal_quantile(0.5, ((double)i + 0.5) / 200));
    fw_averaged x = {.at = at, .quantile = quantile, .self = s, .n = 200};
    fw_interval clean = fw_averaged_interval(&x, 0.9, 0.95);
    x.failed_share = 4.0 / 204;
    fw_interval few = fw_averaged_interval(&x, 0.9, 0.95);
    x.failed_share = 40.0 / 240;
    fw_interval many = fw_averaged_interval(&x, 0.9, 0.95);
    assert_true(few.low < clean.low && few.high > clean.high);
    assert_true(many.low < few.low && isnan(many.high));
    x.failed_share = 1;
    assert_true(isnan(fw_averaged_interval(&x, 0.9, 0.95).low));
    x.failed_share = 0, x.n = FW_AVERAGED_MIN_N - 1;
    assert_true(isnan(fw_averaged_interval(&x, 0.9, 0.95).coverage));
    free(s);
    fw_scale_free(&scale);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(levels_pass_into_order_statistics),
                                       cmocka_unit_test(levels_are_those_of_the_normal_law_for_many),
                                       cmocka_unit_test(effective_size),
                                       cmocka_unit_test(coverage_on_known_laws),
                                       cmocka_unit_test(coverage_with_control_variates),
                                       cmocka_unit_test(failed_runs_open_both_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
