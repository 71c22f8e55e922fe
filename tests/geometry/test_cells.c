#include "check.h"
#include "geometry/cells.h"

#include <stdbool.h>
#include <stdlib.h>

/* Law: every pair closer than the reach is found by walking the cells in range; items are each there once. */
static void finds_every_pair(void **state)
{
    (void)state;
    enum { N = 400 };
    double   x[N], y[N];
    uint32_t s = 12345;
    for (int i = 0; i < N; i++) {
        s = s * 1664525u + 1013904223u, x[i] = (double)(s >> 8) / (1 << 24) * 120 - 60;
        s = s * 1664525u + 1013904223u, y[i] = (double)(s >> 8) / (1 << 24) * 40;
    }
    fw_cells c = {0};
    assert_int_equal(fw_cells_build(&c, N, x, y, 1, 5, NULL), FW_OK);
    bool seen[N] = {false};
    for (size_t k = 0; k < c.n_items; k++) {
        assert_false(seen[c.item[k]]);
        seen[c.item[k]] = true;
    }
    for (int i = 0; i < N; i++) {
        bool   near[N] = {false};
        size_t a, b, d, e;
        fw_cells_range(&c, x[i], y[i], 7, &a, &b, &d, &e);
        for (size_t iy = d; iy < e; iy++)
            for (size_t ix = a; ix < b; ix++)
                for (size_t q = c.start[iy * c.nx + ix]; q < c.start[iy * c.nx + ix + 1]; q++) near[c.item[q]] = true;
        for (int j = 0; j < N; j++)
            if (hypot(x[i] - x[j], y[i] - y[j]) <= 7) assert_true(near[j]);
    }
    fw_cells_free(&c);
}

static void ugly_points(void **state)
{
    (void)state;
    fw_cells c = {0};
    double   x[3] = {0, 1e9, -1e9}, y[3] = {5, 5, 5};
    assert_int_equal(fw_cells_build(&c, 0, NULL, NULL, 1, 5, NULL), FW_OK);
    assert_int_equal(c.start[c.nx * c.ny], 0);
    assert_int_equal(fw_cells_build(&c, 3, x, y, 1, 1e-3, NULL), FW_OK); /* the side grows */
    assert_true(c.nx * c.ny <= 16384);
    x[1] = NAN;
    assert_int_equal(fw_cells_build(&c, 3, x, y, 1, 5, NULL), FW_E_NUMERIC);
    size_t a, b, d, e;
    fw_cells_range(&c, 1e300, 0, 1, &a, &b, &d, &e);
    assert_true(a >= b);
    fw_cells_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_every_pair), cmocka_unit_test(ugly_points)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
