#include "abrasion/rule.h"

#include <math.h>
#include <string.h>

#include "abrasion/rule_inside.h"
#include "geometry/lens.h"

/* Gauss-Legendre on (0, 1). */
static const double NODE3[] = FW_RULE_NODES3, WEIGHT3[] = FW_RULE_WEIGHTS3;
static const double NODE5[] = {0.046910077030668004, 0.23076534494715846, 0.5, 0.76923465505284154,
                               0.95308992296933200};
static const double WEIGHT5[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                 0.11846344252809454};
static const double NODE4[] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
static const double WEIGHT4[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};

/* An interval that begins sooner after the touch than this many of its own lengths takes each law's own weights; past it
 * three Gauss nodes leave 2e-6 of t^(-1/2 m). */
static const double EARLY = 2;
/* Force at one end below this share of the other: nodes drawn to that end. */
static const double FADED = 0.25;

/* Lagrange polynomials of n nodes: out[k][i] is the coefficient of u^k in the polynomial that is 1 at node i. */
static void lagrange(size_t n, const double *at, size_t row, double *out)
{
    for (size_t i = 0; i < n; i++) {
        double c[FW_WEAR_STAGES] = {1}, scale = 1;
        size_t degree = 0;
        for (size_t j = 0; j < n; j++) {
            if (j == i) continue;
            scale *= at[i] - at[j];
            degree++;
            for (size_t k = degree; k > 0; k--) c[k] = c[k - 1] - at[j] * c[k];
            c[0] *= -at[j];
        }
        for (size_t k = 0; k < n; k++) out[k * row + i] = c[k] / scale;
    }
}

void fw_rule_init(fw_rule *r, size_t n_laws, const double *exponent)
{
    memset(r, 0, sizeof *r);
    r->n_laws = n_laws;
    for (size_t l = 0; l < n_laws; l++) {
        double e = 1 - 0.5 * exponent[l];
        r->exponent[l] = exponent[l];
        fw_power_init(&r->start[l], e);
        for (size_t k = 0; k < FW_RULE_TOUCH; k++)
            r->along[l][k] = 1 / ((double)k + e), r->wall[l][k] = 1 / ((double)k + e + 0.5);
    }
    for (size_t k = 0; k < FW_RULE_TOUCH; k++) r->wide[k] = 1 / ((double)k + 1.5);
    lagrange(FW_RULE_TOUCH, NODE4, FW_RULE_TOUCH, &r->touch[0][0]);
}

static bool are_of(const struct fw_rule_stages *s, const fw_wear_interval *iv)
{
    bool is_same = s->n == iv->n_stages;
    for (size_t i = 0; i < iv->n_stages && is_same; i++) is_same = iv->at[i] == s->at[i];
    return is_same;
}

static const struct fw_rule_stages *know_stages(fw_rule *r, const fw_wear_interval *iv)
{
    if (are_of(&r->known[r->last], iv)) return &r->known[r->last];
    r->last = 1 - r->last;
    struct fw_rule_stages *s = &r->known[r->last];
    if (are_of(s, iv)) return s;
    size_t n = s->n = iv->n_stages;
    for (size_t i = 0; i < n; i++) s->at[i] = iv->at[i];
    lagrange(n, iv->at, FW_WEAR_STAGES, &s->to_power[0][0]);
    for (size_t i = 0; i < n; i++)
        for (size_t q = 0; q < 4; q++) {
            double u = NODE3[q < 3 ? q : 1], sum = 0;
            for (size_t k = n; k-- > 0;) sum = sum * u + s->to_power[k][i];
            s->to_node[i][q] = sum, sum = 0;
            for (size_t k = n; k-- > 0;) sum = sum * NODE4[q] + s->to_power[k][i];
            s->to_touch[i][q] = sum;
        }
    return s;
}

