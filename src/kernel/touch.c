/* When do two rims meet? */
#include <math.h>

#include "kernel/island.h"
#include "physics/drag.h"

void fw_touch_fly(const fw_setup *setup, const fw_member *m, double dt, double *x, double *y, double v[3])
{
    double rx = m->v0[0] - setup->speed, ry = m->v0[1], r = sqrt(rx * rx + ry * ry);
    v[2] = m->v0[2];
    if (!(m->body->drag > 0)) {
        *x = m->x0 + m->v0[0] * dt, *y = m->y0 + m->v0[1] * dt;
        v[0] = m->v0[0], v[1] = m->v0[1];
        return;
    }
    if (!(r > 0)) {
        *x = m->x0 + setup->speed * dt, *y = m->y0;
        v[0] = setup->speed, v[1] = 0;
        return;
    }
    fw_drag_flow f = fw_drag_free(m->body->drag * m->body->inv_mass, r, dt);
    double       d = f.distance / r, s = f.speed / r;
    *x = m->x0 + setup->speed * dt + rx * d, *y = m->y0 + ry * d;
    v[0] = setup->speed + rx * s, v[1] = ry * s;
}

static void gap_of(double dx, double dy, double ux, double uy, double reach, double *gap, double *rate)
{
    double r2 = dx * dx + dy * dy, r = sqrt(r2);
    *gap = (r2 - reach * reach) / (r + reach);
    *rate = r > 0 ? -(dx * ux + dy * uy) / r : 0;
}

void fw_touch_gap(const fw_island *is, const fw_pair *p, bool at_end, double *gap, double *rate)
{
    const fw_member *a = &is->members[p->a];
    const double    *v = at_end ? a->v1 : a->v0;
    double dx = at_end ? a->x1 : a->x0, dy = at_end ? a->y1 : a->y0, ux = v[0], uy = v[1], reach = a->body->radius;
    if (p->b == FW_WALL) {
        reach += is->structure_radius;
    } else {
        const fw_member *b = &is->members[p->b];
        const double    *vb = at_end ? b->v1 : b->v0;
        dx -= at_end ? b->x1 : b->x0, dy -= at_end ? b->y1 : b->y0;
        ux -= vb[0], uy -= vb[1];
        reach += b->body->radius;
    }
    gap_of(dx, dy, ux, uy, reach, gap, rate);
}

double fw_touch_root(double gap0, double rate0, double gap1, double rate1, double h)
{
    /* g(u) on u in [0, 1]; slopes are -rate. */
    double s0 = -rate0 * h, s1 = -rate1 * h;
    double c2 = 3 * (gap1 - gap0) - 2 * s0 - s1, c3 = 2 * (gap0 - gap1) + s0 + s1;
    double hi = 1;
    if (gap1 > 0) {
        /* Both ends open: touch only if the gap dips below zero between, i.e. it closes at first and opens at last. */
        if (!(s0 < 0 && s1 > 0)) return INFINITY;
        double lo = 0;
        for (int n = 0; n < 60 && hi - lo > 1e-12; n++) { /* the slope's root */
            double u = 0.5 * (lo + hi);
            if (s0 + u * (2 * c2 + 3 * c3 * u) < 0)
                lo = u;
            else
                hi = u;
        }
        if (gap0 + hi * (s0 + hi * (c2 + c3 * hi)) > 0) return INFINITY;
    }
    double lo = 0;
    for (int n = 0; n < 100 && hi - lo > 1e-15; n++) {
        double u = 0.5 * (lo + hi);
        if (gap0 + u * (s0 + u * (c2 + c3 * u)) > 0)
            lo = u;
        else
            hi = u;
    }
    return hi * h;
}

static void free_gap(const fw_island *is, const fw_pair *p, double t, double reach, double *gap, double *rate)
{
    double x, y, v[3], xb = 0, yb = 0, vb[3] = {0, 0, 0};
    fw_touch_fly(is->setup, &is->members[p->a], t, &x, &y, v);
    if (p->b != FW_WALL) fw_touch_fly(is->setup, &is->members[p->b], t, &xb, &yb, vb);
    gap_of(x - xb, y - yb, v[0] - vb[0], v[1] - vb[1], reach, gap, rate);
}

double fw_touch_free(const fw_island *is, const fw_pair *p, double dt)
{
    /* Speeds relative to the water only fall, so the gap closes no faster than bound: wide gaps are skipped by it. In
     * the last tenth of reach the ways are nearly straight and the cubic finds the touch, Newton on the exact flight
     * locates it. (Skipping alone needs hundreds of looks at two floes that drift side by side and close slowly.) */
    const fw_member *a = &is->members[p->a];
    double           bound = fw_length(a->v0[0] - is->setup->speed, a->v0[1]), reach = a->body->radius;
    if (p->b == FW_WALL) {
        bound += is->setup->speed;
        reach += is->structure_radius;
    } else {
        const fw_member *b = &is->members[p->b];
        bound += fw_length(b->v0[0] - is->setup->speed, b->v0[1]);
        reach += b->body->radius;
    }
    if (!(bound > 0)) return INFINITY;
    const double tiny = 1e-12 * reach, close = 0.1 * reach;
    double       gap, rate;
    free_gap(is, p, 0, reach, &gap, &rate);
    if (gap <= tiny && rate > 0) return 0;
    for (double t = 0; t < dt;) {
        if (gap > close) {
            t += (gap - 0.5 * close) / bound;
            if (t < dt) free_gap(is, p, t, reach, &gap, &rate);
            continue;
        }
        double h = fmin(dt - t, close / bound), gap1, rate1;
        free_gap(is, p, t + h, reach, &gap1, &rate1);
        double root = fw_touch_root(fmax(gap, 0), rate, gap1, rate1, h);
        if (root <= h && !(gap <= 0 && rate <= 0 && gap1 > 0)) {
            double at = t + root;
            for (int n = 0; n < 30; n++) {
                double g, r;
                free_gap(is, p, at, reach, &g, &r);
                if (!(r > 0)) break; /* grazing: the cubic's dip is not there */
                if (fabs(g) <= tiny) return at;
                at = fmin(t + h, fmax(t, at + g / r));
                if (n == 29) return at;
            }
        }
        t += h, gap = gap1, rate = rate1;
        if (dt - t <= 1e-15 * dt) break;
    }
    return INFINITY;
}
