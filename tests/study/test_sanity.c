/* The swept strip beside a campaign: records that are the strip's own rings, or twice them, give ratios of 1, or 2, at every point; a site whose law
 * is known in closed form gives what its moments say. */
#include "study/made_up.h"
#include "study/sanity.h"

enum { N_ARCS = 360, N_RECORDS = 20 };

static fw_campaign campaign(double *bearings)
{
    fw_campaign c = made_up_campaign(bearings);
    fw_model_defaults(&c.model);
    c.model.n_mixes = 2;
    c.model.mixes[0].probability = 0.25;
    c.model.mixes[1] = (fw_thickness_mix){.probability = 0.75, .n_classes = 1, .classes = {{0.5, 1}}};
    c.site.speed = made_up_law(FW_DIST_UNIFORM, 0.2, 1);
    c.site.concentration = made_up_law(FW_DIST_UNIFORM, 0.1, 0.5);
    return c;
}

/* Records as the strip has them, times `times`; record 3 fails. */
typedef struct strip_records {
    fw_swept strip;
    double   times;
} strip_records;

static fw_scenario scenario(uint64_t id)
{
    return (fw_scenario){.concentration = 0.1 + 0.02 * (double)id, .speed = 0.2 + 0.04 * (double)id, .mix = (uint32_t)(id % 2)};
}

static fw_status read_strip(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    (void)m;
    strip_records *s = self;
    fw_scenario    sc = scenario(id);
    memset(r->rings, 0, fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof *r->rings);
    r->id = id, r->status = id == 3 ? FW_E_NUMERIC : FW_OK, r->weight = 1, r->randomisation = -1;
    r->concentration = sc.concentration, r->speed = sc.speed, r->mix = sc.mix;
    if (r->status != FW_OK) return FW_OK;
    fw_swept_ring(&s->strip, &sc, r->rings + r->n_arcs, NULL);
    for (size_t k = 0; k < r->n_arcs; k++) r->rings[r->n_arcs + k] *= s->times;
    return FW_OK;
}

static double sum_of(const double *ring)
{
    double sum = 0;
    for (size_t k = 0; k < N_ARCS; k++) sum += ring[k];
    return sum;
}

static void the_strip_against_itself(void **state)
{
    (void)state;
    double        bearings[24], crowded = 0, plain = 0;
    fw_campaign   c = campaign(bearings);
    strip_records s;
    fw_answer     a;
    assert_int_equal(fw_swept_make(&s.strip, &c.model, 0.2, 1, 0, NULL), FW_OK); /* the site's speeds, as the check takes them */
    fw_answer_source source = {.records = {.n = N_RECORDS, .read = read_strip, .self = &s}};
    for (s.times = 1; s.times <= 2; s.times++) {
        assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
        assert_int_equal(a.n_swept, 24);
        assert_true(a.swept_why[0] == 0);
        size_t n_worn = 0;
        for (size_t i = 0; i < a.n_swept; i++) {
            assert_true(a.swept[i].point == i + 1 && a.swept[i].bearing_deg == bearings[i]);
            if (isnan(a.swept[i].ratio)) {
                assert_true(a.points[i].mean_mm == 0 && a.swept[i].strip_mm == 0);
                continue;
            }
            CHECK_RELATIVE(a.swept[i].ratio, s.times, 1e-10);
            n_worn++;
        }
        assert_true(n_worn >= 11 && n_worn <= 15); /* the half that faces the current */
        CHECK_RELATIVE(a.swept_ring.ratio, s.times, 1e-10);
        for (uint64_t id = 0; id < N_RECORDS && s.times == 1; id++) {
            double      ring[N_ARCS];
            fw_scenario sc = scenario(id);
            fw_swept_ring(&s.strip, &sc, ring, NULL);
            if (id == 3) continue; /* it failed */
            plain += sum_of(ring);
            crowded += sum_of(ring) * (1 + 1.7 * sc.concentration + 0.93 * sc.concentration * sc.concentration);
        }
        CHECK_RELATIVE(a.swept_ring.usual, crowded / plain, 1e-10);
        fw_answer_free(&a);
    }
    fw_swept_free(&s.strip);
}

