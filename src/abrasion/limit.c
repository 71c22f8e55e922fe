#include "abrasion/limit.h"

#include <math.h>

#include "abrasion/rule_inside.h"
#include "geometry/lens.h"

/* Places of a piece that are looked at for crossings, crossings that part it, and cuts of what is steep. */
enum { N_LOOKS = 4, MAX_CROSSINGS = 2, SPARE = 14 };
/* Crossings part a piece in three, a touch that fades has two parts, slip turns once. */
_Static_assert(FW_RULE_NODES >= 2 * (3 * (FW_RULE_TOUCH + FW_RULE_FADE) + SPARE * FW_RULE_TOUCH), "room for all nodes");

/* From the crossing on a law with m above 2.2 falls so steeply that four nodes get weights below zero on the wall, and the ring loads below
 * zero, when a piece's end is more than this many times its start after the touch. Scanned in steps of 0.2: m and the largest ratio with
 * positive weights are 2.4: 1e6, 2.6: 1259, 2.8: 309, 3: 145, 3.2: 87, 3.4: 60, 3.6: 46, 3.8: 34, 4: 26. SPARE cuts reach over 1e20 at m = 4,
 * 1e31 at 3: limits of 100 MPa. */
static double steepest(size_t n, const double *m)
{
    double most = 0;
    for (size_t l = 0; l < n; l++) most = fmax(most, m[l]);
    return most > 3.5 ? 25 : most > 3 ? 50 : most > 2.5 ? 140 : most > 2.2 ? 1000 : INFINITY;
}

/* The rate is continuous at the crossing, so that an error of the place counts with its square. In the root of the time: */
static const double PLACE = 1e-6;

void fw_rule_limit(fw_rule *r, const fw_pressure_law *law, double structure_radius)
{
    r->is_steep = false;
    for (size_t l = 0; l < r->n_laws; l++) r->is_steep |= r->exponent[l] >= 2;
    r->steepest = steepest(r->n_laws, r->exponent);
    r->limit.law = *law, r->limit.structure_radius = structure_radius;
    fw_power_init(&r->limit.power, 1 - law->exponent);
}

/* Weights at the touch nodes for int t^(e-1) f dt from start t_end to t_end, f smooth, at nodes freed of (t / t_end)^(e-1), for any e
 * (e > 0 where start is 0); power = start^e. In x = t / t_end: moments K_j = int x^(e-1+j) dx, those of z = (x - start) / (1 - start)
 * from them; touch_weights of rule.c goes by parts, which is shorter and divides by zero at e = 0, -1. */
static void weigh(const fw_rule *r, double e, double power, double start, double t_end, double *weight)
{
    double K[FW_RULE_TOUCH], rest = 1 - start;
    for (int j = 0; j < FW_RULE_TOUCH; j++, power *= start) {
        double a = e + j;
        K[j] = fabs(a) < 0.01 ? (a != 0 ? -expm1(a * log(start)) / a : -log(start)) : (1 - power) / a;
    }
    double J1 = (K[1] - start * K[0]) / rest, J2 = (K[2] - start * (2 * K[1] - start * K[0])) / (rest * rest);
    double J3 = (K[3] - start * (3 * K[2] - start * (3 * K[1] - start * K[0]))) / (rest * rest * rest);
    for (size_t i = 0; i < FW_RULE_TOUCH; i++)
        weight[i] = t_end * (r->touch[0][i] * K[0] + r->touch[1][i] * J1 + (r->touch[2][i] * J2 + r->touch[3][i] * J3));
}

/* Law l's rate grows like t^(e-1) along the contact in the touch nodes from n on, from a share a of the interval on. */
static void weigh_law(const fw_rule *r, const fw_wear_interval *iv, double a, size_t l, double e, size_t n, fw_rule_nodes *to)
{
    double t_end = iv->since_touch + to->to[n + FW_RULE_TOUCH - 1] * iv->length, start = (iv->since_touch + a * iv->length) / t_end;
    if (e <= 0) start = fmax(start, 1e-60); /* a limit passed sooner is none, and the law has no integral */
    double power = start > 0 ? pow(start, e) : 0;
    weigh(r, e, power, start, t_end, to->along[l] + n);
    weigh(r, e + 0.5, power * sqrt(start), start, t_end, to->wall[l] + n);
}

static bool is_touch(const fw_rule_nodes *to, size_t n) { return to->n > n && to->lift[n] < 1; }

/* Looks along a piece in s, the root of the time since touch: there b ~ s, and N - P0 A^(1 - q) is smooth from the touch on. */
typedef struct look {
    const fw_rule          *r;
    const fw_wear_interval *iv;
    const fw_course        *c;
    double                  a, b;
} look;

static double share_at(const look *k, double s)
{
    double u = (s * s - k->iv->since_touch) / k->iv->length;
    return u < k->a ? k->a : u > k->b ? k->b : u;
}

static double excess(const look *k, double u, double chord)
{
    return fw_course_value(k->c->n, k->c->normal, u) - fw_limit_force(&k->r->limit, chord * k->iv->thickness);
}

static double excess_at(const look *k, double s)
{
    double u = share_at(k, s), depth = fw_course_value(k->c->n_depth, k->c->depth, u);
    return excess(k, u, fw_lens_chord(depth, k->iv->radius, k->r->limit.structure_radius));
}

