#include "kernel/path.h"

#include <float.h>
#include <math.h>

#include "effects/skin_drag.h"
#include "physics/drag.h"

fw_path fw_path_of_structure(const fw_setup *s)
{
    return (fw_path){.kind = FW_PATH_STANDS, .radius = s->structure_radius, .ux = s->flow.ux, .uy = s->flow.uy, .bound = fw_length(s->flow.ux, s->flow.uy)};
}

fw_path fw_path_of_drifting(const fw_setup *s, double t0, double x, double y, double radius)
{
    const fw_flow *f = &s->flow;
    return (fw_path){.kind = FW_PATH_DRIFTS,
                     .radius = radius,
                     .t0 = t0,
                     .x = x,
                     .y = y,
                     .vx = f->ice_x,
                     .vy = f->ice_y,
                     .ux = f->ux,
                     .uy = f->uy,
                     .bound = fw_length(f->ice_x - f->ux, f->ice_y - f->uy)};
}

fw_path fw_path_of_flying(const fw_setup *s, const fw_body *b)
{
    double r = fw_length(b->vx - s->flow.ux, b->vy - s->flow.uy);
    return (fw_path){.kind = r > 0 ? FW_PATH_FLIES : FW_PATH_DRIFTS,
                     .radius = b->radius,
                     .t0 = b->t,
                     .x = b->x,
                     .y = b->y,
                     .vx = b->vx,
                     .vy = b->vy,
                     .ux = s->flow.ux,
                     .uy = s->flow.uy,
                     .K = b->drag * b->inv_mass,
                     .r = r,
                     .bound = r};
}

fw_path fw_path_of_member(const fw_setup *s, const fw_cluster *c, const fw_member *m)
{
    return (fw_path){.kind = FW_PATH_CUBIC,
                     .radius = m->radius,
                     .t0 = c->t0,
                     .x = m->y0[FW_X],
                     .y = m->y0[FW_Y],
                     .vx = m->y0[FW_VX],
                     .vy = m->y0[FW_VY],
                     .ux = s->flow.ux,
                     .uy = s->flow.uy,
                     .h = c->t1 - c->t0,
                     .x1 = m->y1[FW_X],
                     .y1 = m->y1[FW_Y],
                     .vx1 = m->y1[FW_VX],
                     .vy1 = m->y1[FW_VY],
                     .bound = m->fastest};
}

/* Cubic through both ends and its slope, u = share of the step. */
static void cubic(double f0, double s0, double f1, double s1, double h, double u, double *value, double *slope)
{
    double d = f1 - f0, c2 = 3 * d - h * (2 * s0 + s1), c3 = h * (s0 + s1) - 2 * d;
    *value = f0 + u * (h * s0 + u * (c2 + u * c3));
    *slope = s0 + u * (2 * c2 + 3 * u * c3) / h;
}

fw_place fw_path_at(const fw_path *p, double t)
{
    double dt = t - p->t0;
    if (dt == 0) return (fw_place){p->x, p->y, p->vx, p->vy};
    switch (p->kind) {
    case FW_PATH_STANDS: return (fw_place){p->x, p->y, 0, 0};
    case FW_PATH_DRIFTS: return (fw_place){p->x + p->vx * dt, p->y + p->vy * dt, p->vx, p->vy};
    case FW_PATH_FLIES: {
        if (!(p->K > 0)) return (fw_place){p->x + p->vx * dt, p->y + p->vy * dt, p->vx, p->vy};
        fw_drag_flow f = fw_drag_free(p->K, p->r, dt);
        double       per_r = 1 / p->r, rx = (p->vx - p->ux) * per_r, ry = (p->vy - p->uy) * per_r;
        return (fw_place){p->x + p->ux * dt + rx * f.distance, p->y + p->uy * dt + ry * f.distance, p->ux + rx * f.speed,
                          p->uy + ry * f.speed};
    }
    case FW_PATH_CUBIC: break;
    }
    fw_place at;
    if (!(dt > 0)) return (fw_place){p->x, p->y, p->vx, p->vy};
    if (dt >= p->h) return (fw_place){p->x1, p->y1, p->vx1, p->vy1};
    cubic(p->x, p->vx, p->x1, p->vx1, p->h, dt / p->h, &at.x, &at.vx);
    cubic(p->y, p->vy, p->y1, p->vy1, p->h, dt / p->h, &at.y, &at.vy);
    return at;
}

double fw_flight_spin(const fw_body *b, double r, double K, double t, double *turned)
{
    /* dw/dt = -q w sqrt((3 V / 4)^2 + (2 R w / 5)^2), q = coefficient R^2 / I, V = r / (1 + K r t): ln w is smooth. Classical fourth
     * order, in steps within which neither V nor w changes by more than a tenth; the angle by Simpson, ln w in the middle as the same four slopes have it. */
    double q = b->spin_drag * b->inv_inertia, w = b->spin, done = 0;
    *turned = 0;
    while (done < t) {
        double V = r / (1 + K * r * done), rate = fw_skin_drag_torque_rate(q, b->radius, V, w), h = fw_smaller(t - done, 0.1 / (rate + K * V + 1e-300));
        double k[4], at[4] = {0, 0.5 * h, 0.5 * h, h};
        for (int j = 0; j < 4; j++) { /* d ln w / dt */
            double now = w * exp(j ? k[j - 1] * at[j] : 0);
            k[j] = -fw_skin_drag_torque_rate(q, b->radius, r / (1 + K * r * (done + at[j])), now);
        }
        double was = w, middle = w * exp(h / 24 * (5 * k[0] + 4 * k[1] + 4 * k[2] - k[3]));
        w *= exp(h / 6 * (k[0] + 2 * k[1] + 2 * k[2] + k[3]));
        *turned += h / 6 * (was + 4 * middle + w);
        done = t - done <= h ? t : done + h;
    }
    return w;
}

