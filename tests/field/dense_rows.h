/* Rows of ice at 80 %, the densest that is made, and what is to be true of them. */
#ifndef FW_TESTS_DENSE_ROWS_H
#define FW_TESTS_DENSE_ROWS_H

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <stdlib.h>

#include <cmocka.h>

#include "field/field.h"
#include "field/field_mixes.h"

static inline fw_field *make_dense(const fw_thickness_mix *mix, uint64_t id)
{
    fw_field         *f;
    fw_msg            m;
    fw_field_settings s = {.seed = 80, .id = id, .concentration = FW_MAX_CONCENTRATION, .mix = mix};
    assert_int_equal(fw_field_create(&f, &s, &m), FW_OK);
    return f;
}

static inline const fw_tile *dense_tile(fw_field *f, int64_t column, int64_t row)
{
    const fw_tile *t;
    fw_msg         m = {{0}};
    if (fw_field_tile(f, column, row, &t, &m) != FW_OK) fail_msg("%s", m.text);
    return t;
}

static inline void assert_same_places(const fw_tile *a, const fw_tile *b)
{
    assert_int_equal(a->n_floes, b->n_floes);
    assert_memory_equal(a->x, b->x, a->n_floes * sizeof *a->x);
    assert_memory_equal(a->y, b->y, a->n_floes * sizeof *a->y);
}

static inline void assert_apart(const fw_tile *a, const fw_tile *b)
{
    size_t n = 0;
    for (size_t i = 0; i < a->n_floes; i++) {
        for (size_t j = a == b ? i + 1 : 0; j < b->n_floes; j++) {
            double dx = a->x[i] - b->x[j], dy = a->y[i] - b->y[j], s = a->radius[i] + b->radius[j];
            n += dx * dx + dy * dy <= s * s;
        }
    }
    assert_int_equal(n, 0);
}

/* Columns -1 .. -n_columns of rows -1 to 1: every tile is there, its floes overlap none of it or of the tiles right,
 * above and obliquely above; the concentration is within 0.3 % of the wanted one, the mean diameter within four
 * standard errors (of floes drawn one by one: stratified ones lie closer) of its law's, uniform on
 * [4h, sqrt(130h - 11)]. */
static inline void assert_dense_rows(const fw_thickness_mix *mix, uint64_t id, int64_t n_columns)
{
    fw_field *f = make_dense(mix, id);
    double    n = 0.0, sum = 0.0, square = 0.0, share = 0.0, wanted = 0.0;
    for (int64_t c = -1; c >= -n_columns; c--) {
        for (int64_t r = -1; r <= 1; r++) {
            const fw_tile *t = dense_tile(f, c, r);
            assert_apart(t, t);
            for (int64_t k = -1; k <= 1; k++) {
                if (r < 1) assert_apart(t, dense_tile(f, c + k, r + 1));
            }
            assert_apart(t, dense_tile(f, c + 1, r));
            for (size_t i = 0; i < t->n_floes; i++) {
                double d = 2.0 * t->radius[i];
                n += 1.0;
                sum += d;
                square += d * d;
            }
        }
        fw_field_forget(f, c + 2);
    }
    fw_field_census census = fw_field_count(f);
    for (size_t k = 0; k < mix->n_classes; k++) {
        double h = mix->classes[k].thickness, low = 4.0 * h, high = sqrt(130.0 * h - 11.0);
        double weight = mix->classes[k].share;
        if (mix->by_area) weight /= low * low + low * high + high * high;
        share += weight;
        wanted += weight * 0.5 * (low + high);
    }
    double mean = sum / n, error = sqrt((square / n - mean * mean) / n);
    assert_true(fabs(census.ice_area / census.tile_area / FW_MAX_CONCENTRATION - 1.0) < 0.003);
    assert_true(fabs(mean - wanted / share) < 4.0 * error);
    fw_field_destroy(f);
}

#endif
