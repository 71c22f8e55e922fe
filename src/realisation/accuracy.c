#include "realisation/accuracy.h"

#include <math.h>

#include "physics/crush.h"

/* What each accuracy takes. Found on the 22 scenes of tests/reference in which floes meet (singles, several, extreme floes), on 20000
 * random single hits against a tenth of the finest tolerances, and on windows at 10 / 40 / 60 % on the same ice, 2 m/s. Everything is
 * measured again by tests/realisation/test_reference.c, test_order.c, test_evaluations.c, tests/validation (the hits and the windows) and
 * `floewear accuracy`.
 *
 *            worst of 22: depth  depth x wall  energy balance  evaluations | 20000 hits, along contact: 99 % within  worst | x wall: worst
 *   10 %                1.3e-2       1.5e-2        2.8e-2          2416    |                            3.3e-3     3.2e-2 |   4.8e-3
 *    1 %                2.3e-3       3.2e-3        8.9e-3          3002    |                            1.0e-3     8.4e-3 |   1.4e-3
 *    0.1 %              2.5e-4       4.5e-4        7.9e-4          6171    |                            2.9e-4     8.4e-3 |   2.8e-4
 *    0.01 %             2.5e-5       2.8e-5        7.7e-5         13162    |                            3.0e-5     2.7e-4 |   1.9e-5
 * Where a promise cannot be kept: 6 and 9 of 20000 hits at the two finest levels are glances in which the floe bounces, nearly parts and is pressed
 * once more with next to no overlap: pressure has no bound there, wear on the wall has.
 * A lone floe on the wall goes by closed forms (kernel/lone.h), the others by ARK3.
 *
 * tolerance   local error of velocity over the current's speed. wear: error of a step's wear over its touch's (kernel/cluster.c). With the
 *             first alone, third order at 1e-3 was 15 % off in depth where sliding ends. At 1 % the tolerance is what two floes' energy
 *             balance allows; both halved, the mean of windows at 40 % ice does not change and the price is 6 % more.
 * order       3 (ARK3). TR-BDF2 at its best takes 2.1 times the evaluations at 1 % (its energy balance is what binds, and its errors
 *             have one sign: -1e-3 in the mean); order 4 takes 1.2 times.
 * first step  0.05 to 0.2 / w cost and give the same at 1 %; the finer levels want the shorter ones. growth 3 costs 1 % more, 6 no less.
 * solver      sweeps of a stage may leave 3 times the tolerance: the error estimate sees what they leave, and the structure's contacts are left
 *             nothing (kernel/stage.c). At 1 a window at 40 % ice takes 4 % longer, at 8 less, but mean depth shows it (-0.14 %).
 * horizon     6 m of the current's way between two listings; 4 m take 3 % longer, 8 m as long.
 * Fields, means over windows, tests/validation/accuracy.md: at 1 % 10 % ice, 2000 windows, +0.05 +- 0.02 %; 40 % ice, 3000 windows, 0.0 +- 0.1 %;
 * 60 % ice, 1000 windows, 0.1 +- 0.5 %. Raahe's slow currents, 19 coupled windows: -0.06 +- 0.09 %. Jams decouple: two runs that differ in the last digit differ after a minute, so single
 * windows at 40 % and more agree in the mean over fields and not one by one.
 *
 * Strip width against 200 m [%], 64 windows of 1800 s:                      40        60        80       100       140 m
 *   10 % ice                                                               -0.01      0         0         0         0
 *   40 % ice                                                               -1.1      -0.30     -0.03     -0.003     0
 * Downstream against 50 m:                                                   8        12        16        20        30 m
 *   10 % ice                                                                0         0         0         0         0
 *   40 % ice                                                               -0.15     -0.11     -0.005    -0.01      0
 * Both at 60 % ice, against 200 m / 40 m, 400 windows of 600 s: 100 / 16 m +0.67 +- 0.52 %, 60 / 16 m -0.25 +- 0.57 %, 100 / 40 m
 * +0.53 +- 0.51 %.
 * Warm-up: load of the next 60 s against that after 240 s, 1500 / 600 / 150 fields:   0       30        60       120 m
 *   10 / 40 / 60 % ice                                                  -3 / -7 / -12   0 / 0 / -5   0 / 0 / -5   0 / 0 / 0
 *             so starting without one costs a 3 h window 0.04 % at 40 % ice; the way is what counts, not the time.
 * Crush: share of the tolerances for floes on a structure that crushes them; those that touch only each other keep theirs. 150 random hits at accuracy
 * 1 % against a tenth of the finest tolerances, depth on the wall: median, 90 % within, 99 % within, evaluations a hit
 *             1: 8e-3, 0.10, 1.0, 542     0.3: 2e-3, 0.019, 0.076, 599     0.1: 6e-4, 4.8e-3, 1.1e-2, 699
 *             98 random hits against independent integration (tests/reference/crush.py), 90 % within, worst, on the wall | along the contact: 1 % 2.7e-3, 1.1e-2 |
 *             5.5e-3, 0.10; 0.1 % 1.5e-4, 5e-4 | 3.1e-4, 3e-3. The worst come off their flat late, with next to no force and on a chord of millimetres, where
 *             the ice still has its pressure: it is no wear on the wall.
 *             Slow currents, 60 windows each at 20 % ice, load against a tenth of the tolerances: 1 m/s 0.0 +- 0.1 %, 5 cm/s +0.5 +- 0.1 %, 1 cm/s +1.2 +- 0.7 %
 *             (one floe hit once more; without it +0.5 %), 3 mm/s +0.1 +- 0.1 %; 90 % of the windows within 1.4 %.
 * Ring: an arc's mean against the depth at its middle is (arc / patch)^2 / 24 or so: 7e-4 at 360 arcs of 6.5 cm under patches of 0.5 m. */
