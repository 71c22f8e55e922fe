#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "world/world.h"

static fw_body floe(double x, double y, double r, uint64_t name)
{
    return (fw_body){.x = x,
                     .y = y,
                     .vx = 1,
                     .radius = r,
                     .thickness = 0.5,
                     .inv_mass = 0.5,
                     .inv_inertia = 0.25,
                     .spin = 2,
                     .name = name};
}

static void bodies_and_energy(void **state)
{
    (void)state;
    fw_world *w;
    assert_int_equal(fw_world_create(&w, 3.7, NULL), FW_OK);
    fw_body b = floe(-5, 0, 1, 1);
    assert_int_equal(fw_world_add_body(w, &b, NULL), FW_OK);
    CHECK_NEAR(fw_world_energy(w), 0.5 * 2 * 1 + 0.5 * 4 * 4, 1e-14); /* m = 2, I = 4 by hand */
    CHECK_NEAR(w->ledger.inflow, 9, 1e-14);
    CHECK_NEAR(fw_world_overlap(w, 0, FW_WALL), 3.7 + 1 - 5, 1e-14);
    fw_world_destroy(w);
    fw_world_destroy(NULL);
}

/* Forgetting the middle floe: contacts of the others follow their floes, its own are gone, energy is booked as outflow. */
static void forgetting(void **state)
{
    (void)state;
    fw_world *w;
    assert_int_equal(fw_world_create(&w, 3.7, NULL), FW_OK);
    for (int i = 0; i < 4; i++) {
        fw_body b = floe(2.0 * i, 10, 1.05, (uint64_t)i);
        assert_int_equal(fw_world_add_body(w, &b, NULL), FW_OK);
    }
    fw_contact c[3] = {
        {.i = 0, .j = 1, .stiffness = 100}, {.i = 1, .j = 2, .stiffness = 100}, {.i = 2, .j = 3, .stiffness = 100}};
    w->contacts = malloc(sizeof c), memcpy(w->contacts, c, sizeof c), w->n_contacts = 3;
    fw_world_open_ledger(w);
    double before = fw_world_energy(w);
    bool   gone[4] = {false, true, false, false};
    fw_world_forget(w, gone);
    assert_int_equal(w->n_bodies, 3);
    assert_int_equal(w->n_contacts, 1);
    assert_int_equal(w->contacts[0].i, 1);
    assert_int_equal(w->contacts[0].j, 2);
    assert_int_equal(w->bodies[1].name, 2);
    CHECK_NEAR(before, fw_world_energy(w) + w->ledger.outflow, 1e-12);
    fw_world_destroy(w);
}

static void blocks(void **state)
{
    (void)state;
    fw_world *w;
    assert_int_equal(fw_world_create(&w, 3.7, NULL), FW_OK);
    double x[2] = {1, 5}, y[2] = {0, 1}, r[2] = {1, 2}, h[2] = {0.5, 0.6};
    assert_int_equal(fw_world_add_block(w, 2, x, y, r, h, 7, NULL), FW_OK);
    assert_int_equal(fw_world_add_block(w, 0, NULL, NULL, NULL, NULL, 9, NULL), FW_OK); /* an empty tile */
    CHECK_NEAR(w->max_radius, 2, 0);
    w->drift_x = 20;
    fw_world_drop_blocks_beyond(w, 24);
    assert_int_equal(w->n_blocks, 1); /* the empty one is gone, the other still has a floe at 21 */
    w->drift_x = 30;
    fw_world_drop_blocks_beyond(w, 24);
    assert_int_equal(w->n_blocks, 0);
    fw_world_destroy(w);
}

/* Ledger ratios: planted faults must show. */
static void ledgers(void **state)
{
    (void)state;
    fw_ledger l = {.kinetic_change = 5,
                   .impulse_work = 5,
                   .impulse_size = 100,
                   .momentum_size = 10,
                   .dashpot = 3,
                   .friction = 1,
                   .dropped = 1,
                   .drag_work = 2};
    assert_true(fw_ledger_energy_relative(&l) == 0 && fw_ledger_momentum_relative(&l) == 0);
    CHECK_NEAR(fw_ledger_energy_truncation(&l, 10, 7), 0, 1e-15);
    l.impulse_work = 4, l.momentum_error = 1;
    CHECK_NEAR(fw_ledger_energy_relative(&l), 0.01, 1e-15);
    CHECK_NEAR(fw_ledger_momentum_relative(&l), 0.1, 1e-15);
    CHECK_NEAR(fw_ledger_energy_truncation(&l, 10, 6), 0.2, 1e-15);
    /* 1 J astray of 5 J that contacts took, of a tenth of 1 kJ that drag moved, of a thousandth of 100 kJ that floes brought */
    l.drag_size = 1000;
    CHECK_NEAR(fw_ledger_energy_truncation(&l, 10, 6), 0.01, 1e-15);
    l.drag_size = 0, l.inflow = 1e5 - 10;
    CHECK_NEAR(fw_ledger_energy_truncation(&l, 10, 1e5 - 4), 0.01, 1e-12);
    fw_ledger empty = {0};
    assert_true(fw_ledger_energy_relative(&empty) == 0 && fw_ledger_energy_truncation(&empty, 0, 0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_and_energy), cmocka_unit_test(forgetting),
                                       cmocka_unit_test(blocks), cmocka_unit_test(ledgers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
