#include "statistics/mixture.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { MOST_EXACT_ENTRIES = 20000, MOST_BINS = 200000 };
static const double bin_width = 1e-3; /* of ln load */

/* Ascending loads, by radix: the bits of positive doubles order like the doubles. Stable, so equal loads keep their
 * order; on a million entries ten times as fast as qsort, which a report pays for at every point. other (n) is
 * scratch. */
static void sort_by_load(size_t n, fw_mixture_entry *entries, fw_mixture_entry *other)
{
    enum { BITS = 11, BUCKETS = 1 << BITS };
    fw_mixture_entry *from = entries, *to = other;
    for (int shift = 0; shift < 64; shift += BITS) {
        size_t   first[BUCKETS + 1] = {0};
        uint64_t bits;
        for (size_t i = 0; i < n; i++) {
            memcpy(&bits, &from[i].load, sizeof bits);
            first[((bits >> shift) & (BUCKETS - 1)) + 1]++;
        }
        for (size_t b = 0; b < BUCKETS; b++) first[b + 1] += first[b];
        for (size_t i = 0; i < n; i++) {
            memcpy(&bits, &from[i].load, sizeof bits);
            to[first[(bits >> shift) & (BUCKETS - 1)]++] = from[i];
        }
        fw_mixture_entry *last = from;
        from = to;
        to = last;
    }
    /* 64 bits in steps of 11 are six passes: an even number, so the result is back in entries */
}

/* Entries whose loads share a bin of ln load become one at their weighted mean. Bins are visited in order, so the
 * result is sorted without a sort, and sums run in entry order, so they are the same on every run. */
static fw_status join_in_bins(fw_mixture *x, size_t n, const fw_mixture_entry *from, fw_msg *m)
{
    double lowest = INFINITY, highest = 0;
    for (size_t i = 0; i < n; i++) {
        if (from[i].load <= 0 || from[i].weight <= 0) continue;
        lowest = fmin(lowest, from[i].load);
        highest = fmax(highest, from[i].load);
    }
    if (!(highest > 0)) return FW_OK;
    double ln_low = log(lowest), range = log(highest) - ln_low;
    size_t n_bins = (size_t)fmin(range / bin_width, MOST_BINS - 1) + 1;
    double per_ln = range > 0 ? (double)n_bins / range : 0;
    FW_TRY(fw_alloc(&x->entries, n_bins, sizeof *x->entries, "bins of an averaged distribution", m));
    for (size_t i = 0; i < n; i++) {
        if (from[i].load <= 0) continue;
        size_t k = (size_t)((log(from[i].load) - ln_low) * per_ln);
        if (k >= n_bins) k = n_bins - 1;
        x->entries[k].load += from[i].load * from[i].weight;
        x->entries[k].weight += from[i].weight;
    }
    for (size_t k = 0; k < n_bins; k++) {
        if (!(x->entries[k].weight > 0)) continue;
        x->entries[x->n].load = x->entries[k].load / x->entries[k].weight;
        x->entries[x->n++].weight = x->entries[k].weight;
    }
    return FW_OK;
}

static fw_status keep_sorted(fw_mixture *x, size_t n, const fw_mixture_entry *from, fw_msg *m)
{
    FW_TRY(fw_alloc(&x->entries, n, sizeof *x->entries, "entries of an averaged distribution", m));
    for (size_t i = 0; i < n; i++)
        if (from[i].load > 0 && from[i].weight > 0) x->entries[x->n++] = from[i];
    fw_mixture_entry *other = NULL;
    FW_TRY(fw_alloc(&other, x->n, sizeof *other, "entries of an averaged distribution", m));
    sort_by_load(x->n, x->entries, other);
    free(other);
    return FW_OK;
}

