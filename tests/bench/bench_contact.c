/* What a contact costs: time per force evaluation, and force evaluations per contact against the error of depth. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "bench/reference.h"

static fw_scene_result run(double accuracy, double duration, size_t n_floes, fw_floe *floes)
{
    fw_scene s = {.speed = 2, .temperature = -10, .duration = duration, .n_floes = n_floes, .floes = floes};
    fw_model_defaults(&s.model);
    s.model.accuracy = accuracy;
    fw_scene_result r;
    fw_msg          m = {""};
    if (fw_scene_run(&s, NULL, NULL, &r, &m) != FW_OK) {
        fprintf(stderr, "%s\n", m.text);
        exit(1);
    }
    return r;
}

/* --- time per evaluation ------------------------------------------------------------------------------------------ */

enum { N_BATCHES = 9 };

static void time_scene(const char *name, double accuracy, double duration, size_t n_floes, fw_floe *floes, double batch_s)
{
    double ns[N_BATCHES], evaluations = 0, steps = 0, depth = 0;
    for (size_t b = 0; b < N_BATCHES; b++) {
        double start = bench_cpu_now(), done = 0;
        do {
            fw_scene_result r = run(accuracy, duration, n_floes, floes);
            done += evaluations = r.record.force_evaluations;
            steps = r.record.steps, depth = r.depth_along_contact;
            fw_scene_result_free(&r);
        } while (bench_cpu_now() - start < batch_s);
        ns[b] = 1e9 * (bench_cpu_now() - start) / done;
    }
    printf("| %s | %g %% | %.0f | %.0f | %.1f | %.0f |\n", name, 100 * accuracy, evaluations, steps, evaluations / steps,
           bench_median(N_BATCHES, ns));
    bench_expect(evaluations > 0 && depth > 0, "%s: no contact", name);
}

/* Hexagonal raft, a millimetre apart, that drifts on the structure off centre. */
static size_t raft(int rings, fw_floe *floes, size_t room)
{
    double D = 2.5, gap = 1e-3, a = D + gap, first = -(3.7 + D / 2 + 0.2) - rings * a;
    size_t n = 0;
    for (int q = -rings; q <= rings; q++)
        for (int r = -rings; r <= rings; r++) {
            if (abs(q + r) > rings || n >= room) continue;
            floes[n++] = (fw_floe){.x = first + a * (q + 0.5 * r), .y = 0.7 + a * 0.8660254037844386 * r, .diameter = D, .thickness = 0.5, .vx = 2};
        }
    return n;
}

static void times(double batch_s)
{
    printf("### Time per force evaluation\n\n");
    printf("Whole scenes through the kernel, everything included; an evaluation is one contact at one stage. Median of %d batches of "
           "%g s.\n\n", (int)N_BATCHES, batch_s);
    printf("| scene | accuracy | evaluations | sub-steps | per sub-step | ns per evaluation |\n|---|---|---|---|---|---|\n");
    fw_floe one = {.x = -6, .y = 0.5, .diameter = 2.5, .thickness = 0.5, .vx = 2}, floes[64];
    size_t  n19 = raft(2, floes, 64);
    for (int a = 0; a < 2; a++) time_scene("one floe slides round", a ? 0.001 : 0.01, 10, 1, &one, batch_s);
    for (int a = 0; a < 2; a++) time_scene("raft of 19 floes", a ? 0.001 : 0.01, 10, n19, floes, batch_s);
    size_t n61 = raft(4, floes, 64);
    for (int a = 0; a < 2; a++) time_scene("raft of 61 floes", a ? 0.001 : 0.01, 10, n61, floes, batch_s);
    printf("\n");
}

/* --- work against precision ---------------------------------------------------------------------------------------- */

static void work_precision(void)
{
    static const double ACCURACY[] = {0.1, 0.01, 0.001, 0.0001};
    reference_scene    *scenes     = calloc(REFERENCE_SCENES, sizeof *scenes);
    if (!scenes) exit(1);
    size_t n = reference_read(scenes);
    bench_expect(n >= 9, "only %zu reference scenes", n);
    printf("### Work against precision\n\n");
    printf("The %zu scenes of tests/reference in which floes meet and part. Depth error against the independent solutions.\n\n", n);
    printf("| accuracy | evaluations, all scenes | per scene: least, median, most | depth error: median | worst | worst scene | position error mm "
           "| worst energy balance |\n|---|---|---|---|---|---|---|---|\n");
    for (size_t a = 0; a < sizeof ACCURACY / sizeof *ACCURACY; a++) {
        double evaluations[REFERENCE_SCENES], error[REFERENCE_SCENES], sum = 0, least = INFINITY, most = 0, worst = 0, way = 0, balance = 0;
        size_t n_errors = 0, worst_scene = 0;
        for (size_t i = 0; i < n; i++) {
            reference_scene *s = &scenes[i];
            fw_scene_result  r = run(ACCURACY[a], s->duration, s->n_floes, s->start);
            evaluations[i] = r.record.force_evaluations;
            sum += evaluations[i], least = fmin(least, evaluations[i]), most = fmax(most, evaluations[i]);
            balance = fmax(balance, r.record.energy_truncation);
            if (s->depth > 0) {
                double e = fabs(r.depth_along_contact / s->depth - 1);
                if (e > worst) worst = e, worst_scene = i;
                error[n_errors++] = e;
            }
            if (s->has_end)
                for (size_t k = 0; k < s->n_floes; k++) way = fmax(way, hypot(r.floes[k].x - s->end[k].x, r.floes[k].y - s->end[k].y));
            fw_scene_result_free(&r);
        }
        printf("| %g %% | %.0f | %.0f, %.0f, %.0f | %.1e | %.1e | %s | %.2g | %.1e |\n", 100 * ACCURACY[a], sum, least, bench_median(n, evaluations),
               most, bench_median(n_errors, error), worst, scenes[worst_scene].name, 1e3 * way, balance);
        bench_expect(worst <= ACCURACY[a], "depth error %g at accuracy %g", worst, ACCURACY[a]);
    }
    printf("\n");
    free(scenes);
}

int main(int argc, char **argv)
{
    bool is_quick = bench_start(argc, argv);
    times(is_quick ? 0.01 : 0.3);
    work_precision();
    return bench_end();
}