static const struct row {
    double accuracy, tolerance, wear, first_step, growth, crush;
    double strip_width, downstream, warm_up; /* [m] */
    size_t n_arcs;
} TABLE[] = {
    {1e-1, 4e-3, 3e-3, 0.10, 4, 0.04, 60, 10, 60, 360},
    {1e-2, 1.3e-3, 5e-4, 0.10, 4, 0.1, 100, 16, 120, 360},
    {1e-3, 4e-5, 1.5e-5, 0.05, 4, 0.1, 100, 24, 240, 720},
    {1e-4, 1.6e-6, 8e-7, 0.02, 4, 0.1, 140, 40, 480, 1440},
};
enum { N_ROWS = sizeof TABLE / sizeof TABLE[0] };

static const double FINER = 10; /* of a second try: the step from one row to the next and more */

static double blend(double a, double b, double f) { return exp(log(a) + f * (log(b) - log(a))); }

/* The coarsest row that is fine enough; between two rows nobody is given less than he asked for. */
static const struct row *row_of(double accuracy)
{
    size_t r = 0;
    while (r + 1 < N_ROWS && accuracy < TABLE[r].accuracy * (1 - 1e-9)) r++;
    return &TABLE[r];
}

void fw_accuracy_setup(fw_setup *s, const fw_model *m, double speed, double velocity_scale)
{
    size_t r = 0;
    while (r + 2 < N_ROWS && m->accuracy < TABLE[r + 1].accuracy) r++;
    double f = log(m->accuracy / TABLE[r].accuracy) / log(TABLE[r + 1].accuracy / TABLE[r].accuracy);
    f = fmin(1, fmax(0, f));
    bool has_own = (m->effects & FW_EFFECT_ICE_ON_ICE) != 0, has_skin = (m->effects & FW_EFFECT_SKIN_DRAG) != 0;
    bool is_crush = (m->effects & FW_EFFECT_CRUSH_CONTACT) != 0;
    bool has_friction = (m->effects & FW_EFFECT_FRICTION) != 0, has_drag = (m->effects & FW_EFFECT_FORM_DRAG) != 0;
    double ct = has_friction ? m->slip_damping_ratio : 0; /* over c; beside a friction of 0 it would still be in the rounding */
    double ct_wall = is_crush && m->crush.has_flat ? m->slip_damping_ratio : ct; /* the flat's moment is none of friction */
    *s = (fw_setup){
        .structure_radius = m->structure_radius,
        .flow = {.ux = speed, .ice_x = speed},
        .contact = {m->stiffness, m->damping_ratio, has_friction ? m->friction : 0, ct_wall},
        .floe_contact = {has_own ? m->floe_stiffness : m->stiffness, m->damping_ratio,
                         !has_friction ? 0 : has_own ? m->floe_friction : m->friction, ct},
        .has_floe_contact = (m->effects & FW_EFFECT_FLOE_CONTACT) != 0,
        .has_drag = has_drag || has_skin,
        .has_rotation = (m->effects & FW_EFFECT_ROTATION) != 0,
        .has_body_forces = (m->effects & (FW_EFFECT_WIND | FW_EFFECT_DEFLECTED_FLOW | FW_EFFECT_SKIN_DRAG)) != 0,
        .has_wind = (m->effects & FW_EFFECT_WIND) != 0,
        .has_deflection = (m->effects & FW_EFFECT_DEFLECTED_FLOW) != 0,
        .has_spin_drag = has_skin && (m->effects & FW_EFFECT_ROTATION) != 0,
        .has_added_mass = (m->effects & FW_EFFECT_ADDED_MASS) != 0,
        .ice_density = m->ice_density,
        .water_density = m->water_density,
        .skin_drag = has_skin ? m->skin_drag : 0,
        .wind = m->wind,
        .drag_per_area = has_drag ? 0.5 * m->water_density * m->form_drag : 0,
        .method = FW_METHOD_ARK3,
        .is_crush = is_crush,
        .is_from_pressure = m->stiffness_from_pressure,
        .crush = m->crush,
        .crush_share = blend(TABLE[r].crush, TABLE[r + 1].crush, f),
        .crush_speed = speed > 0 ? speed : velocity_scale,
        .is_lone_exact = !m->numerics.order && !is_crush, /* a study of the method is one of every contact */
        .tolerance = blend(TABLE[r].tolerance, TABLE[r + 1].tolerance, f),
        .wear_tolerance = blend(TABLE[r].wear, TABLE[r + 1].wear, f),
        .velocity_scale = velocity_scale,
        .first_step = blend(TABLE[r].first_step, TABLE[r + 1].first_step, f),
        .growth = blend(TABLE[r].growth, TABLE[r + 1].growth, f),
        .max_step = 2.0,
        .solver_share = 3,
        .landing = 10 * blend(TABLE[r].tolerance, TABLE[r + 1].tolerance, f),
        .horizon = 6.0,
        .margin = 0.3,
        .skin = 2.0,
        .half_width = 0.5 * fw_accuracy_strip_width(m),
        .downstream = fw_accuracy_downstream(m),
        .max_evaluations = INFINITY,
    };
    s->energy_tolerance = m->accuracy;
    if (!(s->crush.unloading > 0)) s->crush.unloading = fw_crush_unloading(&s->crush.law, exp(-2)); /* the critically damped spring's restitution */
    const fw_numerics *own = &m->numerics; /* of a study of the choice itself */
    if (own->order) s->method = own->order == 2 ? FW_METHOD_TRBDF2 : own->order == 3 ? FW_METHOD_ARK3 : FW_METHOD_ARK4;
    if (own->tolerance > 0) {
        s->energy_tolerance *= fmax(1, own->tolerance / s->tolerance); /* a coarser level of a study is as far out as it is meant to be */
        s->tolerance = own->tolerance, s->landing = 10 * own->tolerance;
    }
    if (own->wear_tolerance > 0) s->wear_tolerance = own->wear_tolerance;
    if (own->first_step > 0) s->first_step = own->first_step;
    if (own->growth > 0) s->growth = own->growth;
}

