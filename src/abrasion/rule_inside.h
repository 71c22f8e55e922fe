/* Inside abrasion: pieces of an interval, as rule.c makes them and limit.c cuts them. */
#ifndef FW_ABRASION_RULE_INSIDE_H
#define FW_ABRASION_RULE_INSIDE_H

#include "abrasion/rule.h"

/* Force, slip and overlap of one interval as polynomials in u, its share of the length. */
typedef struct fw_course {
    size_t n, n_depth; /* coefficients of normal and slip, and of depth */
    double normal[FW_WEAR_STAGES], slip[FW_WEAR_STAGES], depth[FW_WEAR_STAGES];
} fw_course;

static inline double fw_course_value(size_t n, const double *c, double u)
{
    double sum = c[n - 1];
    for (size_t k = n - 1; k-- > 0;) sum = sum * u + c[k];
    return sum;
}

/* Force right after a touch above this share of the end's: a touch, however much it grows. */
#define FW_RULE_GROWN 0.05

/* Nodes of one piece [a, b] without a change of slip's sign; na, nb: force at its ends. */
void fw_rule_add(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double na, double b, double nb,
                 fw_rule_nodes *to);
/* The same under a constant pressure or one that goes with the patch's area, whatever the force: weights, depth and slip;
 * normal is the caller's. */
void fw_rule_add_capped(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double b, fw_rule_nodes *to);

/* fw_rule_add under the rule's limit. */
void fw_limit_add(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double na, double b, double nb,
                  fw_rule_nodes *to);

#endif
