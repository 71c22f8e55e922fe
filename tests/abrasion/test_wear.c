#include "abrasion/wear.h"
#include "check.h"
#include "geometry/lens.h"

#define PI 3.14159265358979323846
static const fw_abrasion_law LAWS[] = {{"bekker2011", 0.116, 1.121, true}, {"archard", 0.01, 1.0, false}};

/* Values along an interval, sampled at TR-BDF2's instants. */
static fw_wear_interval interval(double length, double since, double radius, double thickness)
{
    return (fw_wear_interval){.length = length,
                              .since_touch = since,
                              .n_stages = 3,
                              .at = {0, 0.58578643762690495, 1},
                              .radius = radius,
                              .thickness = thickness};
}

/* A held contact: constant force, slip and overlap: everything by hand. */
static void steady_rubbing(void **state)
{
    (void)state;
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, 3.7, 360, 2, LAWS, NULL), FW_OK);
    fw_wear_interval iv = interval(0.5, 100, 2.5, 0.5);
    iv.depth[0] = iv.depth[1] = 0.02;
    iv.angle[0] = iv.angle[1] = 1.0;
    for (int s = 0; s < 3; s++) iv.normal[s] = 4e5, iv.slip[s] = -0.3;
    fw_wear_collect(&w, &iv);
    assert_true(w.sums[0].path == 0); /* closed during warm-up */
    w.is_open = true;
    fw_wear_collect(&w, &iv);
    fw_wear_finish(&w);
    double b = fw_lens_chord(0.02, 2.5, 3.7), sigma = 4e5 / (b * 0.5), path = 0.3 * 0.5;
    for (int l = 0; l < 2; l++) {
        double m = LAWS[l].exponent;
        CHECK_RELATIVE(w.sums[l].path, path, 1e-13);
        CHECK_RELATIVE(w.sums[l].along, pow(sigma, m) * path, 1e-12);
        CHECK_RELATIVE(w.sums[l].x_wall, pow(sigma, m) * path * b, 1e-12);
        assert_true(w.sums[l].impact == 0 && w.sums[l].beyond == 0);
    }
    /* an arc wholly under the patch collects the patch's own load, less the chord-to-arc ratio */
    double half = asin(b / 7.4);
    size_t k = (size_t)(1.0 * 180 / PI);
    CHECK_RELATIVE(w.load[0][0][k], pow(sigma, 1.121) * path * b / (2 * 3.7 * half), 1e-12);
    CHECK_RELATIVE(w.path[k], path * b / (2 * 3.7 * half), 1e-12);
    assert_true(fw_wear_conservation(&w) < 1e-13);
    assert_true(w.load[0][0][200] == 0);
    fw_wear_free(&w);
}

/* Head-on touch with a steady slip put on: critically damped closed form; wear load by the substitution t = s^2 in 1e6 midpoints. */
static void first_touch(void **state)
{
    (void)state;
    double m = 2209, om = sqrt(2e6 / m), v = 2, R = 1.25, h = 0.5, slip = 0.2, end = 1.2 / om, sum = 0, last = 0;
    for (int i = 0; i < 1000000; i++) {
        double s = (i + 0.5) * 1e-6 * sqrt(end), t = s * s, d = v * t * exp(-om * t);
        double N = m * om * v * exp(-om * t) * (2 - om * t);
        sum += pow(N / (h * fw_lens_chord(d, R, 3.7)), 1.121) * slip * 2 * s * 1e-6 * sqrt(end);
    }
    for (int n = 4; n <= 16; n *= 2) {
        fw_wear w;
        assert_int_equal(fw_wear_init(&w, 3.7, 360, 1, LAWS, NULL), FW_OK);
        w.is_open = true;
        for (int i = 0; i < n; i++) { /* graded steps t ~ i^2 */
            double           t0 = end * i * i / (n * n), t1 = end * (i + 1) * (i + 1) / (n * n);
            fw_wear_interval iv = interval(t1 - t0, t0, R, h);
            iv.impact_left = 1;
            for (int q = 0; q < 2; q++) {
                double t = q ? t1 : t0;
                iv.depth[q] = v * t * exp(-om * t), iv.rate[q] = v * exp(-om * t) * (1 - om * t);
            }
            for (int q = 0; q < 3; q++) {
                double t = t0 + iv.at[q] * (t1 - t0);
                iv.normal[q] = m * om * v * exp(-om * t) * (2 - om * t), iv.slip[q] = slip;
            }
            fw_wear_collect(&w, &iv);
        }
        double error = fabs(w.sums[0].along / sum - 1);
        if (n > 4) assert_true(error < 0.3 * last || error < 1e-6); /* second order at least */
        last = error;
        if (n == 16) CHECK_RELATIVE(w.sums[0].along, sum, 2e-5);
        CHECK_RELATIVE(w.sums[0].impact, w.sums[0].along, 1e-14);
        fw_wear_free(&w);
    }
}

