#include "statistics/mean.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

double fw_mean(size_t n, const double *values)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += values[i];
    return n ? sum / (double)n : NAN;
}

/* Below this the cube root of Hall's inverse goes on as its tangent. */
static const double FLOOR = 0.3;

/* Inverse of Hall's g(x) = x + A x^2 + A^2 x^3 / 3 + A/(2n), A = skewness/3, at t/sqrt(n): ((1 + 3A(t' - A/(2n)))^(1/3) - 1)/A. */
static double hall_inverse(double t, double skewness, double n)
{
    double A = skewness / 3, y = t / sqrt(n) - A / (2 * n), cube = 1 + 3 * A * y, root = cbrt(fmax(cube, FLOOR));
    if (fabs(A) < 1e-6) return y;
    return (root + fmin(0, cube - FLOOR) / (3 * root * root) - 1) / A;
}

typedef struct moments {
    double n, mean, sd, skewness, vov;
} moments;

static void add_powers(double d, double times, double *sum)
{
    sum[0] += times * d * d, sum[1] += times * d * d * d, sum[2] += times * d * d * d * d;
}

/* Of the values and n_same more. */
static moments take_moments(size_t n, const double *values, size_t n_same, double same)
{
    moments m = {.n = (double)(n + n_same)};
    double  sum = (double)n_same * same, power[3] = {0};
    for (size_t i = 0; i < n; i++) sum += values[i];
    m.mean = sum / m.n;
    for (size_t i = 0; i < n; i++) add_powers(values[i] - m.mean, 1, power);
    add_powers(same - m.mean, (double)n_same, power);
    m.sd = sqrt(power[0] / (m.n - 1));
    m.skewness = m.sd > 0 ? power[1] / m.n / (m.sd * m.sd * m.sd) : 0;
    m.vov = m.sd > 0 ? power[2] / (power[0] * power[0]) - 1 / m.n : 0;
    return m;
}

fw_interval fw_mean_interval_about(double about, size_t n, const double *values, size_t n_same, double same, double confidence)
{
    moments m = take_moments(n, values, n_same, same);
    double  dof = m.vov > 0 ? fmax(1, fmin(m.n - 1, 2 / m.vov)) : m.n - 1, t = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, dof);
    if (n_same) about = m.mean;
    return (fw_interval){about - m.sd * hall_inverse(t, m.skewness, m.n), about - m.sd * hall_inverse(-t, m.skewness, m.n), confidence};
}

fw_interval fw_mean_interval_of(double about, size_t n, const double *values, size_t n_failed, double none, size_t least, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    if (n + n_failed < least || n == 0 || !(confidence > 0 && confidence < 1)) return out;
    out = fw_mean_interval_about(about, n, values, n_failed, none, confidence);
    if (n_failed) out.high = NAN;
    return out;
}

fw_interval fw_mean_interval(size_t n, const double *values, size_t n_failed, size_t least, double confidence)
{
    return fw_mean_interval_of(fw_mean(n, values), n, values, n_failed, 0, least, confidence);
}
