/* What ice costs: tiles made one after the other and forgotten behind, as a window does. */
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "field/field.h"

enum { N_BATCHES = 9 };

static void row(double concentration, int64_t tiles_per_batch)
{
    fw_model m;
    fw_model_defaults(&m);
    fw_field_settings s = {.seed = 20260101, .id = 1, .concentration = concentration, .mix = &m.mixes[0], .size_law = m.size_law,
                           .size_a = m.size_a, .size_b = m.size_b};
    fw_field *f;
    fw_msg    msg = {""};
    if (fw_field_create(&f, &s, &msg) != FW_OK) {
        fprintf(stderr, "%s\n", msg.text);
        exit(1);
    }
    double  ms[N_BATCHES];
    int64_t column = 0;
    size_t  n_floes = 0;
    for (int b = -1; b < N_BATCHES; b++) { /* the first batch also makes what lies downstream of it: not counted */
        double start = bench_cpu_now();
        for (int64_t t = 0; t < tiles_per_batch; t++, column--) {
            const fw_tile *tile;
            if (fw_field_tile(f, column, 0, &tile, &msg) != FW_OK) {
                fprintf(stderr, "%s\n", msg.text);
                exit(1);
            }
            n_floes += tile->n_floes;
            fw_field_forget(f, column + 3);
        }
        if (b >= 0) ms[b] = 1e3 * (bench_cpu_now() - start) / (double)tiles_per_batch;
    }
    fw_field_census c        = fw_field_count(f);
    double          floes    = (double)n_floes / (double)-column, per_tile = bench_median(N_BATCHES, ms);
    double          achieved = c.ice_area / c.tile_area;
    printf("| %g %% | %.3g | %.0f | %.2f | %.2f %% | %.2f |\n", 100 * concentration, per_tile, floes, 1e3 * per_tile / floes, 100 * achieved,
           c.sum_diameter / (double)c.n_floes);
    bench_expect(per_tile > 0 && achieved > concentration - 0.01 && achieved < concentration + 0.01, "%g %%: achieved %g %%",
                 100 * concentration, 100 * achieved);
    fw_field_destroy(f);
}

int main(int argc, char **argv)
{
    bool is_quick = bench_start(argc, argv);
    printf("### Ice field\n\n");
    printf("Tiles of 100 m x 100 m, above 65 %% ice 200 m x 200 m, five classes 0.5-1.3 m; CPU per tile as median of %d batches. A window of 3 h at 2 m/s takes 217 "
           "tiles.\n\n", (int)N_BATCHES);
    printf("| ice | ms per tile | floes per tile | us per floe | achieved | mean diameter m |\n|---|---|---|---|---|---|\n");
    static const double CONCENTRATION[] = {0.1, 0.4, 0.6, 0.7, 0.8};
    for (size_t c = 0; c < 5; c++) row(CONCENTRATION[c], (is_quick ? 20 : 200) / (CONCENTRATION[c] > 0.65 ? 20 : 1)); /* larger tiles, each far dearer */
    printf("\n");
    return bench_end();
}
