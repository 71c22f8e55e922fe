/* How fast do the depths of the reference scenes (tests/reference, independent of this code) converge?
 *
 * Refining under error control: the estimate of a step is ~ h^q with q = 3 for orders 2 and 3, q = 4 for order 4, so a tolerance
 * 2^-q times as large halves the steps; the first step after a touch is halved with it, and the root of growth keeps
 * the grading: twice the steps for each factor in time. Length of step here is therefore h = 2^-level, and order is the slope of
 * log |error| against log h by least squares over the levels of one scene. The median over the scenes is held to; the
 * slope against the steps that were taken is printed beside it (it is higher while something else than tolerance cuts them). */
#include "realisation/reference_table.h"

enum { MAX_CASES = 32, MAX_LEVELS = 5, MAX_FLOES = 8 };

typedef struct reference_case {
    char    name[64];
    fw_floe floes[MAX_FLOES];
    size_t  n_floes;
    double  duration, depth, over_wall;
} reference_case;

typedef struct measured {
    double depth[MAX_CASES][MAX_LEVELS], over_wall[MAX_CASES][MAX_LEVELS], steps[MAX_CASES][MAX_LEVELS];
} measured;

typedef struct study {
    int    order;       /* 0: what a user gets at 1 % */
    double error_order; /* q */
    size_t n_levels;
    double tolerance; /* of level 0 */
} study;

static size_t add_single(reference_case *c, size_t n, const char *file)
{
    table *t = malloc(sizeof *t);
    read_table(t, file);
    for (size_t row = 1; row < t->n_rows; row++) {
        if (strcmp(text(t, row, "outcome"), "leaves") != 0) continue; /* a miss and a pinned floe wear nothing */
        reference_case *to = &c[n++];
        assert_true(n <= MAX_CASES);
        to->floes[0] = single_floe_of(t, row), to->n_floes = 1;
        snprintf(to->name, sizeof to->name, "case %s offset %g", text(t, row, "case"), to->floes[0].y);
        to->duration = REFERENCE_GAP / to->floes[0].vx + value(t, row, "t_release") + 1;
        to->depth = value(t, row, "depth_total_mm"), to->over_wall = value(t, row, "W_mm_m");
    }
    free(t);
    return n;
}

static size_t add_several(reference_case *c, size_t n, const char *file)
{
    table *t = malloc(sizeof *t);
    read_table(t, file);
    for (size_t row = 1, n_rows; row < t->n_rows; row += n_rows) {
        reference_case *to = &c[n];
        n_rows = to->n_floes = floes_of(t, row, to->floes);
        if (!(value(t, row, "depth_mm") > 0)) continue;
        n++;
        assert_true(n <= MAX_CASES);
        snprintf(to->name, sizeof to->name, "%s", text(t, row, "scene"));
        to->duration = value(t, row, "t_end");
        to->depth = value(t, row, "depth_mm"), to->over_wall = value(t, row, "W_mm_m");
    }
    free(t);
    return n;
}

static size_t all_cases(reference_case *c)
{
    size_t n = add_single(c, 0, "single_floe.csv");
    n = add_single(c, n, "extreme_floes.csv");
    n = add_several(c, n, "multi_floe.csv");
    return add_several(c, n, "extreme_multi.csv");
}

