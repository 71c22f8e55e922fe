#include "abrasion/interval_rates.h"
#include "geometry/lens.h"

/* Wear rules against fine quadratures. */

static void rates(const fw_wear_interval *iv, double m, double u, double *along, double *wall)
{
    double n, s, d;
    values_at(iv, u, &n, &s, &d);
    *along = *wall = 0;
    if (!(n > 0) || !(d > 0)) return;
    double b = fw_lens_chord(d, iv->radius, RS);
    *along = pow(n / (b * iv->thickness), m) * fabs(s), *wall = *along * b;
}

/* Midpoints in y, t = y^k, which takes any t^(-m/2) with m < 2 - 2/k, many of them. */
static void fine(const fw_wear_interval *iv, double m, double *along, double *wall)
{
    enum { N = 60000 };
    double k = fmax(3, 3 / (1 - 0.5 * m)), y0 = pow(iv->since_touch, 1 / k),
           y1 = pow(iv->since_touch + iv->length, 1 / k);
    *along = *wall = 0;
    for (int i = 0; i < N; i++) {
        double y = y0 + (y1 - y0) * (i + 0.5) / N, t = pow(y, k), a, w;
        rates(iv, m, (t - iv->since_touch) / iv->length, &a, &w);
        double dt = k * t / y * (y1 - y0) / N;
        *along += a * dt, *wall += w * dt;
    }
}

static void by_nodes(fw_rule *r, const fw_wear_interval *iv, size_t l, double *along, double *wall)
{
    fw_rule_nodes at;
    fw_rule_apply(r, FW_WEAR_HERMITE, iv, &at);
    *along = *wall = 0;
    for (size_t q = 0; q < at.n; q++) {
        double breadth = fw_lens_chord(at.depth[q], iv->radius, RS) / at.lift[q];
        double rate = pow(at.normal[q] / (breadth * iv->thickness), r->exponent[l]) * fabs(at.slip[q]);
        *along += rate * at.along[l][q], *wall += rate * breadth * at.wall[l][q];
        assert_true(at.wall[l][q] > 0 && at.wide[q] > 0); /* a negative deposit would show on the ring */
    }
}

/* First step 0.05/w and growth 3 is what the kernel takes after a touch; 1.5 and a longer first step beside it. */
static void any_laws_after_a_touch(void **state)
{
    (void)state;
    static const double M[2][4] = {{1.121, 1.9, 0.3, 1.0}, {0.02, 1.5, 1.8, 0.7}};
    static const double FIRST[] = {0.05, 0.05, 0.2, 1e-4}, GROWTH[] = {3, 1.5, 3, 3};
    for (int laws = 0; laws < 2; laws++)
        for (int c = 0; c < 4; c++) {
            fw_rule r;
            fw_rule_init(&r, 4, M[laws]);
            double t = 0, h = FIRST[c] / omega();
            for (int step = 0; step < 4; step++, t += h, h *= GROWTH[c]) {
                if ((t + h) * omega() > 2) break;
                fw_wear_interval iv = interval(t, t + h);
                for (size_t l = 0; l < 4; l++) {
                    double a, w, fa, fw;
                    fine(&iv, M[laws][l], &fa, &fw);
                    by_nodes(&r, &iv, l, &a, &w);
                    CHECK_RELATIVE(a, fa, c == 0 ? 1e-5 : 1e-4);
                    CHECK_RELATIVE(w, fw, c == 0 ? 1e-5 : 1e-4);
                }
            }
        }
    /* beyond what a midpoint sum can follow: t^(-0.9995); the integral of t^(e-1) times a constant is known */
    fw_rule r;
    fw_rule_init(&r, 1, (double[]){1.999});
    fw_wear_interval iv = interval(0, 1e-9);
    double           a, w, p = force_at(0) / (H * 2 * sqrt(2 * V / (1 / R + 1 / RS))), e = 1 - 0.5 * 1.999;
    by_nodes(&r, &iv, 0, &a, &w);
    CHECK_RELATIVE(a, pow(p, 1.999) * slip_at(0) * pow(1e-9, e) / e, 1e-5);
}

