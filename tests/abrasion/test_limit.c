#include "abrasion/interval_rates.h"
#include "abrasion/wear.h"
#include "geometry/lens.h"

/* Nodes under a crushing limit against fine quadratures. */

static void rates(const fw_wear_interval *iv, const fw_pressure_law *limit, double m, double u, double *along, double *wall)
{
    double n, s, d;
    values_at(iv, u, &n, &s, &d);
    *along = *wall = 0;
    if (!(n > 0) || !(d > 0)) return;
    double b = fw_lens_chord(d, iv->radius, RS), A = b * iv->thickness;
    *along = pow(fmin(n / A, limit->pressure * pow(A, -limit->exponent)), m) * fabs(s), *wall = *along * b;
}

/* Midpoints in y, t = y^16: a twentieth decade of time takes as many as the last. */
static void fine(const fw_wear_interval *iv, const fw_pressure_law *limit, double m, double *along, double *wall)
{
    enum { N = 12000 };
    double k = 16, y0 = pow(iv->since_touch, 1 / k), y1 = pow(iv->since_touch + iv->length, 1 / k);
    *along = *wall = 0;
    for (int i = 0; i < N; i++) {
        double y = y0 + (y1 - y0) * (i + 0.5) / N, t = pow(y, k), a, w;
        rates(iv, limit, m, (t - iv->since_touch) / iv->length, &a, &w);
        double dt = k * t / y * (y1 - y0) / N;
        *along += a * dt, *wall += w * dt;
    }
}

static void by_nodes(fw_rule *r, const fw_wear_interval *iv, size_t l, double *along, double *wall)
{
    fw_rule_nodes at;
    fw_rule_apply_limited(r, FW_WEAR_HERMITE, iv, &at);
    assert_true(at.n <= FW_RULE_NODES);
    *along = *wall = 0;
    for (size_t q = 0; q < at.n; q++) {
        double breadth = fw_lens_chord(at.depth[q], iv->radius, RS) / at.lift[q];
        double rate = pow(at.normal[q] / (breadth * iv->thickness), r->exponent[l]) * fabs(at.slip[q]);
        *along += rate * at.along[l][q], *wall += rate * breadth * at.wall[l][q];
        assert_true(at.wall[l][q] > 0 && at.wide[q] > 0); /* a negative deposit would show on the ring */
    }
}

static double worst_of(const fw_wear_interval *iv, const fw_pressure_law *limit, size_t n, const double *m)
{
    double  worst = 0;
    fw_rule r;
    fw_rule_init(&r, n, m);
    fw_rule_limit(&r, limit, RS);
    for (size_t l = 0; l < n; l++) {
        double a, w, fa, fw;
        if (m[l] * limit->exponent >= 2) continue;
        fine(iv, limit, m[l], &fa, &fw);
        by_nodes(&r, iv, l, &a, &w);

        worst = fmax(worst, fmax(fabs(a / fa - 1), fabs(w / fw - 1)));
    }
    return worst;
}

/* First steps as the kernel takes them after a touch. Limits from one that holds throughout to one passed within 1e-24 s. Steep laws cost the
 * polynomials more where the force fades at the end of a long step, as they do without a limit. */
static void after_a_touch(void **state)
{
    (void)state;
    static const double M[2][4] = {{1.121, 1.9, 0.5, 2}, {2.5, 3, 4, 1}}, GROWTH[] = {3, 1.5, 4};
    static const double FIRST[] = {0.05, 0.02, 0.1}, P0[] = {1e5, 1e6, 5e6, 2e7, 4e7, 1e8}, Q[] = {0, 0.4, 0.7};
    for (int laws = 0; laws < 2; laws++)
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 6 * 3; i++) {
                fw_pressure_law limit = {P0[i / 3], Q[i % 3]};
                double          t = 0, h = FIRST[c] / omega();
                for (int step = 0; step < 4; step++, t += h, h *= GROWTH[c]) {
                    if ((t + h) * omega() > 2) break;
                    fw_wear_interval iv = interval(t, t + h);
                    CHECK_NEAR(worst_of(&iv, &limit, 4, M[laws]), 0, laws == 0 ? 3e-5 : 1e-3);
                }
            }
}

