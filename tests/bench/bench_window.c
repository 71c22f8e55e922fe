/* What a window costs, and how far it is from a finer one; and the same windows stepped floe by floe at 1 ms. */
#include <math.h>
#include <stdio.h>

#include "bench/bench.h"

enum { MAX_IDS = 16 };

static const double SPEED           = 2; /* [m/s] */
static const double CONCENTRATION[] = {0.1, 0.4, 0.6};
static const double ACCURACY[]      = {0.1, 0.01, 0.001};

static void long_windows(double window, size_t n_ids)
{
    printf("Windows of %g s at %g m/s and their automatic warm-up, medians of %zu realisations; depth: mean over the arcs within "
           "75 degrees at -10 degC.\n\n", window, SPEED, n_ids);
    printf("| ice | accuracy | CPU s | hits | force evaluations | per hit | sub-steps | energy balance | depth 1e-4 mm |\n");
    printf("|---|---|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < sizeof CONCENTRATION / sizeof *CONCENTRATION; c++)
        for (size_t a = 0; a < sizeof ACCURACY / sizeof *ACCURACY; a++) {
            double cpu[MAX_IDS], hits[MAX_IDS], evaluations[MAX_IDS], per_hit[MAX_IDS], steps[MAX_IDS], balance[MAX_IDS], depth[MAX_IDS];
            for (size_t i = 0; i < n_ids; i++) {
                fw_record r = bench_realise(CONCENTRATION[c], SPEED, window, ACCURACY[a], 0, i);
                cpu[i] = r.host_cpu_s, hits[i] = r.hits, evaluations[i] = r.force_evaluations, steps[i] = r.steps;
                per_hit[i] = r.force_evaluations / r.hits, balance[i] = r.energy_truncation, depth[i] = bench_depth(&r);
                bench_expect(r.hits > 0 && depth[i] > 0, "no hits at %g %% in %g s", 100 * CONCENTRATION[c], window);
                bench_expect(r.energy_truncation <= ACCURACY[a], "energy balance %g at accuracy %g", r.energy_truncation, ACCURACY[a]);
                fw_record_free(&r);
            }
            double seconds = bench_median(n_ids, cpu);
            printf("| %g %% | %g %% | %.3g | %.0f | %.3g | %.0f | %.3g | %.1e | %.4g |\n", 100 * CONCENTRATION[c], 100 * ACCURACY[a],
                   seconds, bench_median(n_ids, hits), bench_median(n_ids, evaluations), bench_median(n_ids, per_hit),
                   bench_median(n_ids, steps), bench_median(n_ids, balance), 1e4 * bench_median(n_ids, depth));
        }
    printf("\n");
}

typedef struct method {
    const char *name;
    double      accuracy, plain_step;
} method;

/* The reference stands last; the plain method's accuracy only sets what it does not use. */
static const method METHOD[] = {{"plain, every floe at 1 ms", 0.01, 1e-3}, {"accuracy 10 %", 0.1, 0}, {"accuracy 1 %", 0.01, 0},
                                {"accuracy 0.1 %", 0.001, 0}, {"accuracy 0.01 %", 0.0001, 0}};
enum { N_METHODS = sizeof METHOD / sizeof METHOD[0], PLAIN = 0, REFERENCE = N_METHODS - 1 };

static void against_plain(double concentration, double window, size_t n_ids)
{
    double cpu[N_METHODS][MAX_IDS], depth[N_METHODS][MAX_IDS], per_hit[N_METHODS][MAX_IDS], ratio[MAX_IDS], change[MAX_IDS];
    for (size_t i = 0; i < n_ids; i++)
        for (size_t k = 0; k < N_METHODS; k++) { /* alternately: whoever else uses the machine slows all of them */
            fw_record r = bench_realise(concentration, SPEED, window, METHOD[k].accuracy, METHOD[k].plain_step, i);
            cpu[k][i] = r.host_cpu_s, depth[k][i] = bench_depth(&r), per_hit[k][i] = r.force_evaluations / r.hits;
            fw_record_free(&r);
        }
    double mean = bench_mean(n_ids, depth[REFERENCE]);
    for (size_t k = 0; k < N_METHODS; k++) {
        double square = 0;
        for (size_t i = 0; i < n_ids; i++) {
            ratio[i]  = cpu[PLAIN][i] / cpu[k][i];
            change[i] = depth[k][i] / mean - depth[REFERENCE][i] / mean;
            square += change[i] * change[i];
        }
        double error = bench_standard_error(n_ids, change);
        printf("| %g %% | %s | %.3g | %.3g | %.3g | ", 100 * concentration, METHOD[k].name, bench_median(n_ids, cpu[k]),
               bench_median(n_ids, ratio), bench_median(n_ids, per_hit[k]));
        if (k == REFERENCE) printf("reference | |\n");
        else printf("%+.2g +- %.1g %% | %.2g %% |\n", 100 * bench_mean(n_ids, change), 100 * error, 100 * sqrt(square / (double)n_ids));
        bench_expect(k == REFERENCE || !(concentration < 0.5) || k == PLAIN || fabs(bench_mean(n_ids, change)) < 0.1,
                     "%s at %g %%: depth differs by %g", METHOD[k].name, 100 * concentration, bench_mean(n_ids, change));
    }
}

/* CPU s of one window; depth may be NULL. */
static double of_model(fw_model m, double concentration, size_t id, double *hits, double *depth)
{
    fw_scenario s = {.seed = 20260101, .id = id, .concentration = concentration, .speed = SPEED};
    fw_record   r;
    fw_msg      msg = {""};
    bench_expect(fw_realise(&m, &s, NULL, &r, &msg) == FW_OK && r.status == FW_OK, "%s%s", msg.text, r.cause);
    double cpu = r.host_cpu_s;
    *hits = r.hits;
    if (depth) *depth = bench_depth(&r);
    fw_record_free(&r);
    return cpu;
}

/* Cost against the length of the window, per hit, and against the width of the strip: on the same ice, in turn. */
static void growth(size_t n_ids, double unit)
{
    static const double LENGTH[] = {1, 3, 9, 18}, WIDTH[] = {60, 80, 100, 140, 200, 400};
    printf("### How cost grows\n\nAccuracy 1 %%, medians of %zu realisations; widths in turn on the same ice, windows of %g s.\n\n", n_ids,
           3 * unit);
    printf("| ice | window s | CPU s | CPU ms per hour | CPU us per hit |\n|---|---|---|---|---|\n");
    for (size_t c = 0; c < sizeof CONCENTRATION / sizeof *CONCENTRATION; c++)
        for (size_t k = 0; k < sizeof LENGTH / sizeof *LENGTH; k++) {
            double cpu[MAX_IDS], per_hit[MAX_IDS], hits;
            for (size_t i = 0; i < n_ids; i++) {
                fw_model m;
                fw_model_defaults(&m);
                m.window   = LENGTH[k] * unit;
                cpu[i]     = of_model(m, CONCENTRATION[c], i, &hits, NULL);
                per_hit[i] = 1e6 * cpu[i] / fmax(1, hits);
            }
            double one = bench_median(n_ids, cpu);
            printf("| %g %% | %g | %.3g | %.3g | %.3g |\n", 100 * CONCENTRATION[c], LENGTH[k] * unit, one, 3.6e6 * one / (LENGTH[k] * unit),
                   bench_median(n_ids, per_hit));
        }
    printf("\nStrip width: CPU over that at 100 m; in brackets how many windows have the depth of 400 m to the last digit. A floe counts as long as its "
           "pushing on, from rim to rim, reaches the structure in the end: wider than that nothing changes, and costs nothing.\n\n");
    printf("| ice | strip 60 m | 80 m | 100 m | 140 m | 200 m | 400 m |\n|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < sizeof CONCENTRATION / sizeof *CONCENTRATION; c++) {
        double cpu[6][MAX_IDS], depth[6][MAX_IDS], hits;
        for (size_t i = 0; i < n_ids; i++)
            for (size_t k = 0; k < 6; k++) {
                fw_model m;
                fw_model_defaults(&m);
                m.window = 3 * unit, m.strip_width = WIDTH[k];
                cpu[k][i] = of_model(m, CONCENTRATION[c], i, &hits, &depth[k][i]);
            }
        printf("| %g %% |", 100 * CONCENTRATION[c]);
        for (size_t k = 0; k < 6; k++) {
            size_t n_same = 0;
            double ratio[MAX_IDS];
            for (size_t i = 0; i < n_ids; i++) ratio[i] = cpu[k][i] / cpu[2][i], n_same += depth[k][i] == depth[5][i];
            if (k == 2) printf(" %.3g s (%zu of %zu) |", bench_median(n_ids, cpu[k]), n_same, n_ids);
            else printf(" %.2f (%zu) |", bench_median(n_ids, ratio), n_same);
        }
        printf("\n");
    }
    printf("\n");
}

/* Only printed: times are those of a machine that others use too. */
static void targets(void)
{
    static const double ICE[] = {0.1, 0.4, 0.7}, SHARE[] = {0.01, 0.025, NAN};
    static const size_t N[] = {15, 9, 5};
    printf("### Against what was wanted\n\n3 h at %g m/s, accuracy 1 %%, medians of %zu, %zu and %zu; plain method at 1 ms in turn on the same ice (600 s, "
           "scaled by length).\n\n", SPEED, N[0], N[1], N[2]);
    printf("| ice | CPU s | plain CPU s | plain / this | wanted |\n|---|---|---|---|---|\n");
    for (size_t c = 0; c < 3; c++) {
        double ours[MAX_IDS], plain[MAX_IDS], ratio[MAX_IDS], short_window = 600, warm_up = 120 / SPEED;
        for (size_t i = 0; i < N[c]; i++) {
            fw_record r = bench_realise(ICE[c], SPEED, 3 * 3600, 0.01, 0, i), p = bench_realise(ICE[c], SPEED, short_window, 0.01, 1e-3, i);
            ours[i]  = r.host_cpu_s;
            plain[i] = p.host_cpu_s * (3 * 3600 + warm_up) / (short_window + warm_up);
            ratio[i] = plain[i] / ours[i];
            fw_record_free(&r), fw_record_free(&p);
        }
        printf("| %g %% | %.3g | %.3g | %.3g | ", 100 * ICE[c], bench_median(N[c], ours), bench_median(N[c], plain), bench_median(N[c], ratio));
        if (SHARE[c] > 0) printf("%g |\n", 1 / SHARE[c]);
        else printf("a quarter of 15 CPU s |\n");
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    bool is_quick = bench_start(argc, argv);
    printf("### Windows\n\n");
    if (is_quick) {
        long_windows(60, 1);
    } else {
        long_windows(600, 5);
        long_windows(3 * 3600, 3);
    }
    double window = is_quick ? 30 : 600;
    size_t n_ids  = is_quick ? 2 : 12;
    printf("### Against the plain method\n\n");
    printf("Windows of %g s on the same ice, %zu realisations, methods in turn. CPU: median; ratio: median of plain / this, pair by "
           "pair. Depth difference: of the summed depth to accuracy 0.01 %%, with its standard error; last column: r.m.s. of single "
           "windows. Where a jam makes runs decouple (60 %%) differences are scatter of the ice, not errors of the method; the "
           "plain method also wakes all ice at an inlet 60 m upstream.\n\n", window, n_ids);
    printf("| ice | method | CPU s | plain / this | evaluations per hit | depth difference | single windows |\n|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < sizeof CONCENTRATION / sizeof *CONCENTRATION; c++) against_plain(CONCENTRATION[c], window, n_ids);
    printf("\n");
    growth(is_quick ? 1 : 5, is_quick ? 20 : 1200);
    if (!is_quick) targets();
    return bench_end();
}
