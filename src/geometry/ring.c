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
    if (!(along > 0) || s > 0.0025) return atan2(across, along);
    return t * (1 - s * (1.0 / 3 - s * (1.0 / 5 - s * (1.0 / 7 - s * (1.0 / 9 - s * (1.0 / 11)))))); /* left out: 3e-17 t */
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

/* Where a patch lies, in arcs from the first one it reaches. Its low edge sweeps over the first n_tail arcs, its high edge over
 * the last n_nose; they share arcs when n_tail + n_nose > n. */
typedef struct patch {
    edge   tail, nose;
    double end, whole; /* where the nose ends; share of an arc that is covered all the time */
    size_t first, n, n_tail, n_nose;
} patch;

static inline bool locate(patch *p, size_t n_arcs, const double low[2], const double high[2])
{
    double n = (double)n_arcs, scale = n * TURNS_PER_RADIAN;
    double l0 = low[0] * scale, l1 = low[1] * scale, h0 = high[0] * scale, h1 = high[1] * scale;
    double lack = 1e-3 - 0.5 * ((h0 - l0) + (h1 - l1));
    if (lack > 0) l0 -= 0.5 * lack, l1 -= 0.5 * lack, h0 += 0.5 * lack, h1 += 0.5 * lack;
    double start = floor(l0 < l1 ? l0 : l1), k = start >= 0 && start < n ? start : start - n * floor(start / n);
    p->first = k < n ? (size_t)k : 0;
    p->tail = edge_of(l0 - start, l1 - start), p->nose = edge_of(h0 - start, h1 - start);
    double tail_end = p->tail.from + p->tail.sweep, end = p->nose.from + p->nose.sweep;
    if (!(end < 2 * n)) return false; /* no number: the sums over the ring will show it */
    /* the width from the numbers that the shares come from: then they sum to 1 */
    p->end = end, p->whole = 2 / ((p->nose.from + end) - (p->tail.from + tail_end));
    size_t count = (size_t)end;
    count += (double)count < end;
    p->n = count = count < n_arcs + 1 ? count : n_arcs + 1;
    /* Two arcs at least for either edge: most edges need no more, and a loop whose length seldom changes is a cheap one. */
    size_t n_tail = (size_t)tail_end + 1, n_nose = count - (size_t)p->nose.from;
    p->n_tail = n_tail < 2 ? 2 : n_tail, p->n_nose = n_nose < 2 ? 2 : n_nose;
    return true;
}

/* Inlined for one quad and for many, and for a patch that does not pass arc 0: `round` is a constant, and cell `a` then a plain
 * address. */
static inline void lay(quad *cells, size_t stride, size_t n_arcs, const patch *p, const quad *amount, bool round)
{
    quad        *near = cells + p->first * stride;
    const size_t beyond = round ? n_arcs - p->first : SIZE_MAX; /* from this arc of the patch on: at the ring's beginning */
    double       last = 0, y;
#define CELL(a) ((a) < beyond ? near + (a)*stride : near + (a)*stride - n_arcs * stride)
    if (p->n_tail + p->n_nose > p->n) {
        y = 1;
        for (size_t a = 0; a < p->n; a++, y += 1) {
            double next = passed(&p->tail, y - p->tail.from) - passed(&p->nose, y - p->nose.from), share = next - last;
            if (share > 0) {
                add(CELL(a), amount, share * p->whole, stride);
                last = next;
            }
        }
        return;
    }
    size_t rest = p->n - p->n_nose, a = p->n_tail;
    y = 1 - p->tail.from;
    for (size_t i = 0; i < a; i++, y += 1) {
        double next = passed(&p->tail, y);
        add(CELL(i), amount, (next - last) * p->whole, stride);
        last = next;
    }
    for (; a + 1 < rest; a += 2) {
        add(CELL(a), amount, p->whole, stride);
        add(CELL(a + 1), amount, p->whole, stride);
    }
    if (a < rest) add(CELL(a), amount, p->whole, stride);
    last = 0, y = p->end - (double)p->n + 1;
    for (size_t i = p->n; i-- > rest; y += 1) {
        double next = passed(&p->nose, y);
        add(CELL(i), amount, (next - last) * p->whole, stride);
        last = next;
    }
#undef CELL
}

void fw_ring_spread(double *cells, size_t n_quads, size_t n_arcs, const double low[2], const double high[2],
                    const double *amount)
{
    quad       *to = (quad *)cells;
    const quad *of = (const quad *)amount;
    patch       p;
    if (!locate(&p, n_arcs, low, high)) return;
    if (p.first + p.n > n_arcs)
        lay(to, n_quads, n_arcs, &p, of, true);
    else if (n_quads == 1)
        lay(to, 1, n_arcs, &p, of, false);
    else
        lay(to, n_quads, n_arcs, &p, of, false);
}
