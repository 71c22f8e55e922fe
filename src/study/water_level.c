#include "study/water_level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Windows are gathered by thickness, which differs by decimetres: at most this many kinds of equal width, each with its mean. One thickness
 * stays one kind and exact. */
enum { MOST_KINDS = 128 };
/* The law of the level as even quantiles, for the integral of its CDF. */
enum { N_QUANTILES = 4096 };
/* Heights among which the most worn one is looked for. */
enum { N_LOOKS = 4001 };
/* Levels that are left out of the heights' range at either end, where a law has none. */
static const double RARE = 1e-5;
static const double MARGIN = 0.05; /* of the range, beyond either end */

typedef struct kind {
    double weight, draft, freeboard; /* weights sum to 1 */
} kind;

typedef struct wall {
    const fw_distribution *level;
    size_t                 n;
    kind                   kinds[MOST_KINDS];
    double                *quantile, *sum; /* (N_QUANTILES), (N_QUANTILES + 1) sums of those below; owned, one block */
} wall;

static fw_status gather(wall *w, double afloat, size_t n, const double *thickness, const double *weight, double *mean, fw_msg *m)
{
    double low = INFINITY, high = 0, all = 0, sums[MOST_KINDS][2] = {{0}};
    for (size_t i = 0; i < n; i++) {
        FW_CHECK(isfinite(thickness[i]) && thickness[i] >= 0 && isfinite(weight[i]) && weight[i] >= 0, m, FW_E_ARG,
                 "window %zu: ice of %g m wore %g", i, thickness[i], weight[i]);
        if (!(weight[i] > 0 && thickness[i] > 0)) continue;
        low = fmin(low, thickness[i]), high = fmax(high, thickness[i]), all += weight[i];
    }
    *mean = 0;
    if (!(all > 0)) return FW_OK;
    for (size_t i = 0; i < n; i++) {
        if (!(weight[i] > 0 && thickness[i] > 0)) continue;
        size_t k = high > low ? (size_t)((thickness[i] - low) / (high - low) * MOST_KINDS) : 0;
        if (k >= MOST_KINDS) k = MOST_KINDS - 1;
        sums[k][0] += weight[i], sums[k][1] += weight[i] * (thickness[i] - low);
    }
    for (size_t k = 0; k < MOST_KINDS; k++) {
        if (!(sums[k][0] > 0)) continue;
        double h = low + sums[k][1] / sums[k][0]; /* from the least, so that one thickness keeps its bits */
        w->kinds[w->n++] = (kind){sums[k][0] / all, afloat * h, (1 - afloat) * h};
        *mean += sums[k][0] / all * h;
    }
    return FW_OK;
}

static double share_at(const wall *w, double z)
{
    double share = 0;
    for (size_t k = 0; k < w->n; k++) {
        const kind *q = &w->kinds[k];
        share += q->weight * fmax(0, fw_distribution_cdf(w->level, z + q->draft) - fw_distribution_cdf_left(w->level, z - q->freeboard));
    }
    return share;
}

/* E max(0, x - level), the integral of the level's CDF up to x. */
static double mean_above(const wall *w, double x)
{
    size_t low = 0, high = N_QUANTILES;
    while (low < high) {
        size_t mid = (low + high) / 2;
        if (w->quantile[mid] < x)
            low = mid + 1;
        else
            high = mid;
    }
    return ((double)low * x - w->sum[low]) / N_QUANTILES;
}

/* Share of all wear below z. */
static double below(const wall *w, double z)
{
    double part = 0, all = 0;
    for (size_t k = 0; k < w->n; k++) {
        const kind *q = &w->kinds[k];
        part += q->weight * (mean_above(w, z + q->draft) - mean_above(w, z - q->freeboard));
        all += q->weight * (q->draft + q->freeboard);
    }
    return part / all;
}

static double height_below_which(const wall *w, double share, double low, double high)
{
    for (int i = 0; i < 60; i++) {
        double mid = 0.5 * (low + high);
        if (below(w, mid) < share)
            low = mid;
        else
            high = mid;
    }
    return 0.5 * (low + high);
}

