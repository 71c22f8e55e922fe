/* A small world to test the kernel on: bodies put in by hand, stepped without a realisation around them. Included once per test
 * program. */
#ifndef FW_TESTS_RIG_H
#define FW_TESTS_RIG_H

#include "check.h"
#include "kernel/kernel.h"

#define PI 3.14159265358979323846

typedef struct rig {
    fw_setup   s; /* as opened, for a second kernel on the same world */
    fw_world  *w;
    fw_kernel *k;
    fw_wear    wear; /* open from the start, a measuring point at each degree */
} rig;

static inline rig open_rig(const fw_setup *s)
{
    rig                   r = {.s = *s};
    const fw_abrasion_law law = {"bekker2011", 0.116, 1.121, true};
    assert_int_equal(fw_wear_init(&r.wear, s->structure_radius, 360, 1, &law, NULL), FW_OK);
    assert_int_equal(fw_world_create(&r.w, s->structure_radius, NULL), FW_OK);
    assert_int_equal(fw_kernel_create(&r.k, s, NULL), FW_OK);
    r.wear.is_open = true;
    return r;
}

/* A body that moves: floes untouched stand still. */
static inline void put_body(rig *r, const fw_body *b)
{
    assert_int_equal(fw_world_add_body(r->w, b, NULL), FW_OK);
    r->w->bodies[r->w->n_bodies - 1].is_touched = true;
}

static inline void run(rig *r, double t)
{
    fw_msg m = {""};
    while (r->w->t < t)
        if (fw_kernel_step(r->k, r->w, &r->wear, t, &m) != FW_OK) fail_msg("%s", m.text);
}

static inline void close_rig(rig *r)
{
    fw_kernel_destroy(r->k);
    fw_world_destroy(r->w);
    fw_wear_free(&r->wear);
}

#endif