/* One scenario is the whole law: the law's depth is the records'. Then a speed of two values: the mean of the two. */
static void law_of_the_site(void **state)
{
    (void)state;
    double        bearings[24], depth[3][24];
    fw_campaign   c = campaign(bearings);
    fw_directions d;
    const double  speeds[] = {0.4, 0.9}, halves[] = {0.5, 0.5};
    c.model.mixes[0].probability = 0, c.model.mixes[1].probability = 1;
    fw_distribution_constant(&c.site.concentration, 0.3);
    assert_int_equal(fw_directions_make(&d, &c.site, N_ARCS, 24, bearings, NULL), FW_OK);
    for (size_t i = 0; i < 3; i++) {
        fw_sanity      s;
        fw_sanity_row  rows[24];
        fw_sanity_ring ring;
        fw_record      r;
        c.site.speed = made_up_law(FW_DIST_CONSTANT, speeds[i % 2], 0);
        if (i == 2) assert_int_equal(fw_distribution_values(&c.site.speed, 2, speeds, halves, NULL), FW_OK);
        fw_site_cell cells[2] = {{.probability = 1, .concentration = 0.3, .mix = 1, .speed = speeds[i % 2]}, {.probability = 0, .concentration = 0.3, .mix = 1, .speed = 2}};
        assert_int_equal(fw_record_init(&r, N_ARCS, 1, NULL), FW_OK);
        r.concentration = 0.3, r.speed = speeds[i % 2], r.mix = 1;
        assert_int_equal(fw_sanity_begin(&s, &c, 0, NULL), FW_OK);
        fw_sanity_add(&s, &r, 1);
        r.status = FW_E_LIMIT, fw_sanity_add(&s, &r, 1); /* not seen */
        assert_int_equal(fw_sanity_end(&s, &c, &d, 0.01, rows, &ring, NULL), FW_OK);
        for (size_t p = 0; p < 24; p++) {
            depth[i][p] = rows[p].law_mm;
            if (i < 2) assert_true(fabs(rows[p].law_mm - rows[p].strip_mm) <= 1e-10 * rows[p].strip_mm);
        }
        if (i < 2) CHECK_RELATIVE(ring.law_over_sample, 1, 1e-10);
        assert_true(ring.ratio == 0); /* the record wore nothing */
        fw_sanity_free(&s);

        c.site.n_cells = 2, c.site.cells = cells; /* a joint table with that one cell, or two halves */
        if (i == 2) cells[0].probability = cells[1].probability = 0.5, cells[1].speed = 0.4, cells[0].speed = 0.9;
        assert_int_equal(fw_sanity_begin(&s, &c, 0, NULL), FW_OK);
        r.status = FW_OK, r.cell = 0, r.speed = cells[0].speed;
        fw_sanity_add(&s, &r, 1);
        fw_directions of_cells;
        for (size_t k = 0; k < 2; k++) fw_distribution_constant(&cells[k].direction, 0);
        assert_int_equal(fw_directions_make(&of_cells, &c.site, N_ARCS, 24, bearings, NULL), FW_OK);
        assert_int_equal(fw_sanity_end(&s, &c, &of_cells, 0.01, rows, &ring, NULL), FW_OK);
        for (size_t p = 0; p < 24; p++) assert_true(fabs(rows[p].law_mm - depth[i][p]) <= 1e-10 * depth[i][p]);
        fw_sanity_free(&s);
        fw_directions_free(&of_cells);
        c.site.n_cells = 0, c.site.cells = NULL;
        fw_distribution_free(&c.site.speed);
        fw_record_free(&r);
    }
    double most = 0; /* each of the three has hits at speeds of its own */
    for (size_t p = 0; p < 24; p++) most = fmax(most, depth[2][p]);
    for (size_t p = 0; p < 24; p++) CHECK_NEAR(depth[2][p], 0.5 * (depth[0][p] + depth[1][p]), 0.02 * most);
    fw_directions_free(&d);
}

static void no_model_no_strip(void **state)
{
    (void)state;
    double           bearings[24];
    fw_campaign      c = made_up_campaign(bearings); /* without a structure */
    made_up          s = {.campaign = &c, .sigma = 1};
    fw_answer        a;
    fw_answer_source source = made_up_source(&s, 40);
    assert_int_equal(fw_answer_make(&a, &c, &source, NULL, NULL), FW_OK);
    assert_true(a.n_swept == 0 && a.swept == NULL && strstr(a.swept_why, "structure radius"));
    fw_answer_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_strip_against_itself),
        cmocka_unit_test(law_of_the_site),
        cmocka_unit_test(no_model_no_strip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
