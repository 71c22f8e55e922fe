/* Sums of years: their moments in closed form, simulated lives against them, the year in which a limit is passed. */
#include "statistics/lives.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "statistics/near.h"

#include "statistics/lognormal_windows.h"
#include "statistics/winters.h"

enum { YEARS = 50 };

/* 50 years of 800 windows. */
static fw_years even_years(fw_year *kinds, double cv)
{
    for (size_t k = 0; k < YEARS; k++) kinds[k] = (fw_year){800, 1};
    return (fw_years){.n_years = YEARS, .n = YEARS, .kinds = kinds, .cv = cv};
}

static double life_cv(const fw_life_spread *l, const fw_scores *s) { return fw_life_spread_sd(l, s->mean, s->variance) / (l->windows * s->mean); }

/* Windows of CV 1.5, 800 a year, 50 years: 1.5/sqrt(40000) when all are independent; the rule that independent windows understate a life's
 * scatter ten-fold gives 0.8 % against 7.9 %. */
static void independent_windows_understate_the_scatter_tenfold(void **state)
{
    (void)state;
    fw_scores s;
    fw_year   kinds[YEARS];
    lognormal_scores(&s);
    fw_years       plain = even_years(kinds, 0), both = even_years(kinds, 0.4);
    fw_life_spread a = fw_life_spread_make(&plain, &s, 0), b = fw_life_spread_make(&both, &s, 0.97);
    assert_near(life_cv(&a, &s), 0.0075, 1e-12);
    assert_near(life_cv(&a, &s), 0.008, 0.1);
    assert_near(life_cv(&b, &s), 0.079, 0.1);
    assert_near(a.windows, 40000, 1e-12);
}

/* F and S independent: var(F S) = E F^2 var S + var F (E S)^2. */
static void moments_of_a_product(void **state)
{
    (void)state;
    fw_scores s;
    fw_year   kinds[YEARS];
    lognormal_scores(&s);
    fw_years       y = even_years(kinds, 0.4);
    fw_life_spread l = fw_life_spread_make(&y, &s, 0.97);
    double         var_sum = s.variance * fw_scores_sum(&s, 0.97, 800), sum = 800 * s.mean;
    assert_near(pow(fw_life_spread_sd(&l, s.mean, s.variance), 2), YEARS * (1.16 * var_sum + 0.16 * sum * sum), 1e-10);

    /* drawn from a table of two rows: law of total variance over 50 draws */
    const fw_year  rows[] = {{400, 1}, {800, 2}};
    const fw_years table = {.n_years = YEARS, .is_table = true, .n = 2, .kinds = rows};
    fw_life_spread t = fw_life_spread_make(&table, &s, 0.97);
    assert_near(t.windows, YEARS * (400 + 1600) / 2, 1e-12);
    double within = 0.5 * (s.variance * fw_scores_sum(&s, 0.97, 400) + 4 * var_sum), between = 600 * 600 * s.mean * s.mean;
    assert_near(pow(fw_life_spread_sd(&t, s.mean, s.variance), 2), YEARS * (within + between), 1e-10);
}

typedef struct told {
    double mean, variance, n, depths[2 * 3], scaled[2 * 3], used[YEARS], used_scaled[YEARS];
} told;

static void simulate(const fw_years *y, const fw_scores *s, double phi, double limit, double scale, told *out)
{
    fw_lives     l;
    fw_winters   w;
    const double ps[] = {0.5, 0.9, 0.99};
    const size_t fan[] = {10, YEARS};
    assert_int_equal(fw_lives_make(&l, y, NULL), FW_OK);
    assert_int_equal(fw_winters_make(&w, 3, phi, l.lengths[l.n_lengths - 1], NULL), FW_OK);
    assert_int_equal(fw_lives_draw(&l, 3, w.n_winters, NULL), FW_OK);
    double *sums = calloc(l.n_lengths * w.n_winters, sizeof *sums), *work = calloc(3 * l.n_lives, sizeof *work),
           *scales = calloc(l.n_lives, sizeof *scales);
    for (size_t i = 0; i < l.n_lives; i++) scales[i] = scale;
    fw_winters_sum(&w, s, l.n_lengths, l.lengths, sums);
    fw_lives_ask ask = {.n_percentiles = 3, .percentiles = ps, .n_fan = 2, .fan = fan, .limit = limit, .scale = scales};
    fw_lives_run(&l, &ask, sums, work, out->depths, out->scaled, out->used, out->used_scaled);
    out->n = (double)l.n_lives, out->mean = out->variance = 0;
    for (size_t i = 0; i < l.n_lives; i++) out->mean += work[i] / out->n;
    for (size_t i = 0; i < l.n_lives; i++) out->variance += pow(work[i] - out->mean, 2) / out->n;
    free(sums), free(work), free(scales);
    fw_winters_free(&w), fw_lives_free(&l);
}

