#include "statistics/lives.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/random.h"

/* Lives: 16384 leave 0.03 of a life's standard deviation open in P99; fewer of very long ones, more of very short ones, which are cheap. */
enum { DRAWS = 1000000, FEWEST = 2048, MOST = 65536, PART = 2 /* of the service streams */ };

/* ---- moments ---------------------------------------------------------------------------------------------------- */

fw_life_spread fw_life_spread_make(const fw_years *y, const fw_scores *s, double phi)
{
    double windows = 0, scatter = 0, squares = 0, of_means = 0, each = y->is_table ? (double)y->n_years / (double)y->n : 1;
    for (size_t k = 0; k < y->n; k++) {
        double n = (double)y->kinds[k].windows, f = y->kinds[k].factor, again = 1 + y->cv * y->cv;
        windows += f * n;
        scatter += n > 0 ? again * f * f * fw_scores_sum(s, phi, n) : 0;
        squares += again * f * f * n * n;
        of_means += f * f * n * n;
    }
    if (y->is_table) of_means = windows * windows / (double)y->n;
    return (fw_life_spread){each * windows, each * scatter, fmax(0, each * (squares - of_means))};
}

double fw_life_spread_sd(const fw_life_spread *l, double mean, double variance)
{
    return sqrt(l->scatter * variance + l->years * mean * mean);
}

/* ---- draws ------------------------------------------------------------------------------------------------------ */

