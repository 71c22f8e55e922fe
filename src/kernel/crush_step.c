/* Of a whole step: where its law has a kink, what it leaves in the books and on the ring, and the imprint it writes. */
#include <math.h>

#include "kernel/crush_rim.h"

enum { PROBES = 8, HALVINGS = 40 };

/* At D, or as near to it as rounding knows [of the radius]. */
static const double AT = 1e-12;
static const double ROUNDING = 1e-9;  /* of caps, which are solved for exactly */
static const double QUASI_STATIC = 6; /* step in m / c: 3 in 1/w, as in books.c */
static const double LONG = 100;         /* step in m / c, beyond which an error of velocity is one of force by the mass alone */
/* A kink is met when what is wrong behind it is more than this share of the tolerance of velocity. */
static const double MATTERS = 0.1;

/* The tried step as cubics in its share u: overlap, and the place under the wall. */
typedef struct course {
    const fw_rim *r;
    double        d[4], at[4], from, per_h; /* coefficients; place at u = 0 */
} course;

static void cubic(double *c, double f0, double s0, double f1, double s1)
{
    double rise = f1 - f0;
    c[0] = f0, c[1] = s0, c[2] = 3 * rise - 2 * s0 - s1, c[3] = s0 + s1 - 2 * rise;
}
static double value(const double *c, double u) { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }

static course course_of(const fw_cluster *c, const fw_pair *p, size_t last, double h)
{
    const fw_rim    *r = p->rim;
    const fw_member *a = &c->members[p->a];
    course           o = {.r = r, .from = r->place, .per_h = 1 / h};
    cubic(o.d, p->depth[0], h * p->rate[0], p->depth[last], h * p->rate[last]);
    cubic(o.at, 0, -h * r->turning[0], fw_rim_between(o.from, fw_rim_place(a->y1)), -h * r->turning[last]);
    return o;
}

/* What a kink is a zero of: over D; N on the line, and what it lacks of F(D), as overlaps. */
enum { OVER, PRESSED, FULL, N_KINKS };
static void probe(const course *o, double u, double at[N_KINKS])
{
    const fw_rim *r = o->r;
    double        slope, b, d = value(o->d, u), rate = (o->d[1] + u * (2 * o->d[2] + 3 * u * o->d[3])) * o->per_h;
    double        D = fw_rim_deepest(r, o->from + value(o->at, u), &slope), F = fw_rim_force(r, D, &b);
    at[OVER] = d - D;
    double S = fw_rim_stiffness(r, D, F);
    at[PRESSED] = fw_rim_line(r, d, D, F) / S + 2 * sqrt(r->mass / S) * rate;
    at[FULL] = at[PRESSED] - F / S;
}

