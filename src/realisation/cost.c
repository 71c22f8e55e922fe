#include "realisation/cost.h"

#include <math.h>

#include "field/sizes.h"
#include "realisation/accuracy.h"

/* Fitted to windows of 600 m of the current's way, thickness classes from 0.0855 to 8 m, structures of 7.4 and 40 m, 0.2 and 2 m/s, accuracy
 * 1 %. With D the mean diameter and N = 2 Rs / D the floes that the structure is wide, a metre of way takes
 *
 *   a(C) (1 + N)^3 / D      evaluations
 *
 * 0.5 to 1.5 times this at 10 and 40 % ice, 0.3 to 1.3 times at 60 and 70 % (least for floes as wide as the structure). The jam is about as
 * long as it is wide, so its floes go with N^2, and the pace of the smallest contact with N. At accuracy 0.01 % it is six times as much.
 * All further effects together, wind of 15 m/s: 4 / 2 / 0.9 / 0.5 times this at 10 / 40 / 60 / 70 % ice and 1 m/s. At 0.1 m/s 49 / 18 / 11 / 9 times,
 * nearly all of it the contacts that crush in thin ice, and in dense ice the wind, which brings more than the current: what is expected is little
 * there, and LEAST is far above. */
static const struct point {
    double concentration, a;
} POINTS[] = {{0, 1}, {0.1, 2}, {0.4, 45}, {0.6, 500}, {0.7, 3000}, {0.8, 34000}};
enum { N_POINTS = sizeof POINTS / sizeof POINTS[0] };

static const double WITH_ACCURACY = -0.4; /* power of accuracy / 1 % */
static const double ASTRAY = 100, LEAST = 1e9; /* a minute or so: slow currents and stiff contacts cost more than is expected of them */

static double of_concentration(double c)
{
    size_t k = 1;
    while (k + 1 < N_POINTS && c > POINTS[k].concentration) k++;
    const struct point *p = &POINTS[k - 1], *q = &POINTS[k];
    double              f = (c - p->concentration) / (q->concentration - p->concentration);
    return exp(log(p->a) + f * (log(q->a) - log(p->a)));
}

fw_status fw_cost_expected(const fw_model *m, const fw_scenario *s, double *evaluations, fw_msg *msg)
{
    fw_sizes sizes;
    FW_TRY(fw_sizes_init(&sizes, &m->mixes[s->mix], m->size_law, m->size_a, m->size_b, msg));
    double D = sizes.mean_diameter, n = 1 + 2 * m->structure_radius / D;
    double way = s->speed * (m->window + fw_accuracy_warm_up(m, s->speed));
    *evaluations = of_concentration(s->concentration) * n * n * n / D * way * pow(m->accuracy / 0.01, WITH_ACCURACY);
    return FW_OK;
}

fw_status fw_cost_limit(const fw_model *m, const fw_scenario *s, double *evaluations, fw_msg *msg)
{
    *evaluations = m->max_evaluations;
    if (m->max_evaluations > 0) return FW_OK;
    FW_TRY(fw_cost_expected(m, s, evaluations, msg));
    *evaluations = fmax(LEAST, ASTRAY * *evaluations);
    return FW_OK;
}