/* Where the excess passes zero between p and s: false position, Illinois variant. */
static double crossing(const look *k, double p, double fp, double s, double fs)
{
    for (int i = 0; i < 60 && fabs(s - p) > PLACE * s && fs != 0; i++) {
        double x = s - fs * (s - p) / (fs - fp), fx = excess_at(k, x);
        bool   is_there = fabs(x - s) < PLACE * x;
        if ((fx > 0) == (fs > 0))
            fp *= 0.5;
        else
            p = s, fp = fs;
        s = x, fs = fx;
        if (is_there) break;
    }
    return share_at(k, s);
}

/* The force that wears, and where a node's part begins and ends in what fw_wear's share above a pressure looks at: sigma = p / lift^q. */
static void add_capped(const look *k, double a, double b, fw_rule_nodes *to)
{
    const fw_wear_limit *l = &k->r->limit;
    double               q = l->law.exponent, chord[FW_RULE_TOUCH];
    size_t               n = to->n;
    fw_rule_add_capped(k->r, k->iv, k->c, a, b, to);
    to->depth[to->n] = 0; /* of three nodes' fourth */
    fw_lens_chords(to->depth + n, k->iv->radius, l->structure_radius, chord);
    for (size_t j = 0; is_touch(to, n) && j < k->r->n_laws; j++) weigh_law(k->r, k->iv, a, j, 1 - 0.5 * q * k->r->exponent[j], n, to);
    for (size_t i = n; i < to->n; i++) {
        to->normal[i] = fw_limit_force(l, chord[i - n] / to->lift[i] * k->iv->thickness);
        to->lift2_from[i] = q == 0 ? 1 : pow(to->lift2_from[i], q), to->lift2_to[i] = q == 0 ? 1 : pow(to->lift2_to[i], q);
    }
}

/* fw_rule_add; weighed anew are laws with m >= 2, and all when the crossing is so soon after the touch that a difference from the
 * piece's end has no digits of it. */
static void add_weighed(const look *k, double a, double na, double b, double nb, fw_rule_nodes *to)
{
    size_t n = to->n;
    fw_rule_add(k->r, k->iv, k->c, a, na, b, nb, to);
    if (!is_touch(to, n)) return;
    bool is_soon = to->lift2_from[n] < 1e-4;
    for (size_t j = 0; j < k->r->n_laws && (is_soon || k->r->is_steep); j++)
        if (is_soon || k->r->exponent[j] >= 2) weigh_law(k->r, k->iv, a, j, 1 - 0.5 * k->r->exponent[j], n, to);
}

static void add_open(const look *k, double a, double b, size_t *spare, fw_rule_nodes *to)
{
    const fw_wear_interval *iv = k->iv;
    double na = fw_course_value(k->c->n, k->c->normal, a), nb = fw_course_value(k->c->n, k->c->normal, b);
    double t = iv->since_touch + a * iv->length, end = iv->since_touch + b * iv->length;
    double most = k->r->steepest;
    for (; t > 0 && end > most * t && na > FW_RULE_GROWN * nb && *spare > 0; --*spare) {
        double next = end > most * most * t ? most * t : sqrt(t * end), cut = (next - iv->since_touch) / iv->length;
        double n = fw_course_value(k->c->n, k->c->normal, cut);
        add_weighed(k, a, na, cut, n, to);
        a = cut, na = n, t = next;
    }
    add_weighed(k, a, na, b, nb, to);
}

static void add_part(const look *k, bool is_capped, double a, double b, size_t *spare, fw_rule_nodes *to)
{
    if (!(b > a)) return;
    if (is_capped)
        add_capped(k, a, b, to);
    else
        add_open(k, a, b, spare, to);
}

void fw_limit_add(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double na, double b, double nb,
                  fw_rule_nodes *to)
{
    if (!(b > a)) return;
    const look k = {r, iv, c, a, b};
    double     s = sqrt(iv->since_touch + a * iv->length), pace = (sqrt(iv->since_touch + b * iv->length) - s) / N_LOOKS;
    double     u[N_LOOKS], depth[N_LOOKS], chord[N_LOOKS], edge = a, before = excess_at(&k, s);
    size_t     n_crossings = 0, spare = SPARE;
    for (int i = 0; i < N_LOOKS; i++) {
        u[i] = i + 1 < N_LOOKS ? share_at(&k, s + (i + 1) * pace) : b;
        depth[i] = fw_course_value(c->n_depth, c->depth, u[i]);
    }
    fw_lens_chords(depth, iv->radius, r->limit.structure_radius, chord);
    if (!(na > 0)) before = fmin(before, 0); /* found as a zero of the force: to rounding */
    bool is_capped = before > 0;
    for (int i = 0; i < N_LOOKS && n_crossings < MAX_CROSSINGS; i++, s += pace) {
        double now = excess(&k, u[i], chord[i]);
        if (u[i] == b && !(nb > 0)) now = fmin(now, 0);
        if ((now > 0) != is_capped) {
            double cut = crossing(&k, s, before, s + pace, now);
            add_part(&k, is_capped, edge, cut, &spare, to);
            edge = cut, is_capped = !is_capped, n_crossings++;
        }
        before = now;
    }
    add_part(&k, is_capped, edge, b, &spare, to);
}
