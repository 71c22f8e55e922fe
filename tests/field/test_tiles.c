/* Tiles: what they promise one by one. No overlap is checked by brute force; purity by comparing bits. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "field/field.h"
#include "field/field_mixes.h"

static const double PI = 3.14159265358979323846;

static fw_field *make(const fw_thickness_mix *mix, double concentration, uint64_t seed, uint64_t id)
{
    fw_field         *f;
    fw_msg            m;
    fw_field_settings s = {.seed = seed, .id = id, .concentration = concentration, .mix = mix};
    assert_int_equal(fw_field_create(&f, &s, &m), FW_OK);
    return f;
}

static const fw_tile *tile_of(fw_field *f, int64_t column, int64_t row)
{
    const fw_tile *t;
    fw_msg         m = {{0}};
    fw_status      status = fw_field_tile(f, column, row, &t, &m);
    if (status != FW_OK) fail_msg("%s", m.text);
    assert_true(t->column == column && t->row == row);
    return t;
}

static void assert_same(const fw_tile *a, const fw_tile *b)
{
    size_t bytes = a->n_floes * sizeof(double);
    assert_int_equal(a->n_floes, b->n_floes);
    assert_memory_equal(a->x, b->x, bytes);
    assert_memory_equal(a->y, b->y, bytes);
    assert_memory_equal(a->radius, b->radius, bytes);
    assert_memory_equal(a->thickness, b->thickness, bytes);
}

/* Overlapping or touching pairs between two tiles' floes (or inside one tile), all pairs. */
static size_t overlaps(const fw_tile *a, const fw_tile *b)
{
    size_t n = 0;
    for (size_t i = 0; i < a->n_floes; i++) {
        for (size_t j = a == b ? i + 1 : 0; j < b->n_floes; j++) {
            double dx = a->x[i] - b->x[j], dy = a->y[i] - b->y[j], s = a->radius[i] + b->radius[j];
            n += dx * dx + dy * dy <= s * s;
        }
    }
    return n;
}

static void nothing_overlaps_anywhere(void **state)
{
    (void)state;
    const struct {
        fw_thickness_mix mix;
        double           concentration;
    } cases[] = {{mix_paper(false), 0.1}, {mix_paper(false), 0.4},  {mix_paper(false), 0.65},
                 {mix_paper(true), 0.65}, {mix_thin(false), 0.65},  {mix_single(0.5), 0.65},
                 {mix_single(1.3), 0.65}, {mix_single(8.04), 0.65}, {mix_single(0.0855), 0.02},
                 {mix_paper(false), 0.8}, {mix_thin(false), 0.8},   {mix_single(8.04), 0.75}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        fw_field      *f = make(&cases[k].mix, cases[k].concentration, 5, k);
        const fw_tile *t[15];
        double         L = fw_field_tile_length(f);
        bool           is_dense = cases[k].concentration > 0.65; /* odd rows, which are dear, at the other concentrations */
        int            n_tiles = is_dense ? 5 : 15;
        for (int i = 0; i < n_tiles; i++) {
            t[i] = tile_of(f, i % 5 - 2, is_dense ? 0 : i / 5 - 1);
            for (size_t n = 0; n < t[i]->n_floes; n++) {
                double x = t[i]->x[n], y = t[i]->y[n], c = (double)t[i]->column, r = (double)t[i]->row;
                assert_true(x >= c * L && x < (c + 1.0) * L && y >= (r - 0.5) * L && y < (r + 0.5) * L);
                assert_true(t[i]->radius[n] <= fw_field_max_radius(f));
                assert_true(n == 0 || t[i]->radius[n] <= t[i]->radius[n - 1]);
            }
        }
        for (int i = 0; i < n_tiles; i++) {
            for (int j = i; j < n_tiles; j++) assert_int_equal(overlaps(t[i], t[j]), 0);
        }
        fw_field_destroy(f);
    }
}

