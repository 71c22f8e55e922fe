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
    assert_true(fw_ring_angle(-1, -1e-300) < 2 * PI);
}

/* Law: shares sum to 1, and their first moment is the patch's centre (a uniform patch). */
static void cover_conserves(void **state)
{
    (void)state;
    double share[400];
    for (size_t n = 72; n <= 360; n += 96)
        for (double centre = -0.3; centre < 6.6; centre += 0.0937)
            for (double half = 1e-9; half < 1.6; half *= 3.1) {
                size_t first, count = fw_ring_cover(n, centre, half, &first, share);
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
    size_t first, count = fw_ring_cover(360, 0, 1.5 * PI / 180, &first, share);
    assert_int_equal(first, 358);
    assert_int_equal(count, 4);
    CHECK_NEAR(share[0], 0.5 / 3, 1e-12);
    CHECK_NEAR(share[1], 1.0 / 3, 1e-12);
    count = fw_ring_cover(360, 10.25 * PI / 180, 0, &first, share);
    assert_int_equal(count, 1);
    assert_int_equal(first, 10);
    assert_true(share[0] == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(angle_convention), cmocka_unit_test(cover_conserves),
                                       cmocka_unit_test(cover_wraps_and_points)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
