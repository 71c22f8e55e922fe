/* Packing of one box: every promise is checked by brute force over all pairs, without the search cells. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "field/growing.h"
#include "field/packing.h"

static const double PI = 3.14159265358979323846;

static void assert_no_overlap(const fw_packing *p)
{
    const fw_packing_box *b = &p->box;
    for (size_t i = 0; i < p->n_own; i++) {
        assert_true(p->x[i] >= b->x0 && p->x[i] < b->x1 && p->y[i] >= b->y0 && p->y[i] < b->y1);
        for (size_t j = 0; j < p->n_discs; j++) {
            if (j == i || (j >= p->n_own && j < p->n_most)) continue;
            for (int image = b->wraps_y ? -1 : 0; image <= (b->wraps_y ? 1 : 0); image++) {
                double dx = p->x[i] - p->x[j], dy = p->y[i] - p->y[j] + image * (b->y1 - b->y0), s = p->r[i] + p->r[j];
                assert_true(dx * dx + dy * dy > s * s);
            }
        }
    }
}

/* Radii falling from `largest` to `smallest` until they fill `share` of the area; returns how many. */
static size_t fill(double *r, size_t capacity, double largest, double smallest, double share, double area)
{
    double mean = PI * (largest * largest + largest * smallest + smallest * smallest) / 3.0;
    size_t n = (size_t)(share * area / mean);
    assert_true(n <= capacity);
    for (size_t i = 0; i < n; i++) r[i] = largest - (largest - smallest) * ((double)i + 0.5) / (double)n;
    return n;
}

static void add_obstacle(fw_packing *p, double x, double y, double r)
{
    assert_int_equal(fw_packing_obstacles(p, 1, &x, &y, &r, NULL), FW_OK);
}

static void discs_never_overlap(void **state)
{
    (void)state;
    static const struct {
        double largest, smallest, share;
        bool   wraps;
    } cases[] = {{6.0, 1.0, 0.1, true},  {6.0, 1.0, 0.65, true}, {6.0, 1.0, 0.78, false}, {3.0, 3.0, 0.65, true},
                 {3.0, 3.0, 0.7, false}, {8.0, 0.4, 0.7, true},  {12.0, 12.0, 0.6, true}};
    fw_packing p = {0};
    fw_msg     m;
    double     r[4000];
    size_t     n_left;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        fw_packing_box box = {-350.0, -250.0, 50.0, 150.0, cases[k].wraps};
        size_t         n = fill(r, 4000, cases[k].largest, cases[k].smallest, cases[k].share, 1e4);
        fw_uniforms    random;
        fw_uniforms_stream(&random, 11, FW_STREAM_TEST, k, 0);
        assert_int_equal(fw_packing_begin(&p, &box, n, cases[k].largest, 3.0, &m), FW_OK);
        /* Obstacles left and right: one at every 2 radii of the borders, some reaching far into the box. */
        for (double y = 50.0 + cases[k].largest; y < 150.0 - cases[k].largest; y += 2.5 * cases[k].largest) {
            add_obstacle(&p, -350.0 - 1e-3, y, cases[k].largest);
            add_obstacle(&p, -250.0 + 0.7 * cases[k].largest, y, cases[k].largest);
        }
        add_obstacle(&p, 900.0, 100.0, cases[k].largest); /* out of reach */
        /* In two calls: the second may move the floes of the first. */
        assert_int_equal(fw_packing_place(&p, n / 3, r, 0, &random, &n_left, &m), FW_OK);
        assert_int_equal(n_left, 0);
        assert_no_overlap(&p);
        assert_int_equal(fw_packing_place(&p, n - n / 3, r + n / 3, 1000, &random, &n_left, &m), FW_OK);
        assert_int_equal(n_left, 0);
        assert_int_equal(p.n_own, n);
        assert_no_overlap(&p);
    }
    fw_packing_free(&p);
}

static void what_cannot_be_packed_says_so(void **state)
{
    (void)state;
    fw_packing     p = {0};
    fw_packing_box box = {0.0, 60.0, 0.0, 60.0, true};
    fw_uniforms    random;
    fw_msg         m;
    double         r[200];
    size_t n_left, n = fill(r, 200, 3.0, 3.0, 0.95, 3600.0); /* above the densest packing of equal discs, 0.9069 */
    fw_uniforms_stream(&random, 11, FW_STREAM_TEST, 0, 0);
    assert_int_equal(fw_packing_begin(&p, &box, n, 3.0, 3.0, &m), FW_OK);
    assert_int_equal(fw_packing_place(&p, n, r, 0, &random, &n_left, &m), FW_OK);
    assert_true(n_left > 0);

    /* One disc and an obstacle that covers the whole box. */
    assert_int_equal(fw_packing_begin(&p, &box, 1, 50.0, 3.0, &m), FW_OK);
    add_obstacle(&p, 30.0, 30.0, 50.0);
    assert_int_equal(fw_packing_place(&p, 1, r, 0, &random, &n_left, &m), FW_OK);
    assert_int_equal(n_left, 1);
    fw_packing_free(&p);
}

