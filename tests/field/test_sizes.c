/* Law of floe sizes. Expected values: densities integrated numerically here (Simpson's rule), independent of the closed
 * forms under test; the ends of the range from the criterion by hand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "field/field_mixes.h"
#include "field/sizes.h"

static const double PI = 3.14159265358979323846;

/* Unnormalised density of the diameter, as scenario.h states the laws. */
static double density(fw_size_law law, double a, double b, double d)
{
    if (law == FW_SIZE_POWER_LAW) return pow(d, -a);
    if (law == FW_SIZE_LOGNORMAL) return exp(-0.5 * (log(d) - a) * (log(d) - a) / (b * b)) / d;
    return 1.0;
}

static double integral(fw_size_law law, double a, double b, double from, double to, int power)
{
    enum { N = 20000 };
    double sum = 0.0, h = (to - from) / N;
    for (int i = 0; i <= N; i++) {
        double d = from + i * h, w = i == 0 || i == N ? 1.0 : i % 2 ? 4.0 : 2.0;
        sum += w * density(law, a, b, d) * pow(d, power);
    }
    return sum * h / 3.0;
}

static const struct {
    fw_size_law law;
    double      a, b;
} laws[] = {
    {FW_SIZE_UNIFORM, 0, 0},       {FW_SIZE_POWER_LAW, 0.0, 0},    {FW_SIZE_POWER_LAW, 1.0, 0},
    {FW_SIZE_POWER_LAW, 2.0, 0},   {FW_SIZE_POWER_LAW, 3.0, 0},    {FW_SIZE_POWER_LAW, 1.8, 0},
    {FW_SIZE_POWER_LAW, -2.5, 0},  {FW_SIZE_POWER_LAW, 100.0, 0},  {FW_SIZE_POWER_LAW, 1.0 + 1e-9, 0},
    {FW_SIZE_LOGNORMAL, 1.4, 0.4}, {FW_SIZE_LOGNORMAL, -0.5, 0.5}, {FW_SIZE_LOGNORMAL, 3.5, 0.6},
    {FW_SIZE_LOGNORMAL, 1.2, 5.0}, {FW_SIZE_LOGNORMAL, 1.5, 0.02},
};
enum { N_LAWS = sizeof laws / sizeof laws[0] };

static void moments_are_those_of_the_density(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_single(0.5);
    for (int k = 0; k < N_LAWS; k++) {
        fw_sizes s;
        fw_msg   m;
        assert_int_equal(fw_sizes_init(&s, &mix, laws[k].law, laws[k].a, laws[k].b, &m), FW_OK);
        double lo = 2.0, hi = sqrt(54.0), mass = integral(laws[k].law, laws[k].a, laws[k].b, lo, hi, 0);
        for (int power = 1; power <= 2; power++) {
            double wanted = integral(laws[k].law, laws[k].a, laws[k].b, lo, hi, power) / mass;
            assert_true(fabs(fw_sizes_moment(&s, 0, power) / wanted - 1.0) < 1e-7);
        }
        assert_true(fabs(s.mean_area / (0.25 * PI * fw_sizes_moment(&s, 0, 2)) - 1.0) < 1e-14);
    }
}

static void quantiles_invert_the_distribution(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_single(0.5);
    for (int k = 0; k < N_LAWS; k++) {
        fw_sizes s;
        fw_msg   m;
        assert_int_equal(fw_sizes_init(&s, &mix, laws[k].law, laws[k].a, laws[k].b, &m), FW_OK);
        double lo = 2.0, hi = sqrt(54.0), mass = integral(laws[k].law, laws[k].a, laws[k].b, lo, hi, 0), last = lo;
        for (double v = 0.01; v < 1.0; v += 0.07) {
            double d = fw_sizes_quantile(&s, 0, v);
            assert_true(d >= last && d <= hi);
            last = d;
            assert_true(fabs(integral(laws[k].law, laws[k].a, laws[k].b, lo, d, 0) / mass - v) < 1e-7);
        }
    }
}

