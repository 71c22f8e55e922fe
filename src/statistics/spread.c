#include "statistics/spread.h"

#include <math.h>

typedef struct powers {
    double one, two, four;
} powers;

static void add(powers *p, double z)
{
    p->one += z;
    p->two += z * z;
    p->four += z * z * z * z;
}

fw_spread fw_spread_of(const fw_units *u, const double *values, double *scratch)
{
    powers p = {0};
    double units = (double)u->n_units, fitted = (double)u->n_fitted, n = (double)u->n;
    if (u->n_units < 2 || n <= fitted) return (fw_spread){NAN, NAN, NAN};
    if (u->unit) {
        for (size_t r = 0; r < u->n_units; r++) scratch[r] = 0;
        for (size_t i = 0; i < u->n; i++) scratch[u->unit[i]] += u->weight[i] * values[i];
        for (size_t r = 0; r < u->n_units; r++) add(&p, scratch[r]);
    } else {
        for (size_t i = 0; i < u->n; i++) add(&p, u->weight[i] * values[i]);
    }
    double squares = p.two - p.one * p.one / units, dof = fmax(1, u->unit ? units - 1 : n - fitted);
    if (!(squares > 0)) return (fw_spread){0, dof, 0};
    return (fw_spread){squares * (u->unit ? units / (units - 1) : 1), dof, fmax(0, p.four / (p.two * p.two) - 1 / units)};
}