static void nothing_to_place_is_fine(void **state)
{
    (void)state;
    fw_packing     p = {0};
    fw_packing_box box = {0.0, 100.0, -50.0, 50.0, true};
    fw_uniforms    random;
    fw_msg         m;
    size_t         n_left = 7;
    fw_uniforms_stream(&random, 1, FW_STREAM_TEST, 0, 0);
    assert_int_equal(fw_packing_begin(&p, &box, 0, 5.0, 3.0, &m), FW_OK);
    assert_int_equal(fw_packing_place(&p, 0, NULL, 0, &random, &n_left, &m), FW_OK);
    assert_int_equal(n_left, 0);
    fw_packing_free(&p);
    fw_packing_free(&p); /* zeroed: fine */
}

static void overlapping_floes_are_pushed_apart(void **state)
{
    /* 80 equal discs of radius 2 m in 40 m x 40 m: 62.8 %. Random tries jam at 54.7 % (random sequential adsorption of
     * equal discs, Feder 1980; a little more with free borders), so the rest is relaxation. */
    (void)state;
    fw_packing     p = {0};
    fw_packing_box box = {0.0, 40.0, 0.0, 40.0, false};
    fw_uniforms    random;
    fw_msg         m;
    double         r[80];
    size_t         n_left;
    for (int i = 0; i < 80; i++) r[i] = 2.0;
    fw_uniforms_stream(&random, 2, FW_STREAM_TEST, 0, 0);
    assert_int_equal(fw_packing_begin(&p, &box, 80, 2.0, 2.0, &m), FW_OK);
    assert_int_equal(fw_packing_own(&p, 3, (double[]){20.0, 24.1, 28.2}, (double[]){20.0, 20.0, 20.0}, r, &m), FW_OK);
    assert_int_equal(fw_packing_place(&p, 77, r, 0, &random, &n_left, &m), FW_OK);
    assert_int_equal(n_left, 0);
    assert_true(p.cost.n_crowded > 0 && p.cost.n_pushes > 0);
    assert_no_overlap(&p);
    fw_packing_free(&p);
}

/* Floes of radii near 3 m filling `share` of a box of 60 m between rows of obstacles that reach 1 m into it; what
 * pushing leaves overlapping is grown. Returns the share of their size that they reached. */
static double grow_between_rims(fw_packing *p, double share, int patience, double *r, size_t *n)
{
    fw_packing_box box = {0.0, 60.0, 0.0, 60.0, false};
    fw_uniforms    random;
    fw_msg         m;
    size_t         n_left;
    double         size;
    *n = fill(r, 200, 3.3, 2.7, share, 3600.0);
    fw_uniforms_stream(&random, 3, FW_STREAM_TEST, 0, 0);
    assert_int_equal(fw_packing_begin(p, &box, *n, 3.3, 3.0, &m), FW_OK);
    for (double x = 5.0; x < 60.0; x += 10.0) {
        add_obstacle(p, x, -2.0, 3.0);
        add_obstacle(p, x, 62.0, 3.0);
    }
    assert_int_equal(fw_packing_place(p, *n, r, 0, &random, &n_left, &m), FW_OK);
    assert_true(n_left > 0);
    assert_int_equal(fw_growing_pack(p, patience, &random, &size, &m), FW_OK);
    assert_int_equal(p->n_own, *n);
    assert_memory_equal(p->r, r, *n * sizeof *r);
    return size;
}

static void floes_grow_where_pushing_fails(void **state)
{
    (void)state;
    fw_packing p = {0};
    double     r[200], x[200];
    size_t     n;
    /* Of the box; floes stick out by half where there are no rims. */
    assert_true(grow_between_rims(&p, 0.91, 4, r, &n) == 1.0);
    assert_no_overlap(&p);
    memcpy(x, p.x, n * sizeof *x);
    assert_true(grow_between_rims(&p, 0.91, 4, r, &n) == 1.0); /* in a used workspace: the same */
    assert_memory_equal(x, p.x, n * sizeof *x);
    double size = grow_between_rims(&p, 1.2, 1, r, &n); /* more than there is room for */
    assert_true(size > 0.8 && size < 1.0);
    fw_packing_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_never_overlap),
        cmocka_unit_test(what_cannot_be_packed_says_so),
        cmocka_unit_test(nothing_to_place_is_fine),
        cmocka_unit_test(overlapping_floes_are_pushed_apart),
        cmocka_unit_test(floes_grow_where_pushing_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
