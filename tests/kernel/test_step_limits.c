/* Step limits of explicit schemes on a floe of 1.2 m x 0.3 m, w = 81 /s, and what lies beyond them: nothing blows up, slip chatters between
 * the caps of friction, wear is silently wrong, and the watch-dog sees it. The event-driven kernel has no such limit.
 *
 * The limit is 2 / lambda: lambda the largest rate of the contacts' dashpots, normal and slip, an eigenvalue of M^-1/2 C M^-1/2. One floe on
 * the wall: its slip, 6 w. Clusters: 4.1, 1.9, 1.2 and 0.8 ms were measured with an independent program (wall; two floes behind; six
 * contacts; 19 floes). */
#include <gsl/gsl_eigen.h>
#include <string.h>

#include "check.h"
#include "floewear/realisation.h"
#include "kernel/plain.h"
#include "physics/contact.h"

#define PI 3.14159265358979323846
enum { MAX_FLOES = 19, N_SCENES = 4 };

static const double RS = 3.7, R = 0.6, H = 0.3, K = 2e6;

typedef struct scene {
    const char *name;
    size_t      n;
    double      x[MAX_FLOES], y[MAX_FLOES];
    double      measured; /* limit [s] */
} scene;

static double mass(void) { return 900 * PI * R * R * H; }

/* Rows of a hexagonal raft, pointed at the wall: widths[r] floes in row r, all touching. */
static void raft(scene *s, size_t n_rows, const size_t *widths)
{
    for (size_t r = 0; r < n_rows; r++)
        for (size_t i = 0; i < widths[r]; i++, s->n++) {
            s->x[s->n] = -(RS + R) - sqrt(3) * R * (double)r;
            s->y[s->n] = 2 * R * ((double)i - 0.5 * (double)(widths[r] - 1));
        }
}

static void make(scene *s, size_t k)
{
    static const size_t ONE[] = {1}, THREE[] = {1, 2}, FOUR[] = {1, 2, 1}, NINETEEN[] = {1, 2, 3, 4, 5, 4};
    static const struct {
        const char   *name;
        size_t        n_rows;
        const size_t *widths;
        double        measured;
    } CASES[] = {{"one floe on the wall", 1, ONE, 4.1e-3},
                 {"with two floes behind", 2, THREE, 1.9e-3},
                 {"a rhombus, six contacts", 3, FOUR, 1.2e-3},
                 {"raft of 19", 6, NINETEEN, 0.8e-3}};
    *s = (scene){.name = CASES[k].name, .measured = CASES[k].measured};
    raft(s, CASES[k].n_rows, CASES[k].widths);
}

/* Adds c d d^T to the mass-scaled damping matrix for a direction d of relative motion, (3n). */
static void add_direction(gsl_matrix *C, double c, const double *d)
{
    for (size_t i = 0; i < C->size1; i++)
        for (size_t j = 0; j < C->size1; j++) {
            double mi = i % 3 == 2 ? 0.5 * mass() * R * R : mass(), mj = j % 3 == 2 ? 0.5 * mass() * R * R : mass();
            gsl_matrix_set(C, i, j, gsl_matrix_get(C, i, j) + c * d[i] * d[j] / sqrt(mi * mj));
        }
}

static double largest_rate(const scene *s)
{
    size_t      n = 3 * s->n;
    gsl_matrix *C = gsl_matrix_calloc(n, n);
    for (size_t i = 0; i < s->n; i++)
        for (size_t j = i; j < s->n; j++) { /* j == i: the wall */
            bool   is_wall = i == j;
            double dx = s->x[i] - (is_wall ? 0 : s->x[j]), dy = s->y[i] - (is_wall ? 0 : s->y[j]), r = hypot(dx, dy), d[3 * MAX_FLOES] = {0};
            if (r > (is_wall ? RS + R : 2 * R) + 1e-9) continue;
            double c = 2 * sqrt(K * (is_wall ? mass() : 0.5 * mass())), nx = dx / r, ny = dy / r;
            d[3 * i] = nx, d[3 * i + 1] = ny;
            if (!is_wall) d[3 * j] = -nx, d[3 * j + 1] = -ny;
            add_direction(C, c, d);
            memset(d, 0, sizeof d);
            d[3 * i] = -ny, d[3 * i + 1] = nx, d[3 * i + 2] = -R;
            if (!is_wall) d[3 * j] = ny, d[3 * j + 1] = -nx, d[3 * j + 2] = -R;
            add_direction(C, c, d);
        }
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(n);
    gsl_vector               *rates = gsl_vector_alloc(n);
    gsl_eigen_symm(C, rates, work);
    double worst = gsl_vector_max(rates);
    gsl_vector_free(rates);
    gsl_eigen_symm_free(work);
    gsl_matrix_free(C);
    return worst;
}

typedef struct outcome {
    double chatter, load, steps;
} outcome;

/* A current of 2 m/s presses the cluster, which starts with the water's speed at the wall and a little spin. */
static const double DURATION = 3, SPIN = 2;

