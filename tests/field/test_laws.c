/* Statistics of the field over many tiles: what the settings ask for is what drifts past. Expected values are closed
 * forms worked out here from the law's statement; tolerances are given by the requirement or are four standard errors.
 * */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "field/field.h"
#include "field/field_mixes.h"

static const double PI = 3.14159265358979323846;

typedef struct strip {
    fw_field       *field;
    double          length; /* of a tile */
    size_t          n;      /* tiles of row 0, columns -1, -2 ... */
    const fw_tile **tiles;
} strip;

static strip make_strip(const fw_thickness_mix *mix, double concentration, uint64_t id, size_t n)
{
    strip             s = {.n = n, .tiles = calloc(n, sizeof *s.tiles)};
    fw_field_settings settings = {.seed = 2026, .id = id, .concentration = concentration, .mix = mix};
    fw_msg            m;
    assert_non_null(s.tiles);
    assert_int_equal(fw_field_create(&s.field, &settings, &m), FW_OK);
    s.length = fw_field_tile_length(s.field);
    for (size_t k = 0; k < n; k++) assert_int_equal(fw_field_tile(s.field, -1 - (int64_t)k, 0, &s.tiles[k], &m), FW_OK);
    return s;
}

static void free_strip(strip *s)
{
    fw_field_destroy(s->field);
    free(s->tiles);
}

/* Mean and second moment of the uniform law on [4h, sqrt(130h - 11)]. */
static double mean_of(double h) { return 0.5 * (4.0 * h + sqrt(130.0 * h - 11.0)); }
static double square_of(double h)
{
    double a = 4.0 * h, b = sqrt(130.0 * h - 11.0);
    return (a * a + a * b + b * b) / 3.0;
}

/* Share by number of class k. */
static double number_share(const fw_thickness_mix *mix, size_t k)
{
    if (!mix->by_area) return mix->classes[k].share;
    double sum = 0.0;
    for (size_t j = 0; j < mix->n_classes; j++) sum += mix->classes[j].share / square_of(mix->classes[j].thickness);
    return mix->classes[k].share / square_of(mix->classes[k].thickness) / sum;
}