static void through_stages(fw_rule *r, const fw_wear_interval *iv, fw_course *c)
{
    size_t                       n = iv->n_stages;
    bool                         is_release = n == 2; /* the method's stages stay known */
    const struct fw_rule_stages *s = is_release && !iv->has_overlap ? NULL : know_stages(r, iv);
    c->n = n;
    if (is_release) {
        c->normal[0] = iv->normal[0], c->normal[1] = iv->normal[1] - iv->normal[0];
        c->slip[0] = iv->slip[0], c->slip[1] = iv->slip[1] - iv->slip[0];
    } else {
        for (size_t k = 0; k < n; k++) {
            double normal = 0, slip = 0;
            for (size_t i = 0; i < n; i++) {
                normal += s->to_power[k][i] * iv->normal[i];
                slip += s->to_power[k][i] * iv->slip[i];
            }
            c->normal[k] = normal, c->slip[k] = slip;
        }
    }
    c->n_depth = iv->has_overlap ? n : 4;
    if (iv->has_overlap) {
        for (size_t k = 0; k < n; k++) {
            c->depth[k] = 0;
            for (size_t i = 0; i < n; i++) c->depth[k] += s->to_power[k][i] * iv->overlap[i];
        }
        return;
    }
    double rise = iv->depth[1] - iv->depth[0], s0 = iv->length * iv->rate[0], s1 = iv->length * iv->rate[1];
    c->depth[0] = iv->depth[0], c->depth[1] = s0;
    c->depth[2] = 3 * rise - 2 * s0 - s1, c->depth[3] = s0 + s1 - 2 * rise;
}

static void through_ends(const fw_wear_interval *iv, fw_course *c)
{
    size_t last = iv->n_stages - 1;
    *c = (fw_course){.n = 2,
                     .n_depth = 2,
                     .normal = {iv->normal[0], iv->normal[last] - iv->normal[0]},
                     .slip = {iv->slip[0], iv->slip[last] - iv->slip[0]},
                     .depth = {iv->depth[0], iv->depth[1] - iv->depth[0]}};
}

/* Zero of a polynomial between a and b, where it has the signs of fa and fb: false position, Illinois variant. */
static double zero(size_t n, const double *c, double a, double fa, double b, double fb)
{
    for (int i = 0; i < 60 && fabs(b - a) > 1e-14 && fb != 0; i++) {
        double x = b - fb * (b - a) / (fb - fa), fx = fw_course_value(n, c, x);
        if ((fx > 0) == (fb > 0))
            fa *= 0.5;
        else
            a = b, fa = fb;
        b = x, fb = fx;
    }
    return b;
}

enum kind { SMOOTH, TOUCH, FADES, GROWS };

/* Weights at the touch nodes for int t^(e-1) f dt from start t_end to t_end, f smooth, at nodes freed of (t / t_end)^(e-1).
 * In x = t / t_end and z = (x - start) / (1 - start) the moments J_k = int x^(e-1) z^k dx follow by parts from J_0, given;
 * step = start / (1 - start), inverse[k] = 1 / (k + e). */
static void touch_weights(const fw_rule *r, const double *inverse, double J0, double step, double t_end, double *weight)
{
    double J1 = (1 - step * J0) * inverse[1], J2 = (1 - 2 * step * J1) * inverse[2];
    double J3 = (1 - 3 * step * J2) * inverse[3];
    for (size_t i = 0; i < FW_RULE_TOUCH; i++)
        weight[i] = t_end * (r->touch[0][i] * J0 + r->touch[1][i] * J1 + (r->touch[2][i] * J2 + r->touch[3][i] * J3));
}

/* Lift and weights of the touch nodes from to->n on, for times from start t_end to t_end after the touch. */
static void weigh_touch(const fw_rule *r, double start, double t_end, fw_rule_nodes *to)
{
    size_t n = to->n;
    double rest = 1 - start, step = start / rest, root = sqrt(start), part = start;
    for (size_t i = 0; i < FW_RULE_TOUCH; i++) {
        to->lift[n + i] = sqrt(start + rest * NODE4[i]);
        to->lift2_from[n + i] = part, to->lift2_to[n + i] = part += rest * WEIGHT4[i];
    }
    touch_weights(r, r->wide, (1 - start * root) * r->wide[0], step, t_end, to->wide + n);
    for (size_t l = 0; l < r->n_laws; l++) {
        double e = r->start[l].m, power = start > 0 ? fw_power_of(&r->start[l], start) : e > 0 ? 0 : INFINITY;
        double J0 = (1 - power) * r->along[l][0];
        if (fabs(e) < 0.01) J0 = e != 0 ? -expm1(e * log(start)) / e : -log(start); /* no digits left in the difference */
        touch_weights(r, r->along[l], J0, step, t_end, to->along[l] + n);
        touch_weights(r, r->wall[l], (1 - power * root) * r->wall[l][0], step, t_end, to->wall[l] + n);
    }
}

