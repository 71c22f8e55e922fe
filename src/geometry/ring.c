#include "geometry/ring.h"

#include <math.h>

static const double TWO_PI = 6.283185307179586476925286766559;

double fw_ring_angle(double x, double y)
{
    double a = atan2(y, -x);
    if (a < 0) a += TWO_PI;
    return a < TWO_PI ? a : 0;
}

size_t fw_ring_cover(size_t n_arcs, double centre, double half, size_t *first, double *share)
{
    double n = (double)n_arcs;
    double scale = n / TWO_PI;
    double low = (centre - half) * scale, high = (centre + half) * scale; /* in arcs, may be negative */
    if (high - low > n) high = low + n;
    double a = floor(low);
    double k = a >= 0 && a < n ? a : fmod(a, n);
    if (k < 0) k += n;
    *first = (size_t)k;
    if (*first >= n_arcs) *first = 0;
    double width = high - low;
    if (!(width > 1e-12)) {
        share[0] = 1;
        return 1;
    }
    size_t count = 0;
    double whole = 1 / width;
    for (double from = low, edge = a + 1; from < high && count <= n_arcs; from = edge, edge += 1, count++)
        share[count] = count > 0 && edge <= high ? whole : ((edge < high ? edge : high) - from) / width;
    return count;
}