static void ends_are_those_of_the_criterion(void **state)
{
    (void)state;
    fw_sizes         s;
    fw_msg           m;
    fw_thickness_mix mix = mix_paper(false);
    assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_OK);
    assert_true(fabs(s.min_diameter - 2.0) < 1e-15);         /* 4 x 0.5 */
    assert_true(fabs(s.max_diameter - sqrt(158.0)) < 1e-12); /* 130 x 1.3 - 11 */
    /* Mean of the middles: (2 + 7.34847 + 2.8 + 8.94427 + 3.6 + 10.29563 + 4.4 + 11.48913 + 5.2 + 12.56981) / 10 */
    assert_true(fabs(s.mean_diameter - 6.864731) < 1e-6);

    static const double limits[] = {0.0855, 8.04};
    for (int k = 0; k < 2; k++) {
        mix = mix_single(limits[k]);
        assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_LOGNORMAL, 1.0, 0.3, &m), FW_OK);
        double d, h;
        fw_sizes_draw(&s, 0.3, &d, &h);
        assert_true(h == limits[k] && d <= sqrt(130.0 * h - 11.0) && fabs(d / (4.0 * h) - 1.0) < 0.01);
        assert_true(fabs(s.mean_diameter - d) < 1e-12 && fabs(s.mean_area - 0.25 * PI * d * d) < 1e-9);
    }
}

static void shares_by_area_come_back_as_area(void **state)
{
    (void)state;
    fw_sizes         s;
    fw_msg           m;
    fw_thickness_mix mix = mix_paper(true);
    mix.classes[0].share = 0.5, mix.classes[4].share = 0.0, mix.classes[1].share = 0.1;
    assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_POWER_LAW, 1.5, 0, &m), FW_OK);
    double total = 0.0;
    for (size_t k = 0; k < 5; k++) {
        double area = s.classes[k].share * 0.25 * PI * fw_sizes_moment(&s, k, 2) / s.mean_area;
        assert_true(fabs(area - mix.classes[k].share) < 1e-12);
        total += s.classes[k].share;
    }
    assert_true(fabs(total - 1.0) < 1e-14);
    assert_true(fabs(s.max_diameter - sqrt(130.0 * 1.1 - 11.0)) < 1e-12); /* the class without floes does not count */
}

static void every_q_draws_from_its_class(void **state)
{
    (void)state;
    fw_sizes         s;
    fw_msg           m;
    fw_thickness_mix mix = {.n_classes = 4, .classes = {{0.3, 0.0}, {0.5, 0.25}, {0.7, 0.0}, {0.9, 0.75}}};
    assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_OK);
    for (double q = 0.0; q <= 1.0; q += 1.0 / 64.0) {
        double d, h, v = q < 0.25 ? 4.0 * q : (q - 0.25) / 0.75;
        fw_sizes_draw(&s, q, &d, &h);
        double lo = q < 0.25 ? 2.0 : 3.6, hi = q < 0.25 ? sqrt(54.0) : sqrt(106.0);
        assert_true(h == (q < 0.25 ? 0.5 : 0.9));
        assert_true(fabs(d - (lo + v * (hi - lo))) < 1e-12);
    }
}

static void bad_laws_are_refused(void **state)
{
    (void)state;
    static const double bad_thickness[] = {0.0, -1.0, 0.0854, 8.05, 1e300, NAN, INFINITY};
    fw_sizes            s;
    fw_msg              m;
    fw_thickness_mix    good = mix_paper(false), mix;
    for (size_t k = 0; k < sizeof bad_thickness / sizeof *bad_thickness; k++) {
        mix = mix_single(bad_thickness[k]);
        m.text[0] = 0;
        assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_E_ARG);
        assert_non_null(strstr(m.text, "thickness class"));
    }
    static const double bad_share[] = {-0.1, 0.3, 0.2001, 2.0, NAN, INFINITY};
    for (size_t k = 0; k < sizeof bad_share / sizeof *bad_share; k++) {
        mix = good;
        mix.classes[2].share = bad_share[k];
        assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_E_ARG);
    }
    mix = good, mix.n_classes = 0;
    assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_E_ARG);
    mix.n_classes = FW_MAX_CLASSES + 1;
    assert_int_equal(fw_sizes_init(&s, &mix, FW_SIZE_UNIFORM, 0, 0, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, NULL, FW_SIZE_UNIFORM, 0, 0, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, FW_SIZE_POWER_LAW, NAN, 0, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, FW_SIZE_POWER_LAW, 101, 0, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, FW_SIZE_LOGNORMAL, 1.5, 0, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, FW_SIZE_LOGNORMAL, NAN, 1, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, (fw_size_law)77, 1, 1, &m), FW_E_ARG);
    assert_int_equal(fw_sizes_init(&s, &good, FW_SIZE_LOGNORMAL, 8.0, 0.2, NULL), FW_E_ARG); /* D about 3 km */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_are_those_of_the_density), cmocka_unit_test(quantiles_invert_the_distribution),
        cmocka_unit_test(ends_are_those_of_the_criterion),  cmocka_unit_test(shares_by_area_come_back_as_area),
        cmocka_unit_test(every_q_draws_from_its_class),     cmocka_unit_test(bad_laws_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
