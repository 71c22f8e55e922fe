#include "statistics/mean.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

double fw_mean(size_t n, const double *values)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += values[i];
    return n ? sum / (double)n : NAN;
}

/* Inverse of Hall's g(x) = x + A x^2 + A^2 x^3 / 3 + A/(2n), A = skewness/3, at t/sqrt(n): ((1 + 3A(t' -
 * A/(2n)))^(1/3) - 1)/A. */
static double hall_inverse(double t, double skewness, double n)
{
    double A = skewness / 3, y = t / sqrt(n) - A / (2 * n);
    if (fabs(A) < 1e-6) return y;
    return (cbrt(1 + 3 * A * y) - 1) / A;
}

typedef struct moments {
    double n, mean, sd, skewness, vov;
} moments;

/* Of the values and n_zeros zeros. */
static moments take_moments(size_t n, const double *values, size_t n_zeros)
{
    moments m = {.n = (double)(n + n_zeros)};
    double  sum = 0, square = 0, cube = 0, fourth = 0;
    for (size_t i = 0; i < n; i++) sum += values[i];
    m.mean = sum / m.n;
    for (size_t i = 0; i < n; i++) {
        double d = values[i] - m.mean;
        square += d * d;
        cube += d * d * d;
        fourth += d * d * d * d;
    }
    double z = (double)n_zeros;
    square += z * m.mean * m.mean;
    cube -= z * m.mean * m.mean * m.mean;
    fourth += z * m.mean * m.mean * m.mean * m.mean;
    m.sd = sqrt(square / (m.n - 1));
    m.skewness = m.sd > 0 ? cube / m.n / (m.sd * m.sd * m.sd) : 0;
    m.vov = square > 0 ? fourth / (square * square) - 1 / m.n : 0;
    return m;
}

fw_interval fw_mean_interval(size_t n, const double *values, size_t n_failed, size_t least, double confidence)
{
    fw_interval out = {NAN, NAN, NAN};
    if (n + n_failed < least || n == 0 || !(confidence > 0 && confidence < 1)) return out;
    moments m = take_moments(n, values, n_failed);
    double  dof = m.vov > 0 ? fmax(1, fmin(m.n - 1, 2 / m.vov)) : m.n - 1, t = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, dof);
    out.low = m.mean - m.sd * hall_inverse(t, m.skewness, m.n);
    if (n_failed == 0) out.high = m.mean - m.sd * hall_inverse(-t, m.skewness, m.n);
    out.coverage = confidence;
    return out;
}
