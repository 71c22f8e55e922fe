/* Watch-dogs see what they are there for, and nothing in sound runs; a step that breaks a law is repeated finer until it does not. */
#include <string.h>

#include "check.h"
#include "kernel/watch.h"

static fw_setup setup(void)
{
    return (fw_setup){.structure_radius = 3.7, .energy_tolerance = 0.01, .velocity_scale = 2, .method = FW_METHOD_ARK3};
}

static fw_body body(double x, double y)
{
    return (fw_body){.x = x, .y = y, .radius = 1.25, .thickness = 0.5, .name = 17, .t = 4.5};
}

static void expect_failure(fw_status s, const fw_msg *m, const char *piece)
{
    assert_int_equal(s, FW_E_NUMERIC);
    assert_non_null(strstr(m->text, "floe 17"));
    assert_non_null(strstr(m->text, "t = 4.5 s"));
    if (!strstr(m->text, piece)) fail_msg("no \"%s\" in: %s", piece, m->text);
}

static void bodies(void **state)
{
    (void)state;
    fw_setup s = setup();
    fw_msg   m = {""};
    fw_body  good = body(-4, 0), inside = body(-3.6, 0), lost = body(-4, NAN), fast = body(-4, 0);
    fast.spin = INFINITY;
    assert_int_equal(fw_watch_body(&s, &good, &m), FW_OK);
    expect_failure(fw_watch_body(&s, &inside, &m), &m, "centre inside the structure");
    expect_failure(fw_watch_body(&s, &lost, &m), &m, "not finite");
    expect_failure(fw_watch_body(&s, &fast, &m), &m, "not finite");
}

/* A whole radius of the smaller disc, be that a floe or the structure. */
static void overlaps(void **state)
{
    (void)state;
    fw_setup s = setup();
    fw_msg   m = {""};
    fw_body  a = body(-4, 0), small = body(-4, 1), huge = body(-9, 0);
    small.radius = 0.3, small.name = 18, huge.radius = 8;
    assert_int_equal(fw_watch_overlap(&s, &a, NULL, 1.24, 4.5, &m), FW_OK);
    expect_failure(fw_watch_overlap(&s, &a, NULL, 1.25, 4.5, &m), &m, "the structure overlap");
    assert_int_equal(fw_watch_overlap(&s, &a, &small, 0.29, 4.5, &m), FW_OK);
    expect_failure(fw_watch_overlap(&s, &a, &small, 0.31, 4.5, &m), &m, "floe 18");
    assert_int_equal(fw_watch_overlap(&s, &huge, NULL, 3.6, 4.5, &m), FW_OK);
    expect_failure(fw_watch_overlap(&s, &huge, NULL, 3.8, 4.5, &m), &m, "whole radius");
}

static void late_touches(void **state)
{
    (void)state;
    fw_setup  s = setup();
    fw_ledger l = {0};
    fw_msg    m = {""};
    fw_body   a = body(-4, 0);
    assert_int_equal(fw_watch_late(&s, &l, &a, 0.5, 1e-3, 4.5, &m), FW_OK);
    assert_int_equal(fw_watch_late(&s, &l, &a, 0, 1e-3, 4.5, &m), FW_OK);
    CHECK_RELATIVE(l.late_overlap, 2e-3, 1e-12); /* of the floe of 0.5 m */
    expect_failure(fw_watch_late(&s, &l, &a, 0.5, 0.02, 4.5, &m), &m, "before they touched");
    assert_true(l.late_touches == 3);
}

/* One floe on the structure, as a cluster whose step ends with the given slips and forces; cap of friction 100 N, ct 100 Ns/m. */
typedef struct rig {
    fw_pair    pair;
    fw_member  member;
    fw_cluster c;
} rig;

static void step_of(rig *r, double slip0, double slip1, double normal1)
{
    size_t last = FW_METHOD_ARK3->n_stages - 1;
    r->member = (fw_member){.mass = 2209, .own_inv_mass = 1 / 2209.0, .radius = 1.25};
    r->pair.b = FW_WALL;
    r->pair.law = (fw_contact_constants){.k = 2e6, .c = 1e5, .ct = 100, .mu = 0.1, .omega = 30};
    r->pair.slip[0] = slip0, r->pair.slip[last] = slip1, r->pair.normal[0] = 1000, r->pair.normal[last] = normal1;
    r->c = (fw_cluster){.n_members = 1, .n_pairs = 1, .members = &r->member, .pairs = &r->pair, .omega = 30, .dissipated = 1000};
}

