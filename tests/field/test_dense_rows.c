/* Many tiles of the densest ice, in row 0 and beside it: none fails
 * where the floes are not nearly equal and as long as a seventh of the tile. */
#include <stdio.h>

#include "field/dense_rows.h"

static void rows_of_every_mix_are_packed(void **state)
{
    (void)state;
    fw_thickness_mix mixes[] = {mix_paper(false), mix_paper(true), mix_thin(false), mix_thin(true),
                                mix_single(0.5),  mix_single(1.3), mix_single(3.0), mix_single(4.0)};
    for (uint64_t k = 0; k < sizeof mixes / sizeof *mixes; k++) assert_dense_rows(&mixes[k], 100 + k, 100);
}

static void a_tile_beside_row_zero_is_a_pure_function(void **state)
{
    (void)state;
    fw_thickness_mix mix = mix_single(4.0);
    fw_field        *whole = make_dense(&mix, 1), *f = make_dense(&mix, 1);
    for (int64_t c = -6; c <= 1; c++) {
        for (int64_t r = 1; r >= -1; r--) (void)dense_tile(whole, c, r);
    }
    for (int64_t c = 0; c >= -5; c--) assert_same_places(dense_tile(f, c, 1), dense_tile(whole, c, 1));
    fw_field_destroy(f);
    fw_field_destroy(whole);
}

static void what_is_out_of_reach_is_said(void **state)
{
    /* Equal floes, 7.5 to a tile's length: rows beside row 0 take 80 % of them now and then only. */
    (void)state;
    fw_thickness_mix mix = mix_single(8.04);
    fw_field        *f = make_dense(&mix, 0);
    const fw_tile   *t;
    fw_msg           m = {{0}}, again = {{0}};
    int64_t          c = 0;
    while (fw_field_tile(f, c, 1, &t, &m) == FW_OK) c--;
    assert_int_equal(fw_field_tile(f, c, 1, &t, &again), FW_E_NUMERIC);
    assert_string_equal(m.text, again.text);
    long long column, row;
    double    wanted, reached;
    assert_int_equal(sscanf(m.text,
                            "ice field: tile (%lld, %lld) was to be packed to %lf %%, reached without overlap: %lf %%;",
                            &column, &row, &wanted, &reached),
                     4);
    assert_true(wanted == 80.0 && reached > 70.0 && reached < 80.0);
    fw_field_destroy(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_every_mix_are_packed),
        cmocka_unit_test(a_tile_beside_row_zero_is_a_pure_function),
        cmocka_unit_test(what_is_out_of_reach_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