static outcome explicit_run(const scene *s, double mu, double dt)
{
    const fw_abrasion_law law = {"bekker2011", 0.116, 1.121, true};
    fw_setup              set = {.structure_radius = RS, .flow = {.ux = 2, .ice_x = 2}, .contact = {K, 1, mu, 1}, .floe_contact = {K, 1, mu, 1}, .has_floe_contact = true, .has_drag = true,
                                 .has_rotation = true, .ice_density = 900, .drag_per_area = 5125, .velocity_scale = 2, .skin = 2,
                                 .half_width = INFINITY, .downstream = INFINITY, .max_evaluations = INFINITY};
    fw_numerics           n = {.scheme = FW_SCHEME_EULER, .wear_rule = FW_WEAR_HERMITE, .step = dt};
    fw_plain             *p;
    fw_world             *w;
    fw_wear               wear;
    fw_msg                m = {""};
    assert_int_equal(fw_wear_init(&wear, RS, 360, 1, &law, &m), FW_OK);
    assert_int_equal(fw_world_create(&w, RS, &m), FW_OK);
    assert_int_equal(fw_plain_create(&p, &set, &n, -60, &m), FW_OK);
    for (size_t i = 0; i < s->n; i++) {
        fw_body b = {.x = s->x[i], .y = s->y[i], .vx = 2, .spin = SPIN, .radius = R, .thickness = H, .inv_mass = 1 / mass(),
                     .inv_inertia = 2 / (mass() * R * R), .drag = set.drag_per_area * 2 * R * H};
        assert_int_equal(fw_world_add_body(w, &b, &m), FW_OK);
        w->bodies[i].is_touched = true;
    }
    wear.is_open = true;
    while (w->t < DURATION)
        if (fw_plain_step(p, w, &wear, DURATION, &m) != FW_OK) fail_msg("%s", m.text);
    outcome o = {.chatter = fw_ledger_chatter(&w->ledger), .load = wear.sums[0].along, .steps = w->ledger.steps};
    fw_plain_destroy(p);
    fw_world_destroy(w);
    fw_wear_free(&wear);
    return o;
}

static void explicit_limits(void **state)
{
    (void)state;
    for (size_t k = 0; k < N_SCENES; k++) {
        scene s;
        make(&s, k);
        double limit = 2 / largest_rate(&s);
        print_message("%-24s limit %.3f ms (elsewhere %.1f)\n", s.name, 1e3 * limit, 1e3 * s.measured);
        CHECK_RELATIVE(limit, s.measured, 0.2);
        for (int i = 0; i < 2; i++) {
            double  mu = i ? 1 : 0.1, fine = explicit_run(&s, mu, 0.1 * limit).load;
            outcome below = explicit_run(&s, mu, 0.8 * limit), beyond = explicit_run(&s, mu, 2.8 * limit);
            print_message("  mu %-4g 0.8 of it: chatter %.4f, wear x%.2f; 2.8 of it: chatter %.4f, wear x%.2f\n", mu, below.chatter,
                          below.load / fine, beyond.chatter, beyond.load / fine);
            assert_true(beyond.chatter > 3e-3 && isfinite(beyond.load)); /* three times what a run may have: realisation/verdict.c */
            assert_true(beyond.load > below.load);
            if (mu < 1) assert_true(below.chatter == 0);
        }
    }
}

/* One floe on the wall has one mode, so its limit is sharp. */
static void sharp_limit(void **state)
{
    (void)state;
    scene s;
    make(&s, 0);
    double w = sqrt(K / mass()), limit = 2 / (6 * w);
    CHECK_RELATIVE(2 / largest_rate(&s), limit, 1e-12);
    assert_true(explicit_run(&s, 0.1, 0.95 * limit).chatter == 0);
    assert_true(explicit_run(&s, 0.1, 1.1 * limit).chatter > 0.5);
}

/* The event-driven kernel, its error control let off: steps of many limits, no chatter, wear as good as its tolerance. */
static void no_limit_here(void **state)
{
    (void)state;
    for (size_t k = 0; k < N_SCENES; k++) {
        scene           s;
        fw_floe         floes[MAX_FLOES];
        fw_scene        c = {.speed = 2, .temperature = -10, .duration = DURATION, .floes = floes};
        fw_scene_result good, loose;
        fw_msg          m = {""};
        make(&s, k);
        c.n_floes = s.n;
        for (size_t i = 0; i < s.n; i++)
            floes[i] = (fw_floe){.x = s.x[i], .y = s.y[i], .diameter = 2 * R, .thickness = H, .vx = 2, .spin = SPIN};
        fw_model_defaults(&c.model);
        c.model.accuracy = 0.001;
        assert_int_equal(fw_scene_run(&c, NULL, NULL, &good, &m), FW_OK);
        c.model.accuracy = 0.1, c.model.numerics = (fw_numerics){.order = 3, .tolerance = 0.1, .wear_tolerance = 0.5, .growth = 10};
        assert_int_equal(fw_scene_run(&c, NULL, NULL, &loose, &m), FW_OK);
        double limit = 2 / largest_rate(&s);
        print_message("%-24s %.0f steps for %.0f; wear %+.1f %%, chatter %g, %g\n", s.name, loose.record.steps, DURATION / limit,
                      100 * (loose.depth_along_contact / good.depth_along_contact - 1), good.record.slip_chatter, loose.record.slip_chatter);
        assert_true(loose.record.slip_chatter == 0 && good.record.slip_chatter == 0);
        assert_true(loose.record.steps < 0.1 * DURATION / limit); /* ten limits long in the mean */
        CHECK_RELATIVE(loose.depth_along_contact, good.depth_along_contact, 0.2);
        fw_scene_result_free(&good);
        fw_scene_result_free(&loose);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(explicit_limits), cmocka_unit_test(sharp_limit), cmocka_unit_test(no_limit_here)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