/* Nodes of one piece [a, b]. GROWS and FADES put u at a distance (1 - v)^2 from the end where the force is nil: a rate
 * like distance^m becomes (1 - v)^(2m + 1). */
static void add_piece(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, enum kind kind, double a, double b,
                      fw_rule_nodes *to)
{
    size_t        n = kind == SMOOTH ? 3 : kind == TOUCH ? FW_RULE_TOUCH : FW_RULE_FADE;
    const double *node = n == 3 ? NODE3 : n == FW_RULE_TOUCH ? NODE4 : NODE5;
    const double *weight = n == 3 ? WEIGHT3 : n == FW_RULE_TOUCH ? WEIGHT4 : WEIGHT5;
    double        done = 0, edge = a, width = b - a;
    for (size_t i = 0; i < n; i++) {
        size_t q = to->n + i;
        double u = a + width * node[i], dt = width * weight[i] * iv->length, next = done + weight[i];
        double end = a + width * next;
        if (kind == FADES) {
            double v = 1 - node[i], w = 1 - next;
            u = b - width * v * v, end = b - width * w * w, dt *= 2 * v;
        } else if (kind == GROWS) {
            u = a + width * node[i] * node[i], end = a + width * next * next, dt *= 2 * node[i];
        }
        to->u[q] = u, to->dt[q] = dt, to->lift[q] = to->lift2_from[q] = to->lift2_to[q] = 1;
        to->from[q] = edge, to->to[q] = edge = i + 1 < n ? end : b;
        done = next;
        to->wide[q] = dt;
        for (size_t l = 0; l < r->n_laws; l++) to->along[l][q] = to->wall[l][q] = dt;
        to->normal[q] = fw_course_value(c->n, c->normal, u), to->slip[q] = fw_course_value(c->n, c->slip, u);
        to->depth[q] = fw_course_value(c->n_depth, c->depth, u);
    }
    if (kind == TOUCH) {
        double t_end = iv->since_touch + b * iv->length;
        weigh_touch(r, fmax(0, 1 - width * iv->length / t_end), t_end, to);
    }
    to->n += n;
}

static bool is_early(const fw_wear_interval *iv, double a, double b)
{
    return iv->since_touch + a * iv->length < EARLY * (b - a) * iv->length;
}

void fw_rule_add(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double na, double b, double nb,
                 fw_rule_nodes *to)
{
    if (!(b > a)) return;
    bool      is_touch = is_early(iv, a, b);
    enum kind kind = nb < FADED * na ? FADES : na < FADED * nb ? GROWS : SMOOTH;
    if (iv->is_crushed) { /* no t^(-1/2) at its touch, but a chord like t^(1/2) where ice crushes: nodes drawn to it */
        add_piece(r, iv, c, iv->is_push && is_touch ? GROWS : kind, a, b, to);
        return;
    }
    /* with next to no damping the force of a touch grows from little: still a touch, unless it begins at nil */
    if (is_touch && kind == GROWS && na > FW_RULE_GROWN * nb) kind = SMOOTH;
    if (is_touch && kind == FADES) {
        double middle = 0.5 * (a + b);
        add_piece(r, iv, c, TOUCH, a, middle, to);
        add_piece(r, iv, c, FADES, middle, b, to);
    } else {
        add_piece(r, iv, c, is_touch && kind == SMOOTH ? TOUCH : kind, a, b, to);
    }
}

void fw_rule_add_capped(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c, double a, double b, fw_rule_nodes *to)
{
    add_piece(r, iv, c, is_early(iv, a, b) ? TOUCH : SMOOTH, a, b, to);
}

/* Cubic Hermite weights of both ends' values and slopes at the smooth nodes, and at the touch nodes. */
#define EACH(f)                                                                                                        \
    {                                                                                                                  \
        f(0.11270166537925831), f(0.5), f(0.88729833462074169), f(0.5)                                                 \
    }
#define EACH_T(f)                                                                                                      \
    {                                                                                                                  \
        f(0.069431844202973712), f(0.33000947820757187), f(0.66999052179242813), f(0.93056815579702629)                \
    }
#define VALUE(u)     ((1 + 2 * (u)) * (1 - (u)) * (1 - (u)))
#define SLOPE(u)     ((u) * (1 - (u)) * (1 - (u)))
#define END_VALUE(u) ((3 - 2 * (u)) * (u) * (u))
#define END_SLOPE(u) (-(1 - (u)) * (u) * (u))
static const double D0[4] = EACH(VALUE), S0[4] = EACH(SLOPE), D1[4] = EACH(END_VALUE), S1[4] = EACH(END_SLOPE);