/* Pressure that rises through the limit, or falls below it while the slip turns, or goes with a force that fades; and comes back. */
static void crossings_anywhere(void **state)
{
    (void)state;
    static const double M[4] = {0.5, 1.121, 1.9, 2.6};
    fw_wear_interval    ivs[] = {interval(1.0 / omega(), 1.3 / omega()), interval(0.65 / omega(), 2.4 / omega()), interval(0.9 / omega(), 1.1 / omega()),
                                 interval(1.2 / omega(), 1.5 / omega()), interval(1.0 / omega(), 1.3 / omega())};
    for (int q = 0; q < 3; q++) {
        ivs[0].normal[q] = 2e5 * (0.6 + STAGE[q]);                                           /* rises */
        ivs[2].slip[q] = 0.1 - 0.25 * STAGE[q];                                              /* turns */
        ivs[3].normal[q] = 3e5 * (STAGE[q] - 0.2);                                           /* comes back */
        ivs[4].normal[q] = 4e5 * (1 - 0.8 * STAGE[q] * (1 - STAGE[q])), ivs[4].slip[q] = -1; /* down and up again */
    }
    for (int i = 0; i < 5; i++)
        for (double P0 = 2e5; P0 < 5e6; P0 *= 1.3) {
            CHECK_NEAR(worst_of(&ivs[i], &(fw_pressure_law){P0, 0}, 4, M), 0, 2e-4);
            CHECK_NEAR(worst_of(&ivs[i], &(fw_pressure_law){P0, 0.5}, 4, M), 0, 2e-4);
        }
}

/* A held contact at 1.7 times the limit, then at 0.6 times: everything by hand. */
static void steady_rubbing(void **state)
{
    (void)state;
    static const fw_abrasion_law LAWS[] = {{"bekker2011", 0.116, 1.121, true}, {"power", 0.01, 3, false}};
    for (int i = 0; i < 2; i++) {
        fw_wear         w;
        double          b = fw_lens_chord(0.02, 2.5, RS), A = b * H, sigma = 4e5 / A, path = 0.3 * 0.5, q = 0.6;
        fw_pressure_law limit = {sigma / (i ? 0.6 : 1.7) * pow(A, q), q};
        assert_int_equal(fw_wear_init(&w, RS, 360, 2, LAWS, NULL), FW_OK);
        fw_wear_limit_pressure(&w, &limit);
        w.is_open = true;
        fw_wear_interval iv = {.length = 0.5, .since_touch = 100, .n_stages = 3, .at = {0, 0.58578643762690495, 1}, .radius = 2.5, .thickness = H};
        iv.depth[0] = iv.depth[1] = 0.02, iv.angle[0] = iv.angle[1] = 1;
        for (int s = 0; s < 3; s++) iv.normal[s] = 4e5, iv.slip[s] = -0.3;
        fw_wear_collect(&w, &iv);
        fw_wear_finish(&w);
        for (int l = 0; l < 2; l++) {
            CHECK_RELATIVE(w.sums[l].path, path, 1e-13);
            CHECK_RELATIVE(w.sums[l].along, pow(i ? sigma : sigma / 1.7, LAWS[l].exponent) * path, 1e-11);
        }
        assert_true(fw_wear_conservation(&w) < 1e-13);
        fw_wear_free(&w);
    }
}

