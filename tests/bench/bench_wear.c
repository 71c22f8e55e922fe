/* What the wear of one interval costs: from the integrator's stages to the ring, by kind of interval and number of laws. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "abrasion/wear.h"
#include "bench/bench.h"

enum { N_BATCHES = 9, N_INTERVALS = 512 };

static const fw_abrasion_law LAWS[FW_MAX_LAWS] = {{"bekker2011", 0.116, 1.121, true},
                                                  {"archard", 0.01, 1.0, false},
                                                  {"power", 0.01, 1.9, false},
                                                  {"power", 0.01, 0.5, false}};

/* Floes of every kind, in an order that no branch predictor learns: a slide with a share `change` gained or lost over the
 * interval, while the patch moves over `arcs` arcs of 360. */
static void slides(fw_wear_interval *iv, double change, double arcs)
{
    uint32_t s = 7;
    for (size_t i = 0; i < N_INTERVALS; i++) {
        double r[6];
        for (int q = 0; q < 6; q++) s = s * 1664525u + 1013904223u, r[q] = (double)(s >> 8) / (1 << 24);
        double g = change * (2 * r[3] - 1), depth = 0.005 + 0.1 * r[0], length = 0.02 + 0.05 * r[4];
        iv[i] = (fw_wear_interval){.length = length,
                                   .since_touch = 1 + r[1],
                                   .n_stages = 3,
                                   .depth = {depth, depth * (1 + g)},
                                   .rate = {depth * g / length, depth * g / length},
                                   .angle = {6.28 * r[2], 6.28 * r[2] + arcs * (2 * r[5] - 1) * 6.28 / 360},
                                   .at = {0, 0.58578643762690495, 1},
                                   .radius = 1.25 + 3 * r[1],
                                   .thickness = 0.5 + 0.8 * r[0]};
        for (int q = 0; q < 3; q++)
            iv[i].normal[q] = 2e6 * depth * (1 + g * iv[i].at[q]), iv[i].slip[q] = 0.3 * (1 - g * iv[i].at[q]);
    }
}

/* Head-on touches in closed form (critically damped), steps as the kernel takes them: 0.05/w, then three times longer each. */
static void touches(fw_wear_interval *iv)
{
    for (size_t i = 0; i < N_INTERVALS; i++) {
        double m = 2000 + 10 * (double)i, w = sqrt(2e6 / m), v = 2, t0 = 0, h = 0.05 / w;
        for (size_t k = 0; k < i % 4; k++) t0 += h, h *= k == 2 ? 2 : 3;
        iv[i] = (fw_wear_interval){.length = h,
                                   .since_touch = t0,
                                   .impact_left = 2 / w - t0,
                                   .n_stages = 3,
                                   .angle = {0.01 * (double)i, 0.01 * (double)i + 0.002},
                                   .at = {0, 0.58578643762690495, 1},
                                   .radius = 1.25,
                                   .thickness = 0.5};
        for (int q = 0; q < 2; q++) {
            double t = t0 + q * h;
            iv[i].depth[q] = v * t * exp(-w * t), iv[i].rate[q] = v * exp(-w * t) * (1 - w * t);
        }
        for (int q = 0; q < 3; q++) {
            double t = t0 + iv[i].at[q] * h;
            iv[i].normal[q] = m * w * v * exp(-w * t) * (2 - w * t), iv[i].slip[q] = 0.5 * exp(-w * t);
        }
    }
}

static void fades(fw_wear_interval *iv)
{
    slides(iv, 0.1, 1);
    for (size_t i = 0; i < N_INTERVALS; i++)
        for (int q = 0; q < 3; q++) iv[i].normal[q] *= 1 - (1 + 0.002 * (double)i) * iv[i].at[q];
}