static void simulated_lives_have_the_moments(void **state)
{
    (void)state;
    fw_scores      s;
    fw_year        kinds[YEARS];
    const fw_year  rows[] = {{400, 1}, {0, 1}, {800, 2}};
    fw_years       of[] = {even_years(kinds, 0.4), even_years(kinds, 0), {.n_years = YEARS, .is_table = true, .n = 3, .kinds = rows}};
    lognormal_scores(&s);
    for (size_t k = 0; k < 3; k++) {
        told           t;
        fw_life_spread l = fw_life_spread_make(&of[k], &s, 0.97);
        simulate(&of[k], &s, 0.97, 0, 1, &t);
        double mean = l.windows * s.mean, sd = fw_life_spread_sd(&l, s.mean, s.variance);
        /* of a variance with next to no excess kurtosis: sqrt(2/n); it is below 1 here */
        assert_true(fabs(t.mean - mean) < 4 * sd / sqrt(t.n));
        assert_true(fabs(t.variance / (sd * sd) - 1) < 4 * sqrt(3 / t.n));
        assert_true(t.depths[3] < t.depths[4] && t.depths[4] < t.depths[5] && t.depths[1] < t.depths[3]);
    }
}

/* Windows that do not scatter: every year wears 800. */
static double constant_depth(const void *self, double score)
{
    (void)self, (void)score;
    return 1;
}

static void the_year_of_the_limit(void **state)
{
    (void)state;
    fw_scores s;
    fw_year   kinds[YEARS];
    told      t;
    fw_years  y = even_years(kinds, 0);
    assert_int_equal(fw_scores_make(&s, constant_depth, NULL, 1, 0, NULL), FW_OK);
    simulate(&y, &s, 0.5, 800 * 20.5, 2, &t); /* year 21, and 11 at twice the rate */
    for (size_t k = 0; k < YEARS; k++) assert_true(t.used[k] == (k == 20) && t.used_scaled[k] == (k == 10));
    for (size_t k = 0; k < 6; k++) assert_true(t.depths[k] == (k < 3 ? 8000 : 40000) && t.scaled[k] == 2 * t.depths[k]);

    lognormal_scores(&s);
    y = even_years(kinds, 0.4);
    fw_life_spread l = fw_life_spread_make(&y, &s, 0.97);
    simulate(&y, &s, 0.97, l.windows * s.mean, 1, &t); /* a life of the mean depth: half of them, a little less as lives are skew */
    double all = 0;
    for (size_t k = 0; k < YEARS; k++) all += t.used[k];
    assert_true(all > 0.45 && all < 0.5 && t.used[0] == 0 && t.used[YEARS - 1] > 0.02);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    fw_lives l;
    fw_year  kinds[YEARS];
    fw_years y = even_years(kinds, 0);
    y.n = 3;
    assert_int_equal(fw_lives_make(&l, &y, NULL), FW_E_ARG);
    y = even_years(kinds, 0);
    y.n_years = 0;
    assert_int_equal(fw_lives_make(&l, &y, NULL), FW_E_ARG);
    y = even_years(kinds, 0);
    y.is_table = true, y.n = FW_LIVES_KINDS + 1;
    assert_int_equal(fw_lives_make(&l, &y, NULL), FW_E_ARG);
    y = even_years(kinds, 0);
    assert_int_equal(fw_lives_make(&l, &y, NULL), FW_OK);
    assert_int_equal(fw_lives_draw(&l, 1, 70000, NULL), FW_E_ARG);
    fw_lives_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(independent_windows_understate_the_scatter_tenfold), cmocka_unit_test(moments_of_a_product),
                                       cmocka_unit_test(simulated_lives_have_the_moments), cmocka_unit_test(the_year_of_the_limit),
                                       cmocka_unit_test(nonsense_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