static void no_overlap_far_from_the_origin(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_thin(false);
    fw_field        *f = make(&mix, 0.65, 5, 0);
    int64_t          far = 1 << 20;
    for (int64_t c = -far; c <= far; c += 2 * far) {
        int64_t        inside = c < 0 ? c + 1 : c - 1;
        const fw_tile *a = tile_of(f, c, 0), *b = tile_of(f, inside, 0);
        assert_int_equal(overlaps(a, a) + overlaps(b, b) + overlaps(a, b), 0);
    }
    const fw_tile *t;
    fw_msg         m;
    assert_int_equal(fw_field_tile(f, far + 1, 0, &t, &m), FW_E_ARG);
    assert_int_equal(fw_field_tile(f, 0, -far - 1, &t, &m), FW_E_ARG);
    assert_int_equal(fw_field_tile(f, INT64_MIN, INT64_MAX, &t, NULL), FW_E_ARG);
    fw_field_destroy(f);
}

static void a_tile_is_a_pure_function(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_paper(false);
    for (int crowded = 0; crowded < 2; crowded++) {
        double    concentration = crowded ? 0.65 : 0.3;
        fw_field *whole = make(&mix, concentration, 5, 3);
        for (int64_t c = 30; c >= -40; c--) {
            for (int64_t r = -2; r <= 2; r++) (void)tile_of(whole, c, r);
        }
        /* Alone, each in a field of its own. */
        static const int64_t place[][2] = {{0, 0}, {-1, 0}, {3, 1}, {2, -1}, {-7, 2}, {-20, -2}};
        for (size_t k = 0; k < sizeof place / sizeof *place; k++) {
            fw_field *f = make(&mix, concentration, 5, 3);
            assert_same(tile_of(f, place[k][0], place[k][1]), tile_of(whole, place[k][0], place[k][1]));
            fw_field_destroy(f);
        }
        /* In another order, rows beside first. */
        fw_field *f = make(&mix, concentration, 5, 3);
        for (int64_t k = 0; k < 41; k++) {
            int64_t c = (k * 17) % 41 - 20;
            for (int64_t r = 1; r >= -1; r--) assert_same(tile_of(f, c, r), tile_of(whole, c, r));
        }
        fw_field_destroy(f);
        /* As a strip that forgets; a forgotten tile asked again; tiles still held keep their address. */
        f = make(&mix, concentration, 5, 3);
        for (int64_t c = 30; c >= -40; c--) {
            const fw_tile *t = tile_of(f, c, 0);
            fw_field_forget(f, c + 1);
            assert_ptr_equal(t, tile_of(f, c, 0));
            assert_same(t, tile_of(whole, c, 0));
            if (c % 5 == 0) assert_same(tile_of(f, c, -1), tile_of(whole, c, -1));
        }
        assert_same(tile_of(f, 30, 0), tile_of(whole, 30, 0));
        assert_same(tile_of(f, 29, 1), tile_of(whole, 29, 1));
        fw_field_destroy(f);
        fw_field_destroy(whole);
    }
}

static void fields_differ_by_seed_id_and_place(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_paper(false);
    fw_field        *f[] = {make(&mix, 0.4, 5, 3), make(&mix, 0.4, 6, 3), make(&mix, 0.4, 5, 4)};
    const fw_tile   *t[] = {tile_of(f[0], 0, 0),  tile_of(f[1], 0, 0), tile_of(f[2], 0, 0), tile_of(f[0], 1, 0),
                            tile_of(f[0], -1, 0), tile_of(f[0], 0, 1), tile_of(f[0], 0, -1)};
    double           L = fw_field_tile_length(f[0]);
    for (int i = 0; i < 7; i++) {
        for (int j = 0; j < i; j++) {
            assert_true(t[i]->radius[0] != t[j]->radius[0]);
            double xi = t[i]->x[0] - (double)t[i]->column * L, xj = t[j]->x[0] - (double)t[j]->column * L;
            assert_true(fabs(xi - xj) > 1e-9);
        }
    }
    for (int i = 0; i < 3; i++) fw_field_destroy(f[i]);
}

