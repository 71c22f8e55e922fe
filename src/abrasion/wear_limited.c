/* Wear under a crushing limit (limit.h). */
#define FW_WEAR_IS_LIMITED 1
#include "abrasion/wear_inside.h"

/* The usual interval, where it is open or capped from end to end; else false, and nothing done. */
static bool collect_smooth(fw_wear *w, const fw_wear_interval *iv, const fw_rule_smooth *at, double turn)
{
    static const double OUT = 0.29099444873580566; /* from the outer node to the end, over the way from the middle one */
    double              chord[4], p[4], over[3];
    fw_lens_chords(at->depth, iv->radius, w->structure_radius, chord);
    for (size_t q = 0; q < 4; q++) p[q] = at->normal[q] / (chord[q] * iv->thickness);
    for (size_t q = 0; q < 3; q++) {
        double area = chord[q] * iv->thickness, most = fw_limit_force(&w->quadrature.limit, area);
        over[q] = at->normal[q] - most;
        if (over[q] > 0) p[q] = most / area;
    }
    p[3] = p[1];
    double start = over[0] + OUT * (over[0] - over[1]), end = over[2] + OUT * (over[2] - over[1]);
    bool   is_capped = over[1] > 0;
    if ((over[0] > 0) != is_capped || (over[2] > 0) != is_capped || (start > 0) != is_capped || (end > 0) != is_capped) return false;
    lay_smooth(w, iv, at, chord, p, turn);
    return true;
}

void fw_wear_collect_limited(fw_wear *w, const fw_wear_interval *iv)
{
    fw_rule_smooth smooth;
    fw_rule_nodes  at;
    double         turn = iv->angle[1] - iv->angle[0];
    if (fabs(turn) > 0.5 * TWO_PI) turn -= TWO_PI * round(turn / TWO_PI);
    if (iv->is_crushed) {
        fw_rule_apply(&w->quadrature, w->rule, iv, &at);
        if (at.n > 0) collect_nodes(w, iv, &at, turn);
        return;
    }
    if (fw_rule_is_smooth(&w->quadrature, w->rule, iv, &smooth) && collect_smooth(w, iv, &smooth, turn)) return;
    fw_rule_apply_limited(&w->quadrature, w->rule, iv, &at);
    if (at.n > 0) collect_nodes(w, iv, &at, turn);
}
