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
    *x   = m->x0 + setup->speed * dt + rx * d, *y = m->y0 + ry * d;
    v[0] = setup->speed + rx * s, v[1] = ry * s;
}

static void gap_of(double dx, double dy, double ux, double uy, double reach, double *gap, double *rate)
{
    double r2 = dx * dx + dy * dy, r = sqrt(r2);
    *gap      = (r2 - reach * reach) / (r + reach);
    *rate     = r > 0 ? -(dx * ux + dy * uy) / r : 0;
}

void fw_touch_gap(const fw_island *is, const fw_pair *p, bool at_end, double *gap, double *rate)
{
    const fw_member *a = &is->members[p->a];
    const double    *v = at_end ? a->v1 : a->v0;
    double dx = at_end ? a->x1 : a->x0, dy = at_end ? a->y1 : a->y0, ux = v[0], uy = v[1], reach = a->body->radius;
    if (p->b == FW_WALL) {
        reach += is->structure_radius;
    } else {
        const fw_member *b  = &is->members[p->b];
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
            if (s0 + u * (2 * c2 + 3 * c3 * u) < 0) lo = u;
            else hi = u;
        }
        if (gap0 + hi * (s0 + hi * (c2 + c3 * hi)) > 0) return INFINITY;
    }
    double lo = 0;
    for (int n = 0; n < 100 && hi - lo > 1e-15; n++) {
        double u = 0.5 * (lo + hi);
        if (gap0 + u * (s0 + u * (c2 + c3 * u)) > 0) lo = u;
        else hi = u;
    }
    return hi * h;
}

double fw_touch_free(const fw_island *is, const fw_pair *p, double dt)
{
    /* Conservative advancement: relative to the water speeds only fall, so the gap cannot close faster than bound. Near the
     * touch the actual closing rate takes over (Newton), kept on the open side by the bound. */
    fw_member a = is->members[p->a], b;
    double    u = is->setup->speed, bound = hypot(a.v0[0] - u, a.v0[1]), reach = a.body->radius;
    if (p->b == FW_WALL) {
        bound += u;
        reach += is->structure_radius;
    } else {
        b = is->members[p->b];
        bound += hypot(b.v0[0] - u, b.v0[1]);
        reach += b.body->radius;
    }
    if (!(bound > 0)) return INFINITY;
    double t = 0, tiny = 1e-12 * reach;
    double last_open = 0;
    for (int n = 0; n < 200 && t <= dt; n++) {
        double x, y, v[3], xb = 0, yb = 0, vb[3] = {0, 0, 0}, gap, rate;
        fw_touch_fly(is->setup, &a, t, &x, &y, v);
        if (p->b != FW_WALL) fw_touch_fly(is->setup, &b, t, &xb, &yb, vb);
        gap_of(x - xb, y - yb, v[0] - vb[0], v[1] - vb[1], reach, &gap, &rate);
        if (fabs(gap) <= tiny) {
            if (rate > 0) return t;
            if (n > 0 || gap < 0) {
                /* grazing or parting: step over it */
                last_open = t;
                t += fmax(1e-9 * dt, 1e-6 * reach / bound);
                continue;
            }
        }
        if (gap < 0) {
            if (rate <= 0 && t == 0) return INFINITY; /* parting already */
            t = 0.5 * (last_open + t);                /* Newton went past it */
            if (t - last_open < 1e-15 * (1 + t)) return t;
            continue;
        }
        last_open   = t;
        double safe = gap / bound;
        double newton = rate > 0.2 * bound || (rate > 0 && gap < 1e-3 * reach) ? gap / rate : safe;
        t += fmax(fmax(newton, safe), 1e-14 * (1 + t));
    }
    return INFINITY;
}