static void row(const char *name, const fw_wear_interval *iv, fw_wear_rule rule, double batch_s)
{
    printf("| %s |", name);
    for (size_t n_laws = 1; n_laws <= FW_MAX_LAWS; n_laws *= 2) {
        fw_wear w;
        double  ns[N_BATCHES];
        fw_msg  m = {""};
        if (fw_wear_init(&w, 3.7, 360, n_laws, LAWS, &m) != FW_OK) exit(1);
        w.rule = rule, w.is_open = true;
        for (size_t b = 0; b < N_BATCHES; b++) {
            double start = bench_cpu_now(), done = 0;
            do {
                for (size_t i = 0; i < N_INTERVALS; i++) fw_wear_collect(&w, &iv[i]);
                done += N_INTERVALS;
            } while (bench_cpu_now() - start < batch_s);
            ns[b] = 1e9 * (bench_cpu_now() - start) / done;
        }
        printf(" %.0f |", bench_median(N_BATCHES, ns));
        fw_wear_finish(&w);
        bench_expect(w.sums[0].along > 0 && fw_wear_conservation(&w) < 1e-10,
                     "%s: %zu laws: ring and patch differ by %g", name, n_laws, fw_wear_conservation(&w));
        fw_wear_free(&w);
    }
    printf("\n");
}

/* With and without a crushing limit in turn; ratio of the batches' medians. */
static void limited(const char *name, const fw_wear_interval *iv, double pressure, double batch_s)
{
    fw_wear w[2];
    double  ns[2][N_BATCHES];
    fw_msg  m = {""};
    for (int i = 0; i < 2; i++) {
        if (fw_wear_init(&w[i], 3.7, 360, 1, LAWS, &m) != FW_OK) exit(1);
        w[i].is_open = true;
    }
    fw_wear_limit_pressure(&w[1], &(fw_pressure_law){pressure, 0});
    for (size_t b = 0; b < N_BATCHES; b++)
        for (int i = 0; i < 2; i++) {
            double start = bench_cpu_now(), done = 0;
            do {
                for (size_t k = 0; k < N_INTERVALS; k++) fw_wear_collect(&w[i], &iv[k]);
                done += N_INTERVALS;
            } while (bench_cpu_now() - start < batch_s);
            ns[i][b] = 1e9 * (bench_cpu_now() - start) / done;
        }
    fw_wear_finish(&w[1]);
    bench_expect(w[1].sums[0].along > 0 && fw_wear_conservation(&w[1]) < 1e-10, "%s: ring and patch differ by %g", name,
                 fw_wear_conservation(&w[1]));
    double off = bench_median(N_BATCHES, ns[0]), on = bench_median(N_BATCHES, ns[1]);
    printf("| %s | %.2f | %.0f | %.0f | %.2f |\n", name, pressure * 1e-6, off, on, on / off);
    for (int i = 0; i < 2; i++) fw_wear_free(&w[i]);
}

static void limits(fw_wear_interval *iv, double batch_s)
{
    printf("\nUnder a crushing limit, law with exponent 1.121:\n\n| interval | limit MPa | ns without | ns with | ratio |\n|---|---|---|---|---|\n");
    slides(iv, 0.05, 1);
    limited("slide, patch moves up to an arc", iv, 5e6, batch_s);
    limited("the same, limit in the midst of the pressures", iv, 0.12e6, batch_s);
    touches(iv);
    limited("one of the first four after a touch", iv, 5e6, batch_s);
    fades(iv);
    limited("force fades", iv, 5e6, batch_s);
}

int main(int argc, char **argv)
{
    double            batch_s = bench_start(argc, argv) ? 0.002 : 0.1;
    fw_wear_interval *iv = calloc(N_INTERVALS, sizeof *iv);
    if (!iv) return 1;
    printf("### Time per interval of a structure contact\n\n");
    printf("Stages to ring of 360 arcs, %d different intervals in turn, patches some 10 to 30 arcs wide. Median of %d "
           "batches of %g s. At\n"
           "10 %% concentration 94 of 100 intervals are slides.\n\n",
           (int)N_INTERVALS, (int)N_BATCHES, batch_s);
    printf("| interval | ns, 1 law | 2 laws | 4 laws |\n|---|---|---|---|\n");
    slides(iv, 0.05, 1);
    row("slide, patch moves up to an arc", iv, FW_WEAR_HERMITE, batch_s);
    row("the same, naive rule", iv, FW_WEAR_NAIVE, batch_s);
    slides(iv, 0.2, 8);
    row("slide, patch moves up to eight arcs", iv, FW_WEAR_HERMITE, batch_s);
    touches(iv);
    row("one of the first four after a touch", iv, FW_WEAR_HERMITE, batch_s);
    fades(iv);
    row("force fades", iv, FW_WEAR_HERMITE, batch_s);
    limits(iv, batch_s);
    printf("\n");
    free(iv);
    return bench_end();
}
