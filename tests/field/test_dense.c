/* The densest ice of thick floes, where pushing apart fails in every third tile, here in (-1, 0), and floes are grown.
 * Many tiles, and rows beside row 0: test_dense_rows.c. */
#include "field/dense_rows.h"

static void grown_tiles_are_pure_functions(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_single(4.0);
    fw_field        *whole = make_dense(&mix, 0), *f = make_dense(&mix, 0);
    for (int64_t c = -3; c <= 0; c++) (void)dense_tile(whole, c, 0);
    for (int64_t c = -1; c >= -2; c--) {
        assert_same_places(dense_tile(f, c, 0), dense_tile(whole, c, 0));
        assert_apart(dense_tile(f, c, 0), dense_tile(f, c, 0));
        assert_apart(dense_tile(f, c, 0), dense_tile(whole, c + 1, 0));
    }
    fw_field_census n = fw_field_count(whole);
    assert_true(fabs(n.ice_area / n.tile_area / FW_MAX_CONCENTRATION - 1.0) < 0.003);
    fw_field_destroy(f);
    fw_field_destroy(whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(grown_tiles_are_pure_functions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