static const double D0_T[4] = EACH_T(VALUE), S0_T[4] = EACH_T(SLOPE), D1_T[4] = EACH_T(END_VALUE), S1_T[4] = EACH_T(END_SLOPE);

/* An interval that is a touch from end to end: half of all. What add_piece would do, its nodes known beforehand. */
static bool is_touch(fw_rule *r, const fw_wear_interval *restrict iv, fw_rule_nodes *restrict to)
{
    static const double END[] = {0, 0.17392742256872693, 0.5, 0.82607257743127307, 1};
    size_t              last = iv->n_stages - 1;
    double              na = iv->normal[0], nb = iv->normal[last], length = iv->length;
    if (last < 2 || iv->is_crushed || iv->since_touch >= EARLY * length || !(na > 0) || !(nb > 0)) return false;
    if (nb < FADED * na || na <= FW_RULE_GROWN * nb || !(iv->slip[0] * iv->slip[last] > 0)) return false;
    const struct fw_rule_stages *stages = know_stages(r, iv);
    double s0 = length * iv->rate[0], s1 = length * iv->rate[1], normal[4] = {0}, slip[4] = {0};
    for (size_t i = 0; i <= last; i++)
        for (size_t q = 0; q < 4; q++)
            normal[q] += stages->to_touch[i][q] * iv->normal[i], slip[q] += stages->to_touch[i][q] * iv->slip[i];
    for (size_t q = 0; q < 4; q++) {
        to->normal[q] = normal[q], to->slip[q] = slip[q], to->u[q] = NODE4[q], to->dt[q] = WEIGHT4[q] * length;
        to->from[q] = END[q], to->to[q] = END[q + 1];
        to->depth[q] = D0_T[q] * iv->depth[0] + S0_T[q] * s0 + D1_T[q] * iv->depth[1] + S1_T[q] * s1;
    }
    double t_end = iv->since_touch + length;
    weigh_touch(r, iv->since_touch / t_end, t_end, to);
    to->n = 4;
    return true;
}

bool fw_rule_is_smooth(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *restrict iv, fw_rule_smooth *restrict to)
{
    size_t last = iv->n_stages - 1;
    double na = iv->normal[0], nb = iv->normal[last], sa = iv->slip[0], sb = iv->slip[last];
    if (rule == FW_WEAR_NAIVE || iv->since_touch < EARLY * iv->length || !(na > 0) || !(nb > 0)) return false;
    if (nb < FADED * na || na < FADED * nb || !(sa * sb > 0)) return false;
    if (rule == FW_WEAR_SINGULAR) {
        for (size_t q = 0; q < 4; q++) {
            double u = NODE3[q < 3 ? q : 1];
            to->normal[q] = na + u * (nb - na), to->slip[q] = sa + u * (sb - sa);
            to->depth[q] = iv->depth[0] + u * (iv->depth[1] - iv->depth[0]);
        }
        return iv->depth[0] > 0 && iv->depth[1] > 0;
    }
    const struct fw_rule_stages *stages = know_stages(r, iv);
    double s0 = iv->length * iv->rate[0], s1 = iv->length * iv->rate[1];
    for (size_t q = 0; q < 4; q++) {
        to->normal[q] = to->slip[q] = 0;
        to->depth[q] = D0[q] * iv->depth[0] + S0[q] * s0 + D1[q] * iv->depth[1] + S1[q] * s1;
    }
    for (size_t i = 0; i <= last; i++) {
        double normal = iv->normal[i], slip = iv->slip[i];
        for (size_t q = 0; q < 4; q++)
            to->normal[q] += stages->to_node[i][q] * normal, to->slip[q] += stages->to_node[i][q] * slip;
    }
    bool is_loaded = true;
    for (size_t q = 0; q < 3; q++) is_loaded &= to->normal[q] > 0 && to->depth[q] > 0;
    return is_loaded;
}

static void at_end(const fw_rule *r, const fw_wear_interval *iv, fw_rule_nodes *to)
{
    size_t last = iv->n_stages - 1;
    to->n = 1, to->u[0] = to->from[0] = to->to[0] = 1, to->lift[0] = to->lift2_from[0] = to->lift2_to[0] = 1;
    to->dt[0] = to->wide[0] = iv->length;
    to->normal[0] = iv->normal[last], to->slip[0] = iv->slip[last], to->depth[0] = iv->depth[1];
    for (size_t l = 0; l < r->n_laws; l++) to->along[l][0] = to->wall[l][0] = iv->length;
}