void fw_path_gap(const fw_path *a, const fw_path *b, double t, double *gap, double *closing)
{
    fw_place p = fw_path_at(a, t), q = fw_path_at(b, t);
    double   dx = p.x - q.x, dy = p.y - q.y, reach = a->radius + b->radius, r2 = dx * dx + dy * dy, r = sqrt(r2);
    *gap = (r2 - reach * reach) / (r + reach); /* without cancellation */
    *closing = r > 0 ? -(dx * (p.vx - q.vx) + dy * (p.vy - q.vy)) / r : 0;
}

double fw_path_root(double gap0, double rate0, double gap1, double rate1, double h)
{
    /* g(u) on u in [0, 1]; slopes are -rate. */
    double s0 = -rate0 * h, s1 = -rate1 * h;
    double c2 = 3 * (gap1 - gap0) - 2 * s0 - s1, c3 = 2 * (gap0 - gap1) + s0 + s1;
    double hi = 1;
    if (gap1 > 0) {
        /* Both ends open: touch only if the gap's least value between is below zero. Rims that part slowly may be back within h. */
        double d = c2 * c2 - 3 * c3 * s0;
        if (!(d > 0)) return INFINITY;
        hi = c2 < 0 ? (sqrt(d) - c2) / (3 * c3) : -s0 / (sqrt(d) + c2);
        if (!(hi > 0 && hi < 1) || gap0 + hi * (s0 + hi * (c2 + c3 * hi)) > 0) return INFINITY;
    }
    /* Newton from wherever the bracket is, bisection when it leaves it. */
    double lo = 0, u = gap1 > 0 ? 0.5 * hi : hi * gap0 / (gap0 - gap1);
    for (int n = 0; n < 100 && hi - lo > 1e-15; n++) {
        if (!(u > lo && u < hi)) u = 0.5 * (lo + hi);
        double g = gap0 + u * (s0 + u * (c2 + u * c3)), slope = s0 + u * (2 * c2 + 3 * u * c3), next = u - g / slope;
        if (g > 0)
            lo = u;
        else
            hi = u;
        if (fabs(next - u) < 1e-15) return (g > 0 && next < hi ? next : hi) * h;
        u = next;
    }
    return hi * h;
}

/* From the cubic's root to the paths' own: Newton, kept between an instant before the touch and one at which they overlap (where there is one).
 * Floes that part and come back slowly have a hump of gap between, from whose top Newton goes anywhere. */
static double polish(const fw_path *a, const fw_path *b, double at, double low, double high, bool is_over, double tiny)
{
    for (int n = 0; n < 60; n++) {
        double g, r;
        fw_path_gap(a, b, at, &g, &r);
        if (!(r > 0) && !is_over) return INFINITY; /* grazing: the cubic's dip is not there */
        if (fabs(g) <= tiny && r > 0) break;
        if (g > 0 || !(r > 0))
            low = at;
        else
            high = at, is_over = true;
        double next = r > 0 ? at + g / r : high;
        if (is_over && !(next > low && next < high)) next = 0.5 * (low + high);
        next = fw_smaller(high, fw_larger(low, next));
        if (next == at) break;
        at = next;
    }
    return at;
}

/* Gap over reach below which touches are looked for five times as often: a floe that left the structure at a glance is back after a hump
 * of some 1e-6, dips in as little and leaves, all within one length otherwise (1 of 20000 random hits: 6 % of its depth). */
static const double BARELY = 1e-4;

double fw_path_touch(const fw_path *a, const fw_path *b, double from, double until, double gap, double rate)
{
    /* Speeds are bounded, so a wide gap is skipped by its bound. In the last tenth of reach the ways are nearly
     * straight and the cubic finds the touch. (Skipping alone needs hundreds of looks at two floes that drift side by side
     * and close slowly.) */
    double reach = a->radius + b->radius, bound = a->bound + b->bound, tiny = 1e-12 * reach, close = 0.1 * reach;
    if (gap <= tiny && rate > 0) return from;
    if (!(bound > 0)) return INFINITY;
    for (double t = from; t < until;) {
        if (gap > close) {
            t += (gap - 0.5 * close) / bound;
            if (t < until) fw_path_gap(a, b, t, &gap, &rate);
            continue;
        }
        double h = fw_smaller(until - t, (gap < BARELY * reach ? 0.2 : 1) * close / bound), gap1, rate1;
        fw_path_gap(a, b, t + h, &gap1, &rate1);
        if (!(gap <= 0 && rate <= 0 && gap1 <= 0 && rate1 <= 0)) { /* just opened: it parts */
            double root = fw_path_root(fw_larger(gap, DBL_MIN), rate, gap1, rate1, h);
            if (root <= h) {
                double at = polish(a, b, t + root, t, t + h, gap1 <= 0, tiny);
                if (at <= until) return at;
            }
        }
        t += h, gap = gap1, rate = rate1;
        if (until - t <= 1e-15 * fabs(until)) break;
    }
    return INFINITY;
}