/* Where between low and high, on either side of which a kink's zero differs in sign. */
static double bisect(const course *o, double low, double high, int kink)
{
    double at[N_KINKS];
    probe(o, high, at);
    bool is_above = at[kink] > 0;
    for (int n = 0; n < HALVINGS; n++) {
        double middle = 0.5 * (low + high);
        probe(o, middle, at);
        if ((at[kink] > 0) == is_above)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* How far off a kink: between no force and full force of the line the nearer end counts. */
static double largest_of(double was, const double at[N_KINKS], int kink)
{
    return fw_larger(was, fw_smaller(fabs(at[kink]), kink == OVER ? INFINITY : fabs(at[OVER])));
}

/* Force per overlap on the line. */
static double stiffness(const fw_rim *r, double D)
{
    double b;
    return fw_rim_stiffness(r, D, fw_rim_force(r, D, &b));
}

/* On the line, between no force and all of it, at all stages of a step so long that overlap follows force: the cubic through its ends, with slopes that are
 * what tolerance leaves of 0, says nothing about kinks then. */
static bool is_held(const fw_pair *p, size_t last, double h)
{
    const fw_rim *r = p->rim;
    bool          is_held = h * fw_rim_damping(r, r->deepest[0], fw_rim_force(r, r->deepest[0], &(double){0})) > LONG * r->mass;
    for (size_t s = 0; s <= last && is_held; s++) is_held = p->depth[s] < r->deepest[s] && p->normal[s] > 0 && p->normal[s] < r->yield[s];
    return is_held;
}

double fw_crush_turn(const fw_cluster *c, const fw_pair *p, const fw_setup *set, double h)
{
    const fw_rim *r = p->rim;
    size_t        last = set->method->n_stages - 1;
    course        o = course_of(c, p, last, h);
    double        most = MATTERS * set->crush_share * set->tolerance * set->velocity_scale * r->mass / h, at[N_KINKS], was[N_KINKS]; /* force x share of the step */
    probe(&o, 0, was);
    double near = AT * r->radius;
    double top = 0, c2 = o.d[2], c3 = o.d[3], root = c2 * c2 - 3 * c3 * o.d[1];
    if (root >= 0) top = o.d[1] / (sqrt(root) - c2);
    bool has_peak = top > 0 && top < 1, begins = was[OVER] >= -near || (r->deepest[0] <= FW_CRUSH_ELASTIC && value(o.d, has_peak ? top : 1) > FW_CRUSH_ELASTIC);
    if (begins && p->rate[0] > 0) { /* a push, maybe from the touch on: to its peak, where history is written */
        if (!has_peak) return h;
        double peak = value(o.d, top), S = stiffness(r, peak), wrong = S * (peak - p->depth[last]) + 2 * sqrt(S * r->mass) * fabs(p->rate[last]);
        return wrong * (1 - top) > most ? top * h : h;
    }
    if (is_held(p, last, h)) return h;
    if (fabs(was[OVER]) <= near) was[OVER] = -1, was[PRESSED] = 1, was[FULL] = -1;
    double first = 1, before = 0, beyond = 0, D = fw_larger(r->deepest[0], r->deepest[last]);
    int    kink = OVER;
    for (int k = 1; k <= PROBES; k++) {
        double u = (double)k / PROBES;
        probe(&o, u, at);
        for (int q = 0; q < N_KINKS && first == 1; q++)
            if ((at[q] > 0) != (was[q] > 0) && (q == OVER || at[OVER] < 0)) first = bisect(&o, u - 1.0 / PROBES, u, q), kink = q;
        if (first < 1) beyond = largest_of(beyond, at, kink);
        for (int q = 0; q < N_KINKS; q++) was[q] = at[q];
    }
    if (first == 1) return h;
    for (int k = 0; k < PROBES / 2; k++) {
        probe(&o, first * k / (PROBES / 2), at);
        before = largest_of(before, at, kink);
    }
    /* What is wrong is the shorter branch taken for the longer one. A floe that rolls is off F(d) by next to nothing, again and again. */
    return fw_smaller(before * first, beyond * (1 - first)) * stiffness(r, D) > most ? first * h : h;
}

double fw_crush_error(const fw_cluster *c, fw_pair *p, const fw_setup *set, double h, double no_slip)
{
    const fw_method *me = set->method;
    const fw_rim    *r = p->rim;
    const fw_member *a = &c->members[p->a];
    size_t           last = me->n_stages - 1;
    double           e[3], en, et, load = 0, wrong = 0;
    fw_pair_errors(p, a, me, h, e, &en, &et);
    for (size_t s = 0; s <= last; s += last) {
        double slip = fabs(p->slip[s]) + no_slip * set->velocity_scale, N = p->normal[s], b = r->chord[s], D = fw_larger(p->depth[s], r->deepest[s]);
        if (!(N > 0) || !(b > 0)) continue;
        double weight = 0.5 * h / b, damping = N < r->yield[s] ? fw_rim_damping(r, D, r->yield[s]) : 0; /* ice that crushes has the pressure it has */
        /* In steps much longer than m / c force is what balance of momentum leaves, not what the line makes of a velocity that is off. */
        damping = fw_smaller(damping, LONG / h * r->mass);
        load += weight * N * slip;
        wrong += weight * (damping * en * slip + N * et);
    }
    p->load_tried = load;
    double speed = fw_larger(fw_length(e[0], e[1]), a->radius * fabs(e[2])) / (set->tolerance * set->velocity_scale);
    return fw_larger(speed, p->load + load > 0 ? wrong / (p->load + load) / set->wear_tolerance : 0) / set->crush_share;
}

/* --- books ------------------------------------------------------------------------------------------------------------ */

/* int F dd from a to b, by four Gauss nodes in sqrt d, where F is smooth. */
static double work_of_push(const fw_rim *r, double a, double b)
{
    static const double NODE[] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
    static const double WEIGHT[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
    double              low = sqrt(fw_larger(0, a)), high = sqrt(fw_larger(0, b)), sum = 0, chord;
    for (int i = 0; i < 4; i++) {
        double x = low + NODE[i] * (high - low);
        sum += WEIGHT[i] * 2 * x * fw_rim_force(r, x * x, &chord);
    }
    return sum * (high - low);
}

/* dU/dD at fixed d, U = N^2 / 2S. */
static double store_by_place(const fw_rim *r, double depth, double D, double F)
{
    if (!(D > FW_CRUSH_ELASTIC)) return 0;
    double b, eps = 1e-4 * D, more = fw_rim_force(r, D + eps, &b), less = fw_rim_force(r, D - eps, &b), S = fw_rim_stiffness(r, D, F);
    double dS = (fw_rim_stiffness(r, D + eps, more) - fw_rim_stiffness(r, D - eps, less)) / (2 * eps);
    double N = fw_rim_line(r, depth, D, F), dN = (more - less) / (2 * eps) - S - dS * (D - depth);
    return N > 0 ? N / S * dN - 0.5 * N * N / (S * S) * dS : 0;
}

/* From where it begins, or next to it: rolling, a floe presses on at a D that falls away before it. */
static bool is_push_from_end_to_end(const fw_pair *p, size_t last)
{
    const fw_rim *r = p->rim;
    bool          is_push = true;
    for (size_t s = 1; s <= last; s++) is_push &= p->depth[s] >= r->deepest[s];
    return is_push;
}

void fw_crush_weigh(fw_cluster *c, const fw_method *me, fw_pair *p, double h, fw_step_books *to)
{
    const fw_rim *r = p->rim;
    fw_member    *a = &c->members[p->a];
    size_t        last = me->n_stages - 1;
    double        jx = 0, jy = 0, spin = 0, rub = 0, push = 0, friction = 0, rolling = 0, turned = 0, way = 0, per_way = 0, n_flat = 0, beyond = 0;
    double        dashpot = 0, dropped = 0, damping = 0;
    bool          is_damped = true; /* at all stages, alike */
    bool          is_push = is_push_from_end_to_end(p, last);
    for (size_t s = 0; s <= last; s++) {
        double hb = h * me->b[s], n = p->normal[s], f = p->friction[s], M = r->moment[s], D = r->deepest[s], d = p->depth[s], w = p->rate[s];
        double along = f - M * r->lever[s], elastic = r->yield[s];
        jx += hb * (n * p->dir[s][0] - along * p->dir[s][1]), jy += hb * (n * p->dir[s][1] + along * p->dir[s][0]);
        spin += hb * (f - M / a->radius), rub += hb * f, push += hb * n;
        friction -= hb * f * p->slip[s], rolling -= hb * M * r->turning[s];
        if (d <= D) {
            double per = store_by_place(r, d, D, r->yield[s]), dD = -hb * r->slope[s] * a->radius * r->turning[s];
            turned -= per * dD, way += dD, per_way += per, n_flat++;
            /* a touch that begins a push: D0 is behind it in no time, and all of it is work of the push */
            elastic = is_push ? n : fw_larger(0, fw_rim_line(r, d, D, r->yield[s]));
        }
        if (n > 0)
            dashpot += hb * (n - elastic) * w;
        else
            dropped -= hb * elastic * w;
        is_damped &= n > 0 && n < r->yield[s];
        if (is_damped) damping += me->b[s] * fw_rim_damping(r, fw_larger(d, D), r->yield[s]);
        beyond = fw_larger(beyond, fw_larger(-n, fabs(f) - p->law.mu * n * (1 + ROUNDING)));
        beyond = fw_larger(beyond, fw_larger(fabs(M), 0) - r->hold[s] * (1 + ROUNDING));
        to->peak_force = fw_larger(to->peak_force, n);
    }
    p->is_lawful = beyond <= 0;
    double d0 = p->depth[0], d1 = p->depth[last], D1 = r->deepest[last], stored = fw_rim_stored(r, d1, D1) - r->stored;
    if (is_push)
        turned = 0;
    else if (n_flat > 0) /* D has corners where imprints meet, and a push may end the step: by how much D has changed is known, so the mean is put right */
        turned += per_way / n_flat * (way - (D1 - r->deepest[0]));
    if (d1 > D1) { /* pushed, from where it met the ice that had not been crushed: at once, or somewhere on its way */
        double from = is_push ? d0 : D1;
        double crushed = work_of_push(r, from, d1) - (fw_rim_stored(r, d1, d1) - fw_rim_stored(r, from, from));
        if (push > 0) *(crushed > 0 ? &to->crushed : &turned) += crushed; /* rolling, the floe is lifted as it is off its flat */
    }
    /* Long steps, and no force at all: as for springs (books.c). */
    if (is_damped && damping * h > QUASI_STATIC * r->mass && (is_push || n_flat > (double)last)) dashpot = damping * (d1 - d0) * (d1 - d0) / h;
    if (!(push > 0)) dashpot = 0, dropped = -stored - turned;
    to->dashpot += dashpot, to->dropped += dropped, to->friction += friction, to->rolling += rolling, to->turned += turned;
    to->stored += stored, to->into_springs += fw_larger(0, stored);
    a->gained[0] += jx * a->own_inv_mass, a->gained[1] += jy * a->own_inv_mass, a->gained[2] -= spin * a->turn;
    a->shoved += fw_length(jx, jy) * a->own_inv_mass, a->twisted += fabs(spin * a->turn);
    to->drag_work += fw_member_held(a, rub);
    to->normal_impulse += push;
    double from = r->line[0], until = r->line[last];
    to->contact_time += from > 0 && until > 0 ? h
                        : from > 0            ? h * from / (from - until)
                        : until > 0           ? h * until / (until - from)
                                              : 0;
}

double fw_crush_interval(const fw_pair *p, size_t n_stages, fw_wear_interval *iv)
{
    const fw_rim *r = p->rim;
    size_t        last = n_stages - 1;
    iv->is_push = is_push_from_end_to_end(p, last) && p->rate[0] > 0 && p->normal[last] >= (1 - ROUNDING) * r->yield[last];
    iv->crush = r->law;
    for (size_t s = 0; s < n_stages; s++) {
        iv->normal[s] = iv->is_push ? 1 : r->chord[s] > 0 ? r->line[s] / (r->chord[s] * r->thickness) : 0;
        if (iv->is_push || (s != 0 && s != last)) continue;
        size_t end = s ? 1 : 0;
        bool   is_deeper = p->depth[s] > r->deepest[s];
        iv->depth[end] = is_deeper ? p->depth[s] : r->deepest[s];
        iv->rate[end] = is_deeper ? p->rate[s] : -r->slope[s] * r->radius * r->turning[s];
    }
    if (iv->is_push) return INFINITY;
    /* Below zero the line is as steep as above: 1e-5 m off the rim it stands 1e5 N below, and a polynomial that begins at 1 N bulges to as many above. */
    double most = 0;
    size_t first = last, n_pressed = 0;
    for (size_t s = 0; s < n_stages; s++) {
        most = fw_larger(most, iv->normal[s]), n_pressed += iv->normal[s] > 0;
        if (s > 0 && iv->at[s] < iv->at[first]) first = s;
    }
    if (n_pressed == 1 && iv->normal[0] > 0) return iv->length * iv->at[first] * iv->normal[0] / (iv->normal[0] - iv->normal[first]);
    for (size_t s = 0; s < n_stages; s++) iv->normal[s] = fw_larger(iv->normal[s], -most);
    return INFINITY;
}

/* --- memory ----------------------------------------------------------------------------------------------------------- */

static void leave_imprint(fw_cluster *c, fw_pair *p, size_t last, double h)
{
    fw_rim *r = p->rim;
    course  o = course_of(c, p, last, h);
    r->stored = fw_rim_stored(r, p->depth[last], r->deepest[last]);
    r->load = p->load;
    if (p->rate[0] > 0 || p->rate[last] > 0) {
        /* A push that turns meanwhile leaves its imprints side by side. Where d falls (a floe rolls over fresh rim, slower and slower) nothing is written: on
         * each imprint it would be on the flat again, for an instant, and those instants have no smallest one. */
        double way = r->radius * fabs(o.at[1] + o.at[2] + o.at[3]);
        int    n = 1 + (int)fw_smaller(1000, way / (0.5 * r->width));
        for (int k = 1; k <= n; k++) {
            double u = (double)k / n, slope, d = k == n ? p->depth[last] : value(o.d, u), at = o.from + value(o.at, u);
            if (!(d > 0) || d < fw_rim_deepest(r, at, &slope)) continue;
            r->own = (fw_imprint){d, at};
            fw_rim_press(r, r->own);
        }
    }
    r->moment[0] = r->moment[last], r->hold[0] = r->hold[last], r->lever[0] = r->lever[last], r->turning[0] = r->turning[last], r->line[0] = r->line[last];
    /* what was written counts from here on */
    r->place = o.from + o.at[1] + o.at[2] + o.at[3];
    r->deepest[0] = fw_rim_deepest(r, r->place, &r->slope[0]);
    r->yield[0] = fw_rim_force(r, fw_larger(r->deepest[0], p->depth[last]), &r->chord[0]);
}

void fw_crush_commit(fw_cluster *c, fw_world *w, size_t last, double h)
{
    for (size_t i = 0; i < c->n_members; i++) w->bodies[c->members[i].index].angle = c->members[i].y0[FW_TURN];
    for (size_t k = 0; k < c->n_pairs; k++)
        if (c->pairs[k].rim) leave_imprint(c, &c->pairs[k], last, h);
}