/* Law: a limit that nothing reaches changes no bit; whatever moves over the ring, arcs add up to the patch integral, by every rule. */
static void conserves(void **state)
{
    (void)state;
    static const fw_abrasion_law LAWS[] = {{"bekker2011", 0.116, 1.121, true}, {"power", 0.01, 3.9, false}};
    static const fw_pressure_law LIMIT[] = {{3e5, 0}, {5e6, 0}, {1e6, 0.5}};
    for (int rule = FW_WEAR_HERMITE; rule <= FW_WEAR_NAIVE; rule++)
        for (int c = 0; c < 3; c++) {
            fw_wear w;
            assert_int_equal(fw_wear_init(&w, RS, 360, 2, LAWS, NULL), FW_OK);
            fw_wear_limit_pressure(&w, &LIMIT[c]);
            w.rule = (fw_wear_rule)rule, w.is_open = true;
            uint32_t s = 7;
            for (int k = 0; k < 2000; k++) {
                double r[8];
                for (int q = 0; q < 8; q++) s = s * 1664525u + 1013904223u, r[q] = (double)(s >> 8) / (1 << 24);
                fw_wear_interval iv = {.length = 0.3 * r[0], .since_touch = k % 3 ? 0.5 * r[1] : 0, .n_stages = 3, .at = {0, 0.58578643762690495, 1}};
                iv.radius = 0.3 + 6 * r[2], iv.thickness = 0.3 + r[3];
                iv.depth[0] = k % 3 ? 0.2 * r[4] : 0, iv.depth[1] = 0.2 * r[5];
                iv.angle[0] = 6.28 * r[6], iv.angle[1] = iv.angle[0] + r[7] - 0.5;
                for (int q = 0; q < 3; q++) iv.normal[q] = 1e6 * (r[q] - 0.2), iv.slip[q] = 2 * r[q + 3] - 1;
                fw_wear_collect(&w, &iv);
            }
            fw_wear_finish(&w);
            assert_true(fw_wear_conservation(&w) < 1e-12);
            for (size_t k = 0; k < 360; k++)
                for (size_t l = 0; l < 2; l++) {
                    assert_true(w.load[l][0][k] >= 0 && w.load[l][2][k] <= w.load[l][0][k]);
                    if (c == 0) assert_true(w.load[l][2][k] == 0); /* nothing wears above 5 MPa under 0.3 MPa */
                }
            fw_wear_free(&w);
        }
}

static void out_of_reach(void **state)
{
    (void)state;
    static const fw_abrasion_law LAW = {"bekker2011", 0.116, 1.121, true};
    fw_wear                      w[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(fw_wear_init(&w[i], RS, 360, 1, &LAW, NULL), FW_OK);
        if (i) fw_wear_limit_pressure(&w[i], &(fw_pressure_law){1e8, 0});
        w[i].is_open = true;
        for (int k = 0; k < 50; k++) {
            fw_wear_interval iv = interval(0.5 / omega(), 0.6 / omega());
            iv.angle[0] = 0.1 * k, iv.angle[1] = iv.angle[0] + 0.002 * k;
            if (k % 5 == 0) iv.normal[2] = -iv.normal[2]; /* fades, too */
            fw_wear_collect(&w[i], &iv);
        }
        fw_wear_finish(&w[i]);
    }
    for (size_t k = 0; k < 360; k++)
        for (size_t q = 0; q < 3; q++) assert_true(w[0].load[0][q][k] == w[1].load[0][q][k]);
    fw_wear_free(&w[0]);
    fw_wear_free(&w[1]);
}

/* sigma = S / sqrt(t) capped at P > 5 MPa in the first interval. Archard's load on the wall, min(sigma, P) b with b = B sqrt(t), is
 * P B t^(1/2) until t_P = (S/P)^2, then S B; above 5 MPa until t_5 = (S / 5 MPa)^2: for p hardly changing. */
static void share_above_high_pressure(void **state)
{
    (void)state;
    static const fw_abrasion_law LAW = {"archard", 0.01, 1, false};
    double  end = 0.05 / omega(), B = 2 * sqrt(2 * V / (1 / R + 1 / RS)), S = 2 * MASS * omega() * V / (B * H), P = 8e6;
    double  t_P = S * S / (P * P), t_5 = S * S / 25e12, capped = P * B * 2 / 3 * pow(t_P, 1.5);
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, RS, 360, 1, &LAW, NULL), FW_OK);
    fw_wear_limit_pressure(&w, &(fw_pressure_law){P, 0});
    w.is_open = true;
    fw_wear_interval iv = interval(0, end);
    for (int q = 0; q < 3; q++) iv.slip[q] = 0.3;
    fw_wear_collect(&w, &iv);
    fw_wear_finish(&w);
    double above = 0, all = 0;
    for (size_t k = 0; k < 360; k++) above += w.load[0][2][k], all += w.load[0][0][k];
    CHECK_NEAR(above / all, (capped + S * B * (t_5 - t_P)) / (capped + S * B * (end - t_P)), 0.03);
    fw_wear_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(after_a_touch), cmocka_unit_test(crossings_anywhere), cmocka_unit_test(steady_rubbing),
                                       cmocka_unit_test(conserves),     cmocka_unit_test(out_of_reach),       cmocka_unit_test(share_above_high_pressure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