fw_model fw_accuracy_finer(const fw_model *m)
{
    fw_model   finer = *m;
    fw_numerics *n = &finer.numerics;
    fw_setup   s;
    fw_accuracy_setup(&s, m, 1, 1);
    n->tolerance = s.tolerance / FINER, n->wear_tolerance = s.wear_tolerance / FINER;
    n->first_step = fmin(s.first_step, TABLE[N_ROWS - 1].first_step), n->growth = s.growth;
    return finer;
}

double fw_accuracy_strip_width(const fw_model *m)
{
    return m->strip_width > 0 ? m->strip_width : row_of(m->accuracy)->strip_width;
}
double fw_accuracy_downstream(const fw_model *m)
{
    return m->downstream > 0 ? m->downstream : row_of(m->accuracy)->downstream;
}
double fw_accuracy_warm_up(const fw_model *m, double speed)
{
    return m->warm_up >= 0 ? m->warm_up : row_of(m->accuracy)->warm_up / speed;
}
size_t fw_accuracy_arcs(double accuracy) { return row_of(accuracy)->n_arcs; }

size_t fw_accuracy_lines(const fw_model *m, double speed, fw_accuracy_line *lines, size_t capacity)
{
    fw_setup s;
    fw_accuracy_setup(&s, m, speed, speed);
    const fw_accuracy_line all[] = {
        {"tolerance", "1", "local error of velocity per step over the current's speed", s.tolerance},
        {"wear_tolerance", "1", "local error of a step's wear over the wear of its touch", s.wear_tolerance},
        {"first_step", "1/w", "step after a touch; it grows from there by error control", s.first_step},
        {"method_order", "1", "order of the integrator (2: TR-BDF2, 3: ARK3, 4: ARK4)", s.method->order},
        {"horizon", "s", "6 m of the current's way: who may touch whom is listed anew", s.horizon / speed},
        {"ring_arcs", "1", "arcs round the structure (ring.arcs)", (double)m->n_arcs},
        {"strip_width", "m",
         m->strip_width > 0 ? "field.strip_width" : "auto: 60 m are 0.3 % off at 40 % ice, 100 m 0.003 %",
         fw_accuracy_strip_width(m)},
        {"downstream", "m",
         m->downstream > 0 ? "field.downstream" : "auto: floes forgotten at 8 m are 0.15 % off at 40 % ice, at 16 m 0.005 %",
         fw_accuracy_downstream(m)},
        {"warm_up", "s",
         m->warm_up >= 0 ? "exposure.warm_up" : "auto: 60 to 480 m of the current's way; none is 0.04 % off in 3 h",
         fw_accuracy_warm_up(m, speed)},
    };
    size_t n = sizeof all / sizeof all[0] < capacity ? sizeof all / sizeof all[0] : capacity;
    for (size_t i = 0; i < n; i++) lines[i] = all[i];
    return n;
}

fw_numerics fw_accuracy_built_in(const fw_model *m)
{
    fw_setup s;
    fw_model bare = *m;
    bare.numerics = (fw_numerics){.scheme = FW_SCHEME_EVENTS};
    fw_accuracy_setup(&s, &bare, 1, 1);
    return (fw_numerics){
        .tolerance = s.tolerance, .wear_tolerance = s.wear_tolerance, .first_step = s.first_step, .growth = s.growth};
}

void fw_accuracy_set_tolerance(fw_numerics *n, double tolerance)
{
    n->wear_tolerance *= tolerance / n->tolerance;
    n->tolerance = tolerance;
}