/* Force that fades through zero inside the interval, with and without a touch just before, and slip that turns round. */
static void fading_and_turning(void **state)
{
    (void)state;
    static const double M[4] = {0.3, 1.0, 1.121, 1.9};
    fw_rule             r;
    fw_rule_init(&r, 4, M);
    fw_wear_interval ivs[] = {interval(0.65 / omega(), 2.4 / omega()), interval(1.6 / omega(), 2.1 / omega()),
                              interval(1.5 / omega(), 1.9 / omega()),  interval(0.2 / omega(), 0.5 / omega()),
                              interval(1.2 / omega(), 1.5 / omega()),  interval(1.0 / omega(), 1.3 / omega())};
    for (int q = 0; q < 3; q++) {
        ivs[3].slip[q] = 0.1 - 0.25 * STAGE[q];
        ivs[4].slip[q] = 0.2 * STAGE[q] - 0.03;
        ivs[5].normal[q] = 3e5 * (STAGE[q] - 0.2); /* comes back */
    }
    for (int i = 0; i < 6; i++)
        for (size_t l = 0; l < 4; l++) {
            double a, w, fa, fw;
            fine(&ivs[i], M[l], &fa, &fw);
            by_nodes(&r, &ivs[i], l, &a, &w);
            CHECK_RELATIVE(a, fa, 1e-4);
            CHECK_RELATIVE(w, fw, 1e-4);
        }
}

/* The short way is taken for smooth intervals only, and is the same rule. */
static void smooth_is_the_same(void **state)
{
    (void)state;
    fw_rule        r;
    fw_rule_smooth s;
    fw_rule_nodes  at;
    fw_rule_init(&r, 1, (double[]){1.121});
    fw_wear_interval iv = interval(0.9 / omega(), 1.1 / omega());
    for (int rule = FW_WEAR_HERMITE; rule <= FW_WEAR_SINGULAR; rule++) {
        assert_true(fw_rule_is_smooth(&r, (fw_wear_rule)rule, &iv, &s));
        fw_rule_apply(&r, (fw_wear_rule)rule, &iv, &at);
        assert_int_equal(at.n, 3);
        for (size_t q = 0; q < 3; q++) {
            CHECK_RELATIVE(s.normal[q], at.normal[q], 1e-13);
            CHECK_RELATIVE(s.slip[q], at.slip[q], 1e-13);
            CHECK_RELATIVE(s.depth[q], at.depth[q], 1e-13);
            assert_true(at.along[0][q] == at.dt[q] && at.wall[0][q] == at.dt[q] && at.wide[q] == at.dt[q]);
        }
    }
    /* three nodes are enough at the limit where the short way begins, for the worst law */
    static const double M[4] = {0.3, 1.0, 1.121, 1.9};
    fw_rule_init(&r, 4, M);
    iv = interval(0.4 / omega(), 0.6 / omega());
    for (size_t l = 0; l < 4; l++) {
        double a, w, fa, fw;
        fine(&iv, M[l], &fa, &fw);
        by_nodes(&r, &iv, l, &a, &w);
        CHECK_RELATIVE(a, fa, 1e-5);
        CHECK_RELATIVE(w, fw, 1e-5);
    }
    assert_false(fw_rule_is_smooth(&r, FW_WEAR_HERMITE, &(fw_wear_interval){.length = 1, .n_stages = 3}, &s));
    iv.slip[2] = -iv.slip[2];
    assert_false(fw_rule_is_smooth(&r, FW_WEAR_HERMITE, &iv, &s));
    for (int q = 0; q < 3; q++) iv.slip[q] = 0;
    fw_rule_apply(&r, FW_WEAR_HERMITE, &iv, &at);
    assert_int_equal(at.n, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_laws_after_a_touch), cmocka_unit_test(fading_and_turning),
                                       cmocka_unit_test(smooth_is_the_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
