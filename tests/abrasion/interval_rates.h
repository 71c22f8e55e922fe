/* A contact to test wear rules on, and what goes on in one interval of it, written in the textbook forms.
 *
 * The contact is the head-on, critically damped closed form, d = v t exp(-wt), N = m w v exp(-wt) (2 - wt), with a slip put on that
 * dies away as friction makes it. Included once per test program. Units SI. */
#ifndef FW_TESTS_INTERVAL_RATES_H
#define FW_TESTS_INTERVAL_RATES_H

#include "abrasion/rule.h"
#include "check.h"

static const double MASS = 2209, V = 2, R = 1.25, RS = 3.7, H = 0.5;
static const double STAGE[3] = {0, 0.58578643762690495, 1};

static inline double omega(void) { return sqrt(2e6 / MASS); }
static inline double depth_at(double t) { return V * t * exp(-omega() * t); }
static inline double force_at(double t) { return MASS * omega() * V * exp(-omega() * t) * (2 - omega() * t); }
static inline double slip_at(double t) { return 0.3 * exp(-1.5 * omega() * t); }

/* The contact from t0 to t1 after the touch. */
static inline fw_wear_interval interval(double t0, double t1)
{
    fw_wear_interval iv = {.length = t1 - t0, .since_touch = t0, .n_stages = 3, .radius = R, .thickness = H};
    for (int q = 0; q < 2; q++) {
        double t = q ? t1 : t0;
        iv.depth[q] = depth_at(t), iv.rate[q] = V * exp(-omega() * t) * (1 - omega() * t);
    }
    for (int q = 0; q < 3; q++) {
        double t = t0 + STAGE[q] * (t1 - t0);
        iv.at[q] = STAGE[q], iv.normal[q] = force_at(t), iv.slip[q] = slip_at(t);
    }
    return iv;
}

/* Normal force n, slip s and depth d at a share u of the interval, from the interval's own values: Lagrange and Hermite. */
static inline void values_at(const fw_wear_interval *iv, double u, double *n, double *s, double *d)
{
    double a = 1 - u, h = iv->length;
    *n = *s = 0;
    for (int i = 0; i < 3; i++) {
        double p = 1;
        for (int j = 0; j < 3; j++)
            if (j != i) p *= (u - iv->at[j]) / (iv->at[i] - iv->at[j]);
        *n += p * iv->normal[i], *s += p * iv->slip[i];
    }
    *d = a * a * ((1 + 2 * u) * iv->depth[0] + u * h * iv->rate[0]) + u * u * ((1 + 2 * a) * iv->depth[1] - a * h * iv->rate[1]);
}

#endif
