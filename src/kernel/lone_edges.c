/* Where in a step another form begins to hold: roots of the closed forms of lone.c. */
#include "kernel/lone_forms.h"

static const double WATCH = 0.8;   /* how often a force that may dip below zero is looked at [1/w], */
static const double RINGING = 0.2; /* which is one of which this share has to decay yet */

/* How far inside its form the floe is [N]: negative past the edge. i = 0: force or none; 1: friction, or parting. */
static inline double margin(const fw_lone *L, const fw_pair *p, const fw_lone_state *y, int i)
{
    if (!L->presses) return i == 0 ? -y->normal : y->rate < 0 ? p->law.k * y->depth : 1;
    if (i == 0) return y->normal;
    if (!L->rubs) return 1;
    return L->slides != 0 ? L->slides * p->law.ct * y->slip - p->mu * y->normal
                          : p->mu * y->normal - p->law.ct * fabs(y->slip);
}

static double margin_at(const fw_lone *L, const fw_pair *p, double t, int i)
{
    fw_lone_state y;
    state_at(L, &p->law, t, decay_at(L, t), &y);
    return margin(L, p, &y, i);
}

/* When does margin i vanish between a, where it is fa, and b, where it is fb < 0? False position; an end that stays loses weight by how
 * much the other one gained (Anderson and Bjorck 1973). */
static double edge(const fw_lone *L, const fw_pair *p, int i, double a, double fa, double b, double fb)
{
    for (int n = 0; n < 40 && !(fa > 0); n++) { /* the step begins on that edge and leaves it: it comes back later */
        double x = a + 0.25 * (b - a), fx = margin_at(L, p, x, i);
        if (fx > 0)
            a = x, fa = fx;
        else
            b = x, fb = fx;
    }
    if (!(fa > 0)) return b;
    int side = 0;
    for (int n = 0; n < 60 && b - a > 1e-14 * b; n++) {
        double x = b - fb * (b - a) / (fb - fa);
        if (!(x > a && x < b)) x = 0.5 * (a + b);
        double fx = margin_at(L, p, x, i);
        if (fx == 0) return x;
        double gain = fx / (fx > 0 ? fa : fb), left = gain < 1 ? 1 - gain : 0.5;
        if (fx > 0) {
            a = x, fa = fx;
            if (side > 0) fb *= left;
            side = 1;
        } else {
            b = x, fb = fx;
            if (side < 0) fa *= left;
            side = -1;
        }
    }
    return b;
}

bool fw_lone_rings(const fw_lone *L, const fw_pair *p)
{
    if (!L->presses || L->is_short) return false;
    double A = L->from.depth - L->swing[0], B = L->from.rate - L->swing[1] * L->per_span, omega = p->law.omega;
    return 2 * (p->law.k + p->law.c * omega) * (fabs(A) + fabs(B) / omega) > RINGING * L->from.normal;
}

double fw_lone_first_edge(const fw_lone *L, const fw_pair *p, const fw_lone_state *at)
{
    int           n = fw_lone_rings(L, p) ? (int)fw_smaller(20, 2 + L->span * p->law.omega / WATCH) : 2;
    decay         w = {1, 0, 1}, step = {0, 0, 0};
    fw_lone_state y[2] = {at[0]};
    if (n > 2) step = decay_at(L, L->span / n);
    for (int j = 1; j <= n; j++, y[0] = y[1]) {
        double from = L->span * (j - 1) / n, to = L->span * j / n, first = INFINITY;
        if (n > 2)
            w = later(L, w, step), state_at(L, &p->law, to, w, &y[1]);
        else
            y[1] = at[j];
        for (int i = 0; i < 2; i++) {
            double now = margin(L, p, &y[1], i);
            if (now < 0) first = fw_smaller(first, edge(L, p, i, from, margin(L, p, &y[0], i), to, now));
        }
        if (first < INFINITY) return first;
    }
    return INFINITY;
}
