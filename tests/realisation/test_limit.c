/* Single floes under a crushing limit at every accuracy a user may ask for, for laws of several exponents: reference solutions with the limit
 * (tests/reference/limited_floes.csv; independent of this code). The motion knows nothing of it. */
#include "realisation/reference_table.h"

static fw_scene limited(fw_floe *f, double m, double pressure, double exponent, double accuracy)
{
    fw_scene s = scene_of(f, 1, 60, accuracy);
    s.model.laws[0] = (fw_abrasion_law){"power", 1, m, false};
    s.model.effects |= FW_EFFECT_CRUSHING_LIMIT;
    s.model.crushing_limit = (fw_pressure_law){pressure, exponent};
    return s;
}

static void run(const fw_scene *s, fw_scene_result *r)
{
    fw_msg m = {""};
    if (fw_scene_run(s, NULL, NULL, r, &m) != FW_OK) fail_msg("%s", m.text);
    assert_true(r->record.wear_conservation <= 1e-10);
}

static void reference_floes(void **state)
{
    (void)state;
    static const double ACCURACY[] = {1e-1, 1e-2, 1e-3, 1e-4}, M[] = {0.5, 1.121, 1.9, 2.5};
    table              *t = malloc(sizeof *t);
    read_table(t, "limited_floes.csv");
    for (size_t a = 0; a < 4; a++) {
        double worst = 0;
        for (size_t row = 1; row < t->n_rows; row++)
            for (size_t l = 0; l < 4; l++) {
                char            along[32], wall[32];
                fw_floe         f = single_floe_at(value(t, row, "D"), value(t, row, "h"), value(t, row, "y0"));
                fw_scene        s = limited(&f, M[l], 1e6 * value(t, row, "P0"), value(t, row, "q"), ACCURACY[a]);
                fw_scene_result r;
                run(&s, &r);
                snprintf(along, sizeof along, "along_%g", M[l]), snprintf(wall, sizeof wall, "wall_%g", M[l]);
                double wanted = 1e-3 * value(t, row, along), on_wall = 1e-3 * value(t, row, wall);
                worst = fmax(worst, fmax(fabs(r.depth_along_contact / wanted - 1), fabs(r.depth_x_wall / on_wall - 1)));
                CHECK_RELATIVE(r.depth_along_contact, wanted, ACCURACY[a]);
                CHECK_RELATIVE(r.depth_x_wall, on_wall, ACCURACY[a]);
                fw_scene_result_free(&r);
            }
        print_message("accuracy %g: at most %.2g off\n", ACCURACY[a], worst);
    }
    free(t);
}

/* What the limit takes away is wear alone: every other number of the record keeps its bits. And a limit below every pressure makes load
 * limit^m x path. */
static void wear_alone(void **state)
{
    (void)state;
    fw_floe         f = {.x = -6, .y = 2, .diameter = 5, .thickness = 0.5, .vx = 2};
    fw_scene        s[3] = {limited(&f, 1.121, 1e6, 0, 1e-2), limited(&f, 1.121, 1e6, 0, 1e-2), limited(&f, 1.121, 1e3, 0, 1e-2)};
    fw_scene_result r[3];
    s[1].model.effects &= ~(uint32_t)FW_EFFECT_CRUSHING_LIMIT;
    for (int i = 0; i < 3; i++) run(&s[i], &r[i]);
    assert_true(r[0].depth_along_contact < 0.95 * r[1].depth_along_contact);
    CHECK_RELATIVE(r[0].path, r[1].path, 1e-4); /* the same integral through other nodes */
    for (size_t c = 0; c < fw_n_record_columns; c++) {
        const char *name = fw_record_columns[c].name;
        if (strncmp(name, "wear", 4) == 0 || strcmp(name, "host_cpu_s") == 0 || strcmp(name, "overlap_wear_share") == 0) continue;
        double a, b;
        memcpy(&a, (char *)&r[0].record + fw_record_columns[c].offset, sizeof a);
        memcpy(&b, (char *)&r[1].record + fw_record_columns[c].offset, sizeof b);
        if (a != b) fail_msg("%s: %g with a limit, %g without", name, a, b);
    }
    /* the last instants of a contact are below any limit */
    CHECK_RELATIVE(r[2].depth_along_contact, 1e-3 * pow(1e-3, 1.121) * r[2].path, 2e-2);
    for (int i = 0; i < 3; i++) fw_scene_result_free(&r[i]);
}

/* A window of many floes: whatever the limit does, ring and patches agree, and a higher limit wears more. */
static void windows(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    m.window = 600, m.n_laws = 3;
    m.laws[1] = (fw_abrasion_law){"power", 1, 4, false}, m.laws[2] = (fw_abrasion_law){"power", 1, 0.5, false};
    m.effects |= FW_EFFECT_CRUSHING_LIMIT;
    fw_scenario s = {.seed = 7, .concentration = 0.4, .speed = 2};
    double      last[3] = {0, 0, 0};
    for (double P0 = 0.3e6; P0 < 1e8; P0 *= 6) {
        fw_record r;
        m.crushing_limit = (fw_pressure_law){P0, 0.4};
        assert_int_equal(fw_realise(&m, &s, NULL, &r, NULL), FW_OK);
        if (r.status != FW_OK) fail_msg("%s", r.cause);
        assert_true(r.wear_conservation <= 1e-10);
        for (size_t l = 0; l < 3; l++) {
            double sum = 0;
            for (size_t k = 0; k < m.n_arcs; k++) {
                double load = fw_record_load(&r, l, FW_RING_LOAD)[k];
                assert_true(load >= 0 && fw_record_load(&r, l, FW_RING_HIGH)[k] <= load * (1 + 1e-12));
                sum += load;
            }
            assert_true(sum > last[l]);
            last[l] = sum;
        }
        fw_record_free(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(reference_floes), cmocka_unit_test(wear_alone), cmocka_unit_test(windows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
