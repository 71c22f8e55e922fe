/* Estimates of the made-up site over many repeats: how far off, how wide, how often covered. */
#ifndef FW_TESTS_STUDY_REPEATS_H
#define FW_TESTS_STUDY_REPEATS_H

#include "study/made_up_site.h"

static const double SIGMA = 0.15; /* of ln ice, as on the default campaign */

enum { N_LEVELS = 2, MEAN = N_LEVELS, N_ESTIMATES };
static const double LEVEL[N_LEVELS] = {0.5, 0.9};

typedef struct repeats {
    double sum[N_ESTIMATES], squares[N_ESTIMATES]; /* of F at the true percentile less its level, of the mean over its truth less 1 */
    size_t n, covered[N_ESTIMATES], n_controlled;
} repeats;

static inline void take(repeats *to, int k, double error, double truth, fw_interval v)
{
    to->sum[k] += error, to->squares[k] += error * error;
    to->covered[k] += v.low <= truth && truth <= v.high;
}

/* E D: the product of means, that of |T|^-m by closed form. */
static inline double mean_depth(const fw_campaign *c)
{
    const double m = 1.121;
    double       load = 0, factor = 0.116 * (pow(12, 1 - m) - pow(2, 1 - m)) / (1 - m) / 10;
    fw_scenario  s;
    for (uint64_t i = 0; i < SITE_LAW; i++) {
        site_law_point(c, i, &s);
        load += s.weight * site_load(&s);
    }
    return factor * load * site_shape(0, c->model.n_arcs);
}

static double truth[N_ESTIMATES]; /* by quadrature */

static inline int find_truth(void **state)
{
    double      bearings[24];
    fw_campaign c = site_campaign(bearings);
    (void)state;
    for (int k = 0; k < N_LEVELS; k++) truth[k] = site_percentile(&c, SIGMA, LEVEL[k]);
    truth[MEAN] = mean_depth(&c);
    fw_site_free(&c.site);
    return 0;
}

static inline repeats repeat(const fw_campaign *c, site_way way, size_t n, const fw_scenario_law *law, size_t n_repeats)
{
    repeats out = {.n = n_repeats};
    for (size_t i = 0; i < n_repeats; i++) {
        site_records s = {.campaign = c, .way = way, .seed = 1000 + i, .sigma = SIGMA};
        fw_depth     d;
        fw_window    w;
        site_depth(&d, &s, n, law, 0);
        assert_int_equal(fw_window_make(&w, &d, 0, NULL), FW_OK);
        out.n_controlled += d.control.is_on;
        for (int k = 0; k < N_LEVELS; k++) take(&out, k, fw_mixture_cdf(&w.mixture, truth[k]) - LEVEL[k], truth[k], fw_window_interval(&w, LEVEL[k], 0.95));
        take(&out, MEAN, w.moment[1] / truth[MEAN] - 1, truth[MEAN], fw_window_mean_interval(&w, 0.95));
        fw_window_free(&w);
        fw_depth_free(&d);
    }
    return out;
}

static inline double spread_over(const repeats *r, int k) { return sqrt(r->squares[k] / (double)r->n - pow(r->sum[k] / (double)r->n, 2)); }

static const char *const NAME[N_ESTIMATES] = {"P50", "P90", "mean"};

/* Within four standard errors over the repeats. The mean is off by more, to one side: without the load among the functions it goes with what was drawn, and
 * samples without fast windows are those that have no room for it. That is less than a tenth of what plain sampling scatters by. */
static inline void is_unbiased(const repeats *r, const char *what, double plain_scatter)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double mean = r->sum[k] / (double)r->n, error = spread_over(r, k) / sqrt((double)r->n);
        if (!(fabs(mean) < 4 * error + (k == MEAN ? 0.1 * plain_scatter : 0))) fail_msg("%s, %s: off by %g +- %g", what, NAME[k], mean, error);
    }
}

/* 95 % to within three standard errors of 500 repeats. */
static inline void is_covered(const repeats *r, const char *what)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double covered = (double)r->covered[k] / (double)r->n;
        if (!(covered >= (k == MEAN ? 0.91 : 0.92) && covered <= 0.98)) fail_msg("%s, %s: covered %.3f", what, NAME[k], covered);
    }
}

/* Percentiles scatter by less than this part of what they do without control. */
static inline void is_narrower(const repeats *with, const repeats *without, const char *what, double part)
{
    for (int k = 0; k < N_ESTIMATES; k++) {
        double ratio = spread_over(with, k) / spread_over(without, k);
        if (!(ratio < part)) fail_msg("%s, %s: %.3f of the scatter without control", what, NAME[k], ratio);
    }
}

#endif
