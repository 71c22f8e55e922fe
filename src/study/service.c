#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/random.h"
#include "statistics/life.h"
#include "study/rows.h"

/* Resampling is for short lives: at most this many windows, and about this many draws per point. */
enum { MOST_RESAMPLED_WINDOWS = 500, FEWEST_LIVES = 4000, MOST_LIVES = 100000, DRAWS = 2000000 };

double fw_service_windows(const fw_campaign *c)
{
    double windows = c->service.life_years * c->service.ice_hours_per_year * 3600 / c->model.window;
    return fmax(1, round(windows));
}

/* Whole year, counted from 1, in which this many windows are used up. */
static double year_of(const fw_campaign *c, double windows)
{
    return fmax(1, ceil(windows / fw_service_windows(c) * c->service.life_years * (1 - 1e-12)));
}

static void smooth_rows(const fw_campaign *c, const fw_life *life, size_t n, const double *percentiles,
                        fw_life_row *rows)
{
    double windows = fw_service_windows(c);
    for (size_t k = 0; k < n; k++) {
        double p = percentiles[k] / 100;
        rows[k].depth_mm = fmax(0, fw_life_percentile(life, windows, p));
        if (!(c->service.allowance > 0)) continue;
        double used = fw_life_windows_to(life, c->service.allowance, windows, p);
        if (isfinite(used)) rows[k].allowance_year = year_of(c, used);
    }
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Lives drawn window by window, all of them one year further at a time, so that the year in which a percentile passes
 * the allowance is read off on the way. The same random numbers serve every point. */
static void resample(const fw_campaign *c, const fw_window *w, size_t n, const double *percentiles, fw_life_row *rows,
                     size_t n_lives, fw_random *streams, double *sums, double *sorted)
{
    double windows = fw_service_windows(c), n_years = fmax(1, ceil(c->service.life_years));
    double made = 0;
    for (double year = 1; year <= n_years; year++) {
        double until = year == n_years ? windows : fmin(windows, round(windows * year / c->service.life_years));
        for (size_t i = 0; i < n_lives; i++)
            for (double k = made; k < until; k++) sums[i] += fw_window_draw(w, fw_random_uniform(&streams[i]));
        made = until;
        if (!(c->service.allowance > 0) && year < n_years) continue;
        for (size_t i = 0; i < n_lives; i++) sorted[i] = sums[i];
        qsort(sorted, n_lives, sizeof *sorted, compare_doubles);
        for (size_t k = 0; k < n; k++) {
            rows[k].depth_mm = fw_order_percentile(n_lives, sorted, percentiles[k] / 100);
            if (c->service.allowance > 0 && isnan(rows[k].allowance_year) && rows[k].depth_mm >= c->service.allowance)
                rows[k].allowance_year = year;
        }
    }
}

static fw_status resampled_rows(const fw_campaign *c, const fw_window *w, size_t n, const double *percentiles,
                                fw_life_row *rows, fw_msg *m)
{
    double     wanted = DRAWS / fw_service_windows(c);
    size_t     n_lives = (size_t)fmin(fmax(wanted, FEWEST_LIVES), MOST_LIVES);
    fw_random *streams = NULL;
    double    *sums = NULL, *sorted = NULL;
    fw_status  s = fw_alloc(&streams, n_lives, sizeof *streams, "random streams of lives", m);
    if (s == FW_OK) s = fw_alloc(&sums, n_lives, sizeof *sums, "depths of lives", m);
    if (s == FW_OK) s = fw_alloc(&sorted, n_lives, sizeof *sorted, "depths of lives", m);
    if (s == FW_OK) {
        for (size_t i = 0; i < n_lives; i++) fw_random_stream(&streams[i], c->seed, FW_STREAM_SERVICE, i, 0);
        resample(c, w, n, percentiles, rows, n_lives, streams, sums, sorted);
    }
    free(streams);
    free(sums);
    free(sorted);
    return s;
}

fw_status fw_service_rows(const fw_campaign *c, const fw_window *w, size_t n_percentiles, const double *percentiles,
                          double confidence, fw_life_row *rows, fw_msg *m)
{
    double      windows = fw_service_windows(c);
    fw_life     life = fw_life_of_moments(w->moment[1], w->moment[2], w->moment[3]);
    fw_interval mean = fw_window_mean_interval(w, confidence);
    for (size_t k = 0; k < n_percentiles; k++) {
        rows[k].percentile = percentiles[k];
        rows[k].windows = windows;
        rows[k].allowance_year = NAN;
    }
    if (fw_life_is_smooth(&life, windows) || windows > MOST_RESAMPLED_WINDOWS) {
        smooth_rows(c, &life, n_percentiles, percentiles, rows);
    } else {
        FW_TRY(resampled_rows(c, w, n_percentiles, percentiles, rows, m));
    }
    for (size_t k = 0; k < n_percentiles; k++) {
        bool has_wear = life.mean > 0;
        rows[k].low_mm = has_wear ? rows[k].depth_mm * (mean.low / life.mean) : NAN;
        rows[k].high_mm = has_wear ? rows[k].depth_mm * (mean.high / life.mean) : NAN;
    }
    return FW_OK;
}
