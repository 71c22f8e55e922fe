/* Whole campaigns on one rank, without MPI being started, over the stand-in simulation. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "campaign/fake_realisation.h"
#include "campaign/memory_sink.h"

typedef struct rule {
    uint64_t enough_at; /* the first look at or beyond it is enough */
    uint64_t looks[32];
    size_t   n_looks;
    bool     is_broken;
} rule;

static fw_status rule_look(void *self, uint64_t n, bool *is_enough, fw_msg *m)
{
    rule *r = self;

    r->looks[r->n_looks++] = n;
    *is_enough             = n >= r->enough_at;
    return r->is_broken ? fw_fail(m, FW_E_FORMAT, "a record cannot be read back") : FW_OK;
}

typedef struct scene {
    fw_campaign    campaign;
    fw_memory_sink sink;
    rule           rule;
    fw_run         run;
    fw_run_result  result;
    fw_msg         m;
} scene;

static int set_up(void **state)
{
    scene *s = calloc(1, sizeof *s);

    if (!s || fw_fake_campaign(&s->campaign, 42, 400, &s->m) != FW_OK) return -1;
    fw_fake_settings = (fw_fake){.nomem_id = -1};
    fw_memory_sink_create(&s->sink, &s->campaign);
    s->run = (fw_run){.campaign = &s->campaign, .sink = fw_memory_sink_of(&s->sink), .only_id = -1};
    *state = s;
    return 0;
}

static int tear_down(void **state)
{
    scene *s = *state;

    fw_memory_sink_destroy(&s->sink);
    fw_campaign_free(&s->campaign);
    free(s);
    return 0;
}

static fw_status run(scene *s)
{
    return fw_campaign_run(&s->run, &s->result, &s->m);
}

static void with_rule(scene *s, uint64_t enough_at)
{
    s->rule.enough_at = enough_at;
    s->run.stop       = (fw_stop_rule){.look = rule_look, .self = &s->rule};
}

static void test_runs_to_the_end(void **state)
{
    scene *s = *state;

    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->sink.n, 400);
    for (uint64_t i = 0; i < 400; i++) assert_int_equal(s->sink.ids[i], i);
    assert_int_equal(s->result.n_prefix, 400);
    assert_int_equal(s->result.n_done, 400);
    assert_int_equal(s->result.n_failed, 0);
    assert_false(s->result.is_enough);
    assert_true(s->sink.n_flushes >= 1);
    assert_true(s->sink.waiting_since == 0.0); /* nothing waits for a commit at the end */
}

static void test_stops_at_a_look(void **state)
{
    static const uint64_t looks[] = {100, 150, 225};
    scene                *s       = *state;

    with_rule(s, 200);
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->result.n_prefix, 225);
    assert_true(s->result.is_enough);
    assert_int_equal(s->rule.n_looks, 3);
    assert_memory_equal(s->rule.looks, looks, sizeof looks);
}

static void test_last_look_is_the_end(void **state)
{
    scene *s = *state;

    with_rule(s, 5000);
    s->campaign.precision.max_realisations = 160;
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->result.n_prefix, 160);
    assert_false(s->result.is_enough);
    assert_int_equal(s->rule.n_looks, 3);
    assert_int_equal(s->rule.looks[2], 160);
}

/* A part has no looks: its ids are no prefix, whatever the rule would say of them. */
static void test_a_part(void **state)
{
    scene *s = *state;

    with_rule(s, 1);
    s->run.first_id = 120;
    s->run.end_id   = 270;
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->sink.n, 150);
    for (uint64_t i = 0; i < 150; i++) assert_int_equal(s->sink.ids[i], 120 + i);
    assert_int_equal(s->result.n_prefix, 150);
    assert_int_equal(s->result.n_done, 150);
    assert_false(s->result.is_enough);
    assert_int_equal(s->rule.n_looks, 0);

    s->run.end_id = 120;
    assert_int_equal(run(s), FW_E_ARG);
}

/* The journal of an interrupted run is given back: the missing ones are computed, the looks come as before. */
static void test_goes_on_from_a_journal(void **state)
{
    scene   *s = *state;
    uint64_t have[200];

    for (uint64_t i = 0; i < 200; i++) have[i] = i < 120 ? i : i + 10; /* 0 .. 119, 130 .. 209 */
    s->run.have   = have;
    s->run.n_have = 200;
    with_rule(s, 200);
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->result.n_prefix, 225);
    assert_int_equal(s->rule.n_looks, 3);
    assert_int_equal(s->sink.ids[0], 120);
    assert_int_equal(s->sink.ids[9], 129);
    assert_int_equal(s->sink.ids[10], 210);
    assert_int_equal(s->sink.n, 25);
    assert_int_equal(fw_fake_settings.n_calls, 25);
}

static void test_nothing_left_to_do(void **state)
{
    scene   *s = *state;
    uint64_t have[300];

    for (uint64_t i = 0; i < 300; i++) have[i] = i;
    s->run.have   = have;
    s->run.n_have = 300;
    with_rule(s, 100);
    assert_int_equal(run(s), FW_OK); /* more is there than the look needs: the answer is still the look's */
    assert_int_equal(s->result.n_prefix, 100);
    assert_int_equal(fw_fake_settings.n_calls, 0);
}