static bool slides(const fw_wear_interval *iv)
{
    bool is_moving = false;
    for (size_t i = 0; i < iv->n_stages; i++) is_moving |= iv->slip[i] != 0;
    return is_moving;
}

/* An interval's pieces, each with a force and without a change of slip's sign. */
static inline __attribute__((always_inline)) void
add_pieces(const fw_rule *r, const fw_wear_interval *iv, const fw_course *c,
           void (*add)(const fw_rule *, const fw_wear_interval *, const fw_course *, double, double, double, double, fw_rule_nodes *),
           fw_rule_nodes *to)
{
    size_t last = iv->n_stages - 1;
    /* The part [a, b] with a force. The signed law k d + c d' is smooth where the clamp at zero has a kink, so its zero is
     * found on the interpolant: a floe that leaves slides fast on its last millimetres and a step that counts whole nodes
     * there would be off by some per cent in path. */
    double a = 0, b = 1, na = iv->normal[0], nb = iv->normal[last];
    if (!(na > 0) && !(nb > 0)) return;
    if (!(nb > 0)) b = zero(c->n, c->normal, 0, na, 1, nb), nb = 0;
    if (!(na > 0)) a = zero(c->n, c->normal, 1, nb, 0, na), na = 0;
    /* |slip| has a kink where rolling over takes slip through zero */
    double s0 = iv->slip[0], s1 = iv->slip[last];
    if ((s0 > 0 && s1 < 0) || (s0 < 0 && s1 > 0)) {
        double turn = zero(c->n, c->slip, 0, s0, 1, s1);
        if (turn > a && turn < b) {
            double nt = fw_course_value(c->n, c->normal, turn);
            add(r, iv, c, a, na, turn, nt, to);
            a = turn, na = nt;
        }
    }
    add(r, iv, c, a, na, b, nb, to);
}

void fw_rule_apply(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *iv, fw_rule_nodes *to)
{
    fw_course c;
    to->n = 0;
    if (!slides(iv)) return;
    switch (rule) {
    case FW_WEAR_NAIVE: at_end(r, iv, to); return;
    case FW_WEAR_SINGULAR: through_ends(iv, &c); break;
    case FW_WEAR_HERMITE:
        if (is_touch(r, iv, to)) return;
        through_stages(r, iv, &c);
        break;
    }
    add_pieces(r, iv, &c, fw_rule_add, to);
}

/* Overlaps at the stages miss the closing rate at the touch by a few 1e-4, and that is what the first instants under a limit live on: one power
 * more, with the rate. */
static void start_with_rate(const fw_wear_interval *iv, fw_course *c)
{
    double P[FW_WEAR_STAGES + 1] = {1}; /* product of (u - at) */
    size_t n = iv->n_stages;
    for (size_t i = 0; i < n; i++)
        for (size_t k = i + 2; k-- > 0;) P[k] = (k > 0 ? P[k - 1] : 0) - iv->at[i] * P[k];
    double more = (iv->length * iv->rate[0] - c->depth[1]) / P[1];
    c->depth[n] = 0, c->n_depth = n + 1;
    for (size_t k = 1; k <= n; k++) c->depth[k] += more * P[k];
}

void fw_rule_apply_limited(fw_rule *r, fw_wear_rule rule, const fw_wear_interval *iv, fw_rule_nodes *to)
{
    fw_course c;
    to->n = 0;
    if (!slides(iv)) return;
    if (rule == FW_WEAR_NAIVE) {
        at_end(r, iv, to);
        double area = fw_lens_chord(to->depth[0], iv->radius, r->limit.structure_radius) * iv->thickness;
        to->normal[0] = fmin(to->normal[0], fw_limit_force(&r->limit, area));
        return;
    }
    rule == FW_WEAR_SINGULAR ? through_ends(iv, &c) : through_stages(r, iv, &c);
    if (rule == FW_WEAR_HERMITE && iv->has_overlap && iv->since_touch == 0 && iv->n_stages < FW_WEAR_STAGES) start_with_rate(iv, &c);
    add_pieces(r, iv, &c, fw_limit_add, to);
}