/* A floe that lets go inside the step: force falls linearly through zero, path and load end there. */
static void release_inside_a_step(void **state)
{
    (void)state;
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, 3.7, 720, 1, &LAWS[1], NULL), FW_OK);
    w.is_open = true;
    fw_wear_interval iv = interval(0.2, 50, 2.5, 0.5);
    iv.depth[0] = iv.depth[1] = 0.01;
    for (int s = 0; s < 3; s++) iv.normal[s] = 1e5 * (1 - 4 * iv.at[s]), iv.slip[s] = 1.5;
    fw_wear_collect(&w, &iv);
    CHECK_RELATIVE(w.sums[0].path, 1.5 * 0.05, 1e-9); /* zero at a quarter of 0.2 s */
    CHECK_RELATIVE(w.sums[0].along, 1e5 / 2 / (fw_lens_chord(0.01, 2.5, 3.7) * 0.5) * 1.5 * 0.05, 1e-9);
    fw_wear_free(&w);
}

static void rotate_by_17_arcs(fw_wear_rule rule)
{
    fw_wear w[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(fw_wear_init(&w[i], 3.7, 360, 2, LAWS, NULL), FW_OK);
        w[i].rule = rule, w[i].is_open = true;
        uint32_t s = 7;
        for (int k = 0; k < 500; k++) {
            double r[8];
            for (int q = 0; q < 8; q++) s = s * 1664525u + 1013904223u, r[q] = (double)(s >> 8) / (1 << 24);
            fw_wear_interval iv = interval(0.3 * r[0], k % 3 ? 0.5 * r[1] : 0, 0.3 + 6 * r[2], 0.3 + r[3]);
            iv.depth[0] = k % 3 ? 0.2 * r[4] : 0, iv.depth[1] = 0.2 * r[5];
            iv.angle[0] = 6.28 * r[6] + (i ? 17 * PI / 180 : 0), iv.angle[1] = iv.angle[0] + r[7] - 0.5;
            iv.impact_left = r[1] - 0.5;
            for (int q = 0; q < 3; q++) iv.normal[q] = 1e6 * (r[q] - 0.2), iv.slip[q] = 2 * r[q + 3] - 1;
            fw_wear_collect(&w[i], &iv);
        }
        fw_wear_finish(&w[i]);
        assert_true(fw_wear_conservation(&w[i]) < 1e-12);
    }
    for (size_t k = 0; k < 360; k++) {
        CHECK_RELATIVE(w[1].load[0][0][(k + 17) % 360], w[0].load[0][0][k], 1e-9);
        CHECK_RELATIVE(w[1].path[(k + 17) % 360], w[0].path[k], 1e-9);
        assert_true(w[0].load[0][1][k] <= w[0].load[0][0][k] && w[0].load[0][2][k] <= w[0].load[0][0][k]);
    }
    fw_wear_free(&w[0]);
    fw_wear_free(&w[1]);
}

/* Law: whatever moves over the ring, arcs add up to the patch integral; a rotated interval gives the rotated ring. */
static void conserves_and_rotates(void **state)
{
    (void)state;
    for (int rule = FW_WEAR_HERMITE; rule <= FW_WEAR_NAIVE; rule++) rotate_by_17_arcs((fw_wear_rule)rule);
}

/* One head-on touch in n even steps up to 1.2/w, by one rule, slip put on: what each rule converges to, and how fast. */
static double load_of(fw_wear_rule rule, int n, bool is_moving)
{
    double  m = 2209, om = sqrt(2e6 / m), v = 2, end = 1.2 / om;
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, 3.7, 360, 2, LAWS, NULL), FW_OK);
    w.rule = rule, w.is_open = true;
    for (int i = 0; i < n; i++) {
        double           t0 = end * i / n, t1 = end * (i + 1) / n;
        fw_wear_interval iv = interval(t1 - t0, t0, 1.25, 0.5);
        for (int q = 0; q < 2; q++) {
            double t = q ? t1 : t0;
            iv.depth[q] = v * t * exp(-om * t), iv.rate[q] = v * exp(-om * t) * (1 - om * t);
            iv.angle[q] = is_moving ? 6 + 8 * t : 1;
        }
        for (int q = 0; q < 3; q++) {
            double t = t0 + iv.at[q] * (t1 - t0);
            iv.normal[q] = m * om * v * exp(-om * t) * (2 - om * t), iv.slip[q] = 0.3 * exp(-2 * om * t);
        }
        fw_wear_collect(&w, &iv);
    }
    fw_wear_finish(&w);
    assert_true(fw_wear_conservation(&w) < 1e-12);
    double along = w.sums[0].along;
    fw_wear_free(&w);
    return along;
}