static void slip_chatters(void **state)
{
    (void)state;
    fw_setup  s = setup();
    fw_ledger l = {0};
    rig       r = {0};
    step_of(&r, 3, -3, 1000); /* from cap to cap: may be real, once */
    assert_false(fw_watch_step(&r.c, &s, 0.01));
    fw_watch_slip(&r.c, &s, &l);
    assert_true(r.pair.jumped == -1 && l.chatter == 0 && l.contact_steps == 1);
    step_of(&r, -3, 3, 1000); /* and back at once is not */
    assert_true(fw_watch_step(&r.c, &s, 0.01));
    fw_watch_slip(&r.c, &s, &l);
    assert_true(l.chatter == 1 && l.contact_steps == 2);
    CHECK_RELATIVE(fw_ledger_chatter(&l), 0.5, 1e-15);
    step_of(&r, 3, -0.5, 1000); /* ends below the cap: creep, resolved */
    assert_false(fw_watch_step(&r.c, &s, 0.01));
    fw_watch_slip(&r.c, &s, &l);
    r.pair.jumped = 1, r.pair.law.mu = 0; /* without friction there is no cap: a change of sign is just one */
    step_of(&r, 3, -3, 1000), r.pair.law.mu = 0;
    assert_false(fw_watch_step(&r.c, &s, 0.01));
    fw_watch_slip(&r.c, &s, &l);
    assert_true(l.chatter == 1 && r.pair.jumped == 0);
    step_of(&r, 3, -3, 0); /* ends without a force */
    assert_false(fw_watch_step(&r.c, &s, 0.01));
    fw_watch_slip(&r.c, &s, &l);
    assert_true(l.chatter == 1 && r.pair.jumped == 0);
    /* between floes, within what sweeps leave: a jump, but for ice that crushes beside it */
    s.solver_share = 3, s.tolerance = 1e-3;
    double least = s.solver_share * s.tolerance * s.velocity_scale;
    for (int crush = 0; crush < 2; crush++) {
        s.is_crush = crush;
        step_of(&r, 0.05 * least, -0.05 * least, 1000), r.pair.b = 1, r.pair.law.ct = 1e9;
        fw_watch_slip(&r.c, &s, &l);
        assert_true(r.pair.jumped == (crush ? 0 : -1));
        r.pair.b = FW_WALL;
        fw_watch_slip(&r.c, &s, &l);
        assert_true(r.pair.jumped == -1);
    }
    /* a sum below 0 of what has gone so far is no measure: this step is in balance */
    r.pair.jumped = 0, r.c.dissipated = -1000, r.c.tried = (fw_step_books){.dashpot = 1, .kinetic_change = -1};
    assert_false(fw_watch_step(&r.c, &s, 0.01));
}

/* Imbalance against what the cluster has dissipated: twice the tolerance is allowed in one step, and what a floe at rest cannot tell. */
static void energy_is_out(void **state)
{
    (void)state;
    fw_setup s = setup();
    rig      r = {0};
    double   at_rest = 1e-3 * 0.5 * 2209 * 4;
    step_of(&r, 1, 1, 1000);
    r.c.tried.dashpot = 500; /* and kinetic energy falls by as much, or by more */
    double bound = 0.02 * (1500 + at_rest);
    r.c.tried.kinetic_change = -500 - 0.99 * bound;
    assert_false(fw_watch_step(&r.c, &s, 0.01));
    r.c.tried.kinetic_change = -500 - 1.01 * bound;
    assert_true(fw_watch_step(&r.c, &s, 0.01));
    r.c.tried.kinetic_change = -500 + 1.01 * bound;
    assert_true(fw_watch_step(&r.c, &s, 0.01));
    assert_false(fw_watch_step(&r.c, &s, 1e-5)); /* not its length */
    r.c.dissipated = 0, r.c.tried = (fw_step_books){.kinetic_change = 0.019 * at_rest};
    assert_false(fw_watch_step(&r.c, &s, 0.01));
}

/* What errors leave of next to no dissipation may be less than nothing: no step is out for that. */
static void energy_of_nothing(void **state)
{
    (void)state;
    fw_member  floe = {.mass = 500};
    fw_cluster c = {.n_members = 1, .members = &floe, .n_pairs = 1, .omega = 100, .dissipated = -5};
    fw_pair    pair = {0};
    fw_setup   s = setup();
    c.pairs = &pair;
    c.tried.drag_work = 1e-9;
    assert_false(fw_watch_step(&c, &s, 0.01));
    c.tried.drag_work = 1; /* 1e-3 of 1 kJ: its share of 2 % */
    assert_true(fw_watch_step(&c, &s, 0.01));
}

static void floes_are_counted(void **state)
{
    (void)state;
    fw_ledger l = {.floes_start = 3, .floes_in = 5, .floes_out = 2};
    assert_true(fw_ledger_floes_lost(&l, 6) == 0 && fw_ledger_floes_lost(&l, 5) == 1 && fw_ledger_floes_lost(&l, 8) == 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bodies),        cmocka_unit_test(overlaps),      cmocka_unit_test(late_touches),
                                       cmocka_unit_test(slip_chatters), cmocka_unit_test(energy_is_out), cmocka_unit_test(energy_of_nothing), cmocka_unit_test(floes_are_counted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