static void test_failure_limit(void **state)
{
    scene *s = *state;

    fw_fake_settings.fail_every      = 10; /* 0, 10, 20, ... */
    s->campaign.precision.max_failed = 3;
    assert_int_equal(run(s), FW_E_FAILURES);
    assert_int_equal(fw_status_exit_code(FW_E_FAILURES), 3);
    assert_int_equal(s->result.n_prefix, 31);
    assert_int_equal(s->result.n_failed, 4);
    assert_int_equal(s->sink.n, 31); /* failed ones are kept, and nothing is computed in vain */
    assert_non_null(strstr(s->m.text, "id 0 (seed 42): failed on purpose"));
    assert_non_null(strstr(s->m.text, "id 30 (seed 42)"));
}

static void test_failures_of_earlier_calls_count(void **state)
{
    static const uint64_t have[] = {0, 1, 2}, failed[] = {0, 2};
    scene                *s      = *state;

    s->run.have                      = have;
    s->run.n_have                    = 3;
    s->run.have_failed               = failed;
    s->run.n_have_failed             = 2;
    s->campaign.precision.max_failed = 1;
    assert_int_equal(run(s), FW_E_FAILURES);
    assert_int_equal(s->result.n_prefix, 3);
    assert_int_equal(fw_fake_settings.n_calls, 0);
    s->campaign.precision.max_failed = 2; /* exactly as many as allowed: goes on */
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->result.n_failed, 2);
    assert_int_equal(s->result.n_done, 400);
}

static void test_sink_that_breaks(void **state)
{
    scene *s = *state;

    s->sink.break_at = 17;
    assert_int_equal(run(s), FW_E_IO);
    assert_string_equal(s->m.text, "the disk is full on purpose");
    assert_int_equal(s->result.n_prefix, 17);
    assert_int_equal(fw_fake_settings.n_calls, 18);
}

static fw_status broken_flush(void *self, fw_msg *m)
{
    (void)self;
    return fw_fail(m, FW_E_IO, "no space left for the last records");
}

/* Records that only the last commit loses are lost all the same. */
static void test_last_flush_that_breaks(void **state)
{
    scene *s = *state;

    s->run.sink.flush = broken_flush;
    assert_int_equal(run(s), FW_E_IO);
    assert_string_equal(s->m.text, "no space left for the last records");
}

static void test_rule_that_breaks(void **state)
{
    scene *s = *state;

    with_rule(s, 100);
    s->rule.is_broken = true;
    assert_int_equal(run(s), FW_E_FORMAT);
    assert_string_equal(s->m.text, "a record cannot be read back");
    assert_int_equal(s->result.n_done, 100);
}

static void test_no_memory(void **state)
{
    scene *s = *state;

    fw_fake_settings.nomem_id = 5;
    assert_int_equal(run(s), FW_E_NOMEM);
    assert_string_equal(s->m.text, "realisation 5: out of memory on purpose");
    assert_int_equal(s->result.n_prefix, 5);
}

static void test_only_one(void **state)
{
    scene         *s = *state;
    fw_memory_sink all;

    assert_int_equal(run(s), FW_OK);
    all = s->sink;
    fw_memory_sink_create(&s->sink, &s->campaign);
    s->run.only_id = 123;
    assert_int_equal(run(s), FW_OK);
    assert_int_equal(s->sink.n, 1);
    /* the same bits as within the campaign */
    assert_memory_equal(s->sink.bytes, all.bytes + 123 * all.n_bytes, all.n_bytes);
    fw_memory_sink_destroy(&all);
}

typedef struct meter {
    size_t      n;
    fw_progress last;
} meter;

static void meter_show(void *self, const fw_progress *p)
{
    meter *w = self;

    if (w->n++) assert_true(p->done >= w->last.done && p->elapsed_s >= w->last.elapsed_s);
    w->last = *p;
}

/* Realisations of half a second, a budget of 1.6 s: what is done is committed within a second though rank 0 computes
 * itself, the live line goes on meanwhile, and the one under way at the end is dropped, not finished. */
static void test_long_realisations(void **state)
{
    scene *s = *state;
    meter  w = {0};

    s->run.watcher                 = (fw_watcher){.show = meter_show, .self = &w};
    fw_fake_settings.cost_s        = 0.5;
    s->campaign.precision.budget_s = 1.6;
    assert_int_equal(run(s), FW_E_STOPPED);
    assert_in_range(s->sink.n, 0, 3); /* 3 at best; a loaded machine does less */
    assert_int_equal(s->result.n_prefix, s->sink.n);
    assert_int_equal(fw_fake_settings.n_calls, s->sink.n + 1);
    assert_true(s->sink.waiting_since <= 0.0 && s->sink.longest_gap_s < 1.0);
    assert_in_range(w.n, 4, 9); /* every 0.2 s */
    assert_int_equal(w.last.done, s->sink.n);
    assert_int_equal(w.last.total, 400);
    assert_true(w.last.elapsed_s < 1.9);
    assert_non_null(strstr(s->m.text, "budget"));
}

static void test_bad_calls(void **state)
{
    scene *s = *state;

    s->run.sink.append = NULL;
    assert_int_equal(run(s), FW_E_ARG);
    assert_int_equal(fw_campaign_serve(&s->campaign, &s->m), FW_E_ARG);
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(test_runs_to_the_end),
        CASE(test_stops_at_a_look),
        CASE(test_last_look_is_the_end),
        CASE(test_a_part),
        CASE(test_goes_on_from_a_journal),
        CASE(test_nothing_left_to_do),
        CASE(test_failure_limit),
        CASE(test_failures_of_earlier_calls_count),
        CASE(test_sink_that_breaks),
        CASE(test_last_flush_that_breaks),
        CASE(test_rule_that_breaks),
        CASE(test_no_memory),
        CASE(test_only_one),
        CASE(test_long_realisations),
        CASE(test_bad_calls),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