static fw_status make(fw_mixture *x, size_t n, const fw_mixture_entry *from, fw_msg *m)
{
    double total = 0;
    for (size_t i = 0; i < n; i++) {
        FW_CHECK(isfinite(from[i].load) && from[i].load >= 0 && isfinite(from[i].weight) && from[i].weight >= 0, m,
                 FW_E_ARG, "load %g with weight %g: both have to be finite and >= 0", from[i].load, from[i].weight);
        total += from[i].weight;
        if (from[i].load <= 0) x->zero_weight += from[i].weight;
    }
    FW_CHECK(total > 0, m, FW_E_ARG, "an averaged distribution of no realisations does not exist");
    if (x->scale->is_discrete || n <= MOST_EXACT_ENTRIES) {
        FW_TRY(keep_sorted(x, n, from, m));
    } else {
        FW_TRY(join_in_bins(x, n, from, m));
    }
    FW_TRY(fw_alloc(&x->cumulative, x->n + 1, sizeof *x->cumulative, "weights of an averaged distribution", m));
    x->zero_weight /= total;
    x->cumulative[0] = x->zero_weight;
    for (size_t k = 0; k < x->n; k++) {
        x->entries[k].weight /= total;
        x->cumulative[k + 1] = x->cumulative[k] + x->entries[k].weight;
        if (!x->scale->is_discrete) x->entries[k].load = log(x->entries[k].load);
    }
    return FW_OK;
}

fw_status fw_mixture_make(fw_mixture *out, const fw_scale *scale, size_t n, const fw_mixture_entry *entries, fw_msg *m)
{
    memset(out, 0, sizeof *out);
    out->scale = scale;
    fw_status s = make(out, n, entries, m);
    if (s != FW_OK) fw_mixture_free(out);
    return s;
}

void fw_mixture_free(fw_mixture *x)
{
    if (!x) return;
    free(x->entries);
    free(x->cumulative);
    memset(x, 0, sizeof *x);
}

/* Number of entries with load <= limit. */
static size_t count_up_to(const fw_mixture *x, double limit)
{
    size_t from = 0, to = x->n;
    while (from < to) {
        size_t k = from + (to - from) / 2;
        if (x->entries[k].load <= limit) {
            from = k + 1;
        } else {
            to = k;
        }
    }
    return from;
}

static double cdf_continuous(const fw_mixture *x, double ln_depth)
{
    const fw_scale *s = x->scale;
    size_t          certain = count_up_to(x, ln_depth - s->ln_max), possible = count_up_to(x, ln_depth - s->ln_min);
    double          sum = x->cumulative[certain];
    for (size_t k = certain; k < possible; k++)
        sum += x->entries[k].weight * fw_scale_cdf_ln(s, ln_depth - x->entries[k].load);
    return sum;
}

static double cdf_discrete(const fw_mixture *x, double depth)
{
    double sum = 0;
    for (size_t t = 0; t < x->scale->n; t++)
        sum += x->scale->weights[t] * x->cumulative[count_up_to(x, depth / x->scale->values[t])];
    return sum;
}

double fw_mixture_cdf(const fw_mixture *x, double depth)
{
    if (!(depth >= 0)) return 0;
    if (depth == 0) return x->zero_weight;
    return fmin(x->scale->is_discrete ? cdf_discrete(x, depth) : cdf_continuous(x, log(depth)), 1);
}

double fw_mixture_quantile(const fw_mixture *x, double p)
{
    if (!(p > 0 && p <= 1)) return NAN;
    p *= 1 - 1e-13; /* sums of weights end a rounding short of 1 */
    if (x->zero_weight >= p || x->n == 0) return 0;
    const fw_scale *s = x->scale;
    bool            is_discrete = s->is_discrete;
    double          from, to;
    if (is_discrete) {
        from = log(x->entries[0].load * s->values[0]) - 1e-9;
        to = log(x->entries[x->n - 1].load * s->values[s->n - 1]) + 1e-9;
    } else {
        from = x->entries[0].load + s->ln_min;
        to = x->entries[x->n - 1].load + s->ln_max;
    }
    for (int i = 0; i < 64 && to - from > 1e-14 * fmax(1, fabs(to)); i++) {
        double mid = 0.5 * (from + to);
        double F = is_discrete ? cdf_discrete(x, exp(mid)) : cdf_continuous(x, mid);
        if (F >= p) {
            to = mid;
        } else {
            from = mid;
        }
    }
    return exp(to);
}