static void row_zero_needs_row_zero_alone(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_paper(false);
    fw_field        *f = make(&mix, 0.5, 1, 1);
    for (int64_t c = 0; c > -50; c--) (void)tile_of(f, c, 0);
    fw_field_census n = fw_field_count(f);
    assert_true(n.n_tiles >= 50 && n.n_tiles <= 52); /* a second column may finish on the way */
    fw_field_destroy(f);
}

static void census_counts_every_tile_once(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_thin(true);
    fw_field        *f = make(&mix, 0.4, 9, 1);
    fw_field_census  n = fw_field_count(f);
    assert_true(n.n_tiles == 0 && n.n_floes == 0 && n.ice_area == 0.0 && n.tile_area == 0.0);
    size_t floes = 0;
    double area = 0.0, diameters = 0.0;
    for (int64_t c = 9; c >= -40; c--) {
        const fw_tile *t = tile_of(f, c, 0);
        fw_field_forget(f, c + 2);
        floes += t->n_floes;
        for (size_t i = 0; i < t->n_floes; i++) {
            area += PI * t->radius[i] * t->radius[i];
            diameters += 2.0 * t->radius[i];
        }
    }
    n = fw_field_count(f);
    assert_true(n.n_tiles == 50 || n.n_tiles == 51);
    assert_true(fabs(n.tile_area - 1e4 * (double)n.n_tiles) < 1e-6);
    if (n.n_tiles == 50) {
        assert_int_equal(n.n_floes, floes);
        assert_true(fabs(n.ice_area / area - 1.0) < 1e-12 && fabs(n.sum_diameter / diameters - 1.0) < 1e-12);
    } else { /* one neighbour more, finished on the way at either end */
        assert_true(fabs((double)n.n_floes / (double)floes - 51.0 / 50.0) < 0.01);
        assert_true(fabs(n.ice_area / area - 51.0 / 50.0) < 0.01);
    }
    (void)tile_of(f, 9, 0); /* forgotten, made again: not counted again */
    assert_true(fw_field_count(f).n_tiles <= n.n_tiles + 1);
    fw_field_destroy(f);
}

static void settings_out_of_range_are_refused(void **state)
{
    (void)state;
    static const double bad[] = {0.0, -0.1, 0.8000001, 1.0, NAN, INFINITY};
    fw_thickness_mix    mix = mix_paper(false);
    fw_field           *f;
    fw_msg              m;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        fw_field_settings s = {.concentration = bad[k], .mix = &mix};
        assert_int_equal(fw_field_create(&f, &s, &m), FW_E_ARG);
        assert_null(f);
        assert_non_null(strstr(m.text, "concentration"));
        assert_non_null(strstr(m.text, "80"));
    }
    fw_field_settings s = {.concentration = 0.4, .mix = NULL};
    assert_int_equal(fw_field_create(&f, &s, &m), FW_E_ARG);
    mix.classes[1].thickness = 0.05;
    s.mix = &mix;
    assert_int_equal(fw_field_create(&f, &s, &m), FW_E_ARG);
    assert_non_null(strstr(m.text, "0.05"));
    fw_field_destroy(NULL);
}

static void the_thinnest_mix_of_open_water_works(void **state)
{
    /* So little ice that most tiles are empty: n = 0 is a tile, too. C L^2 / E[A] = 1e-5 x 57886 / 812.3 = 0.00071. */
    (void)state;
    fw_thickness_mix mix = mix_single(8.04);
    fw_field        *f = make(&mix, 1e-5, 2, 2);
    for (int64_t c = 0; c > -100; c--) (void)tile_of(f, c, 0);
    assert_true(fw_field_count(f).n_floes <= 3);
    fw_field_forget(f, INT64_MIN);
    fw_field_forget(f, INT64_MAX);
    fw_field_destroy(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_overlaps_anywhere),         cmocka_unit_test(no_overlap_far_from_the_origin),
        cmocka_unit_test(a_tile_is_a_pure_function),         cmocka_unit_test(fields_differ_by_seed_id_and_place),
        cmocka_unit_test(row_zero_needs_row_zero_alone),     cmocka_unit_test(census_counts_every_tile_once),
        cmocka_unit_test(settings_out_of_range_are_refused), cmocka_unit_test(the_thinnest_mix_of_open_water_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