static int compare_sizes(const void *a, const void *b)
{
    size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

static fw_status find_lengths(fw_lives *l, fw_msg *m)
{
    const fw_years *y = l->years;
    FW_TRY(fw_alloc(&l->lengths, y->n, sizeof *l->lengths, "lengths of winters", m));
    FW_TRY(fw_alloc(&l->length, y->n, sizeof *l->length, "lengths of winters", m));
    for (size_t k = 0; k < y->n; k++) l->lengths[k] = y->kinds[k].windows;
    qsort(l->lengths, y->n, sizeof *l->lengths, compare_sizes);
    for (size_t k = 0; k < y->n; k++)
        if (k == 0 || l->lengths[k] != l->lengths[l->n_lengths - 1]) l->lengths[l->n_lengths++] = l->lengths[k];
    for (size_t k = 0; k < y->n; k++)
        while (l->lengths[l->length[k]] != y->kinds[k].windows) l->length[k]++;
    return FW_OK;
}

size_t fw_lives_count(const fw_years *years)
{
    size_t n = DRAWS / years->n_years;
    return n < FEWEST ? FEWEST : n > MOST ? MOST : n;
}

fw_status fw_lives_make(fw_lives *out, const fw_years *years, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    FW_CHECK(years->n_years > 0 && years->n > 0 && (years->is_table || years->n == years->n_years), m, FW_E_ARG, "a life of no years");
    FW_CHECK(!years->is_table || years->n <= FW_LIVES_KINDS, m, FW_E_ARG, "a table of %zu years, wanted at most %d", years->n, FW_LIVES_KINDS);
    out->years = years;
    fw_status s = find_lengths(out, m);
    if (s != FW_OK) fw_lives_free(out);
    return s;
}

/* Even quantiles, brought to mean 1. */
static fw_status make_factors(fw_lives *l, fw_msg *m)
{
    double sigma = sqrt(log1p(l->years->cv * l->years->cv)), sum = 0;
    FW_TRY(fw_alloc(&l->factors, FW_LIVES_FACTORS, sizeof *l->factors, "factors of years", m));
    for (size_t k = 0; k < FW_LIVES_FACTORS; k++)
        sum += l->factors[k] = exp(sigma * gsl_cdf_ugaussian_Pinv(((double)k + 0.5) / FW_LIVES_FACTORS));
    for (size_t k = 0; k < FW_LIVES_FACTORS; k++) l->factors[k] *= FW_LIVES_FACTORS / sum;
    return FW_OK;
}

fw_status fw_lives_draw(fw_lives *l, uint64_t seed, size_t n_winters, fw_msg *m)
{
    const fw_years *y = l->years;
    FW_CHECK(n_winters > 0 && n_winters <= 65536, m, FW_E_ARG, "a pool of %zu winters, wanted 1 to 65536", n_winters);
    l->n_lives = fw_lives_count(y);
    l->n_winters = n_winters;
    size_t all = y->n_years * l->n_lives;
    FW_TRY(fw_alloc(&l->winter, all, sizeof *l->winter, "winters of lives", m));
    if (y->is_table) FW_TRY(fw_alloc(&l->kind, all, sizeof *l->kind, "years of lives", m));
    if (y->cv > 0) {
        FW_TRY(fw_alloc(&l->luck, all, sizeof *l->luck, "factors of lives", m));
        FW_TRY(make_factors(l, m));
    }
    for (size_t i = 0; i < l->n_lives; i++) {
        fw_uniforms u;
        fw_uniforms_stream(&u, seed, FW_STREAM_SERVICE, i, PART);
        for (size_t k = 0; k < y->n_years; k++) {
            double x = fw_uniforms_next(&u);
            if (k == 0) x = ((double)i + x) / (double)l->n_lives; /* first years are stratified */
            l->winter[k * l->n_lives + i] = (uint16_t)(x * (double)n_winters);
            if (l->kind) l->kind[k * l->n_lives + i] = (uint16_t)(fw_uniforms_next(&u) * (double)y->n);
            if (l->luck) l->luck[k * l->n_lives + i] = (uint16_t)(fw_uniforms_next(&u) * FW_LIVES_FACTORS);
        }
    }
    return FW_OK;
}

void fw_lives_free(fw_lives *l)
{
    if (!l) return;
    free(l->lengths);
    free(l->length);
    free(l->winter);
    free(l->kind);
    free(l->luck);
    free(l->factors);
    memset(l, 0, sizeof *l);
}

/* ---- the run ---------------------------------------------------------------------------------------------------- */

static void add_year(const fw_lives *l, size_t year, const double *sums, double *depth)
{
    const fw_years *y = l->years;
    size_t          n = l->n_lives;
    const uint16_t *winter = l->winter + year * n, *kind = l->kind ? l->kind + year * n : NULL, *luck = l->luck ? l->luck + year * n : NULL;
    for (size_t i = 0; i < n; i++) {
        size_t k = kind ? kind[i] : year;
        depth[i] += y->kinds[k].factor * (luck ? l->factors[luck[i]] : 1) * sums[l->length[k] * l->n_winters + winter[i]];
    }
}

static void select_percentiles(size_t n, double *x, const fw_lives_ask *ask, double *out)
{
    for (size_t k = 0; k < ask->n_percentiles; k++) {
        double rank = ceil(ask->percentiles[k] * (double)n) - 1;
        out[k] = gsl_stats_select(x, 1, n, (size_t)fmax(0, rank));
    }
}

/* Share of lives that pass the limit in a year; those of earlier years had passed it before. */
static double newly_past(size_t n, const double *depth, const double *scale, double limit, double *before)
{
    size_t past = 0;
    for (size_t i = 0; i < n; i++) past += depth[i] * (scale ? scale[i] : 1) >= limit;
    double share = (double)past / (double)n, fresh = share - *before;
    *before = share;
    return fresh;
}

void fw_lives_run(const fw_lives *l, const fw_lives_ask *ask, const double *sums, double *work, double *depths, double *scaled, double *used,
                  double *used_scaled)
{
    size_t n = l->n_lives, at = 0;
    double *depth = work, *copy = work + n, *times = work + 2 * n, before = 0, before_scaled = 0;
    memset(depth, 0, n * sizeof *depth);
    for (size_t year = 0; year < l->years->n_years; year++) {
        add_year(l, year, sums, depth);
        used[year] = ask->limit > 0 ? newly_past(n, depth, NULL, ask->limit, &before) : 0;
        if (used_scaled) used_scaled[year] = ask->limit > 0 ? newly_past(n, depth, ask->scale, ask->limit, &before_scaled) : 0;
        if (at == ask->n_fan || ask->fan[at] != year + 1) continue;
        memcpy(copy, depth, n * sizeof *copy);
        select_percentiles(n, copy, ask, depths + at * ask->n_percentiles);
        if (scaled) {
            for (size_t i = 0; i < n; i++) times[i] = depth[i] * ask->scale[i];
            select_percentiles(n, times, ask, scaled + at * ask->n_percentiles);
        }
        at++;
    }
}