/* Naive: the sum of t^(-m/2) dt at the steps' ends is off by zeta(m/2) dt^(1 - m/2), 0.44 at m = 1.121. Singular: overlap linear
 * on the first step is off by its length, so one order more. Hermite: the force's quadratic through the stages, third. */
static void order_of_each_rule(void **state)
{
    (void)state;
    double exact = load_of(FW_WEAR_HERMITE, 4096, false);
    for (int rule = FW_WEAR_HERMITE; rule <= FW_WEAR_NAIVE; rule++) {
        double coarse = fabs(load_of((fw_wear_rule)rule, 32, false) / exact - 1);
        double finer = fabs(load_of((fw_wear_rule)rule, 128, false) / exact - 1), order = log(coarse / finer) / log(4);
        if (rule == FW_WEAR_NAIVE) CHECK_NEAR(order, 0.44, 0.03);
        if (rule == FW_WEAR_SINGULAR) CHECK_NEAR(order, 1.44, 0.15);
        if (rule == FW_WEAR_HERMITE) assert_true(order > 2.7 && coarse < 1e-4);
        if (rule == FW_WEAR_NAIVE)
            assert_true(finer > 0.02);         /* 1/100 of w^-1: the 11-31 % of the plain method at 1 ms */
        load_of((fw_wear_rule)rule, 32, true); /* conserves across angle 0, too */
    }
}

/* A patch that crosses several arcs in one long interval leaves what the same slide leaves in 64 short ones. */
static void long_slides_stay_even(void **state)
{
    (void)state;
    for (int c = 0; c < 3; c++) {
        fw_wear w[2];
        for (int k = 0; k < 2; k++) {
            int n = k ? 64 : 1;
            assert_int_equal(fw_wear_init(&w[k], 3.7, 360, 2, LAWS, NULL), FW_OK);
            w[k].is_open = true;
            for (int visit = 0; visit < 5;
                 visit++) /* the slide goes on for five long intervals, speeding up or slowing down */
                for (int i = 0; i < n; i++) {
                    fw_wear_interval iv = interval(0.5 / n, 20 + 0.5 * visit, 2.5, 0.5);
                    double           change = c == 0 ? 0 : c == 1 ? 0.12 : -0.15, u[2];
                    for (int q = 0; q < 2; q++) {
                        u[q] = visit + (double)(i + q) / n;
                        iv.depth[q] = 0.02 * exp(change * u[q]), iv.rate[q] = change * iv.depth[q] / 0.5;
                        iv.angle[q] = 6.1 + 0.1 * u[q]; /* 5.7 arcs in each of the five */
                    }
                    for (int q = 0; q < 3; q++) {
                        double x = u[0] + iv.at[q] * (u[1] - u[0]);
                        iv.normal[q] = 3e5 * exp(change * x), iv.slip[q] = -0.7 * exp(0.5 * change * x);
                    }
                    fw_wear_collect(&w[k], &iv);
                }
            fw_wear_finish(&w[k]);
        }
        double most = 0, worst = 0;
        for (size_t k = 0; k < 360; k++) most = fmax(most, w[1].load[0][0][k]);
        for (size_t k = 0; k < 360; k++) worst = fmax(worst, fabs(w[0].load[0][0][k] - w[1].load[0][0][k]));
        assert_true(worst < 0.01 * most);
        CHECK_RELATIVE(w[0].sums[0].x_wall, w[1].sums[0].x_wall, 2e-5);
        fw_wear_free(&w[0]);
        fw_wear_free(&w[1]);
    }
}

/* Pressure falls through 5 MPa inside the first interval: its share above, in closed form for p hardly changing. */
static void share_above_high_pressure(void **state)
{
    (void)state;
    double  m = 2209, om = sqrt(2e6 / m), v = 2, end = 0.05 / om;
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, 3.7, 360, 2, LAWS, NULL), FW_OK);
    w.is_open = true;
    fw_wear_interval iv = interval(end, 0, 1.25, 0.5);
    iv.depth[1] = v * end * exp(-om * end), iv.rate[0] = v, iv.rate[1] = v * exp(-om * end) * (1 - om * end);
    for (int q = 0; q < 3; q++) {
        double t = iv.at[q] * end;
        iv.normal[q] = m * om * v * exp(-om * t) * (2 - om * t), iv.slip[q] = 0.3;
    }
    /* sigma = S / sqrt(t), b = B sqrt(t): above for t < (S / 5 MPa)^2; Archard's load on the wall grows evenly in time */
    double B = 2 * sqrt(2 * v / (1 / 1.25 + 1 / 3.7)), S = 2 * m * om * v / (B * 0.5), until = S * S / 25e12;
    assert_true(until > 0.2 * end && until < 0.8 * end);
    fw_wear_collect(&w, &iv);
    fw_wear_finish(&w);
    double above = 0, all = 0;
    for (size_t k = 0; k < 360; k++) above += w.load[1][2][k], all += w.load[1][0][k];
    CHECK_NEAR(above / all, until / end, 0.03);
    fw_wear_free(&w);
}

