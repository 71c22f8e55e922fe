/* Direction weights: the convention of arcs, wrapped laws, rotation. */
#include "study/directions.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

static fw_distribution law(fw_distribution_kind kind, double a, double b)
{
    return (fw_distribution){.kind = kind, .a = a, .b = b, .low = -INFINITY, .high = INFINITY};
}

static void a_point_reads_the_arc_that_physics_names(void **state)
{
    (void)state;
    /* bearing = direction + 180 + theta, arc k covers [k, k+1) degrees of 360 */
    assert_int_equal(fw_directions_arc(360, 180, 0), 0);  /* current to the north meets the south point */
    assert_int_equal(fw_directions_arc(360, 195, 0), 15); /* clockwise from there: theta 15 */
    assert_int_equal(fw_directions_arc(360, 165, 0), 345);
    assert_int_equal(fw_directions_arc(360, 0, 90), 90);
    assert_int_equal(fw_directions_arc(360, 0, 270), 270);
    assert_int_equal(fw_directions_arc(360, 0, -90), 270); /* 270 said otherwise */
    assert_int_equal(fw_directions_arc(360, 0.5, 180), 0);
    assert_int_equal(fw_directions_arc(72, 4.999, 180), 0);
    assert_int_equal(fw_directions_arc(72, 5, 180), 1);
    /* 0.1 + 0.2 - 0.3 is 5.6e-17 and its negative wraps to 359.99..: both are theta 0 */
    assert_int_equal(fw_directions_arc(360, 0.1 + 0.2, 180.3), 0);
    assert_int_equal(fw_directions_arc(360, 0.3, 180 + (0.1 + 0.2)), 0);
}

static double total(const fw_direction_weight *w, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum += w[k].weight;
    return sum;
}

static void uniform_directions_weigh_all_arcs_alike(void **state)
{
    (void)state;
    const double  bearings[] = {0, 37.5};
    fw_site       site;
    fw_directions d;
    memset(&site, 0, sizeof site);
    site.direction = law(FW_DIST_UNIFORM, 0, 360);
    assert_int_equal(fw_directions_make(&d, &site, 72, 2, bearings, NULL), FW_OK);
    assert_int_equal(d.n_used, 72);
    assert_false(d.is_single);
    for (size_t p = 0; p < 2; p++) {
        size_t                     n;
        const fw_direction_weight *w = fw_directions_row(&d, 0, p, &n);
        assert_int_equal(n, 72);
        for (size_t k = 0; k < n; k++) CHECK_NEAR(w[k].weight, 1.0 / 72, 1e-14);
    }
    fw_directions_free(&d);
}

static void a_normal_law_wraps(void **state)
{
    (void)state;
    /* directions normal about 350 with sd 40: mass beyond 360 comes back at 0. Independent sum from the error function:
     * arc k is read when direction lies in (bearing - 180 - (k+1), bearing - 180 - k], modulo 360 */
    const double  bearing = 100;
    fw_site       site;
    fw_directions d;
    size_t        n;
    memset(&site, 0, sizeof site);
    site.direction = law(FW_DIST_NORMAL, 350, 40);
    assert_int_equal(fw_directions_make(&d, &site, 360, 1, &bearing, NULL), FW_OK);
    const fw_direction_weight *w = fw_directions_row(&d, 0, 0, &n);
    CHECK_NEAR(total(w, n), 1, 1e-14);
    for (size_t k = 0; k < n; k++) {
        double want = 0;
        for (int turn = -4; turn <= 6; turn++) {
            double to = bearing - 180 - (double)d.used[w[k].column] + 360.0 * turn;
            want += 0.5 * (erf((to - 350) / (40 * sqrt(2))) - erf((to - 1 - 350) / (40 * sqrt(2))));
        }
        CHECK_NEAR(w[k].weight, want, 1e-13);
    }
    fw_directions_free(&d);
}

static void values_and_a_narrow_continuous_law_agree(void **state)
{
    (void)state;
    const double  bearings[] = {0, 15, 200}, values[] = {10.5, 250.5}, weights[] = {0.25, 0.75};
    fw_site       discrete, narrow;
    fw_directions a, b;
    memset(&discrete, 0, sizeof discrete);
    memset(&narrow, 0, sizeof narrow);
    assert_int_equal(fw_distribution_values(&discrete.direction, 2, values, weights, NULL), FW_OK);
    narrow.direction = law(FW_DIST_UNIFORM, 250.2, 250.8); /* inside one arc of each bearing */
    assert_int_equal(fw_directions_make(&a, &discrete, 360, 3, bearings, NULL), FW_OK);
    assert_int_equal(fw_directions_make(&b, &narrow, 360, 3, bearings, NULL), FW_OK);
    assert_true(b.is_single && !a.is_single);
    for (size_t p = 0; p < 3; p++) {
        size_t                     na, nb;
        const fw_direction_weight *wa = fw_directions_row(&a, 0, p, &na), *wb = fw_directions_row(&b, 0, p, &nb);
        assert_true(na == 2 && nb == 1);
        size_t arc = b.used[wb[0].column], heavy = wa[0].weight > wa[1].weight ? 0u : 1u;
        assert_int_equal(a.used[wa[heavy].column], arc);
        CHECK_NEAR(wa[heavy].weight, 0.75, 1e-15);
    }
    fw_directions_free(&a);
    fw_directions_free(&b);
    fw_distribution_free(&discrete.direction);
}

static void cells_of_a_joint_table_have_their_own_rows(void **state)
{
    (void)state;
    const double  bearings[] = {180, 270};
    fw_site_cell  cells[2];
    fw_site       site;
    fw_directions d;
    size_t        n;
    memset(&site, 0, sizeof site);
    memset(cells, 0, sizeof cells);
    site.n_cells = 2;
    site.cells = cells;
    fw_distribution_constant(&cells[0].direction, 0);
    fw_distribution_constant(&cells[1].direction, 90);
    assert_int_equal(fw_directions_make(&d, &site, 360, 2, bearings, NULL), FW_OK);
    assert_true(d.is_single); /* one direction per cell: each record still gives one load per point */
    assert_int_equal(d.used[fw_directions_row(&d, 0, 0, &n)->column], 0);
    assert_int_equal(d.used[fw_directions_row(&d, 0, 1, &n)->column], 90);
    assert_int_equal(d.used[fw_directions_row(&d, 1, 0, &n)->column], 270);
    assert_int_equal(d.used[fw_directions_row(&d, 1, 1, &n)->column], 0);
    assert_int_equal(d.n_used, 3);
    fw_directions_free(&d);
    fw_directions_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_point_reads_the_arc_that_physics_names),
                                       cmocka_unit_test(uniform_directions_weigh_all_arcs_alike),
                                       cmocka_unit_test(a_normal_law_wraps),
                                       cmocka_unit_test(values_and_a_narrow_continuous_law_agree),
                                       cmocka_unit_test(cells_of_a_joint_table_have_their_own_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
