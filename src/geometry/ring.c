#include "geometry/ring.h"

#include <math.h>

static const double TWO_PI = 6.283185307179586476925286766559, TURNS_PER_RADIAN = 1 / 6.283185307179586476925286766559;

double fw_ring_angle(double x, double y)
{
    double a = atan2(y, -x);
    if (a < 0) a += TWO_PI;
    return a < TWO_PI ? a : 0;
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

/* How much of the stretch from an edge's far end, y long, the edge has passed, on average over its sweep:
 * y^2 / (2 sweep) within the sweep, y - sweep / 2 beyond. Selections, not branches: where an edge lies among the arcs cannot be foreseen. */
static inline double passed(const edge *e, double y)
{
    y = y > 0 ? y : 0;
    double within = y < e->sweep ? y : e->sweep;
    return e->bend * within * within + (y - within);
}

/* Four doubles in one register where the machine has such; the compiler's own vectors, because it found them in the loops
 * below only half of the time. */
typedef double quad __attribute__((vector_size(32), aligned(8), may_alias));

static inline void add(quad *cell, const quad *amount, double share, size_t n_quads)
{
    for (size_t i = 0; i < n_quads; i++) cell[i] += amount[i] * share;
}

static inline size_t wrapped(size_t arc, size_t n_arcs) { return arc < n_arcs ? arc : arc - n_arcs; }

/* Inlined once with a stride of one quad. */
static inline void spread(quad *cells, size_t stride, size_t n_arcs, const double low[2], const double high[2],
                          const quad *amount)
{
    double n = (double)n_arcs, scale = n * TURNS_PER_RADIAN;
    double l0 = low[0] * scale, l1 = low[1] * scale, h0 = high[0] * scale, h1 = high[1] * scale;
    double lack = 1e-3 - 0.5 * ((h0 - l0) + (h1 - l1));
    if (lack > 0) l0 -= 0.5 * lack, l1 -= 0.5 * lack, h0 += 0.5 * lack, h1 += 0.5 * lack;
    double start = floor(l0 < l1 ? l0 : l1), k = start >= 0 && start < n ? start : start - n * floor(start / n);
    size_t first = k < n ? (size_t)k : 0;
    edge   tail = edge_of(l0 - start, l1 - start), nose = edge_of(h0 - start, h1 - start);
    double tail_end = tail.from + tail.sweep, end = nose.from + nose.sweep;
    if (!(end < 2 * n)) return; /* no number: the sums over the ring will show it */
    /* the width from the numbers that the shares come from: then they sum to 1 */
    double whole = 2 / ((nose.from + end) - (tail.from + tail_end)), last = 0;
    size_t count = (size_t)end;
    count += (double)count < end;
    if (count > n_arcs + 1) count = n_arcs + 1;
    /* Two arcs at least for either edge: most edges need no more, and a loop whose length seldom changes is a cheap one. */
    size_t a1 = (size_t)tail_end + 1, at_nose = count - (size_t)nose.from;
    if (a1 < 2) a1 = 2;
    if (at_nose < 2) at_nose = 2;
    if (a1 + at_nose > count) {
        for (size_t a = 0; a < count; a++) {
            double x = (double)(a + 1), next = passed(&tail, x - tail.from) - passed(&nose, x - nose.from);
            if (next > last) {
                add(cells + wrapped(first + a, n_arcs) * stride, amount, (next - last) * whole, stride);
                last = next;
            }
        }
        return;
    }
    for (size_t a = 0; a < a1; a++) {
        double next = passed(&tail, (double)(a + 1) - tail.from);
        add(cells + wrapped(first + a, n_arcs) * stride, amount, (next - last) * whole, stride);
        last = next;
    }
    size_t a2 = count - at_nose, from = first + a1, to = first + a2, until = to < n_arcs ? to : n_arcs;
    for (size_t a = from; a < until; a++) add(cells + a * stride, amount, whole, stride);
    for (size_t a = from > n_arcs ? from : n_arcs; a < to; a++)
        add(cells + (a - n_arcs) * stride, amount, whole, stride);
    last = 0;
    for (size_t a = count; a-- > a2;) {
        double next = passed(&nose, end - (double)a);
        add(cells + wrapped(first + a, n_arcs) * stride, amount, (next - last) * whole, stride);
        last = next;
    }
}

void fw_ring_spread(double *cells, size_t n_quads, size_t n_arcs, const double low[2], const double high[2],
                    const double *amount)
{
    if (n_quads == 1)
        spread((quad *)cells, 1, n_arcs, low, high, (const quad *)amount);
    else
        spread((quad *)cells, n_quads, n_arcs, low, high, (const quad *)amount);
}