/* The largest share; where it is a range of heights, as under a constant level, the middle of the first one. */
static void find_most(const wall *w, double low, double high, fw_water_level *out)
{
    double step = (high - low) / (N_LOOKS - 1), share = -1;
    size_t first = 0, last = 0;
    for (size_t i = 0; i < N_LOOKS; i++) {
        double s = share_at(w, low + step * (double)i);
        if (s > share * (1 + 1e-12))
            share = s, first = last = i;
        else if (s >= share * (1 - 1e-12) && last == i - 1)
            last = i;
    }
    double a = low + step * ((double)first - 1), b = low + step * ((double)last + 1);
    if (last > first) {
        out->most_height = 0.5 * (a + b), out->most_share = share;
        return;
    }
    const double golden = 0.61803398874989485;
    double       x = b - golden * (b - a), y = a + golden * (b - a), at_x = share_at(w, x), at_y = share_at(w, y);
    for (int i = 0; i < 40; i++) {
        if (at_x > at_y)
            b = y, y = x, at_y = at_x, x = b - golden * (b - a), at_x = share_at(w, x);
        else
            a = x, x = y, at_x = at_y, y = a + golden * (b - a), at_y = share_at(w, y);
    }
    out->most_height = 0.5 * (a + b), out->most_share = fmax(share, share_at(w, 0.5 * (a + b)));
}

static void fill(wall *w, fw_water_level *out)
{
    double draft = 0, freeboard = 0, low = fw_distribution_min(w->level), high = fw_distribution_max(w->level);
    if (!isfinite(low)) low = fw_distribution_quantile(w->level, RARE);
    if (!isfinite(high)) high = fw_distribution_quantile(w->level, 1 - RARE);
    for (size_t k = 0; k < w->n; k++) draft = fmax(draft, w->kinds[k].draft), freeboard = fmax(freeboard, w->kinds[k].freeboard);
    low -= draft, high += freeboard;
    double margin = MARGIN * (high - low);
    low -= margin, high += margin;
    for (size_t j = 0; j < N_QUANTILES; j++) {
        w->quantile[j] = fw_distribution_quantile(w->level, ((double)j + 0.5) / N_QUANTILES);
        w->sum[j + 1] = w->sum[j] + w->quantile[j];
    }
    out->n = FW_WATER_LEVEL_HEIGHTS;
    for (size_t i = 0; i < out->n; i++) {
        out->height[i] = low + (high - low) * (double)i / (double)(out->n - 1);
        out->share[i] = share_at(w, out->height[i]);
    }
    find_most(w, low, high, out);
    out->band_low = height_below_which(w, 0.05, low, high);
    out->band_high = height_below_which(w, 0.95, low, high);
}

fw_status fw_water_level_make(fw_water_level *out, const fw_distribution *level, double afloat, size_t n, const double *thickness,
                              const double *weight, fw_msg *m)
{
    wall w = {.level = level};
    memset(out, 0, sizeof *out);
    FW_CHECK(afloat > 0 && afloat < 1, m, FW_E_ARG, "ice of %g times the water's density does not float", afloat);
    FW_TRY(gather(&w, afloat, n, thickness, weight, &out->thickness, m));
    if (w.n == 0) return FW_OK;
    FW_TRY(fw_alloc(&w.quantile, 2 * N_QUANTILES + 1, sizeof *w.quantile, "quantiles of the water level", m));
    w.sum = w.quantile + N_QUANTILES;
    fill(&w, out);
    free(w.quantile);
    return FW_OK;
}

fw_status fw_water_level_shares(const fw_distribution *level, double afloat, size_t n, const double *thickness, const double *weight,
                                size_t n_heights, const double *heights, double *shares, fw_msg *m)
{
    wall   w = {.level = level};
    double mean;
    FW_TRY(gather(&w, afloat, n, thickness, weight, &mean, m));
    for (size_t i = 0; i < n_heights; i++) shares[i] = share_at(&w, heights[i]);
    return FW_OK;
}
