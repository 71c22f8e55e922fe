/* What a half-width costs: the default campaign by plain sampling with sampled temperature and direction, and by what floewear does instead, at the same
 * number of force evaluations, replicated. Half an hour. Label long. Prints Markdown; the committed precision.md is its output.
 *
 *   validate_precision CAMPAIGN.yaml [FILE [REPLICATES]]    to FILE as well; exit code 1 when the whole gains less than 4
 *
 * Pieces, on the same windows and seeds: (a) one temperature and one direction drawn for each window, interval by order statistics; (b) both integrated;
 * (c) control variates on top; (d) windows drawn by the design that the pilot of `floewear plan` chooses, as many as cost what (a) did.
 * The scatter of the 20 values about the best estimate from all windows of (c) and (d) is beside each half-width: it has to be what the half-width promises. */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "cli/config.h"
#include "cli/plan_design.h"
#include "statistics/order.h"

enum { N = 225, REPLICATES = 20, PIECES = 4, MOST = 4000 };
static const char *const WORDS[PIECES] = {"plain windows, temperature and direction sampled", "temperature and direction integrated", "control variates",
                                          "the pilot's design, same cost"};

static FILE *copy;
#define SAY(...) (printf(__VA_ARGS__), fflush(stdout), copy ? fprintf(copy, __VA_ARGS__) : 0)
#define TRY(call)                                     \
    do {                                              \
        if ((call) != FW_OK) {                        \
            fprintf(stderr, "%s\n", message.text);    \
            exit(1);                                  \
        }                                             \
    } while (0)
static fw_msg message;

typedef struct windows {
    size_t     n;
    fw_record *record; /* (n) */
    double     evaluations, cpu_s;
} windows;

/* Realisations of a campaign until n of them are there, or a cost is reached (n = 0). */
static windows run(const fw_campaign *c, size_t n, double cost)
{
    windows w = {.record = calloc(MOST, sizeof *w.record)};
    while (w.n < MOST && (n ? w.n < n : w.evaluations < cost)) {
        fw_scenario s;
        fw_campaign_scenario(c, w.n, &s);
        TRY(fw_realise(&c->model, &s, NULL, &w.record[w.n], &message));
        w.evaluations += w.record[w.n].force_evaluations, w.cpu_s += w.record[w.n].host_cpu_s;
        w.n++;
    }
    return w;
}

static void free_windows(windows *w)
{
    for (size_t i = 0; i < w->n; i++) fw_record_free(&w->record[i]);
    free(w->record);
}

static fw_status read_window(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    const fw_record *from = &((windows *)self)->record[id];
    double          *rings = r->rings;
    (void)m;
    memcpy(rings, from->rings, fw_record_n_rings(from->n_arcs, from->n_laws) * sizeof *rings);
    *r = *from;
    r->rings = rings;
    return FW_OK;
}

typedef struct estimate {
    double value, half; /* [mm] */
} estimate;

static estimate of(double value, double low, double high) { return (estimate){value, 0.5 * (high - low)}; }

/* One temperature and one direction for each window. */
static estimate sampled(const fw_campaign *c, size_t point, const windows *w)
{
    double    depth[MOST], p = c->precision.percentile / 100;
    fw_random g;
    fw_random_stream(&g, c->seed, FW_STREAM_TEST, 1, 0);
    for (size_t i = 0; i < w->n; i++) {
        double temperature = fw_distribution_quantile(&c->site.temperature, fw_random_uniform(&g));
        double direction = fw_distribution_quantile(&c->site.direction, fw_random_uniform(&g));
        size_t arc = fw_directions_arc(c->model.n_arcs, c->points.bearing[point - 1], direction);
        depth[i] = fw_abrasion_rate(&c->model.laws[0], temperature) * fw_record_load(&w->record[i], 0, FW_RING_LOAD)[arc];
    }
    for (size_t i = 1; i < w->n; i++)
        for (size_t k = i; k > 0 && depth[k] < depth[k - 1]; k--) {
            double x = depth[k];
            depth[k] = depth[k - 1], depth[k - 1] = x;
        }
    fw_interval v = fw_order_interval(w->n, depth, 0, p, 0.95);
    return of(fw_order_percentile(w->n, depth, p), v.low, v.high);
}

static estimate answered(const fw_campaign *c, size_t point, windows *w, bool is_controlled)
{
    fw_answer         a;
    double            p = c->precision.percentile;
    fw_answer_options o = {.n_percentiles = 1, .percentiles = &p, .n_points = 1, .points = &point, .confidence = 0.95};
    fw_answer_source  source = {.records = {.n = w->n, .read = read_window, .self = w}};
    if (is_controlled) source.law = fw_campaign_law(c);
    TRY(fw_answer_make(&a, c, &source, &o, &message));
    estimate e = of(a.percentiles[0].depth_mm, a.percentiles[0].low_mm, a.percentiles[0].high_mm);
    fw_answer_free(&a);
    return e;
}

