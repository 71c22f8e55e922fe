#include "check.h"
#include "geometry/ring.h"

#define PI 3.14159265358979323846

static void angle_convention(void **state)
{
    (void)state;
    /* theta = atan2(y, -x): 0 faces the current that comes from x < 0, positive towards +y */
    CHECK_NEAR(fw_ring_angle(-1, 0), 0, 0);
    CHECK_NEAR(fw_ring_angle(0, 1), PI / 2, 1e-15);
    CHECK_NEAR(fw_ring_angle(1, 0), PI, 1e-15);
    CHECK_NEAR(fw_ring_angle(0, -1), 3 * PI / 2, 1e-15);
    for (double turn = -3; turn < 3; turn += 0.0071)
        CHECK_NEAR(fw_ring_turn(-cos(2), sin(2), -3 * cos(2 + turn), 3 * sin(2 + turn)), turn, 1e-14);
    assert_true(fw_ring_angle(-1, -1e-300) < 2 * PI);
}

/* A patch at rest: its shares, from the first arc it covers on. */
static size_t cover(size_t n, double centre, double half, size_t *first, double *share)
{
    double cells[400][4] = {{0}}, low[2] = {centre - half, centre - half}, high[2] = {centre + half, centre + half};
    size_t count = 0, k = 0;
    fw_ring_spread(cells[0], 1, n, low, high, (double[]){1, 2, 0, -1});
    for (size_t a = 0; a < n; a++) {
        assert_true(cells[a][0] >= 0 && cells[a][1] == 2 * cells[a][0] && cells[a][2] == 0 &&
                    cells[a][3] == -cells[a][0]);
        if (cells[a][0] > 0 && !(cells[(a + n - 1) % n][0] > 0)) k = a;
    }
    *first = k;
    for (; count < n && cells[k][0] > 0; k = (k + 1) % n) share[count++] = cells[k][0];
    return count;
}

/* Law: shares sum to 1, and their first moment is the patch's centre (a uniform patch). */
static void cover_conserves(void **state)
{
    (void)state;
    double share[400];
    for (size_t n = 72; n <= 360; n += 96)
        for (double centre = -0.3; centre < 6.6; centre += 0.0937)
            for (double half = 1e-9; half < 1.6; half *= 3.1) {
                size_t first, count = cover(n, centre, half, &first, share);
                double sum = 0, moment = 0, width = 2 * PI / (double)n;
                assert_true(first < n && count <= n + 1);
                for (size_t i = 0; i < count; i++) sum += share[i];
                CHECK_NEAR(sum, 1, 1e-12);
                if (2 * half > 4 * width) { /* whole arcs in the middle are evenly covered */
                    for (size_t i = 1; i + 1 < count; i++) CHECK_RELATIVE(share[i], width / (2 * half), 1e-9);
                    for (size_t i = 0; i < count; i++) moment += share[i] * ((double)(first + i) + 0.5) * width;
                    double off = moment - centre;
                    off -= 2 * PI * round(off / (2 * PI));
                    CHECK_NEAR(off, 0, width); /* the two end arcs are only known to their middle */
                }
            }
}

static void cover_wraps_and_points(void **state)
{
    (void)state;
    double share[400];
    size_t first, count = cover(360, 0, 1.5 * PI / 180, &first, share);
    assert_int_equal(first, 358);
    assert_int_equal(count, 4);
    CHECK_NEAR(share[0], 0.5 / 3, 1e-12);
    CHECK_NEAR(share[1], 1.0 / 3, 1e-12);
    count = cover(360, 10.25 * PI / 180, 0, &first, share);
    assert_int_equal(count, 1);
    assert_int_equal(first, 10);
    CHECK_NEAR(share[0], 1, 1e-12);
}

/* A sweep is the mean of many rests on the way; each edge has its own. Both laws of the header: sum 1, untouched cells keep their bits. */
static void sweep_is_a_mean_of_rests(void **state)
{
    (void)state;
    enum { N = 90, STEPS = 20000 };
    static const double CASE[][4] = {/* low and high edge at the start and at the end, in arcs */
                                     {10.2, 14.9, 10.9, 15.4},  {88.3, 97.1, 93.9, 98.8}, {5.4, 9.3, 3.2, 12.1},
                                     {40.3, 40.4, 44.7, 44.9},  {-2.6, 1.2, -3.1, 1.9},   {20.1, 21.0, 20.2, 23.5},
                                     {30.5, 70.25, 30.5, 70.25}};
    for (size_t c = 0; c < sizeof CASE / sizeof CASE[0]; c++) {
        double arc = 2 * PI / N, sweep[N][4] = {{0}}, rests[N][4] = {{0}}, sum = 0;
        double low[2] = {CASE[c][0] * arc, CASE[c][2] * arc}, high[2] = {CASE[c][1] * arc, CASE[c][3] * arc};
        double mean = 0.5 * (high[0] + high[1] - low[0] - low[1]);
        fw_ring_spread(sweep[0], 1, N, low, high, (double[]){1, 0, 0, 0});
        for (int i = 0; i < STEPS; i++) {
            double u = (i + 0.5) / STEPS, l = low[0] + u * (low[1] - low[0]), h = high[0] + u * (high[1] - high[0]);
            fw_ring_spread(rests[0], 1, N, (double[]){l, l}, (double[]){h, h},
                           (double[]){(h - l) / mean / STEPS, 0, 0, 0});
        }
        for (size_t a = 0; a < N; a++) {
            sum += sweep[a][0];
            CHECK_NEAR(sweep[a][0], rests[a][0], 1e-4);
            assert_true((sweep[a][0] == 0) == (rests[a][0] == 0));
        }
        CHECK_NEAR(sum, 1, 1e-13);
    }
}

/* Two laws side by side are laid down as each would be alone. */
static void quads_are_alike(void **state)
{
    (void)state;
    double one[72][4] = {{0}}, two[72][8] = {{0}}, low[2] = {6.1, 6.2}, high[2] = {6.6, 6.5},
           amount[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    fw_ring_spread(one[0], 1, 72, low, high, amount);
    fw_ring_spread(two[0], 2, 72, low, high, amount);
    for (size_t a = 0; a < 72; a++)
        for (size_t i = 0; i < 4; i++) {
            assert_true(two[a][i] == one[a][i]);
            CHECK_NEAR(two[a][i + 4] * amount[i], one[a][i] * amount[i + 4], 1e-14);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(angle_convention), cmocka_unit_test(cover_conserves),
                                       cmocka_unit_test(cover_wraps_and_points),
                                       cmocka_unit_test(sweep_is_a_mean_of_rests), cmocka_unit_test(quads_are_alike)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