/* Ice that crushes from a touch on: p = P0 (b h)^-q, d = v t - g t^2 / 2, slip 0.3 (1 - t / 2 end); against 1e6 midpoints in the root of time. Then the flat:
 * a pressure that is handed over, falling through zero half-way, under the chord of a deepest overlap that shrinks. */
static void crushing(void **state)
{
    (void)state;
    static const double FIRST[] = {0.3, 1, 0.01}, Q[] = {0, 0.3, 0.5};
    double              v = 1.8, g = 40, R = 1.25, h = 0.5, P0 = 1.1e6, m = LAWS[0].exponent;
    for (int q = 0; q < 3; q++)
        for (int c = 0; c < 3; c++) {
            double end = 0.03, along = 0, wall = 0, path = 0;
            fw_wear w;
            for (int i = 0; i < 1000000; i++) {
                double x = (i + 0.5) * 1e-6, t = x * x * end, b = fw_lens_chord(v * t - 0.5 * g * t * t, R, 3.7), dt = 2 * x * 1e-6 * end;
                double slide = 0.3 * (1 - 0.5 * t / end) * dt, rate = pow(P0 * pow(fmax(0.01, b * h), -Q[q]), m);
                along += rate * slide, wall += rate * b * slide, path += b * slide;
            }
            assert_int_equal(fw_wear_init(&w, 3.7, 360, 2, LAWS, NULL), FW_OK);
            w.is_open = true;
            double t = 0, length = FIRST[c] * end;
            for (int step = 0; t < end * (1 - 1e-12); step++, t += length, length = fmin(4 * length, end - t)) {
                fw_wear_interval iv = interval(length, t, R, h);
                iv.is_crushed = iv.is_push = true, iv.crush = (fw_pressure_law){P0, Q[q]};
                for (int s = 0; s < 3; s++) {
                    double at = t + iv.at[s] * length;
                    iv.normal[s] = 1, iv.slip[s] = 0.3 * (1 - 0.5 * at / end);
                    if (s != 1) iv.depth[s / 2] = v * at - 0.5 * g * at * at, iv.rate[s / 2] = v - g * at;
                }
                fw_wear_collect(&w, &iv);
            }
            fw_wear_finish(&w);
            CHECK_RELATIVE(w.sums[0].along, along, Q[q] > 0 ? 5e-3 : 1e-6); /* the law has a corner at 0.01 m2 */
            CHECK_RELATIVE(w.sums[0].x_wall, wall, Q[q] > 0 ? 1e-3 : 1e-6);
            double over = 0;
            for (int k = 0; k < 360; k++) over += w.path[k] * 2 * PI * 3.7 / 360;
            CHECK_RELATIVE(over, path, 1e-6);
            assert_true(fw_wear_conservation(&w) < 1e-12 && w.sums[0].beyond == 0);
            fw_wear_free(&w);
        }
    fw_wear w;
    assert_int_equal(fw_wear_init(&w, 3.7, 360, 2, LAWS, NULL), FW_OK);
    w.is_open = true;
    fw_wear_interval iv = interval(0.2, 0.01, R, h);
    iv.is_crushed = true, iv.depth[0] = 0.3, iv.depth[1] = 0.2, iv.rate[0] = iv.rate[1] = -0.5; /* deeper than a tenth of R: gone, not overlapping */
    for (int s = 0; s < 3; s++) iv.normal[s] = 8e5 * (1 - 2 * iv.at[s]), iv.slip[s] = -0.2;
    fw_wear_collect(&w, &iv);
    double along = 0, wall = 0;
    for (int i = 0; i < 100000; i++) {
        double u = 0.5 * (i + 0.5) * 1e-5, rate = pow(8e5 * (1 - 2 * u), m) * 0.2 * 0.1 * 1e-5;
        along += rate, wall += rate * fw_lens_chord(0.3 - 0.1 * u, R, 3.7);
    }
    CHECK_RELATIVE(w.sums[0].along, along, 1e-5);
    CHECK_RELATIVE(w.sums[0].x_wall, wall, 1e-5);
    assert_true(w.sums[0].beyond == 0);
    fw_wear_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steady_rubbing),           cmocka_unit_test(first_touch),
        cmocka_unit_test(release_inside_a_step),    cmocka_unit_test(conserves_and_rotates),
        cmocka_unit_test(order_of_each_rule),       cmocka_unit_test(long_slides_stay_even),
        cmocka_unit_test(share_above_high_pressure), cmocka_unit_test(crushing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