static void concentration_sizes_and_shares_are_the_wanted_ones(void **state)
{
    (void)state;
    const fw_thickness_mix mixes[] = {mix_paper(false), mix_paper(true), mix_thin(false), mix_thin(true),
                                      mix_single(0.5)};
    static const double    concentrations[] = {0.05, 0.1, 0.4, 0.6, 0.65, 0.75, 0.8};
    for (size_t k = 0; k < 5; k++) {
        for (size_t c = 0; c < 7; c++) {
            const fw_thickness_mix *mix = &mixes[k];
            size_t                  n_tiles = concentrations[c] > 0.65 ? 15 : 60; /* tiles of dense ice are four times as large */
            strip                   s = make_strip(mix, concentrations[c], 10 * k + c, n_tiles);
            fw_field_census         n = fw_field_count(s.field);
            double                  mean = 0.0, counts[FW_MAX_CLASSES] = {0}, areas[FW_MAX_CLASSES] = {0}, area = 0.0;
            for (size_t j = 0; j < mix->n_classes; j++)
                mean += number_share(mix, j) * mean_of(mix->classes[j].thickness);
            assert_true(fabs(n.ice_area / n.tile_area - concentrations[c]) < 0.005);
            assert_true(fabs(n.sum_diameter / (double)n.n_floes / mean - 1.0) < 0.01);

            double total = 0.0;
            for (size_t t = 0; t < s.n; t++) {
                for (size_t i = 0; i < s.tiles[t]->n_floes; i++) {
                    size_t j = 0;
                    while (j < mix->n_classes && mix->classes[j].thickness != s.tiles[t]->thickness[i]) j++;
                    assert_true(j < mix->n_classes);
                    double r = s.tiles[t]->radius[i];
                    counts[j] += 1.0;
                    areas[j] += PI * r * r;
                    area += PI * r * r;
                    total += 1.0;
                }
            }
            /* Stratified draws: at most the two strata at a class's ends are left to chance, a variance of at most 1/4
             * each and tile. The area share follows the number and adds the scatter of sizes inside a stratum: below 2
             * points. */
            for (size_t j = 0; j < mix->n_classes; j++) {
                double share = number_share(mix, j);
                assert_true(fabs(counts[j] - share * total) <= 4.0 * sqrt(0.5 * (double)n_tiles));
                if (mix->by_area && concentrations[c] >= 0.1)
                    assert_true(fabs(areas[j] / area - mix->classes[j].share) < 0.02);
            }
            free_strip(&s);
        }
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void diameters_follow_their_law_in_every_class(void **state)
{
    /* Kolmogorov-Smirnov at 0.1 % (1.95 / sqrt n), conservative here: stratified samples lie closer to their law. */
    (void)state;
    enum { MOST = 20000 };
    static double          d[MOST];
    const fw_thickness_mix mixes[] = {mix_paper(false), mix_paper(true)};
    static const double    concentrations[] = {0.1, 0.6};
    for (size_t k = 0; k < 4; k++) {
        strip s = make_strip(&mixes[k / 2], concentrations[k % 2], k, 120);
        for (size_t j = 0; j < 5; j++) {
            double h = mixes[k / 2].classes[j].thickness, lo = 4.0 * h, hi = sqrt(130.0 * h - 11.0), worst = 0.0;
            size_t n = 0;
            for (size_t t = 0; t < s.n; t++) {
                for (size_t i = 0; i < s.tiles[t]->n_floes; i++) {
                    if (s.tiles[t]->thickness[i] == h && n < MOST) d[n++] = 2.0 * s.tiles[t]->radius[i];
                }
            }
            assert_true(n > 200);
            qsort(d, n, sizeof *d, ascending);
            assert_true(d[0] >= lo * (1.0 - 1e-15) && d[n - 1] <= hi * (1.0 + 1e-15));
            for (size_t i = 0; i < n; i++) {
                double law = (d[i] - lo) / (hi - lo);
                worst = fmax(worst, fmax(fabs(law - (double)i / (double)n), fabs(law - (double)(i + 1) / (double)n)));
            }
            assert_true(worst < 1.95 / sqrt((double)n));
        }
        free_strip(&s);
    }
}

static void flux_through_a_line_is_c_u_w(void **state)
{
    /* 3 h at 2 m/s: the floes of 21.6 km of the strip cross the line x = 0, y in [-50, 50). A floe counts when its
     * centre crosses; the ends lie inside tiles. Standard error: scatter of the area from tile to tile, and at both
     * ends at most that of independent floes in half a tile. Then the middle band |y| < 20 alone, with its standard
     * error from the tiles. */
    (void)state;
    static const double concentrations[] = {0.1, 0.4, 0.6};
    fw_thickness_mix    mix = mix_paper(false);
    for (size_t k = 0; k < 3; k++) {
        strip  s = make_strip(&mix, concentrations[k], k, 218);
        double far = -37.3, near = far - 2.0 * 10800.0, area = 0.0, band = 0.0, band_square = 0.0;
        double all = 0.0, all_square = 0.0, floe_square = 0.0;
        for (size_t t = 0; t < s.n; t++) {
            double in_band = 0.0, in_tile = 0.0;
            for (size_t i = 0; i < s.tiles[t]->n_floes; i++) {
                double a = PI * s.tiles[t]->radius[i] * s.tiles[t]->radius[i];
                if (s.tiles[t]->x[i] >= near && s.tiles[t]->x[i] < far) area += a;
                if (fabs(s.tiles[t]->y[i]) < 20.0) in_band += a;
                in_tile += a;
                floe_square += a * a;
            }
            all += in_tile;
            all_square += in_tile * in_tile;
            band += in_band;
            band_square += in_band * in_band;
        }
        double n = (double)s.n, wanted = concentrations[k] * 2.0 * 10800.0 * 100.0;
        double scatter = all_square - all * all / n, ends = 2.0 * 0.5 * 0.5 * floe_square / n;
        assert_true(fabs(area - wanted) < 4.0 * sqrt(scatter + ends));
        assert_true(sqrt(scatter + ends) < 0.004 * wanted);
        double mean = band / n, error = sqrt((band_square / n - mean * mean) / n);
        assert_true(fabs(mean - concentrations[k] * 40.0 * 100.0) < 4.0 * error);
        assert_true(error < 0.02 * mean);
        free_strip(&s);
    }
}

/* Length of the line x = const inside the strip's floes, added at position[(x mod L)] for lines 1 m apart. */
static void add_chords(const fw_tile *t, double L, size_t n_lines, double *chords)
{
    for (size_t i = 0; i < t->n_floes; i++) {
        double x = t->x[i], r = t->radius[i];
        for (double line = ceil(x - r - 0.5) + 0.5; line < x + r; line += 1.0) {
            double at = -line; /* columns count from -1 downwards: distance from the strip's head */
            if (at < 0.0 || at >= (double)n_lines) continue;
            chords[(size_t)at] += 2.0 * sqrt(r * r - (line - x) * (line - x)) / L;
        }
    }
}

static void no_place_in_a_tile_is_special(void **state)
{
    (void)state;
    enum { N_TILES = 400, N_BINS = 10 };
    static double       chords[N_TILES * 100];
    static const double concentrations[] = {0.4, 0.6};
    fw_thickness_mix    mix = mix_paper(false);
    for (size_t k = 0; k < 2; k++) {
        strip s = make_strip(&mix, concentrations[k], 50 + k, N_TILES);
        for (size_t i = 0; i < N_TILES * 100; i++) chords[i] = 0.0;
        for (size_t t = 0; t < s.n; t++) add_chords(s.tiles[t], s.length, N_TILES * 100, chords);
        double chi2 = 0.0;
        for (int parity = 0; parity < 2; parity++) {
            for (size_t b = 0; b < N_BINS; b++) {
                double sum = 0.0, square = 0.0, n = 0.0;
                for (size_t t = 1 + (size_t)parity; t + 1 < N_TILES;
                     t += 2) { /* the strip's ends lack a neighbour's floes */
                    double share = 0.0;
                    for (size_t i = 0; i < 10; i++) share += chords[100 * t + 10 * b + i] / 10.0;
                    sum += share;
                    square += share * share;
                    n += 1.0;
                }
                double mean = sum / n, error = sqrt((square / n - mean * mean) / n);
                double z = (mean - concentrations[k]) / error;
                assert_true(fabs(z) < 4.0);
                assert_true(error < 0.005);
                chi2 += z * z;
            }
        }
        assert_true(chi2 < 45.3); /* 0.1 % point of chi-square with 20 degrees of freedom */
        free_strip(&s);
    }
}

/* Pairs of floes with a gap below `gap` whose centres lie on either side of a line x = (k + at) L. */
static double pairs_across(const strip *s, double at, double gap)
{
    double n = 0.0;
    for (size_t t = 1; t + 1 < s->n; t++) {
        double line = ((double)s->tiles[t]->column + at) * s->length, reach = 2.0 * fw_field_max_radius(s->field) + gap;
        for (size_t u = t - 1; u <= t + 1; u++) {
            for (size_t i = 0; i < s->tiles[u]->n_floes; i++) {
                double xi = s->tiles[u]->x[i], yi = s->tiles[u]->y[i], ri = s->tiles[u]->radius[i];
                if (xi >= line || xi < line - reach) continue;
                for (size_t v = t - 1; v <= t + 1; v++) {
                    for (size_t j = 0; j < s->tiles[v]->n_floes; j++) {
                        double xj = s->tiles[v]->x[j];
                        if (xj < line || xj > line + reach) continue;
                        if (hypot(xi - xj, yi - s->tiles[v]->y[j]) < ri + s->tiles[v]->radius[j] + gap) n += 1.0;
                    }
                }
            }
        }
    }
    return n;
}

static void close_pairs_across_a_border_are_as_frequent_as_inside(void **state)
{
    /* Counts of close pairs scatter at most like Poisson numbers; 4 standard errors of a difference, relative to the
     * middle of the tile. A visible lane along borders would show as a lack of pairs there. */
    (void)state;
    static const double concentrations[] = {0.4, 0.6};
    fw_thickness_mix    mix = mix_paper(false);
    for (size_t k = 0; k < 2; k++) {
        strip  s = make_strip(&mix, concentrations[k], 70 + k, 400);
        double border = pairs_across(&s, 0.0, 0.5), quarter = pairs_across(&s, 0.25, 0.5),
               middle = pairs_across(&s, 0.5, 0.5);
        print_message(
            "C = %.1f: pairs with a gap below 0.5 m across x = k L: %.0f, (k + 1/4) L: %.0f, (k + 1/2) L: %.0f\n",
            concentrations[k], border, quarter, middle);
        assert_true(fabs(border - middle) < 4.0 * sqrt(border + middle));
        assert_true(fabs(quarter - middle) < 4.0 * sqrt(quarter + middle));
        free_strip(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(concentration_sizes_and_shares_are_the_wanted_ones),
        cmocka_unit_test(diameters_follow_their_law_in_every_class),
        cmocka_unit_test(flux_through_a_line_is_c_u_w),
        cmocka_unit_test(no_place_in_a_tile_is_special),
        cmocka_unit_test(close_pairs_across_a_border_are_as_frequent_as_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
