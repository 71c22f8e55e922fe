#include "geometry/ring.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

static const double TWO_PI = 6.283185307179586476925286766559, TURNS_PER_RADIAN = 1 / 6.283185307179586476925286766559;

double fw_ring_angle(double x, double y)
{
    double a = atan2(y, -x);
    if (a < 0) a += TWO_PI;
    return a < TWO_PI ? a : 0;
}

double fw_ring_turn(double x0, double y0, double x1, double y1)
{
    double across = x1 * y0 - x0 * y1, along = x0 * x1 + y0 * y1, t = across / along, s = t * t;
    if (!(along > 0) || s > 0.01) return atan2(across, along);
    double high = 1.0 / 9 - s * (1.0 / 11 - s * (1.0 / 13)), low = 1.0 / 3 - s * (1.0 / 5 - s * (1.0 / 7 - s * high));
    return t * (1 - s * low); /* left out: 1e-15 of a turn of six degrees */
}

/* An edge that sweeps evenly over [from, from + sweep], lengths in arcs. */
typedef struct edge {
    double from, sweep, bend;
} edge;

static edge edge_of(double a, double b)
{
    edge e = {a < b ? a : b, fabs(b - a), 0};
    if (e.sweep > 1e-9)
        e.bend = 0.5 / e.sweep;
    else
        e.sweep = 0;
    return e;
}

/* Four doubles in one register where the machine has such; the compiler's own vectors, because it found them in the loops
 * below only half of the time. Arcs go by registers: a pair at a time where a register holds no more, since four split in halves
 * cost twice as much as one after the other. The maximum is one instruction that the compiler does not find. */
typedef double  quad __attribute__((vector_size(32), aligned(8), may_alias));
#ifdef __AVX__
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double lanes __attribute__((vector_size(LANES * 8)));

static inline lanes positive(lanes x)
{
#if defined __AVX__
    return __builtin_ia32_maxpd256(x, (lanes){0});
#elif defined __SSE2__
    return __builtin_ia32_maxpd(x, (lanes){0});
#else
    typedef int64_t mask __attribute__((vector_size(LANES * 8)));
    return (lanes)((mask)x & (mask)(x > 0));
#endif
}

/* What stands before each of `now`, given what was before. */
static inline lanes shifted(lanes before, lanes now)
{
#ifdef __AVX__
    return __builtin_shufflevector(before, now, 3, 4, 5, 6);
#else
    return __builtin_shufflevector(before, now, 1, 2);
#endif
}

/* How much of the stretch from an edge's far end to x the edge has passed, on average over its sweep: with y the stretch's length
 * y^2 / (2 sweep) within the sweep, y - sweep / 2 beyond. Several x at a time and selections, not branches: where an edge lies among
 * the arcs cannot be foreseen. */
static inline lanes passed(const edge *e, lanes x)
{
    lanes y = positive(x - e->from), beyond = positive(y - e->sweep), within = y - beyond;
    return e->bend * within * within + beyond;
}

static inline void add(quad *cell, const quad *amount, double share, size_t n_quads)
{
    for (size_t i = 0; i < n_quads; i++) cell[i] += amount[i] * share;
}

/* Where a patch lies, in arcs from the first of the n it reaches. */
typedef struct patch {
    edge   low, high;
    double end, whole; /* where the high edge ends; share of an arc that is covered all the time */
    size_t first, n;
} patch;

static inline bool locate(patch *p, size_t n_arcs, const double low[2], const double high[2])
{
    double n = (double)n_arcs, scale = n * TURNS_PER_RADIAN;
    double l0 = low[0] * scale, l1 = low[1] * scale, h0 = high[0] * scale, h1 = high[1] * scale;
    double lack = 1e-3 - 0.5 * ((h0 - l0) + (h1 - l1));
    if (lack > 0) l0 -= 0.5 * lack, l1 -= 0.5 * lack, h0 += 0.5 * lack, h1 += 0.5 * lack;
    double start = floor(l0 < l1 ? l0 : l1), k = start >= 0 && start < n ? start : start - n * floor(start / n);
    p->first = k < n ? (size_t)k : 0;
    p->low = edge_of(l0 - start, l1 - start), p->high = edge_of(h0 - start, h1 - start);
    double low_end = p->low.from + p->low.sweep, end = p->high.from + p->high.sweep;
    if (!(end < 2 * n)) return false; /* no number: the sums over the ring will show it */
    /* the width from the numbers that the shares come from: then they sum to 1 */
    p->end = end, p->whole = 2 / ((p->high.from + end) - (p->low.from + low_end));
    size_t count = (size_t)end;
    count += (double)count < end;
    p->n = count < n_arcs + 1 ? count : n_arcs + 1;
    return true;
}

/* Shares of the next arcs, x their ends: what was covered up to an arc's end less what was up to the arc before; past the patch
 * 0, exactly. */
static inline lanes shares(const patch *p, lanes x, lanes *covered)
{
    lanes to = p->end - positive(p->end - x), before = *covered;
    *covered = passed(&p->low, to) - passed(&p->high, to);
    return positive(*covered - shifted(before, *covered)) * p->whole;
}

static inline lanes first_ends(void)
{
    lanes x;
    for (int i = 0; i < LANES; i++) x[i] = i + 1;
    return x;
}

static void lay_round(quad *cell, size_t stride, size_t n_arcs, const patch *p, const quad *amount)
{
    lanes covered = {0}, share, x = first_ends();
    for (size_t a = 0; a < p->n; a += LANES, x += LANES) {
        share = shares(p, x, &covered);
        for (size_t i = 0; i < LANES && a + i < p->n; i++) {
            if (p->first + a + i == n_arcs) cell -= n_arcs * stride;
            add(cell, amount, share[i], stride);
            cell += stride;
        }
    }
}

/* The same for a patch that stays below arc n_arcs when rounded up to whole registers. Inlined for one quad and for many. */
static inline void lay(quad *cell, size_t stride, const patch *p, const quad *amount)
{
    lanes covered = {0}, share, x = first_ends();
    for (quad *end = cell + p->n * stride; cell < end; cell += LANES * stride, x += LANES) {
        share = shares(p, x, &covered);
        add(cell, amount, share[0], stride);
        add(cell + stride, amount, share[1], stride);
#ifdef __AVX__
        add(cell + 2 * stride, amount, share[2], stride);
        add(cell + 3 * stride, amount, share[3], stride);
#endif
    }
}

void fw_ring_spread(double *cells, size_t n_quads, size_t n_arcs, const double low[2], const double high[2],
                    const double *amount)
{
    quad       *to = (quad *)cells;
    const quad *of = (const quad *)amount;
    patch       p;
    if (!locate(&p, n_arcs, low, high)) return;
    to += p.first * n_quads;
    if (p.first + p.n + LANES - 1 > n_arcs)
        lay_round(to, n_quads, n_arcs, &p, of);
    else if (n_quads == 1) /* a constant stride each: no loop over quads */
        lay(to, 1, &p, of);
    else if (n_quads == 2)
        lay(to, 2, &p, of);
    else
        lay(to, n_quads, &p, of);
}