static double slope(size_t n, const double *x, const double *y)
{
    double mx = 0, my = 0, xy = 0, xx = 0;
    for (size_t i = 0; i < n; i++) mx += x[i] / (double)n, my += y[i] / (double)n;
    for (size_t i = 0; i < n; i++) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
    return xy / xx;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(size_t n, const double *value)
{
    double sorted[MAX_CASES];
    memcpy(sorted, value, n * sizeof *value);
    qsort(sorted, n, sizeof *sorted, ascending);
    return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

/* Errors and steps of every case at every level. */
static void measure(const study *st, const reference_case *cases, size_t n, measured *m)
{
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < st->n_levels; l++) {
            const reference_case *c = &cases[k];
            fw_floe               floes[MAX_FLOES];
            memcpy(floes, c->floes, sizeof floes);
            fw_scene s = scene_of(floes, c->n_floes, c->duration, 0.01);
            double   finer = pow(2, -(double)l);
            s.model.numerics = (fw_numerics){.order = st->order,
                                             .tolerance = st->tolerance * pow(finer, st->error_order),
                                             .first_step = 0.05 * finer,
                                             .growth = pow(3, finer)};
            fw_scene_result r;
            fw_msg          msg = {""};
            if (fw_scene_run(&s, NULL, NULL, &r, &msg) != FW_OK) fail_msg("%s: %s", c->name, msg.text);
            /* the reference is good to 1e-10: below ten times that an error says nothing */
            m->depth[k][l] = fmax(1e-9, fabs(r.depth_along_contact / c->depth - 1));
            m->over_wall[k][l] = fmax(1e-9, fabs(r.depth_x_wall / c->over_wall - 1));
            m->steps[k][l] = r.record.steps;
            fw_scene_result_free(&r);
        }
}

/* Median over the cases of the order in h; prints it with the medians of the errors. */
static double order_of(const char *what, const study *st, size_t n, double error[][MAX_LEVELS],
                       double steps[][MAX_LEVELS])
{
    double in_h[MAX_CASES], in_steps[MAX_CASES], column[MAX_CASES];
    for (size_t k = 0; k < n; k++) {
        double x[MAX_LEVELS], y[MAX_LEVELS], log_steps[MAX_LEVELS];
        for (size_t l = 0; l < st->n_levels; l++)
            x[l] = -(double)l, y[l] = log2(error[k][l]), log_steps[l] = log2(steps[k][l]);
        in_h[k] = slope(st->n_levels, x, y), in_steps[k] = -slope(st->n_levels, log_steps, y);
    }
    print_message("order %d (0: the default), %s: errors", st->order, what);
    for (size_t l = 0; l < st->n_levels; l++) {
        for (size_t k = 0; k < n; k++) column[k] = error[k][l];
        print_message(" %.1e", median(n, column));
    }
    double median_h = median(n, in_h);
    print_message(", order in h %.2f, against steps taken %.2f\n", median_h, median(n, in_steps));
    return median_h;
}

static void check_order(study st, double wanted_depth, double wanted_over_wall)
{
    reference_case *cases = calloc(MAX_CASES, sizeof *cases);
    measured       *m = calloc(1, sizeof *m);
    size_t          n = all_cases(cases);
    assert_true(n >= 15);
    measure(&st, cases, n, m);
    double depth = order_of("depth", &st, n, m->depth, m->steps);
    double over_wall = order_of("over the wall", &st, n, m->over_wall, m->steps);
    assert_true(depth >= wanted_depth);
    assert_true(over_wall >= wanted_over_wall);
    free(m);
    free(cases);
}

/* Over the wall: chord x load is ~ t^((1 - m)/2) after a touch, and the nodes of the first step are exact for the load alone, ~ t^(-m/2):
 * what is left is ~ first step^0.94, small (1e-5) but first order. */
static void default_scheme(void **state)
{
    (void)state;
    check_order((study){.order = 0, .error_order = 3, .n_levels = 5, .tolerance = 1e-5}, 1.8, 0.9);
}
static void third_order(void **state)
{
    (void)state;
    check_order((study){.order = 3, .error_order = 3, .n_levels = 4, .tolerance = 1e-5}, 2.4, 0.5);
}
static void fourth_order(void **state)
{
    (void)state;
    check_order((study){.order = 4, .error_order = 4, .n_levels = 4, .tolerance = 1e-5}, 2.4, 0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(default_scheme), cmocka_unit_test(third_order),
                                       cmocka_unit_test(fourth_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
