/* Ice that comes from any side: what lies where it is needed is in the world, once. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"
#include "realisation/ice.h"

/* Untouched floes of the world whose centres lie in the box (kernel frame), and how many of them are there twice. */
static size_t count(const fw_world *w, const fw_box *b, size_t *n_twice)
{
    size_t n = 0;
    *n_twice = 0;
    for (size_t q = 0; q < w->n_blocks; q++)
        for (size_t i = 0; i < w->blocks[q].n; i++) {
            double X = w->blocks[q].x[i], Y = w->blocks[q].y[i], x = X + w->drift_x, y = Y + w->drift_y;
            if (w->blocks[q].is_taken[i] || x < b->x0 || x > b->x1 || y < b->y0 || y > b->y1) continue;
            n++;
            for (size_t p = 0; p < q; p++)
                for (size_t k = 0; k < w->blocks[p].n; k++) *n_twice += w->blocks[p].x[k] == X && w->blocks[p].y[k] == Y;
        }
    return n;
}

/* The same box of a field that nobody has drifted through. */
static size_t count_tiles(const fw_field_settings *s, double x, double y, const fw_box *b)
{
    fw_field      *f;
    const fw_tile *t;
    size_t         n = 0;
    assert_int_equal(fw_field_create(&f, s, NULL), FW_OK);
    double L = fw_field_tile_length(f);
    for (int64_t c = (int64_t)floor((b->x0 - x) / L) - 1; c <= (int64_t)floor((b->x1 - x) / L) + 1; c++)
        for (int64_t r = (int64_t)floor((b->y0 - y) / L + 0.5) - 1; r <= (int64_t)floor((b->y1 - y) / L + 0.5) + 1; r++) {
            assert_int_equal(fw_field_tile(f, c, r, &t, NULL), FW_OK);
            for (size_t i = 0; i < t->n_floes; i++) {
                double px = t->x[i] + x, py = t->y[i] + y;
                n += px >= b->x0 && px <= b->x1 && py >= b->y0 && py <= b->y1;
            }
        }
    fw_field_destroy(f);
    return n;
}

/* At 0.2 % ice every other tile is empty. Two that are next to each other come at once and go, and come back, one by one:
 * nothing is lost, and nothing comes twice. */
static void empty_tiles_come_and_go(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    fw_field_settings s = {.seed = 3, .id = 1, .concentration = 0.002, .mix = &m.mixes[0], .size_law = m.size_law};
    fw_world         *w;
    fw_ice            ice;
    fw_box            need = {400, 480, -50, 50}; /* far from the structure, which would swallow some */
    assert_int_equal(fw_world_create(&w, 3.7, NULL), FW_OK);
    assert_int_equal(fw_ice_lay(&ice, &s, w, 50, 16, 120, FW_ICE_ANYWHERE, NULL), FW_OK);
    size_t all = 0, n_twice;
    for (int k = 0; k < 400; k++) {
        w->drift_x += k % 20 == 0 ? 230 : 0, w->drift_y = 150 * sin(0.31 * k);
        assert_int_equal(fw_ice_feed(&ice, w, &need, NULL), FW_OK);
        size_t n = count(w, &need, &n_twice);
        assert_int_equal(n, count_tiles(&s, w->drift_x, w->drift_y, &need));
        assert_int_equal(n_twice, 0);
        all += n;
    }
    assert_true(all > 100);
    fw_ice_free(&ice);
    fw_world_destroy(w);
}

/* Aslant, for a long way: tiles that have passed are forgotten, the rest is as ever. */
static void passes_aslant(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    fw_field_settings s = {.seed = 3, .id = 2, .concentration = 0.05, .mix = &m.mixes[0], .size_law = m.size_law};
    fw_world         *w;
    fw_ice            ice;
    size_t            n_twice;
    assert_int_equal(fw_world_create(&w, 3.7, NULL), FW_OK);
    assert_int_equal(fw_ice_lay(&ice, &s, w, 50, 16, 120, FW_ICE_ACROSS, NULL), FW_OK);
    for (int k = 0; k < 400; k++) {
        fw_box need = {-400 - 100 * sin(k), -320, -50, 50 + 80 * cos(k)}; /* disturbed ice reaches farther and less far */
        w->drift_x += 15, w->drift_y -= 6;
        assert_int_equal(fw_ice_feed(&ice, w, &need, NULL), FW_OK);
        assert_int_equal(count(w, &need, &n_twice), count_tiles(&s, w->drift_x, w->drift_y, &need));
        assert_int_equal(n_twice, 0);
    }
    fw_ice_free(&ice);
    fw_world_destroy(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(empty_tiles_come_and_go), cmocka_unit_test(passes_aslant)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