/* The design that a pilot chooses, kept for all replicates. */
static size_t choose_design(fw_campaign *c, fw_outlook *x, fw_sampling *design)
{
    fw_record *pilot;
    size_t     n, point = 0;
    double     most = 0;
    TRY(fw_plan_pilot(c, -1, true, &pilot, &n, &message));
    TRY(fw_plan_outlook(x, c, n, pilot, true, &message));
    *design = x->design[x->chosen].sampling;
    windows w = {.n = n, .record = pilot};
    for (size_t i = 0; i < c->points.n; i++) {
        estimate e = answered(c, i + 1, &w, false);
        if (e.value > most) most = e.value, point = i + 1;
    }
    SAY("Pilot of %zu windows: %s. Governing point %zu (%g degrees).\n\n", n, x->reason, point, c->points.bearing[point - 1]);
    for (size_t i = 0; i < n; i++) fw_record_free(&pilot[i]);
    free(pilot);
    return point;
}

static int report(int n, estimate found[][PIECES], const double *cost, double n_design)
{
    double half[PIECES] = {0}, mean[PIECES] = {0}, scatter[PIECES] = {0}, best = 0;
    for (int i = 0; i < n; i++) best += 0.5 * (found[i][2].value + found[i][3].value) / n;
    for (int k = 0; k < PIECES; k++)
        for (int i = 0; i < n; i++) {
            half[k] += found[i][k].half / found[i][k].value / n, mean[k] += found[i][k].value / n;
            scatter[k] += (found[i][k].value / best - 1) * (found[i][k].value / best - 1) / n;
        }
    SAY("| %d replicates | force evaluations | P90 [mm] | half-width | 1.96 x scatter of the values | narrower than plain |\n|---|---|---|---|---|---|\n", n);
    for (int k = 0; k < PIECES; k++)
        SAY("| %s | %.3g | %.3g | %.2f %% | %.2f %% | x%.1f |\n", WORDS[k], cost[k == 3], mean[k], 100 * half[k], 196 * sqrt(scatter[k]), half[0] / half[k]);
    SAY("\n%d windows each by plain sampling, %.0f by the design. The same half-width by plain sampling alone would take %.0f times the windows.\n", (int)N, n_design,
        pow(half[0] / half[3], 2));
    return half[0] / half[3] >= 4 ? 0 : 1;
}

int main(int argc, char **argv)
{
    fw_campaign c;
    fw_outlook  x;
    fw_sampling design;
    int         n = argc > 3 ? atoi(argv[3]) : REPLICATES;
    estimate    found[REPLICATES][PIECES];
    double      cost[2] = {0}, n_design = 0;
    if (argc < 2 || n < 1 || n > REPLICATES) return 2;
    gsl_set_error_handler_off();
    copy = argc > 2 ? fopen(argv[2], "w") : NULL;
    TRY(fw_config_campaign(&c, argv[1], 0, NULL, -1, &message));
    SAY("# What a half-width costs\n\n`validate_precision %s`: %d windows of %g h by plain sampling, against the same cost by the pilot's design.\n\n", c.name, (int)N,
        c.model.window / 3600);
    size_t      point = choose_design(&c, &x, &design);
    uint64_t    seed = c.seed;
    fw_sampling plain = c.sampling;
    for (int i = 0; i < n; i++) {
        c.seed = seed + 1000 + (uint64_t)i, c.sampling = plain;
        windows w = run(&c, N, 0);
        found[i][0] = sampled(&c, point, &w), found[i][1] = answered(&c, point, &w, false), found[i][2] = answered(&c, point, &w, true);
        double spent = w.evaluations;
        free_windows(&w);
        c.sampling = design;
        w = run(&c, 0, spent);
        found[i][3] = answered(&c, point, &w, true);
        cost[0] += spent / n, cost[1] += w.evaluations / n, n_design += (double)w.n / n;
        fprintf(stderr, "replicate %d: half-widths %.3g %.3g %.3g %.3g %%, %zu windows by the design\n", i, 100 * found[i][0].half / found[i][0].value,
                100 * found[i][1].half / found[i][1].value, 100 * found[i][2].half / found[i][2].value, 100 * found[i][3].half / found[i][3].value, w.n);
        free_windows(&w);
    }
    int wrong = report(n, found, cost, n_design);
    c.sampling = plain;
    fw_outlook_free(&x);
    fw_campaign_free(&c);
    return wrong;
}
